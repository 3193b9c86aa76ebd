//! Where within a step a switch comes to its jump.

use numerics::bdf::{self, Verdict, Within};

use super::Switching;
use crate::dynamics::Dynamics;
use crate::expression::Branch;
use crate::system::System;

/// Solutions for one jump, at most.
const LOCATIONS: usize = 8;
/// Part of the width behind a jump at which it is looked for.
const AIM: f64 = 0.02;
/// A jump below this part of what the sides differ by elsewhere is a bend.
const BEND: f64 = 1e-3;
/// A jump this part of a step behind its beginning, or less than the shortest step, is at its
/// beginning.
const AT_START: f64 = 1e-10;
/// Switches that are turned over without a step between, before a step goes over them.
const STILL: usize = 20;
/// Evaluations to find a root.
const ROOT: usize = 200;

impl Switching {
    /// Looks at a step that passed the error test and is evaluated at its end, `values`.
    pub(in crate::dynamics) fn judge(
        &mut self,
        dynamics: &mut Dynamics,
        step: &bdf::Step<'_>,
        values: &[f64],
        within: Within<'_>,
    ) -> Verdict {
        self.read(&mut dynamics.system);
        self.switches.iter_mut().for_each(|s| s.passed_over = false);
        let cut = self.located == Some(step.time);
        let often = cut && self.locations >= LOCATIONS;
        self.find_excursions(dynamics, step, values, within);
        if often {
            self.excursions.fill(None);
        }
        if !cut && self.pass_over(dynamics, step) {
            return Verdict::EndAt(step.time);
        }
        self.look_at_lines(dynamics);
        let excursion = self.excursions.iter().any(Option::is_some);
        if !excursion && !self.any_left(&dynamics.system) {
            return Verdict::Accept;
        }
        let mut met = true;
        for k in 0..self.switches.len() {
            if self.left_for(k, &dynamics.system).is_none() {
                // An excursion that is over at the end of the step.
                met &= self.excursions[k].is_none();
                continue;
            }
            let switch = &mut self.switches[k];
            switch.largest_jump = switch.largest_jump.max(self.readings[k].jump);
            if !switch.of_time {
                switch.width = switch.widening * dynamics.argument_error(switch.place);
            }
            let outside = switch.outside(&dynamics.system, self.readings[k].argument);
            let near = outside <= switch.tolerance();
            met &= near || often || cut && switch.of_time;
        }
        let start = step.time - step.size;
        let time = if met {
            step.time
        } else {
            self.locate(dynamics, step, within)
        };
        if self.release_bends(&mut dynamics.system) {
            self.located = None;
            return Verdict::EndAt(step.time);
        }
        if time - start <= (AT_START * step.size).max(dynamics.steps[0]) {
            self.still += 1;
            if self.still > STILL {
                // No order of turning them over leads on.
                self.release_left(&mut dynamics.system);
                return Verdict::EndAt(step.time);
            }
            self.turn_left(&dynamics.system);
            return Verdict::Abandon;
        }
        if !met {
            self.located = Some(time);
            self.locations = if time < step.time {
                self.locations + 1
            } else {
                LOCATIONS
            };
            return Verdict::EndAt(time);
        }
        self.turn_left(&dynamics.system);
        Verdict::Accept
    }

    /// The switches that have left their cell go where they are, after the step.
    fn turn_left(&mut self, system: &System) {
        for k in 0..self.switches.len() {
            self.switches[k].target = self.left_for(k, system);
        }
        self.due = true;
    }

    /// Lets go, for this step, of what has left its cell.
    fn release_left(&mut self, system: &mut System) {
        for k in 0..self.switches.len() {
            if self.left_for(k, system).is_some() {
                self.set_branch(k, Branch::Free, system);
            }
        }
    }

    /// Lets go, for this step, of what only bends where it has left its cell; whether there was any.
    fn release_bends(&mut self, system: &mut System) -> bool {
        let mut any = false;
        for k in 0..self.switches.len() {
            let switch = &self.switches[k];
            let held = matches!(switch.branch, Branch::Held(_)) && !switch.constrains;
            let bends = self.readings[k].jump <= BEND * switch.largest_jump;
            if held && bends && self.left_for(k, system).is_some() {
                self.set_branch(k, Branch::Free, system);
                any = true;
            }
        }
        any
    }

    /// The first time within a step at which a switch is just behind its jump. What was read last is
    /// then of that time.
    fn locate(&mut self, dynamics: &mut Dynamics, step: &bdf::Step<'_>, within: Within<'_>) -> f64 {
        let mut end = step.time;
        for k in 0..self.switches.len() {
            let start = step.time - step.size;
            let (from, to) = match self.excursions[k] {
                Some([from, to]) if to <= end => (from, to),
                Some([from, _]) if from >= end => continue,
                Some([from, _]) => (from, end),
                None => (start, end),
            };
            if to < end || self.left_for(k, &dynamics.system).is_some() {
                end = self.root(k, [from, to], dynamics, step, within);
                self.evaluate(end, false, dynamics, step, within);
                self.read(&mut dynamics.system);
            }
        }
        end
    }

