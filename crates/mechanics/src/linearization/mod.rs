//! Small motions about an instant: mass, damping and stiffness in independent coordinates.
//!
//! With displacements `δx` and changes of velocity `δu` of all bodies (`system`), the equations of
//! motion vary as
//!
//! ```text
//! M δu̇ + K δx + D δu = B δλ        B = Gᵀ + ∂f/∂λ
//! D = −∂(Q+f)/∂u        K = −∂(Q+f+Gᵀλ)/∂x + ∂(M u̇)/∂x
//! G δx = 0
//! ```
//!
//! at the reactions `λ` and accelerations `u̇` of the instant, so that `K` holds the change of the
//! constraint forces with the configuration (the geometric stiffness of a pendulum) and the turning
//! of forces that follow a body, and `D` gyroscopic terms. Displacements that the constraints allow
//! are `δx = N z` with as many independent coordinates `z` as there are degrees of freedom, some of
//! the components of `δx` themselves (Negrut and Ortiz, *On an approach for the linearization of the
//! differential algebraic equations of multibody dynamics*, ASME DETC2005-85109). Ground axes turn
//! the rotations, `δθ̇ = δω + ω × δθ`, so with `W = diag(0, ω×)`
//!
//! ```text
//! δu = N ż + V z,    V = Ṅ − W N,    δu̇ = N z̈ + (Ṅ + V) ż + V̇ z
//! ```
//!
//! and multiplied with `L`, for which `LᵀB = 0`, the reactions drop out:
//!
//! ```text
//! LᵀM N z̈ + Lᵀ(M (Ṅ+V) + D N) ż + Lᵀ(M V̇ + K N + D V) z = 0
//! ```
//!
//! Differential states `y` of system elements stand beside `z` with equations of first order, and
//! algebraic variables are eliminated. `L` is `N` where no friction depends on a reaction. Velocity and acceleration constraints hold
//! displacements, too: what they prescribe is a function of time.
//!
//! Friction that sticks is the spring and damper that its law is there, with the anchor held. LuGre
//! bristles are springs; how they relax while the joint creeps or slides is left out.

mod coordinates;
mod derivatives;
mod modes;

use nalgebra::DMatrix;

pub use modes::{Mode, ModesError};

use crate::simulation::{Cause, RunError, Simulation};
use coordinates::Coordinates;
use derivatives::{Bristles, turned};

/// Forces that leave this part of those of the model unbalanced are in balance.
const BALANCED: f64 = 1e-6;
/// A time that is short against every motion, in those of one radian at the model's largest rate.
const SHORT: f64 = 1e-6;

/// A component of the small motion of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinate {
    /// The body, by its place in the model.
    pub body: usize,
    /// 0 to 2: displacement of its centre of mass along x, y, z; 3 to 5: rotation about them.
    pub component: usize,
}

/// A model linearised at an instant: `mass p̈ + damping ṗ + stiffness p = 0` with `p` the independent
/// coordinates `z` and then the differential states, which have no mass.
#[derive(Clone, Debug)]
pub struct Linearization {
    /// Time of the instant.
    pub time: f64,
    /// What the independent coordinates `z` are, along the axes of the reference frame.
    pub coordinates: Vec<Coordinate>,
    /// Mass matrix; the unit of an entry follows from its row and column.
    pub mass: DMatrix<f64>,
    /// Damping and gyroscopic matrix.
    pub damping: DMatrix<f64>,
    /// Stiffness matrix.
    pub stiffness: DMatrix<f64>,
    /// Displacement of all bodies, six numbers each along ground axes, by the coordinates: `N`.
    motions: DMatrix<f64>,
    /// Typical length of the model, by which rotations count as displacements.
    length: f64,
}

