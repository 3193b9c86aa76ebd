//! Expressions of vectors to three scalars (Adams Solver help: Operators, UV, TRANS and the other
//! vector functions).

use dataset::{BinaryOperator, Expr, Expression, Function, VectorForce};
use mechanics::expression::{Binary, Input, Operation, Program, Register, Unary};

use super::Lowering;
use super::composite::magnitude;
use super::expression::{Compiler, Reads, Refused};

/// The components of a vector.
type Vector = [Register; 3];

impl Compiler {
    /// Recursion is no deeper than an expression, which is `dataset::DEEPEST` at most.
    pub(super) fn vector(
        &mut self,
        lowering: &mut Lowering,
        expr: &Expr,
    ) -> Result<Vector, Refused> {
        match expr {
            Expr::Vector(components) => {
                let [x, y, z] = components.as_slice() else {
                    return Err(Refused);
                };
                Ok([
                    self.expr(lowering, x)?,
                    self.expr(lowering, y)?,
                    self.expr(lowering, z)?,
                ])
            }
            Expr::Negate(operand) => {
                let operand = self.vector(lowering, operand)?;
                Ok(operand.map(|a| self.program.push(Operation::Unary(Unary::Negate, a))))
            }
            Expr::Binary {
                operator,
                left,
                right,
            } => self.operation(lowering, *operator, left, right),
            Expr::Call { .. } => self.function(lowering, expr),
            // The parser has told numbers from vectors.
            Expr::Number(_) | Expr::Time | Expr::Mode => Err(Refused),
        }
    }

    fn operation(
        &mut self,
        lowering: &mut Lowering,
        operator: BinaryOperator,
        left: &Expr,
        right: &Expr,
    ) -> Result<Vector, Refused> {
        match operator {
            BinaryOperator::Add | BinaryOperator::Subtract => {
                let function = match operator {
                    BinaryOperator::Add => Binary::Add,
                    _ => Binary::Subtract,
                };
                let (a, b) = (self.vector(lowering, left)?, self.vector(lowering, right)?);
                Ok([0, 1, 2].map(|k| self.binary(function, a[k], b[k])))
            }
            BinaryOperator::Multiply => {
                let (vector, factor) = match left.is_vector() {
                    true => (self.vector(lowering, left)?, self.expr(lowering, right)?),
                    false => {
                        let factor = self.expr(lowering, left)?;
                        (self.vector(lowering, right)?, factor)
                    }
                };
                Ok(vector.map(|a| self.binary(Binary::Multiply, factor, a)))
            }
            BinaryOperator::Divide => {
                let vector = self.vector(lowering, left)?;
                let divisor = self.expr(lowering, right)?;
                Ok(vector.map(|a| self.binary(Binary::Divide, a, divisor)))
            }
            BinaryOperator::Cross => {
                let (a, b) = (self.vector(lowering, left)?, self.vector(lowering, right)?);
                Ok([(1, 2), (2, 0), (0, 1)].map(|(j, k)| {
                    let forwards = self.binary(Binary::Multiply, a[j], b[k]);
                    let backwards = self.binary(Binary::Multiply, a[k], b[j]);
                    self.binary(Binary::Subtract, forwards, backwards)
                }))
            }
            BinaryOperator::Power => Err(Refused),
        }
    }

    fn function(&mut self, lowering: &mut Lowering, call: &Expr) -> Result<Vector, Refused> {
        let Expr::Call {
            function,
            arguments,
            span,
        } = call
        else {
            return Err(Refused);
        };
        if let Some([x, y, z]) = function.components() {
            let mut component = |function| {
                let component = Expr::Call {
                    function,
                    arguments: arguments.clone(),
                    span: *span,
                };
                self.expr(lowering, &component)
            };
            return Ok([component(x)?, component(y)?, component(z)?]);
        }
        let marker = |k: usize| arguments.get(k).and_then(Expr::as_id).unwrap_or(0);
        match function {
            Function::Uvx => self.axis(lowering, call, 0, [marker(0), marker(1)]),
            Function::Uvy => self.axis(lowering, call, 1, [marker(0), marker(1)]),
            Function::Uvz => self.axis(lowering, call, 2, [marker(0), marker(1)]),
            Function::Uv => {
                let vector = self.vector(lowering, &arguments[0])?;
                let length = magnitude(&mut self.program, vector);
                Ok(vector.map(|a| self.binary(Binary::Divide, a, length)))
            }
            Function::Trans => {
                let vector = self.vector(lowering, &arguments[0])?;
                let markers = [marker(1), marker(2)];
                let mut along = |a| -> Result<Register, Refused> {
                    let cosines = self.axis(lowering, call, a, markers)?;
                    Ok(self.inner(cosines, vector))
                };
                Ok([along(0)?, along(1)?, along(2)?])
            }
            _ => Err(self.refuse_function(lowering, call)),
        }
    }

    /// Axis `a` of a marker along the axes of another one.
    fn axis(
        &mut self,
        lowering: &mut Lowering,
        call: &Expr,
        a: usize,
        [of, along]: [u32; 2],
    ) -> Result<Vector, Refused> {
        if self.reads() < Reads::Displacements {
            return Err(self.refuse_order(lowering, call));
        }
        let [of, along] = [of, along].map(|id| lowering.marker_place(id));
        let ground = lowering.ground;
        Ok([0, 1, 2].map(|b| {
            let cosine = lowering
                .measures
                .direction_cosine([a, b], of, along, ground);
            self.program.push(Operation::Input(Input::Measure(cosine)))
        }))
    }

    /// The inner product.
    pub(super) fn inner(&mut self, a: Vector, b: Vector) -> Register {
        let [x, y, z] = [0, 1, 2].map(|k| self.binary(Binary::Multiply, a[k], b[k]));
        let sum = self.binary(Binary::Add, x, y);
        self.binary(Binary::Add, sum, z)
    }
}

impl Lowering<'_> {
    /// The program of a component of a vector that a force has for a function.
    pub(super) fn component_of(
        &mut self,
        force: &VectorForce,
        statement: &str,
        expression: &Expression,
        component: usize,
    ) -> Option<Program> {
        let mut compiler = Compiler::new(Reads::Solution);
        let owner = format!("{statement}/{}", force.header.id);
        let vector = compiler.add_vector(self, &owner, expression).ok()?;
        Some(compiler.finish(vector[component]))
    }
}
