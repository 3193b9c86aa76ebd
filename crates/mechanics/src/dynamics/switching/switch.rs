//! One switch while its model is integrated.

use super::effect::Effect;
use crate::expression::Branch;
use crate::system::{SwitchPlace, System};
use serde::{Deserialize, Serialize};

/// Share beyond 0 or 1 at which a switch may leave its jump.
const LEAVING: f64 = 1e-5;

/// A switch with what is known of it since the run began.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Switch {
    pub(super) place: SwitchPlace,
    /// Whether its argument depends on nothing but time.
    pub(super) of_time: bool,
    /// Whether a bend of it, too, is to be met.
    pub(super) constrains: bool,
    /// Whether it jumps again and again.
    pub(super) stairs: bool,
    /// Whether nothing but the motion shows its jump.
    pub(super) may_be_dull: bool,
    /// Whether its jump in the present step does nothing that counts.
    pub(super) passed_over: bool,
    /// What its jumps did when it became a line.
    pub(super) effect: Option<Effect>,
    pub(super) branch: Branch,
    /// The cell that it goes to after the present step.
    pub(super) target: Option<f64>,
    /// Whether it was turned over at the present instant.
    pub(super) turned: bool,
    /// Error of the argument that the tolerance allows.
    pub(super) width: f64,
    /// How far within its cell it has been.
    pub(super) reach: f64,
    /// The same within the present step.
    pub(super) reach_within: f64,
    /// How often it has turned back within a few widths, one time after the other.
    pub(super) returns: usize,
    /// How much wider than the tolerance allows it is.
    pub(super) widening: f64,
    /// Turns since a time.
    pub(super) turns: usize,
    pub(super) since: f64,
    /// Most that the sides of its jump differed by.
    pub(super) largest_jump: f64,
}

impl Switch {
    /// A switch at the beginning of a run, whose cell is still to be found.
    pub(super) fn new(place: SwitchPlace, system: &System) -> Self {
        Self {
            place,
            of_time: system.is_switch_of_time(place),
            constrains: system.switch_constrains(place),
            stairs: system.is_stairs(place),
            may_be_dull: system.switch_may_be_dull(place),
            passed_over: false,
            effect: None,
            branch: if system.switch_acts(place) {
                Branch::Held(0.0)
            } else {
                Branch::Free
            },
            target: None,
            turned: false,
            width: 0.0,
            reach: 0.0,
            reach_within: 0.0,
            returns: 0,
            widening: 1.0,
            turns: 0,
            since: f64::NEG_INFINITY,
            largest_jump: 0.0,
        }
    }

    /// How far it is outside of its cell.
    pub(super) fn outside(&self, system: &System, argument: f64) -> f64 {
        match self.branch {
            Branch::Free | Branch::Even => f64::NEG_INFINITY,
            Branch::Held(cell) => system.outside_cell(self.place, cell, argument),
            Branch::Shared(sharing) => {
                ((sharing.at(argument) - 0.5).abs() - 0.5) / sharing.steepness
            }
        }
    }

    /// The cell that it has left its own for.
    pub(super) fn left_for(&self, system: &System, argument: f64) -> Option<f64> {
        match self.branch {
            Branch::Free | Branch::Even => None,
            Branch::Held(_) if self.passed_over => None,
            Branch::Held(cell) => {
                let now = system.switch_cell(self.place, argument);
                // The point of an IF at which its argument is zero is on the way to the other side.
                let arrives = now == 0.0 && self.outside(system, argument) <= 0.0;
                (now != cell && !arrives && !argument.is_nan()).then_some(now)
            }
            Branch::Shared(sharing) => {
                let share = sharing.at(argument);
                if share > 1.0 {
                    Some(sharing.upper)
                } else {
                    (share < 0.0).then_some(sharing.lower)
                }
            }
        }
    }

    /// How far behind its jump it may be turned over.
    pub(super) fn tolerance(&self) -> f64 {
        match self.branch {
            Branch::Shared(sharing) => LEAVING / sharing.steepness,
            Branch::Held(_) | Branch::Free | Branch::Even => self.width,
        }
    }
}
