//! Scales of the rows and columns of a matrix, relative to which its pivots count.

use super::{Matrix, Singular};

/// Units in which the unknowns of a matrix are of the same size: its masses become one, and its
/// constraint equations and reactions, which have nothing on the diagonal, follow from the motions that
/// they bind. The choice of the units of length, mass and time then makes no difference.
pub(super) fn units(matrix: &Matrix) -> Vec<f64> {
    let n = matrix.size();
    let row = |row: usize| {
        let entries = matrix.row_starts()[row]..matrix.row_starts()[row + 1];
        let columns = matrix.columns()[entries.clone()].iter();
        columns
            .map(|&column| column as usize)
            .zip(&matrix.values()[entries])
    };
    let diagonal = |k: usize| -> f64 { row(k).filter(|(c, _)| *c == k).map(|(_, a)| a).sum() };
    let motions: Vec<Option<f64>> = (0..n)
        .map(|k| Some(diagonal(k).abs().sqrt().recip()).filter(|unit| unit.is_finite()))
        .collect();
    let bound = |k: usize| {
        let largest = row(k).fold(0.0, |m: f64, (column, a)| {
            m.max(a.abs() * motions[column].unwrap_or(0.0))
        });
        if largest > 0.0 { largest.recip() } else { 1.0 }
    };
    let units = motions.iter().enumerate();
    units
        .map(|(k, unit)| unit.unwrap_or_else(|| bound(k)))
        .collect()
}

/// The reciprocal of the largest entry of a row, in `units` of the unknowns where there are such: units
/// differ by row.
///
/// # Errors
/// Where an entry is not finite.
pub(super) fn row_scale(
    matrix: &Matrix,
    row: usize,
    units: Option<&[f64]>,
) -> Result<f64, Singular> {
    let entries = matrix.row_starts()[row]..matrix.row_starts()[row + 1];
    let values = &matrix.values()[entries.clone()];
    let largest = largest(values);
    if !largest.is_finite() {
        let bad = values.iter().position(|a| !a.is_finite());
        let column = matrix.columns()[entries.start + bad.unwrap_or(0)] as usize;
        return Err(Singular { row, column });
    }
    let largest = match units {
        None => largest,
        Some(units) => {
            let columns = &matrix.columns()[entries];
            let scaled = values.iter().zip(columns);
            scaled.fold(0.0, |m: f64, (a, &c)| m.max(a.abs() * units[c as usize]))
        }
    };
    Ok(if largest > 0.0 { 1.0 / largest } else { 1.0 })
}

/// The largest magnitude, and not a number where a value is not finite; in four lanes, which the
/// processor works on side by side.
fn largest(values: &[f64]) -> f64 {
    let (heads, tail) = values.as_chunks::<4>();
    let mut largest = [0.0_f64; 4];
    // Zero, unless a value is not finite.
    let mut check = [0.0_f64; 4];
    let mut take = |lane: usize, value: f64| {
        let size = value.abs();
        largest[lane] = if size > largest[lane] {
            size
        } else {
            largest[lane]
        };
        check[lane] += 0.0 * value;
    };
    for chunk in heads {
        for lane in 0..4 {
            take(lane, chunk[lane]);
        }
    }
    tail.iter().for_each(|&value| take(0, value));
    largest.iter().fold(0.0, |m: f64, l| m.max(*l)) + check.iter().sum::<f64>()
}
