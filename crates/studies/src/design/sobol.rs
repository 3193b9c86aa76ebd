//! Sobol' points, without scrambling: those of `scipy.stats.qmc.Sobol(d, scramble=False)`.
//!
//! Bratley, Fox, *Algorithm 659: implementing Sobol's quasirandom sequence generator*, ACM TOMS 14
//! (1988), in the order of the Gray code; direction numbers `new-joe-kuo-6.21201` of Joe, Kuo,
//! *Constructing Sobol sequences with better two-dimensional projections*, SIAM J. Sci. Comput. 30
//! (2008).

/// Binary digits of a point.
const BITS: usize = 32;

/// Of each parameter from the second on: its primitive polynomial, whose coefficients are the binary
/// digits, and the first direction numbers.
#[rustfmt::skip]
const DIRECTIONS: [(u32, &[u32]); 63] = [
    (3, &[1]),
    (7, &[1, 3]),
    (11, &[1, 3, 1]),
    (13, &[1, 1, 1]),
    (19, &[1, 1, 3, 3]),
    (25, &[1, 3, 5, 13]),
    (37, &[1, 1, 5, 5, 17]),
    (41, &[1, 1, 5, 5, 5]),
    (47, &[1, 1, 7, 11, 19]),
    (55, &[1, 1, 5, 1, 1]),
    (59, &[1, 1, 1, 3, 11]),
    (61, &[1, 3, 5, 5, 31]),
    (67, &[1, 3, 3, 9, 7, 49]),
    (91, &[1, 1, 1, 15, 21, 21]),
    (97, &[1, 3, 1, 13, 27, 49]),
    (103, &[1, 1, 1, 15, 7, 5]),
    (109, &[1, 3, 1, 15, 13, 25]),
    (115, &[1, 1, 5, 5, 19, 61]),
    (131, &[1, 3, 7, 11, 23, 15, 103]),
    (137, &[1, 3, 7, 13, 13, 15, 69]),
    (143, &[1, 1, 3, 13, 7, 35, 63]),
    (145, &[1, 3, 5, 9, 1, 25, 53]),
    (157, &[1, 3, 1, 13, 9, 35, 107]),
    (167, &[1, 3, 1, 5, 27, 61, 31]),
    (171, &[1, 1, 5, 11, 19, 41, 61]),
    (185, &[1, 3, 5, 3, 3, 13, 69]),
    (191, &[1, 1, 7, 13, 1, 19, 1]),
    (193, &[1, 3, 7, 5, 13, 19, 59]),
    (203, &[1, 1, 3, 9, 25, 29, 41]),
    (211, &[1, 3, 5, 13, 23, 1, 55]),
    (213, &[1, 3, 7, 3, 13, 59, 17]),
    (229, &[1, 3, 1, 3, 5, 53, 69]),
    (239, &[1, 1, 5, 5, 23, 33, 13]),
    (241, &[1, 1, 7, 7, 1, 61, 123]),
    (247, &[1, 1, 7, 9, 13, 61, 49]),
    (253, &[1, 3, 3, 5, 3, 55, 33]),
    (285, &[1, 3, 1, 15, 31, 13, 49, 245]),
    (299, &[1, 3, 5, 15, 31, 59, 63, 97]),
    (301, &[1, 3, 1, 11, 11, 11, 77, 249]),
    (333, &[1, 3, 1, 11, 27, 43, 71, 9]),
    (351, &[1, 1, 7, 15, 21, 11, 81, 45]),
    (355, &[1, 3, 7, 3, 25, 31, 65, 79]),
    (357, &[1, 3, 1, 1, 19, 11, 3, 205]),
    (361, &[1, 1, 5, 9, 19, 21, 29, 157]),
    (369, &[1, 3, 7, 11, 1, 33, 89, 185]),
    (391, &[1, 3, 3, 3, 15, 9, 79, 71]),
    (397, &[1, 3, 7, 11, 15, 39, 119, 27]),
    (425, &[1, 1, 3, 1, 11, 31, 97, 225]),
    (451, &[1, 1, 1, 3, 23, 43, 57, 177]),
    (463, &[1, 3, 7, 7, 17, 17, 37, 71]),
    (487, &[1, 3, 1, 5, 27, 63, 123, 213]),
    (501, &[1, 1, 3, 5, 11, 43, 53, 133]),
    (529, &[1, 3, 5, 5, 29, 17, 47, 173, 479]),
    (539, &[1, 3, 3, 11, 3, 1, 109, 9, 69]),
    (545, &[1, 1, 1, 5, 17, 39, 23, 5, 343]),
    (557, &[1, 3, 1, 5, 25, 15, 31, 103, 499]),
    (563, &[1, 1, 1, 11, 11, 17, 63, 105, 183]),
    (601, &[1, 1, 5, 11, 9, 29, 97, 231, 363]),
    (607, &[1, 1, 5, 15, 19, 45, 41, 7, 383]),
    (617, &[1, 3, 7, 7, 31, 19, 83, 137, 221]),
    (623, &[1, 1, 1, 3, 23, 15, 111, 223, 83]),
    (631, &[1, 1, 5, 13, 31, 15, 55, 25, 161]),
    (637, &[1, 1, 3, 13, 25, 47, 39, 87, 257]),
];

