//! Claims: what the tests compare with a reference, recorded so that the verification manual is made
//! of the very numbers that were checked.
//!
//! A test describes a [`Case`], makes [`Claim`]s of it, and hands them to [`check`], which prints
//! every claim, records it where the environment variable [`FOLDER`] names a folder, and fails the
//! test where one does not hold. `cargo run --release -p verification` runs all tests in that way and
//! writes `docs/verification.md` ([`manual`]).
//!
//! ```
//! use friction::parameters::JointType;
//! use verification::{Case, Coverage, Formulation, Section, check};
//!
//! let case = Case {
//!     section: Section::Joint,
//!     id: "example",
//!     model: "disc of 0.05 kg m² on a collar with 0.2 · 0.08 m · 100 N",
//!     source: "closed form T/J",
//!     covers: &[Coverage {
//!         joint: JointType::Revolute,
//!         formulation: Formulation::Original,
//!         arguments: &["FRICTION_ARM"],
//!     }],
//! };
//! let (ours, exact) = (0.2 * 0.08 * 100.0 / 0.05, 32.0);
//! check(&[case.values("deceleration [rad/s²]", &[ours], &[exact], 1e-13, "rounding")]);
//! ```

pub mod claim;
pub mod coverage;
pub mod manual;
pub mod number;
mod record;

pub use claim::{Case, Claim, Rule, Section};
pub use coverage::{Cell, Coverage, Formulation};
pub use record::{FOLDER, check};
