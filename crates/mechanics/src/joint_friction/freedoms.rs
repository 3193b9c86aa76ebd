//! Friction of joints whose freedoms are displacements and angles: one of them, or both at once.

use friction::{
    Bristles, Coefficient, Resultant, bristle_resultant, cylindrical_bristle_resultant,
    cylindrical_resultant, resultant,
};
use nalgebra::Vector3;

use super::response::{Joining, Response, respond};
use super::{Element, LoadAt, Past, SurfaceVector, Values, Wanted};
use crate::equation::{Equation, Local, Pair};
use crate::model::{Friction, FrictionJoint};
use crate::state::MarkerFrame;
use friction::Regime;

/// A joint with one freedom.
struct One<'a> {
    friction: &'a Friction,
    load: f64,
}

impl Joining<1> for One<'_> {
    #[inline(always)]
    fn original(&self, coefficient: &Coefficient<1>) -> Resultant<1> {
        let (preload, maximum) = self.limits();
        resultant(coefficient, self.load, preload, maximum)
    }

    #[inline(always)]
    fn bristles(&self, bristles: &Bristles<1>) -> Resultant<1> {
        let (preload, maximum) = self.limits();
        bristle_resultant(bristles, self.friction.load.arm(), preload + maximum)
    }
}

impl One<'_> {
    fn limits(&self) -> (f64, f64) {
        let Friction {
            preload, maximum, ..
        } = self.friction;
        if self.friction.load.has_force_load() {
            (preload.force, maximum.force)
        } else {
            (preload.torque, maximum.torque)
        }
    }
}

/// A cylindrical joint.
struct Both<'a> {
    friction: &'a Friction,
    load: f64,
}

impl Joining<2> for Both<'_> {
    #[inline(always)]
    fn original(&self, coefficient: &Coefficient<2>) -> Resultant<2> {
        let Friction {
            preload, maximum, ..
        } = self.friction;
        cylindrical_resultant(
            coefficient,
            self.load,
            self.friction.load.arm(),
            [preload.force, preload.torque],
            [maximum.force, maximum.torque],
        )
    }

    #[inline(always)]
    fn bristles(&self, bristles: &Bristles<2>) -> Resultant<2> {
        let Friction {
            preload, maximum, ..
        } = self.friction;
        let limit = [
            preload.force + maximum.force,
            preload.torque + maximum.torque,
        ];
        cylindrical_bristle_resultant(bristles, self.friction.load.arm(), limit)
    }
}

/// Friction along or about the one freedom of a joint.
#[inline(always)]
pub(super) fn one(
    friction: &Friction,
    past: &Past<'_>,
    equation: Equation,
    load: &LoadAt,
    i: &MarkerFrame,
    j: &MarkerFrame,
    wanted: Wanted<'_>,
) -> Element {
    let joining = One {
        friction,
        load: load.load.value,
    };
    evaluate(friction, past, [equation], load, i, j, &joining, wanted)
}

/// Friction along and about the axis of a cylindrical joint.
#[inline(always)]
pub(super) fn cylindrical(
    friction: &Friction,
    past: &Past<'_>,
    equations: [Equation; 2],
    load: &LoadAt,
    i: &MarkerFrame,
    j: &MarkerFrame,
    wanted: Wanted<'_>,
) -> Element {
    let joining = Both {
        friction,
        load: load.load.value,
    };
    evaluate(friction, past, equations, load, i, j, &joining, wanted)
}

