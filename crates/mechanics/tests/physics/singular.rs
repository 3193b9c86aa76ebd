//! Mechanisms that pass or start in positions where constraints depend on others for an instant.

use mechanics::model::Model;
use mechanics::{
    Ending, Formulation, Observer, Settings, Simulation, Snapshot, StepReport, gravity_energy,
    kinetic_energy,
};
use mechanisms::builder::{Builder, v};
use nalgebra::Vector3;

use crate::runs::{assembled, every, settings};

/// Largest change of energy at the outputs, and the first redundant equation that did not hold.
struct Watch {
    first: f64,
    change: f64,
    broken: Option<String>,
}

fn energy(s: &Snapshot<'_>) -> f64 {
    kinetic_energy(s.model(), s.state()) + gravity_energy(s.model(), s.state())
}

impl Observer for Watch {
    fn step(&mut self, _: &StepReport) -> bool {
        true
    }

    fn output(&mut self, snapshot: &Snapshot<'_>) -> bool {
        self.change = self.change.max((energy(snapshot) - self.first).abs());
        if self.broken.is_none() {
            self.broken = snapshot.broken(1e-4, 1.0).next().map(|u| u.to_string());
        }
        true
    }
}

/// Runs a model with I3 and SI2 at ERROR 1e-2 to 1e-9, to the end each time; where rounding keeps I3 from
/// a tolerance of 1e-9 it says which part does not find its place.
fn at_all_errors(name: &str, model: &Model, end: f64, look: impl Fn(&Watch, f64)) {
    for formulation in [Formulation::Si2, Formulation::I3] {
        for power in 2..=9 {
            let error = 10f64.powi(-power);
            let mut simulation = Simulation::new(model.clone(), 1.0);
            simulation.assemble().expect("it assembles");
            simulation.solve_instant().expect("it has reactions");
            let mut watch = Watch {
                first: energy(&simulation.snapshot()),
                change: 0.0,
                broken: None,
            };
            let settings = settings(formulation, error, 0.02 * end);
            let ending = simulation.run(end, every(end, 100), &settings, &mut watch);
            let steps = simulation.statistics().steps.steps;
            println!(
                "{name}, {formulation:?}, {error:.0e}: {ending:?}, {steps} steps, energy {:.1e}, {:?}",
                watch.change, watch.broken
            );
            match ending {
                Err(error) if formulation == Formulation::I3 && power == 9 => {
                    let element = error.element.expect("a part is named");
                    assert_eq!(element.statement, "PART");
                }
                ending => assert_eq!(
                    ending,
                    Ok(Ending::Completed),
                    "{name} {formulation:?} {error:e}"
                ),
            }
            look(&watch, error);
        }
    }
}

/// Runs a model that keeps its energy of the size `unit`.
fn passes(name: &str, model: &Model, end: f64, unit: f64) {
    at_all_errors(name, model, end, |watch, error| {
        // Some 2,000 steps, each with an error of ERROR in the velocities, twice that in the energy; a
        // loose one is to leave at least the size of the energy.
        let bound = unit * (4000.0 * error).min(1.0);
        assert!(
            watch.change <= bound,
            "{name} {error:e}: {:e}",
            watch.change
        );
        assert_eq!(watch.broken, None);
    });
}

#[test]
fn bricard_keeps_its_energy_at_every_error() {
    passes("Bricard", &mechanisms::bricard(), 10.0, 30.0);
}

#[test]
fn rows_of_four_bars_pass_their_singular_positions_at_every_error() {
    // Kinetic energy at first, and of the weights.
    for (loops, unit) in [(1, 20.0), (2, 36.0), (5, 82.0)] {
        let name = format!("{loops} four-bars");
        passes(&name, &mechanisms::four_bar_chain(loops), 10.0, unit);
    }
}

/// A crank of 1, a coupler of 1.5 and a rocker of 2 m on a base of 2.5 m: stretched once a turn, as
/// `1.5 + 2 = 1 + 2.5`. The crank stands upright at first.
fn change_point() -> Model {
    let mut b = Builder::new(v(0.0, -9.81, 0.0));
    let (knee, base) = (Vector3::y(), v(2.5, 0.0, 0.0));
    // The corner above the line from knee to base.
    let span = base - knee;
    let along = (span.norm_squared() + 1.5 * 1.5 - 2.0 * 2.0) / (2.0 * span.norm());
    let aside = (1.5 * 1.5 - along * along).sqrt();
    let unit = span.normalize();
    let tip = knee + along * unit + aside * Vector3::z().cross(&unit);
    let crank = b.rod(1.0, Vector3::zeros(), knee);
    let coupler = b.rod(1.5, knee, tip);
    let rocker = b.rod(2.0, tip, base);
    let drive = b.pin(Some(crank), None, Vector3::zeros());
    b.pin(Some(coupler), Some(crank), knee);
    b.pin(Some(rocker), Some(coupler), tip);
    b.pin(Some(rocker), None, base);
    b.start_turning(drive, 8.0);
    b.model
}

