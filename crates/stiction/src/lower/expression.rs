//! Run-time expressions to programs: one table from functions to operations.

use std::collections::{HashMap, HashSet};

use dataset::{ArgumentKind, BinaryOperator, Code, Element, Expr, Expression, Function, Span};
use mechanics::expression::{Binary, Input, Operation, Program, Register, Unary};
use mechanics::measure::Order;
use mechanics::{Acting, ForceComponent, ForceElement, Side};

use super::linear_systems::{ArrayElement, Term};
use super::results::ResultSource;
use super::unknowns::Unknown;
use super::{Lowering, composite};

/// What a function may read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Reads {
    /// TIME only: motions.
    Time,
    /// Displacements too: general constraints.
    Displacements,
    /// Everything, solved together with the motion: forces and system elements.
    Solution,
    /// Everything, once the motion is solved: outputs.
    Outputs,
}

/// An expression, or a part of one, that is not simulated; it has been reported.
pub(super) struct Refused;

/// A program while expressions are added to it.
pub(super) struct Compiler {
    pub(super) program: Program,
    reads: Reads,
    /// What the expressions belong to, for messages, such as `SFORCE/3`.
    pub(super) owner: String,
    /// Place of the expression.
    span: Span,
    /// The variable whose function is being added.
    within: Option<u32>,
    /// Values of the variables that are in the program already; `None` for a refused one.
    variables: HashMap<u32, Option<Register>>,
}

impl Compiler {
    pub(super) fn new(reads: Reads) -> Self {
        Self {
            program: Program::default(),
            reads,
            owner: String::new(),
            span: Span::default(),
            within: None,
            variables: HashMap::new(),
        }
    }

    fn constant(&mut self, value: f64) -> Register {
        self.program.push(Operation::Constant(value))
    }

    /// Adds an expression of `owner`, after the variables that it reads; returns its value.
    pub(super) fn add(
        &mut self,
        lowering: &mut Lowering,
        owner: &str,
        expression: &Expression,
    ) -> Result<Register, Refused> {
        owner.clone_into(&mut self.owner);
        self.add_variables(lowering, &expression.root)?;
        self.span = expression.span;
        self.expr(lowering, &expression.root)
    }

    /// The same of an expression that gives a vector.
    pub(super) fn add_vector(
        &mut self,
        lowering: &mut Lowering,
        owner: &str,
        expression: &Expression,
    ) -> Result<[Register; 3], Refused> {
        owner.clone_into(&mut self.owner);
        self.add_variables(lowering, &expression.root)?;
        self.span = expression.span;
        self.vector(lowering, &expression.root)
    }

    /// What its functions may read.
    pub(super) fn reads(&self) -> Reads {
        self.reads
    }

    /// The program whose value is that of a register.
    pub(super) fn finish(self, value: Register) -> Program {
        let mut program = self.program;
        // The value of a program is that of its last operation.
        if value as usize + 1 != program.len() {
            let zero = program.push(Operation::Constant(0.0));
            program.push(Operation::Binary(Binary::Add, value, zero));
        }
        program
    }

    /// Value of a variable.
    pub(super) fn variable(
        &mut self,
        lowering: &mut Lowering,
        id: u32,
    ) -> Result<Register, Refused> {
        self.owner = format!("VARIABLE/{id}");
        self.close_variable(lowering, id)?;
        self.variables.get(&id).copied().flatten().ok_or(Refused)
    }

    fn add_variables(&mut self, lowering: &mut Lowering, root: &Expr) -> Result<(), Refused> {
        for id in variables_of(lowering, root) {
            self.close_variable(lowering, id)?;
        }
        Ok(())
    }

    /// Adds a variable after all variables that it reads, each once. One of every circle is an
    /// unknown, see [`Lowering::break_circles`].
    fn close_variable(&mut self, lowering: &mut Lowering, id: u32) -> Result<(), Refused> {
        let mut stack = vec![id];
        let mut opened = HashSet::new();
        while let Some(&top) = stack.last() {
            let function = lowering.dataset.variables.by_id(top).map(|v| &v.function);
            let Some(function) = function.filter(|_| !self.variables.contains_key(&top)) else {
                stack.pop();
                continue;
            };
            if let Some(place) = lowering.measures.unknowns.of_variable(top) {
                let value = self.unknown(place, lowering, top, function.span);
                self.variables.insert(top, value);
                stack.pop();
            } else if opened.insert(top) {
                let needed = variables_of(lowering, &function.root);
                stack.extend(
                    needed
                        .into_iter()
                        .filter(|v| !self.variables.contains_key(v)),
                );
            } else {
                self.span = function.span;
                self.within = Some(top);
                let value = self.expr(lowering, &function.root).ok();
                self.within = None;
                self.variables.insert(top, value);
                stack.pop();
            }
        }
        match self.variables.get(&id) {
            Some(Some(_)) => Ok(()),
            _ => Err(Refused),
        }
    }

