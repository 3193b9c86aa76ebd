//! Frictions at the end of a step, and the bristle deflections of LuGre: states of the integrator that
//! the step equations leave out.

use friction::Regime;
use nalgebra::Vector3;

use super::System;
use crate::joint_friction::{BristlePast, StepEnd};
use crate::model::Law;

/// Error of the deflection that a step may make, relative to that of the largest load: in units of the
/// tolerance and at least while it sticks, and plainly where it slides (docs/decisions/0006).
const STICKING_PART: f64 = 30.0;
const LEAST_PART: f64 = 1e-6;
const SLIDING_PART: f64 = 0.01;

impl System {
    /// Number of bristle deflections: one by component of the surfaces of each LuGre friction.
    #[must_use]
    pub fn bristle_count(&self) -> usize {
        (0..self.model.frictions.len())
            .map(|place| self.bristles_of(place))
            .sum()
    }

    /// The friction that a deflection belongs to.
    pub(crate) fn friction_of_bristle(&self, deflection: usize) -> usize {
        let mut end = 0;
        (0..self.model.frictions.len())
            .find(|&place| {
                end += self.bristles_of(place);
                deflection < end
            })
            .expect("every deflection belongs to a friction")
    }

    fn bristles_of(&self, friction: usize) -> usize {
        let friction = &self.model.frictions[friction];
        match friction.law {
            Law::LuGre(_) => friction.load.components(),
            Law::Original(_) => 0,
        }
    }

    /// Says what the integrator's formula gives of the deflections, `z = past + gamma z'`; with
    /// `gamma = 0` they are `past`.
    pub(crate) fn set_bristles(&mut self, past: &[f64], gamma: f64) {
        let mut first = 0;
        for place in 0..self.model.frictions.len() {
            let count = self.bristles_of(place);
            let bristles = &mut self.bristles[place];
            bristles.gamma = gamma;
            bristles.past[..count].copy_from_slice(&past[first..first + count]);
            first += count;
        }
    }

    /// Takes every friction at the instant evaluated last with its multipliers, for all that is read of
    /// them there: powers, bristles, and what an accepted step leaves behind.
    pub(crate) fn take_frictions(&mut self, multipliers: &[f64]) {
        self.friction_ends.clear();
        for place in 0..self.model.frictions.len() {
            let element = self.friction(place, multipliers);
            self.friction_ends.push(StepEnd {
                time: self.inputs.time,
                velocity: element.velocity,
                creep: element.creep,
                deflection: element.deflection,
                deflection_rate: element.deflection_rate,
                regime: element.regime,
                load: self.model.frictions[place].surface_load(&element.load),
                power: element.power,
            });
        }
    }

    /// Writes the deflections and their rates where frictions were taken last, as wanted.
    pub(crate) fn write_bristles(
        &self,
        deflections: Option<&mut [f64]>,
        rates: Option<&mut [f64]>,
    ) {
        let (mut deflections, mut rates) = (deflections, rates);
        let mut first = 0;
        for place in 0..self.model.frictions.len() {
            let count = self.bristles_of(place);
            if count == 0 {
                continue;
            }
            let end = &self.friction_ends[place];
            if let Some(out) = deflections.as_deref_mut() {
                out[first..first + count].copy_from_slice(&end.deflection[..count]);
            }
            if let Some(out) = rates.as_deref_mut() {
                out[first..first + count].copy_from_slice(&end.deflection_rate[..count]);
            }
            first += count;
        }
    }

    /// Writes the largest error of the deflections that a step may make where frictions were taken last,
    /// for the error `tolerance`: a part of the deflection of the largest load, the larger the less of
    /// its past a step takes over, and at least `tolerance` of the largest friction of all: where a joint
    /// has no load to speak of, its own is rounding. `rough` is the part of the largest load below which
    /// nothing is known of reactions, and so of deflections.
    pub(crate) fn write_bristle_errors(&self, tolerance: f64, rough: f64, errors: &mut [f64]) {
        let levels = self.model.frictions.iter().zip(&self.history.frictions);
        let largest = levels.fold(0.0_f64, |most, (friction, memory)| match &friction.law {
            Law::LuGre(law) => most.max(law.mu_static * memory.largest_load),
            Law::Original(_) => most,
        });
        let mut first = 0;
        for (place, friction) in self.model.frictions.iter().enumerate() {
            let count = self.bristles_of(place);
            if let Law::LuGre(law) = &friction.law {
                let end = &self.friction_ends[place];
                let load = end.load;
                let level = law.mu_static * load.max(self.history.frictions[place].largest_load);
                let part = match end.regime {
                    Regime::Stuck => (STICKING_PART * tolerance).max(LEAST_PART),
                    _ => SLIDING_PART,
                } + rough;
                // What a step takes over of the past deflection: G/(G + γ s0 v).
                let speed = Vector3::from(end.velocity).norm();
                let present = law.stribeck(speed).0 * load;
                let pull = self.bristles[place].gamma * law.bristle_stiffness * speed;
                let kept = if present > 0.0 {
                    present / (present + pull)
                } else {
                    0.0
                };
                errors[first..first + count].fill(if kept > 0.0 {
                    (part * level).max(tolerance * largest) / (law.bristle_stiffness * kept)
                } else {
                    f64::INFINITY
                });
            }
            first += count;
        }
    }

    /// Takes over the instant at which frictions were taken last as the end of an accepted step.
    pub(crate) fn accept_frictions(&mut self) {
        for place in 0..self.model.frictions.len() {
            if !self.friction_acts(place) {
                // What rests begins anew: stuck without creep where the joint stands.
                let fresh = self.fresh_memory(place);
                self.history.frictions[place] = self.history.frictions[place].renewed(fresh);
                continue;
            }
            let joint = &self.model.joints[self.model.frictions[place].joint];
            let [i, j] = [joint.i, joint.j].map(|marker| self.markers.get(marker));
            let (friction, end) = (&self.model.frictions[place], &self.friction_ends[place]);
            self.history.frictions[place].accept(friction, i, j, end);
        }
    }

    /// Raises the largest loads so far to those where frictions were taken last.
    pub(crate) fn observe_loads(&mut self) {
        let ends = self.friction_ends.iter();
        for (memory, end) in self.history.frictions.iter_mut().zip(ends) {
            memory.largest_load = memory.largest_load.max(end.load);
        }
    }

    /// What is known of the bristles of a friction.
    pub(super) fn bristle_past(&self, friction: usize) -> &BristlePast {
        &self.bristles[friction]
    }
}
