//! Steps allocate nothing: a run of twice the time allocates exactly as often.
//!
//! A binary of its own, because it counts with a global allocator.

use mechanics::model::{
    Body, ForceAndTorque, Friction, FrictionJoint, Joint, JointKind, JointStart, Label, Law,
    Marker, Model,
};
use mechanics::rotation::Quaternion;
use mechanics::{Formulation, Observer, Settings, Simulation, Snapshot, StepReport};
use nalgebra::{Matrix3, Vector3};

fn label(statement: &'static str, id: u32) -> Label {
    Label {
        statement,
        id,
        name: String::new(),
    }
}

/// Rods that hang on hinges with friction.
fn chain(rods: usize) -> Model {
    let mut model = Model {
        gravity: Vector3::new(0.0, 0.0, -9.81),
        ..Model::default()
    };
    // The hinges turn about the ground's y axis.
    let hinge = Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0);
    for k in 0..rods {
        let id = k as u32 + 1;
        model.bodies.push(Body {
            label: label("PART", id),
            mass: 1.0,
            inertia: Matrix3::from_diagonal(&Vector3::new(0.001, 0.08, 0.08)),
            centre: Vector3::zeros(),
            origin: Vector3::new(k as f64 + 0.5, 0.0, 0.0),
            orientation: Quaternion::IDENTITY,
            velocity: Vector3::zeros(),
            angular_velocity: Vector3::zeros(),
            exact: [false; 6],
            given_velocity: [false; 6],
            rotates: true,
        });
        let (body, offset) = match k {
            0 => (None, Vector3::zeros()),
            _ => (Some(k - 1), Vector3::new(0.5, 0.0, 0.0)),
        };
        let offset_i = Vector3::new(-0.5, 0.0, 0.0);
        model.markers.push(Marker {
            id: 2 * id,
            body: Some(k),
            offset: offset_i,
            axes: hinge,
        });
        model.markers.push(Marker {
            id: 2 * id + 1,
            body,
            offset,
            axes: hinge,
        });
        model.joints.push(Joint {
            label: label("JOINT", id),
            kind: JointKind::Revolute,
            i: 2 * k,
            j: 2 * k + 1,
            translation_start: JointStart::default(),
            rotation_start: JointStart::default(),
        });
        model.frictions.push(Friction {
            label: label("FRICTION", id),
            joint: k,
            // Both formulations.
            law: if k == 1 {
                Law::LuGre(friction::LuGre {
                    mu_static: 0.2,
                    mu_dynamic: 0.15,
                    bristle_stiffness: 1e5,
                    damping: 1.0,
                    viscous: 0.0,
                    stribeck_velocity: 0.01,
                    stribeck_exponent: 2.0,
                })
            } else {
                Law::Original(friction::Original {
                    mu_static: 0.2,
                    mu_dynamic: 0.15,
                    transition_velocity: 0.05,
                    transition_coefficient: 1.5,
                    max_deformation: 0.01,
                    effect: friction::Effect::All,
                })
            },
            load: FrictionJoint::Revolute(friction::RevoluteLoad {
                inputs: friction::Inputs::ALL,
                pin_radius: 0.02,
                friction_arm: 0.02,
                bending_reaction_arm: 0.1,
            }),
            preload: ForceAndTorque::both(0.0),
            maximum: ForceAndTorque::both(1e40),
            inactive_static: false,
        });
    }
    model
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

/// Allocates as often in a longer run.
fn allocates_nothing(rods: usize) {
    let settings = Settings {
        formulation: Formulation::Si2,
        error: 1e-4,
        highest_order: 5,
        longest_step: 0.02,
        shortest_step: 1e-9,
        first_step: None,
        newton_iterations: 10,
    };
    let run = |end: f64| {
        let mut simulation = Simulation::new(chain(rods), 1.0);
        simulation.assemble().unwrap();
        let info = allocation_counter::measure(|| {
            simulation.run(end, &[end], &settings, &mut Silent).unwrap();
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
    allocates_nothing(3);
    allocates_nothing(12);
}
