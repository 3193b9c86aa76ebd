//! Settings of analyses and of output: INTEGRATOR, EQUILIBRIUM, KINEMATICS, IC, PREFERENCES,
//! OUTPUT and RESULTS. Every absent argument is `None`.

use crate::source::Span;

/// The integration method asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IntegratorMethod {
    /// GSTIFF: backward differences, fixed coefficients.
    Gstiff,
    /// WSTIFF: backward differences, variable coefficients.
    Wstiff,
    /// HASTIFF.
    Hastiff,
    /// HHT: Hilber, Hughes and Taylor.
    Hht,
    /// NEWMARK.
    Newmark,
    /// ABAM: Adams and Moulton.
    Abam,
}

impl IntegratorMethod {
    /// The name in the dataset language.
    #[must_use]
    pub const fn keyword(self) -> &'static str {
        match self {
            Self::Gstiff => "GSTIFF",
            Self::Wstiff => "WSTIFF",
            Self::Hastiff => "HASTIFF",
            Self::Hht => "HHT",
            Self::Newmark => "NEWMARK",
            Self::Abam => "ABAM",
        }
    }
}

/// The form of the constrained equations asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IndexReduction {
    /// I3: index three.
    I3,
    /// SI2: stabilised index two.
    Si2,
    /// SI1: stabilised index one.
    Si1,
}

/// CORRECTOR: which unknowns the corrector must have converged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Corrector {
    /// All of them.
    Original,
    /// Only those under error control.
    Modified,
}

/// INTEGRATOR.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Integrator {
    /// Method; Adams takes GSTIFF.
    pub method: Option<IntegratorMethod>,
    /// Form; Adams takes I3.
    pub formulation: Option<IndexReduction>,
    /// ERROR: local error, at most.
    pub error: Option<f64>,
    /// HINIT: first step, time.
    pub hinit: Option<f64>,
    /// HMAX: largest step, time.
    pub hmax: Option<f64>,
    /// HMIN: smallest step, time.
    pub hmin: Option<f64>,
    /// HRATIO: steps of an output step where FIXIT is given.
    pub hratio: Option<f64>,
    /// KMAX: highest order.
    pub kmax: Option<u32>,
    /// MAXIT: most iterations of a step.
    pub maxit: Option<u32>,
    /// FIXIT: so many iterations of every step, steps of fixed length.
    pub fixit: Option<u32>,
    /// PATTERN: at which iterations the Jacobian is computed anew.
    pub pattern: Option<Vec<bool>>,
    /// CORRECTOR: what must have converged.
    pub corrector: Option<Corrector>,
    /// INTERPOLATE: output by interpolation.
    pub interpolate: Option<bool>,
    /// ADAPTIVITY: divided by the step, what is added to the tolerance of the corrector.
    pub adaptivity: Option<f64>,
    /// ALPHA of HHT.
    pub alpha: Option<f64>,
    /// BETA of NEWMARK.
    pub beta: Option<f64>,
    /// GAMMA of NEWMARK.
    pub gamma: Option<f64>,
    /// The place of the statement.
    pub span: Span,
}

/// EQUILIBRIUM.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Equilibrium {
    /// ALIMIT: largest change of an angle in an iteration, radians.
    pub alimit: Option<f64>,
    /// TLIMIT: largest change of a displacement in an iteration, length.
    pub tlimit: Option<f64>,
    /// ERROR: largest change when converged.
    pub error: Option<f64>,
    /// IMBALANCE: largest residual when converged.
    pub imbalance: Option<f64>,
    /// STABILITY: fraction of mass and damping that is added to the stiffness.
    pub stability: Option<f64>,
    /// MAXIT: most iterations.
    pub maxit: Option<u32>,
    /// PATTERN: at which iterations the Jacobian is computed anew.
    pub pattern: Option<Vec<bool>>,
    /// METHOD.
    pub method: Option<String>,
    /// ATOL.
    pub atol: Option<f64>,
    /// RTOL.
    pub rtol: Option<f64>,
    /// MAXITL.
    pub maxitl: Option<u32>,
    /// The place of the statement.
    pub span: Span,
}

/// KINEMATICS.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kinematics {
    /// ERROR: largest change when converged.
    pub error: Option<f64>,
    /// AERROR: the same of accelerations.
    pub aerror: Option<f64>,
    /// MAXIT: most iterations.
    pub maxit: Option<u32>,
    /// AMAXIT: most iterations for accelerations.
    pub amaxit: Option<u32>,
    /// ALIMIT, radians.
    pub alimit: Option<f64>,
    /// TLIMIT, length.
    pub tlimit: Option<f64>,
    /// HMAX: largest step, time.
    pub hmax: Option<f64>,
    /// PATTERN.
    pub pattern: Option<Vec<bool>>,
    /// APATTERN.
    pub apattern: Option<Vec<bool>>,
    /// The place of the statement.
    pub span: Span,
}

/// IC: how initial conditions are solved.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InitialConditions {
    /// ERROR: of positions.
    pub error: Option<f64>,
    /// VERROR: of velocities.
    pub verror: Option<f64>,
    /// AERROR: of accelerations.
    pub aerror: Option<f64>,
    /// MAXIT.
    pub maxit: Option<u32>,
    /// AMAXIT.
    pub amaxit: Option<u32>,
    /// ALIMIT, radians.
    pub alimit: Option<f64>,
    /// TLIMIT, length.
    pub tlimit: Option<f64>,
    /// PATTERN.
    pub pattern: Option<Vec<bool>>,
    /// APATTERN.
    pub apattern: Option<Vec<bool>>,
    /// The place of the statement.
    pub span: Span,
}

/// PREFERENCES.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Preferences {
    /// SIMFAIL=STOPCF: stop at the first command that fails.
    pub stop_on_failure: Option<bool>,
    /// The place of the statement.
    pub span: Span,
}

/// OUTPUT.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OutputOptions {
    /// REQSAVE: write the requests to `.req`.
    pub requests: bool,
}

/// RESULTS.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ResultsOptions {
    /// DECIMALPLACES.
    pub decimal_places: Option<u32>,
    /// COMMENT.
    pub comment: Option<String>,
}
