//! A reference integrator for the tests: the pair of orders 5 and 4 of Dormand and Prince (1980).

/// Nodes of the stages.
const C: [f64; 7] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];
/// Coefficients of the stages; the last row is the formula of order 5.
const A: [[f64; 6]; 7] = [
    [0.0; 6],
    [0.2, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [
        19372.0 / 6561.0,
        -25360.0 / 2187.0,
        64448.0 / 6561.0,
        -212.0 / 729.0,
        0.0,
        0.0,
    ],
    [
        9017.0 / 3168.0,
        -355.0 / 33.0,
        46732.0 / 5247.0,
        49.0 / 176.0,
        -5103.0 / 18656.0,
        0.0,
    ],
    [
        35.0 / 384.0,
        0.0,
        500.0 / 1113.0,
        125.0 / 192.0,
        -2187.0 / 6784.0,
        11.0 / 84.0,
    ],
];
/// Formula of order 5 less the one of order 4.
const E: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

/// Integrates `y' = f(t, y)` with steps whose error in each component is below its `tolerance`, and
/// which are at most `longest`. Keeps its step from one interval to the next.
pub(crate) struct Integrator<const N: usize> {
    pub(crate) time: f64,
    pub(crate) state: [f64; N],
    pub(crate) tolerance: [f64; N],
    pub(crate) longest: f64,
    step: f64,
}

impl<const N: usize> Integrator<N> {
    pub(crate) fn new(state: [f64; N], tolerance: [f64; N], longest: f64) -> Self {
        Self {
            time: 0.0,
            state,
            tolerance,
            longest,
            step: 1e-6 * longest,
        }
    }

    /// Integrates up to `end`; `accept` sees and may change the state after every step, and stops
    /// the integration there by returning true.
    pub(crate) fn run(
        &mut self,
        end: f64,
        f: impl Fn(f64, &[f64; N]) -> [f64; N],
        mut accept: impl FnMut(f64, &mut [f64; N]) -> bool,
    ) {
        while self.time < end {
            let rest = end - self.time;
            let last = self.step >= rest;
            let h = if last { rest } else { self.step };
            let mut slopes = [[0.0; N]; 7];
            let mut y = self.state;
            for s in 0..7 {
                y = core::array::from_fn(|i| {
                    let sum: f64 = (0..s).map(|k| A[s][k] * slopes[k][i]).sum();
                    self.state[i] + h * sum
                });
                slopes[s] = f(self.time + C[s] * h, &y);
            }
            let error = (0..N).fold(0.0, |worst: f64, i| {
                let sum: f64 = (0..7).map(|k| E[k] * slopes[k][i]).sum();
                worst.max((h * sum / self.tolerance[i]).abs())
            });
            let factor = (0.9 * error.powf(-0.2)).clamp(0.2, 5.0);
            if error <= 1.0 {
                self.time = if last { end } else { self.time + h };
                self.state = y;
                if accept(self.time, &mut self.state) {
                    return;
                }
            }
            if !(last && error <= 1.0) {
                self.step = (factor * h).min(self.longest);
            }
        }
    }

    /// The state at `end`.
    pub(crate) fn to(&mut self, end: f64, f: impl Fn(f64, &[f64; N]) -> [f64; N]) -> [f64; N] {
        self.run(end, f, |_, _| false);
        self.state
    }
}
