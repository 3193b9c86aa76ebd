//! Eigenvalues and mode shapes of a linearised model.
//!
//! The eigenvalues of `λ² M + λ D + K` are those of a matrix of first order, or where there is no
//! damping and no state the roots of those of `−M⁻¹K`. Parts without mass make `M` singular and some eigenvalues
//! infinite; the others are then found by their distance from a shift,
//! `(A − σE)⁻¹E x = x/(λ − σ)` for `E ẋ = A x` (Golub and Van Loan, *Matrix Computations*, section
//! 7.7).

use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{Complex, DMatrix, DVector, Schur};

use super::Linearization;
use crate::state::VELOCITIES;

/// A mass, or a pivot of the mass matrix, that is this part of the largest is none.
const MASSLESS: f64 = 1e-13;
/// Eigenvalues beyond this multiple of the typical rate of a model with parts without mass are
/// infinite. They come in defective pairs, which rounding moves by the root of its size.
const INFINITE: f64 = 1e6;
/// Iterations for each row of the matrix before its eigenvalues are given up.
const ITERATIONS: usize = 200;
/// An eigenvalue has no further shape where this part of what an iteration finds is all that is new.
const DEFECTIVE: f64 = 1e-6;
/// Distance of the shift of the inverse iteration from its eigenvalue, relative.
const NEAR: f64 = 1e-9;

/// A natural motion `Re(shape · exp(value · time))`.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Eigenvalue, 1/time; of a conjugate pair the one with the positive imaginary part.
    pub value: Complex<f64>,
    /// Displacement (length) and rotation (radians) of every body along ground axes, six numbers
    /// each, such that the largest is one; rotations count by the model's length. Empty where it was
    /// not asked for.
    pub shape: Vec<Complex<f64>>,
}

impl Mode {
    /// Which component of the shape is the largest; none without a shape.
    #[must_use]
    pub fn largest(&self) -> Option<usize> {
        let one = Complex::new(1.0, 0.0);
        self.shape.iter().position(|component| *component == one)
    }
}

/// Eigenvalues that could not be found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModesError {
    /// A part without mass can move without a force.
    Indefinite,
    /// The iteration for the eigenvalues did not converge, or met what is not a number.
    NotConverged,
}

impl std::fmt::Display for ModesError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Indefinite => "a part without mass can move without a force against it",
            Self::NotConverged => "the iteration for the eigenvalues did not converge",
        })
    }
}

impl std::error::Error for ModesError {}

impl Linearization {
    /// Without dampers: of the damping matrix the gyroscopic (skew-symmetric) part stays.
    #[must_use]
    pub fn without_damping(mut self) -> Self {
        let n = self.coordinates.len();
        let mut motions = self.damping.view_mut((0, 0), (n, n));
        let skew = 0.5 * (&motions - motions.transpose());
        motions.copy_from(&skew);
        self
    }

    /// The modes: real eigenvalues and then conjugate pairs, each by magnitude. `shapes` says whether
    /// their shapes are wanted.
    ///
    /// # Errors
    /// [`ModesError`].
    pub fn modes(&self, shapes: bool) -> Result<Vec<Mode>, ModesError> {
        let mut values = self.eigenvalues()?;
        values.retain(|value| value.im >= 0.0);
        values.sort_by(|a, b| {
            let pair = |value: &Complex<f64>| value.im > 0.0;
            pair(a)
                .cmp(&pair(b))
                .then(a.norm().total_cmp(&b.norm()))
                .then(a.re.total_cmp(&b.re))
        });
        let mut modes: Vec<Mode> = Vec::with_capacity(values.len());
        let mut vectors: Vec<DVector<Complex<f64>>> = Vec::new();
        for (place, &value) in values.iter().enumerate() {
            let shape = if shapes {
                let same = values[..place].iter().rev();
                let close = |other: &&Complex<f64>| {
                    (**other - value).norm() <= 1e-6 * (value.norm() + self.rate())
                };
                let count = same.take_while(close).count();
                let vector = self.vector(value, &vectors[place - count..], place)?;
                let shape = self.shape(&vector);
                vectors.push(vector);
                shape
            } else {
                Vec::new()
            };
            modes.push(Mode { value, shape });
        }
        Ok(modes)
    }

