//! Switches that leave their cell within a step, whether or not they are back at its end.
//!
//! Along a step the argument of a switch is a function of time of which value and rate are known at the
//! ends (of a function of time alone the second rate, too). With a bound `C` of the second rate the
//! argument stays in its cell as long as its parabolas from both ends do, `d + ḋ t − C t²/2 ≥ 0` for the
//! distance `d` to each end of the cell. `C` is twice the largest second rate that these values show.
//! A piece of the step that this does not clear is halved, so that the pieces become as short as the
//! argument's own variation asks for, and the first excursion of an oscillation is found as the others
//! are. What no value and no rate at the points looked at shows (a pulse between two pieces at which a
//! function is flat) is not seen.

use numerics::bdf::{self, Within};

use super::Switching;
use crate::dynamics::Dynamics;
use crate::expression::Branch;
use crate::scalar::Jet;
use crate::system::Course;

/// What the second rate may be beyond the largest that shows.
const SAFETY: f64 = 2.0;
/// Pieces of a step that are looked at, at least, where the argument depends on time alone: a look is
/// cheap then.
const PIECES: f64 = 4.0;
/// Looks at a step, at most: for arguments of time, and for others.
const LOOKS: [usize; 2] = [10_000, 200];

/// An argument at a time.
#[derive(Clone, Copy, Debug)]
struct Look {
    time: f64,
    at: Jet,
}

impl Look {
    /// A bound of the second rate from here to a later look.
    fn bend(&self, later: &Self) -> f64 {
        let (a, b, span) = (self.at, later.at, later.time - self.time);
        let change = b.value - a.value;
        let by_values = (change - a.rate * span)
            .abs()
            .max((b.rate * span - change).abs());
        let shown = (2.0 * by_values / span)
            .max((b.rate - a.rate).abs())
            .max(a.acceleration.abs() * span)
            .max(b.acceleration.abs() * span);
        SAFETY * shown / span
    }

    /// Whether the argument stays between `first` and `last` until a later look.
    fn stays_until(&self, later: &Self, first: f64, last: f64) -> bool {
        let bend = self.bend(later);
        let side = |distance: fn(f64, f64) -> f64, end: f64, sign: f64| {
            let ahead = stay(distance(self.at.value, end), sign * self.at.rate, bend);
            let back = stay(distance(later.at.value, end), -sign * later.at.rate, bend);
            end.is_infinite() || ahead + back >= later.time - self.time
        };
        side(|x, end| x - end, first, 1.0) && side(|x, end| end - x, last, -1.0)
    }

    /// Whether the argument goes one way until a later look.
    fn goes_one_way_to(&self, later: &Self) -> bool {
        let (a, b) = (self.at.rate, later.at.rate);
        let turn = self.bend(later) * (later.time - self.time);
        a * b > 0.0 && turn <= 2.0 * a.abs().min(b.abs())
    }

    /// The argument halfway to a later look, by the cubic through both.
    fn halfway_to(&self, later: &Self) -> f64 {
        let (a, b) = (self.at, later.at);
        0.5 * (a.value + b.value) + 0.125 * (a.rate - b.rate) * (later.time - self.time)
    }
}

/// For how long `distance + rate t − bend t²/2` does not fall below zero.
fn stay(distance: f64, rate: f64, bend: f64) -> f64 {
    let distance = distance.max(0.0);
    if bend > 0.0 {
        (rate + (rate * rate + 2.0 * bend * distance).sqrt()) / bend
    } else if rate < 0.0 {
        distance / -rate
    } else {
        f64::INFINITY
    }
}

impl Switching {
    /// Looks for the first excursion of each switch within a step that is evaluated at its end, `values`:
    /// the times between which it leaves its cell.
    pub(super) fn find_excursions(
        &mut self,
        dynamics: &mut Dynamics,
        step: &bdf::Step<'_>,
        values: &[f64],
        within: Within<'_>,
    ) {
        self.keep_end(dynamics, step);
        let mut moved = false;
        if !self.switches.iter().all(|s| s.of_time) {
            dynamics.system.evaluate_slopes();
        }
        for k in 0..self.switches.len() {
            self.ends[k] = self.motion(k, dynamics);
        }
        if !self.starts_known {
            moved = true;
            self.evaluate(step.time - step.size, false, dynamics, step, within);
            dynamics.system.evaluate_slopes();
            for k in 0..self.switches.len() {
                self.starts[k] = self.motion(k, dynamics);
            }
            self.starts_known = true;
        }
        for k in 0..self.switches.len() {
            let found = match self.switches[k].branch {
                Branch::Held(_) => self.first_excursion(k, dynamics, step, within, &mut moved),
                Branch::Free | Branch::Shared(_) | Branch::Even => None,
            };
            self.excursions[k] = found;
        }
        if moved {
            dynamics.state.time = step.time;
            dynamics.state.values.copy_from_slice(values);
            self.load(1.0, dynamics);
        }
        dynamics.system.set_time(step.time);
    }

    /// The argument of a switch with its rates at the instant evaluated last.
    fn motion(&self, k: usize, dynamics: &mut Dynamics) -> Jet {
        let course = Course {
            rates: &self.rates[2],
            rate_changes: &self.changes[0],
            variable_rates: &self.changes[1],
        };
        dynamics
            .system
            .switch_motion(self.switches[k].place, &course)
    }

    /// The times between which a switch leaves its cell first; `moved` where another instant than the end
    /// was evaluated.
    fn first_excursion(
        &mut self,
        k: usize,
        dynamics: &mut Dynamics,
        step: &bdf::Step<'_>,
        within: Within<'_>,
        moved: &mut bool,
    ) -> Option<[f64; 2]> {
        let start = step.time - step.size;
        let (place, of_time) = (self.switches[k].place, self.switches[k].of_time);
        let Branch::Held(cell) = self.switches[k].branch else {
            return None;
        };
        // An excursion within the error of the argument is none.
        let width = self.switches[k].width;
        let (first, last) = dynamics.system.cell_ends(place, cell);
        let (first, last) = (first - width, last + width);
        let end = Look {
            time: step.time,
            at: self.ends[k],
        };
        self.switches[k].reach_within = 0.0;
        let mut here = Look {
            time: start,
            at: self.starts[k],
        };
        let mut span = if of_time {
            step.size / PIECES
        } else {
            step.size
        };
        for _ in 0..LOOKS[usize::from(!of_time)] {
            let time = here.time + span;
            let next = if time >= step.time {
                end
            } else {
                self.evaluate(time, of_time, dynamics, step, within);
                if !of_time {
                    dynamics.system.evaluate_slopes();
                    *moved = true;
                }
                let at = self.motion(k, dynamics);
                Look { time, at }
            };
            let argument = next.at.value;
            let depth = |argument: f64| (argument - first).min(last - argument);
            let left = if next.time == step.time {
                self.left_for(k, &dynamics.system).is_some()
            } else {
                depth(argument) < 0.0
            };
            let shortest = span <= 4.0 * f64::EPSILON * step.time.abs();
            if left && (shortest || here.goes_one_way_to(&next)) {
                return Some([here.time, next.time]);
            }
            if !left && (shortest || here.stays_until(&next, first, last)) {
                let halfway = here.halfway_to(&next);
                let switch = &mut self.switches[k];
                switch.reach_within = switch.reach_within.max(depth(halfway)).max(depth(argument));
                if next.time == step.time {
                    return None;
                }
                here = next;
                span *= 2.0;
                continue;
            }
            span *= 0.5;
        }
        // The rest is not looked at, but for its end.
        let left = self.left_for(k, &dynamics.system).is_some();
        left.then_some([here.time, step.time])
    }
}
