//! How the forces of equations between two markers change with where the bodies are.
//!
//! All equations between a pair of markers together apply a force `F` at the origin of I, fixed to J
//! but for curves, and a moment on I that depends on both orientations; J has the opposite. That
//! is what is summed up, so that a joint costs little more than one equation.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};

use super::{Angle, Axis, Equation, Local, LocalMatrix, Pair, parts, position};
use crate::curve::Curve;
use crate::rotation::skew;

/// The change of what equations apply, each with a multiplier, to the two bodies of a pair.
#[derive(Clone, Debug)]
pub(crate) struct Stiffness {
    /// Force at the origin of I, on J where that is along the axes on which it is free; it turns with J.
    force: Vector3<f64>,
    /// Change of that force, seen from J, with the place of the origin of I there; ground axes.
    by_place: Option<Matrix3<f64>>,
    /// Change of the moment on I with the rotation of I.
    by_i: Matrix3<f64>,
    /// Change of the moment on I with the rotation of J.
    by_j: Matrix3<f64>,
}

/// Which parts of the local motions (`δr_I, δθ_I, δr_J, δθ_J`) a stiffness connects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Reach {
    /// Rotations with rotations.
    Turns,
    /// What a force that is fixed to J does.
    Force,
    /// Everything with everything.
    Place,
}

impl Reach {
    /// Whether the forces along part `row` depend on part `column`.
    pub(crate) const fn connects(self, row: usize, column: usize) -> bool {
        let turns = (row % 2 == 1, column % 2 == 1);
        match self {
            Self::Turns => turns.0 && turns.1,
            // Forces turn with J; moments about the centre of J's body depend on all places.
            Self::Force => turns.0 && turns.1 || row == 3 || column == 3,
            Self::Place => true,
        }
    }
}

impl Equation {
    /// What its stiffness connects.
    pub(crate) const fn reach(self) -> Reach {
        match self {
            Self::Axes(..) | Self::About(_) | Self::EvenTurns { .. } => Reach::Turns,
            Self::Along(_) | Self::Thread { .. } => Reach::Force,
            Self::OnCurve { .. } => Reach::Place,
        }
    }

    /// `∂(Gᵀ)/∂x` for a unit multiplier: the change of the reaction with the configuration.
    ///
    /// With the multiplier it is the geometric stiffness `∂(Gᵀλ)/∂x`; its transpose times the
    /// velocities is `∂(G u)/∂x`.
    pub(crate) fn stiffness(self, pair: &Pair<'_>, curves: &[Curve]) -> Stiffness {
        let mut stiffness = Stiffness::none();
        stiffness.add(self, 1.0, pair, curves);
        stiffness
    }
}

impl Stiffness {
    /// That of no equations.
    pub(crate) fn none() -> Self {
        Self {
            force: Vector3::zeros(),
            by_place: None,
            by_i: Matrix3::zeros(),
            by_j: Matrix3::zeros(),
        }
    }

    /// Adds that of an equation with its multiplier.
    pub(crate) fn add(
        &mut self,
        equation: Equation,
        multiplier: f64,
        pair: &Pair<'_>,
        curves: &[Curve],
    ) {
        match equation {
            Equation::Along(k) => self.force += multiplier * pair.j.axis(k),
            Equation::Axes(k, l) => self.add_axes(k, l, multiplier, pair),
            Equation::About(axis) => self.add_angle(axis, multiplier, pair),
            Equation::Thread { about, pitch, .. } => {
                self.force += multiplier * pair.j.axis(2);
                self.add_angle(about, -multiplier * pitch / TAU, pair);
            }
            Equation::OnCurve { curve, component } => {
                let axes = &pair.j.axes;
                let across = curves[curve].across(&position(pair))[component];
                self.force += multiplier * (axes * across.gradient);
                let bend = multiplier * (axes * across.hessian * axes.transpose());
                self.by_place = Some(self.by_place.map_or(bend, |sum| sum + bend));
            }
            Equation::EvenTurns { away } => {
                let sign = if away { 1.0 } else { -1.0 };
                self.add_axes(0, 1, multiplier, pair);
                self.add_axes(1, 0, sign * multiplier, pair);
            }
        }
    }

