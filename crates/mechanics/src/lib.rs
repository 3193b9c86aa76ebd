//! Rigid bodies, joints, forces and friction as one set of equations in time.

mod assembly;
mod constraint;
mod dynamics;
mod equation;
pub mod expression;
mod instant;
#[cfg(test)]
mod jacobian_test;
mod joint_friction;
pub mod measure;
pub mod model;
pub mod rotation;
mod scalar;
mod simulation;
mod snapshot;
pub mod state;
mod system;

pub use assembly::{Assembly, AssemblyError, Moved, Redundancy, VelocityChange};
pub use constraint::Owner;
pub use dynamics::{Formulation, Work};
pub use instant::Failure;
pub use joint_friction::{Memory, Values as FrictionValues};
pub use simulation::{
    Ending, Observer, RunError, Settings, Simulation, Statistics, StepReport, gravity_energy,
    kinetic_energy,
};
pub use snapshot::{Snapshot, Wrench};
pub use system::{History, System};
