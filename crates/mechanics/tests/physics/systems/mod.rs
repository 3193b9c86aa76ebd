//! Reference systems: mechanisms whose motion is known in closed form or was published.

mod andrews;
mod linkages;
mod rigid;
pub(crate) mod sliding;
mod spatial;
pub(crate) mod turning;

pub(crate) use andrews::{andrews, body_angles};
pub(crate) use linkages::{bricard, four_bar, four_bar_chain, slider_crank};
pub(crate) use rigid::{free_body, pendulum, top};
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