/// The largest number of parameters.
pub(super) const MOST_PARAMETERS: usize = DIRECTIONS.len() + 1;

/// Direction numbers v1, v2, ... of a parameter, as binary fractions.
fn directions(parameter: usize) -> [u32; BITS] {
    let mut v = [0; BITS];
    let Some(&(polynomial, first)) = parameter.checked_sub(1).map(|place| &DIRECTIONS[place])
    else {
        // Van der Corput's sequence: m = 1 throughout.
        for (k, v) in v.iter_mut().enumerate() {
            *v = 1 << (BITS - 1 - k);
        }
        return v;
    };
    let degree = first.len();
    for k in 0..BITS {
        v[k] = match first.get(k) {
            Some(m) => m << (BITS - 1 - k),
            None => {
                let mut sum = v[k - degree] ^ (v[k - degree] >> degree);
                for j in 1..degree {
                    if (polynomial >> (degree - j)) & 1 == 1 {
                        sum ^= v[k - j];
                    }
                }
                sum
            }
        };
    }
    v
}

/// Points from 0 (the first) to below 1, case by case, of so many parameters each.
pub(super) fn points(cases: usize, parameters: usize) -> Vec<Vec<f64>> {
    let directions: Vec<_> = (0..parameters).map(directions).collect();
    let mut now = vec![0_u32; parameters];
    let mut points = Vec::with_capacity(cases);
    for case in 0..cases {
        let scaled = now.iter().map(|x| f64::from(*x) / (1_u64 << BITS) as f64);
        points.push(scaled.collect());
        // The place of the lowest zero of its number.
        let place = case.trailing_ones() as usize;
        for (x, v) in now.iter_mut().zip(&directions) {
            *x ^= v[place.min(BITS - 1)];
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::points;

    #[test]
    fn every_interval_of_a_power_of_two_is_met_once() {
        let points = points(256, super::MOST_PARAMETERS);
        for parameter in 0..super::MOST_PARAMETERS {
            let mut layers: Vec<_> = points
                .iter()
                .map(|p| (p[parameter] * 256.0) as usize)
                .collect();
            layers.sort_unstable();
            assert_eq!(
                layers,
                (0..256).collect::<Vec<_>>(),
                "parameter {parameter}"
            );
        }
        let first: Vec<_> = points.iter().take(5).map(|p| [p[0], p[1], p[2]]).collect();
        let expected = [
            [0.0; 3],
            [0.5; 3],
            [0.75, 0.25, 0.25],
            [0.25, 0.75, 0.75],
            [0.375, 0.375, 0.625],
        ];
        assert_eq!(first, expected);
    }
}
