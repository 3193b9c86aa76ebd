//! Independent coordinates of small motions, and the displacements of the bodies by them.

use nalgebra::{DMatrix, Matrix3};

use super::Coordinate;
use crate::state::{State, VELOCITIES};
use crate::system::System;

/// Weight of a rotation against a displacement when the dependent components are chosen: rotations
/// stay independent where both will do, as an angle is the better coordinate of a part that turns.
const ROTATION: f64 = 0.1;
/// A pivot below this part of its row's length is none.
const SINGULAR: f64 = 1e-10;
/// Angle, or displacement in lengths of the model, between the instants of a difference. Five points
/// make errors of its fourth power.
const STEP: f64 = 5e-3;

/// Which components of the small motions follow from which, along the axes of a marker or of ground.
pub(super) struct Coordinates {
    reference: Option<usize>,
    dependent: Vec<usize>,
    pub(super) independent: Vec<usize>,
}

/// Displacements of all bodies by the coordinates, and how that changes in time.
pub(super) struct Basis {
    /// `N`.
    pub(super) value: DMatrix<f64>,
    /// `Ṅ`.
    pub(super) rate: DMatrix<f64>,
    /// `N̈`.
    pub(super) second_rate: DMatrix<f64>,
}

impl Coordinates {
    /// Chooses the dependent components by elimination with complete pivoting at the state evaluated
    /// last. `None` where equations depend on one another.
    pub(super) fn choose(system: &System, reference: Option<usize>, length: f64) -> Option<Self> {
        let mut rows = constraint_rows(system, &axes(system, reference));
        let turns = |column: usize| column % VELOCITIES >= 3;
        let mut free: Vec<usize> = (0..system.velocity_count())
            .filter(|&column| !turns(column) || system.model().bodies[column / 6].rotates)
            .collect();
        for mut row in rows.row_iter_mut() {
            for column in 0..row.len() {
                if turns(column) {
                    row[column] /= length;
                }
            }
            let size = row.norm();
            if size > 0.0 {
                row /= size;
            }
        }
        let mut dependent = Vec::with_capacity(rows.nrows());
        for step in 0..rows.nrows() {
            let weight = |column: usize| if turns(column) { ROTATION } else { 1.0 };
            let candidates = (step..rows.nrows())
                .flat_map(|row| free.iter().enumerate().map(move |(k, &c)| (row, k, c)));
            let best = candidates.max_by(|a, b| {
                let size = |(row, _, column): &(usize, usize, usize)| {
                    rows[(*row, *column)].abs() * weight(*column)
                };
                size(a).total_cmp(&size(b))
            });
            let (row, k, column) = best?;
            let pivot = rows[(row, column)];
            if !(pivot.abs() > SINGULAR) {
                return None;
            }
            rows.swap_rows(step, row);
            free.swap_remove(k);
            dependent.push(column);
            for other in step + 1..rows.nrows() {
                let factor = rows[(other, column)] / pivot;
                if factor != 0.0 {
                    for &c in free.iter().chain([&column]) {
                        rows[(other, c)] -= factor * rows[(step, c)];
                    }
                }
            }
        }
        free.sort_unstable();
        Some(Self {
            reference,
            dependent,
            independent: free,
        })
    }

    /// What the independent coordinates are.
    pub(super) fn names(&self) -> Vec<Coordinate> {
        let name = |&column: &usize| Coordinate {
            body: column / VELOCITIES,
            component: column % VELOCITIES,
        };
        self.independent.iter().map(name).collect()
    }

    /// The basis at the state evaluated last: rows of all bodies along ground axes. `None` where the
    /// constraints depend on one another.
    fn value(&self, system: &System) -> Option<DMatrix<f64>> {
        let turn = axes(system, self.reference);
        let rows = constraint_rows(system, &turn);
        self.spread(&rows, &turn)
    }

    /// `L` with `LᵀB = 0` for the `columns` that the reactions act along, at the state evaluated
    /// last. `None` where friction depends on the reactions so that they are not unique.
    pub(super) fn left(&self, system: &System, columns: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        let turn = axes(system, self.reference);
        let rows = along(&columns.transpose(), &turn);
        self.spread(&rows, &turn)
    }

