//! The derivatives of the equations of motion by all motions of the bodies.

use nalgebra::{DMatrix, Vector3};
use numerics::linear::Matrix;

use crate::constraint::Form;
use crate::rotation::skew;
use crate::state::{State, VELOCITIES};
use crate::system::{Rows, System, Weights};

/// Matrices over the motions of all bodies, six a body along ground axes, and then the differential
/// states; see [`super`]. Algebraic variables are eliminated.
pub(super) struct Derivatives {
    /// By accelerations of the motions.
    pub(super) mass: DMatrix<f64>,
    /// By velocities of the motions.
    pub(super) velocity: DMatrix<f64>,
    /// By displacements.
    pub(super) position: DMatrix<f64>,
    /// By differential states.
    pub(super) state: DMatrix<f64>,
    /// By their rates.
    pub(super) state_rate: DMatrix<f64>,
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

const NONE: Weights = Weights {
    mass: 0.0,
    velocity: 0.0,
    position: 0.0,
    state: 0.0,
    rate: 0.0,
};
/// What the equations are differentiated by.
const BY_MASS: Weights = Weights {
    mass: 1.0,
    rate: 1.0,
    ..NONE
};
const BY_VELOCITY: Weights = Weights {
    velocity: 1.0,
    ..NONE
};
const BY_POSITION_AND_VELOCITY: Weights = Weights {
    velocity: 1.0,
    position: 1.0,
    ..NONE
};
const BY_STATE: Weights = Weights { state: 1.0, ..NONE };

impl System {
    /// The derivatives at an instant that has been solved, with the `rates` of velocities and states
    /// found there. `None` where algebraic variables are not determined, or where the rate of a
    /// state depends on a reaction.
    pub(super) fn derivatives(
        &mut self,
        state: &State,
        rates: &[f64],
        multipliers: &[f64],
        bristles: &Bristles<'_>,
    ) -> Option<Derivatives> {
        let (n, moving) = (self.rate_count(), self.velocity_count());
        let zero = vec![0.0; n];
        self.set_bristles(bristles.deflections, 0.0);
        self.evaluate(state, true);
        self.set_solution(rates, 1.0, multipliers);
        let by_rate = self.dense(BY_MASS, &zero, multipliers);
        let damping = self.dense(BY_VELOCITY, &zero, multipliers);
        let both = self.dense(BY_POSITION_AND_VELOCITY, rates, multipliers);
        let by_state = self.dense(BY_STATE, &zero, multipliers);
        // What a variable follows, in terms of everything else.
        let first = n + self.row_count();
        let variables = by_rate.nrows() - first;
        let own = by_rate.view((first, first), (variables, variables));
        let follow = if variables > 0 {
            let inverse = own.into_owned().try_inverse()?;
            by_rate.view((0, first), (n, variables)) * inverse
        } else {
            DMatrix::zeros(n, 0)
        };
        let rest = |matrix: &DMatrix<f64>, column: usize, count: usize| {
            let direct = matrix.view((0, column), (n, count)).into_owned();
            direct - &follow * matrix.view((first, column), (variables, count))
        };
        let motions = |matrix: &DMatrix<f64>| rest(matrix, 0, moving);
        let velocity = motions(&damping);
        let mut position = motions(&both) - &velocity;
        if self.bristle_count() > 0 {
            // A deflection that follows the displacement of the surfaces for a short time: what it
            // adds to the damper, over that time, is its spring.
            self.set_bristles(bristles.deflections, bristles.short);
            let held = self.dense(BY_VELOCITY, &zero, multipliers);
            position += (motions(&held) - &velocity) / bristles.short;
            self.set_bristles(bristles.deflections, 0.0);
        }
        self.add_function_stiffness(multipliers, &mut position);
        let states = n - moving;
        // Variables may read reactions, and forces those variables.
        let by_multiplier = -rest(&by_rate, n, self.row_count());
        let of_states = by_multiplier.rows(moving, states);
        if of_states.iter().any(|slope| *slope != 0.0) {
            return None;
        }
        Some(Derivatives {
            mass: motions(&by_rate),
            velocity,
            position,
            state: rest(&by_state, moving, states),
            state_rate: rest(&by_rate, moving, states),
            by_multiplier: by_multiplier.rows(0, moving).into_owned(),
        })
    }

    fn dense(&mut self, weights: Weights, w: &[f64], multipliers: &[f64]) -> DMatrix<f64> {
        let size = self.unknown_count();
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
        self.update_markers();
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
        self.update_markers();
        self.evaluate_function(place);
        -self.evaluated[place].unbiased_acceleration
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
