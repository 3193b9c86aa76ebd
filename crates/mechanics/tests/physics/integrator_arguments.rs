//! Every argument of an integrator does what it says: tests that fail where one is ignored.
//!
//! Counts of steps are compared with one another, not with numbers: another error test gives others.

use mechanics::model::Model;
use mechanics::{
    Cause, Corrector, Ending, Formulation, Observer, Pattern, RunError, Settings, Snapshot,
    Statistics, StepReport,
};
use mechanisms::pendulum;

use crate::runs::{assembled, every, settings};

const END: f64 = 1.0;
const OUTPUTS: usize = 7;

/// What a run of the pendulum did.
struct Ran {
    steps: Vec<StepReport>,
    statistics: Statistics,
    /// Place at the end.
    place: [f64; 2],
    ending: Result<Ending, RunError>,
}

#[derive(Default)]
struct Steps(Vec<StepReport>);

impl Observer for Steps {
    fn step(&mut self, report: &StepReport) -> bool {
        self.0.push(*report);
        true
    }

    fn output(&mut self, _: &Snapshot<'_>) -> bool {
        true
    }
}

fn ran(model: Model, settings: &Settings) -> Ran {
    let mut simulation = assembled(model);
    let mut steps = Steps::default();
    let ending = simulation.run(END, every(END, OUTPUTS), settings, &mut steps);
    let centre = simulation.state().centre(0);
    Ran {
        steps: steps.0,
        statistics: simulation.statistics(),
        place: [centre.x, centre.y],
        ending,
    }
}

/// Runs the pendulum with settings that differ from these as `change` says.
fn with(formulation: Formulation, error: f64, change: impl FnOnce(&mut Settings)) -> Ran {
    let mut settings = settings(formulation, error, 0.1);
    change(&mut settings);
    ran(pendulum(), &settings)
}

fn completed(run: &Ran) {
    assert_eq!(run.ending, Ok(Ending::Completed));
}

const ALL: [Formulation; 5] = [
    Formulation::Si2,
    Formulation::I3,
    Formulation::Adams,
    Formulation::Hht { alpha: -0.3 },
    Formulation::Newmark {
        beta: 0.36,
        gamma: 0.7,
    },
];

#[test]
fn the_first_step_is_the_one_given_and_none_is_longer_than_the_longest() {
    for formulation in ALL {
        let run = with(formulation, 1e-3, |settings| {
            settings.first_step = Some(1.5e-5);
            settings.longest_step = 3e-3;
        });
        completed(&run);
        assert_eq!(run.steps[0].size, 1.5e-5, "{formulation:?}");
        let longest = run.steps.iter().fold(0.0_f64, |most, s| most.max(s.size));
        // The steps at the end are made to fit.
        assert!((2e-3..=3e-3).contains(&longest), "{longest}");
        let free = with(formulation, 1e-3, |_| {});
        assert!(free.statistics.steps.steps < run.statistics.steps.steps);
    }
}

#[test]
fn no_step_is_shorter_than_the_shortest_and_with_it_the_run_gives_up() {
    for formulation in ALL {
        let free = with(formulation, 1e-7, |_| {});
        let shortest = |run: &Ran| run.steps.iter().fold(1.0_f64, |least, s| least.min(s.size));
        let natural = shortest(&free);
        let run = with(formulation, 1e-7, |settings| {
            settings.shortest_step = 4.0 * natural;
            // Steps that fit the end are no shorter than these.
            settings.longest_step = 0.1;
        });
        let fitted = run.steps.iter().filter(|step| step.time < 0.8);
        for step in fitted {
            assert!(step.size >= 4.0 * natural * (1.0 - 1e-9), "{step:?}");
        }
        let refused = with(formulation, 1e-9, |settings| {
            settings.shortest_step = 0.05;
        });
        let cause = refused.ending.unwrap_err().cause;
        assert_eq!(cause, Cause::Inaccurate, "{formulation:?}");
    }
}

#[test]
fn orders_are_bounded() {
    for (formulation, most) in [
        (Formulation::Si2, 5),
        (Formulation::I3, 5),
        (Formulation::Adams, 12),
    ] {
        let highest = |order| {
            let run = with(formulation, 1e-8, |settings| {
                settings.highest_order = order;
            });
            completed(&run);
            run.steps.iter().fold(0, |most, step| most.max(step.order))
        };
        assert_eq!([1, 2, 3].map(highest), [1, 2, 3], "{formulation:?}");
        assert!((4..=most).contains(&highest(12)), "{formulation:?}");
    }
}

#[test]
fn iterations_are_bounded() {
    for formulation in ALL {
        // One correction says nothing about convergence.
        let run = with(formulation, 1e-6, |settings| {
            settings.corrector.iterations = Some(1);
        });
        let cause = run.ending.unwrap_err().cause;
        assert_eq!(cause, Cause::NotConverged, "{formulation:?}");
        let run = with(formulation, 1e-6, |settings| {
            settings.corrector.iterations = Some(4);
        });
        completed(&run);
    }
}