    /// A typical rate: root of the ratio of stiffness and mass, or ratio of damping and mass.
    fn rate(&self) -> f64 {
        let n = self.coordinates.len();
        let norm = |matrix: &DMatrix<f64>| matrix.view((0, 0), (n, n)).norm();
        let mass = norm(&self.mass);
        let rate = (norm(&self.stiffness) / mass)
            .sqrt()
            .max(norm(&self.damping) / mass);
        if rate > 0.0 && rate.is_finite() {
            rate
        } else {
            1.0
        }
    }

    /// What multiplies the coordinates so that masses on the diagonal are one; of a coordinate without
    /// mass, rotations in units of the length.
    fn units(&self) -> Vec<f64> {
        let natural = |k: usize| match self.coordinates.get(k) {
            Some(coordinate) if coordinate.component >= 3 => 1.0 / self.length,
            _ => 1.0,
        };
        let mass = |k: usize| natural(k) * natural(k) * self.mass[(k, k)];
        let all = 0..self.mass.nrows();
        let largest = all.clone().map(mass).fold(0.0, f64::max);
        all.map(|k| {
            if mass(k) > MASSLESS * largest {
                1.0 / self.mass[(k, k)].sqrt()
            } else {
                natural(k)
            }
        })
        .collect()
    }

    fn eigenvalues(&self) -> Result<Vec<Complex<f64>>, ModesError> {
        let (n, all) = (self.coordinates.len(), self.mass.nrows());
        if all == 0 {
            return Ok(Vec::new());
        }
        let units = self.units();
        let unit = |k: usize| units[k];
        let scaled = |matrix: &DMatrix<f64>| {
            DMatrix::from_fn(all, all, |r, c| unit(r) * matrix[(r, c)] * unit(c))
        };
        let (mass, damping) = (scaled(&self.mass), scaled(&self.damping));
        let stiffness = scaled(&self.stiffness);
        // E ẋ = A x with x = (p, ż): states are of first order.
        let states = all - n;
        let size = all + n;
        let mut right = DMatrix::zeros(size, size);
        right.view_mut((0, 0), (n, n)).fill_with_identity();
        let by_state = damping.view((0, n), (all, states));
        right.view_mut((n, n), (all, states)).copy_from(&by_state);
        let by_velocity = mass.view((0, 0), (all, n));
        right.view_mut((n, all), (all, n)).copy_from(&by_velocity);
        let mut left = DMatrix::zeros(size, size);
        left.view_mut((0, all), (n, n)).fill_with_identity();
        left.view_mut((n, 0), (all, all)).copy_from(&-&stiffness);
        let by_velocity = -damping.view((0, 0), (all, n));
        left.view_mut((n, all), (all, n)).copy_from(&by_velocity);
        let rate = self.rate();
        let factors = right.clone().full_piv_lu();
        let pivots = factors.u().diagonal().abs();
        let regular = pivots.min() > MASSLESS * pivots.max();
        if regular && damping.iter().all(|entry| *entry == 0.0) {
            let squares = mass.lu().solve(&-stiffness);
            return Ok(roots(
                &of_matrix(squares.ok_or(ModesError::Indefinite)?)?,
                n,
            ));
        }
        if let (true, Some(matrix)) = (regular, factors.solve(&left)) {
            return of_matrix(matrix);
        }
        let shift = 0.7 * rate;
        let matrix = (left - shift * &right).lu().solve(&right);
        let distances = of_matrix(matrix.ok_or(ModesError::Indefinite)?)?;
        let values = distances
            .into_iter()
            .filter(|distance| distance.norm() * INFINITE * rate > 1.0)
            .map(|distance| distance.inv() + shift);
        Ok(values.collect())
    }

