//! How the cost of assembly and steps grows with the number of bodies.
//!
//! A spatial chain of hinged rods, without and with loops (a strut over every ten rods) and friction in
//! every hinge. Prints the time of assembly, of the first steps (which search the order of the pivots)
//! and of a later step.
//!
//! `cargo bench -p mechanics --bench chains`
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]

use std::time::Instant;

use mechanics::model::{
    Body, ForceAndTorque, Friction, FrictionJoint, Joint, JointKind, JointStart, Label, Law,
    Marker, Model,
};
use mechanics::rotation::Quaternion;
use mechanics::{Ending, Formulation, Observer, Settings, Simulation, Snapshot, StepReport};
use nalgebra::{Matrix3, Vector3};

/// Rods between two struts.
const RODS: usize = 10;

fn label(statement: &'static str, count: usize) -> Label {
    Label {
        statement,
        id: count as u32 + 1,
        name: String::new(),
    }
}

#[derive(Default)]
struct Builder(Model);

impl Builder {
    /// A rod of unit length along x with its centre of mass at `centre`.
    fn rod(&mut self, centre: Vector3<f64>) -> usize {
        let bodies = &mut self.0.bodies;
        bodies.push(Body {
            label: label("PART", bodies.len()),
            mass: 1.0,
            inertia: Matrix3::from_diagonal(&Vector3::new(0.001, 0.08, 0.08)),
            centre: Vector3::zeros(),
            origin: centre,
            orientation: Quaternion::IDENTITY,
            velocity: Vector3::zeros(),
            angular_velocity: Vector3::zeros(),
            exact: [false; 6],
            given_velocity: [false; 6],
            rotates: true,
        });
        bodies.len() - 1
    }

    fn marker(&mut self, body: Option<usize>, at: Vector3<f64>, axes: Matrix3<f64>) -> usize {
        let offset = at - body.map_or(Vector3::zeros(), |body| self.0.bodies[body].origin);
        self.0.markers.push(Marker {
            id: self.0.markers.len() as u32 + 1,
            body,
            offset,
            axes,
        });
        self.0.markers.len() - 1
    }

    fn joint(
        &mut self,
        kind: JointKind,
        bodies: [Option<usize>; 2],
        at: Vector3<f64>,
        axes: Matrix3<f64>,
    ) {
        let [i, j] = bodies.map(|body| self.marker(body, at, axes));
        self.0.joints.push(Joint {
            label: label("JOINT", self.0.joints.len()),
            kind,
            i,
            j,
            translation_start: JointStart::default(),
            rotation_start: JointStart::default(),
        });
    }

    fn friction(&mut self, joint: usize) {
        self.0.frictions.push(Friction {
            label: label("FRICTION", joint),
            joint,
            law: Law::Original(friction::Original {
                mu_static: 0.1,
                mu_dynamic: 0.05,
                transition_velocity: 0.05,
                transition_coefficient: 1.5,
                max_deformation: 0.01,
                effect: friction::Effect::All,
            }),
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
}

/// `count` rods in a row from ground, whose hinges turn about y and z by turns.
fn chain(count: usize, loops: bool, friction: bool) -> Model {
    let mut builder = Builder::default();
    builder.0.gravity = Vector3::new(0.0, 0.0, -9.81);
    let about_y = Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0);
    let mut last = None;
    for k in 0..count {
        let at = Vector3::new(k as f64, 0.0, 0.0);
        let rod = builder.rod(at + Vector3::new(0.5, 0.0, 0.0));
        let turn = if k % 3 == 1 {
            Matrix3::identity()
        } else {
            about_y
        };
        builder.joint(JointKind::Revolute, [Some(rod), last], at, turn);
        if friction {
            builder.friction(k);
        }
        last = Some(rod);
    }
    if loops {
        for first in (0..count.saturating_sub(RODS)).step_by(RODS) {
            let from = Vector3::new(first as f64 + 1.5, 0.0, 0.5);
            let to = Vector3::new((first + RODS) as f64 - 0.5, 0.0, 0.5);
            let strut = builder.rod(0.5 * (from + to));
            let near = [Some(strut), Some(first + 1)];
            let far = [Some(strut), Some(first + RODS - 1)];
            builder.joint(JointKind::Spherical, near, from, Matrix3::identity());
            builder.joint(JointKind::Hooke, far, to, Matrix3::identity());
        }
    }
    builder.0
}

/// Ends a run after so many steps.
struct Steps(usize);
impl Observer for Steps {
    fn step(&mut self, _: &StepReport) -> bool {
        self.0 -= 1;
        self.0 > 0
    }
    fn output(&mut self, _: &Snapshot<'_>) -> bool {
        true
    }
}

fn main() {
    // Arguments: sizes instead of those below; cargo passes `--bench`, too.
    let given: Vec<usize> = std::env::args().filter_map(|a| a.parse().ok()).collect();
    let sizes = if given.is_empty() {
        vec![3, 10, 30, 100, 300, 1000, 3000]
    } else {
        given
    };
    println!("bodies loops friction  assembly  first 4 steps  step [us]  a body  matrices a step");
    for (loops, friction) in [(false, false), (false, true), (true, false), (true, true)] {
        for &count in &sizes {
            let mut simulation = Simulation::new(chain(count, loops, friction), 1.0);
            let start = Instant::now();
            simulation.assemble().expect("the chain is assembled");
            let assembly = start.elapsed().as_secs_f64();
            let settings = Settings {
                formulation: Formulation::Si2,
                error: 1e-4,
                highest_order: 5,
                longest_step: 0.01,
                shortest_step: 1e-9,
                first_step: Some(1e-4),
                newton_iterations: 10,
            };
            let mut run = |steps: usize| {
                let before = simulation.statistics();
                let start = Instant::now();
                let ending = simulation
                    .run(1e3, &[], &settings, &mut Steps(steps))
                    .expect("the chain moves");
                assert_eq!(ending, Ending::Stopped);
                let after = simulation.statistics();
                let done = after.steps.steps - before.steps.steps;
                let matrices = after.work.factorisations - before.work.factorisations;
                (start.elapsed().as_secs_f64(), matrices as f64 / done as f64)
            };
            let (first, _) = run(4);
            let steps = (20_000 / count).clamp(30, 400);
            let (time, matrices) = run(steps);
            let step = 1e6 * time / steps as f64;
            println!(
                "{count:6} {loops:5} {friction:8} {assembly:8.3} s {first:12.3} s {step:10.1} {:7.2} {matrices:16.2}",
                step / count as f64
            );
        }
    }
}
