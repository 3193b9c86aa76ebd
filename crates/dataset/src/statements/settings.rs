//! INTEGRATOR, EQUILIBRIUM, KINEMATICS, IC and PREFERENCES.

use super::Builder;
use crate::diagnostic::Code;
use crate::keywords::{Keyword, Kind, SUBROUTINE, abbreviated, keyword};
use crate::model::{
    Corrector, Equilibrium, IndexReduction, InitialConditions, Integrator, IntegratorMethod,
    Kinematics, Preferences,
};
use crate::reading::Reading;

const STIFF: &str = "stiction integrates by backward differentiation";
const TOLERANCE: &str = "ERROR alone is the tolerance";

pub(crate) const INTEGRATOR_KEYWORDS: &[Keyword] = &[
    keyword("GSTIFF", Kind::Flag),
    keyword("WSTIFF", Kind::Flag),
    keyword("HASTIFF", Kind::Flag),
    keyword("HHT", Kind::Flag),
    keyword("NEWMARK", Kind::Flag),
    keyword("ABAM", Kind::Flag),
    keyword("I3", Kind::Flag),
    keyword("SI2", Kind::Flag),
    keyword("SI1", Kind::Flag),
    abbreviated("ERROR", "E", Kind::Real),
    keyword("HINIT", Kind::Real),
    keyword("HMAX", Kind::Real),
    keyword("HMIN", Kind::Real),
    keyword("HRATIO", Kind::Real),
    abbreviated("KMAX", "K", Kind::Integer),
    abbreviated("MAXIT", "M", Kind::Integer),
    keyword("FIXIT", Kind::Integer),
    abbreviated("PATTERN", "P", Kind::Words),
    abbreviated("CORRECTOR", "C", Kind::Word),
    abbreviated("INTERPOLATE", "IN", Kind::Word),
    keyword("ADAPTIVITY", Kind::Real),
    keyword("CONSTANT_BDF", Kind::Ignored(STIFF)),
    keyword("CPBDF", Kind::Ignored(STIFF)),
    keyword("DSTIFF", Kind::Ignored(STIFF)),
    keyword("RKF45", Kind::Ignored(STIFF)),
    keyword("MAXERR", Kind::Ignored(TOLERANCE)),
    keyword("SCALE", Kind::Ignored(TOLERANCE)),
    keyword(
        "RECONCILE",
        Kind::Ignored("outputs are always brought onto the constraints"),
    ),
    keyword(
        "REPARTITION_THRESHOLD",
        Kind::Ignored("coordinates are not partitioned"),
    ),
    keyword("ALPHA", Kind::Real),
    keyword("BETA", Kind::Real),
    keyword("GAMMA", Kind::Real),
];

/// The arguments of INTEGRATOR, as a statement or as a command.
pub(crate) fn integrator(reading: &mut Reading) -> Integrator {
    let methods = [
        IntegratorMethod::Gstiff,
        IntegratorMethod::Wstiff,
        IntegratorMethod::Hastiff,
        IntegratorMethod::Hht,
        IntegratorMethod::Newmark,
        IntegratorMethod::Abam,
    ]
    .map(|method| (method.keyword(), method));
    let formulations = [
        ("I3", IndexReduction::I3),
        ("SI2", IndexReduction::Si2),
        ("SI1", IndexReduction::Si1),
    ];
    let correctors = [
        ("ORIGINAL", Corrector::Original),
        ("MODIFIED", Corrector::Modified),
        // The original one that is never changed by itself for the modified one.
        ("ORIG_CONSTANT", Corrector::Original),
    ];
    if let (Some(hmin), Some(hmax)) = (reading.real("HMIN"), reading.real("HMAX"))
        && hmin > hmax
    {
        let span = reading.place("HMIN");
        let message = format!("HMIN = {hmin} is greater than HMAX = {hmax}");
        reading.diagnostics.error(Code::OutOfRange, span, message);
    }
    Integrator {
        method: reading.one_flag(&methods),
        formulation: reading.one_flag(&formulations),
        error: reading.positive("ERROR"),
        hinit: reading.positive("HINIT"),
        hmax: reading.positive("HMAX"),
        hmin: reading.positive("HMIN"),
        hratio: reading.positive("HRATIO"),
        kmax: reading.count("KMAX"),
        maxit: reading.count("MAXIT"),
        fixit: reading.count("FIXIT"),
        pattern: reading.pattern("PATTERN"),
        corrector: reading.choice("CORRECTOR", &correctors),
        interpolate: reading.switch("INTERPOLATE"),
        adaptivity: reading.not_negative("ADAPTIVITY"),
        alpha: reading.real("ALPHA"),
        beta: reading.real("BETA"),
        gamma: reading.real("GAMMA"),
        span: reading.span,
    }
}

/// INTEGRATOR.
pub(super) fn integrator_statement(reading: &mut Reading, builder: &mut Builder) {
    builder.dataset.integrator = Some(integrator(reading));
}

const ITERATION: &str = "equilibria are found by iteration";
const INNER: &str = "the iteration has no inner one";

