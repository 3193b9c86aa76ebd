//! Functions that jump, and how they are evaluated beside their jumps.
//!
//! IF, SIGN, MOD, AINT and ANINT cut the numbers into *cells* by the value of an *argument*; within
//! each cell they are as smooth as what they read:
//!
//! ```text
//! IF(x: a, b, c)   argument x      cells −1 (x < 0), 0 (x = 0), 1 (x > 0)
//! SIGN(a, x)       argument x      cells −1 (x < 0), 1
//! AINT(x)          argument x      cells …, −1, 0, 1, … of the integer part
//! ANINT(x)         argument x      cells of the nearest integer
//! MOD(x, y)        argument x/y    cells of its integer part
//! ```
//!
//! An integrator holds each such *switch* in its cell while it steps, so that the program is smooth,
//! and looks where the argument leaves the cell.

use super::{Binary, Input, Operation, Program, Register, Unary, select};
use crate::scalar::{Jet, Scalar};
use serde::{Deserialize, Serialize};

/// How a switch is evaluated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) enum Branch {
    /// By the value of its argument.
    #[default]
    Free,
    /// As in this cell, whatever the argument.
    Held(f64),
    /// Between two cells.
    Shared(Sharing),
    /// Stairs as the line through the middle of them.
    Even,
}

/// A switch between two cells: `(1 − s) f_lower + s f_upper` with `s = share + steepness (x − boundary)`
/// at the argument x. The share is not cut off at 0 and 1, so that the function stays smooth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Sharing {
    /// The cell below the boundary.
    pub(crate) lower: f64,
    /// The cell above it.
    pub(crate) upper: f64,
    /// Share of the upper cell at the boundary.
    pub(crate) share: f64,
    /// Slope of the share by the argument.
    pub(crate) steepness: f64,
    /// Argument at which the cells meet.
    pub(crate) boundary: f64,
}

impl Sharing {
    /// Share of the upper cell at this argument.
    pub(crate) fn at(&self, argument: f64) -> f64 {
        self.share + self.steepness * (argument - self.boundary)
    }
}

/// A place where a program may jump.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Switch {
    place: usize,
    branch: Branch,
}

/// The register that an IF takes as in a cell. A branch need not be defined beyond the jump
/// (`IF(x: 0, 0, SQRT(x))`): there it is the one that belongs to the argument.
fn held_choice(
    cell: f64,
    x: Register,
    choices: [Register; 3],
    at: impl Fn(Register) -> f64,
) -> Register {
    let held = select(x, cell, choices);
    if at(held).is_finite() && !at(x).is_nan() {
        held
    } else {
        select(x, at(x), choices)
    }
}

impl Operation {
    fn jumps(self) -> bool {
        matches!(
            self,
            Self::If(..)
                | Self::Unary(Unary::Truncate | Unary::Round, _)
                | Self::Binary(Binary::Sign | Binary::Modulo, ..)
        )
    }

    fn is_stairs(self) -> bool {
        self.jumps() && !matches!(self, Self::If(..) | Self::Binary(Binary::Sign, ..))
    }

    /// What the cells are on the whole at an argument, and its slope.
    fn even_cell(self, x: f64) -> (f64, f64) {
        match self {
            Self::Unary(Unary::Round, _) => (x, 1.0),
            _ if x.abs() <= 0.5 => (0.0, 0.0),
            _ => (x - 0.5 * x.signum(), 1.0),
        }
    }

    /// The register of the argument and, where there is one, that of its divisor.
    fn argument(self) -> (Register, Option<Register>) {
        match self {
            Self::Binary(Binary::Modulo, x, y) => (x, Some(y)),
            Self::Binary(_, _, x) | Self::If(x, ..) | Self::Unary(_, x) => (x, None),
            // No other operation jumps.
            _ => (0, None),
        }
    }

    /// The cell of an argument.
    fn cell(self, x: f64) -> f64 {
        match self {
            Self::If(..) if x == 0.0 || x.is_nan() => 0.0,
            Self::If(..) => x.signum(),
            Self::Binary(Binary::Sign, ..) => {
                if x < 0.0 {
                    -1.0
                } else {
                    1.0
                }
            }
            Self::Unary(Unary::Round, _) => x.round(),
            _ => x.trunc(),
        }
    }

