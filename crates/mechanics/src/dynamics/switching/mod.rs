//! Functions that jump, met where they jump.
//!
//! A step holds every switch (see [`crate::expression`]) in the cell in which it begins, so that the
//! equations are smooth within it. Where the argument of a switch has left its cell at the end of a
//! step that would be accepted, the place is looked for on the polynomial through the step, and the
//! step is solved again to end just behind it; there the switch is turned over, and the integrator
//! starts anew (Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, section II.6).
//! *Just behind* is within the error that the tolerance allows in the argument: its *width*.
//!
//! A switch that turns back before it has gone farther than a few widths is pushed back to its jump
//! from both sides: the motion stays there, with a force between those of the two sides that holds it
//! (A. F. Filippov, *Differential Equations with Discontinuous Righthand Sides*, 1988). Then the jump
//! becomes a straight transition from one width before it to one behind, which an implicit step
//! takes as it is. The motion leaves where the share of one side has come to zero.
//!
//! A switch that only bends its function, or less, is stepped over like any other bend; one whose jump
//! cannot be told from the error of a step, too (`effect.rs`).

mod effect;
mod excursion;
mod location;
mod switch;

use numerics::bdf;
use serde::{Deserialize, Serialize};

use super::Dynamics;
use crate::expression::{Branch, Sharing};
use crate::model::Label;
use crate::scalar::{Jet, Scalar};
use crate::state::State;
use crate::system::{Reading, SwitchPlace, System, Units};
use switch::Switch;

/// A switch that turns back within so many widths has not left its jump,
const NEAR: f64 = 4.0;
/// and after so many times it is held there.
const RETURNS: usize = 2;
/// So many turns within a trial step, none from farther than that, make the width this many times larger
/// until the motion has been farther away: then rounding, not the motion, turns the switch over, or a
/// jump so fast that nothing but its mean shows.
const TURNS: usize = 20;
const WIDENING: f64 = 10.0;
/// Error of the share of a held switch that a step may make; it is that of the force as a part of its
/// jump.
const SHARE_ERROR: f64 = 1e-3;
/// Steps behind a jump in which the shares are not tested.
const FIRST_STEPS: usize = 3;
/// Steps below this part of the longest have no test of the shares.
const SHORT: f64 = 1e-3;

/// A motion that stays where a function jumps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sliding {
    /// The element that the function belongs to.
    pub element: Label,
    /// The name of the function that jumps, in the dataset language.
    pub function: String,
    /// Time from which it was held first.
    pub time: f64,
    /// How near to the jump its argument is held, in the unit of the argument.
    pub width: f64,
}

/// The switches of a model while it is integrated.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Switching {
    switches: Vec<Switch>,
    readings: Vec<Reading>,
    /// Where the present step has been cut, and how often.
    located: Option<f64>,
    locations: usize,
    /// Switches turned over since the last accepted step.
    still: usize,
    /// Steps since the integrator has started, and whether the present one is short.
    steps: usize,
    short: bool,
    /// Whether some are to be turned over now.
    due: bool,
    /// Rates and multipliers at the beginning of the step, at its end, and at an instant within; how
    /// fast rates and variables change.
    rates: [Vec<f64>; 3],
    multipliers: [Vec<f64>; 3],
    changes: [Vec<f64>; 2],
    /// Arguments with their rates at the beginning of the step, where they are known, and at its end.
    starts: Vec<Jet>,
    starts_known: bool,
    ends: Vec<Jet>,
    /// Between which times each switch leaves its cell first.
    excursions: Vec<Option<[f64; 2]>>,
    slidings: Vec<Sliding>,
}

impl Switching {
    /// Begins anew with the switches of a system that is evaluated at an instant.
    pub(super) fn start(&mut self, system: &mut System) {
        self.switches.clear();
        for place in system.switches() {
            self.switches.push(Switch::new(place, system));
        }
        self.readings = vec![Reading::default(); self.switches.len()];
        self.starts = vec![Jet::constant(0.0); self.switches.len()];
        self.ends = self.starts.clone();
        self.excursions = vec![None; self.switches.len()];
        self.starts_known = false;
        self.due = false;
        self.still = 0;
    }

    pub(super) fn is_empty(&self) -> bool {
        self.switches.is_empty()
    }

    /// Whether a switch is held at its jump.
    pub(super) fn slides(&self) -> bool {
        self.switches
            .iter()
            .any(|s| matches!(s.branch, Branch::Shared(_)))
    }

    /// Begins a step of `size`, where the longest is `longest`.
    pub(super) fn attempt(&mut self, size: f64, longest: f64) {
        self.short = size < SHORT * longest;
    }

    /// Part of the usual tolerance that Newton's iteration has to meet: a step across the transition
    /// of a held switch is within the tolerance, and its share is to be found.
    pub(super) fn newton_part(&self) -> f64 {
        if self.slides() { SHARE_ERROR } else { 1.0 }
    }

