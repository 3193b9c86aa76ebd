//! The friction laws of machine joints: pure functions with exact derivatives.
//!
//! The crate turns four things into a friction force or torque and its derivatives:
//!
//! | step | file | from | to |
//! |---|---|---|---|
//! | parameters | [`parameters`] | the arguments of a `FRICTION` statement | keyword, default, range, unit |
//! | regime and coefficient | [`original`] | surface velocity `V`, creep `D` | vector coefficient `mu(V, D)` |
//! | bristles | [`lugre`] | `V`, bristle deflection `z`, load | vector force at the surface |
//! | effective load | [`joint`] | reaction force and moment of the joint | `N`, `Teff` or `Rb*\|F\|` |
//! | resultant | [`resultant`](mod@resultant) | coefficient, load, preload, limit | force or torque on the I part |
//!
//! All of it is plain functions of their arguments: no state, no allocation, no panics on finite
//! input. The creep is the caller's state; [`Original::settle`] says what becomes of it after an
//! accepted step. For simulators that step explicitly, [`explicit`] puts the four together and keeps
//! the state.
//!
//! # Signs and frames
//! Velocities are those of the **I** marker's part relative to the **J** marker's part, measured at
//! the surfaces in contact (length/time, also for rotations: arm times angular rate). Forces and
//! torques act on the **I** part; the J part receives the opposite. The coefficient already
//! opposes the motion, so that force = load * coefficient without a further sign.
//!
//! # Example
//! ```
//! use friction::{Effect, Original, resultant};
//! let law = Original {
//!     mu_static: 0.3, mu_dynamic: 0.2,
//!     transition_velocity: 0.1, transition_coefficient: 1.5,
//!     max_deformation: 0.01, effect: Effect::All,
//! };
//! let sliding = law.evaluate(&[0.5], &[0.0]);
//! let friction = resultant(&sliding, 100.0, 0.0, 1e40);
//! assert_eq!(friction.force, [-20.0]);
//! ```
#![no_std]

#[cfg(feature = "std")]
extern crate std;
#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!(
    "enable one of the features `std` (default) and `libm` for square root, exponential and power"
);

/// Runs the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

pub mod explicit;
pub mod joint;
pub mod law;
pub mod lugre;
pub mod original;
pub mod parameters;
pub mod resultant;
pub mod step;
mod vector;

pub use joint::{CylindricalLoad, Inputs, Load, RevoluteLoad, SphericalLoad, TranslationalLoad};
pub use law::{ForceAndTorque, Law};
pub use lugre::{Bristles, LuGre};
pub use original::{Coefficient, Effect, Original, Regime};
pub use resultant::{
    Resultant, bristle_resultant, cylindrical_bristle_resultant, cylindrical_resultant, resultant,
};