pub(crate) const EQUILIBRIUM_KEYWORDS: &[Keyword] = &[
    abbreviated("ALIMIT", "AL", Kind::Real),
    abbreviated("TLIMIT", "TL", Kind::Real),
    abbreviated("ERROR", "ERR", Kind::Real),
    abbreviated("IMBALANCE", "IM", Kind::Real),
    abbreviated("STABILITY", "ST", Kind::Real),
    abbreviated("MAXIT", "MAX", Kind::Integer),
    abbreviated("PATTERN", "PAT", Kind::Words),
    keyword("METHOD", Kind::Text),
    keyword("ATOL", Kind::Real),
    keyword("RTOL", Kind::Real),
    keyword("MAXITL", Kind::Integer),
    keyword("STATIC", Kind::Flag),
    keyword("DYNAMIC", Kind::Ignored(ITERATION)),
    keyword("ACCELERATION_ERROR", Kind::Ignored(ITERATION)),
    keyword("GLOBAL_DAMPING", Kind::Ignored(ITERATION)),
    keyword("KINETIC_ENERGY_ERROR", Kind::Ignored(ITERATION)),
    keyword("SETTLING_TIME", Kind::Ignored(ITERATION)),
    keyword("ETA", Kind::Ignored(INNER)),
    keyword("ETAMAX", Kind::Ignored(INNER)),
];

/// The arguments of EQUILIBRIUM, as a statement or as a command.
pub(crate) fn equilibrium(reading: &mut Reading) -> Equilibrium {
    Equilibrium {
        alimit: reading.positive("ALIMIT"),
        tlimit: reading.positive("TLIMIT"),
        error: reading.positive("ERROR"),
        imbalance: reading.positive("IMBALANCE"),
        stability: reading.not_negative("STABILITY"),
        maxit: reading.count("MAXIT"),
        pattern: reading.pattern("PATTERN"),
        method: reading.text("METHOD"),
        atol: reading.positive("ATOL"),
        rtol: reading.positive("RTOL"),
        maxitl: reading.count("MAXITL"),
        span: reading.span,
    }
}

/// EQUILIBRIUM.
pub(super) fn equilibrium_statement(reading: &mut Reading, builder: &mut Builder) {
    builder.dataset.equilibrium = Some(equilibrium(reading));
}

pub(super) const KINEMATICS_KEYWORDS: &[Keyword] = &[
    abbreviated("ERROR", "ERR", Kind::Real),
    keyword("AERROR", Kind::Real),
    abbreviated("MAXIT", "MAX", Kind::Integer),
    keyword("AMAXIT", Kind::Integer),
    keyword("ALIMIT", Kind::Real),
    keyword("TLIMIT", Kind::Real),
    keyword("HMAX", Kind::Real),
    keyword("PATTERN", Kind::Words),
    keyword("APATTERN", Kind::Words),
];

/// KINEMATICS.
pub(super) fn kinematics(reading: &mut Reading, builder: &mut Builder) {
    builder.dataset.kinematics = Some(Kinematics {
        error: reading.positive("ERROR"),
        aerror: reading.positive("AERROR"),
        maxit: reading.count("MAXIT"),
        amaxit: reading.count("AMAXIT"),
        alimit: reading.positive("ALIMIT"),
        tlimit: reading.positive("TLIMIT"),
        hmax: reading.positive("HMAX"),
        pattern: reading.pattern("PATTERN"),
        apattern: reading.pattern("APATTERN"),
        span: reading.span,
    });
}

pub(super) const IC_KEYWORDS: &[Keyword] = &[
    abbreviated("ERROR", "ERR", Kind::Real),
    abbreviated("VERROR", "VER", Kind::Real),
    abbreviated("AERROR", "AERR", Kind::Real),
    abbreviated("MAXIT", "MAX", Kind::Integer),
    abbreviated("AMAXIT", "AMAX", Kind::Integer),
    abbreviated("ALIMIT", "AL", Kind::Real),
    abbreviated("TLIMIT", "TL", Kind::Real),
    abbreviated("PATTERN", "PAT", Kind::Words),
    abbreviated("APATTERN", "APAT", Kind::Words),
];

/// IC.
pub(super) fn initial_conditions(reading: &mut Reading, builder: &mut Builder) {
    builder.dataset.initial_conditions = Some(InitialConditions {
        error: reading.positive("ERROR"),
        verror: reading.positive("VERROR"),
        aerror: reading.positive("AERROR"),
        maxit: reading.count("MAXIT"),
        amaxit: reading.count("AMAXIT"),
        alimit: reading.positive("ALIMIT"),
        tlimit: reading.positive("TLIMIT"),
        pattern: reading.pattern("PATTERN"),
        apattern: reading.pattern("APATTERN"),
        span: reading.span,
    });
}

const NO_CONTACT: &str = "contacts are not simulated";
const RIGID: &str = "parts are rigid";

pub(crate) const PREFERENCES_KEYWORDS: &[Keyword] = &[
    keyword("SIMFAIL", Kind::Word),
    keyword("CONTACT_FACETING_TOLERANCE", Kind::Ignored(NO_CONTACT)),
    keyword("CONTACT_GEOMETRY_LIBRARY", Kind::Ignored(NO_CONTACT)),
    keyword("FLEX_BODY_FORMULATION", Kind::Ignored(RIGID)),
    keyword("FLEX_LIMIT_CHECK", Kind::Ignored(RIGID)),
    keyword("FLEX_LIMIT_CHECK_ACTION", Kind::Ignored(RIGID)),
    keyword("LIBPATH", Kind::Ignored(SUBROUTINE)),
    keyword("NTHREADS", Kind::Ignored("one thread is used")),
    keyword(
        "STATUS_MESSAGE",
        Kind::Ignored("messages are not switched off"),
    ),
    keyword("LIST_STATUS", Kind::Ignored("stiction prints no listing")),
];

/// PREFERENCES, as a statement or a command.
pub(crate) fn preferences(reading: &mut Reading) -> Preferences {
    let choices = [("STOPCF", true), ("NOSTOPCF", false)];
    Preferences {
        stop_on_failure: reading.choice("SIMFAIL", &choices),
        span: reading.span,
    }
}

/// PREFERENCES.
pub(super) fn preferences_statement(reading: &mut Reading, builder: &mut Builder) {
    builder.dataset.preferences = Some(preferences(reading));
}
