//! INTEGRATOR, EQUILIBRIUM and SIMULATE to settings and output times; what is not honoured is
//! listed.

use dataset::{
    Code, Equilibrium, IndexReduction, Integrator, IntegratorMethod, Kinematics, Simulate,
};
use mechanics::{EquilibriumSettings, Formulation, Settings};

/// Error tolerance without an INTEGRATOR statement.
const OWN_ERROR: f64 = 1e-6;
/// Shortest step where HMIN is not given and that of Adams would be longer, seconds.
const SHORTEST: f64 = 1e-9;
/// Highest order of the formulas that are stable enough to be used.
const HIGHEST_ORDER: u32 = 5;
/// ALPHA of HHT, BETA and GAMMA of NEWMARK where they are not given (statement page of INTEGRATOR).
const HHT_ALPHA: f64 = -0.3;
const NEWMARK_BETA: f64 = 0.36;
const NEWMARK_GAMMA: f64 = 0.7;
/// Where HHT and Newmark's method are stable: with less, the steps of position constraints swing up.
const ALPHAS: [f64; 2] = [-1.0 / 3.0, 0.0];
const BETAS: [f64; 2] = [0.25, 1.0];
const GAMMAS: [f64; 2] = [0.5, 1.0];
/// Output steps of a SIMULATE with neither STEPS nor DTOUT.
const DEFAULT_STEPS: u32 = 50;
/// More outputs than this in one simulation are refused.
const MOST_OUTPUTS: f64 = 1e7;

/// How a simulation is integrated, and what to tell about it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Choice {
    pub(crate) settings: Settings,
    /// What differs from what the dataset says or leaves open.
    pub(crate) notes: Vec<String>,
}

/// Settings of a simulation with outputs every `output_step`; `error` overrides the tolerance, and
/// HMAX of `kinematics`, where it is kinematic, limits the step, too.
///
/// Defaults are those of Adams (I3, error 1e-3, HMAX of one output step, KMAX 6, MAXIT 10), except
/// that without any INTEGRATOR statement it is SI2 with error 1e-6, and that HMIN is a nanosecond
/// where 1e-6 HMAX is longer. `second` is one second in the unit of time.
pub(crate) fn choose(
    integrator: Option<&Integrator>,
    kinematics: Option<&Kinematics>,
    output_step: f64,
    error: Option<f64>,
    second: f64,
) -> Choice {
    let mut notes = Vec::new();
    let fallback = Integrator::default();
    if integrator.is_none() {
        notes.push(format!(
            "no INTEGRATOR statement: stabilised index 2 (SI2) with error {:e} is used",
            error.unwrap_or(OWN_ERROR)
        ));
    }
    let given = integrator.unwrap_or(&fallback);
    let method = given.method.unwrap_or(IntegratorMethod::Gstiff);
    let formulation = match method {
        IntegratorMethod::Hht => Formulation::Hht {
            alpha: in_range(given.alpha, HHT_ALPHA, ALPHAS, "ALPHA", &mut notes),
        },
        IntegratorMethod::Newmark => Formulation::Newmark {
            beta: in_range(given.beta, NEWMARK_BETA, BETAS, "BETA", &mut notes),
            gamma: in_range(given.gamma, NEWMARK_GAMMA, GAMMAS, "GAMMA", &mut notes),
        },
        _ => match given.formulation {
            None if integrator.is_none() => Formulation::Si2,
            None | Some(IndexReduction::I3) => Formulation::I3,
            Some(IndexReduction::Si2) => Formulation::Si2,
            Some(IndexReduction::Si1) => {
                notes.push("SI1 is not available: SI2 is used".to_owned());
                Formulation::Si2
            }
        },
    };
    let is_newmark = matches!(method, IntegratorMethod::Hht | IntegratorMethod::Newmark);
    if !(is_newmark || method == IntegratorMethod::Gstiff) {
        notes.push(format!(
            "{} is not available: backward differences of variable order (as GSTIFF) are used",
            method.keyword()
        ));
    }
    if is_newmark
        && matches!(
            given.formulation,
            Some(IndexReduction::Si1 | IndexReduction::Si2)
        )
    {
        notes.push(format!(
            "{} has position constraints only (I3)",
            method.keyword()
        ));
    }
    let default_error = match method {
        _ if integrator.is_none() => OWN_ERROR,
        IntegratorMethod::Hht | IntegratorMethod::Newmark => 1e-5,
        _ => 1e-3,
    };
    let highest_order = given.kmax.unwrap_or(6).clamp(1, HIGHEST_ORDER);
    if let Some(kmax) = given
        .kmax
        .filter(|kmax| *kmax > HIGHEST_ORDER && !is_newmark)
    {
        notes.push(format!("KMAX={kmax}: the highest order is {HIGHEST_ORDER}"));
    }
    let longest_step = given.hmax.unwrap_or(output_step);
    let longest_step = kinematics
        .and_then(|kinematics| kinematics.hmax)
        .map_or(longest_step, |hmax| hmax.min(longest_step));
    notes.extend(not_honoured(
        "INTEGRATOR",
        &[
            ("HRATIO", given.hratio.is_some()),
            ("FIXIT", given.fixit.is_some()),
            ("PATTERN", given.pattern.is_some()),
            ("CORRECTOR", given.corrector.is_some()),
            ("INTERPOLATE", given.interpolate.is_some()),
            ("ADAPTIVITY", given.adaptivity.is_some()),
            (
                "ALPHA",
                given.alpha.is_some() && method != IntegratorMethod::Hht,
            ),
            (
                "BETA",
                given.beta.is_some() && method != IntegratorMethod::Newmark,
            ),
            (
                "GAMMA",
                given.gamma.is_some() && method != IntegratorMethod::Newmark,
            ),
        ],
    ));
    let settings = Settings {
        formulation,
        error: error.or(given.error).unwrap_or(default_error),
        highest_order: highest_order as usize,
        longest_step,
        // Adams' 1e-6 HMAX would keep long output steps from resolving a stick.
        shortest_step: given
            .hmin
            .unwrap_or((1e-6 * longest_step).min(SHORTEST * second)),
        first_step: given.hinit,
        newton_iterations: given.maxit.unwrap_or(10) as usize,
    };
    Choice { settings, notes }
}

