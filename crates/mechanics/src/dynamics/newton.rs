//! The equations of a step and Newton's iteration on them.

use numerics::bdf::{self, Family};

use super::{Dynamics, Formulation, INDEX3_SHARE, Index, MatrixUse};
use crate::instant::Failure;
use crate::model::Level;
use crate::system::{Rows, Weights};

/// Newton stops when what is left is this part of the error tolerance.
const NEWTON_TOLERANCE: f64 = 0.05;
/// The same for index 3, whose velocities and reactions are what is left divided by the step and its
/// square.
const INDEX3_NEWTON_TOLERANCE: f64 = 0.002;
/// The same for the formulas of Newmark, whose velocities keep what is left, divided by the step.
const NEWMARK_NEWTON_TOLERANCE: f64 = 2e-5;
/// By how much error tests of what follows from positions stay above what the iteration leaves of it.
const MARGIN: f64 = 10.0;
/// The same for the formulas of Adams, whose high differences of slopes magnify what is left.
const ADAMS_NEWTON_TOLERANCE: f64 = 0.02;
/// Corrections that may grow in such an iteration.
const GROWTHS: usize = 5;

impl Dynamics {
    /// Right-hand sides at the state evaluated last.
    pub(super) fn residual(&mut self, step: &bdf::Step<'_>) -> Result<(), Failure> {
        self.work.residuals += 1;
        let n = self.system.rate_count();
        let gamma = step.gamma;
        self.take_change(step);
        for (trial, impulse) in self.trial.iter_mut().zip(&self.impulses) {
            *trial = impulse / gamma;
        }
        self.system
            .set_solution(&self.change, 1.0 / gamma, &self.trial);
        self.system.mass_times(&self.change, &mut self.momentum);
        self.system.forces(&self.trial, &mut self.force);
        let (inertia, lag) = (self.inertia_part(), self.lag());
        if lag != 0.0 {
            self.system
                .mass_times(&self.past_rates, &mut self.past_inertia);
        }
        for k in 0..n {
            let past = if lag == 0.0 {
                0.0
            } else {
                lag * (self.past_force[k] + self.past_inertia[k])
            };
            self.right[k] = gamma * (self.force[k] + past) - inertia * self.momentum[k];
        }
        if self.present == Index::One || self.system.prescribes_accelerations() {
            self.system.prescribe_accelerations(&mut self.prescribed);
        }
        for (row, &place) in self.system.rows.iter().enumerate() {
            let evaluated = &self.system.evaluated[place];
            let constraint = &self.system.constraints[place];
            let of = |u: &[f64]| evaluated.rate_of(constraint, u);
            self.right[n + row] = match (self.system.levels[row], self.present) {
                (Level::Acceleration, _) | (_, Index::One) => {
                    gamma * self.prescribed[row] - of(&self.change)
                }
                (Level::Position, Index::Three) => -evaluated.error / step.position_gamma,
                (Level::Position, Index::StabilisedTwo) | (Level::Velocity, _) => {
                    evaluated.rate - of(self.state.velocities())
                }
            };
        }
        let lacks = &mut self.right[n + self.system.row_count()..];
        self.system.algebraic_residual(&self.trial, lacks);
        for lack in lacks {
            *lack *= gamma;
        }
        if self.right.iter().all(|r| r.is_finite()) {
            Ok(())
        } else {
            Err(Failure::NotANumber {
                element: self.system.find_not_a_number(),
            })
        }
    }

    /// Size of a Newton correction in units of the error tolerance.
    pub(super) fn correction_norm(&self, gamma: f64) -> f64 {
        let moving = self.system.velocity_count();
        let motions = self.scales.largest(&self.right[..moving]);
        let mut norm = gamma * motions;
        if self.present != Index::Three {
            norm = norm.max(motions / self.scales.rate);
        }
        if self.present == Index::StabilisedTwo {
            norm = norm.max(self.scales.largest(&self.position_right[..moving]));
        }
        let changes = &self.right[moving..self.system.rate_count()];
        for (scale, change) in self.state_scales.iter().zip(changes) {
            norm = norm.max(change.abs() / scale);
        }
        // Near a singular position no iteration comes as close as index 3 wants it elsewhere.
        match self.formulation.index() {
            Index::One | Index::StabilisedTwo => norm / self.motion_error,
            Index::Three if self.tests_free_velocities() => {
                let part = INDEX3_NEWTON_TOLERANCE / NEWTON_TOLERANCE;
                let velocities = part * motions / (self.scales.rate * self.motion_error);
                (norm / self.position_tolerance()).max(velocities)
            }
            Index::Three => norm / self.position_tolerance(),
        }
    }

    /// What the iteration leaves of velocities that follow from positions, in units of the error of
    /// positions: an error test that looks closer asks for shorter steps, which leave more.
    pub(super) fn left_of_velocities(&self, step: &bdf::Step<'_>) -> f64 {
        let tolerance = match self.formulation {
            Formulation::I3 => self.loosened(INDEX3_NEWTON_TOLERANCE, step.size) * INDEX3_SHARE,
            Formulation::Newmark { .. } => NEWMARK_NEWTON_TOLERANCE,
            Formulation::Si2 | Formulation::Adams | Formulation::Hht { .. } => 0.0,
        };
        MARGIN * tolerance / step.size
    }

