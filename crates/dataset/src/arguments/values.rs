//! The values of arguments, one reader for each [`Kind`].

use super::{Parser, Refused};
use crate::diagnostic::Code;
use crate::expression;
use crate::keywords::{Kind, Value};
use crate::names::{self, Match};
use crate::source::Span;
use crate::syntax::{TokenKind, join, number_value, with_exponent};
use std::borrow::Cow;

impl Parser<'_, '_> {
    /// Reads the value behind a keyword.
    pub(super) fn value(
        &mut self,
        name: &'static str,
        kind: Kind,
        span: Span,
    ) -> Result<Value, Refused> {
        let has_value = self.kind(self.at) == Some(TokenKind::Equals);
        if matches!(kind, Kind::Flag) {
            if has_value {
                return Err(self.refuse(self.at, format!("{name} takes no value")));
            }
            return Ok(Value::Flag);
        }
        if !has_value {
            let message = format!("{name} needs a value");
            self.diagnostics
                .error(Code::InvalidValue, span, message)
                .help(format!("write {name} = ..."));
            return Err(Refused);
        }
        self.at += 1;
        // A list may start on the next line: the comma there only continues the statement.
        let begins = self.items.get(self.at).is_some_and(|item| item.continues);
        if begins && self.kind(self.at) == Some(TokenKind::Comma) && self.number_at(self.at + 1) {
            self.at += 1;
        }
        match kind {
            Kind::Real => self.reals(name, 1, 1),
            Kind::Reals(least, most) => self.reals(name, least, most),
            Kind::RealsEach => self.reals(name, 1, usize::MAX),
            Kind::Integer => self.integers(name, 0, true),
            Kind::Id => self.integers(name, 1, true),
            Kind::Ids => self.integers(name, 1, false),
            Kind::IdsOrAll => self.integers_or_all(name),
            Kind::Word => self.words(name, false),
            Kind::Words => self.words(name, true),
            Kind::Strings => self.strings(),
            Kind::Expression => self.expression(),
            Kind::Text | Kind::Flag | Kind::Ignored(_) | Kind::Unsupported(_) => Ok(self.text()),
        }
    }

    /// Whether a number starts at `at`.
    fn number_at(&self, at: usize) -> bool {
        match self.kind(at) {
            Some(TokenKind::Number) => true,
            Some(TokenKind::Plus | TokenKind::Minus) => {
                self.kind(at + 1) == Some(TokenKind::Number)
            }
            _ => false,
        }
    }

    fn reals(&mut self, name: &str, least: usize, most: usize) -> Result<Value, Refused> {
        let first = self.at;
        let mut values = Vec::new();
        loop {
            if !self.number_at(self.at) {
                let what = if most == 1 { "a number" } else { "numbers" };
                return Err(self.expected(name, what));
            }
            let start = self.span(self.at);
            let negative = self.kind(self.at) == Some(TokenKind::Minus);
            if self.kind(self.at) != Some(TokenKind::Number) {
                self.at += 1;
            }
            let text = self.slice(self.at);
            let Some(value) = number_value(text) else {
                return Err(self.not_a_number(self.span(self.at)));
            };
            if !value.is_finite() {
                let message = format!(
                    "`{}` is too large for a number",
                    self.source.excerpt(self.span(self.at))
                );
                let span = self.span(self.at);
                self.diagnostics.error(Code::OutOfRange, span, message);
                return Err(Refused);
            }
            let span = start.to(self.span(self.at));
            values.push((if negative { -value } else { value }, span));
            self.at += 1;
            if self.kind(self.at) == Some(TokenKind::Comma) && self.number_at(self.at + 1) {
                self.at += 1;
            } else {
                break;
            }
        }
        self.end_of_value(name)?;
        if !(least..=most).contains(&values.len()) {
            let count = match least {
                _ if least == most => format!("{most}"),
                _ => format!("{least} to {most}"),
            };
            let plural = if most == 1 { "" } else { "s" };
            let message = format!(
                "{name} takes {count} number{plural}, found {}",
                values.len()
            );
            let span = self.span(first).to(self.span(self.at - 1));
            let error = self.diagnostics.error(Code::InvalidValue, span, message);
            // `1,5` for 1.5: digits on both sides of one comma.
            let written = self.source.slice(span);
            let decimal = written.replacen(',', ".", 1);
            if most == 1 && values.len() == 2 && decimal.parse::<f64>().is_ok() {
                error
                    .help(format!("decimals follow a point: write {decimal}"))
                    .replace(span, decimal);
            }
            return Err(Refused);
        }
        Ok(Value::Reals(values))
    }

