//! Friction of a spherical joint: a torque against its relative rotation.
//!
//! The law works in axes fixed to J: its vectors are those of `friction::SphericalLoad`.

use friction::{Bristles, Coefficient, Regime, Resultant, bristle_resultant, resultant};
use nalgebra::{Matrix3, Vector3};

use super::response::{Joining, respond};
use super::{Element, LoadAt, Past, SurfaceVector, Values, Wanted};
use crate::equation::Local;
use crate::model::Friction;
use crate::rotation::{log, log_jacobian, skew};
use crate::state::MarkerFrame;

struct Ball<'a> {
    friction: &'a Friction,
    load: f64,
}

impl Joining<3> for Ball<'_> {
    #[inline(always)]
    fn original(&self, coefficient: &Coefficient<3>) -> Resultant<3> {
        let Friction {
            preload, maximum, ..
        } = self.friction;
        resultant(coefficient, self.load, preload.torque, maximum.torque)
    }

    #[inline(always)]
    fn bristles(&self, bristles: &Bristles<3>) -> Resultant<3> {
        let Friction {
            preload, maximum, ..
        } = self.friction;
        let limit = preload.torque + maximum.torque;
        bristle_resultant(bristles, self.friction.load.arm(), limit)
    }
}

#[inline(always)]
pub(super) fn evaluate(
    friction: &Friction,
    past: &Past<'_>,
    load: &LoadAt,
    i: &MarkerFrame,
    j: &MarkerFrame,
    wanted: Wanted<'_>,
) -> Element {
    let arm = friction.load.arm();
    let omega = i.omega - j.omega;
    let to_j = j.axes.transpose();
    let velocity = arm * (to_j * omega);
    let memory = past.memory;
    let theta = || log(&(to_j * i.axes * memory.rotation.transpose()));
    let slip = || (arm * theta()).into();
    let since = memory.creep_at(friction, past.time, slip, &velocity.into());
    let creep = since.map_or([0.0; 3], |creep| creep.value);
    let joining = Ball {
        friction,
        load: load.load.value,
    };
    let r = respond(
        friction,
        past,
        &velocity.into(),
        &creep,
        &load.load,
        [arm; 3],
        &joining,
    );
    let torque = Vector3::from(r.resultant.force);
    let mut element = Element {
        velocity: velocity.into(),
        creep,
        load: load.load,
        regime: r.regime,
        power: -torque.dot(&velocity) / arm,
        steady_coefficient: r.steady_coefficient,
        load_by_reaction: load.by_reaction,
        deflection: r.deflection,
        deflection_rate: r.deflection_rate,
        ..Element::AT_REST
    };
    if let Some(values) = wanted.values {
        let stuck = memory.stuck && r.regime == Regime::Stuck;
        let anchor = if stuck { memory.anchor } else { to_j * i.axes };
        let printed = |vector: Vector3<f64>| SurfaceVector {
            translation: Vector3::zeros(),
            rotation: anchor.tr_mul(&vector),
        };
        let visible = if stuck {
            Vector3::from(creep)
        } else {
            Vector3::zeros()
        };
        *values = Values {
            force: Vector3::zeros(),
            torque,
            mu: printed(Vector3::from(r.mu)),
            mu1: r.mu1,
            velocity: printed(velocity),
            creep: printed(visible),
            deflection: printed(Vector3::from(r.deflection)),
            beta: r.beta,
            regime: r.regime,
            load: load.load,
            causes: r.causes,
            clipped: r.resultant.clipped,
            power: element.power,
            stored: r.stored,
        };
    }
    let torque = j.axes * torque;
    let steady = j.axes * Vector3::from(r.steady_by_load);
    // Torque on I at 3, the opposite on J at 9.
    const SIDES: [(usize, f64); 2] = [(3, 1.0), (9, -1.0)];
    for (place, sign) in SIDES {
        let put = |local: &mut Local, vector: Vector3<f64>| {
            local.fixed_rows_mut::<3>(place).copy_from(&vector);
        };
        put(&mut element.force, sign * torque);
        put(&mut element.by_load, sign * steady);
    }
    let Some(slopes) = wanted.slopes else {
        return element;
    };
    let matrix = |m: [[f64; 3]; 3]| Matrix3::from_fn(|row, column| m[row][column]);
    // Derivatives of the torque along ground axes by the relative velocity and rotation.
    let by_creep = matrix(r.resultant.by_creep);
    let (mut by_velocity, mut by_theta_i) = (matrix(r.resultant.by_velocity), Matrix3::zeros());
    if let Some(since) = since {
        // The rotation of I comes in from the left, hence the Jacobian at −θ.
        let turn = arm * log_jacobian(&-theta());
        by_theta_i = j.axes * by_creep * matrix(since.by_slip) * turn * to_j;
        by_velocity += by_creep * matrix(since.by_velocity);
    }
    let by_omega = j.axes * by_velocity * arm * to_j;
    // δ(A_J T) = δθ_J × (A_J T) + A_J δT, and δ(A_Jᵀ ω) = −A_Jᵀ (δθ_J × ω).
    let by_theta_j = -skew(&torque) - by_theta_i + by_omega * skew(&omega);
    let along = j.axes * Vector3::from(r.resultant.by_load);
    for (place, sign) in SIDES {
        for k in 0..3 {
            let column = sign * load.by_reaction[k] * along;
            let mut view = slopes.by_reaction.fixed_view_mut::<3, 1>(place, k);
            view.copy_from(&column);
        }
        let (velocity, position) = (sign * slopes.velocity, sign * slopes.position);
        slopes.add(
            [place / 3, 1],
            &(velocity * by_omega + position * by_theta_i),
        );
        slopes.add(
            [place / 3, 3],
            &(position * by_theta_j - velocity * by_omega),
        );
    }
    element
}
