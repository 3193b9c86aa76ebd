//! Jumps that cannot be told from the error that a step may make.
//!
//! What a jump does within a time follows from the equations of the step that met it: with the switch on
//! one side and on the other their residuals differ, and the Newton matrix tells the change of
//! velocities and states that goes with it. A jump that stays below a part of the tolerance for as long as
//! the longest step is not met: the switch goes over after the step. Of stairs, which jump again and
//! again, the time between two jumps counts: where one is that small, they are taken as the line through
//! the middle of them.

use numerics::bdf;
use serde::{Deserialize, Serialize};

use super::Switching;
use crate::dynamics::Dynamics;
use crate::expression::Branch;
use crate::system::SwitchPlace;

/// Part of the tolerance below which a jump is not met.
const DULL: f64 = 0.1;

/// What the jump of stairs did where they became a line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Effect {
    /// In units of the tolerance.
    error: f64,
    jump: f64,
    time: f64,
}

impl Effect {
    /// At most what another jump does in another time: velocities go with the time, places with its
    /// square.
    fn scaled(&self, jump: f64, time: f64) -> f64 {
        let longer = time / self.time;
        self.error * (jump / self.jump) * longer.max(longer * longer)
    }
}

impl Switching {
    /// Looks at the switches that have left their cell in a step that is evaluated at its end: those
    /// whose jump does nothing are passed over. Whether the step is to be solved again, for stairs have
    /// become a line.
    pub(super) fn pass_over(&mut self, dynamics: &mut Dynamics, step: &bdf::Step<'_>) -> bool {
        let mut again = false;
        for k in 0..self.switches.len() {
            let left = self.left_for(k, &dynamics.system).is_some();
            let Branch::Held(cell) = self.switches[k].branch else {
                continue;
            };
            if !(self.switches[k].may_be_dull && (left || self.excursions[k].is_some())) {
                continue;
            }
            let (jump, time) = (self.readings[k].jump, self.time_in_cell(k, dynamics));
            let place = self.switches[k].place;
            let error = dynamics.jump_error(place, cell, step, time);
            if !(error <= DULL) {
                continue;
            }
            if self.switches[k].stairs {
                self.switches[k].effect = Some(Effect { error, jump, time });
                self.set_branch(k, Branch::Even, &mut dynamics.system);
                again = true;
            } else {
                self.switches[k].passed_over = true;
            }
            self.excursions[k] = None;
        }
        again
    }

    /// How long a jump of a switch lasts, at most.
    fn time_in_cell(&self, k: usize, dynamics: &Dynamics) -> f64 {
        let longest = dynamics.steps[1];
        if self.switches[k].stairs {
            self.ends[k].rate.abs().recip().min(longest)
        } else {
            longest
        }
    }

    /// Stairs whose single steps show again are met again.
    pub(super) fn look_at_lines(&mut self, dynamics: &mut Dynamics) {
        for k in 0..self.switches.len() {
            let time = self.time_in_cell(k, dynamics);
            let (switch, reading) = (&self.switches[k], self.readings[k]);
            let Some(effect) = switch.effect.filter(|_| switch.branch == Branch::Even) else {
                continue;
            };
            // Not from and to at every step.
            if effect.scaled(reading.jump, time) > 10.0 * DULL {
                let cell = dynamics.system.switch_cell(switch.place, reading.argument);
                self.set_branch(k, Branch::Held(cell), &mut dynamics.system);
            }
        }
    }
}

impl Dynamics {
    /// What a switch at the other side of its jump changes in a time, in units of the tolerance; at the
    /// end of a step.
    fn jump_error(
        &mut self,
        place: SwitchPlace,
        cell: f64,
        step: &bdf::Step<'_>,
        time: f64,
    ) -> f64 {
        if self.factored.is_none() {
            return f64::INFINITY;
        }
        let mut known = true;
        let mut side = |cell: f64, dynamics: &mut Self| {
            dynamics.system.set_branch(place, Branch::Held(cell));
            known &= dynamics.residual(step).is_ok();
        };
        let [lower, upper] = self.system.switch_neighbours(place, cell);
        side(lower, self);
        // No position is corrected here: its place keeps the other side.
        self.position_right.copy_from_slice(&self.right);
        side(upper, self);
        self.system.set_branch(place, Branch::Held(cell));
        for (right, lower) in self.right.iter_mut().zip(&self.position_right) {
            *right = (*right - lower) * time / step.gamma;
        }
        let n = self.system.rate_count();
        self.kept_axes.follow(&self.system);
        self.kept_axes.bring_back(&mut self.right[n..]);
        self.factors.solve(&mut self.right);
        self.position_right.fill(0.0);
        if known {
            self.correction_norm(time)
        } else {
            f64::INFINITY
        }
    }
}