    /// Ends of a cell.
    fn ends(self, cell: f64) -> (f64, f64) {
        match self {
            Self::If(..) | Self::Binary(Binary::Sign, ..) => (
                if cell < 0.0 { f64::NEG_INFINITY } else { 0.0 },
                if cell > 0.0 { f64::INFINITY } else { 0.0 },
            ),
            Self::Unary(Unary::Round, _) => (cell - 0.5, cell + 0.5),
            _ => (
                if cell > 0.0 { cell } else { cell - 1.0 },
                if cell < 0.0 { cell } else { cell + 1.0 },
            ),
        }
    }

    /// The value as in a cell.
    fn in_cell<T: Scalar>(self, cell: f64, at: impl Fn(Register) -> T) -> T {
        match self {
            Self::If(x, negative, zero, positive) => {
                let value = |r: Register| at(r).value();
                at(held_choice(cell, x, [negative, zero, positive], value))
            }
            Self::Binary(Binary::Modulo, x, y) => at(x) - at(y) * T::constant(cell),
            Self::Binary(_, a, _) => {
                let keep = (at(a).value() < 0.0) == (cell < 0.0);
                if keep { at(a) } else { -at(a) }
            }
            _ => T::constant(cell),
        }
    }

    /// Calls `add(register, slope)` for what the value as in a cell reads.
    fn cell_slopes(
        self,
        cell: f64,
        at: impl Fn(Register) -> f64,
        mut add: impl FnMut(Register, f64),
    ) {
        match self {
            Self::If(x, negative, zero, positive) => {
                add(held_choice(cell, x, [negative, zero, positive], at), 1.0);
            }
            Self::Binary(Binary::Modulo, x, y) => {
                add(x, 1.0);
                add(y, -cell);
            }
            Self::Binary(_, a, _) => {
                let keep = (at(a) < 0.0) == (cell < 0.0);
                add(a, if keep { 1.0 } else { -1.0 });
            }
            _ => {}
        }
    }

    /// Calls `add(register, slope)` for what the argument reads.
    fn argument_slopes(self, at: impl Fn(Register) -> f64, mut add: impl FnMut(Register, f64)) {
        match self.argument() {
            (x, Some(y)) => {
                add(x, 1.0 / at(y));
                add(y, -at(x) / (at(y) * at(y)));
            }
            (x, None) => add(x, 1.0),
        }
    }

    fn argument_value<T: Scalar>(self, at: impl Fn(Register) -> T) -> T {
        match self.argument() {
            (x, Some(y)) => at(x) / at(y),
            (x, None) => at(x),
        }
    }

    /// Value of a switch that is not free.
    fn branch_value<T: Scalar>(self, branch: Branch, at: impl Fn(Register) -> T + Copy) -> T {
        match branch {
            Branch::Held(cell) => self.in_cell(cell, at),
            Branch::Even => {
                let argument = self.argument_value(at);
                let (cell, slope) = self.even_cell(argument.value());
                let cell = argument.chain(cell, slope, 0.0);
                match self.argument() {
                    (x, Some(y)) => at(x) - at(y) * cell,
                    _ => cell,
                }
            }
            Branch::Shared(sharing) => {
                let argument = self.argument_value(at);
                let share = argument.chain(sharing.at(argument.value()), sharing.steepness, 0.0);
                let lower = self.in_cell(sharing.lower, at);
                lower + share * (self.in_cell(sharing.upper, at) - lower)
            }
            Branch::Free => self.in_cell(self.cell(self.argument_value(at).value()), at),
        }
    }

    /// Calls `add(register, slope)` for what a switch that is not free reads.
    pub(super) fn branch_slopes(
        self,
        branch: Branch,
        at: impl Fn(Register) -> f64 + Copy,
        mut add: impl FnMut(Register, f64),
    ) {
        match branch {
            Branch::Free => {
                self.cell_slopes(self.cell(self.argument_value(at)), at, add);
            }
            Branch::Held(cell) => self.cell_slopes(cell, at, add),
            Branch::Even => {
                let x = self.argument_value(at);
                let (cell, slope) = self.even_cell(x);
                match self.argument() {
                    (a, Some(b)) => {
                        add(a, 1.0 - slope);
                        add(b, slope * x - cell);
                    }
                    (a, None) => add(a, slope),
                }
            }
            Branch::Shared(sharing) => {
                let share = sharing.at(self.argument_value(at));
                self.cell_slopes(sharing.lower, at, |r, slope| add(r, (1.0 - share) * slope));
                self.cell_slopes(sharing.upper, at, |r, slope| add(r, share * slope));
                let jump = self.in_cell(sharing.upper, at) - self.in_cell(sharing.lower, at);
                let steep = jump * sharing.steepness;
                self.argument_slopes(at, |r, slope| add(r, steep * slope));
            }
        }
    }
}

