//! The gain of friction: how much load a friction that a load causes brings about.
//!
//! With the friction `f_k = φ_k N_k` of each joint (`φ_k` its direction and coefficient in steady
//! motion) the reactions of the reduced system answer a unit load on friction `k` with
//!
//! ```text
//! A_lk = dN_l/dλ · dλ/df · φ_k       from  M δa − Gᵀ δλ = φ_k,  G δa = 0
//! ```
//!
//! and the loads are `N = (1 − A)⁻¹ N₀`. Where an eigenvalue of `A` reaches one, loads grow without
//! bound: the joint jams, or has no or several solutions (Painlevé 1895). Beyond it the equations
//! still have a solution, with which no machine moves; so it is reported, never integrated.

mod answers;
mod full;
mod krylov;

use serde::{Deserialize, Serialize};

use crate::instant::Failure;
use crate::joint_friction::Memory;
use crate::model::Label;
use crate::system::System;
use answers::Answers;
use full::Full;
use krylov::Krylov;

/// A friction whose gain is one or more, or as near to one as makes equations unsolvable.
#[derive(Clone, Debug, PartialEq)]
pub struct Jam {
    /// The friction.
    pub friction: Label,
    /// The gain: the largest real eigenvalue of the loop.
    pub gain: f64,
}

/// The largest real gain.
struct Largest {
    /// The friction that takes the largest part in it.
    friction: usize,
    gain: f64,
}

/// Bound of the gains from which on every step is looked at.
const LOOK_ALWAYS: f64 = 0.5;
/// A gain from which on a failure to solve the equations is put down to it.
const NEAR_ONE: f64 = 0.9;
/// Frictions up to which all gains are found, with bounds that hold whatever way joints slide. The
/// largest gain of more is estimated, in a time that does not grow with the square of their number.
const MOST_IN_FULL: usize = 64;
/// A look solves the equations some times. Looks are so far apart that this is as many times a step;
/// a jam is then found that much later.
const SOLVES_A_STEP: usize = 16;
/// Steps between two looks at most.
const LONGEST_INTERVAL: f64 = 1000.0;

/// The gains, in full or in part.
#[derive(Clone, Debug, Serialize, Deserialize)]
enum Gains {
    Full(Full),
    Krylov(Krylov),
}

/// Finds gains, with storage of its own.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct GainWatch {
    answers: Answers,
    gains: Gains,
    /// Steps until the next look.
    wait: usize,
}

impl GainWatch {
    pub(crate) fn new(system: &System) -> Self {
        let frictions = system.model.frictions.len();
        Self {
            answers: Answers::new(system),
            gains: if frictions <= MOST_IN_FULL {
                Gains::Full(Full::new(frictions))
            } else {
                Gains::Krylov(Krylov::new(frictions))
            },
            wait: 0,
        }
    }

    /// Looks at the instant evaluated last, if it is time to: often where gains are large, seldom
    /// where geometry and coefficients leave them far from one. `before` is what the frictions
    /// remembered before the step that led there.
    pub(crate) fn look_seldom(
        &mut self,
        system: &mut System,
        multipliers: &[f64],
        before: &[Memory],
    ) -> Result<Option<Jam>, Failure> {
        if self.wait > 0 {
            self.wait -= 1;
            return Ok(None);
        }
        self.look_across(system, multipliers, Some(before))
    }

    /// Looks at the instant evaluated last.
    pub(crate) fn look(
        &mut self,
        system: &mut System,
        multipliers: &[f64],
    ) -> Result<Option<Jam>, Failure> {
        self.look_across(system, multipliers, None)
    }

    fn look_across(
        &mut self,
        system: &mut System,
        multipliers: &[f64],
        before: Option<&[Memory]>,
    ) -> Result<Option<Jam>, Failure> {
        if self.answers.count() == 0 {
            self.wait = usize::MAX;
            return Ok(None);
        }
        let bound = self.bound(system, multipliers, before)?;
        let interval = (LOOK_ALWAYS / bound).powi(2).clamp(1.0, LONGEST_INTERVAL);
        let solves = match &self.gains {
            Gains::Full(_) => self.answers.count(),
            Gains::Krylov(_) => krylov::PRODUCTS,
        };
        self.wait = (interval as usize - 1).max(solves / SOLVES_A_STEP);
        if bound < 1.0 {
            return Ok(None);
        }
        Ok(self.largest(system).filter(|jam| jam.gain >= 1.0))
    }

    /// The largest gain at the instant evaluated last, where it is near enough to one to explain why
    /// no solution is found.
    pub(crate) fn explain(&mut self, system: &mut System, multipliers: &[f64]) -> Option<Jam> {
        if self.answers.count() == 0 {
            return None;
        }
        self.bound(system, multipliers, None).ok()?;
        self.largest(system).filter(|jam| jam.gain >= NEAR_ONE)
    }

    fn largest(&self, system: &System) -> Option<Jam> {
        let largest = match &self.gains {
            Gains::Full(full) => full.largest(),
            Gains::Krylov(krylov) => krylov.largest(),
        };
        largest.map(|Largest { friction, gain }| Jam {
            friction: system.model.frictions[friction].label.clone(),
            gain,
        })
    }

    /// Takes the gains; a bound of them, or an estimate where frictions are many.
    fn bound(
        &mut self,
        system: &mut System,
        multipliers: &[f64],
        before: Option<&[Memory]>,
    ) -> Result<f64, Failure> {
        let open = self.answers.take(system, multipliers, before)?;
        let bound = match &mut self.gains {
            Gains::Full(full) => full.take(&mut self.answers),
            Gains::Krylov(krylov) => krylov.take(&mut self.answers),
        };
        Ok(if open { bound.max(LOOK_ALWAYS) } else { bound })
    }
}
