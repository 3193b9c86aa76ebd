//! Random friction.

use friction::{Effect, Inputs, LuGre, Original};
use mechanics::model::{ForceAndTorque, FrictionJoint, JointKind, Law, Pin};

use super::Draft;
use crate::load::joint_load;

/// Part of the joints that have friction.
const SHARE: f64 = 0.7;

impl Draft {
    /// Friction in most of the joints that may have it, and at least in one, where there is any.
    pub(super) fn frictions(&mut self) {
        let lugre = self.numbers.chance(0.5);
        for joint in 0..self.b.model.joints.len() {
            let first = self.b.model.frictions.is_empty();
            let Some(load) = self.load(self.b.model.joints[joint].kind) else {
                continue;
            };
            if !(first || self.numbers.chance(SHARE)) {
                continue;
            }
            let law: Law = if lugre {
                self.lugre().into()
            } else {
                self.original().into()
            };
            self.b.friction(joint, law, load);
            let (force, length) = (self.units.force(), self.units.length);
            let last = self.b.model.frictions.len() - 1;
            if self.numbers.chance(0.25) {
                let preload = force * self.numbers.decades(-3.0, 0.0);
                self.b.model.frictions[last].preload = ForceAndTorque {
                    force: preload,
                    torque: preload * length,
                };
            }
            if self.numbers.chance(0.125) {
                let maximum = force * self.numbers.decades(-1.0, 1.0);
                self.b.model.frictions[last].maximum = ForceAndTorque {
                    force: maximum,
                    torque: maximum * length,
                };
            }
        }
    }

    fn coefficients(&mut self) -> [f64; 2] {
        let mu_static = self.numbers.decades(-3.0, 0.0);
        [mu_static, mu_static * self.numbers.between(0.4, 1.0)]
    }

    fn original(&mut self) -> Original {
        let [mu_static, mu_dynamic] = self.coefficients();
        let (length, time) = (self.units.length, self.units.time);
        Original {
            mu_static,
            mu_dynamic,
            transition_velocity: length / time * self.numbers.decades(-4.0, -0.5),
            transition_coefficient: self.numbers.between(1.05, 3.0),
            max_deformation: length * self.numbers.decades(-6.0, -2.0),
            effect: self.numbers.choose(&[
                (4.0, Effect::All),
                (1.0, Effect::Stiction),
                (1.0, Effect::Sliding),
            ]),
        }
    }

    fn lugre(&mut self) -> LuGre {
        let [mu_static, mu_dynamic] = self.coefficients();
        let (length, time, force) = (self.units.length, self.units.time, self.units.force());
        let bristle_stiffness = force / length * self.numbers.decades(2.0, 6.0);
        let critical = (bristle_stiffness * self.units.mass).sqrt();
        LuGre {
            mu_static,
            mu_dynamic,
            bristle_stiffness,
            damping: critical * self.numbers.decades(-2.0, 0.0),
            viscous: force * time / length * self.numbers.decades(-5.0, -1.0),
            stribeck_velocity: length / time * self.numbers.decades(-4.0, -0.5),
            stribeck_exponent: self.numbers.between(0.5, 2.0),
        }
    }

    fn load(&mut self, kind: JointKind) -> Option<FrictionJoint> {
        let length = self.units.length;
        let mut size = || length * self.numbers.decades(-2.5, -0.7);
        let arms = [0; 3].map(|_| size());
        let load = joint_load(kind, Inputs::ALL, length, arms[0], arms[1])?;
        Some(match load {
            FrictionJoint::Pin(Pin::HookeI, pin) => FrictionJoint::Pin(
                self.numbers
                    .choose(&[(1.0, Pin::HookeI), (1.0, Pin::HookeJ)]),
                pin,
            ),
            FrictionJoint::Pin(Pin::UniversalI, pin) => FrictionJoint::Pin(
                self.numbers
                    .choose(&[(1.0, Pin::UniversalI), (1.0, Pin::UniversalJ)]),
                pin,
            ),
            load => load,
        })
    }
}
