//! What friction remembers of the last accepted step, and the tally of what it did so far.

use friction::Regime;
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

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
    /// Velocity of the sliding surfaces.
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

/// The end of an accepted step.
pub(crate) struct StepEnd {
    pub(crate) time: f64,
    pub(crate) size: f64,
    /// Bristle deflection there.
    pub(crate) deflection: [f64; 3],
    /// Load at the surfaces, force.
    pub(crate) load: f64,
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
            stuck: true,
            displacement,
            rotation: j.axes.transpose() * i.axes,
            anchor: j.axes.transpose() * i.axes,
            initial_displacement: Equation::Along(2).value(&Pair::new(i, j), &[]),
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
    ///
    /// Stick that begins within the step is anchored where the speed fell below the transition
    /// velocity, found with the velocity taken linear over the step; the law gives creep a weight
    /// there that vanishes with the third power of the distance to that velocity.
    pub(crate) fn accept(
        &mut self,
        friction: &Friction,
        i: &MarkerFrame,
        j: &MarkerFrame,
        end: &StepEnd,
    ) {
        let velocity = surface_velocity(friction, i, j);
        let slip = self.slip(friction, i, j);
        let stuck = friction.law.regime(norm(&velocity)) == Regime::Stuck;
        let creep = match &friction.law {
            Law::Original(law) => {
                let creep = if self.stuck {
                    std::array::from_fn(|k| self.creep[k] + slip[k])
                } else {
                    self.first_creep(law.transition_velocity, &velocity, end.size)
                };
                law.settle(&velocity, creep)
            }
            Law::LuGre(_) => [0.0; 3],
        };
        self.count(friction, &velocity, &slip, stuck, &creep, end);
        if !(self.stuck && stuck) {
            self.anchor = j.axes.transpose() * i.axes;
        }
        self.stuck = stuck;
        self.creep = creep;
        self.deflection = end.deflection;
        self.largest_load = self.largest_load.max(end.load);
        self.rotation = j.axes.transpose() * i.axes;
        self.velocity = velocity;
        for (k, equation) in freedoms(&friction.load).iter().enumerate() {
            let value = equation.value(&Pair::new(i, j), &[]);
            self.displacement[k] += self.change(*equation, k, value);
        }
    }

    /// Counts what happened in a step, before it is taken over.
    fn count(
        &mut self,
        friction: &Friction,
        velocity: &[f64; 3],
        slip: &[f64; 3],
        stuck: bool,
        creep: &[f64; 3],
        end: &StepEnd,
    ) {
        let limit = match &friction.law {
            Law::Original(law) => law.transition_velocity,
            Law::LuGre(law) => law.stribeck_velocity,
        };
        let tally = &mut self.tally;
        let was_stuck = tally.sticking;
        tally.sticking = stuck;
        // The velocity is taken linear over the step, as for the creep.
        let part = crossing(&self.velocity, velocity, limit, was_stuck).unwrap_or(0.0);
        let change = end.time - end.size * (1.0 - part);
        match (was_stuck, stuck) {
            (true, true) => tally.stuck_time += end.size,
            (false, false) => {}
            (true, false) => {
                tally.stuck_time += end.size * part;
                tally.stick_end = Some(change);
                tally.longest_stick = tally.longest_stick.max(change - tally.stick_start);
            }
            (false, true) => {
                tally.stuck_time += end.size * (1.0 - part);
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
                let speed = norm(velocity);
                let level = law.stribeck(speed).0 * end.load;
                if tally.not_passive.is_none() && level > 0.0 && speed > law.passive_speed(level) {
                    tally.not_passive = Some(end.time);
                }
            }
        }
    }

    /// Displacement since the speed fell below `limit` within a step.
    fn first_creep(&self, limit: f64, velocity: &[f64; 3], size: f64) -> [f64; 3] {
        let (before, after) = (Vector3::from(self.velocity), Vector3::from(*velocity));
        let Some(s) = crossing(&self.velocity, velocity, limit, false) else {
            return [0.0; 3];
        };
        (0.5 * size * (1.0 - s) * (before + s * (after - before) + after)).into()
    }
}

/// Part of a step after which the speed crosses `limit`, with the velocity linear over the step:
/// upwards the first time, downwards the last. None where it does not.
fn crossing(before: &[f64; 3], after: &[f64; 3], limit: f64, upwards: bool) -> Option<f64> {
    let (before, after) = (Vector3::from(*before), Vector3::from(*after));
    let change = after - before;
    // |before + s change| = limit: outwards at the larger root, inwards at the smaller.
    let (a, b) = (change.norm_squared(), before.dot(&change));
    let root = b * b - a * (before.norm_squared() - limit * limit);
    if !(a > 0.0 && root >= 0.0) {
        return None;
    }
    let sign = if upwards { 1.0 } else { -1.0 };
    Some(((-b + sign * root.sqrt()) / a).clamp(0.0, 1.0))
}