    fn add_axes(&mut self, k: usize, l: usize, multiplier: f64, pair: &Pair<'_>) {
        // δ(a × b) = b×a× δθ_I − a×b× δθ_J
        let by_i = twice_across(&(multiplier * pair.j.axis(l)), &pair.i.axis(k));
        self.by_i += by_i;
        self.by_j -= by_i.transpose();
    }

    fn add_angle(&mut self, axis: Axis, multiplier: f64, pair: &Pair<'_>) {
        let (_, [(k, l), (m, n)]) = axis.angle();
        let Angle {
            sign,
            sine,
            cosine,
            r2,
        } = Angle::new(pair, axis);
        let (s, c) = (sine.value / r2, cosine.value / r2);
        self.add_axes(k, l, sign * multiplier * c, pair);
        self.add_axes(m, n, -sign * multiplier * s, pair);
        // δ(c/r²) and δ(s/r²), with δs and δc along their moments.
        let d_r2 = 2.0 * (sine.value * sine.moment + cosine.value * cosine.moment);
        let by_sine = (cosine.moment - d_r2 * c) / r2;
        let by_cosine = (sine.moment - d_r2 * s) / r2;
        let turned = sign
            * multiplier
            * (sine.moment * by_sine.transpose() - cosine.moment * by_cosine.transpose());
        self.by_i += turned;
        self.by_j -= turned;
    }

    /// Its transpose times the velocities.
    pub(crate) fn rate_change(&self, pair: &Pair<'_>) -> Local {
        let (f, arm) = (self.force, pair.i.arm);
        let (turning, drift) = (pair.turning(), pair.drift());
        let turned = pair.j.omega.cross(&f);
        // What the part of the displacement that is held adds is zero.
        let along = pair.free(turned);
        let held = along - turned;
        let on_i = arm.cross(&(f.cross(&turning) + held)) + self.by_i.tr_mul(&turning);
        let on_j = f.cross(&drift) - pair.reach.cross(&held) + self.by_j.tr_mul(&turning);
        let mut change = parts(&along, &on_i, &-along, &on_j);
        if let Some(bend) = &self.by_place {
            let f = bend * drift;
            change += parts(&f, &arm.cross(&f), &-f, &-pair.reach.cross(&f));
        }
        change
    }

    /// The matrix over the local motions.
    pub(crate) fn matrix(&self, pair: &Pair<'_>) -> LocalMatrix {
        let mut matrix = LocalMatrix::zeros();
        let mut add = |row: usize, column: usize, block: &Matrix3<f64>| {
            let mut view = matrix.fixed_view_mut::<3, 3>(3 * row, 3 * column);
            view += block;
        };
        // The pair of forces ±F at o_I, with F turning with J: δF = −F× δθ_J.
        let turned = twice_across(&self.force, &pair.i.arm);
        let by_i = turned + self.by_i;
        let by_j = self.by_j - turned.transpose();
        let f = skew(&self.force);
        // Where the force acts on J follows I along the axes on which that is free.
        let followed = f * pair.free_matrix();
        let held = followed - f;
        let reach = skew(&pair.reach);
        add(0, 3, &-f);
        add(1, 1, &by_i);
        add(1, 3, &by_j);
        add(2, 3, &f);
        add(3, 0, &followed);
        add(3, 1, &(-by_i - held * skew(&pair.i.arm)));
        add(3, 2, &-followed);
        add(
            3,
            3,
            &(twice_across(&pair.reach, &self.force) + held * reach - self.by_j),
        );
        if let Some(bend) = &self.by_place {
            // δ(o_I − o_J) seen from J = δr_I − ρ× δθ_I − δr_J + c× δθ_J, and so the force acts.
            let one = Matrix3::identity();
            let arms = [one, skew(&pair.i.arm), -one, -skew(&pair.reach)];
            for (row, arm) in arms.iter().enumerate() {
                for (column, other) in arms.iter().enumerate() {
                    add(row, column, &(arm * bend * other.transpose()));
                }
            }
        }
        matrix
    }
}

/// `a× b×`, which is `b aᵀ − (a · b)`.
fn twice_across(a: &Vector3<f64>, b: &Vector3<f64>) -> Matrix3<f64> {
    b * a.transpose() - Matrix3::from_diagonal_element(a.dot(b))
}
