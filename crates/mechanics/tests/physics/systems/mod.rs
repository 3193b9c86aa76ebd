//! Reference systems: mechanisms whose motion is known in closed form or was published.

mod andrews;
mod linkages;
mod rigid;

pub(crate) use andrews::{andrews, body_angles};
pub(crate) use linkages::{bricard, four_bar_chain};
pub(crate) use rigid::{free_body, pendulum, top};