#[inline(always)]
fn evaluate<const N: usize>(
    friction: &Friction,
    past: &Past<'_>,
    equations: [Equation; N],
    load: &LoadAt,
    i: &MarkerFrame,
    j: &MarkerFrame,
    joining: &impl Joining<N>,
    wanted: Wanted<'_>,
) -> Element {
    let arms = equations.map(|equation| equation.arm(friction.load.arm()));
    let pair = Pair::new(i, j);
    let u = pair.velocities();
    let mut velocity = [0.0; N];
    let mut rows = [Local::zeros(); N];
    for k in 0..N {
        equations[k].differentiate(&pair, &[], &mut rows[k]);
        velocity[k] = arms[k] * rows[k].dot(&u);
    }
    let slip = || {
        core::array::from_fn(|k| {
            let value = equations[k].value(&pair, &[]);
            arms[k] * past.memory.change(equations[k], k, value)
        })
    };
    let since = past.memory.creep_at(friction, past.time, slip, &velocity);
    let creep = since.map_or([0.0; N], |creep| creep.value);
    let r = respond(friction, past, &velocity, &creep, &load.load, arms, joining);
    let powers = (0..N).map(|k| -r.resultant.force[k] * velocity[k] / arms[k]);
    let mut element = Element {
        load: load.load,
        regime: r.regime,
        power: powers.sum(),
        steady_coefficient: r.steady_coefficient,
        load_by_reaction: load.by_reaction,
        ..Element::AT_REST
    };
    element.velocity[..N].copy_from_slice(&velocity);
    element.creep[..N].copy_from_slice(&creep);
    if let Some(values) = wanted.values {
        *values = self::values(friction, equations, &element, &velocity, &creep, &r, i, j);
    }
    element.deflection[..N].copy_from_slice(&r.deflection);
    element.deflection_rate[..N].copy_from_slice(&r.deflection_rate);
    // The virtual work of component k is force · δ(value): the arms are in the force.
    let Resultant {
        force,
        by_load,
        mut by_velocity,
        by_creep,
        ..
    } = r.resultant;
    let mut by_slip = [[0.0; N]; N];
    if let Some(since) = since {
        for (k, row) in by_creep.iter().enumerate() {
            for l in 0..N {
                by_slip[k][l] = (0..N).map(|m| row[m] * since.by_slip[m][l]).sum();
                by_velocity[k][l] += (0..N)
                    .map(|m| row[m] * since.by_velocity[m][l])
                    .sum::<f64>();
            }
        }
    }
    for k in 0..N {
        element.force += force[k] * rows[k];
        element.by_load += r.steady_by_load[k] * rows[k];
    }
    let Some(slopes) = wanted.slopes else {
        return element;
    };
    let stiffnesses = equations.map(|equation| equation.stiffness(&pair, &[]));
    let velocity_by_position: [Local; N] =
        std::array::from_fn(|k| arms[k] * stiffnesses[k].rate_change(&pair));
    let mut along_load = Local::zeros();
    for k in 0..N {
        along_load += by_load[k] * rows[k];
        let mut velocity_change = Local::zeros();
        let mut position_change = by_load[k] * load.by_position;
        for l in 0..N {
            velocity_change += by_velocity[k][l] * arms[l] * rows[l];
            position_change += by_velocity[k][l] * velocity_by_position[l];
            position_change += by_slip[k][l] * arms[l] * rows[l];
        }
        let change = slopes.velocity * velocity_change + slopes.position * position_change;
        let turning = slopes.position * force[k] * stiffnesses[k].matrix(&pair);
        slopes.add_blocks(|row, column| {
            let along = rows[k].fixed_rows::<3>(3 * row);
            let change = change.fixed_rows::<3>(3 * column);
            turning.fixed_view::<3, 3>(3 * row, 3 * column) + along * change.transpose()
        });
    }
    for (column, slope) in load.by_reaction.iter().enumerate() {
        slopes
            .by_reaction
            .set_column(column, &(*slope * along_load));
    }
    element
}

fn values<const N: usize>(
    friction: &Friction,
    equations: [Equation; N],
    element: &Element,
    velocity: &[f64; N],
    creep: &[f64; N],
    r: &Response<N>,
    i: &MarkerFrame,
    j: &MarkerFrame,
) -> Values {
    // The axis of the turning freedom, along the axes of J.
    let axis = match friction.load {
        FrictionJoint::Pin(pin, _) => {
            let (on_i, k) = pin.axis();
            j.axes.tr_mul(&if on_i { i } else { j }.axis(k))
        }
        _ => Vector3::z(),
    };
    let spread = |components: &[f64; N]| {
        let mut vector = SurfaceVector::ZERO;
        for (equation, component) in equations.iter().zip(components) {
            match equation {
                Equation::About(_) => vector.rotation = *component * axis,
                _ => vector.translation = *component * Vector3::z(),
            }
        }
        vector
    };
    let force = spread(&r.resultant.force);
    let visible = if r.regime == Regime::Stuck {
        *creep
    } else {
        [0.0; N]
    };
    Values {
        force: force.translation,
        torque: force.rotation,
        mu: spread(&r.mu),
        mu1: r.mu1,
        velocity: spread(velocity),
        creep: spread(&visible),
        deflection: spread(&r.deflection),
        beta: r.beta,
        regime: r.regime,
        load: element.load,
        causes: r.causes,
        clipped: r.resultant.clipped,
        power: element.power,
        stored: r.stored,
    }
}
