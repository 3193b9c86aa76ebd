//! The values of our own entity of a friction; `results::friction_detail` says what they are.

use friction::Regime;
use mechanics::FrictionValues;
use mechanics::model::{Friction, FrictionJoint, Law};
use results::{Entity, SurfaceMotion, UnitNames};

use crate::wrenches::Wrenches;

/// The entity of a friction of that name and id.
pub(crate) fn entity(name: &str, id: u32, friction: &Friction, units: &UnitNames) -> Entity {
    let bristles = matches!(friction.law, Law::LuGre(_));
    Entity::friction_detail(name, id, surface_motion(friction), bristles, units)
}

fn surface_motion(friction: &Friction) -> SurfaceMotion {
    match friction.load {
        FrictionJoint::Translational(_) => SurfaceMotion::Sliding,
        FrictionJoint::Revolute(_) | FrictionJoint::Pin(..) => SurfaceMotion::Turning,
        FrictionJoint::Cylindrical(_) => SurfaceMotion::SlidingAndTurning,
        FrictionJoint::Spherical(_) => SurfaceMotion::TurningAboutPoint,
    }
}

/// 0 stuck, 1 transition, 2 sliding.
pub(crate) fn number(regime: Regime) -> usize {
    match regime {
        Regime::Stuck => 0,
        Regime::Transition => 1,
        Regime::Sliding => 2,
    }
}

/// Friction and velocity of the surfaces about the one axis of a joint; their magnitudes where there
/// are several.
fn along(joint: FrictionJoint, now: &FrictionValues) -> [f64; 2] {
    let (sliding, turning) = (now.velocity.translation, now.velocity.rotation);
    match joint {
        FrictionJoint::Translational(_) | FrictionJoint::Cylindrical(_) => [now.force.z, sliding.z],
        FrictionJoint::Revolute(_) => [now.torque.z, turning.z],
        // A pin turns about one axis of I and its torque is along the axes of J; it goes the way of the
        // coefficient.
        FrictionJoint::Pin(..) => {
            let torque = now.torque.norm().copysign(now.mu.rotation.sum());
            [torque, turning.sum()]
        }
        FrictionJoint::Spherical(_) => [now.torque.norm(), turning.norm()],
    }
}

/// Appends the values of a friction that dissipated so much so far.
pub(crate) fn append(
    values: &mut Vec<f64>,
    wrenches: &Wrenches<'_>,
    place: usize,
    dissipated: f64,
) {
    let snapshot = wrenches.snapshot();
    let friction = &snapshot.model().frictions[place];
    let (now, tally) = (wrenches.friction(place), snapshot.tally(place));
    let load = &now.load;
    values.push(number(now.regime) as f64);
    values.extend([
        load.value,
        load.from_reaction,
        load.from_bending,
        load.from_torsion,
    ]);
    values.extend(now.causes);
    values.push(f64::from(u8::from(now.clipped)));
    values.push(now.power);
    values.extend([snapshot.works()[place], now.stored, dissipated]);
    values.push(tally.sticks as f64);
    let ended = tally.stick_end.unwrap_or(0.0);
    values.extend([
        tally.stick_start,
        ended,
        tally.stuck_time,
        tally.largest_creep,
    ]);
    values.extend(along(friction.load, now));
    if let Law::LuGre(_) = friction.law {
        let motion = surface_motion(friction);
        if motion.slides() {
            values.extend(now.deflection.translation.iter());
        }
        if motion.turns() {
            values.extend(now.deflection.rotation.iter());
        }
        values.extend(&tally.drift[..friction.load.components()]);
    }
}
