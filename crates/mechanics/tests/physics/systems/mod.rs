//! Reference systems: mechanisms whose motion is known in closed form or was published.

mod andrews;
mod cross;
mod linkages;
mod rigid;
mod sleeve;
pub(crate) mod sliding;
mod spatial;
pub(crate) mod turning;

pub(crate) use andrews::{andrews, body_angles};
pub(crate) use cross::{Cross, shafts};
pub(crate) use linkages::{bricard, driven_slider_crank, four_bar, four_bar_chain, slider_crank};
pub(crate) use rigid::{free_body, pendulum, top};
pub(crate) use sleeve::Sleeve;
pub(crate) use spatial::rssr;

/// The original law with the transition coefficient 1.5 and all effects.
pub(crate) fn law(
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
pub(crate) fn bristles(mu_static: f64, mu_dynamic: f64) -> friction::LuGre {
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
