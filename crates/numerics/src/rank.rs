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
            take_off(&mut rest, &basis);
            let mut left = norm(&rest);
            // Where little is left, a second pass removes the rounding of the first (Kahan: twice is
            // enough).
            if left < 0.5 * length {
                take_off(&mut rest, &basis);
                left = norm(&rest);
            }
            let kept = left > tolerance * length;
            if kept {
                basis.push(rest.iter().map(|a| a / left).collect());
            }
            kept
        })
        .collect()
}

/// Takes the projections on orthonormal rows off `rest`.
fn take_off(rest: &mut [f64], basis: &[Vec<f64>]) {
    for unit in basis {
        let along = dot(rest, unit);
        if along != 0.0 {
            for (a, b) in rest.iter_mut().zip(unit) {
                *a -= along * b;
            }
        }
    }
}

/// Scalar product in eight partial sums, which the processor adds side by side.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (heads_a, tail_a) = a.as_chunks::<8>();
    let (heads_b, tail_b) = b.as_chunks::<8>();
    let mut sums = [0.0; 8];
    for (a, b) in heads_a.iter().zip(heads_b) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    let tail = tail_a.iter().zip(tail_b).map(|(a, b)| a * b);
    sums.iter().sum::<f64>() + tail.sum::<f64>()
}

fn norm(row: &[f64]) -> f64 {
    dot(row, row).sqrt()
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