    /// A time between two, at the second of which switch `k` has left its cell, at which it has just
    /// done so: by false position (Illinois), with a bisection in between.
    fn root(
        &mut self,
        k: usize,
        [from, to]: [f64; 2],
        dynamics: &mut Dynamics,
        step: &bdf::Step<'_>,
        within: Within<'_>,
    ) -> f64 {
        let of_time = self.switches[k].of_time;
        let mut outside = |time: f64, switching: &mut Self| {
            switching.evaluate(time, of_time, dynamics, step, within);
            let place = switching.switches[k].place;
            let reading = &mut switching.readings[k..=k];
            dynamics
                .system
                .read_switches(std::iter::once(place), reading);
            let argument = reading[0].argument;
            let switch = &switching.switches[k];
            let left = switch.left_for(&dynamics.system, argument).is_some();
            (switch.outside(&dynamics.system, argument), left)
        };
        let (mut a, mut b) = (from, to);
        let (mut fa, left) = outside(a, self);
        if left {
            return a;
        }
        let (mut fb, _) = outside(b, self);
        let rounding = 4.0 * f64::EPSILON * b.abs();
        let tolerance = if of_time {
            rounding * (fb - fa) / (b - a)
        } else {
            self.switches[k].tolerance()
        };
        let aim = AIM * tolerance;
        (fa, fb) = (fa - aim, fb - aim);
        let mut behind = fb + aim;
        let mut stays = 0;
        for n in 0..ROOT {
            if behind <= tolerance || b - a <= rounding {
                break;
            }
            let secant = b - fb * (b - a) / (fb - fa);
            let c = if n % 3 == 2 || !(a < secant && secant < b) {
                0.5 * (a + b)
            } else {
                secant
            };
            let (value, left) = outside(c, self);
            if left {
                (b, fb, behind) = (c, value - aim, value);
                fa *= if stays > 0 { 0.5 } else { 1.0 };
                stays = 1;
            } else {
                (a, fa) = (c, value - aim);
                fb *= if stays < 0 { 0.5 } else { 1.0 };
                stays = -1;
            }
        }
        b
    }

    /// Keeps rates and reactions of the step that was solved last.
    pub(super) fn keep_end(&mut self, dynamics: &Dynamics, step: &bdf::Step<'_>) {
        self.rates[1].clear();
        let rates = dynamics.change.iter().map(|change| change / step.gamma);
        self.rates[1].extend(rates);
        self.multipliers[1].clone_from(&dynamics.multipliers);
        let [_, end, mixed] = &mut self.rates;
        mixed.clone_from(end);
        let rows = dynamics.system.row_count();
        let slopes = |[start, end, _]: &[Vec<f64>; 3], first: usize, out: &mut Vec<f64>| {
            out.clear();
            let pairs = start.iter().zip(end).skip(first);
            out.extend(pairs.map(|(a, b)| (b - a) / step.size));
        };
        slopes(&self.rates, 0, &mut self.changes[0]);
        slopes(&self.multipliers, rows, &mut self.changes[1]);
    }

    /// Evaluates the system at a time within a step; rates, reactions and variables change evenly.
    pub(super) fn evaluate(
        &mut self,
        time: f64,
        time_alone: bool,
        dynamics: &mut Dynamics,
        step: &bdf::Step<'_>,
        within: Within<'_>,
    ) {
        if time_alone {
            dynamics.system.set_time(time);
            return;
        }
        dynamics.state.time = time;
        within(time, &mut dynamics.state.values);
        dynamics.state.normalize();
        self.load(1.0 - (step.time - time) / step.size, dynamics);
    }

    /// Evaluates the system at its state, with rates, reactions and variables of a part of the step.
    pub(super) fn load(&mut self, part: f64, dynamics: &mut Dynamics) {
        dynamics.system.evaluate(&dynamics.state, false);
        let mix = |[start, end, mixed]: &mut [Vec<f64>; 3]| {
            mixed.clear();
            let pairs = start.iter().zip(end.iter());
            mixed.extend(pairs.map(|(start, end)| (1.0 - part) * start + part * end));
        };
        mix(&mut self.rates);
        mix(&mut self.multipliers);
        let (rates, multipliers) = (&self.rates[2], &self.multipliers[2]);
        dynamics.system.set_solution(rates, 1.0, multipliers);
    }
}
