//! Functions of time and measures, compiled to a list of operations.
//!
//! A [`Program`] is a straight line of operations, each reading registers before it. It is built
//! once ([`Program::push`]) and evaluated without allocation: values forward, and the exact
//! gradient by one sweep back (reverse accumulation: Griewank & Walther, *Evaluating Derivatives*,
//! chapter 3). Composite functions such as STEP or IMPACT are written in these few operations when
//! a program is built, so each derivative rule stands here once.

mod functions;
mod switches;

use std::ops::Range;
use std::sync::Arc;

use numerics::interpolation::Surface;

use crate::scalar::Scalar;
pub use functions::{Binary, Unary};
use functions::{binary, binary_slopes, unary};
use switches::Switch;
pub(crate) use switches::{Branch, Sharing};

/// Place of an operation's result.
pub type Register = u32;

/// What an operation reads from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// Time.
    Time,
    /// A measure, by its place in [`crate::model::Model::measures`].
    Measure(usize),
    /// A differential state, by its place in [`crate::model::Model::states`].
    State(usize),
    /// The rate of a differential state.
    StateRate(usize),
    /// An algebraic variable, by its place in [`crate::model::Model::algebraics`].
    Algebraic(usize),
    /// A result of the solution (a reaction or friction component), by the caller's number. Only
    /// outputs may read one.
    Result(usize),
}

/// One operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operation {
    /// A number.
    Constant(f64),
    /// A value from outside.
    Input(Input),
    /// A function of one register.
    Unary(Unary, Register),
    /// A function of two registers.
    Binary(Binary, Register, Register),
    /// IF: the first register decides between the other three (negative, zero, positive). The
    /// integrator looks for the jumps between them.
    If(Register, Register, Register, Register),
    /// The same where the choices meet: there is no jump to look for.
    Select(Register, Register, Register, Register),
    /// A derivative by x of a table of the program at `(x, z)`: table, order, x, z.
    Lookup(usize, usize, Register, Register),
}

impl Operation {
    /// The registers that it reads, some repeated; `None` where it reads none.
    fn reads(self) -> Option<[Register; 4]> {
        match self {
            Self::Constant(_) | Self::Input(_) => None,
            Self::Unary(_, a) => Some([a; 4]),
            Self::Binary(_, a, b) | Self::Lookup(_, _, a, b) => Some([a, b, a, b]),
            Self::If(a, b, c, d) | Self::Select(a, b, c, d) => Some([a, b, c, d]),
        }
    }
}

/// A compiled function; its value is that of the last operation.
///
/// ```
/// use mechanics::expression::{Binary, Input, Operation, Program, Unary};
/// let mut program = Program::default();
/// let t = program.push(Operation::Input(Input::Time));
/// let s = program.push(Operation::Unary(Unary::Sin, t));
/// program.push(Operation::Binary(Binary::Multiply, t, s));
/// let mut registers = vec![0.0; program.len()];
/// assert_eq!(program.evaluate(&mut registers, |_| 2.0), 2.0 * 2.0_f64.sin());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    operations: Vec<Operation>,
    tables: Vec<Arc<Surface>>,
    /// Operations that jump.
    switches: Vec<Switch>,
    /// Whether some of them are not free.
    holds: bool,
}

impl Program {
    /// A program that is a constant.
    #[must_use]
    pub fn constant(value: f64) -> Self {
        Self {
            operations: vec![Operation::Constant(value)],
            ..Self::default()
        }
    }

    /// Appends an operation; registers it reads must exist. An operation on constants is a
    /// constant at once.
    ///
    /// # Panics
    /// When the operation reads a register that does not exist yet.
    pub fn push(&mut self, operation: Operation) -> Register {
        let new = self.operations.len() as Register;
        let reads = operation.reads();
        let before = reads.is_none_or(|reads| reads.iter().all(|r| *r < new));
        assert!(before, "an operation reads registers before it");
        let constant = |r: &Register| self.constant_value(*r).is_some();
        self.operations
            .push(if reads.is_some_and(|reads| reads.iter().all(constant)) {
                let at = |r: Register| self.constant_value(r).unwrap_or(f64::NAN);
                Operation::Constant(self.apply(operation, at, |_| f64::NAN))
            } else {
                operation
            });
        self.note_switch();
        new
    }

    /// The number in a register that depends on no input.
    #[must_use]
    pub fn constant_value(&self, register: Register) -> Option<f64> {
        match self.operations.get(register as usize) {
            Some(Operation::Constant(value)) => Some(*value),
            _ => None,
        }
    }

