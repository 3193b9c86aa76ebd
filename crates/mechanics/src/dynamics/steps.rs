//! A step as the integrator asks for it: attempts from cheap to sure, the error test, and what an
//! accepted step leaves behind.

use std::ops::Range;

use numerics::bdf::{self, Verdict, Within};

use super::scales::raise;
use super::{Dynamics, INDEX3_STEPS, Index, MatrixUse};
use crate::instant::Failure;
use crate::state::POSITIONS;

/// A kept Newton matrix serves while γ stays within this part of its own.
const GAMMA_RANGE: f64 = 0.25;
/// A kept Newton matrix is renewed when the iteration got slower than this.
const SLOW_RATE: f64 = 0.07;

impl bdf::System for Dynamics {
    type Failure = Failure;

    fn solve(&mut self, step: &bdf::Step<'_>, y: &mut [f64]) -> Result<(), Failure> {
        self.switching.attempt(step.size, self.steps[1]);
        self.step_size = step.size;
        self.left_of_velocities = self.left_of_velocities(step);
        let stale = self
            .factored
            .is_none_or(|gamma| (step.gamma / gamma - 1.0).abs() > GAMMA_RANGE);
        // Iterations whose number is fixed do not tell how fast they converge.
        let unfit = stale
            || self.rate > SLOW_RATE
            || self.switching.slides()
            || self.corrector.fixed.is_some();
        let mut usage = match self.corrector.pattern {
            Some(pattern) => MatrixUse::Patterned {
                pattern,
                first: unfit,
            },
            None if unfit => MatrixUse::Renewed,
            None => MatrixUse::Kept,
        };
        self.present = if self.index3_left > 0 {
            Index::Three
        } else {
            self.formulation.index()
        };
        loop {
            let solved = self.load(step, y, usage);
            let Err(failure) = solved.and_then(|()| self.newton(step, usage)) else {
                break;
            };
            usage = match (usage, &failure) {
                (MatrixUse::Kept, _) => MatrixUse::Renewed,
                (
                    MatrixUse::Renewed | MatrixUse::Patterned { .. },
                    Failure::NotConverged { .. },
                ) => MatrixUse::RenewedAlways,
                // Where the mechanism passes a position at which constraints depend on others,
                // velocity constraints are nearly singular, positions alone are not.
                (_, Failure::NotConverged { .. } | Failure::Singular(_))
                    if self.present == Index::StabilisedTwo =>
                {
                    self.present = Index::Three;
                    self.index3_left = INDEX3_STEPS;
                    MatrixUse::Renewed
                }
                _ => {
                    self.rate = 1.0;
                    self.factored = None;
                    return Err(failure);
                }
            };
        }
        if self.present != self.formulation.index() {
            self.work.index3_steps += 1;
            self.index3_left -= 1;
            if self.index3_left == 0 {
                // The matrix does not fit the next step.
                self.factored = None;
            }
        }
        for (multiplier, impulse) in self.multipliers.iter_mut().zip(&self.impulses) {
            *multiplier = impulse / step.gamma;
        }
        self.complete(step);
        y.copy_from_slice(&self.state.values);
        Ok(())
    }

    fn norm(&mut self, difference: &[f64]) -> f64 {
        self.largest_error(difference).0
    }

    fn slope(&self, step: &bdf::Step<'_>, y: &[f64], slope: &mut [f64]) {
        step.write_slope(y, slope);
        self.state.write_position_slopes(y, slope);
        slope[self.state.rate_range()].copy_from_slice(&self.rates);
        slope[self.state.work_range()].copy_from_slice(&self.powers);
    }

    fn positions(&self) -> Range<usize> {
        0..POSITIONS * self.state.bodies()
    }

    fn curvature(&self, y: &[f64], slope: &[f64], curvature: &mut [f64]) {
        self.state.write_position_curvatures(y, slope, curvature);
    }

    fn judge(&mut self, step: &bdf::Step<'_>, values: &[f64], within: Within<'_>) -> Verdict {
        if self.switching.is_empty() {
            return Verdict::Accept;
        }
        let mut switching = std::mem::take(&mut self.switching);
        let verdict = switching.judge(self, step, values, within);
        self.switching = switching;
        verdict
    }

    fn accepted(&mut self, step: &bdf::Step<'_>, _: &[f64]) {
        // The step solved last is the one accepted: everything is evaluated there.
        self.quadrature
            .accept(step.time, self.state.works(), &self.powers);
        self.past_multipliers.push(step.time, &self.multipliers);
        if self.formulation.alpha() != 0.0 {
            // M u̇/(1 + α) = F + lag (F₀ + (M − M₀) u̇₀) has been solved.
            self.system.mass_times(&self.rates, &mut self.momentum);
            self.system
                .mass_times(&self.past_rates, &mut self.past_inertia);
            let (inertia, lag) = (self.inertia_part(), self.lag());
            let before = self.past_force.iter_mut().zip(&self.past_inertia);
            for ((force, past), now) in before.zip(&self.momentum) {
                *force = inertia * now - lag * (*force + past) - now;
            }
            self.past_rates.copy_from_slice(&self.rates);
            let solved = self.state.values[self.state.bristle_range()].iter();
            let rates = self.past_bristle_rates.iter_mut();
            for (rate, (deflection, past)) in rates.zip(solved.zip(&self.bristle_past)) {
                *rate = (deflection - past) * inertia / step.gamma;
            }
        }
        self.previous.clone_from(&self.system.history.frictions);
        self.system.accept_frictions();
        self.system.remember_angles();
        self.scales.observe(self.state.velocities());
        raise(&mut self.state_scales, self.state.states());
        if !self.switching.is_empty() {
            self.switching.accepted(&mut self.system);
            self.switching
                .begin(self.rates.iter().copied(), &self.multipliers);
        }
    }
}