    /// Motions of the independent components one by one, with those of the dependent ones that keep
    /// the `rows` zero, along ground axes.
    fn spread(&self, rows: &DMatrix<f64>, turn: &Matrix3<f64>) -> Option<DMatrix<f64>> {
        let mut basis = DMatrix::zeros(rows.ncols(), self.independent.len());
        for (k, &column) in self.independent.iter().enumerate() {
            basis[(column, k)] = 1.0;
        }
        if !self.dependent.is_empty() {
            let on = |columns: &[usize]| rows.select_columns(columns);
            let factors = on(&self.dependent).lu();
            let follow = factors.solve(&-on(&self.independent))?;
            for (row, &column) in self.dependent.iter().enumerate() {
                basis.row_mut(column).copy_from(&follow.row(row));
            }
        }
        for block in 0..basis.nrows() / 3 {
            let turned = turn * basis.fixed_rows::<3>(3 * block);
            basis.fixed_rows_mut::<3>(3 * block).copy_from(&turned);
        }
        Some(basis)
    }

    /// The basis and its rates along the motion; the state is evaluated again afterwards. Rates are
    /// differences over nearby instants of the motion, and exactly zero at rest.
    pub(super) fn basis(
        &self,
        system: &mut System,
        state: &State,
        accelerations: &[f64],
        length: f64,
    ) -> Option<Basis> {
        system.evaluate(state, false);
        let value = self.value(system)?;
        let zero = || DMatrix::zeros(value.nrows(), value.ncols());
        let (mut rate, mut second_rate) = (zero(), zero());
        let quickness = quickness(state.velocities(), accelerations, length);
        if quickness > 0.0 {
            let step = STEP / quickness;
            // Central differences of fourth order (Abramowitz and Stegun, table 25.2).
            let points = [
                (-2.0, 1.0 / 12.0, -1.0 / 12.0),
                (-1.0, -8.0 / 12.0, 16.0 / 12.0),
                (1.0, 8.0 / 12.0, 16.0 / 12.0),
                (2.0, -1.0 / 12.0, -1.0 / 12.0),
            ];
            for (place, first, second) in points {
                let time = place * step;
                let ahead = |(u, a): (&f64, &f64)| time * (u + 0.5 * time * a);
                let along = state.velocities().iter().zip(accelerations);
                let path: Vec<f64> = along.map(ahead).collect();
                let mut near = state.clone();
                near.time += time;
                near.displace(&path);
                system.evaluate(&near, false);
                let change = self.value(system)? - &value;
                rate += first * &change;
                second_rate += second * change;
            }
            rate /= step;
            second_rate /= step * step;
            system.evaluate(state, false);
        }
        Some(Basis {
            value,
            rate,
            second_rate,
        })
    }
}

/// The largest rate of the motion: angular velocities, velocities over the length, and the roots of
/// accelerations.
fn quickness(velocities: &[f64], accelerations: &[f64], length: f64) -> f64 {
    let unit = |k: usize| if k % VELOCITIES < 3 { length } else { 1.0 };
    let each = velocities.iter().zip(accelerations).enumerate();
    each.map(|(k, (u, a))| (u.abs() / unit(k)).max((a.abs() / unit(k)).sqrt()))
        .fold(0.0, f64::max)
}

/// Axes of the reference at the state evaluated last.
fn axes(system: &System, reference: Option<usize>) -> Matrix3<f64> {
    reference.map_or_else(Matrix3::identity, |marker| system.marker(marker).axes)
}

/// The constraint Jacobian over motions along `axes`.
fn constraint_rows(system: &System, axes: &Matrix3<f64>) -> DMatrix<f64> {
    let mut rows = DMatrix::zeros(system.row_count(), system.velocity_count());
    for (row, &place) in system.rows.iter().enumerate() {
        let evaluated = &system.evaluated[place];
        for (body, block) in evaluated.blocks(&system.constraints[place]) {
            for k in 0..VELOCITIES {
                rows[(row, VELOCITIES * body + k)] = block[k];
            }
        }
    }
    along(&rows, axes)
}

/// Rows over motions along ground axes as rows over motions along `axes`.
fn along(rows: &DMatrix<f64>, axes: &Matrix3<f64>) -> DMatrix<f64> {
    let mut turned = rows.clone();
    for block in 0..rows.ncols() / 3 {
        let product = rows.fixed_columns::<3>(3 * block) * axes;
        turned.fixed_columns_mut::<3>(3 * block).copy_from(&product);
    }
    turned
}
