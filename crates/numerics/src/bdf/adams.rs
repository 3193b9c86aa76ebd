//! Integrals of Newton's polynomials, from which the formulas of Adams take their coefficients.

/// Points and weights of Gauss's rule with seven points over (0, 1), exact to degree thirteen.
const GAUSS: [(f64, f64); 7] = [
    (0.025_446_043_828_620_737, 0.064_742_483_084_434_85),
    (0.129_234_407_200_302_78, 0.139_852_695_744_638_33),
    (0.297_077_424_311_301_42, 0.190_915_025_252_559_47),
    (0.5, 0.208_979_591_836_734_69),
    (0.702_922_575_688_698_6, 0.190_915_025_252_559_47),
    (0.870_765_592_799_697_2, 0.139_852_695_744_638_33),
    (0.974_553_956_171_379_3, 0.064_742_483_084_434_85),
];

/// Writes `∫ Π_{i<j} (s − nodes[i]) ds` over `span`, for every `j` from zero on; exact for up to
/// thirteen factors.
pub(super) fn integrals(nodes: &[f64], span: [f64; 2], integrals: &mut [f64]) {
    integrals.fill(0.0);
    let length = span[1] - span[0];
    for (point, part) in GAUSS {
        let time = span[0] + point * length;
        let mut product = part * length;
        for (j, integral) in integrals.iter_mut().enumerate() {
            *integral += product;
            if let Some(node) = nodes.get(j) {
                product *= time - node;
            }
        }
    }
}

/// `∫ (s − t) Π_{i<k−1} (s − nodes[i]) ds` from the newest node to `t`: what multiplies the divided
/// difference of order `k` of the slopes in the error of the formula of order `k`.
pub(super) fn error_integral(nodes: &[f64], order: usize, time: f64) -> f64 {
    let length = time - nodes[0];
    GAUSS.iter().fold(0.0, |sum, (point, part)| {
        let at = nodes[0] + point * length;
        let product = nodes[..order - 1]
            .iter()
            .map(|node| at - node)
            .product::<f64>();
        sum + part * length * (at - time) * product
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrals_of_products_are_exact() {
        // Π_{i<12} (s − i/12 + 1) from 0 to 1, by expansion into powers in exact order.
        let nodes: Vec<f64> = (0..12).map(|i| -f64::from(i) / 12.0).collect();
        let mut powers = vec![1.0];
        for node in &nodes {
            let mut next = vec![0.0; powers.len() + 1];
            for (k, p) in powers.iter().enumerate() {
                next[k + 1] += p;
                next[k] -= node * p;
            }
            powers = next;
        }
        let exact: f64 = powers
            .iter()
            .enumerate()
            .map(|(k, p)| p / (k + 1) as f64)
            .sum();
        let mut found = [0.0; 13];
        integrals(&nodes, [0.0, 1.0], &mut found);
        assert!(
            (found[12] - exact).abs() < 1e-13 * exact,
            "{} {exact}",
            found[12]
        );
        assert!((found[0] - 1.0).abs() < 1e-15 && (found[1] - 0.5).abs() < 1e-15);
    }

    #[test]
    fn error_constants_are_those_of_adams_and_moulton() {
        // Equidistant steps of one: C_k k! = -1/2, -1/12 2!, -1/24 3!, -19/720 4! (Hairer, Nørsett,
        // Wanner I, table III.1.2).
        let nodes = [0.0, -1.0, -2.0, -3.0];
        let expected = [-0.5, -1.0 / 6.0, -0.25, -19.0 / 30.0];
        for (k, expected) in expected.into_iter().enumerate() {
            let found = error_integral(&nodes, k + 1, 1.0);
            assert!((found - expected).abs() < 1e-14, "{k} {found} {expected}");
        }
    }
}
