//! What friction remembers of the last accepted step, and the tally of what it did so far.

use friction::Regime;
use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};

use super::course::Course;
use super::response::norm;
use super::{freedoms, surface_velocity};
use crate::equation::{Equation, Pair};
use crate::model::{Friction, Law};
use crate::rotation::log;
use crate::state::MarkerFrame;

/// What friction remembers of the last accepted step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// Creep by component, of a spherical joint along the axes of J.
    pub creep: [f64; 3],
    /// Whether the joint was stuck, so that creep goes on from there.
    pub stuck: bool,
    /// Values of the equations of the joint's freedoms, angles over many turns.
    pub(super) displacement: [f64; 2],
    /// Rotation of I against J, of the spherical joint: axes of I along axes of J.
    pub(super) rotation: Matrix3<f64>,
    /// The same where the stick began, or now while sliding: the frame of printed vectors.
    pub(super) anchor: Matrix3<f64>,
    /// Displacement along z of J at the first assembly, from which the overlap counts.
    pub(super) initial_displacement: f64,
    /// Time, and velocity of the sliding surfaces there.
    time: f64,
    velocity: [f64; 3],
    /// Bristle deflection.
    deflection: [f64; 3],
    /// Largest load at the surfaces so far, force: the scale of the bristles.
    pub(crate) largest_load: f64,
    /// What the friction did so far.
    pub tally: Tally,
}

/// What a friction did so far, step by step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    /// Whether it sticks now.
    pub sticking: bool,
    /// Number of stick intervals that have begun, one at the start among them.
    pub sticks: usize,
    /// When the present or last stick began.
    pub stick_start: f64,
    /// When the last complete stick ended.
    pub stick_end: Option<f64>,
    /// Time spent sticking.
    pub stuck_time: f64,
    /// Length of the longest stick that has ended.
    pub longest_stick: f64,
    /// Largest creep, or largest bristle deflection of LuGre.
    pub largest_creep: f64,
    /// How far the surfaces moved while they stuck beyond what the bristles gave way: the drift of
    /// LuGre, by component.
    pub drift: [f64; 3],
    /// First time at which LuGre was faster than its friction is sure to take energy out.
    pub not_passive: Option<f64>,
}

/// The end of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepEnd {
    pub(crate) time: f64,
    /// Velocity of the sliding surfaces there.
    pub(crate) velocity: [f64; 3],
    /// Creep, before it is limited.
    pub(crate) creep: [f64; 3],
    /// Bristle deflection, and its rate.
    pub(crate) deflection: [f64; 3],
    pub(crate) deflection_rate: [f64; 3],
    pub(crate) regime: Regime,
    /// Load at the surfaces, force.
    pub(crate) load: f64,
    /// Rate at which the friction takes energy out of the motion.
    pub(crate) power: f64,
}

impl Memory {
    /// Stuck without creep where the joint stands, at a time.
    pub(crate) fn at(friction: &Friction, time: f64, i: &MarkerFrame, j: &MarkerFrame) -> Self {
        let mut displacement = [0.0; 2];
        for (value, equation) in displacement.iter_mut().zip(freedoms(&friction.load)) {
            *value = equation.value(&Pair::new(i, j), &[]);
        }
        let velocity = surface_velocity(friction, i, j);
        let moves = friction.law.regime(norm(&velocity)) != Regime::Stuck;
        Self {
            creep: [0.0; 3],
            stuck: !moves,
            displacement,
            rotation: j.axes.transpose() * i.axes,
            anchor: j.axes.transpose() * i.axes,
            initial_displacement: Equation::Along(2).value(&Pair::new(i, j), &[]),
            time,
            velocity,
            deflection: [0.0; 3],
            largest_load: 0.0,
            tally: Tally {
                sticking: !moves,
                sticks: usize::from(!moves),
                stick_start: time,
                ..Tally::default()
            },
        }
    }

    /// Takes the past of `other` but not its overlap and tally: friction that begins anew during a
    /// run keeps what belongs to the joint and to the whole run.
    pub(crate) fn renewed(&self, fresh: Self) -> Self {
        Self {
            initial_displacement: self.initial_displacement,
            largest_load: self.largest_load,
            tally: self.tally,
            ..fresh
        }
    }

    /// Displacement of the surfaces since the last accepted step.
    fn slip(&self, friction: &Friction, i: &MarkerFrame, j: &MarkerFrame) -> [f64; 3] {
        let arm = friction.load.arm();
        let equations = freedoms(&friction.load);
        if equations.is_empty() {
            let turned = j.axes.transpose() * i.axes * self.rotation.transpose();
            return (arm * log(&turned)).into();
        }
        let mut slip = [0.0; 3];
        for (k, equation) in equations.iter().enumerate() {
            let value = equation.value(&Pair::new(i, j), &[]);
            slip[k] = equation.arm(arm) * self.change(*equation, k, value);
        }
        slip
    }

    /// Change of the displacement of a freedom; an angle by less than half a turn since the last
    /// step.
    pub(super) fn change(&self, equation: Equation, freedom: usize, value: f64) -> f64 {
        let change = value - self.displacement[freedom];
        match equation {
            Equation::About(_) => {
                change - std::f64::consts::TAU * (change / std::f64::consts::TAU).round()
            }
            _ => change,
        }
    }

