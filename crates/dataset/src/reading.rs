//! One statement with its arguments, and typed access to them.

use crate::arguments;
use crate::diagnostic::{Code, Diagnostics};
use crate::expression::{Expr, Expression};
use crate::keywords::{Argument, Keyword, Value};
use crate::model::Header;
use crate::names::{self, Match, Name};
use crate::source::Span;
use crate::syntax::Item;

/// A statement whose arguments are read.
pub(crate) struct Reading<'a, 's> {
    /// Its name, in full.
    pub(crate) name: &'static str,
    /// From its name to its last argument.
    pub(crate) span: Span,
    /// Its name and identifier.
    pub(crate) head: Span,
    /// The identifier; 0 where it is missing, which has been reported.
    pub(crate) id: u32,
    /// The name from the comment before it.
    pub(crate) view_name: Option<String>,
    /// Everything behind the name and identifier.
    pub(crate) items: &'a [Item],
    pub(crate) diagnostics: &'a mut Diagnostics<'s>,
    arguments: Vec<Argument>,
}

/// Name, place and identifier of a statement.
pub(crate) struct Head {
    pub(crate) name: &'static str,
    pub(crate) span: Span,
    pub(crate) head: Span,
    pub(crate) id: u32,
    pub(crate) view_name: Option<String>,
}

impl<'a, 's> Reading<'a, 's> {
    /// Reads the arguments, which follow the head of the statement in `items`.
    pub(crate) fn new(
        head: Head,
        items: &'a [Item],
        keywords: Option<&[Keyword]>,
        diagnostics: &'a mut Diagnostics<'s>,
    ) -> Self {
        let arguments = keywords.map_or_else(Vec::new, |keywords| {
            arguments::read(items, head.name, keywords, diagnostics)
        });
        Self {
            name: head.name,
            span: head.span,
            head: head.head,
            id: head.id,
            view_name: head.view_name,
            items,
            diagnostics,
            arguments,
        }
    }

    /// `NAME/id`, or the name alone without identifier, for messages.
    pub(crate) fn label(&self) -> String {
        match self.id {
            0 => self.name.to_string(),
            id => format!("{}/{id}", self.name),
        }
    }

    pub(crate) fn header(&self) -> Header {
        Header {
            id: self.id,
            name: self.view_name.clone(),
            span: self.span,
        }
    }

    /// All arguments, in the order of the statement.
    pub(crate) fn arguments(&self) -> &[Argument] {
        &self.arguments
    }

    pub(crate) fn argument(&self, keyword: &str) -> Option<&Argument> {
        self.arguments
            .iter()
            .find(|argument| argument.keyword == keyword)
    }

    fn value(&self, keyword: &str) -> Option<&Value> {
        let given = |argument: &&Argument| argument.keyword == keyword;
        let mut arguments = self.arguments.iter().filter(given);
        arguments.find_map(|argument| argument.value.as_ref())
    }

    /// Whether the argument is there, be it read, refused or without effect.
    pub(crate) fn has(&self, keyword: &str) -> bool {
        self.argument(keyword).is_some()
    }

