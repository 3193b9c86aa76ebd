//! Steps allocate nothing: a run of twice the time allocates exactly as often.
//!
//! A binary of its own, because it counts with a global allocator.

use mechanics::model::{Model, Reactions};
use mechanics::{Corrector, Formulation, Observer, Settings, Simulation, Snapshot, StepReport};
use mechanisms::chains;

/// Rods that hang on hinges with friction of both formulations.
fn chain(rods: usize) -> Model {
    let mut chain = chains::chain(rods);
    chains::hinge_friction(&mut chain, |joint| match joint {
        1 => friction::LuGre {
            damping: 1.0,
            stribeck_velocity: 0.01,
            ..mechanisms::bristles(0.2, 0.15)
        }
        .into(),
        _ => mechanisms::law(0.2, 0.15, 0.05, 0.01).into(),
    });
    chain.model
}

struct Silent;
impl Observer for Silent {
    fn step(&mut self, _: &StepReport) -> bool {
        true
    }
    fn output(&mut self, _: &Snapshot<'_>) -> bool {
        true
    }
}

/// A chain that hangs on two hinges in a line, whose reactions are shared.
fn chain_on_two_hinges(rods: usize) -> Model {
    let mut model = chain(rods);
    let mut joint = model.joints[0].clone();
    let markers = [joint.i, joint.j].map(|marker| {
        let mut beside = model.markers[marker].clone();
        beside.offset += 0.2 * beside.axes.column(2);
        model.markers.push(beside);
        model.markers.len() - 1
    });
    [joint.i, joint.j] = markers;
    model.joints.push(joint);
    model.reactions = Reactions::LeastSquares { length: None };
    model
}

/// Allocates as often in a longer run.
fn allocates_nothing(model: &Model) {
    let settings = Settings {
        formulation: Formulation::Si2,
        error: 1e-4,
        highest_order: 5,
        longest_step: 0.02,
        shortest_step: 1e-9,
        first_step: None,
        corrector: Corrector::default(),
        interpolates: true,
    };
    let run = |end: f64| {
        let mut simulation = Simulation::new(model.clone(), 1.0);
        simulation.assemble().unwrap();
        let info = allocation_counter::measure(|| {
            simulation.run(end, [end], &settings, &mut Silent).unwrap();
        });
        (info.count_total, simulation.statistics().steps.steps)
    };
    let (short, steps) = run(0.5);
    let (long, more_steps) = run(1.5);
    assert!(2 * more_steps > 3 * steps);
    assert_eq!(short, long, "in {steps} and {more_steps} steps");
}

/// One front, and many with their contributions.
#[test]
fn steps_allocate_nothing() {
    allocates_nothing(&chain(3));
    allocates_nothing(&chain(12));
    allocates_nothing(&chain_on_two_hinges(3));
}
