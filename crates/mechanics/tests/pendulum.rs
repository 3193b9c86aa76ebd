//! A pendulum against its closed form, for both formulations and every order.

use mechanics::model::{Body, Joint, JointKind, JointStart, Label, Marker, Model};
use mechanics::rotation::Quaternion;
use mechanics::{
    Ending, Formulation, Observer, Settings, Simulation, Snapshot, StepReport, gravity_energy,
    kinetic_energy,
};
use nalgebra::{Matrix3, Vector3};

fn label(statement: &'static str, id: u32) -> Label {
    Label { statement, id, name: String::new() }
}

/// A point-like mass of 1 kg, 1 m from a revolute joint at the origin, horizontal, at rest.
fn pendulum() -> Model {
    Model {
        bodies: vec![Body {
            label: label("PART", 2),
            mass: 1.0,
            inertia: Matrix3::zeros(),
            centre: Vector3::zeros(),
            origin: Vector3::new(-1.0, 0.0, 0.0),
            orientation: Quaternion::IDENTITY,
            velocity: Vector3::zeros(),
            angular_velocity: Vector3::zeros(),
            exact: [false; 6],
            given_velocity: [false; 6],
            rotates: true,
        }],
        markers: vec![
            Marker {
                id: 1,
                body: Some(0),
                offset: Vector3::new(1.0, 0.0, 0.0),
                axes: Matrix3::identity(),
            },
            Marker { id: 2, body: None, offset: Vector3::zeros(), axes: Matrix3::identity() },
        ],
        joints: vec![Joint {
            label: label("JOINT", 1),
            kind: JointKind::Revolute,
            i: 0,
            j: 1,
            translation_start: JointStart::default(),
            rotation_start: JointStart::default(),
        }],
        gravity: Vector3::new(0.0, -9.81, 0.0),
        ..Model::default()
    }
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

fn run(formulation: Formulation, error: f64, highest_order: usize) -> (Simulation, f64) {
    let mut simulation = Simulation::new(pendulum(), 1.0);
    simulation.assemble().unwrap();
    simulation.solve_instant().unwrap();
    let settings = Settings {
        formulation,
        error,
        highest_order,
        longest_step: 0.1,
        shortest_step: 1e-12,
        first_step: None,
        newton_iterations: 6,
    };
    let ending = simulation.run(10.0, &[10.0], &settings, &mut Silent).unwrap();
    assert_eq!(ending, Ending::Completed);
    // IFToMM benchmark A01: elliptic functions, 12 digits.
    let exact = Vector3::new(-0.275087462577, -0.961419205099, 0.0);
    let error = (simulation.state().centre(0) - exact).norm();
    (simulation, error)
}

#[test]
fn converges_to_the_closed_form() {
    for formulation in [Formulation::I3, Formulation::Si2] {
        let mut last = f64::INFINITY;
        for tolerance in [1e-4, 1e-6, 1e-8] {
            let (simulation, error) = run(formulation, tolerance, 5);
            let statistics = simulation.statistics();
            let energy = kinetic_energy(simulation.model(), simulation.state())
                + gravity_energy(simulation.model(), simulation.state());
            println!("{formulation:?} {tolerance:e}: {error:.2e}, energy {energy:.2e}, {statistics:?}");
            assert!(error < 0.2 * last);
            last = error;
        }
        assert!(last < 1e-4, "{formulation:?} {last:e}");
    }
}