#[test]
fn a_change_point_four_bar_passes_at_every_error() {
    passes("change point", &change_point(), 3.0, 60.0);
}

#[test]
fn a_four_bar_that_starts_in_line_says_which_equation_it_lost() {
    // Crank, coupler, rocker and base of 1 m in line: two ways lead on, and nothing says which.
    let mut b = Builder::new(v(0.0, -9.81, 0.0));
    let points = [0.0, 1.0, 2.0].map(|x| v(x, 0.0, 0.0));
    let crank = b.rod(1.0, points[0], points[1]);
    let coupler = b.rod(1.0, points[1], points[2]);
    let rocker = b.rod(1.0, points[2], points[1]);
    let drive = b.pin(Some(crank), None, points[0]);
    b.pin(Some(coupler), Some(crank), points[1]);
    b.pin(Some(rocker), Some(coupler), points[2]);
    b.pin(Some(rocker), None, points[1]);
    b.start_turning(drive, -7.0);
    let assembly = Simulation::new(b.model.clone(), 1.0).assemble();
    // One more than in other positions.
    assert_eq!(assembly.expect("it assembles").redundant.len(), 4);
    at_all_errors("in line", &b.model, 1.0, |watch, _| {
        let broken = watch.broken.as_deref();
        assert!(
            broken.is_some_and(|text| text.starts_with("JOINT/4")),
            "{broken:?}"
        );
    });
}

#[test]
fn adams_hands_over_to_index_three_and_takes_over_again() {
    // The shortest step is longer than Adams needs: at first, and where the mechanism is stretched.
    for (loops, unit) in [(1, 20.0), (5, 82.0)] {
        let (error, shortest_step) = (5e-7, 1e-4);
        let name = format!("{loops} four-bars");
        let settings = Settings {
            highest_order: 12,
            shortest_step,
            ..settings(Formulation::Adams, error, 0.06)
        };
        let mut simulation = assembled(mechanisms::four_bar_chain(loops));
        let mut watch = Watch {
            first: energy(&simulation.snapshot()),
            change: 0.0,
            broken: None,
        };
        let ending = simulation.run(3.0, every(3.0, 100), &settings, &mut watch);
        assert_eq!(ending, Ok(Ending::Completed), "{name}");
        let statistics = simulation.statistics();
        let crossing = statistics.work.index3_steps;
        println!(
            "{name}: {crossing} steps of I3, energy {:.1e}",
            watch.change
        );
        // Every hand-over is ten steps of I3 between two starts.
        assert!(crossing >= 10 && statistics.steps.starts == 1 + 2 * crossing / 10);
        // A tenth of ERROR a step in velocities is twice that in the energy.
        let bound = 0.2 * statistics.steps.steps as f64 * error * unit;
        assert!(watch.change <= bound, "{name}: {:e}", watch.change);
    }
}

/// The shortest step of a run but for its beginning.
struct Shortest(f64);

impl Observer for Shortest {
    fn step(&mut self, report: &StepReport) -> bool {
        if report.time > 0.1 {
            self.0 = self.0.min(report.size);
        }
        true
    }

    fn output(&mut self, _: &Snapshot<'_>) -> bool {
        true
    }
}

/// Rods that come into line magnify what equations in axes on different bodies (here of one joint of each
/// loop) make of the errors of a step, if anything is left of them: steps of 2e-8 s were what that took.
#[test]
fn rods_in_line_take_no_short_steps() {
    for formulation in [Formulation::Adams, Formulation::Si2] {
        let settings = Settings {
            highest_order: 12,
            ..settings(formulation, 1e-6, 0.2)
        };
        let mut simulation = assembled(mechanisms::four_bar_chain(40));
        let mut shortest = Shortest(f64::INFINITY);
        let ending = simulation.run(2.0, [2.0], &settings, &mut shortest);
        assert_eq!(ending, Ok(Ending::Completed));
        // Steps are of 5e-3 (SI2) and 2e-2 s.
        assert!(shortest.0 > 1e-3, "{formulation:?}: {:e}", shortest.0);
    }
}