    /// Takes over an accepted step that ended at the frames of I and J.
    pub(crate) fn accept(
        &mut self,
        friction: &Friction,
        i: &MarkerFrame,
        j: &MarkerFrame,
        end: &StepEnd,
    ) {
        let stuck = friction.law.regime(norm(&end.velocity)) == Regime::Stuck;
        let creep = match &friction.law {
            Law::Original(law) => law.settle(&end.velocity, end.creep),
            Law::LuGre(_) => [0.0; 3],
        };
        let slip = match (self.tally.sticking, stuck, &friction.law) {
            // Nothing is counted that asks for it.
            (false, false, _) | (true, true, Law::Original(_)) => [0.0; 3],
            _ => self.slip(friction, i, j),
        };
        self.count(friction, &slip, stuck, &creep, end);
        self.rotation = j.axes.transpose() * i.axes;
        if !(self.stuck && stuck) {
            self.anchor = self.rotation;
        }
        self.stuck = stuck;
        self.creep = creep;
        self.deflection = end.deflection;
        self.largest_load = self.largest_load.max(end.load);
        (self.time, self.velocity) = (end.time, end.velocity);
        for (k, equation) in freedoms(&friction.load).iter().enumerate() {
            let value = equation.value(&Pair::new(i, j), &[]);
            self.displacement[k] += self.change(*equation, k, value);
        }
    }

    /// Counts what happened in a step, before it is taken over.
    fn count(
        &mut self,
        friction: &Friction,
        slip: &[f64; 3],
        stuck: bool,
        creep: &[f64; 3],
        end: &StepEnd,
    ) {
        let limit = match &friction.law {
            Law::Original(law) => law.transition_velocity,
            Law::LuGre(law) => law.stribeck_velocity,
        };
        let size = end.time - self.time;
        let course = self.course(end.time, slip, &end.velocity);
        let part = course.crossing(size * limit).unwrap_or(0.0);
        let change = end.time - size * (1.0 - part);
        let tally = &mut self.tally;
        let was_stuck = std::mem::replace(&mut tally.sticking, stuck);
        match (was_stuck, stuck) {
            (true, true) => tally.stuck_time += size,
            (false, false) => {}
            (true, false) => {
                tally.stuck_time += size * part;
                tally.stick_end = Some(change);
                tally.longest_stick = tally.longest_stick.max(change - tally.stick_start);
            }
            (false, true) => {
                tally.stuck_time += size * (1.0 - part);
                tally.sticks += 1;
                tally.stick_start = change;
            }
        }
        match &friction.law {
            Law::Original(_) => tally.largest_creep = tally.largest_creep.max(norm(creep)),
            Law::LuGre(law) => {
                tally.largest_creep = tally.largest_creep.max(norm(&end.deflection));
                if was_stuck && stuck {
                    for k in 0..3 {
                        tally.drift[k] += slip[k] - (end.deflection[k] - self.deflection[k]);
                    }
                }
                let speed = norm(&end.velocity);
                let level = law.stribeck(speed).0 * end.load;
                if tally.not_passive.is_none() && level > 0.0 && speed > law.passive_speed(level) {
                    tally.not_passive = Some(end.time);
                }
            }
        }
    }

    /// How the surfaces move from the last accepted step to a time, by `slip` and to a velocity.
    fn course<const N: usize>(&self, time: f64, slip: &[f64; N], velocity: &[f64; N]) -> Course<N> {
        let size = time - self.time;
        Course {
            slip: *slip,
            rates: [
                std::array::from_fn(|k| size * self.velocity[k]),
                velocity.map(|v| size * v),
            ],
        }
    }

    /// Creep of ORIGINAL friction at a time of the present step, from the slip and to the velocity of the
    /// surfaces; none where they do not stick, or no creep matters.
    ///
    /// Stick that begins within the step is anchored where the speed falls below the transition
    /// velocity (`course.rs`).
    pub(super) fn creep_at<const N: usize>(
        &self,
        friction: &Friction,
        time: f64,
        slip: impl FnOnce() -> [f64; N],
        velocity: &[f64; N],
    ) -> Option<Creep<N>> {
        let Law::Original(law) = &friction.law else {
            return None;
        };
        if self.stuck {
            let slip = slip();
            return Some(Creep {
                value: std::array::from_fn(|k| self.creep[k] + slip[k]),
                by_slip: std::array::from_fn(|i| std::array::from_fn(|k| f64::from(i == k))),
                by_velocity: [[0.0; N]; N],
            });
        }
        if law.regime(norm(velocity)) != Regime::Stuck {
            return None;
        }
        let size = time - self.time;
        let course = self.course(time, &slip(), velocity);
        let first = course.first_creep(size * law.transition_velocity)?;
        Some(Creep {
            value: first.creep,
            by_slip: first.by_slip,
            by_velocity: first.by_rate.map(|row| row.map(|d| size * d)),
        })
    }
}

/// Creep with its derivatives: row a component of the creep, column one of slip or velocity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Creep<const N: usize> {
    pub(super) value: [f64; N],
    pub(super) by_slip: [[f64; N]; N],
    pub(super) by_velocity: [[f64; N]; N],
}