    /// The coordinates of a mode by inverse iteration, perpendicular to `others` of its eigenvalue unless it
    /// has no further shape.
    fn vector(
        &self,
        value: Complex<f64>,
        others: &[DVector<Complex<f64>>],
        seed: usize,
    ) -> Result<DVector<Complex<f64>>, ModesError> {
        let n = self.mass.nrows();
        let near = value + Complex::new(NEAR, NEAR) * (value.norm() + 1e-3 * self.rate());
        let complex = |matrix: &DMatrix<f64>| matrix.map(|entry| Complex::new(entry, 0.0));
        let pencil = complex(&self.mass) * (near * near)
            + complex(&self.damping) * near
            + complex(&self.stiffness);
        let factors = pencil.lu();
        // No start that a symmetry of the model makes perpendicular to the mode.
        let start = |k: usize, _| Complex::new(1.0 + ((k * (seed + 2)) as f64).sin(), 0.0);
        let mut vector = DVector::from_fn(n, start);
        for _ in 0..3 {
            vector = factors.solve(&vector).ok_or(ModesError::NotConverged)?;
            let whole = vector.clone();
            for other in others {
                let part = other.dotc(&vector);
                vector -= other * part;
            }
            let mut size = vector.norm();
            if size <= DEFECTIVE * whole.norm() {
                // A free motion is the place and the velocity of one shape.
                vector = whole;
                size = vector.norm();
            }
            if !(size > 0.0 && size.is_finite()) {
                return Err(ModesError::NotConverged);
            }
            vector /= Complex::new(size, 0.0);
        }
        Ok(vector)
    }

    /// The motion of all bodies by the coordinates of a mode.
    fn shape(&self, vector: &DVector<Complex<f64>>) -> Vec<Complex<f64>> {
        let motions = self.motions.map(|entry| Complex::new(entry, 0.0));
        let shape = motions * vector.rows(0, self.coordinates.len());
        let size = |k: usize| {
            let turns = k % VELOCITIES >= 3;
            shape[k].norm() * if turns { self.length } else { 1.0 }
        };
        let largest = (0..shape.len()).max_by(|&a, &b| size(a).total_cmp(&size(b)));
        let unit = largest.map_or(Complex::new(1.0, 0.0), |k| shape[k]);
        let scaled = |(k, component): (usize, &Complex<f64>)| {
            if Some(k) == largest {
                Complex::new(1.0, 0.0)
            } else {
                component / unit
            }
        };
        shape.iter().enumerate().map(scaled).collect()
    }
}

/// Eigenvalues of a matrix.
fn of_matrix(mut matrix: DMatrix<f64>) -> Result<Vec<Complex<f64>>, ModesError> {
    let finite = matrix.iter().all(|entry| entry.is_finite());
    if !finite {
        return Err(ModesError::NotConverged);
    }
    balance_parlett_reinsch(&mut matrix);
    let rows = matrix.nrows();
    let schur = Schur::try_new(matrix, f64::EPSILON, ITERATIONS * rows);
    let schur = schur.ok_or(ModesError::NotConverged)?;
    Ok(schur.complex_eigenvalues().iter().copied().collect())
}

/// Both roots of every square; a square that is the rounding of the largest is zero.
fn roots(squares: &[Complex<f64>], rows: usize) -> Vec<Complex<f64>> {
    let largest = squares
        .iter()
        .map(|square| square.norm())
        .fold(0.0, f64::max);
    let rounding = 4.0 * rows as f64 * f64::EPSILON * largest;
    let each = squares.iter().flat_map(|square| {
        if square.norm() <= rounding {
            return [Complex::new(0.0, 0.0); 2];
        }
        // The root of a negative real number has no real part, whatever the sign of its zero.
        let root = if square.im == 0.0 && square.re < 0.0 {
            Complex::new(0.0, (-square.re).sqrt())
        } else {
            square.sqrt()
        };
        [root, -root]
    });
    each.collect()
}
