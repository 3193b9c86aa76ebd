//! Friction against closed forms and exact stick-slip solutions, as claims of the verification
//! manual.
//!
//! A regularised law approaches the set-valued one (exact stick and slip) with the first power of
//! its transition velocity Vs and largest creep Dm: both are halved three times, and the order is
//! observed. Two kinds of values converge faster. A stop without load comes back to where the creep
//! is zero, which leaves the work missing below Vs, `O(Vs²)`; and so do angles (not times) of
//! turning points. Cases whose solution with the law itself is known are compared at one Vs and Dm.

mod balls;
mod crosses;
mod law;
mod linkages;
mod lugre;
mod pins;
mod rotors;
mod sleeves;
mod slopes;
mod spatial;
mod springs;
mod statics;

use friction::parameters::JointType;
use verification::{Coverage, Formulation};

/// Factors of Vs and Dm.
const HALVINGS: [f64; 4] = [1.0, 0.5, 0.25, 0.125];

/// Why an order of one is expected.
const LIMIT: &str = "first order in Vs and Dm; margin of the reference";
/// Why an order of at least one is expected.
const TURNS: &str = "first order in Vs and Dm, turning points faster; margin of the reference";
/// Why an order of two is expected.
const UNLOADED: &str = "without load only the work below Vs, O(Vs²), is missing";

/// What every case of the original law with stick and slip shows, beside `more`.
fn original<'a>(joint: JointType, more: &'a [&'a str]) -> [Coverage<'a>; 2] {
    let basic = &[
        "JOINT",
        "FORMULATION",
        "MU_STATIC",
        "MU_DYNAMIC",
        "STICTION_TRANSITION_VELOCITY",
        "MAX_STICTION_DEFORMATION",
    ];
    coverage(joint, Formulation::Original, basic, more)
}

/// What every case of bristles that slip shows, beside `more`.
fn lugre<'a>(joint: JointType, more: &'a [&'a str]) -> [Coverage<'a>; 2] {
    let basic = &[
        "JOINT",
        "FORMULATION",
        "MU_STATIC",
        "MU_DYNAMIC",
        "BRISTLE_STIFFNESS_COEFFICIENT",
        "DAMPING_COEFFICIENT",
        "VELOCITY_THRESHOLD_STRIBECK",
    ];
    coverage(joint, Formulation::LuGre, basic, more)
}

fn coverage<'a>(
    joint: JointType,
    formulation: Formulation,
    basic: &'a [&'a str],
    more: &'a [&'a str],
) -> [Coverage<'a>; 2] {
    [basic, more].map(|arguments| Coverage {
        joint,
        formulation,
        arguments,
    })
}
