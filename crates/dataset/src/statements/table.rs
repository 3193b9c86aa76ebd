//! The table of statements.

use super::Builder;
use super::{
    array, contact, coupler, curve, differential, elastic, force, friction, joint, linear_system,
    motion, multiple_request, part, request, sensor, settings, spline, units, variable,
    vector_force,
};
use crate::keywords::Keyword;
use crate::names::Name;
use crate::reading::Reading;

/// What is done with a statement.
#[derive(Clone, Copy)]
pub(crate) enum Action {
    /// Its arguments are read by this function. Without keywords they are left as they are.
    Read(Option<&'static [Keyword]>, fn(&mut Reading, &mut Builder)),
    /// It cannot change the motion: a warning with the reason.
    Ignored(&'static str),
    /// It is refused; what to write instead.
    Unsupported(&'static str),
}

/// A statement of the language.
#[derive(Clone, Copy)]
pub(crate) struct Rule {
    pub(crate) name: Name,
    /// Whether it has an identifier. One without may occur once.
    pub(crate) identified: bool,
    pub(crate) action: Action,
}

const fn read(
    full: &'static str,
    least: &'static str,
    keywords: &'static [Keyword],
    read: fn(&mut Reading, &mut Builder),
) -> Rule {
    Rule {
        name: Name { full, least },
        identified: true,
        action: Action::Read(Some(keywords), read),
    }
}

const fn single(
    full: &'static str,
    least: &'static str,
    keywords: &'static [Keyword],
    read: fn(&mut Reading, &mut Builder),
) -> Rule {
    Rule {
        identified: false,
        ..self::read(full, least, keywords, read)
    }
}

const fn ignored(full: &'static str, reason: &'static str) -> Rule {
    Rule {
        name: Name { full, least: full },
        identified: false,
        action: Action::Ignored(reason),
    }
}

const fn unsupported(full: &'static str, least: &'static str, instead: &'static str) -> Rule {
    Rule {
        name: Name { full, least },
        identified: false,
        action: Action::Unsupported(instead),
    }
}

/// Why a statement that only holds data is harmless: whatever could use it is refused.
const DATA: &str = "nothing that is simulated can use it";

const INTEGRATOR: &str = "write its arguments in INTEGRATOR";
const ONLY_REPORTS: &str = "it only reports distances";

/// What to write instead of statements that are refused.
const FLEXIBLE: &str =
    "make the part rigid (PART with its mass and inertia), or a chain of parts and BEAMs";
const FORCES: &str = "write it as BEAMs, FIELDs or GFORCEs between pairs of markers";
const LIKE: &str = "a BUSHING or a FIELD with the stiffness at the operating point comes near";
const SURFACES: &str = "write a GCON on the distance of two markers, or a joint";
const PROGRAM: &str = "what another program computes is not read; write forces as functions";
const SUBROUTINE_STATES: &str =
    "subroutines are not called; write a DIFF for each state and a VARIABLE for each output";
const TIRES: &str = "write the force as a GFORCE with functions";
const CONSTRAINTS: &str = "write it as a GCON with a function";

/// Every statement of the language.
pub(crate) const STATEMENTS: &[Rule] = &[
    single("UNITS", "UNI", units::KEYWORDS, units::units),
    single("ACCGRAV", "ACC", units::GRAVITY_KEYWORDS, units::accgrav),
    read("PART", "P", part::PART_KEYWORDS, part::part),
    read(
        "POINT_MASS",
        "POI",
        part::POINT_MASS_KEYWORDS,
        part::point_mass,
    ),
    read("MARKER", "M", part::MARKER_KEYWORDS, part::marker),
    read("JOINT", "J", joint::JOINT_KEYWORDS, joint::joint),
    read("JPRIM", "JP", joint::PRIMITIVE_KEYWORDS, joint::primitive),
    read("GCON", "GC", joint::CONSTRAINT_KEYWORDS, joint::constraint),
    read("COUPLER", "COU", coupler::KEYWORDS, coupler::coupler),
    read("GEAR", "GE", coupler::GEAR_KEYWORDS, coupler::gear),
    read("MOTION", "MO", motion::KEYWORDS, motion::motion),
    read("SFORCE", "SF", force::SINGLE_KEYWORDS, force::single_force),
    read(
        "SPRINGDAMPER",
        "SPR",
        force::SPRING_KEYWORDS,
        force::spring_damper,
    ),
    read(
        "VFORCE",
        "VF",
        vector_force::FORCE_KEYWORDS,
        vector_force::force,
    ),
    read(
        "VTORQUE",
        "VT",
        vector_force::TORQUE_KEYWORDS,
        vector_force::torque,
    ),
    read(
        "GFORCE",
        "GF",
        vector_force::GENERAL_KEYWORDS,
        vector_force::general,
    ),
    read("BUSHING", "BU", elastic::BUSHING_KEYWORDS, elastic::bushing),
    read("FIELD", "FI", elastic::FIELD_KEYWORDS, elastic::field),
    read("BEAM", "BE", elastic::BEAM_KEYWORDS, elastic::beam),
    read("CONTACT", "CON", contact::KEYWORDS, contact::contact),
    read("PTCV", "PT", curve::POINT_KEYWORDS, curve::point_curve),
    read("CURVE", "CU", curve::KEYWORDS, curve::curve),
    read("SPLINE", "SPL", spline::KEYWORDS, spline::spline),
    read("VARIABLE", "VAR", variable::KEYWORDS, variable::variable),
    read(
        "DIFF",
        "DI",
        differential::KEYWORDS,
        differential::differential,
    ),
    read("ARRAY", "AR", array::ARRAY_KEYWORDS, array::array),
    read("MATRIX", "MAT", array::MATRIX_KEYWORDS, array::matrix),
    read("STRING", "STR", array::STRING_KEYWORDS, array::string),
    read(
        "LSE",
        "LS",
        linear_system::EQUATIONS_KEYWORDS,
        linear_system::equations,
    ),
    read(
        "TFSISO",
        "TF",
        linear_system::TRANSFER_KEYWORDS,
        linear_system::transfer_function,
    ),
    read(
        "PINPUT",
        "PINP",
        variable::PORT_KEYWORDS,
        variable::plant_input,
    ),
    read(
        "POUTPUT",
        "POUT",
        variable::PORT_KEYWORDS,
        variable::plant_output,
    ),
    read("REQUEST", "R", request::KEYWORDS, request::request),
    read(
        "MREQUEST",
        "MR",
        multiple_request::KEYWORDS,
        multiple_request::multiple_request,
    ),
    read("SENSOR", "SE", sensor::KEYWORDS, sensor::sensor),
    read("FRICTION", "FRI", friction::KEYWORDS, friction::friction),
    Rule {
        name: Name {
            full: "GRAPHICS",
            least: "G",
        },
        identified: true,
        action: Action::Read(None, request::graphics),
    },
    single("OUTPUT", "OUT", request::OUTPUT_KEYWORDS, request::output),
    single(
        "RESULTS",
        "RES",
        request::RESULTS_KEYWORDS,
        request::results,
    ),
    single(
        "INTEGRATOR",
        "INT",
        settings::INTEGRATOR_KEYWORDS,
        settings::integrator_statement,
    ),
    single(
        "EQUILIBRIUM",
        "EQU",
        settings::EQUILIBRIUM_KEYWORDS,
        settings::equilibrium_statement,
    ),
    single(
        "KINEMATICS",
        "KIN",
        settings::KINEMATICS_KEYWORDS,
        settings::kinematics,
    ),
    single(
        "IC",
        "IC",
        settings::IC_KEYWORDS,
        settings::initial_conditions,
    ),
    single(
        "PREFERENCES",
        "PREF",
        settings::PREFERENCES_KEYWORDS,
        settings::preferences_statement,
    ),
    ignored("SURFACE", DATA),
    ignored("MATERIAL", "rigid parts give their own mass and inertia"),
    ignored("SECTION", "only flexible parts have a cross-section"),
    ignored("DEBUG", "it asks for diagnostics of another program"),
    ignored("ENVIRONMENT", "stiction reads no environment variables"),
    // What INTEGRATOR was in old datasets.
    ignored("ABAM", INTEGRATOR),
    ignored("DSTIFF", INTEGRATOR),
    ignored("GSTIFF", INTEGRATOR),
    ignored("WSTIFF", INTEGRATOR),
    ignored("LSOLVER", "stiction has one linear solver"),
    ignored("LIST", "stiction prints no listing"),
    ignored("NOLIST", "stiction prints no listing"),
    ignored("CLEARANCE", ONLY_REPORTS),
    ignored("FEMDATA", "it writes loads for other programs"),
    ignored("MADATA", "it writes modal data for another program"),
    ignored(
        "PSTATE",
        "stiction chooses the coordinates of linear models",
    ),
    unsupported("ADAMS_BUSHING", "ADAMS_BUSHING", LIKE),
    unsupported("CVCV", "CVCV", SURFACES),
    unsupported("EXTERNAL_SYSTEM", "EXT", PROGRAM),
    unsupported("FE_LOAD", "FE_L", FLEXIBLE),
    unsupported("FE_NODE", "FE_N", FLEXIBLE),
    unsupported("FE_PART", "FE_P", FLEXIBLE),
    unsupported("FLEX_BODY", "FL", FLEXIBLE),
    unsupported("GSE", "GS", SUBROUTINE_STATES),
    unsupported("MFORCE", "MF", FLEXIBLE),
    unsupported("NFORCE", "NF", FORCES),
    unsupported("TIRE", "TIRE", TIRES),
    unsupported("UCON", "UC", CONSTRAINTS),
];