    /// Recursion is no deeper than an expression, which is `dataset::DEEPEST` at most.
    pub(super) fn expr(
        &mut self,
        lowering: &mut Lowering,
        expr: &Expr,
    ) -> Result<Register, Refused> {
        Ok(match expr {
            Expr::Number(value) => self.constant(*value),
            Expr::Time => self.program.push(Operation::Input(Input::Time)),
            Expr::Mode => {
                lowering.reads_mode = true;
                self.constant(lowering.setting.mode.value())
            }
            Expr::Negate(operand) => {
                let operand = self.expr(lowering, operand)?;
                self.program.push(Operation::Unary(Unary::Negate, operand))
            }
            Expr::Binary {
                operator: BinaryOperator::Multiply,
                left,
                right,
            } if left.is_vector() => {
                let (a, b) = (self.vector(lowering, left)?, self.vector(lowering, right)?);
                self.inner(a, b)
            }
            Expr::Binary {
                operator,
                left,
                right,
            } => {
                let left = self.expr(lowering, left)?;
                let right = self.expr(lowering, right)?;
                let operator = match operator {
                    BinaryOperator::Add => Binary::Add,
                    BinaryOperator::Subtract => Binary::Subtract,
                    BinaryOperator::Multiply => Binary::Multiply,
                    BinaryOperator::Divide => Binary::Divide,
                    BinaryOperator::Power => Binary::Power,
                    // The parser has told numbers from vectors.
                    BinaryOperator::Cross => return Err(Refused),
                };
                self.program.push(Operation::Binary(operator, left, right))
            }
            Expr::Call { .. } => self.call(lowering, expr)?,
            Expr::Vector(_) => return Err(Refused),
        })
    }

    fn call(&mut self, lowering: &mut Lowering, call: &Expr) -> Result<Register, Refused> {
        let Expr::Call {
            function,
            arguments,
            span,
        } = call
        else {
            return Err(Refused);
        };
        let function = *function;
        if let Some(id) = variable_of(lowering, call) {
            return self.variables.get(&id).copied().flatten().ok_or(Refused);
        }
        if function == Function::Aryval {
            return self.array_element(lowering, call);
        }
        let ground = lowering.ground;
        let dataset = lowering.dataset;
        let marker = |id: Option<u32>| {
            id.and_then(|id| dataset.markers.position(id))
                .unwrap_or(ground)
        };
        if let Some(measure) = lowering.measures.of_call(function, arguments, marker) {
            let order = lowering.measures.list()[measure].quantity.order();
            let allowed = match self.reads {
                Reads::Time => false,
                Reads::Displacements => order == Order::Displacement,
                Reads::Solution | Reads::Outputs => true,
            };
            return if allowed && order == Order::Acceleration && self.reads == Reads::Solution {
                Ok(self.solved(lowering, Unknown::Acceleration(measure)))
            } else if allowed {
                Ok(self.program.push(Operation::Input(Input::Measure(measure))))
            } else {
                Err(self.refuse_order(lowering, call))
            };
        }
        if function == Function::Senval {
            // The checks of the dataset have reported a sensor that is not there.
            let id = arguments.first().and_then(Expr::as_id).ok_or(Refused)?;
            lowering.reads_sensors.insert(id);
            let kept = lowering.setting.kept.get(&id);
            return Ok(self.constant(kept.copied().unwrap_or(0.0)));
        }
        if let Some(input) = state_of(lowering, function, arguments) {
            return if self.reads >= Reads::Solution {
                Ok(self.program.push(Operation::Input(input)))
            } else {
                Err(self.refuse_order(lowering, call))
            };
        }
        if let Some(source) = ResultSource::of_call(lowering, function, arguments) {
            return match self.reads {
                Reads::Time | Reads::Displacements => Err(self.refuse_order(lowering, call)),
                Reads::Outputs => Ok(self.result(lowering, source)),
                Reads::Solution => self
                    .solved_result(lowering, source)
                    .ok_or_else(|| self.refuse_function(lowering, call)),
            };
        }
        match function {
            Function::Akispl | Function::Cubspl => {
                return self.interpolation(lowering, function, arguments);
            }
            Function::Mag => {
                let vector = self.vector(lowering, &arguments[0])?;
                return Ok(composite::magnitude(&mut self.program, vector));
            }
            Function::Curve => return self.curve_coordinate(lowering, arguments),
            Function::Invpsd => return self.power_density(lowering, arguments, *span),
            _ => {}
        }
        let of_numbers =
            (0..arguments.len()).all(|k| function.argument_kind(k) == ArgumentKind::Real);
        if !of_numbers {
            return Err(self.refuse_function(lowering, call));
        }
        let mut values = Vec::with_capacity(arguments.len());
        for argument in arguments {
            values.push(self.expr(lowering, argument)?);
        }
        self.mathematics(function, &values)
            .ok_or_else(|| self.refuse_function(lowering, call))
    }