    /// Appends the `order`-th derivative by x (0, 1 or 2) of a table at `(x, z)`.
    ///
    /// # Panics
    /// As [`Program::push`], or for a higher order.
    pub fn push_lookup(
        &mut self,
        table: &Arc<Surface>,
        order: usize,
        x: Register,
        z: Register,
    ) -> Register {
        let known = self.tables.iter().position(|t| Arc::ptr_eq(t, table));
        let place = known.unwrap_or_else(|| {
            self.tables.push(Arc::clone(table));
            self.tables.len() - 1
        });
        self.push(Operation::Lookup(place, order, x, z))
    }

    /// Number of operations, which is the number of registers that an evaluation needs.
    #[must_use]
    pub fn len(&self) -> usize {
        self.operations.len()
    }

    /// True for a program without operations, which has no value.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.operations.is_empty()
    }

    /// Everything the program reads, with repetitions.
    pub fn inputs(&self) -> impl Iterator<Item = Input> + '_ {
        self.operations
            .iter()
            .filter_map(|operation| match operation {
                Operation::Input(input) => Some(*input),
                _ => None,
            })
    }

    /// Value, with the inputs that `read` gives; `registers` must hold [`Program::len`] numbers.
    pub fn evaluate(&self, registers: &mut [f64], read: impl Fn(Input) -> f64) -> f64 {
        self.run(registers, read)
    }

    pub(crate) fn run<T: Scalar>(&self, registers: &mut [T], read: impl Fn(Input) -> T) -> T {
        if self.holds {
            self.run_held(registers, read);
        } else {
            self.run_range(0..self.operations.len(), registers, &read);
        }
        registers[self.operations.len() - 1]
    }

    fn run_range<T: Scalar>(
        &self,
        places: Range<usize>,
        registers: &mut [T],
        read: impl Fn(Input) -> T,
    ) {
        for place in places {
            let operation = self.operations[place];
            registers[place] = self.apply(operation, |r| registers[r as usize], &read);
        }
    }

    fn apply<T: Scalar>(
        &self,
        operation: Operation,
        at: impl Fn(Register) -> T,
        read: impl Fn(Input) -> T,
    ) -> T {
        match operation {
            Operation::Constant(value) => T::constant(value),
            Operation::Input(input) => read(input),
            Operation::Unary(function, a) => {
                let (value, slope, curvature) = unary(function, at(a).value());
                at(a).chain(value, slope, curvature)
            }
            Operation::Binary(function, a, b) => binary(function, at(a), at(b)),
            Operation::If(a, negative, zero, positive)
            | Operation::Select(a, negative, zero, positive) => {
                at(select(a, at(a).value(), [negative, zero, positive]))
            }
            Operation::Lookup(table, order, x, z) => {
                lookup(&self.tables[table], order, at(x), at(z))
            }
        }
    }

    /// Calls `derivative(input, slope)` for every input of the program, after
    /// [`Program::evaluate`] has filled `registers`; `adjoints` is scratch of the same length.
    ///
    /// The calls are always the same in number and order, also where a slope is zero, so that a
    /// matrix can be assembled from them.
    pub fn gradient(
        &self,
        registers: &[f64],
        adjoints: &mut [f64],
        derivative: impl FnMut(Input, f64),
    ) {
        let count = self.operations.len();
        adjoints[..count].fill(0.0);
        adjoints[count - 1] = 1.0;
        self.sweep(count, registers, adjoints, derivative);
    }

    /// The sweep back over the first `count` operations, whose adjoints so far are given.
    fn sweep(
        &self,
        count: usize,
        registers: &[f64],
        adjoints: &mut [f64],
        mut derivative: impl FnMut(Input, f64),
    ) {
        for place in (0..count).rev() {
            let adjoint = adjoints[place];
            if let Operation::Input(input) = self.operations[place] {
                derivative(input, adjoint);
            }
            // Branches that were not taken must not add 0 · ∞.
            if adjoint == 0.0 {
                continue;
            }
            let at = |r: Register| registers[r as usize];
            if let Some(branch) = self.held_branch(place) {
                self.operations[place].branch_slopes(branch, at, |r, slope| {
                    adjoints[r as usize] += adjoint * slope;
                });
                continue;
            }
            match self.operations[place] {
                Operation::Constant(_) | Operation::Input(_) => {}
                Operation::Unary(function, a) => {
                    adjoints[a as usize] += adjoint * unary(function, at(a)).1;
                }
                Operation::Binary(function, a, b) => {
                    let (by_a, by_b) = binary_slopes(function, at(a), at(b), registers[place]);
                    adjoints[a as usize] += adjoint * by_a;
                    adjoints[b as usize] += adjoint * by_b;
                }
                Operation::If(a, negative, zero, positive)
                | Operation::Select(a, negative, zero, positive) => {
                    let taken = select(a, at(a), [negative, zero, positive]);
                    adjoints[taken as usize] += adjoint;
                }
                Operation::Lookup(table, order, x, z) => {
                    let point = self.tables[table].at(order, at(x), at(z));
                    adjoints[x as usize] += adjoint * point.by_x;
                    adjoints[z as usize] += adjoint * point.by_z;
                }
            }
        }
    }
}

