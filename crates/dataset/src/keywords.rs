//! The keywords of statements, and the values that statements give them.

use crate::expression::Expression;
use crate::names::Name;
use crate::source::Span;
use std::ops::Range;

/// What the value of an argument looks like, or why there is none.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kind {
    /// No value.
    Flag,
    /// A number, `D` for degrees allowed.
    Real,
    /// Between so many and so many numbers.
    Reals(usize, usize),
    /// Numbers; the argument may be given several times.
    RealsEach,
    /// A whole number.
    Integer,
    /// A positive whole number.
    Id,
    /// Positive whole numbers.
    Ids,
    /// Positive whole numbers, or ALL.
    IdsOrAll,
    /// One name.
    Word,
    /// Names with `:` or `,` between them, brackets round them allowed.
    Words,
    /// Everything up to `, NAME =` or a continued line that starts with the name of a flag.
    Text,
    /// Texts in quotes.
    Strings,
    /// A run-time expression.
    Expression,
    /// Anything; reported as without effect, with the reason.
    Ignored(&'static str),
    /// Anything; refused, with the reason.
    Unsupported(&'static str),
}

impl Kind {
    /// Whether the value is one number or more.
    pub(crate) const fn is_numeric(self) -> bool {
        matches!(
            self,
            Self::Real
                | Self::Reals(..)
                | Self::RealsEach
                | Self::Integer
                | Self::Id
                | Self::Ids
                | Self::IdsOrAll
        )
    }
}

/// One argument that a statement can have.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Keyword {
    pub(crate) name: Name,
    pub(crate) kind: Kind,
}

/// An argument whose abbreviations are those that fit no other.
pub(crate) const fn keyword(full: &'static str, kind: Kind) -> Keyword {
    abbreviated(full, full, kind)
}

/// An argument that `least` stands for even where other arguments start so too.
pub(crate) const fn abbreviated(full: &'static str, least: &'static str, kind: Kind) -> Keyword {
    Keyword {
        name: Name { full, least },
        kind,
    }
}

/// Why nothing that calls a subroutine of the user is simulated.
pub(crate) const SUBROUTINE: &str = "subroutines are not called";

/// ROUTINE: the library and the name of a subroutine.
pub(crate) const ROUTINE: Keyword = keyword("ROUTINE", Kind::Unsupported(SUBROUTINE));

/// INTERFACE: the language of a subroutine, which is refused where it is named.
pub(crate) const INTERFACE: Keyword =
    keyword("INTERFACE", Kind::Ignored("it is about a subroutine"));

/// The value that a statement gives to an argument.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    Flag,
    Reals(Vec<(f64, Span)>),
    Integers(Vec<(u32, Span)>),
    Words(Vec<Span>),
    Text(String),
    Strings(Vec<String>),
    Expression(Expression),
}

/// An argument of a statement.
#[derive(Clone, Debug)]
pub(crate) struct Argument {
    pub(crate) keyword: &'static str,
    /// The keyword.
    pub(crate) span: Span,
    /// The value, or the keyword where there is none.
    pub(crate) value_span: Span,
    /// The positions of keyword and value among the items of the statement.
    pub(crate) items: Range<usize>,
    /// `None` where it is wrong or without effect, which has been reported, or has been taken.
    pub(crate) value: Option<Value>,
}