/// Switches are called by their place in the order of the program.
impl Program {
    /// Notes the operation pushed last where it jumps and its argument may change.
    pub(super) fn note_switch(&mut self) {
        let place = self.operations.len() - 1;
        let operation = self.operations[place];
        if !operation.jumps() {
            return;
        }
        let (x, y) = operation.argument();
        let fixed = |r: Register| self.constant_value(r).is_some();
        if !(fixed(x) && y.is_none_or(fixed)) {
            let branch = Branch::Free;
            self.switches.push(Switch { place, branch });
        }
    }

    /// Evaluates with some switches held, from registers filled so far; see [`Program::run`].
    pub(super) fn run_held<T: Scalar>(&self, registers: &mut [T], read: impl Fn(Input) -> T) {
        let mut from = 0;
        for switch in &self.switches {
            if switch.branch == Branch::Free {
                continue;
            }
            self.run_range(from..switch.place, registers, &read);
            let at = |r: Register| registers[r as usize];
            registers[switch.place] = self.operations[switch.place].branch_value(switch.branch, at);
            from = switch.place + 1;
        }
        self.run_range(from..self.operations.len(), registers, &read);
    }

    /// The branch of an operation, where it is a switch that is not free.
    pub(super) fn held_branch(&self, place: usize) -> Option<Branch> {
        if !self.holds {
            return None;
        }
        let found = self.switches.binary_search_by_key(&place, |s| s.place);
        let branch = self.switches[found.ok()?].branch;
        (branch != Branch::Free).then_some(branch)
    }

    pub(crate) fn switch_count(&self) -> usize {
        self.switches.len()
    }