    /// Reports digits with something else among or behind them.
    fn not_a_number(&mut self, span: Span) -> Refused {
        let message = format!("`{}` is not a number", self.source.excerpt(span));
        let text = self.source.slice(span);
        let error = self.diagnostics.error(Code::InvalidValue, span, message);
        if let Some(number) = with_exponent(text) {
            error
                .help(format!("D means degrees; with an exponent write {number}"))
                .replace(span, number);
        } else if text.matches('.').count() > 1 {
            error.help("a number has one decimal point");
        } else {
            error.help(
                "write digits only, such as 1.5E-3, or 90D for degrees; UNITS names the units",
            );
        }
        Refused
    }

    fn expected(&mut self, name: &str, what: &str) -> Refused {
        let message = match self.items.get(self.at) {
            Some(item) => {
                let found = self.source.excerpt(item.span());
                format!("{name} takes {what}, found `{found}`")
            }
            None => format!("{name} takes {what}, found nothing"),
        };
        self.refuse(self.at, message)
    }

    /// Whether the item is a name, but neither of an argument nor of anything with a value.
    fn plain_word_at(&self, at: usize) -> bool {
        self.kind(at) == Some(TokenKind::Word)
            && self.kind(at + 1) != Some(TokenKind::Equals)
            && !self.argument_at(at)
    }

    /// Reports anything but a separator behind a value.
    fn end_of_value(&mut self, name: &str) -> Result<(), Refused> {
        match self.kind(self.at) {
            None | Some(TokenKind::Comma | TokenKind::Backslash) => Ok(()),
            // The missing comma is reported where the argument is read.
            Some(TokenKind::Word) if self.argument_at(self.at) => Ok(()),
            Some(kind) => {
                let (before, here) = (self.span(self.at - 1), self.span(self.at));
                let after_number = self.kind(self.at - 1) == Some(TokenKind::Number);
                if after_number && before.end == here.start {
                    // The lexer ends `1.5.2` at its second point and `1D-3` at its sign.
                    let signed = matches!(kind, TokenKind::Plus | TokenKind::Minus);
                    let last = self.span(self.at + usize::from(signed));
                    if kind == TokenKind::Number || signed {
                        return Err(self.not_a_number(before.to(last)));
                    }
                }
                let found = self.source.excerpt(self.span(self.at));
                let message = format!("the value of {name} ends before `{found}`");
                Err(self.refuse(self.at, message))
            }
        }
    }

    fn integers(&mut self, name: &str, least: u32, one: bool) -> Result<Value, Refused> {
        let what = if least == 0 {
            "a whole number"
        } else {
            "the number of an element, 1 to 4294967295"
        };
        let mut values = Vec::new();
        loop {
            let value = match self.kind(self.at) {
                Some(TokenKind::Number) => self.slice(self.at).parse().ok(),
                _ => None,
            };
            match value.filter(|value| *value >= least) {
                Some(value) => values.push((value, self.span(self.at))),
                None => return Err(self.expected(name, self.whole(what))),
            }
            self.at += 1;
            let more = self.kind(self.at) == Some(TokenKind::Comma) && self.number_at(self.at + 1);
            if one && more {
                return Err(self.refuse(self.at + 1, format!("{name} takes one number")));
            }
            if !more {
                break;
            }
            self.at += 1;
        }
        self.end_of_value(name)?;
        Ok(Value::Integers(values))
    }

