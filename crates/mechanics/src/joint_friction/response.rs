//! The law asked: from load, velocity and creep or bristles to friction in surface variables.

use friction::{Bristles, Coefficient, Load, Regime, Resultant};

use super::Past;
use crate::model::{Friction, Law};

/// Smallest level of the bristles, as a part of the largest seen so far, and as a plain number.
const LEAST_LEVEL: [f64; 2] = [1e-9, 1e-12];

/// Friction by component of the surfaces' motion: `N` forces and torques as the resultant has them.
pub(super) struct Response<const N: usize> {
    pub(super) resultant: Resultant<N>,
    pub(super) mu: [f64; N],
    pub(super) mu1: f64,
    pub(super) beta: f64,
    pub(super) regime: Regime,
    pub(super) deflection: [f64; N],
    pub(super) deflection_rate: [f64; N],
    /// Derivative of the friction by the load in steady motion; that of the bristles follows the
    /// load only in time.
    pub(super) steady_by_load: [f64; N],
    pub(super) steady_coefficient: f64,
    pub(super) causes: [f64; 4],
    pub(super) stored: f64,
}

/// How a joint puts its friction together from a coefficient and from bristles.
pub(super) trait Joining<const N: usize> {
    fn original(&self, coefficient: &Coefficient<N>) -> Resultant<N>;
    fn bristles(&self, bristles: &Bristles<N>) -> Resultant<N>;
}

/// Friction of `law` at the surfaces. `preload` is a force at the surfaces by component, `arms` turn
/// forces at the surfaces into the components of the resultant.
#[inline(always)]
pub(super) fn respond<const N: usize>(
    friction: &Friction,
    past: &Past<'_>,
    velocity: &[f64; N],
    creep: &[f64; N],
    load: &Load,
    arms: [f64; N],
    joining: &impl Joining<N>,
) -> Response<N> {
    let preload = surface_preload(friction, arms);
    match &friction.law {
        Law::Original(law) => {
            let c = law.evaluate(velocity, creep);
            let resultant = joining.original(&c);
            let energy = match c.regime {
                Regime::Stuck => law.creep_energy(norm(creep)),
                Regime::Transition | Regime::Sliding => 0.0,
            };
            Response {
                mu: c.mu,
                mu1: c.mu1,
                beta: c.beta,
                regime: c.regime,
                deflection: [0.0; N],
                deflection_rate: [0.0; N],
                steady_by_load: resultant.by_load,
                steady_coefficient: if resultant.clipped { 0.0 } else { norm(&c.mu) },
                causes: causes(
                    load,
                    norm(&c.mu),
                    weighted(&preload, &c.direction),
                    friction,
                ),
                stored: energy * (friction.surface_load(load) + norm(&preload) / law.mu_static),
                resultant,
            }
        }
        Law::LuGre(law) => {
            let at_surface = friction.surface_load(load);
            let level = law.mu_static * past.memory.largest_load.max(at_surface);
            let least = (LEAST_LEVEL[0] * level).max(LEAST_LEVEL[1]);
            let z = core::array::from_fn(|k| past.bristles.past[k]);
            let b = law.evaluate(
                velocity,
                &z,
                past.bristles.gamma,
                at_surface,
                &preload,
                least,
            );
            let resultant = joining.bristles(&b);
            let speed = norm(velocity);
            let steady = |k: usize| {
                let along = if speed > 0.0 {
                    velocity[k] / speed
                } else {
                    0.0
                };
                -b.coefficient * along * load_factor(friction, arms[k])
            };
            // All inputs bend the same bristles: each has the share of the level that it makes.
            let size = norm(&b.force);
            let unit = b.force.map(|f| if size > 0.0 { f / size } else { 0.0 });
            let from_preload = weighted(&preload, &unit);
            let whole = from_preload + b.coefficient * at_surface;
            let share = if whole > 0.0 { size / whole } else { 0.0 };
            Response {
                mu: b.force.map(|f| {
                    if at_surface > 0.0 {
                        f / at_surface
                    } else {
                        0.0
                    }
                }),
                mu1: 0.0,
                beta: 1.0,
                regime: law.regime(speed),
                deflection: b.deflection,
                deflection_rate: b.rate,
                steady_by_load: if resultant.clipped {
                    [0.0; N]
                } else {
                    core::array::from_fn(steady)
                },
                steady_coefficient: if resultant.clipped || speed == 0.0 {
                    0.0
                } else {
                    b.coefficient
                },
                causes: causes(load, share * b.coefficient, share * from_preload, friction),
                stored: 0.5 * law.bristle_stiffness * norm(&b.deflection) * norm(&b.deflection),
                resultant,
            }
        }
    }
}

/// Preload as a force at the surfaces, by component.
fn surface_preload<const N: usize>(friction: &Friction, arms: [f64; N]) -> [f64; N] {
    let slides = |k: usize| friction.load.has_force_load() && k == 0;
    core::array::from_fn(|k| {
        if slides(k) {
            friction.preload.force
        } else {
            friction.preload.torque / arms[k]
        }
    })
}

/// What turns a coefficient into the derivative of a component of the resultant by the load: the
/// load of turning joints contains the arm.
fn load_factor(friction: &Friction, arm: f64) -> f64 {
    if friction.load.has_force_load() {
        arm
    } else {
        1.0
    }
}

/// Friction by cause in the unit of the load, from the magnitude of the coefficient and of the
/// preload at the surfaces.
fn causes(load: &Load, mu: f64, preload: f64, friction: &Friction) -> [f64; 4] {
    let arm = if friction.load.has_force_load() {
        1.0
    } else {
        friction.load.arm()
    };
    [
        arm * preload,
        mu * load.from_reaction,
        mu * load.from_bending,
        mu * load.from_torsion,
    ]
}

fn weighted<const N: usize>(weights: &[f64; N], x: &[f64; N]) -> f64 {
    norm(&core::array::from_fn::<f64, N, _>(|k| weights[k] * x[k]))
}

pub(super) fn norm<const N: usize>(x: &[f64; N]) -> f64 {
    x.iter().map(|c| c * c).sum::<f64>().sqrt()
}