    /// The items of the arguments that are not read; to be asked before any value is taken.
    pub(crate) fn unread(&self) -> impl Iterator<Item = &'a [Item]> {
        let unread = self.arguments.iter().filter(|a| a.value.is_none());
        unread.map(|argument| &self.items[argument.items.clone()])
    }

    /// Whether there is no argument at all.
    pub(crate) fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// The place of an argument, else that of the head.
    pub(crate) fn place(&self, keyword: &str) -> Span {
        self.argument(keyword)
            .map_or(self.head, |argument| argument.span)
    }

    /// Reports that a required argument is missing, unless it was there and refused.
    pub(crate) fn require(&mut self, keyword: &'static str) {
        if !self.has(keyword) {
            let message = format!("{} needs {keyword}", self.label());
            self.diagnostics
                .error(Code::MissingArgument, self.head, message)
                .help(format!("add {keyword}=..."));
        }
    }

    fn out_of_range(&mut self, keyword: &str, range: &str) {
        let span = self
            .argument(keyword)
            .map_or(self.head, |argument| argument.value_span);
        let message = format!("{keyword} must be {range}");
        self.diagnostics.error(Code::OutOfRange, span, message);
    }

    /// A number.
    pub(crate) fn real(&self, keyword: &str) -> Option<f64> {
        match self.value(keyword)? {
            Value::Reals(values) => values.first().map(|(value, _)| *value),
            _ => None,
        }
    }

    /// A number greater than zero.
    pub(crate) fn positive(&mut self, keyword: &str) -> Option<f64> {
        let value = self.real(keyword)?;
        if value > 0.0 {
            return Some(value);
        }
        self.out_of_range(keyword, "greater than 0");
        None
    }

    /// A number that is not negative.
    pub(crate) fn not_negative(&mut self, keyword: &str) -> Option<f64> {
        let value = self.real(keyword)?;
        if value >= 0.0 {
            return Some(value);
        }
        self.out_of_range(keyword, "0 or greater");
        None
    }

    /// Numbers with their places.
    pub(crate) fn reals(&self, keyword: &str) -> &[(f64, Span)] {
        match self.value(keyword) {
            Some(Value::Reals(values)) => values,
            _ => &[],
        }
    }

    /// Numbers with their places, for each time that the argument is given.
    pub(crate) fn reals_each(&self, keyword: &str) -> Vec<Vec<(f64, Span)>> {
        let given = self.arguments.iter().filter(|a| a.keyword == keyword);
        given
            .filter_map(|argument| match &argument.value {
                Some(Value::Reals(values)) => Some(values.clone()),
                _ => None,
            })
            .collect()
    }

    /// Three numbers.
    pub(crate) fn vector(&self, keyword: &str) -> Option<[f64; 3]> {
        match self.reals(keyword) {
            [(x, _), (y, _), (z, _)] => Some([*x, *y, *z]),
            _ => None,
        }
    }

    /// Three numbers that are not negative.
    pub(crate) fn not_negative_vector(&mut self, keyword: &str) -> Option<[f64; 3]> {
        let vector = self.vector(keyword)?;
        if vector.iter().all(|value| *value >= 0.0) {
            return Some(vector);
        }
        self.out_of_range(keyword, "three numbers, each 0 or greater");
        None
    }

    /// A whole number.
    pub(crate) fn integer(&self, keyword: &str) -> Option<u32> {
        self.ids(keyword).first().map(|(value, _)| *value)
    }

    /// A whole number greater than zero.
    pub(crate) fn count(&mut self, keyword: &str) -> Option<u32> {
        let value = self.integer(keyword)?;
        if value > 0 {
            return Some(value);
        }
        self.out_of_range(keyword, "1 or greater");
        None
    }

    /// Whole numbers with their places.
    pub(crate) fn ids(&self, keyword: &str) -> &[(u32, Span)] {
        match self.value(keyword) {
            Some(Value::Integers(values)) => values,
            _ => &[],
        }
    }

    /// A text.
    pub(crate) fn text(&self, keyword: &str) -> Option<String> {
        match self.value(keyword)? {
            Value::Text(text) => Some(text.clone()),
            _ => None,
        }
    }

    /// Texts.
    pub(crate) fn strings(&self, keyword: &str) -> Vec<String> {
        match self.value(keyword) {
            Some(Value::Strings(texts)) => texts.clone(),
            _ => Vec::new(),
        }
    }

    /// Takes an expression that gives a number out of its argument, which has no value from then on.
    pub(crate) fn expression(&mut self, keyword: &str) -> Option<Expression> {
        let help = "take a component, such as DX(i, j), or the magnitude, MAG(...)";
        self.expression_of(keyword, false, "a number, not a vector", help)
    }

    /// The same for one that gives a vector.
    pub(crate) fn vector_expression(&mut self, keyword: &str) -> Option<Expression> {
        let help = "write a vector function, such as DXYZ(i, j), or [x, y, z]";
        self.expression_of(keyword, true, "a vector", help)
    }

    fn expression_of(
        &mut self,
        keyword: &str,
        vector: bool,
        what: &str,
        help: &str,
    ) -> Option<Expression> {
        let given = self.arguments.iter_mut().filter(|a| a.keyword == keyword);
        let mut given = given.map(|argument| &mut argument.value);
        let is_expression =
            |value: &&mut Option<Value>| matches!(value, Some(Value::Expression(_)));
        let Value::Expression(expression) = given.find(is_expression)?.take()? else {
            return None;
        };
        if expression.root.is_vector() != vector {
            let message = format!("{keyword} takes {what}");
            self.diagnostics
                .error(Code::Expression, expression.span, message)
                .help(help);
        }
        Some(expression)
    }

    /// An expression that must be there; where it is not, that is reported and a zero is given.
    pub(crate) fn required_expression(&mut self, keyword: &'static str) -> Expression {
        self.require(keyword);
        self.expression(keyword).unwrap_or(Expression {
            span: self.head,
            root: Expr::Number(0.0),
            text: String::new(),
        })
    }

    /// A list of names, each one of `choices`.
    pub(crate) fn choices<T: Copy>(
        &mut self,
        keyword: &'static str,
        choices: &[(&'static str, T)],
    ) -> Option<Vec<T>> {
        let Value::Words(words) = self.value(keyword)? else {
            return None;
        };
        let words = words.clone();
        words
            .into_iter()
            .map(|span| self.choose(keyword, span, choices))
            .collect()
    }

    /// One name out of `choices`.
    pub(crate) fn choice<T: Copy>(
        &mut self,
        keyword: &'static str,
        choices: &[(&'static str, T)],
    ) -> Option<T> {
        self.choices(keyword, choices)?.first().copied()
    }

    fn choose<T: Copy>(
        &mut self,
        keyword: &str,
        span: Span,
        choices: &[(&'static str, T)],
    ) -> Option<T> {
        let word = self.diagnostics.source.slice(span);
        let names = choices.iter().map(|(full, _)| Name { full, least: full });
        let near = match names::find(word, names) {
            Match::One(index) => return choices.get(index).map(|(_, value)| *value),
            Match::Several(_) => None,
            Match::None => names::nearest(word, choices.iter().map(|(name, _)| *name)),
        };
        let message = format!(
            "{keyword} cannot be {}",
            self.diagnostics.source.excerpt(span)
        );
        let names: Vec<&str> = choices.iter().map(|(name, _)| *name).collect();
        self.diagnostics
            .error(Code::InvalidValue, span, message)
            .help(format!("it can be {}", names.join(", ")))
            .meant(near);
        None
    }

    /// T and F, as in PATTERN.
    pub(crate) fn pattern(&mut self, keyword: &'static str) -> Option<Vec<bool>> {
        self.choices(keyword, &[("TRUE", true), ("FALSE", false)])
    }

    /// ON or OFF.
    pub(crate) fn switch(&mut self, keyword: &'static str) -> Option<bool> {
        self.choice(keyword, &[("ON", true), ("OFF", false)])
    }

    /// The only one of several flags that is given.
    pub(crate) fn one_flag<T: Copy>(&mut self, flags: &[(&'static str, T)]) -> Option<T> {
        let mut given = flags.iter().filter(|(name, _)| self.has(name));
        let (first, value) = given.next()?;
        if let Some((second, _)) = given.next() {
            let message = format!("{} cannot be both {first} and {second}", self.label());
            let span = self.place(second);
            self.diagnostics
                .error(Code::ConflictingArguments, span, message);
        }
        Some(*value)
    }

    /// Like [`Reading::one_flag`] for flags of which one must be given.
    pub(crate) fn required_flag<T: Copy>(
        &mut self,
        what: &str,
        flags: &[(&'static str, T)],
    ) -> Option<T> {
        let given = self.one_flag(flags);
        if given.is_none() {
            let names: Vec<&str> = flags.iter().map(|(name, _)| *name).collect();
            let message = format!("{} needs {what}", self.label());
            self.diagnostics
                .error(Code::MissingArgument, self.head, message)
                .help(format!("add one of {}", names.join(", ")));
        }
        given
    }

    /// Reports every argument of `second` that is given although `first` is.
    pub(crate) fn exclude(&mut self, first: &'static str, second: &[&'static str]) {
        if !self.has(first) {
            return;
        }
        for other in second
            .iter()
            .filter(|other| self.has(other))
            .copied()
            .collect::<Vec<_>>()
        {
            let message = format!("{} cannot have both {first} and {other}", self.label());
            let span = self.place(other);
            self.diagnostics
                .error(Code::ConflictingArguments, span, message)
                .help("keep one of them");
        }
    }
}
