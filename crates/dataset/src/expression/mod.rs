//! Run-time expressions: the syntax tree of a FUNCTION argument.

mod foreign;
mod function;
mod parser;

pub use function::{ArgumentKind, ElementKind, Function};
pub(crate) use parser::parse;

use crate::source::Span;

/// A run-time expression of a statement.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    /// Its place.
    pub span: Span,
    /// Its tree.
    pub root: Expr,
    /// Its text on one line, without comments and continuation marks.
    pub text: String,
}

/// A node of an expression. Trees are at most [`DEEPEST`] levels deep, so recursion is safe.
///
/// PI, DTOR and RTOD are numbers already; numbers with the suffix `D` are in radians.
#[derive(Clone, Debug, PartialEq)]
pub enum Expr {
    /// A number.
    Number(f64),
    /// TIME.
    Time,
    /// MODE: the kind of the running analysis (4 = dynamics, 5 = statics, ...).
    Mode,
    /// Minus.
    Negate(Box<Self>),
    /// An operation with two operands.
    Binary {
        /// Which one.
        operator: BinaryOperator,
        /// Left operand.
        left: Box<Self>,
        /// Right operand.
        right: Box<Self>,
    },
    /// Three scalars: `[x, y, z]`.
    Vector(Vec<Self>),
    /// A function call. The number of arguments fits the function; markers, elements and integer
    /// arguments are [`Expr::Number`] with a whole number.
    Call {
        /// Which function.
        function: Function,
        /// Arguments in order; `IF(a: b, c, d)` has four.
        arguments: Vec<Self>,
        /// The place of the call.
        span: Span,
    },
}

/// The deepest tree that an expression may have.
pub const DEEPEST: usize = 1000;

impl Expr {
    /// The number of a marker, element or integer argument.
    ///
    /// ```
    /// use dataset::Expr;
    /// assert_eq!(Expr::Number(12.0).as_id(), Some(12));
    /// assert_eq!(Expr::Time.as_id(), None);
    /// ```
    #[must_use]
    pub fn as_id(&self) -> Option<u32> {
        match self {
            Self::Number(value)
                if value.fract() == 0.0 && (0.0..=4_294_967_295.0).contains(value) =>
            {
                Some(*value as u32)
            }
            _ => None,
        }
    }

    /// Calls `visit` with every node, parents first.
    pub fn visit<'a>(&'a self, visit: &mut impl FnMut(&'a Self)) {
        visit(self);
        match self {
            Self::Number(_) | Self::Time | Self::Mode => {}
            Self::Negate(operand) => operand.visit(visit),
            Self::Binary { left, right, .. } => {
                left.visit(visit);
                right.visit(visit);
            }
            Self::Call { arguments, .. } | Self::Vector(arguments) => {
                for argument in arguments {
                    argument.visit(visit);
                }
            }
        }
    }

    /// Whether it gives a vector.
    #[must_use]
    pub fn is_vector(&self) -> bool {
        match self {
            Self::Number(_) | Self::Time | Self::Mode => false,
            Self::Negate(operand) => operand.is_vector(),
            Self::Binary {
                operator: BinaryOperator::Multiply,
                left,
                right,
            } => left.is_vector() != right.is_vector(),
            Self::Binary { left, .. } => left.is_vector(),
            Self::Vector(_) => true,
            Self::Call { function, .. } => function.gives_vector(),
        }
    }
}

/// An operation with two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BinaryOperator {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
    /// `**`
    Power,
    /// `%`, the cross product of two vectors.
    Cross,
}

impl BinaryOperator {
    /// Whether it gives a vector of operands that are vectors or not; `None` where it does not take
    /// such operands.
    pub(crate) const fn gives_vector(self, left: bool, right: bool) -> Option<bool> {
        match (self, left, right) {
            (Self::Add | Self::Subtract, true, true)
            | (Self::Multiply, true, false)
            | (Self::Multiply, false, true)
            | (Self::Divide, true, false)
            | (Self::Cross, true, true) => Some(true),
            (Self::Multiply, true, true) => Some(false),
            (Self::Cross, ..) | (_, true, _) | (_, _, true) => None,
            (_, false, false) => Some(false),
        }
    }
}
