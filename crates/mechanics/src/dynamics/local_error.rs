//! The error of a step against the tolerance, and where it is largest.

use super::{Dynamics, Formulation, Index};
use crate::model::Label;
use crate::state::{POSITIONS, VELOCITIES};

/// Part of the longest step below which steps of SI2 that are solved as I3 have no test of velocities.
const SHORTEST_TESTED: f64 = 1e-3;

/// The largest of some sizes and its place; what is not a number stays.
#[derive(Clone, Copy, Default)]
struct Largest {
    size: f64,
    place: usize,
}

impl Largest {
    fn take(&mut self, size: f64, place: usize) {
        if size > self.size || size.is_nan() {
            (self.size, self.place) = (size, place);
        }
    }

    /// The largest of what is measured in lengths and in angles: of `N` numbers a body the first three,
    /// and the others. `units` are those of the two, `first` is the place of the first number.
    fn take_motions<const N: usize>(&mut self, motions: &[f64], first: usize, units: [f64; 2]) {
        let mut largest = [Self::default(); 2];
        for (body, motion) in motions.as_chunks::<N>().0.iter().enumerate() {
            for (k, d) in motion.iter().enumerate() {
                largest[usize::from(k >= 3)].take(d.abs(), first + N * body + k);
            }
        }
        for (largest, unit) in largest.into_iter().zip(units) {
            self.take(largest.size / unit, largest.place);
        }
    }
}

impl Dynamics {
    /// The largest part of a difference of states, in units of the error that a step may make, and its
    /// place among the values.
    pub(crate) fn largest_error(&mut self, difference: &[f64]) -> (f64, usize) {
        let places = POSITIONS * self.system.model.bodies.len();
        let (length, rate) = (self.scales.length, self.scales.rate);
        let mut largest = Largest::default();
        let (tolerance, allowed) = (self.tolerance(), self.position_tolerance());
        // A rotation is twice the change of its quaternion.
        let units = [length * allowed, 0.5 * allowed];
        largest.take_motions::<POSITIONS>(&difference[..places], 0, units);
        let velocities = &difference[places..self.state.motions()];
        let (velocities, allowed): (&[f64], f64) =
            if self.present != Index::Three || self.formulation.tests_velocities() {
                (velocities, allowed)
            } else if self.tests_free_velocities() {
                self.free_velocities(velocities);
                (&self.right[..velocities.len()], self.motion_error)
            } else {
                (&[], allowed)
            };
        let scale = rate + self.left_of_velocities;
        let units = [length * scale * allowed, scale * allowed];
        largest.take_motions::<VELOCITIES>(velocities, places, units);
        let states = self.state.state_range();
        let scales = self.state_scales.iter().zip(self.state.states());
        for ((k, d), (scale, now)) in states.clone().zip(&difference[states]).zip(scales) {
            largest.take(d.abs() / (scale.max(now.abs()) * tolerance), k);
        }
        let bristles = self.state.bristle_range();
        let errors = bristles.clone().zip(&difference[bristles]);
        for ((k, d), error) in errors.zip(&self.bristle_errors) {
            if *error > 0.0 {
                largest.take(d.abs() / error, k);
            }
        }
        for k in self.state.share_range() {
            largest.take(self.switching.norm(&difference[k..=k]), k);
        }
        (largest.size, largest.place)
    }

    /// Whether the error test of the present step looks at the part of velocities that constraints leave
    /// free. With bristles it does not: reactions of index 3 are rough, and what friction makes of them is
    /// no smaller in a shorter step. Short steps of SI2 that are solved as I3 pass what has no solution
    /// with the velocities that it asks for.
    pub(super) fn tests_free_velocities(&self) -> bool {
        matches!(self.formulation, Formulation::I3 | Formulation::Si2)
            && self.step_size > SHORTEST_TESTED * self.steps[1]
            && self.bristle_errors.is_empty()
            && self.factored.is_some()
    }

    /// The part of a difference of velocities that constraints leave free, by the Newton matrix.
    ///
    /// Velocities of index 3 are off along the constraint forces by what the formula makes of errors of
    /// positions, in short steps as in long ones, so that no test of them can be met. Elsewhere they have
    /// the error of any other method, which a bend of the forces within the step (friction that comes to
    /// stick) makes large while positions hardly show it. The Newton matrix tells one from the other
    /// (L. R. Petzold, *Differential/algebraic equations are not ODE's*, SIAM Journal on Scientific and
    /// Statistical Computing 3, 1982: errors are filtered by the iteration matrix).
    fn free_velocities(&mut self, difference: &[f64]) {
        self.momentum.fill(0.0);
        self.momentum[..difference.len()].copy_from_slice(difference);
        self.right.fill(0.0);
        let rates = &mut self.right[..self.momentum.len()];
        self.system.mass_times(&self.momentum, rates);
        self.factors.solve(&mut self.right);
    }

    /// What a place among the values means, and the element that it belongs to.
    pub(crate) fn describe_value(&self, place: usize) -> (String, Option<Label>) {
        let model = &self.system.model;
        let motion = |body: usize, kind: &str, component: &str| {
            let label = &model.bodies[body].label;
            (format!("{label}, {kind} {component}"), Some(label.clone()))
        };
        let axis = |k: usize| ["X", "Y", "Z"][k % 3];
        let places = POSITIONS * model.bodies.len();
        if place < places {
            return match place % POSITIONS {
                k @ 0..3 => motion(place / POSITIONS, "position", axis(k)),
                _ => motion(place / POSITIONS, "orientation", ""),
            };
        }
        if place < self.state.motions() {
            let k = place - places;
            let kind = if k % VELOCITIES < 3 {
                "velocity"
            } else {
                "rotation about"
            };
            return motion(k / VELOCITIES, kind, axis(k));
        }
        let of = |label: &Label| (label.to_string(), Some(label.clone()));
        let (states, bristles) = (self.state.state_range(), self.state.bristle_range());
        if states.contains(&place) {
            return of(&model.states[place - states.start].label);
        }
        if bristles.contains(&place) {
            let friction = self.system.friction_of_bristle(place - bristles.start);
            let (name, label) = of(&model.frictions[friction].label);
            return (format!("the bristles of {name}"), label);
        }
        let share = place - self.state.share_range().start;
        let (name, label) = of(self.switching.element(share, &self.system));
        (format!("where a function of {name} jumps"), label)
    }
}
