//! Andrews' squeezing mechanism (Schiehlen 1990; Hairer & Wanner II, section VII.7; the IVP test
//! set): seven bodies in the plane, three loops, a spring, a constant driving torque.

use mechanics::model::Model;
use nalgebra::Vector3;

use crate::builder::{Builder, v};

/// The model, and the angles of its bodies at the start in terms of the published coordinates.
#[derive(Clone, Debug)]
pub struct Andrews {
    /// The mechanism.
    pub model: Model,
    /// Angle of every body at the start, radians about z.
    pub angles: [f64; 7],
    /// The joints of point F that close the three loops, in the order of the published multipliers:
    /// the bodies K2 (marker J) against K3, K4, K6 (marker I).
    pub closing: [usize; 3],
}

/// Angles of the seven bodies from the published coordinates β, Θ, γ, Φ, δ, Ω, ε; also rates.
#[must_use]
pub fn body_angles(q: &[f64]) -> [f64; 7] {
    [
        q[0],
        q[0] + q[1],
        q[2],
        q[3] + q[4],
        q[4],
        q[5] + q[6],
        q[6],
    ]
}

/// The mechanism at its published start.
#[must_use]
pub fn andrews() -> Andrews {
    let q0 = [
        -0.061_713_890_014_276_45,
        0.0,
        0.455_279_819_163_070_38,
        0.222_668_390_165_885_88,
        0.487_364_979_543_842_55,
        -0.222_668_390_165_885_88,
        1.230_547_444_549_821_19,
    ];
    let angles = body_angles(&q0);
    let direction = |angle: f64| v(angle.cos(), angle.sin(), 0.0);
    let normal = |angle: f64| v(-angle.sin(), angle.cos(), 0.0);
    let (a, b, c) = (
        v(-0.06934, -0.00227, 0.0),
        v(-0.03635, 0.03273, 0.0),
        v(0.014, 0.072, 0.0),
    );
    let o = Vector3::zeros();
    let [beta, second, gamma, fourth, delta, sixth, epsilon] = angles;
    // Pins between K1 and K2, K5 and K4, K7 and K6.
    let k = 7e-3 * direction(beta);
    let h = a + 40e-3 * direction(delta);
    let g = a - 40e-3 * normal(epsilon);
    // Point F, from K3 and its pin B.
    let f = b - 35e-3 * normal(gamma);
    let spring_end = b + 20e-3 * direction(gamma) - 18e-3 * normal(gamma);
    let mut m = Builder::new(Vector3::zeros());
    let masses = [
        0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498,
    ];
    let inertias = [
        2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5,
    ];
    let centres = [
        0.92e-3 * direction(beta),
        k - 11.5e-3 * direction(second),
        b - 18.74e-3 * normal(gamma) + 10.43e-3 * direction(gamma),
        h - (20e-3 - 14.21e-3) * normal(fourth),
        a + 23.08e-3 * direction(delta) + 9.16e-3 * normal(delta),
        g + (20e-3 - 14.21e-3) * direction(sixth),
        a - 12.28e-3 * normal(epsilon) - 4.49e-3 * direction(epsilon),
    ];
    let bodies: Vec<usize> = (0..7)
        .map(|n| m.body(masses[n], [inertias[n]; 3], centres[n]))
        .collect();
    let on = |n: usize| Some(bodies[n - 1]);
    m.pin(on(1), None, o);
    m.pin(on(2), on(1), k);
    m.pin(on(3), None, b);
    m.pin(on(5), None, a);
    m.pin(on(4), on(5), h);
    m.pin(on(7), None, a);
    m.pin(on(6), on(7), g);
    let closing = [3, 4, 6].map(|n| m.pin(on(n), on(2), f));
    let i = m.marker(on(3), spring_end, nalgebra::Matrix3::identity());
    let j = m.marker(None, c, nalgebra::Matrix3::identity());
    m.spring(i, j, 4530.0, 0.07785);
    m.torque(bodies[0], Vector3::z(), 0.033);
    Andrews {
        model: m.model,
        angles,
        closing,
    }
}