    /// `AKISPL(x, z, spline, order)` and CUBSPL; the order is zero where it is left out.
    fn interpolation(
        &mut self,
        lowering: &mut Lowering,
        function: Function,
        arguments: &[Expr],
    ) -> Result<Register, Refused> {
        let number = |k: usize| arguments.get(k).and_then(Expr::as_id);
        // The checks of the dataset have reported a spline that is not there.
        let spline = number(2).and_then(|id| lowering.table(function, id));
        let table = spline.ok_or(Refused)?;
        let x = self.expr(lowering, &arguments[0])?;
        let z = self.expr(lowering, &arguments[1])?;
        let order = number(3).unwrap_or(0) as usize;
        Ok(self.program.push_lookup(&table, order, x, z))
    }

    /// `ARYVAL(array, element)`.
    fn array_element(&mut self, lowering: &mut Lowering, call: &Expr) -> Result<Register, Refused> {
        let found = element_of(lowering, call);
        match found {
            Some(ArrayElement::Number(value)) => Ok(self.constant(value)),
            Some(ArrayElement::Combination(combination)) => {
                let combination = combination.clone();
                let of_states = combination
                    .iter()
                    .any(|(term, _)| matches!(term, Term::State(_)));
                if of_states && self.reads < Reads::Solution {
                    return Err(self.refuse_order(lowering, call));
                }
                self.combination(lowering, &combination)
            }
            None => Err(self.refuse_function(lowering, call)),
        }
    }

    /// A sum of multiples of states and variables.
    pub(super) fn combination(
        &mut self,
        lowering: &mut Lowering,
        combination: &[(Term, f64)],
    ) -> Result<Register, Refused> {
        let mut sum = None;
        for &(term, factor) in combination {
            let value = match term {
                Term::State(place) => self.program.push(Operation::Input(Input::State(place))),
                Term::Variable(id) => {
                    self.close_variable(lowering, id)?;
                    self.variables.get(&id).copied().flatten().ok_or(Refused)?
                }
            };
            let value = if factor == 1.0 {
                value
            } else {
                let factor = self.constant(factor);
                self.binary(Binary::Multiply, factor, value)
            };
            sum = Some(match sum {
                Some(sum) => self.binary(Binary::Add, sum, value),
                None => value,
            });
        }
        Ok(sum.unwrap_or_else(|| self.constant(0.0)))
    }

    /// An algebraic variable.
    fn solved(&mut self, lowering: &mut Lowering, unknown: Unknown) -> Register {
        let place = lowering.measures.unknowns.place(unknown);
        self.program.push(Operation::Input(Input::Algebraic(place)))
    }

    /// A VARIABLE that is an unknown; reports one where it may not be read.
    fn unknown(
        &mut self,
        place: usize,
        lowering: &mut Lowering,
        id: u32,
        span: Span,
    ) -> Option<Register> {
        if self.reads >= Reads::Solution {
            return Some(self.program.push(Operation::Input(Input::Algebraic(place))));
        }
        let message = format!(
            "{} reads VARIABLE/{id}, which depends on itself; only forces, states and outputs may",
            self.owner
        );
        lowering.error(Code::UnsupportedFunction, span, message, None);
        None
    }

    /// A force that is solved together with the motion. `None` for what is known of a friction
    /// beside its force and torque.
    fn solved_result(&mut self, lowering: &mut Lowering, source: ResultSource) -> Option<Register> {
        let (acting, torque, axes, axis) = match source {
            ResultSource::Component {
                acting,
                component,
                axes,
            } => (acting, component >= 4, axes, (component % 4).checked_sub(1)),
            ResultSource::Friction {
                friction,
                component,
            } if component < 6 => {
                let element = &lowering.dataset.frictions[friction];
                let joint = lowering.dataset.joints.by_id(element.joint)?;
                let axes = lowering.marker_place(joint.j);
                let acting = Acting::Element(ForceElement::Friction(friction), Side::I);
                (acting, component >= 3, axes, Some(component % 3))
            }
            ResultSource::Friction { .. } => return None,
        };
        let mut along = |axis: usize| {
            let component = ForceComponent {
                acting,
                torque,
                axis,
                frame: axes,
            };
            self.solved(lowering, Unknown::Force(component))
        };
        Some(match axis {
            Some(axis) => along(axis),
            None => {
                let components = [0, 1, 2].map(along);
                composite::magnitude(&mut self.program, components)
            }
        })
    }