    /// What the iteration leaves of reactions that follow from positions, as a part of the inertia forces
    /// at the largest rate: what is left of positions, divided by the square of the step. An error test
    /// that looks closer at what follows reactions asks for shorter steps, which leave more.
    pub(super) fn left_of_reactions(&self, step: &bdf::Step<'_>) -> f64 {
        match self.formulation.index() {
            Index::One | Index::StabilisedTwo => 0.0,
            Index::Three => {
                let tolerance = self.loosened(INDEX3_NEWTON_TOLERANCE, step.size);
                let left = MARGIN * tolerance * self.position_tolerance();
                left / (step.size * self.scales.rate).powi(2)
            }
        }
    }

    /// Newton's iteration from the loaded state, with the matrix used as `usage` says.
    pub(super) fn newton(&mut self, step: &bdf::Step<'_>, usage: MatrixUse) -> Result<(), Failure> {
        let gamma = step.gamma;
        let moving = self.system.velocity_count();
        let n = self.system.rate_count();
        let rows = match self.present {
            Index::One => Rows::Acceleration,
            Index::StabilisedTwo => Rows::Velocity,
            Index::Three => Rows::Position,
        };
        let (mut first, mut last, mut growths) = (0.0, 0.0, 0);
        let is_full = usage == MatrixUse::RenewedAlways;
        let iterations = self.corrector.most_iterations(is_full);
        let tolerance = match self.present {
            Index::One => ADAMS_NEWTON_TOLERANCE,
            Index::StabilisedTwo => NEWTON_TOLERANCE,
            Index::Three => match self.formulation.family() {
                Family::Newmark(_) => NEWMARK_NEWTON_TOLERANCE,
                Family::BackwardDifferences | Family::Adams => INDEX3_NEWTON_TOLERANCE,
            },
        };
        let tolerance = self.loosened(tolerance, step.size) * self.switching.newton_part();
        for iteration in 0..iterations {
            let renew = match usage {
                MatrixUse::Kept => false,
                MatrixUse::Renewed => iteration == 0,
                MatrixUse::Patterned { pattern, first } => {
                    pattern.renews(iteration) || (first && iteration == 0)
                }
                MatrixUse::RenewedAlways => true,
            };
            self.system.evaluate(&self.state, renew);
            self.residual(step)?;
            if renew {
                self.factored = None;
                self.work.factorisations += 1;
                let weights = Weights::step(self.inertia_part(), gamma, step.position_gamma);
                self.system
                    .assemble(rows, weights, &self.change, &self.trial, &mut self.matrix);
                let factored = self.factors.factor(&self.matrix);
                factored.map_err(|singular| self.system.without_solution(singular))?;
                self.factored = Some(gamma);
                self.kept_axes.keep(&self.system);
            } else {
                self.kept_axes.follow(&self.system);
            }
            self.kept_axes.bring_back(&mut self.right[n..]);
            self.factors.solve(&mut self.right);
            self.kept_axes.bring_forth(&mut self.right[n..]);
            for (impulse, change) in self.impulses.iter_mut().zip(&self.right[n..]) {
                *impulse += change;
            }
            let unwatched = if self.corrector.tests_all {
                self.unwatched_correction(gamma)
            } else {
                0.0
            };
            match self.present {
                Index::One => {
                    for (u, change) in self.state.velocities_mut().iter_mut().zip(&self.right) {
                        *u += change;
                    }
                    self.positions_from_velocities(step)?;
                }
                Index::StabilisedTwo => {
                    self.correct_positions(gamma);
                    for k in 0..moving {
                        self.state.velocities_mut()[k] += self.right[k];
                        self.shift[k] += self.position_right[k];
                    }
                    self.positions_from_velocities(step)?;
                }
                Index::Three => {
                    for k in 0..moving {
                        self.change[k] = step.position_gamma * self.right[k];
                    }
                    self.state.displace(&self.change[..moving]);
                    self.velocities_from_positions(step);
                }
            }
            let states = self.state.states_mut().iter_mut();
            for (state, change) in states.zip(&self.right[moving..n]) {
                *state += change;
            }
            let watched = self.correction_norm(step.position_gamma);
            let norm = watched.max(tolerance * unwatched);
            if !norm.is_finite() {
                break;
            }
            if let Some(fixed) = self.corrector.fixed {
                if iteration + 1 == fixed {
                    return Ok(());
                }
                continue;
            }
            if norm == 0.0 {
                return Ok(());
            }
            // The first correction says nothing about how fast the iteration converges, and the
            // rate of an earlier step says nothing about a matrix that has gone stale since.
            if iteration > 0 {
                self.rate = norm / last;
                if self.rate >= 1.0 && norm > tolerance {
                    // With a matrix of its own in each iteration the kink may be crossed once or
                    // twice before the iteration settles on one side.
                    growths += 1;
                    if usage != MatrixUse::RenewedAlways || growths > GROWTHS {
                        break;
                    }
                }
                if norm * self.rate.min(0.9) / (1.0 - self.rate.min(0.9)) <= tolerance {
                    // That of all iterations says whether the matrix is worth keeping.
                    self.rate = (norm / first).powf(1.0 / iteration as f64);
                    return Ok(());
                }
            } else {
                first = norm;
            }
            last = norm;
        }
        let size = |k: &usize| self.right[*k].abs();
        let worst = (0..n).max_by(|a, b| size(a).total_cmp(&size(b)));
        Err(Failure::NotConverged {
            unknown: worst.unwrap_or(0),
        })
    }
}
