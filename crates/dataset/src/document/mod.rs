//! A dataset as a list of statements with full names and typed values, without places in a text.
//!
//! It is what the JSON form holds, and what must be the same before and after a text is laid out
//! anew. It follows from the tables of statements and keywords alone.

mod difference;
mod number;
mod reader;
mod writer;

pub(crate) use difference::difference;
pub(crate) use number::Number;
pub(crate) use reader::{read, text_of_lines};
pub(crate) use writer::write;

/// The statements of a dataset or command file.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Document {
    /// The lines that are taken as they are at the top: the title of a dataset.
    pub(crate) title: String,
    pub(crate) statements: Vec<Statement>,
    /// Comments behind the last statement.
    pub(crate) comments: Vec<String>,
    /// What follows END (STOP in a command file), which nobody reads.
    pub(crate) rest: String,
}

/// One statement.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Statement {
    /// The full name; in capitals as written where no statement has it.
    pub(crate) name: String,
    /// The identifier, where there is one.
    pub(crate) id: Option<u32>,
    /// The name from the `adams_view_name` comment.
    pub(crate) view_name: Option<String>,
    /// The other comments before it and in it, without `!`; empty ones are left out.
    pub(crate) comments: Vec<String>,
    pub(crate) body: Body,
}

/// What stands behind the head of a statement.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Body {
    /// Arguments by their full names, in the order of the text.
    Arguments(Vec<(String, Value)>),
    /// The text as it is, where no table tells its arguments; lines without blanks at their ends.
    Text(String),
}

/// The value of an argument.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    Flag,
    Number(Number),
    Numbers(Vec<Number>),
    /// Those of an argument that may be given several times.
    Rows(Vec<Vec<Number>>),
    Integer(u32),
    Integers(Vec<u32>),
    /// A name, as written.
    Word(String),
    Words(Vec<String>),
    Text(String),
    Strings(Vec<String>),
    /// An expression on one line, as written.
    Expression(String),
    /// The text of an argument that is not read.
    Raw(String),
}

impl PartialEq for Value {
    /// Blanks in an expression mean nothing.
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Flag, Self::Flag) => true,
            (Self::Number(a), Self::Number(b)) => a == b,
            (Self::Numbers(a), Self::Numbers(b)) => a == b,
            (Self::Rows(a), Self::Rows(b)) => a == b,
            (Self::Integer(a), Self::Integer(b)) => a == b,
            (Self::Integers(a), Self::Integers(b)) => a == b,
            (Self::Words(a), Self::Words(b)) | (Self::Strings(a), Self::Strings(b)) => a == b,
            (Self::Word(a), Self::Word(b))
            | (Self::Text(a), Self::Text(b))
            | (Self::Raw(a), Self::Raw(b)) => a == b,
            (Self::Expression(a), Self::Expression(b)) => {
                let solid = |byte: &u8| *byte != b' ';
                a.bytes().filter(solid).eq(b.bytes().filter(solid))
            }
            _ => false,
        }
    }
}