    /// A value that is known only once an instant has been solved.
    pub(super) fn result(&mut self, lowering: &mut Lowering, source: ResultSource) -> Register {
        lowering.results.push(source);
        self.program
            .push(Operation::Input(Input::Result(lowering.results.len() - 1)))
    }

    /// Reports a function that this element may not read.
    pub(super) fn refuse_order(&self, lowering: &mut Lowering, call: &Expr) -> Refused {
        let Expr::Call { function, span, .. } = call else {
            return Refused;
        };
        let may = match self.reads {
            Reads::Time => "TIME only",
            Reads::Displacements => "TIME and displacements only",
            Reads::Solution | Reads::Outputs => "less",
        };
        let message = format!(
            "{} reads {}, but it may read {may}",
            self.owner,
            function.name()
        );
        lowering.error(Code::UnsupportedFunction, *span, message, None);
        Refused
    }

    /// Reports a function that is not simulated: once, where it stands, with all elements whose
    /// functions hold it.
    pub(super) fn refuse_function(&self, lowering: &mut Lowering, call: &Expr) -> Refused {
        let Expr::Call { function, span, .. } = call else {
            return Refused;
        };
        let (reason, help) = refusal(*function);
        let owner = match self.within {
            Some(id) => format!("VARIABLE/{id}"),
            None => self.owner.clone(),
        };
        let message = format!("{owner}: {} {reason}", function.name());
        let mut refused = lowering.refused.iter_mut();
        let Some((_, _, others)) = refused.find(|(other, ..)| other == function) else {
            let place = lowering.diagnostics.len();
            lowering.refused.push((*function, place, Vec::new()));
            lowering.error(Code::UnsupportedFunction, *span, message, Some(help));
            return Refused;
        };
        if lowering.told.insert((span.start, span.end, message)) && others.last() != Some(&owner) {
            others.push(owner);
        }
        Refused
    }

    fn unary(&mut self, function: Unary, value: Register) -> Register {
        self.program.push(Operation::Unary(function, value))
    }

    pub(super) fn binary(&mut self, function: Binary, a: Register, b: Register) -> Register {
        self.program.push(Operation::Binary(function, a, b))
    }

    /// The table of the functions of numbers.
    fn mathematics(&mut self, function: Function, x: &[Register]) -> Option<Register> {
        use Function as F;
        Some(match function {
            F::Abs => self.unary(Unary::Abs, x[0]),
            F::Acos => self.unary(Unary::Acos, x[0]),
            F::Aint => self.unary(Unary::Truncate, x[0]),
            F::Anint => self.unary(Unary::Round, x[0]),
            F::Asin => self.unary(Unary::Asin, x[0]),
            F::Atan => self.unary(Unary::Atan, x[0]),
            F::Cos => self.unary(Unary::Cos, x[0]),
            F::Cosh => self.unary(Unary::Cosh, x[0]),
            F::Exp => self.unary(Unary::Exp, x[0]),
            F::Log => self.unary(Unary::Log, x[0]),
            F::Log10 => self.unary(Unary::Log10, x[0]),
            F::Sin => self.unary(Unary::Sin, x[0]),
            F::Sinh => self.unary(Unary::Sinh, x[0]),
            F::Sqrt => self.unary(Unary::Sqrt, x[0]),
            F::Tan => self.unary(Unary::Tan, x[0]),
            F::Tanh => self.unary(Unary::Tanh, x[0]),
            F::Atan2 => self.binary(Binary::Atan2, x[0], x[1]),
            F::Max => self.binary(Binary::Max, x[0], x[1]),
            F::Min => self.binary(Binary::Min, x[0], x[1]),
            F::Mod => self.binary(Binary::Modulo, x[0], x[1]),
            F::Sign => self.binary(Binary::Sign, x[0], x[1]),
            F::Dim => composite::dim(&mut self.program, x[0], x[1]),
            F::If => self.program.push(Operation::If(x[0], x[1], x[2], x[3])),
            F::Step => composite::step(&mut self.program, Unary::CubicStep, x),
            F::Step5 => composite::step(&mut self.program, Unary::QuinticStep, x),
            F::Havsin => composite::step(&mut self.program, Unary::Haversine, x),
            F::Impact => composite::impact(&mut self.program, x),
            F::Bistop => composite::bistop(&mut self.program, x),
            F::Poly => composite::polynomial(&mut self.program, x),
            F::Cheby => composite::chebyshev(&mut self.program, x),
            F::Forsin => composite::fourier(&mut self.program, Unary::Sin, x),
            F::Forcos => composite::fourier(&mut self.program, Unary::Cos, x),
            F::Shf => composite::harmonic(&mut self.program, x),
            F::Sweep => composite::sweep(&mut self.program, x),
            _ => return None,
        })
    }
}

