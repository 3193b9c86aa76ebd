//! The derivatives of the equations of motion by all motions of the bodies.

use nalgebra::{DMatrix, Vector3};
use numerics::linear::Matrix;

use crate::constraint::Form;
use crate::rotation::skew;
use crate::state::{State, VELOCITIES};
use crate::system::{Rows, System, Weights};

/// Matrices over the motions of all bodies, six a body along ground axes; see [`super`].
pub(super) struct Derivatives {
    pub(super) mass: DMatrix<f64>,
    pub(super) damping: DMatrix<f64>,
    pub(super) stiffness: DMatrix<f64>,
    /// `B`, by equation in force.
    pub(super) by_multiplier: DMatrix<f64>,
}

/// What is known of the bristles at the instant.
pub(super) struct Bristles<'a> {
    /// Their deflections.
    pub(super) deflections: &'a [f64],
    /// A time that is short against every motion.
    pub(super) short: f64,
}

impl System {
    /// The derivatives at an instant that has been solved.
    pub(super) fn derivatives(
        &mut self,
        state: &State,
        accelerations: &[f64],
        multipliers: &[f64],
        bristles: &Bristles<'_>,
    ) -> Derivatives {
        let n = self.velocity_count();
        let zero = vec![0.0; n];
        self.set_bristles(bristles.deflections, 0.0);
        self.evaluate(state, true);
        let at = |mass: f64, velocity: f64, position: f64| Weights {
            mass,
            velocity,
            position,
        };
        let mass = self.dense(at(1.0, 0.0, 0.0), &zero, multipliers);
        let damping = self.dense(at(0.0, 1.0, 0.0), &zero, multipliers);
        let both = self.dense(at(0.0, 1.0, 1.0), accelerations, multipliers);
        let square = |matrix: &DMatrix<f64>| matrix.view((0, 0), (n, n)).into_owned();
        let by_multiplier = -mass.view((0, n), (n, self.row_count())).into_owned();
        let mut stiffness = square(&both) - square(&damping);
        if self.bristle_count() > 0 {
            // A deflection that follows the displacement of the surfaces for a short time: what it
            // adds to the damper, over that time, is its spring.
            self.set_bristles(bristles.deflections, bristles.short);
            let held = self.dense(at(0.0, 1.0, 0.0), &zero, multipliers);
            stiffness += (square(&held) - square(&damping)) / bristles.short;
            self.set_bristles(bristles.deflections, 0.0);
        }
        self.add_function_stiffness(multipliers, &mut stiffness);
        Derivatives {
            mass: square(&mass),
            damping: square(&damping),
            stiffness,
            by_multiplier,
        }
    }

    fn dense(&mut self, weights: Weights, w: &[f64], multipliers: &[f64]) -> DMatrix<f64> {
        let size = self.velocity_count() + self.row_count();
        let mut matrix = Matrix::new(size);
        self.assemble(Rows::Position, weights, w, multipliers, &mut matrix);
        DMatrix::from_row_slice(size, size, &matrix.to_dense())
    }

    /// Takes `∂(Gᵀλ)/∂x` of general constraints off the stiffness.
    fn add_function_stiffness(&mut self, multipliers: &[f64], stiffness: &mut DMatrix<f64>) {
        for row in 0..self.rows.len() {
            let place = self.rows[row];
            if self.constraints[place].form != Form::Function || multipliers[row] == 0.0 {
                continue;
            }
            let (columns, curvature) = self.function_curvature(place);
            for (r, &row_column) in columns.iter().enumerate() {
                for (c, &column) in columns.iter().enumerate() {
                    stiffness[(row_column, column)] -= multipliers[row] * curvature[(r, c)];
                }
            }
        }
    }

    /// `∂(Gᵀ)/∂x` of a general constraint and the motions that it is over.
    ///
    /// Along a steady motion `u` the function has the second derivative `uᵀ(∂Gᵀ/∂x)u` and terms that
    /// are linear in `u`, which four motions `±a±b` leave with the symmetric part alone; the other
    /// part is that of rotations that do not commute, `∂G_i/∂θ_j − ∂G_j/∂θ_i = ε_ijk G_k`.
    fn function_curvature(&mut self, place: usize) -> (Vec<usize>, DMatrix<f64>) {
        let bodies = self.constraints[place].bodies.clone();
        let columns: Vec<usize> = bodies
            .iter()
            .flat_map(|body| (0..VELOCITIES).map(move |k| VELOCITIES * body + k))
            .collect();
        let kept = self.bodies.clone();
        let mut curvature = DMatrix::zeros(columns.len(), columns.len());
        for a in 0..columns.len() {
            for b in a..columns.len() {
                let mut sum = 0.0;
                for (sign, of_b, of_all) in [
                    (1.0, 1.0, 1.0),
                    (1.0, 1.0, -1.0),
                    (-1.0, -1.0, 1.0),
                    (-1.0, -1.0, -1.0),
                ] {
                    let mut motion = vec![0.0; self.velocity_count()];
                    motion[columns[a]] += of_all;
                    motion[columns[b]] += of_all * of_b;
                    sum += sign * self.second_rate_of_function(place, &bodies, &motion);
                }
                curvature[(a, b)] = sum / 8.0;
                curvature[(b, a)] = sum / 8.0;
            }
        }
        self.bodies = kept;
        self.evaluate_function(place);
        for (block, jacobian) in self.evaluated[place].jacobian.iter().enumerate() {
            let turning = Vector3::from_column_slice(&jacobian[3..]);
            let mut view =
                curvature.fixed_view_mut::<3, 3>(VELOCITIES * block + 3, VELOCITIES * block + 3);
            view -= 0.5 * skew(&turning);
        }
        (columns, curvature)
    }

    fn second_rate_of_function(&mut self, place: usize, bodies: &[usize], motion: &[f64]) -> f64 {
        for &body in bodies {
            let u = &motion[VELOCITIES * body..VELOCITIES * (body + 1)];
            self.bodies[body].velocity = Vector3::from_column_slice(&u[..3]);
            self.bodies[body].omega = Vector3::from_column_slice(&u[3..]);
        }
        self.evaluate_function(place);
        -self.evaluated[place].acceleration
    }
}

/// `diag(0, a×)` times a matrix whose rows are motions of all bodies, where `a` are the rotations in
/// `rates`.
pub(super) fn turned(rates: &[f64], matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let mut turned = DMatrix::zeros(matrix.nrows(), matrix.ncols());
    for (body, rates) in rates.chunks_exact(VELOCITIES).enumerate() {
        let first = VELOCITIES * body + 3;
        let cross = skew(&Vector3::from_column_slice(&rates[3..]));
        let product = cross * matrix.fixed_rows::<3>(first);
        turned.fixed_rows_mut::<3>(first).copy_from(&product);
    }
    turned
}