#[test]
fn matrices_are_new_where_the_pattern_says_so() {
    for formulation in ALL {
        let work = |pattern: &[bool]| {
            let run = with(formulation, 1e-6, |settings| {
                settings.corrector.pattern = Pattern::new(pattern);
            });
            completed(&run);
            (run.statistics.work, run.statistics.steps.steps)
        };
        let (always, _) = work(&[true]);
        assert_eq!(always.factorisations, always.residuals, "{formulation:?}");
        let (first, steps) = work(&[true, false, false, false, false]);
        assert!(first.factorisations >= steps, "{formulation:?} {first:?}");
        assert!(first.factorisations < first.residuals, "{formulation:?}");
        // A kept matrix that does not fit any more is renewed all the same.
        let (seldom, steps) = work(&[false]);
        assert!(
            seldom.factorisations < steps / 2,
            "{formulation:?} {seldom:?}"
        );
    }
    assert_eq!(Pattern::new(&[]), None);
    assert_eq!(Pattern::new(&[true; 65]), None);
}

#[test]
fn all_unknowns_converge_where_the_corrector_tests_them() {
    for formulation in ALL {
        for error in [1e-4, 1e-8] {
            if matches!(formulation, Formulation::Newmark { .. }) && error < 1e-6 {
                // Of first order: too many steps for a test.
                continue;
            }
            let of = |tests_all| {
                let run = with(formulation, error, |settings| {
                    settings.corrector.tests_all = tests_all;
                });
                completed(&run);
                run
            };
            let (modified, original) = (of(false), of(true));
            let [few, many] = [&modified, &original].map(|run| {
                run.statistics.work.residuals as f64 / run.statistics.steps.steps as f64
            });
            // Positions that have converged to a loose error hold reactions of the same, too, where
            // those follow from them; the steps are others.
            let more = many > few || (many > 0.9 * few && error > 1e-6);
            assert!(more, "{formulation:?} {error:e}: {few} {many}");
            assert_eq!(original.statistics.steps.failures, 0, "{formulation:?}");
            for k in 0..2 {
                let moved = (original.place[k] - modified.place[k]).abs();
                // Both are as accurate as their error tests: a few steps' worth apart.
                assert!(
                    moved < 100.0 * error,
                    "{formulation:?} {error:e}: {moved:e}"
                );
            }
        }
    }
}

#[test]
fn adaptivity_loosens_the_corrector_up_to_its_bound() {
    for formulation in [Formulation::Si2, Formulation::I3] {
        let [tight, loose] = [0.0, 1e-2].map(|adaptivity| {
            let run = with(formulation, 1e-6, |settings| {
                settings.corrector.adaptivity = adaptivity;
            });
            completed(&run);
            run
        });
        let residuals = [&tight, &loose]
            .map(|run| run.statistics.work.residuals as f64 / run.statistics.steps.steps as f64);
        assert!(residuals[1] < residuals[0], "{formulation:?} {residuals:?}");
        let moved = (tight.place[0] - loose.place[0]).abs();
        assert!(moved < 1e-4, "{formulation:?} {moved:e}");
    }
}

#[test]
fn steps_end_at_outputs_that_are_not_interpolated() {
    for formulation in ALL {
        let ends = |interpolates| {
            let run = with(formulation, 1e-6, |settings| {
                settings.interpolates = interpolates;
            });
            completed(&run);
            let times = every(END, OUTPUTS);
            let met = |time: &&f64| run.steps.iter().any(|step| step.time == **time);
            times.iter().filter(met).count()
        };
        assert_eq!(ends(false), OUTPUTS, "{formulation:?}");
        assert!(ends(true) < OUTPUTS, "{formulation:?}");
    }
}

#[test]
fn fixed_steps_have_one_length_and_the_same_work() {
    let exact = with(Formulation::Si2, 1e-10, |_| {}).place;
    for formulation in ALL {
        let size = END / (4 * OUTPUTS) as f64;
        let run = with(formulation, 1e-12, |settings| {
            settings.longest_step = size;
            settings.shortest_step = size;
            settings.first_step = Some(size);
            settings.interpolates = false;
            settings.corrector = Corrector {
                fixed: Some(3),
                ..Corrector::default()
            };
        });
        completed(&run);
        assert_eq!(run.steps.len(), 4 * OUTPUTS);
        for step in &run.steps {
            assert!((step.size - size).abs() < 1e-12, "{formulation:?} {step:?}");
        }
        assert_eq!(run.statistics.work.residuals, 3 * run.steps.len());
        // Second order or better: (3 radians a second · h)² is 1e-2.
        let moved = (run.place[0] - exact[0]).abs();
        assert!(moved < 0.05, "{formulation:?} {moved:e}");
    }
}
