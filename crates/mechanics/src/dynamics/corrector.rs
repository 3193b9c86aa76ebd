//! How Newton's iteration on a step goes: its matrices, and what must have converged.
//!
//! These are the arguments MAXIT, FIXIT, PATTERN, CORRECTOR and ADAPTIVITY of INTEGRATOR (Adams Solver,
//! its statement page).

use serde::{Deserialize, Serialize};

use super::scales::SMALLEST_STATE;
use super::{Dynamics, Formulation, Index};

/// Iterations of an attempt at a step where nothing else is said: what takes more is better served by
/// a new matrix (with eight, rows of four-bars came out of singular positions with more energy),
const ITERATIONS: usize = 6;
/// and of one with a matrix in each, which is the last attempt.
const FULL_ITERATIONS: usize = 20;
/// Part of the error tolerance that the iteration may leave, at most, however it is loosened (Hairer
/// and Wanner, *Solving Ordinary Differential Equations II*, section IV.8: 1e-2 to 1e-1).
const LOOSEST: f64 = 0.1;
/// What the iteration may leave of reactions and algebraic variables, as part of the error tolerance.
const REACTION_TOLERANCE: f64 = 0.05;
/// By how much tests of convergence stay above what rounding leaves.
const ROUNDING_MARGIN: f64 = 10.0;

/// The iterations of a step that begin with a new Newton matrix, again and again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Pattern {
    renewed: u64,
    length: u32,
}

impl Pattern {
    /// The longest one.
    pub const LONGEST: usize = 64;

    /// The matrix is new in those iterations that are true, and in those `pattern.len()` after them;
    /// `None` for an empty pattern, and for one that is longer than [`Pattern::LONGEST`].
    #[must_use]
    pub fn new(pattern: &[bool]) -> Option<Self> {
        let length = u32::try_from(pattern.len()).ok()?;
        let fits = (1..=Self::LONGEST).contains(&pattern.len());
        let bits = pattern.iter().enumerate();
        let renewed = || bits.fold(0, |all, (place, &bit)| all | (u64::from(bit) << place));
        fits.then(|| Self {
            renewed: renewed(),
            length,
        })
    }

    /// Whether the matrix is new in this iteration, counted from zero.
    pub(super) fn renews(self, iteration: usize) -> bool {
        self.renewed >> (iteration % self.length as usize) & 1 == 1
    }
}

/// How Newton's iteration on a step goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Corrector {
    /// Iterations of an attempt at a step, at most (MAXIT). `None`: six, and twenty in a last attempt with
    /// a matrix in each.
    pub iterations: Option<usize>,
    /// So many iterations a step, whatever they leave, and steps whose error is not tested (FIXIT): the
    /// same work in every step.
    pub fixed: Option<usize>,
    /// Iterations whose matrix is new (PATTERN). In others, and in all where there is no pattern, it is
    /// kept, over steps, too, as long as the iteration with it is fast. Without convergence a step is
    /// always tried again with a matrix in each iteration.
    pub pattern: Option<Pattern>,
    /// Whether reactions, algebraic variables and velocities must have converged, too
    /// (CORRECTOR=ORIGINAL), and not those unknowns alone that the error test looks at (MODIFIED).
    pub tests_all: bool,
    /// Divided by the step it adds to the tolerance of the iteration (ADAPTIVITY), up to a tenth of
    /// the error tolerance; in that of which the error tolerance is a part, times time. For backward
    /// differentiation.
    pub adaptivity: f64,
}

impl Corrector {
    /// Iterations of an attempt, at most: one with kept matrices, or the last one, with a matrix in each.
    #[must_use]
    pub fn most_iterations(&self, is_full: bool) -> usize {
        let own = if is_full { FULL_ITERATIONS } else { ITERATIONS };
        self.fixed.or(self.iterations).unwrap_or(own)
    }
}

impl Dynamics {
    /// What the iteration may leave of a step of this size, as part of the error tolerance, where
    /// `tolerance` is what it may leave without ADAPTIVITY.
    pub(super) fn loosened(&self, tolerance: f64, size: f64) -> f64 {
        match self.formulation {
            Formulation::I3 | Formulation::Si2 if self.corrector.adaptivity > 0.0 => {
                let more = self.corrector.adaptivity / (size * self.tolerance());
                (tolerance + more).min(LOOSEST).max(tolerance)
            }
            _ => tolerance,
        }
    }

    /// Size of the present correction of what the error test does not look at, in units of what may be
    /// left of it: reactions as power in the motions of the largest rate, against that of all forces;
    /// algebraic variables against the largest of themselves; velocities where positions alone are
    /// tested.
    pub(super) fn unwatched_correction(&mut self, gamma: f64) -> f64 {
        let n = self.system.rate_count();
        let moving = self.system.velocity_count();
        let (length, rate) = (self.scales.length, self.scales.rate);
        let unit = |place: usize| if place % 6 < 3 { length * rate } else { rate };
        // What rounding leaves of velocities, as part of the largest rate.
        let rounding = match self.present {
            Index::Three => ROUNDING_MARGIN * f64::EPSILON / (gamma * rate),
            Index::One | Index::StabilisedTwo => ROUNDING_MARGIN * f64::EPSILON,
        };
        let allowed = REACTION_TOLERANCE * self.error + rounding;
        let mut norm = match self.present {
            Index::Three => self.scales.largest(&self.right[..moving]) / (rate * allowed),
            Index::One | Index::StabilisedTwo => 0.0,
        };
        // Momenta of the largest rate: of them rounding leaves its part in the impulses.
        self.momentum.fill(0.0);
        for place in 0..moving {
            self.rates[place] = unit(place);
        }
        self.system.mass_times(&self.rates, &mut self.momentum);
        let (mut inertia, mut power) = (0.0_f64, 0.0_f64);
        for place in 0..moving {
            inertia = inertia.max(self.momentum[place].abs() * unit(place));
            power = power.max(gamma * self.force[place].abs() * unit(place));
        }
        let reaction = |row: usize| {
            let place = self.system.rows[row];
            let blocks = self.system.evaluated[place].blocks(&self.system.constraints[place]);
            let pushed = blocks.flat_map(|(_, block)| block).enumerate();
            pushed.fold(0.0_f64, |most, (k, g)| most.max(g.abs() * unit(k)))
        };
        let rows = self.system.row_count();
        for row in 0..rows {
            power = power.max(self.impulses[row].abs() * reaction(row));
        }
        let allowed = REACTION_TOLERANCE * self.error * power + rounding * inertia;
        for row in 0..rows {
            norm = norm.max(self.right[n + row].abs() * reaction(row) / allowed);
        }
        // Accelerations, which a variable may be, lose another order to rounding.
        let part = REACTION_TOLERANCE * self.error + rounding / (gamma * rate).min(1.0);
        let size = |values: &[f64]| values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let largest = size(&self.impulses[rows..]).max(gamma * SMALLEST_STATE);
        norm.max(size(&self.right[n + rows..]) / (largest * part))
    }
}
