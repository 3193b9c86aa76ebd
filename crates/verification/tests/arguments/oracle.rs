//! The friction of the driven part by the formulas of the specification, written down apart from the
//! project's code: sections 1.3 to 1.5 (law), 2 and 3 (joints, preload, limits), 4 (bristles), 5
//! (statics).

use friction::parameters::{DefaultValue, JointType, PARAMETERS};

use crate::dataset::{Arguments, BALL_EULER, DRIVE, TORQUE, WEIGHT, Yoke};

/// What is asked for: the joint and the arguments of its friction.
pub(crate) struct Oracle<'a> {
    pub(crate) joint: JointType,
    pub(crate) yoke: Yoke,
    pub(crate) arguments: &'a Arguments,
}

impl Oracle<'_> {
    /// A number, as given or by default.
    fn number(&self, keyword: &str) -> f64 {
        if let Some(text) = self.arguments.get(keyword) {
            return text.parse().expect("a number");
        }
        let parameter = PARAMETERS.iter().find(|p| p.keyword == keyword);
        match parameter.map(|p| p.default) {
            Some(DefaultValue::Number(value)) => value,
            other => panic!("{keyword} has no default number: {other:?}"),
        }
    }

    fn word(&self, keyword: &str) -> &str {
        self.arguments.get(keyword).map_or("", String::as_str)
    }

    /// One where INPUTS has the word.
    fn switch(&self, word: &str) -> f64 {
        let inputs = self.word("INPUTS");
        let on = inputs.is_empty() || inputs == "ALL" || inputs.contains(word);
        if on { 1.0 } else { 0.0 }
    }

    /// Arms of the components: one for sliding, a radius for turning.
    fn arms(&self) -> Vec<f64> {
        match self.joint {
            JointType::Translational => vec![1.0],
            JointType::Cylindrical => vec![1.0, self.number("PIN_RADIUS")],
            JointType::Spherical => vec![self.number("BALL_RADIUS")],
            _ => vec![self.number("PIN_RADIUS")],
        }
    }

    /// Surface velocity after a time: every component grows evenly.
    fn velocity(&self, time: f64) -> Vec<f64> {
        let [along, about] = DRIVE;
        let arms = self.arms();
        match self.joint {
            JointType::Translational => vec![along * time],
            JointType::Cylindrical => vec![along * time, about * arms[1] * time],
            _ => vec![about * arms[0] * time],
        }
    }

    /// Load as a force at the surfaces.
    fn load(&self, time: f64) -> f64 {
        let size = |x: f64, y: f64| x.hypot(y);
        let [x, y, z] = WEIGHT;
        let (force, bending) = (self.switch("REACTION_FORCE"), self.switch("BENDING_MOMENT"));
        let pin = |radial: f64, axial: f64, moment: f64| {
            let radius = self.number("PIN_RADIUS");
            let reaction = radius * radial + self.number("FRICTION_ARM") * axial;
            let moment = radius / self.number("BENDING_REACTION_ARM") * moment;
            (force * reaction + bending * moment) / radius
        };
        match self.joint {
            JointType::Translational | JointType::Cylindrical => {
                let travel = 0.5 * DRIVE[0] * time * time;
                let sign = match self.word("OVERLAP_DELTA") {
                    "INCREASE" => 1.0,
                    "DECREASE" => -1.0,
                    _ => 0.0,
                };
                let overlap = self.number("INITIAL_OVERLAP") + sign * travel;
                let moment = self.number("BENDING_FACTOR") * size(TORQUE[0], TORQUE[1]) / overlap;
                let torsion = if self.joint == JointType::Translational {
                    self.switch("TORSIONAL_MOMENT") * TORQUE[2].abs() / self.number("REACTION_ARM")
                } else {
                    0.0
                };
                force * size(x, y) + bending * moment + torsion
            }
            JointType::Revolute => pin(size(x, y), z.abs(), size(TORQUE[0], TORQUE[1])),
            JointType::Spherical => force * size(size(x, y), z),
            // The cross carries the torque at right angles to both pins, which turns with the part.
            JointType::Hooke | JointType::Universal => match self.yoke {
                Yoke::I => pin(size(y, z), x.abs(), TORQUE[2].abs()),
                Yoke::J => {
                    let (sine, cosine) = (0.5 * DRIVE[1] * time * time).sin_cos();
                    let moment = TORQUE[0] * sine + TORQUE[2] * cosine;
                    pin(size(x, z), y.abs(), moment.abs())
                }
            },
        }
    }

    /// Preload and limit of each component, as forces or torques.
    fn preload_and_limit(&self) -> Vec<[f64; 2]> {
        let on = self.switch("PRELOAD");
        let force = || {
            [
                on * self.number("FRICTION_FORCE_PRELOAD"),
                self.number("MAX_FRICTION_FORCE"),
            ]
        };
        let torque = || {
            [
                on * self.number("FRICTION_TORQUE_PRELOAD"),
                self.number("MAX_FRICTION_TORQUE"),
            ]
        };
        match self.joint {
            JointType::Translational => vec![force()],
            JointType::Cylindrical => vec![force(), torque()],
            _ => vec![torque()],
        }
    }

    /// Coefficient and use of the preload by the original law, both opposite to the motion, which
    /// never turns back: velocity and creep have one direction.
    fn original(&self, speed: f64, travel: f64) -> [f64; 2] {
        let (mu_s, mu_d) = (self.number("MU_STATIC"), self.number("MU_DYNAMIC"));
        let vs = self.number("STICTION_TRANSITION_VELOCITY");
        let fast = self.number("TRANSITION_VELOCITY_COEFFICIENT") * vs;
        let s = (speed / vs).min(1.0);
        let beta = psi(s);
        let hold =
            beta + (1.0 - beta) * psi((travel / self.number("MAX_STICTION_DEFORMATION")).min(1.0));
        match self.word("EFFECT") {
            "SLIDING" => [mu_d * beta, beta],
            "STICTION" => [mu_s * hold, hold],
            _ if speed < vs => [mu_s * hold, hold],
            _ if speed < fast => {
                let s = (speed - vs) / (fast - vs);
                [
                    mu_s + (mu_d - mu_s) * s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s),
                    1.0,
                ]
            }
            _ => [mu_d, 1.0],
        }
    }

    /// Sizes of the friction of every component, against its motion, at the times.
    pub(crate) fn friction(&self, times: &[f64]) -> Vec<Vec<f64>> {
        let bristles = self.word("FORMULATION") == "LUGRE";
        if bristles {
            self.lugre(times)
        } else {
            times.iter().map(|t| self.sliding(*t)).collect()
        }
    }

    fn sliding(&self, time: f64) -> Vec<f64> {
        let velocity = self.velocity(time);
        let speed = velocity.iter().fold(0.0, |m: f64, v| m.hypot(*v));
        let [mu, hold] = self.original(speed, 0.5 * speed * time);
        let load = self.load(time);
        let parts = velocity
            .iter()
            .zip(self.arms())
            .zip(self.preload_and_limit());
        let friction = parts.map(|((v, arm), [preload, limit])| {
            let share = v / speed;
            (arm * load * mu * share).min(limit) + preload * hold * share
        });
        friction.collect()
    }

    /// Level and surface velocity of each component of the bristles.
    fn levels(&self, time: f64) -> (Vec<f64>, Vec<f64>, f64) {
        let velocity = self.velocity(time);
        let speed = velocity.iter().fold(0.0, |m: f64, v| m.hypot(*v));
        let (mu_s, mu_d) = (self.number("MU_STATIC"), self.number("MU_DYNAMIC"));
        let ratio = speed / self.number("VELOCITY_THRESHOLD_STRIBECK");
        let decay = (-ratio.powf(self.number("DECAY_EXPONENT_STRIBECK"))).exp();
        let curve = mu_d + (mu_s - mu_d) * decay;
        let preloads = self.preload_and_limit();
        let parts = preloads.iter().zip(self.arms());
        let levels = parts.map(|([preload, _], arm)| curve * self.load(time) + preload / arm);
        (levels.collect(), velocity, speed)
    }

    fn deflection_rates(&self, time: f64, z: &[f64]) -> Vec<f64> {
        let (levels, velocity, speed) = self.levels(time);
        let s0 = self.number("BRISTLE_STIFFNESS_COEFFICIENT");
        let parts = z.iter().zip(levels).zip(velocity);
        parts
            .map(|((z, level), v)| v - s0 * speed * z / level)
            .collect()
    }

    /// Deflections at the rising times, by Runge and Kutta's formula.
    fn deflections(&self, times: &[f64]) -> Vec<Vec<f64>> {
        let mut z = vec![0.0; self.arms().len()];
        let (mut now, mut seen) = (0.0, Vec::new());
        let ahead = |z: &[f64], h: f64, rate: &[f64]| -> Vec<f64> {
            z.iter().zip(rate).map(|(z, r)| z + h * r).collect()
        };
        for &time in times {
            let steps = 400;
            let h = (time - now) / f64::from(steps);
            for _ in 0..steps {
                let a = self.deflection_rates(now, &z);
                let b = self.deflection_rates(now + 0.5 * h, &ahead(&z, 0.5 * h, &a));
                let c = self.deflection_rates(now + 0.5 * h, &ahead(&z, 0.5 * h, &b));
                let d = self.deflection_rates(now + h, &ahead(&z, h, &c));
                for k in 0..z.len() {
                    z[k] += h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
                }
                now += h;
            }
            now = time;
            seen.push(z.clone());
        }
        seen
    }

    fn lugre(&self, times: &[f64]) -> Vec<Vec<f64>> {
        let s0 = self.number("BRISTLE_STIFFNESS_COEFFICIENT");
        let (s1, s2) = (
            self.number("DAMPING_COEFFICIENT"),
            self.number("VISCOUS_FRICTION_COEFFICIENT"),
        );
        let deflections = self.deflections(times);
        let at = |(time, z): (&f64, &Vec<f64>)| {
            let (rates, velocity) = (self.deflection_rates(*time, z), self.velocity(*time));
            let limits = self.arms().into_iter().zip(self.preload_and_limit());
            let parts = limits.zip(z).zip(rates.iter().zip(velocity));
            let friction = parts.map(|(((arm, [preload, limit]), z), (rate, v))| {
                (arm * (s0 * z + s1 * rate + s2 * v)).min(limit + preload)
            });
            friction.collect()
        };
        times.iter().zip(&deflections).map(at).collect()
    }

    /// Friction of an equilibrium at the place reached at a time below Vs: creep and bristles hold.
    pub(crate) fn at_rest(&self, time: f64) -> Vec<f64> {
        if !self.word("INACTIVE").is_empty() {
            return vec![0.0; self.arms().len()];
        }
        if self.word("FORMULATION") == "LUGRE" {
            let s0 = self.number("BRISTLE_STIFFNESS_COEFFICIENT");
            let z = self.deflections(&[time]);
            return z[0]
                .iter()
                .zip(self.arms())
                .map(|(z, arm)| arm * s0 * z)
                .collect();
        }
        let velocity = self.velocity(time);
        let speed = velocity.iter().fold(0.0, |m: f64, v| m.hypot(*v));
        let hold = psi(0.5 * speed * time / self.number("MAX_STICTION_DEFORMATION"));
        let load = self.number("MU_STATIC") * self.load(time);
        let parts = velocity
            .iter()
            .zip(self.arms())
            .zip(self.preload_and_limit());
        let friction =
            parts.map(|((v, arm), [preload, _])| hold * (arm * load + preload) * v / speed);
        friction.collect()
    }

    /// Friction force and torque on the part, ground axes, of sizes against the motion.
    pub(crate) fn wrench(&self, sizes: &[f64]) -> [f64; 6] {
        let [psi, theta] = BALL_EULER.map(f64::to_radians);
        let axis = match (self.joint, self.yoke) {
            (JointType::Spherical, _) => [
                psi.sin() * theta.sin(),
                -psi.cos() * theta.sin(),
                theta.cos(),
            ],
            (JointType::Hooke | JointType::Universal, Yoke::I) => [1.0, 0.0, 0.0],
            (JointType::Hooke | JointType::Universal, Yoke::J) => [0.0, 1.0, 0.0],
            _ => [0.0, 0.0, 1.0],
        };
        let (force, torque) = match self.joint {
            JointType::Translational => (sizes[0], 0.0),
            JointType::Cylindrical => (sizes[0], sizes[1]),
            _ => (0.0, sizes[0]),
        };
        let [x, y, z] = axis;
        [0.0, 0.0, -force, -torque * x, -torque * y, -torque * z]
    }
}

/// The odd quintic step of the law.
fn psi(s: f64) -> f64 {
    (15.0 * s - 10.0 * s.powi(3) + 3.0 * s.powi(5)) / 8.0
}
