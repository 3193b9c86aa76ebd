//! Reference solutions that the tests compute themselves: small systems of ordinary differential
//! equations, written down apart from the solver and integrated by Runge and Kutta's formula of
//! fourth order.

use friction::LuGre;

/// State at the end of `steps` equal steps over `duration`.
pub(crate) fn runge_kutta<const N: usize>(
    mut state: [f64; N],
    duration: f64,
    steps: usize,
    rate: impl Fn(&[f64; N]) -> [f64; N],
) -> [f64; N] {
    let h = duration / steps as f64;
    let ahead = |state: &[f64; N], by: f64, rate: &[f64; N]| -> [f64; N] {
        core::array::from_fn(|k| state[k] + by * rate[k])
    };
    for _ in 0..steps {
        let a = rate(&state);
        let b = rate(&ahead(&state, 0.5 * h, &a));
        let c = rate(&ahead(&state, 0.5 * h, &b));
        let d = rate(&ahead(&state, h, &c));
        for k in 0..N {
            state[k] += h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
        }
    }
    state
}

/// The bristles by equations (1) to (3) of the statement: rate of `z` and force on the surface of I.
pub(crate) fn bristles<const N: usize>(
    law: &LuGre,
    velocity: [f64; N],
    deflection: [f64; N],
    load: f64,
) -> ([f64; N], [f64; N]) {
    let speed = velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
    let decay = (-(speed / law.stribeck_velocity).powf(law.stribeck_exponent)).exp();
    let level = load * (law.mu_dynamic + (law.mu_static - law.mu_dynamic) * decay);
    let rate: [f64; N] = core::array::from_fn(|k| {
        velocity[k] - law.bristle_stiffness * speed * deflection[k] / level
    });
    let force = core::array::from_fn(|k| {
        -(law.bristle_stiffness * deflection[k] + law.damping * rate[k] + law.viscous * velocity[k])
    });
    (rate, force)
}

/// Where a falling function passes zero between `low` and `high`.
pub(crate) fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// The odd quintic step of the original law.
pub(crate) fn psi(s: f64) -> f64 {
    (15.0 * s - 10.0 * s.powi(3) + 3.0 * s.powi(5)) / 8.0
}
