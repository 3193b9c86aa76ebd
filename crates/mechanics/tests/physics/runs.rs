//! Runs of a model, and what tests read from them.

use mechanics::model::Model;
use mechanics::{
    Corrector, Ending, Formulation, Observer, Settings, Simulation, Snapshot, StepReport,
    gravity_energy, kinetic_energy,
};
use nalgebra::Vector3;

/// Settings with the given error and the longest step.
pub(crate) fn settings(formulation: Formulation, error: f64, longest_step: f64) -> Settings {
    Settings {
        formulation,
        error,
        highest_order: 5,
        longest_step,
        shortest_step: 1e-13,
        first_step: None,
        corrector: Corrector::default(),
        interpolates: true,
    }
}

/// Calls a function at every output.
struct Outputs<F> {
    read: F,
}

impl<F: FnMut(&Snapshot<'_>)> Observer for Outputs<F> {
    fn step(&mut self, _: &StepReport) -> bool {
        true
    }

    fn output(&mut self, snapshot: &Snapshot<'_>) -> bool {
        (self.read)(snapshot);
        true
    }
}

/// An assembled simulation at its first instant.
pub(crate) fn assembled(model: Model) -> Simulation {
    let mut simulation = Simulation::new(model, 1.0);
    simulation.assemble().expect("the model assembles");
    simulation
        .solve_instant()
        .expect("the first instant has a solution");
    simulation
}

/// Assembles the model and runs it to the last of `outputs`, reading every output.
pub(crate) fn run(
    model: Model,
    outputs: &[f64],
    settings: &Settings,
    read: impl FnMut(&Snapshot<'_>),
) -> Simulation {
    let mut simulation = assembled(model);
    go_on(&mut simulation, outputs, settings, read);
    simulation
}

/// Runs an assembled simulation on to the last of `outputs`.
pub(crate) fn go_on(
    simulation: &mut Simulation,
    outputs: &[f64],
    settings: &Settings,
    read: impl FnMut(&Snapshot<'_>),
) {
    let end = *outputs.last().expect("there are outputs");
    let ending = simulation.run(end, outputs, settings, &mut Outputs { read });
    assert_eq!(
        ending.unwrap_or_else(|error| panic!("{error}")),
        Ending::Completed
    );
}

/// `count` equal intervals up to `end`.
pub(crate) fn every(end: f64, count: usize) -> Vec<f64> {
    (1..=count).map(|k| end * k as f64 / count as f64).collect()
}

/// Kinetic energy and energy of the weights.
pub(crate) fn energy(snapshot: &Snapshot<'_>) -> f64 {
    kinetic_energy(snapshot.model(), snapshot.state())
        + gravity_energy(snapshot.model(), snapshot.state())
}

/// Angular velocity of a body, ground axes.
pub(crate) fn angular_velocity(simulation: &Simulation, body: usize) -> Vector3<f64> {
    Vector3::from_column_slice(&simulation.state().velocities()[6 * body + 3..6 * body + 6])
}

/// Angle about z that a body has turned from its start, within half a turn.
pub(crate) fn turned(snapshot: &Snapshot<'_>, body: usize) -> f64 {
    let m = snapshot.rotation(body);
    m[(1, 0)].atan2(m[(0, 0)])
}

/// A coordinate at a time with its rate.
#[derive(Clone, Copy)]
pub(crate) struct Sample {
    pub(crate) time: f64,
    pub(crate) value: f64,
    pub(crate) rate: f64,
}

/// Extrema of a sampled coordinate, where its rate changes sign: time and value by the cubic
/// through values and rates.
pub(crate) fn turning_points(samples: &[Sample]) -> Vec<(f64, f64)> {
    let mut turns = Vec::new();
    for pair in samples.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        if a.rate * b.rate >= 0.0 {
            continue;
        }
        let h = b.time - a.time;
        let chord = (b.value - a.value) / h;
        // Rate of the cubic: a.rate + 2 c2 s + 3 c3 s², s in 0..h.
        let c2 = (3.0 * chord - 2.0 * a.rate - b.rate) / h;
        let c3 = (a.rate + b.rate - 2.0 * chord) / (h * h);
        let (mut low, mut high) = (0.0, h);
        for _ in 0..60 {
            let s = 0.5 * (low + high);
            let rate = a.rate + s * (2.0 * c2 + 3.0 * c3 * s);
            if rate * a.rate > 0.0 {
                low = s;
            } else {
                high = s;
            }
        }
        let s = low;
        turns.push((a.time + s, a.value + s * (a.rate + s * (c2 + c3 * s))));
    }
    turns
}
