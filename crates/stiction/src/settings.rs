//! INTEGRATOR and EQUILIBRIUM to settings; what does not do what it says is told.

use dataset::{Corrector, Equilibrium, IndexReduction, Integrator, IntegratorMethod, Kinematics};
use mechanics::{EquilibriumSettings, Formulation, Pattern, Settings};

use crate::session::RunOptions;

/// Error tolerance without an INTEGRATOR statement.
const OWN_ERROR: f64 = 1e-6;
/// Shortest step where HMIN is not given and that of Adams would be longer, seconds.
const SHORTEST: f64 = 1e-9;
/// ALPHA of HHT, BETA and GAMMA of NEWMARK where they are not given (statement page of INTEGRATOR).
const HHT_ALPHA: f64 = -0.3;
const NEWMARK_BETA: f64 = 0.36;
const NEWMARK_GAMMA: f64 = 0.7;
/// Where HHT and Newmark's method are stable: with less, the steps of position constraints swing up.
const ALPHAS: [f64; 2] = [-1.0 / 3.0, 0.0];
const BETAS: [f64; 2] = [0.25, 1.0];
const GAMMAS: [f64; 2] = [0.5, 1.0];
/// How a simulation is integrated, and what to tell about it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Choice {
    pub(crate) settings: Settings,
    /// What differs from what the dataset says or leaves open.
    pub(crate) notes: Vec<String>,
}

/// Settings of a simulation with outputs every `output_step`; `method` and `error` override those of
/// the statement, and HMAX of `kinematics`, where it is kinematic, limits the step, too.
///
/// Defaults are those of Adams (I3, error 1e-3, HMAX of one output step, KMAX 6), except
/// that without any INTEGRATOR statement it is SI2 with error 1e-6, that HMIN is a nanosecond
/// where 1e-6 HMAX is longer, and what docs/integrators.md says of HINIT, MAXIT, PATTERN,
/// CORRECTOR and INTERPOLATE. `second` is one second in the unit of time.
pub(crate) fn choose(
    integrator: Option<&Integrator>,
    kinematics: Option<&Kinematics>,
    output_step: f64,
    options: &RunOptions,
    second: f64,
) -> Choice {
    let mut notes = Vec::new();
    let fallback = Integrator::default();
    let given = integrator.unwrap_or(&fallback);
    // Another method does not change the error.
    let default_error = match given.method {
        _ if integrator.is_none() => OWN_ERROR,
        Some(IntegratorMethod::Hht | IntegratorMethod::Newmark) => 1e-5,
        _ => 1e-3,
    };
    let error = options.error.or(given.error).unwrap_or(default_error);
    let (method, index) = match options.method {
        Some(method) => {
            notes.push(format!(
                "the integrator is {}, whatever the model says",
                method.name()
            ));
            method.arguments()
        }
        None => (
            given.method.unwrap_or(IntegratorMethod::Gstiff),
            given.formulation,
        ),
    };
    if integrator.is_none() {
        let used = match options.method {
            None => "stabilised index 2 (SI2) with ",
            Some(_) => "",
        };
        notes.push(format!(
            "no INTEGRATOR statement: {used}error {error:e} is used"
        ));
    }
    let formulation = match method {
        IntegratorMethod::Hht => Formulation::Hht {
            alpha: in_range(given.alpha, HHT_ALPHA, ALPHAS, "ALPHA", &mut notes),
        },
        IntegratorMethod::Newmark => Formulation::Newmark {
            beta: in_range(given.beta, NEWMARK_BETA, BETAS, "BETA", &mut notes),
            gamma: in_range(given.gamma, NEWMARK_GAMMA, GAMMAS, "GAMMA", &mut notes),
        },
        IntegratorMethod::Abam => Formulation::Adams,
        IntegratorMethod::Gstiff | IntegratorMethod::Wstiff | IntegratorMethod::Hastiff => {
            match index {
                None if integrator.is_none() => Formulation::Si2,
                None | Some(IndexReduction::I3) => Formulation::I3,
                Some(IndexReduction::Si2) => Formulation::Si2,
                Some(IndexReduction::Si1) => {
                    notes.push("SI1 is not available: SI2 is used".to_owned());
                    Formulation::Si2
                }
            }
        }
    };
    if matches!(method, IntegratorMethod::Wstiff | IntegratorMethod::Hastiff) {
        notes.push(format!(
            "{} is not available: backward differences of variable order (as GSTIFF) are used",
            method.keyword()
        ));
    }
    match formulation {
        Formulation::I3 | Formulation::Si2 => {}
        Formulation::Adams => notes.extend(index.map(|_| {
            "I3, SI2 and SI1 are not of ABAM, which solves accelerations and brings every step back \
             onto the constraints"
                .to_owned()
        })),
        Formulation::Hht { .. } | Formulation::Newmark { .. } => {
            if matches!(index, Some(IndexReduction::Si1 | IndexReduction::Si2)) {
                notes.push(format!(
                    "{} has position constraints only (I3)",
                    method.keyword()
                ));
            }
        }
    }
    let of_another = [
        ("ALPHA", given.alpha, IntegratorMethod::Hht),
        ("BETA", given.beta, IntegratorMethod::Newmark),
        ("GAMMA", given.gamma, IntegratorMethod::Newmark),
    ];
    for (name, _, of) in of_another
        .into_iter()
        .filter(|(_, value, of)| value.is_some() && *of != method)
    {
        notes.push(format!("{name} is of {} only", of.keyword()));
    }
    let longest_step = given.hmax.unwrap_or(output_step);
    let longest_step = kinematics
        .and_then(|kinematics| kinematics.hmax)
        .map_or(longest_step, |hmax| hmax.min(longest_step));
    let mut settings = Settings {
        formulation,
        error,
        highest_order: highest_order(given.kmax, formulation, &mut notes),
        longest_step,
        // Adams' 1e-6 HMAX would keep long output steps from resolving a stick.
        shortest_step: given
            .hmin
            .unwrap_or((1e-6 * longest_step).min(SHORTEST * second)),
        first_step: given.hinit,
        corrector: corrector(given, formulation, &mut notes),
        interpolates: given.interpolate.unwrap_or(true),
    };
    if let Some(iterations) = settings.corrector.fixed {
        let size = output_step / given.hratio.unwrap_or(1.0).round().max(1.0);
        notes.push(format!(
            "FIXIT: steps of {size:e} with {iterations} iterations each; neither ERROR nor \
             convergence is tested"
        ));
        settings.longest_step = size;
        settings.shortest_step = size;
        settings.first_step = Some(size);
        settings.interpolates = false;
    } else if given.hratio.is_some() {
        notes.push(
            "HRATIO, the number of steps of an output step, is of steps of fixed length (FIXIT) only"
                .to_owned(),
        );
    }
    Choice { settings, notes }
}

