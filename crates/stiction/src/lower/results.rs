//! Functions whose value is part of the solution: reactions, forces and friction.

use dataset::{Expr, Function, Switchable};
use mechanics::{Acting, ForceElement, Owner, Side};
use nalgebra::Vector3;

use super::Lowering;
use super::forces::applied_places;
use crate::wrenches::Wrenches;

/// Where a result that an output reads comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ResultSource {
    /// Component 0 to 7 (FM FX FY FZ TM TX TY TZ) of a force along the axes of a marker.
    Component {
        /// Whose force.
        acting: Acting,
        /// Which component.
        component: usize,
        /// Marker whose axes resolve.
        axes: usize,
    },
    /// Component 0 to 25 of a friction, in the order of the `.res`.
    Friction {
        /// Its place among the model's frictions.
        friction: usize,
        /// Which component.
        component: usize,
    },
}

impl ResultSource {
    /// The result that a call stands for; `None` where it stands for none.
    pub(super) fn of_call(
        lowering: &Lowering,
        function: Function,
        arguments: &[Expr],
    ) -> Option<Self> {
        use Function as F;
        let dataset = lowering.dataset;
        let number = |k: usize| arguments.get(k).and_then(Expr::as_id);
        let marker = |k: usize| lowering.marker_place(number(k).unwrap_or(0));
        let between = |component, axes| {
            let (i, j) = (marker(0), marker(1));
            Some(Self::Component {
                acting: Acting::Between { i, j },
                component,
                axes,
            })
        };
        let applied = |kind| {
            let places = applied_places(dataset, kind, number(0)?)?;
            Some(ForceElement::applied(places))
        };
        let element = match function {
            F::Fm => return between(0, lowering.ground),
            F::Fx => return between(1, marker(2)),
            F::Fy => return between(2, marker(2)),
            F::Fz => return between(3, marker(2)),
            F::Tm => return between(4, lowering.ground),
            F::Tx => return between(5, marker(2)),
            F::Ty => return between(6, marker(2)),
            F::Tz => return between(7, marker(2)),
            F::Friction => {
                let component = number(1)?.checked_sub(1).filter(|c| *c < 26)? as usize;
                let friction = dataset.frictions.position(number(0)?)?;
                return Some(Self::Friction {
                    friction,
                    component,
                });
            }
            F::Joint => {
                let joint = dataset.joints.position(number(0)?)?;
                ForceElement::Constraint(Owner::Joint(joint))
            }
            F::Jprim => {
                let primitive = dataset.primitives.position(number(0)?)?;
                ForceElement::Constraint(Owner::Joint(dataset.joints.len() + primitive))
            }
            F::Ptcv => {
                let point = dataset.point_curves.position(number(0)?)?;
                let before = dataset.joints.len() + dataset.primitives.len();
                ForceElement::Constraint(Owner::Joint(before + point))
            }
            F::Motion => {
                let motion = dataset.motions.position(number(0)?)?;
                ForceElement::Constraint((*lowering.motions.get(motion)?)?)
            }
            F::Sforce => applied(Switchable::SingleForce)?,
            F::Spdp => applied(Switchable::SpringDamper)?,
            F::Vforce => applied(Switchable::VectorForce)?,
            F::Vtorq => applied(Switchable::VectorTorque)?,
            F::Gforce => applied(Switchable::GeneralForce)?,
            F::Bush => applied(Switchable::Bushing)?,
            F::Field => applied(Switchable::Field)?,
            F::Beam => applied(Switchable::Beam)?,
            _ => return None,
        };
        let side = match number(1)? {
            0 => Side::I,
            1 => Side::J,
            _ => return None,
        };
        let component = number(2)?.checked_sub(1).filter(|c| *c < 8)? as usize;
        Some(Self::Component {
            acting: Acting::Element(element, side),
            component,
            axes: marker(3),
        })
    }

    /// Its value at a solved instant.
    pub(crate) fn value(&self, instant: &Wrenches) -> f64 {
        match *self {
            Self::Component {
                acting,
                component,
                axes,
            } => {
                let wrench = instant.acting(acting);
                resolved(wrench.force, wrench.torque, component, instant, axes)
            }
            Self::Friction {
                friction,
                component,
            } => instant.components(friction)[component],
        }
    }
}

/// Component 0 to 7 (FM FX FY FZ TM TX TY TZ) of a force and a torque along the axes of a marker.
fn resolved(
    force: Vector3<f64>,
    torque: Vector3<f64>,
    component: usize,
    instant: &Wrenches,
    axes: usize,
) -> f64 {
    let vector = if component < 4 { force } else { torque };
    match component % 4 {
        0 => vector.norm(),
        axis => vector.dot(&instant.marker(axes).axis(axis - 1)),
    }
}