/// A coefficient of the integrator, brought into its range with a note where it is outside.
fn in_range(
    given: Option<f64>,
    default: f64,
    [least, most]: [f64; 2],
    keyword: &str,
    notes: &mut Vec<String>,
) -> f64 {
    let value = given.unwrap_or(default);
    let used = value.clamp(least, most);
    if used != value {
        notes.push(format!(
            "{keyword}={value} is outside of {least:.4} to {most}: {used:.4} is used"
        ));
    }
    used
}

/// What to tell about the arguments of a statement that are given and do nothing.
fn not_honoured(statement: &str, arguments: &[(&str, bool)]) -> Option<String> {
    let given = arguments.iter().filter(|(_, given)| *given);
    let names: Vec<&str> = given.map(|(name, _)| *name).collect();
    let list = || format!("{statement}: without effect here: {}", names.join(", "));
    (!names.is_empty()).then(list)
}

/// How an equilibrium is found, and what to tell about it.
///
/// Defaults are those of Adams: ERROR 1e-4, IMBALANCE 1e-4, STABILITY 1e-5, MAXIT 25, ALIMIT 10
/// degrees, TLIMIT 20 units of length.
pub(crate) fn equilibrium(given: Option<&Equilibrium>) -> (EquilibriumSettings, Option<String>) {
    let fallback = Equilibrium::default();
    let given = given.unwrap_or(&fallback);
    let notes = not_honoured(
        "EQUILIBRIUM",
        &[
            ("PATTERN", given.pattern.is_some()),
            ("METHOD", given.method.is_some()),
            ("ATOL", given.atol.is_some()),
            ("RTOL", given.rtol.is_some()),
            ("MAXITL", given.maxitl.is_some()),
        ],
    );
    let settings = EquilibriumSettings {
        error: given.error.unwrap_or(1e-4),
        imbalance: given.imbalance.unwrap_or(1e-4),
        stability: given.stability.unwrap_or(1e-5),
        iterations: given.maxit.unwrap_or(25) as usize,
        angle_limit: given.alimit.unwrap_or(10.0_f64.to_radians()),
        translation_limit: given.tlimit.unwrap_or(20.0),
    };
    (settings, notes)
}

/// End of a simulation and the time between its outputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TimeSpan {
    pub(crate) end: f64,
    /// Time between two outputs (the last interval may be shorter).
    pub(crate) step: f64,
    /// Number of outputs after the start.
    count: usize,
    /// Whether the SIMULATE says how many outputs it wants.
    pub(crate) is_given: bool,
}

/// Why a SIMULATE cannot be carried out at a time.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub(crate) enum SpanError {
    /// Its end is over.
    #[error("END = {end} is not after the time reached so far, {start}")]
    Past { end: f64, start: f64 },
    /// So many outputs.
    #[error("{0:.3e} outputs are too many: at most {MOST_OUTPUTS:e} are written")]
    Outputs(f64),
}

impl SpanError {
    /// The code of its message.
    pub(crate) const fn code(self) -> Code {
        match self {
            Self::Past { .. } => Code::OutOfRange,
            Self::Outputs(_) => Code::InvalidValue,
        }
    }

    /// What to write instead.
    pub(crate) const fn help(self) -> &'static str {
        match self {
            Self::Past { .. } => "END is a time; DURATION is the length of a simulation",
            Self::Outputs(_) => "write a longer DTOUT",
        }
    }
}

