//! Which rows of a matrix depend on rows before them.

/// Ordered Gram-Schmidt orthogonalisation with reorthogonalisation.
///
/// `rows` come in order of preference. A row is dependent when less than `tolerance` of its length
/// is left after its projections on the kept rows before it are taken off; a zero row is dependent.
/// Returns for each row whether it is kept.
///
/// ```
/// let rows = [vec![1.0, 0.0], vec![2.0, 0.0], vec![1.0, 1.0]];
/// assert_eq!(numerics::rank::independent_rows(&rows, 1e-9), [true, false, true]);
/// ```
#[must_use]
pub fn independent_rows(rows: &[Vec<f64>], tolerance: f64) -> Vec<bool> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    rows.iter()
        .map(|row| {
            let length = norm(row);
            let mut rest = row.clone();
            // The second pass removes what rounding left of the first (Kahan: twice is enough).
            for _ in 0..2 {
                for unit in &basis {
                    let along: f64 = rest.iter().zip(unit).map(|(a, b)| a * b).sum();
                    if along != 0.0 {
                        for (a, b) in rest.iter_mut().zip(unit) {
                            *a -= along * b;
                        }
                    }
                }
            }
            let left = norm(&rest);
            let kept = left > tolerance * length;
            if kept {
                basis.push(rest.iter().map(|a| a / left).collect());
            }
            kept
        })
        .collect()
}

fn norm(row: &[f64]) -> f64 {
    row.iter().map(|a| a * a).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::independent_rows;

    #[test]
    fn nearly_dependent_rows_follow_the_tolerance() {
        let rows = [vec![1.0, 0.0, 0.0], vec![1.0, 1e-6, 0.0]];
        assert_eq!(independent_rows(&rows, 1e-5), [true, false]);
        assert_eq!(independent_rows(&rows, 1e-7), [true, true]);
    }

    #[test]
    fn zero_rows_are_dependent() {
        assert_eq!(independent_rows(&[vec![0.0, 0.0]], 1e-9), [false]);
    }
}
