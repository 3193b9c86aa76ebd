//! Where within a step a switch comes to its jump.

use numerics::bdf::{self, Verdict, Within};

use super::Switching;
use crate::dynamics::Dynamics;
use crate::expression::Branch;
use crate::system::{System, Units};

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
    /// Looks at a step that passed the error test and is evaluated at its end.
    pub(in crate::dynamics) fn judge(
        &mut self,
        dynamics: &mut Dynamics,
        step: &bdf::Step<'_>,
        within: Within<'_>,
    ) -> Verdict {
        self.read(&mut dynamics.system);
        if !self.any_left(&dynamics.system) {
            return Verdict::Accept;
        }
        let cut = self.located == Some(step.time);
        let mut met = true;
        for k in 0..self.switches.len() {
            if self.left_for(k, &dynamics.system).is_none() {
                continue;
            }
            let switch = &mut self.switches[k];
            switch.largest_jump = switch.largest_jump.max(self.readings[k].jump);
            if !switch.of_time {
                let units = Units {
                    length: dynamics.scales.length,
                    rate: dynamics.scales.rate,
                    states: &dynamics.state_scales,
                };
                let unit = dynamics.system.switch_unit(switch.place, &units);
                switch.width = switch.widening * dynamics.tolerance * unit;
            }
            let outside = switch.outside(&dynamics.system, self.readings[k].argument);
            let near = outside <= switch.tolerance();
            met &= near || cut && (switch.of_time || self.locations >= LOCATIONS);
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
        self.rates[1].clone_from(&dynamics.change);
        for rate in &mut self.rates[1] {
            *rate /= step.gamma;
        }
        self.multipliers[1].clone_from(&dynamics.multipliers);
        let mut end = step.time;
        for k in 0..self.switches.len() {
            if self.left_for(k, &dynamics.system).is_some() {
                end = self.root(k, end, dynamics, step, within);
                self.evaluate(end, false, dynamics, step, within);
                self.read(&mut dynamics.system);
            }
        }
        end
    }

    /// A time before `end`, at which switch `k` has left its cell, at which it has just done so: by
    /// false position (Illinois), with a bisection in between.
    fn root(
        &mut self,
        k: usize,
        end: f64,
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
        let (mut a, mut b) = (step.time - step.size, end);
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

    /// Evaluates the system at a time within a step; rates, reactions and variables change evenly.
    fn evaluate(
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
        dynamics.system.evaluate(&dynamics.state, false);
        let left = (step.time - time) / step.size;
        let mix = |[start, end]: &[Vec<f64>; 2], out: &mut [f64]| {
            for (out, (start, end)) in out.iter_mut().zip(start.iter().zip(end)) {
                *out = left * start + (1.0 - left) * end;
            }
        };
        mix(&self.rates, &mut dynamics.change);
        mix(&self.multipliers, &mut dynamics.trial);
        dynamics
            .system
            .set_solution(&dynamics.change, 1.0, &dynamics.trial);
    }
}