/// The time span of a SIMULATE that starts at `start`; `None` for one that takes no time.
///
/// # Errors
/// What is wrong with it.
pub(crate) fn span(simulate: &Simulate, start: f64) -> Result<Option<TimeSpan>, SpanError> {
    let end = match (simulate.end, simulate.duration) {
        (Some(end), _) => end,
        (None, Some(duration)) => start + duration,
        (None, None) => return Ok(None),
    };
    if !(end > start) {
        return Err(SpanError::Past { end, start });
    }
    let (step, is_given) = match (simulate.steps, simulate.dtout) {
        (_, Some(dtout)) => (dtout.min(end - start), true),
        (Some(steps), None) => ((end - start) / f64::from(steps), true),
        (None, None) => ((end - start) / f64::from(DEFAULT_STEPS), false),
    };
    // An interval that is whole but for rounding is not split.
    let count = ((end - start) / step - 1e-9).ceil().max(1.0);
    if !(count <= MOST_OUTPUTS) {
        return Err(SpanError::Outputs(count));
    }
    Ok(Some(TimeSpan {
        end,
        step,
        count: count as usize,
        is_given,
    }))
}

impl TimeSpan {
    /// Output times `start + k·step`, rising, the last exactly the end; those after the first
    /// `taken`.
    pub(crate) fn outputs(&self, start: f64, taken: usize) -> impl Iterator<Item = f64> + use<> {
        let (step, end, count) = (self.step, self.end, self.count);
        let time = move |k| {
            if k < count {
                start + k as f64 * step
            } else {
                end
            }
        };
        (taken + 1..=count).map(time)
    }

    /// What to tell about it.
    pub(crate) fn note(&self) -> Option<String> {
        let note = || format!("neither STEPS nor DTOUT is given: STEPS={DEFAULT_STEPS} is used");
        (!self.is_given).then(note)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dataset::SimulationKind;

    fn simulate(end: f64, steps: Option<u32>, dtout: Option<f64>) -> Simulate {
        Simulate {
            kind: SimulationKind::Dynamic,
            end: Some(end),
            duration: None,
            steps,
            dtout,
        }
    }

    #[test]
    fn the_last_output_is_the_end() {
        let times = |simulate: &Simulate, start| {
            span(simulate, start)
                .map(|span| span.map_or(Vec::new(), |span| span.outputs(start, 0).collect()))
        };
        assert_eq!(
            times(&simulate(0.25, None, Some(0.1)), 0.0).unwrap(),
            [0.1, 0.2, 0.25]
        );
        assert_eq!(
            times(&simulate(0.3, None, Some(0.1)), 0.0).unwrap(),
            [0.1, 0.2, 0.3]
        );
        assert_eq!(
            times(&simulate(2.0, Some(4), None), 1.0).unwrap(),
            [1.25, 1.5, 1.75, 2.0]
        );
        assert!(times(&simulate(1.0, Some(4), None), 1.0).is_err());
        assert!(times(&simulate(1.0, None, Some(1e-12)), 0.0).is_err());
        let lasting = Simulate {
            end: None,
            duration: Some(1.0),
            ..simulate(0.0, Some(2), None)
        };
        assert_eq!(times(&lasting, 5.0).unwrap(), [5.5, 6.0]);
    }

    #[test]
    fn settings_follow_the_statement_and_its_defaults() {
        let own = choose(None, None, 0.01, None, 1.0);
        assert_eq!(own.settings.formulation, Formulation::Si2);
        assert_eq!(own.settings.error, 1e-6);
        assert_eq!(own.settings.longest_step, 0.01);
        assert_eq!(own.notes.len(), 1);
        let given = Integrator {
            method: Some(IntegratorMethod::Hht),
            kmax: Some(6),
            hmin: Some(1e-9),
            pattern: Some(vec![true]),
            ..Integrator::default()
        };
        let chosen = choose(Some(&given), None, 0.01, None, 1.0);
        assert_eq!(
            chosen.settings.formulation,
            Formulation::Hht { alpha: -0.3 }
        );
        assert_eq!(chosen.settings.error, 1e-5);
        assert_eq!(chosen.settings.shortest_step, 1e-9);
        assert_eq!(chosen.notes.len(), 1);
        let newmark = Integrator {
            method: Some(IntegratorMethod::Newmark),
            gamma: Some(0.6),
            ..Integrator::default()
        };
        let newmark = choose(Some(&newmark), None, 0.01, None, 1.0);
        let formulation = Formulation::Newmark {
            beta: 0.36,
            gamma: 0.6,
        };
        assert_eq!(newmark.settings.formulation, formulation);
        assert_eq!(newmark.notes, Vec::<String>::new());
        assert_eq!(
            choose(Some(&given), None, 0.01, Some(1e-4), 1.0)
                .settings
                .error,
            1e-4
        );
    }

    #[test]
    fn equilibria_follow_the_statement_and_its_defaults() {
        let (settings, note) = equilibrium(None);
        assert_eq!((settings.iterations, note), (25, None));
        assert_eq!((settings.error, settings.imbalance), (1e-4, 1e-4));
        let given = Equilibrium {
            stability: Some(0.0),
            alimit: Some(0.5),
            method: Some("AGGRESSIVE".to_owned()),
            ..Equilibrium::default()
        };
        let (settings, note) = equilibrium(Some(&given));
        assert_eq!((settings.stability, settings.angle_limit), (0.0, 0.5));
        assert!(note.unwrap().contains("METHOD"));
    }
}