/// KMAX: six of Adams is the most that backward differentiation has, five, and twelve that of the
/// formulas of Adams and Moulton.
fn highest_order(kmax: Option<u32>, formulation: Formulation, notes: &mut Vec<String>) -> usize {
    let most = match formulation {
        Formulation::I3 | Formulation::Si2 => 5,
        Formulation::Adams => 12,
        // They have but one.
        Formulation::Hht { .. } | Formulation::Newmark { .. } => return 2,
    };
    let kmax = kmax.map(|kmax| kmax as usize);
    if let Some(kmax) = kmax.filter(|kmax| *kmax > most) {
        notes.push(format!("KMAX={kmax}: the highest order is {most}"));
    }
    kmax.unwrap_or(most).clamp(1, most)
}

/// MAXIT, FIXIT, PATTERN, CORRECTOR and ADAPTIVITY.
fn corrector(
    given: &Integrator,
    formulation: Formulation,
    notes: &mut Vec<String>,
) -> mechanics::Corrector {
    let count = |count: Option<u32>| count.map(|count| count as usize);
    if given.adaptivity.is_some() && !matches!(formulation, Formulation::I3 | Formulation::Si2) {
        notes.push("ADAPTIVITY is of backward differentiation (GSTIFF) only".to_owned());
    }
    let pattern = given.pattern.as_deref();
    if let Some(pattern) = pattern.filter(|pattern| pattern.len() > Pattern::LONGEST) {
        notes.push(format!(
            "PATTERN of {} iterations: at most {} are read, and it is left out",
            pattern.len(),
            Pattern::LONGEST
        ));
    }
    mechanics::Corrector {
        iterations: count(given.maxit),
        fixed: count(given.fixit),
        pattern: pattern.and_then(Pattern::new),
        tests_all: given.corrector == Some(Corrector::Original),
        adaptivity: given.adaptivity.unwrap_or(0.0),
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::Method;

    /// Settings for outputs every hundredth of a second.
    fn chosen(integrator: Option<&Integrator>, options: RunOptions) -> Choice {
        choose(integrator, None, 0.01, &options, 1.0)
    }

    fn of(integrator: &Integrator) -> Choice {
        chosen(Some(integrator), RunOptions::default())
    }

    #[test]
    fn settings_follow_the_statement_and_its_defaults() {
        let own = chosen(None, RunOptions::default());
        assert_eq!(own.settings.formulation, Formulation::Si2);
        assert_eq!(
            (own.settings.error, own.settings.longest_step),
            (1e-6, 0.01)
        );
        assert_eq!(own.settings.corrector, mechanics::Corrector::default());
        assert!(own.settings.interpolates);
        assert_eq!(own.notes.len(), 1);
        let given = Integrator {
            method: Some(IntegratorMethod::Hht),
            kmax: Some(6),
            hmin: Some(1e-9),
            hmax: Some(0.02),
            hinit: Some(1e-4),
            maxit: Some(7),
            pattern: Some(vec![true, false]),
            corrector: Some(Corrector::Original),
            interpolate: Some(false),
            ..Integrator::default()
        };
        let Choice { settings, notes } = of(&given);
        assert_eq!(settings.formulation, Formulation::Hht { alpha: -0.3 });
        assert_eq!(settings.error, 1e-5);
        assert_eq!(
            (settings.shortest_step, settings.longest_step),
            (1e-9, 0.02)
        );
        assert_eq!(settings.first_step, Some(1e-4));
        let corrector = settings.corrector;
        assert_eq!(corrector.iterations, Some(7));
        assert_eq!(corrector.pattern, Pattern::new(&[true, false]));
        assert!(corrector.tests_all && !settings.interpolates);
        assert_eq!(notes, Vec::<String>::new());
        let newmark = of(&Integrator {
            method: Some(IntegratorMethod::Newmark),
            gamma: Some(0.6),
            ..Integrator::default()
        });
        let formulation = Formulation::Newmark {
            beta: 0.36,
            gamma: 0.6,
        };
        assert_eq!(newmark.settings.formulation, formulation);
        assert_eq!(newmark.notes, Vec::<String>::new());
        let finer = RunOptions {
            error: Some(1e-4),
            ..RunOptions::default()
        };
        assert_eq!(chosen(Some(&given), finer).settings.error, 1e-4);
    }

    #[test]
    fn another_method_leaves_the_error_as_it_is() {
        let of_method = |integrator: Option<&Integrator>, method| {
            let options = RunOptions {
                method: Some(method),
                ..RunOptions::default()
            };
            chosen(integrator, options).settings
        };
        let stiff = Integrator {
            formulation: Some(IndexReduction::Si2),
            ..Integrator::default()
        };
        for (integrator, error) in [(None, 1e-6), (Some(&stiff), 1e-3)] {
            let formulations = [
                Formulation::Si2,
                Formulation::I3,
                Formulation::Hht { alpha: -0.3 },
                Formulation::Newmark {
                    beta: 0.36,
                    gamma: 0.7,
                },
                Formulation::Adams,
            ];
            for (method, formulation) in Method::ALL.into_iter().zip(formulations) {
                let settings = of_method(integrator, method);
                assert_eq!((settings.formulation, settings.error), (formulation, error));
            }
        }
        let abam = Integrator {
            method: Some(IntegratorMethod::Abam),
            ..Integrator::default()
        };
        let abam = of(&abam);
        assert_eq!(abam.settings.formulation, Formulation::Adams);
        assert_eq!((abam.settings.highest_order, abam.notes.len()), (12, 0));
    }

    #[test]
    fn what_is_not_as_it_says_is_told() {
        let notes = |integrator: Integrator| of(&integrator).notes.join("; ");
        let given = |method| Integrator {
            method: Some(method),
            ..Integrator::default()
        };
        use IntegratorMethod as M;
        let told = notes(given(M::Wstiff));
        assert!(told.starts_with("WSTIFF is not available"), "{told}");
        let told = notes(Integrator {
            formulation: Some(IndexReduction::Si1),
            kmax: Some(6),
            hratio: Some(2.0),
            alpha: Some(-0.1),
            ..given(M::Gstiff)
        });
        for what in ["SI1", "KMAX=6", "HRATIO", "ALPHA is of HHT only"] {
            assert!(told.contains(what), "{told}");
        }
        let told = notes(Integrator {
            formulation: Some(IndexReduction::Si2),
            adaptivity: Some(1e-8),
            beta: Some(0.3),
            ..given(M::Abam)
        });
        for what in ["not of ABAM", "ADAPTIVITY", "BETA is of NEWMARK only"] {
            assert!(told.contains(what), "{told}");
        }
        let told = notes(Integrator {
            pattern: Some(vec![true; 65]),
            alpha: Some(-0.5),
            formulation: Some(IndexReduction::Si2),
            ..given(M::Hht)
        });
        for what in ["PATTERN of 65", "ALPHA=-0.5", "position constraints only"] {
            assert!(told.contains(what), "{told}");
        }
    }

    #[test]
    fn fixed_steps_divide_output_steps() {
        let fixed = Integrator {
            fixit: Some(3),
            hratio: Some(4.0),
            hmax: Some(1e-5),
            ..Integrator::default()
        };
        let Choice { settings, notes } = of(&fixed);
        let steps = [settings.shortest_step, settings.longest_step];
        assert_eq!((steps, settings.first_step), ([0.0025; 2], Some(0.0025)));
        assert_eq!(settings.corrector.fixed, Some(3));
        assert!(notes[0].contains("neither ERROR"), "{notes:?}");
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