/// Taylor's expansion at the point, which is exact for numbers that carry two derivatives.
fn lookup<T: Scalar>(table: &Surface, order: usize, x: T, z: T) -> T {
    let point = table.at(order, x.value(), z.value());
    let (dx, dz) = (x - T::constant(x.value()), z - T::constant(z.value()));
    let constant = T::constant;
    let bend = constant(0.5 * point.by_xx) * dx + constant(point.by_xz) * dz;
    constant(point.value) + dx * (constant(point.by_x) + bend) + dz * constant(point.by_z)
}

/// The register that is taken by the sign of `x`, the value of register `a`: negative, zero,
/// positive; `a` itself where that is not a number.
fn select(a: Register, x: f64, [negative, zero, positive]: [Register; 3]) -> Register {
    if x < 0.0 {
        negative
    } else if x > 0.0 {
        positive
    } else if x == 0.0 {
        zero
    } else {
        a
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Jet;

    #[test]
    fn a_branch_not_taken_leaves_no_trace() {
        // IF(x: 1, 1, SQRT(x)) at x < 0: the square root is not a number but is not taken.
        let mut program = Program::default();
        let x = program.push(Operation::Input(Input::Time));
        let one = program.push(Operation::Constant(1.0));
        let root = program.push(Operation::Unary(Unary::Sqrt, x));
        program.push(Operation::Select(x, one, one, root));
        let mut registers = [0.0; 4];
        assert_eq!(program.evaluate(&mut registers, |_| -4.0), 1.0);
        let mut calls = 0;
        program.gradient(&registers, &mut [0.0; 4], |_, slope| {
            assert_eq!(slope, 0.0);
            calls += 1;
        });
        assert_eq!(calls, 1);
    }

    #[test]
    fn lookups_have_exact_slopes_and_jets() {
        use numerics::interpolation::{Extrapolation, PiecewiseCubic};
        let x = [0.0, 1.0, 2.0, 4.0];
        let curve =
            |y: [f64; 4]| PiecewiseCubic::cubic_spline(&x, &y, Extrapolation::Line).unwrap();
        let family = vec![
            (0.0, curve([1.0, -1.0, 2.0, 3.0])),
            (1.0, curve([0.0, 2.0, 2.0, -1.0])),
        ];
        let table = Arc::new(Surface::new(family).unwrap());
        for order in 0..=2 {
            let mut program = Program::default();
            let x = program.push(Operation::Input(Input::Measure(0)));
            let z = program.push(Operation::Input(Input::Measure(1)));
            program.push_lookup(&table, order, x, z);
            // Along x = 1.3 + 2t - t², z = 0.3 + t + t².
            let at = |input, t: f64| match input {
                Input::Measure(0) => Jet {
                    value: 1.3 + 2.0 * t - t * t,
                    rate: 2.0 - 2.0 * t,
                    acceleration: -2.0,
                },
                _ => Jet {
                    value: 0.3 + t + t * t,
                    rate: 1.0 + 2.0 * t,
                    acceleration: 2.0,
                },
            };
            let jet = |t: f64| program.run(&mut [Jet::constant(0.0); 3], |input| at(input, t));
            let (now, h) = (jet(0.0), 1e-4);
            let rate = (jet(h).value - jet(-h).value) / (2.0 * h);
            let acceleration = (jet(h).rate - jet(-h).rate) / (2.0 * h);
            // Truncation h²/6 times third derivatives of up to a hundred.
            assert!((now.rate - rate).abs() < 1e-6, "{order}");
            assert!((now.acceleration - acceleration).abs() < 1e-5, "{order}");
            let mut registers = [0.0; 3];
            program.evaluate(&mut registers, |input| at(input, 0.0).value);
            let mut along = 0.0;
            program.gradient(&registers, &mut [0.0; 3], |input, slope| {
                along += slope * at(input, 0.0).rate;
            });
            assert!((along - now.rate).abs() < 1e-13 * (1.0 + now.rate.abs()));
        }
    }
}