    fn read(&mut self, system: &mut System) {
        system.read_switches(self.switches.iter().map(|s| s.place), &mut self.readings);
    }

    fn set_branch(&mut self, k: usize, branch: Branch, system: &mut System) {
        self.starts_known = false;
        self.switches[k].branch = branch;
        system.set_branch(self.switches[k].place, branch);
    }

    /// Gives a system whose functions know of no branch those of the switches.
    pub(super) fn hold_branches(&self, system: &mut System) {
        for switch in &self.switches {
            system.set_branch(switch.place, switch.branch);
        }
    }

    /// The cell that switch `k` has left its own for, by what was read last.
    fn left_for(&self, k: usize, system: &System) -> Option<f64> {
        self.switches[k].left_for(system, self.readings[k].argument)
    }

    fn any_left(&self, system: &System) -> bool {
        (0..self.switches.len()).any(|k| self.left_for(k, system).is_some())
    }

    /// Takes over the end of an accepted step, which the switches were judged at.
    pub(super) fn accepted(&mut self, system: &mut System) {
        self.located = None;
        self.locations = 0;
        self.still = 0;
        self.steps += 1;
        self.starts.clone_from(&self.ends);
        self.starts_known = true;
        for k in 0..self.switches.len() {
            let Reading { argument, jump } = self.readings[k];
            let switch = &mut self.switches[k];
            switch.reach = switch.reach.max(switch.reach_within);
            switch.largest_jump = switch.largest_jump.max(jump);
            let passed_over = std::mem::take(&mut switch.passed_over);
            match switch.branch {
                Branch::Held(_) if passed_over => {
                    let cell = system.switch_cell(switch.place, argument);
                    self.set_branch(k, Branch::Held(cell), system);
                }
                Branch::Free if system.switch_acts(switch.place) => {
                    let cell = system.switch_cell(switch.place, argument);
                    self.set_branch(k, Branch::Held(cell), system);
                }
                Branch::Held(cell) => {
                    let within = -system.outside_cell(switch.place, cell, argument);
                    switch.reach = switch.reach.max(within);
                }
                Branch::Free | Branch::Shared(_) | Branch::Even => {}
            }
        }
    }

    /// Keeps the solution at the beginning of the next step.
    pub(super) fn begin(&mut self, rates: impl Iterator<Item = f64>, multipliers: &[f64]) {
        self.rates[0].clear();
        self.rates[0].extend(rates);
        self.multipliers[0].clear();
        self.multipliers[0].extend_from_slice(multipliers);
    }

    pub(super) fn is_due(&self) -> bool {
        self.due
    }

    /// Turns over what has left its cell.
    fn turn(&mut self, system: &mut System, time: f64, trial: f64) {
        self.due = false;
        for k in 0..self.switches.len() {
            let switch = &mut self.switches[k];
            let Some(to) = switch.target.take() else {
                continue;
            };
            switch.turned = true;
            switch.turns += 1;
            if switch.reach > NEAR * switch.width {
                // The motion has been elsewhere: it, and nothing else, has come back.
                (switch.since, switch.turns) = (time, 0);
                switch.widening = 1.0;
            } else if time - switch.since > trial {
                (switch.since, switch.turns) = (time, 0);
            } else if switch.turns >= TURNS {
                (switch.since, switch.turns) = (time, 0);
                switch.widening *= WIDENING;
            }
            let mut branch = Branch::Held(to);
            if let Branch::Held(from) = switch.branch {
                let back = !switch.of_time && switch.reach <= NEAR * switch.width;
                switch.returns = if back { switch.returns + 1 } else { 0 };
                if switch.returns >= RETURNS && switch.width > 0.0 {
                    let (lower, upper, boundary) = system.switch_sides(switch.place, [from, to]);
                    branch = Branch::Shared(Sharing {
                        lower,
                        upper,
                        share: 0.5,
                        steepness: 0.5 / switch.width,
                        boundary,
                    });
                    let sliding = Sliding {
                        element: system.switch_label(switch.place).clone(),
                        function: system.switch_name(switch.place).to_owned(),
                        time,
                        width: switch.width,
                    };
                    let same = |s: &Sliding| {
                        (&s.element, &s.function) == (&sliding.element, &sliding.function)
                    };
                    if !self.slidings.iter().any(same) {
                        self.slidings.push(sliding);
                    }
                }
            }
            self.switches[k].reach = 0.0;
            self.set_branch(k, branch, system);
        }
    }

    /// Writes the shares of the switches that are held at their jump, at the instant evaluated last.
    pub(super) fn write_shares(&mut self, system: &mut System, shares: &mut [f64]) {
        if !self.slides() {
            shares.fill(0.0);
            return;
        }
        self.read(system);
        for ((share, switch), reading) in shares.iter_mut().zip(&self.switches).zip(&self.readings)
        {
            *share = match switch.branch {
                Branch::Shared(sharing) => sharing.at(reading.argument),
                Branch::Free | Branch::Held(_) | Branch::Even => 0.0,
            };
        }
    }

