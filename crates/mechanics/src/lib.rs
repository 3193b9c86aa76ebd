//! Rigid bodies, joints, forces and friction as one set of equations in time.
//!
//! A [`model::Model`] lists what is given. [`Simulation`] assembles it, integrates it and shows
//! solved instants as [`Snapshot`]s. The equations are in `system`, one implicit step in
//! `dynamics/`, one instant in `instant.rs`; frames, signs and symbols are those of
//! `docs/notation.md`.
//!
//! A block on a table, pushed along z against its friction:
//!
//! ```
//! use mechanics::model::{
//!     Body, ForceAndTorque, ForceKind, Friction, FrictionJoint, Joint, JointKind, JointStart,
//!     Label, Law, Marker, Model, SingleForce,
//! };
//! use mechanics::expression::Program;
//! use mechanics::rotation::Quaternion;
//! use mechanics::Simulation;
//! use nalgebra::{Matrix3, Vector3};
//!
//! let label = |statement, id| Label { statement, id, name: String::new() };
//! let axes = Matrix3::identity();
//! let model = Model {
//!     bodies: vec![Body {
//!         label: label("PART", 2),
//!         mass: 2.0,
//!         inertia: Matrix3::identity(),
//!         centre: Vector3::zeros(),
//!         origin: Vector3::zeros(),
//!         orientation: Quaternion::IDENTITY,
//!         velocity: Vector3::new(0.0, 0.0, 1.0),
//!         angular_velocity: Vector3::zeros(),
//!         exact: [false; 6],
//!         given_velocity: [true; 6],
//!         rotates: true,
//!     }],
//!     markers: vec![
//!         Marker { id: 1, body: Some(0), offset: Vector3::zeros(), axes },
//!         Marker { id: 2, body: None, offset: Vector3::zeros(), axes },
//!     ],
//!     joints: vec![Joint {
//!         label: label("JOINT", 1),
//!         kind: JointKind::Translational,
//!         i: 0,
//!         j: 1,
//!         translation_start: JointStart::default(),
//!         rotation_start: JointStart::default(),
//!     }],
//!     forces: vec![SingleForce {
//!         label: label("SFORCE", 1),
//!         i: 0,
//!         j: 1,
//!         kind: ForceKind::AlongZ,
//!         function: Program::constant(10.0),
//!     }],
//!     frictions: vec![Friction {
//!         label: label("FRICTION", 1),
//!         joint: 0,
//!         law: Law::Original(friction::Original {
//!             mu_static: 0.3,
//!             mu_dynamic: 0.2,
//!             transition_velocity: 0.1,
//!             transition_coefficient: 1.5,
//!             max_deformation: 0.01,
//!             effect: friction::Effect::All,
//!         }),
//!         load: FrictionJoint::Translational(friction::TranslationalLoad {
//!             inputs: friction::Inputs::ALL,
//!             reaction_arm: 1.0,
//!             bending_factor: 1.0,
//!             initial_overlap: 1000.0,
//!             overlap_sign: 0.0,
//!         }),
//!         preload: ForceAndTorque::both(0.0),
//!         maximum: ForceAndTorque::both(1e40),
//!         inactive_static: false,
//!     }],
//!     gravity: Vector3::new(0.0, -10.0, 0.0),
//!     ..Model::default()
//! };
//! let mut simulation = Simulation::new(model, 1.0);
//! simulation.assemble().unwrap();
//! simulation.solve_instant().unwrap();
//! let snapshot = simulation.snapshot();
//! // Push 10 less friction 0.2 · 2 · 10, over a mass of 2.
//! assert!((snapshot.part_acceleration(0).linear.z - 3.0).abs() < 1e-12);
//! assert!((snapshot.friction(0).force.z + 4.0).abs() < 1e-12);
//! ```

mod assembly;
mod comparison;
mod constraint;
pub mod curve;
mod dynamics;
mod equation;
mod equilibrium;
pub mod expression;
mod force_element;
mod gain;
mod instant;
#[cfg(test)]
mod jacobian_test;
mod joint_friction;
pub mod linearization;
pub mod measure;
pub mod model;
pub mod rotation;
mod scalar;
mod simulation;
mod snapshot;
pub mod state;
mod system;
mod system_elements;

pub use assembly::{Assembly, AssemblyError, Massless, Moved, Redundancy, Unmet, VelocityChange};
pub use comparison::{Comparison, Deviation, Moment, Motion, Spread, StepError};
pub use constraint::Owner;
pub use dynamics::{Corrector, Formulation, Pattern, Sliding, Work};
pub use equilibrium::{EquilibriumReport, EquilibriumSettings};
pub use force_element::{Acting, Ends, ForceComponent, ForceElement, Side};
pub use gain::Jam;
pub use instant::Failure;
pub use joint_friction::{Memory, SurfaceVector, Tally, Values as FrictionValues};
pub use simulation::{
    Cause, Ending, ForeignState, Observer, Paused, RunError, SavedState, Settings, Simulation,
    Statistics, StepReport, gravity_energy, kinetic_energy,
};
pub use snapshot::{Snapshot, Wrench};
pub use system::{History, System};