impl Simulation {
    /// Linearises the model at its present instant. Small motions are seen from the marker
    /// `reference` (its place in the model), so that a machine that turns steadily with it is at
    /// rest; from ground without one.
    ///
    /// Accelerations and reactions are solved first, except at an equilibrium of parts without mass,
    /// where those of rest serve.
    ///
    /// # Errors
    /// [`RunError`] where accelerations and reactions have no unique solution, or where constraints
    /// depend on one another at this instant.
    pub fn linearize(&mut self, reference: Option<usize>) -> Result<Linearization, RunError> {
        let solved = self.solve_instant();
        if solved.is_err() && self.rests_in_balance() {
            self.accelerations.fill(0.0);
        } else {
            solved?;
        }
        let length = self.scales.length;
        let range = self.state.bristle_range();
        let bristles = Bristles {
            deflections: &self.state.values[range],
            short: SHORT / self.scales.rate,
        };
        let (state, rates) = (&self.state, &self.accelerations);
        let accelerations = &rates[..self.system.velocity_count()];
        let parts = self
            .system
            .derivatives(state, rates, &self.multipliers, &bristles);
        let chosen = Coordinates::choose(&self.system, reference, length);
        let found = chosen.zip(parts).and_then(|(coordinates, parts)| {
            let basis = coordinates.basis(&mut self.system, state, accelerations, length)?;
            let left = coordinates.left(&self.system, &parts.by_multiplier)?;
            Some((coordinates.names(), parts, basis, left))
        });
        // The equation that the elimination could not use is not known by name.
        let Some((coordinates, parts, basis, left)) = found else {
            return Err(RunError {
                time: self.state.time,
                message:
                    "constraints depend on one another here, friction on the reactions so that \
                          they are not unique, or the rate of a state on a reaction; the model \
                          cannot be linearised"
                        .to_owned(),
                element: None,
                cause: Cause::NotLinear,
            });
        };
        let (n, rate) = (&basis.value, &basis.rate);
        let velocity = rate - turned(state.velocities(), n);
        let velocity_rate =
            &basis.second_rate - turned(accelerations, n) - turned(state.velocities(), rate);
        let reduce = |motions: DMatrix<f64>, states: &DMatrix<f64>| join(&left, motions, states);
        let none = DMatrix::zeros(parts.state.nrows(), parts.state.ncols());
        let damping = &parts.mass * (rate + &velocity) + &parts.velocity * n;
        let stiffness =
            &parts.mass * velocity_rate + &parts.position * n + &parts.velocity * &velocity;
        Ok(Linearization {
            time: state.time,
            coordinates,
            mass: reduce(&parts.mass * n, &none),
            damping: reduce(damping, &parts.state_rate),
            stiffness: reduce(stiffness, &parts.state),
            motions: basis.value,
            length,
        })
    }

    /// Whether the model is at rest and the reactions found last balance all forces.
    fn rests_in_balance(&mut self) -> bool {
        if self.state.velocities().iter().any(|u| *u != 0.0) {
            return false;
        }
        let mut forces = vec![0.0; self.system.rate_count()];
        self.system.set_statics(false);
        self.system.evaluate(&self.state, false);
        self.system.set_solution(&forces, 1.0, &self.multipliers);
        self.system.forces(&self.multipliers, &mut forces);
        // Without any load, what would move the model by its length in a unit of time.
        let mass: f64 = self.model().bodies.iter().map(|body| body.mass).sum();
        let unloaded = mass * self.scales.length * self.scales.rate * self.scales.rate;
        let typical = self.system.typical_force(&self.multipliers);
        let least = BALANCED * typical.max(unloaded);
        forces.iter().all(|force| force.abs() <= least)
    }
}

/// The equations of the motions, multiplied with `left`, over the coordinates and the states, with
/// those of the states below.
fn join(left: &DMatrix<f64>, motions: DMatrix<f64>, states: &DMatrix<f64>) -> DMatrix<f64> {
    let (moving, n, s) = (left.nrows(), left.ncols(), states.ncols());
    let mut joined = DMatrix::zeros(n + s, n + s);
    for (first, columns) in [(0, &motions), (n, states)] {
        let above = left.tr_mul(&columns.rows(0, moving));
        joined
            .view_mut((0, first), (n, columns.ncols()))
            .copy_from(&above);
        joined
            .view_mut((n, first), (s, columns.ncols()))
            .copy_from(&columns.rows(moving, s));
    }
    joined
}