    /// The name of a switch's function in the dataset language.
    pub(crate) fn switch_name(&self, switch: usize) -> &'static str {
        match self.switching(switch) {
            Operation::If(..) => "IF",
            Operation::Unary(Unary::Round, _) => "ANINT",
            Operation::Unary(..) => "AINT",
            Operation::Binary(Binary::Modulo, ..) => "MOD",
            _ => "SIGN",
        }
    }

    fn switching(&self, switch: usize) -> Operation {
        self.operations[self.switches[switch].place]
    }

    pub(crate) fn set_branch(&mut self, switch: usize, branch: Branch) {
        self.switches[switch].branch = branch;
        self.holds = self.switches.iter().any(|s| s.branch != Branch::Free);
    }

    /// Argument of a switch in evaluated registers.
    pub(crate) fn switch_argument(&self, switch: usize, registers: &[f64]) -> f64 {
        self.switching(switch)
            .argument_value(|r| registers[r as usize])
    }

    /// The cell of an argument.
    pub(crate) fn switch_cell(&self, switch: usize, argument: f64) -> f64 {
        self.switching(switch).cell(argument)
    }

    /// The argument of a switch with its rates along a motion.
    pub(crate) fn argument_motion(
        &self,
        switch: usize,
        jets: &mut [Jet],
        read: impl Fn(Input) -> Jet,
    ) -> Jet {
        self.run(jets, read);
        self.switching(switch).argument_value(|r| jets[r as usize])
    }

    /// Ends of a cell of a switch.
    pub(crate) fn cell_ends(&self, switch: usize, cell: f64) -> (f64, f64) {
        self.switching(switch).ends(cell)
    }

    /// How far an argument is outside of a cell: negative within.
    pub(crate) fn outside_cell(&self, switch: usize, cell: f64, argument: f64) -> f64 {
        let (first, last) = self.cell_ends(switch, cell);
        (first - argument).max(argument - last)
    }

    /// The two cells that a switch goes between when it leaves one for another, and where they meet:
    /// the point x = 0 of an IF is no cell to stay in.
    pub(crate) fn switch_sides(&self, switch: usize, cells: [f64; 2]) -> (f64, f64, f64) {
        let operation = self.switching(switch);
        let (lower, upper) = match operation {
            Operation::If(..) => (-1.0, 1.0),
            _ => (cells[0].min(cells[1]), cells[0].max(cells[1])),
        };
        (lower, upper, operation.ends(lower).1)
    }

    /// How much a switch jumps between two neighbouring cells, were their boundary there, in
    /// evaluated registers.
    pub(crate) fn switch_jump(&self, switch: usize, registers: &[f64]) -> f64 {
        let operation = self.switching(switch);
        let (lower, upper) = match operation {
            Operation::If(..) | Operation::Binary(Binary::Sign, ..) => (-1.0, 1.0),
            _ => (0.0, 1.0),
        };
        let value = |cell| operation.in_cell(cell, |r| registers[r as usize]);
        (value(upper) - value(lower)).abs()
    }

    /// Calls `derivative(input, slope)` for what the argument of a switch depends on; see
    /// [`Program::gradient`].
    pub(crate) fn argument_gradient(
        &self,
        switch: usize,
        registers: &[f64],
        adjoints: &mut [f64],
        derivative: impl FnMut(Input, f64),
    ) {
        let place = self.switches[switch].place;
        adjoints[..=place].fill(0.0);
        let at = |r: Register| registers[r as usize];
        self.switching(switch)
            .argument_slopes(at, |r, slope| adjoints[r as usize] += slope);
        self.sweep(place, registers, adjoints, derivative);
    }

    /// Whether the argument of a switch depends on nothing but time.
    pub(crate) fn is_switch_of_time(&self, switch: usize) -> bool {
        self.argument_inputs(switch)
            .all(|input| input == Input::Time)
    }

    pub(crate) fn is_stairs(&self, switch: usize) -> bool {
        self.switching(switch).is_stairs()
    }

    /// Whether the argument of another switch depends on a switch.
    pub(crate) fn feeds_switch(&self, switch: usize) -> bool {
        let place = self.switches[switch].place;
        let others = switch + 1..self.switches.len();
        others
            .into_iter()
            .any(|other| self.argument_needs(other)[place])
    }

    /// What the argument of a switch reads.
    pub(crate) fn argument_inputs(&self, switch: usize) -> impl Iterator<Item = Input> + '_ {
        let needed = self.argument_needs(switch);
        let operations = self.operations.iter().zip(needed);
        operations.filter_map(|(operation, needed)| match operation {
            Operation::Input(input) if needed => Some(*input),
            _ => None,
        })
    }

    /// Whether the argument of a switch depends on each operation before it.
    fn argument_needs(&self, switch: usize) -> Vec<bool> {
        let place = self.switches[switch].place;
        let mut needed = vec![false; place];
        let (x, y) = self.switching(switch).argument();
        for r in std::iter::once(x).chain(y) {
            needed[r as usize] = true;
        }
        for k in (0..place).rev() {
            if !needed[k] {
                continue;
            }
            for r in self.operations[k].reads().into_iter().flatten() {
                needed[r as usize] = true;
            }
        }
        needed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One program for each function that jumps, of two measures x and y, with an argument that is
    /// not simply one of them.
    fn programs() -> Vec<Program> {
        let mut made = Vec::new();
        for function in 0..5 {
            let mut program = Program::default();
            let x = program.push(Operation::Input(Input::Measure(0)));
            let y = program.push(Operation::Input(Input::Measure(1)));
            let product = program.push(Operation::Binary(Binary::Multiply, x, y));
            let sine = program.push(Operation::Unary(Unary::Sin, product));
            let value = program.push(match function {
                0 => Operation::If(sine, x, product, y),
                1 => Operation::Binary(Binary::Sign, product, sine),
                2 => Operation::Binary(Binary::Modulo, product, y),
                3 => Operation::Unary(Unary::Truncate, product),
                _ => Operation::Unary(Unary::Round, product),
            });
            program.push(Operation::Binary(Binary::Multiply, value, product));
            assert_eq!(program.switch_count(), 1);
            made.push(program);
        }
        made
    }

    fn branches() -> [Branch; 5] {
        let sharing = |share, steepness| {
            Branch::Shared(Sharing {
                lower: -1.0,
                upper: 1.0,
                share,
                steepness,
                boundary: 0.2,
            })
        };
        [
            Branch::Held(-1.0),
            Branch::Held(1.0),
            sharing(0.3, 0.0),
            sharing(0.5, 4.0),
            Branch::Even,
        ]
    }

    #[test]
    fn switches_in_every_branch_have_exact_gradients_and_jets() {
        let at = [(1.3, 0.7), (-0.4, 1.7), (0.9, -1.1)];
        for mut program in programs() {
            for branch in branches() {
                program.set_branch(0, branch);
                for (x, y) in at {
                    let read = |x: f64, y: f64| {
                        move |input| if input == Input::Measure(0) { x } else { y }
                    };
                    let value = |x, y| program.evaluate(&mut [0.0; 6], read(x, y));
                    let mut registers = [0.0; 6];
                    program.evaluate(&mut registers, read(x, y));
                    let mut slopes = [0.0; 2];
                    program.gradient(&registers, &mut [0.0; 6], |input, slope| {
                        slopes[usize::from(input == Input::Measure(1))] += slope;
                    });
                    let h = 1e-6;
                    let by_x = (value(x + h, y) - value(x - h, y)) / (2.0 * h);
                    let by_y = (value(x, y + h) - value(x, y - h)) / (2.0 * h);
                    // Rounding 1e-16/h, truncation h² times third derivatives of up to a hundred.
                    assert!((slopes[0] - by_x).abs() < 1e-7, "{program:?} {branch:?}");
                    assert!((slopes[1] - by_y).abs() < 1e-7, "{program:?} {branch:?}");

                    let jet = |t: f64| {
                        let made = |value, rate| Jet {
                            value: value + t * rate,
                            rate,
                            acceleration: 0.0,
                        };
                        let zero = Jet {
                            value: 0.0,
                            rate: 0.0,
                            acceleration: 0.0,
                        };
                        program.run(&mut [zero; 6], |input| {
                            if input == Input::Measure(0) {
                                made(x, 0.6)
                            } else {
                                made(y, -0.8)
                            }
                        })
                    };
                    let h = 1e-4;
                    let rate = (jet(h).value - jet(-h).value) / (2.0 * h);
                    let acceleration = (jet(h).rate - jet(-h).rate) / (2.0 * h);
                    // Truncation h²/6 times the next derivatives, of up to some hundred.
                    assert!((jet(0.0).rate - rate).abs() < 1e-5);
                    assert!((jet(0.0).acceleration - acceleration).abs() < 1e-4);
                }
            }
        }
    }

    #[test]
    fn an_argument_has_its_gradient_and_its_cell() {
        for program in programs() {
            let read = |x: f64, y: f64| move |input| if input == Input::Measure(0) { x } else { y };
            let argument = |x, y| {
                let mut registers = [0.0; 6];
                program.evaluate(&mut registers, read(x, y));
                program.switch_argument(0, &registers)
            };
            let (x, y, h) = (1.3, 0.7, 1e-6);
            let mut registers = [0.0; 6];
            program.evaluate(&mut registers, read(x, y));
            let mut slopes = [0.0; 2];
            program.argument_gradient(0, &registers, &mut [0.0; 6], |input, slope| {
                slopes[usize::from(input == Input::Measure(1))] += slope;
            });
            let by_x = (argument(x + h, y) - argument(x - h, y)) / (2.0 * h);
            let by_y = (argument(x, y + h) - argument(x, y - h)) / (2.0 * h);
            assert!((slopes[0] - by_x).abs() < 1e-8 && (slopes[1] - by_y).abs() < 1e-8);
            // Within a cell nothing is outside, beyond its ends nothing is inside.
            for argument in [-2.7, -1.0, -0.3, 0.0, 0.4, 0.6, 1.0, 2.2] {
                let cell = program.switch_cell(0, argument);
                assert!(program.outside_cell(0, cell, argument) <= 0.0, "{argument}");
                let other = program.switch_cell(0, argument + 5.0);
                assert!(other == cell || program.outside_cell(0, other, argument) >= 0.0);
            }
        }
    }

    #[test]
    fn what_depends_on_time_alone_is_known_to() {
        let mut program = Program::default();
        let t = program.push(Operation::Input(Input::Time));
        let x = program.push(Operation::Input(Input::Measure(0)));
        let one = program.push(Operation::Constant(1.0));
        let sine = program.push(Operation::Unary(Unary::Sin, t));
        let sum = program.push(Operation::Binary(Binary::Add, sine, x));
        program.push(Operation::If(sine, x, one, sum));
        program.push(Operation::If(sum, x, one, sum));
        program.push(Operation::If(one, x, one, sum));
        // The last one never switches.
        assert_eq!(program.switch_count(), 2);
        assert!(program.is_switch_of_time(0) && !program.is_switch_of_time(1));
    }
}
