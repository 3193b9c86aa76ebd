//! The mechanisms that tests and benchmarks share, most of them published as benchmarks or with a
//! motion known in closed form.
//!
//! | mechanisms | file |
//! |---|---|
//! | how a model is written down | `builder.rs` |
//! | Andrews' squeezing mechanism | `andrews.rs` |
//! | slider-crank, four-bar, rows of four-bars, Bricard's mechanism | `linkages.rs` |
//! | chains and trees of rods, with loops and friction | `chains.rs` |
//! | a spatial four-bar, shafts with a cross | `spatial.rs`, `cross.rs` |
//! | flyball governor | `governor.rs` |
//! | bodies that turn, slide, or both | `rigid.rs`, `turning.rs`, `sliding.rs`, `sleeve.rs` |
//! | stick and slip: a block on a belt, a block drawn by a spring | `belt.rs` |
//! | random trees with loops | `random/` |
//!
//! ```
//! use mechanics::Simulation;
//!
//! let mut simulation = Simulation::new(mechanisms::bricard(), 1.0);
//! let assembly = simulation.assemble()?;
//! assert_eq!(assembly.redundant.len(), 1);
//! assert_eq!(simulation.system().degrees_of_freedom(), 1);
//! # Ok::<(), mechanics::AssemblyError>(())
//! ```

mod andrews;
mod belt;
pub mod builder;
pub mod chains;
mod cross;
mod governor;
mod linkages;
mod load;
mod random;
mod rigid;
mod sleeve;
pub mod sliding;
mod spatial;
pub mod turning;

pub use andrews::{Andrews, andrews, body_angles};
pub use belt::{Belt, drawn_block};
pub use cross::{Cross, shafts};
pub use governor::governor;
pub use linkages::{
    bricard, driven_slider_crank, four_bar, four_bar_chain, slider_crank, slider_crank_with_pins,
};
pub use load::joint_load;
pub use random::{RandomMechanism, random};
pub use rigid::{free_body, pendulum, top};
pub use sleeve::Sleeve;
pub use spatial::{Rssr, rssr};

/// The original law with the transition coefficient 1.5 and all effects.
#[must_use]
pub fn law(
    mu_static: f64,
    mu_dynamic: f64,
    transition_velocity: f64,
    max_deformation: f64,
) -> friction::Original {
    friction::Original {
        mu_static,
        mu_dynamic,
        transition_velocity,
        transition_coefficient: 1.5,
        max_deformation,
        effect: friction::Effect::All,
    }
}

/// The bristles of most cases: s0 1e5 N/m, s1 300 N s/m, vs 1 mm/s, exponent 2.
#[must_use]
pub fn bristles(mu_static: f64, mu_dynamic: f64) -> friction::LuGre {
    friction::LuGre {
        mu_static,
        mu_dynamic,
        bristle_stiffness: 1e5,
        damping: 300.0,
        viscous: 0.0,
        stribeck_velocity: 1e-3,
        stribeck_exponent: 2.0,
    }
}