    /// Shares to start with from those that hold, zero for switches that are not held at their jump.
    fn shares(&self, shares: &[f64]) -> Vec<f64> {
        let share = |(switch, share): (&Switch, &f64)| match switch.branch {
            Branch::Shared(_) => share.clamp(0.0, 1.0),
            Branch::Free | Branch::Held(_) | Branch::Even => 0.0,
        };
        self.switches.iter().zip(shares).map(share).collect()
    }

    /// Size of a change of the shares in units of the error that a step may make. Behind a
    /// jump they adapt at once, which the first steps are not to resolve; and short steps have shares
    /// made of rounding, whose argument is off by that part of its width.
    pub(super) fn norm(&self, shares: &[f64]) -> f64 {
        if self.steps < FIRST_STEPS || self.short {
            return 0.0;
        }
        shares.iter().fold(0.0_f64, |norm, d| norm.max(d.abs())) / SHARE_ERROR
    }

    /// The element whose function has the switch of a share.
    pub(super) fn element<'a>(&self, share: usize, system: &'a System) -> &'a Label {
        system.switch_label(self.switches[share].place)
    }

    /// Lets another system evaluate the instant of `state` as it is: free, but for those switches
    /// that are held at their jump, and those that were turned over here, on whose new side it is.
    pub(super) fn lend(&self, state: &State, system: &mut System) {
        let shares = &state.values[state.share_range()];
        for (switch, share) in self.switches.iter().zip(shares) {
            let branch = match switch.branch {
                Branch::Shared(sharing) => Branch::Shared(Sharing {
                    share: share.clamp(0.0, 1.0),
                    steepness: 0.0,
                    ..sharing
                }),
                branch if switch.turned => branch,
                _ => Branch::Free,
            };
            system.set_branch(switch.place, branch);
        }
    }

    /// Holds the switches of `own` where those of `system` are at an instant that it has solved, but
    /// for those that were turned over or are at their jump.
    pub(super) fn hold(&mut self, system: &mut System, own: &mut System) {
        self.steps = 0;
        self.starts_known = false;
        self.read(system);
        for k in 0..self.switches.len() {
            let switch = &mut self.switches[k];
            let turned = std::mem::take(&mut switch.turned);
            if !turned && matches!(switch.branch, Branch::Held(_)) {
                let cell = own.switch_cell(switch.place, self.readings[k].argument);
                self.set_branch(k, Branch::Held(cell), own);
            }
        }
    }
}

impl Dynamics {
    /// Whether functions jump here: the integrator has to start anew.
    pub(crate) fn is_at_jump(&self) -> bool {
        self.switching.is_due()
    }

    /// Turns over the switches that have come to their jump, at the time and values of the
    /// integrator; returns the shares on the other side, which a trial step of `size` finds.
    pub(crate) fn pass_jump(&mut self, time: f64, values: &[f64], size: f64) -> Vec<f64> {
        let range = self.state.share_range();
        self.switching.turn(&mut self.system, time, size);
        // With the matrix of a stiff side no iteration moves on a soft one.
        self.factored = None;
        let mut solved = values.to_vec();
        if self.switching.slides() {
            let step = bdf::Step {
                time: time + size,
                size,
                order: 1,
                gamma: size,
                position_gamma: size,
                history: values,
                prediction: values,
            };
            // Without a solution the steps that follow find the shares, in more of them.
            let _ = bdf::System::solve(self, &step, &mut solved);
        }
        self.switching.shares(&solved[range])
    }

    /// Error of the argument of a switch that the tolerance allows.
    fn argument_error(&mut self, place: SwitchPlace) -> f64 {
        let units = Units {
            length: self.scales.length,
            rate: self.scales.rate,
            states: &self.state_scales,
        };
        self.tolerance() * self.system.switch_unit(place, &units)
    }

    /// A motion or constraint whose function jumps here.
    pub(crate) fn turned_constraint(&self) -> Option<&Label> {
        let mut switches = self.switching.switches.iter();
        let found = switches.find(|switch| switch.turned && switch.constrains)?;
        Some(self.system.switch_label(found.place))
    }

    /// See [`Switching::lend`].
    pub(crate) fn lend_branches(&self, state: &State, system: &mut System) {
        self.switching.lend(state, system);
    }

    /// See [`Switching::hold`]; `accelerations` and `multipliers` are the solution there.
    pub(crate) fn hold_switches(
        &mut self,
        system: &mut System,
        accelerations: &[f64],
        multipliers: &[f64],
    ) {
        self.switching.hold(system, &mut self.system);
        self.switching
            .begin(accelerations.iter().copied(), multipliers);
    }

    /// Where the motion has come to stay at jumps of functions, since it was asked last.
    pub(crate) fn take_slidings(&mut self) -> Vec<Sliding> {
        std::mem::take(&mut self.switching.slidings)
    }
}