/// Why a function is not simulated, and what to write instead.
const fn refusal(function: Function) -> (&'static str, &'static str) {
    use Function as F;
    match function {
        F::User => (
            "calls a subroutine, which is not done",
            "write what the subroutine computes as an expression",
        ),
        F::Delay => (
            "reads values of the past, which are not kept",
            "a lag of first order is a DIFF: its rate is (x - DIF(id))/tau",
        ),
        F::Interp => (
            "reads time histories of other programs, which is not done",
            "give the points in a SPLINE and read it by AKISPL or CUBSPL",
        ),
        F::Orient => (
            "knows types 1 to 12 (three components) and 27 (four) only",
            "type 1 is 1-2-3, 6 is 3-2-1, 11 is 3-1-3; 27 gives the Euler parameters",
        ),
        F::Aryval => (
            "reads an element that the array does not have",
            "an array of states or outputs has those of the LSE or TFSISO that names it",
        ),
        F::Contact | F::Cvcv | F::Nforce => (
            "reads a force of an element that is not simulated",
            "take the element and what reads it out of the model",
        ),
        _ => (
            "cannot be computed from these arguments",
            "docs/functions.md lists the functions and what they take",
        ),
    }
}

/// The variable that a call stands for: VARVAL, PINVAL or POUVAL.
fn variable_of(lowering: &Lowering, call: &Expr) -> Option<u32> {
    let Expr::Call {
        function,
        arguments,
        ..
    } = call
    else {
        return None;
    };
    let id = arguments.first()?.as_id()?;
    let port = match function {
        Function::Varval => return Some(id),
        Function::Pinval => lowering.dataset.plant_inputs.by_id(id)?,
        Function::Pouval => lowering.dataset.plant_outputs.by_id(id)?,
        _ => return None,
    };
    let number = arguments.get(1)?.as_id()?.checked_sub(1)?;
    port.variables.get(number as usize).copied()
}

/// What DIF and DIF1 read.
fn state_of(lowering: &Lowering, function: Function, arguments: &[Expr]) -> Option<Input> {
    let input = match function {
        Function::Dif => Input::State,
        Function::Dif1 => Input::StateRate,
        _ => return None,
    };
    let id = arguments.first()?.as_id()?;
    lowering.dataset.differentials.position(id).map(input)
}

/// What an ARYVAL reads; `None` for other nodes, and where there is no such element.
fn element_of<'a>(lowering: &'a Lowering, node: &Expr) -> Option<ArrayElement<'a>> {
    let Expr::Call {
        function: Function::Aryval,
        arguments,
        ..
    } = node
    else {
        return None;
    };
    let [array, element] = [arguments.first()?.as_id()?, arguments.get(1)?.as_id()?];
    let dataset = lowering.dataset;
    lowering.linear_systems.element(dataset, array, element)
}

/// The variables that an expression reads.
pub(super) fn variables_of(lowering: &Lowering, root: &Expr) -> Vec<u32> {
    let mut found = Vec::new();
    root.visit(&mut |node| {
        found.extend(variable_of(lowering, node));
        if let Some(ArrayElement::Combination(terms)) = element_of(lowering, node) {
            found.extend(terms.iter().filter_map(|(term, _)| match term {
                Term::Variable(id) => Some(*id),
                Term::State(_) => None,
            }));
        }
    });
    found
}

impl Lowering<'_> {
    /// The program of one function of an element.
    pub(super) fn function(
        &mut self,
        element: &impl Element,
        statement: &str,
        reads: Reads,
        expression: &Expression,
    ) -> Option<Program> {
        let mut compiler = Compiler::new(reads);
        let owner = format!("{statement}/{}", element.header().id);
        let value = compiler.add(self, &owner, expression).ok()?;
        Some(compiler.finish(value))
    }
}