    /// What a whole number in place of the present item has to be.
    fn whole(&self, what: &'static str) -> &'static str {
        let digits = self
            .slice(self.at)
            .bytes()
            .all(|byte| byte.is_ascii_digit());
        let large = digits && self.slice(self.at).parse::<u32>().is_err();
        // The greatest number of a `u32`.
        if large {
            "a number up to 4294967295"
        } else {
            what
        }
    }

    fn integers_or_all(&mut self, name: &str) -> Result<Value, Refused> {
        if self.kind(self.at) != Some(TokenKind::Word) {
            return self.integers(name, 1, false);
        }
        if !self.slice(self.at).eq_ignore_ascii_case("ALL") {
            return Err(self.expected(name, "ALL or numbers of elements"));
        }
        self.words(name, false)
    }

    fn words(&mut self, name: &str, several: bool) -> Result<Value, Refused> {
        let open = several && self.kind(self.at) == Some(TokenKind::LeftParenthesis);
        self.at += usize::from(open);
        let mut words = Vec::new();
        loop {
            if self.kind(self.at) != Some(TokenKind::Word) {
                return Err(self.expected(name, "a name"));
            }
            words.push(self.span(self.at));
            self.at += 1;
            match self.kind(self.at) {
                Some(TokenKind::Colon) if several => self.at += 1,
                Some(TokenKind::Comma) if open || (several && self.plain_word_at(self.at + 1)) => {
                    self.at += 1;
                }
                _ => break,
            }
        }
        if open {
            if self.kind(self.at) != Some(TokenKind::RightParenthesis) {
                return Err(self.expected(name, "names in brackets and `)`"));
            }
            self.at += 1;
        }
        self.end_of_value(name)?;
        Ok(Value::Words(words))
    }

    /// Whether the comma at `at` is followed by another argument rather than by more text.
    fn text_ends_at(&self, at: usize) -> bool {
        let Some(comma) = self.items.get(at) else {
            return true;
        };
        let named = self.kind(at + 1) == Some(TokenKind::Word)
            && self.kind(at + 2) == Some(TokenKind::Equals);
        comma.kind() == TokenKind::Comma && (named || (comma.continues && self.argument_at(at + 1)))
    }

    fn text(&mut self) -> Value {
        let first = self.at;
        while !self.text_ends_at(self.at) {
            self.at += 1;
        }
        if first == self.at {
            return Value::Text(String::new());
        }
        let text = self.written(first);
        let text = text.trim_end_matches('\\').trim_end();
        let quoted = text
            .strip_prefix('"')
            .and_then(|text| text.strip_suffix('"'));
        Value::Text(quoted.unwrap_or(text).to_string())
    }

    /// The text from `first` to where the reader stands, as it is written; lines as one.
    fn written(&self, first: usize) -> Cow<'_, str> {
        if first == self.at {
            return Cow::Borrowed("");
        }
        let text = self
            .source
            .slice(self.span(first).to(self.span(self.at - 1)));
        if text.contains('\n') {
            return Cow::Owned(join(self.source, &self.items[first..self.at]));
        }
        Cow::Borrowed(text)
    }

    fn strings(&mut self) -> Result<Value, Refused> {
        let mut values = Vec::new();
        loop {
            let first = self.at;
            while !matches!(
                self.kind(self.at),
                None | Some(TokenKind::Comma | TokenKind::Backslash)
            ) {
                self.at += 1;
            }
            let text = self.written(first);
            values.push(text.trim_matches('"').to_string());
            if self.kind(self.at) != Some(TokenKind::Comma) || self.text_ends_at(self.at) {
                break;
            }
            self.at += 1;
        }
        Ok(Value::Strings(values))
    }

    fn expression(&mut self) -> Result<Value, Refused> {
        let keywords = self.keywords;
        let is_argument = |word: &str| {
            let names = keywords.iter().map(|keyword| keyword.name);
            matches!(names::find(word, names), Match::One(_))
        };
        match expression::parse(self.source, self.items, self.at, &is_argument) {
            Ok((expression, end)) => {
                self.at = end;
                Ok(Value::Expression(expression))
            }
            Err(problem) => {
                let error = self
                    .diagnostics
                    .error(problem.code, problem.span, problem.message);
                error.help = problem.help;
                error.replacement = problem.replacement;
                Err(Refused)
            }
        }
    }
}
