//! Parses an expression: recursive descent with the precedence of FORTRAN.
//!
//! ```text
//! sum     = product { ("+" | "-") product }
//! product = sign { ("*" | "/" | "%") sign }
//! sign    = ("+" | "-") sign | power
//! power   = primary [ "**" sign ]
//! primary = number | name | name "(" sum { "," sum } ")" | "(" sum ")" | "[" sum "," sum "," sum "]"
//! ```
//!
//! Operands are scalars or vectors (Adams Solver help, Operators).

use super::{ArgumentKind, BinaryOperator, DEEPEST, Expr, Expression, Function, foreign};
use crate::diagnostic::{Code, Replacement};
use crate::names;
use crate::source::{Source, Span};
use crate::syntax::{Item, TokenKind, join, number_value, with_exponent};

/// What is wrong with an expression.
pub(crate) struct Problem {
    pub(crate) code: Code,
    pub(crate) span: Span,
    pub(crate) message: String,
    pub(crate) help: Option<String>,
    pub(crate) replacement: Option<Replacement>,
}

impl Problem {
    /// Says how to put it right, and what a program may put at `span` for it.
    fn fix(&mut self, help: String, span: Span, text: impl Into<String>) {
        let text = text.into();
        self.help = Some(help);
        self.replacement = Some(Replacement { span, text });
    }
}

/// How a choice is written.
const COMPARISON: &str = "a comparison is written IF(a - b: x, y, z): x where a is less than b, \
                          y where they are equal, z where a is greater";
/// How elements are named.
const NUMBERS: &str = "a dataset does not know the names of Adams View; write the number of the \
                       element";
/// What stands for a value without arguments.
const CONSTANTS: [&str; 5] = ["TIME", "MODE", "PI", "DTOR", "RTOD"];

/// The most brackets, calls and signs inside one another.
const DEEPEST_NESTING: usize = 200;

/// Parses the expression that starts at `items[start]`.
///
/// It ends at `\`, at a comma outside brackets, or at the end. A comma that continues a line is
/// no part of it, unless an argument of the statement follows, which `is_argument` decides: then
/// it ends there as well. Returns the expression and the position of the item behind it.
pub(crate) fn parse(
    source: &Source,
    items: &[Item],
    start: usize,
    is_argument: &dyn Fn(&str) -> bool,
) -> Result<(Expression, usize), Problem> {
    let mut parser = Parser {
        source,
        items,
        at: start,
        start,
        nesting: 0,
        brackets: 0,
        is_argument,
    };
    let Tree { root, .. } = parser.sum()?;
    if let Some(item) = parser.peek() {
        return Err(parser.unexpected(item, "an operator or the end of the expression"));
    }
    let span = parser.span_from(start).unwrap_or_default();
    let text = join(source, parser.used());
    Ok((Expression { span, root, text }, parser.at))
}

struct Parser<'a> {
    source: &'a Source,
    items: &'a [Item],
    at: usize,
    /// Where the expression starts.
    start: usize,
    nesting: usize,
    brackets: usize,
    is_argument: &'a dyn Fn(&str) -> bool,
}

/// A tree, its depth, and whether it gives a vector.
struct Tree {
    root: Expr,
    depth: usize,
    vector: bool,
}

impl Tree {
    /// A tree without branches.
    fn leaf(root: Expr) -> Self {
        Self {
            root,
            depth: 1,
            vector: false,
        }
    }
}

type Parsed = Result<Tree, Problem>;

impl Parser<'_> {
    /// The items of the expression so far: all but the commas that continue lines.
    fn used(&self) -> impl DoubleEndedIterator<Item = &Item> {
        let items = &self.items[self.start..self.at];
        items.iter().filter(|item| !item.continues)
    }

    /// The place of the items of the expression from `first` to where the parser stands.
    fn span_from(&self, first: usize) -> Option<Span> {
        let mut used = self.items[first..self.at]
            .iter()
            .filter(|item| !item.continues);
        let span = used.next()?.span();
        Some(used.next_back().map_or(span, |last| span.to(last.span())))
    }

    /// The next item of the expression; `None` where it ends.
    fn peek(&mut self) -> Option<Item> {
        let item = self.items.get(self.at)?;
        match item.kind() {
            TokenKind::Backslash | TokenKind::Comma => self.peek_at_separator(),
            _ => Some(*item),
        }
    }

    /// [`Parser::peek`] where a comma or backslash is next, which is seldom.
    fn peek_at_separator(&mut self) -> Option<Item> {
        while let Some(item) = self.items.get(self.at).copied() {
            if item.kind() == TokenKind::Backslash {
                return None;
            }
            if item.kind() != TokenKind::Comma {
                return Some(item);
            }
            if self.brackets > 0 && !item.continues {
                return Some(item);
            }
            if self.brackets == 0 && (!item.continues || self.argument_follows()) {
                return None;
            }
            self.at += 1;
        }
        None
    }

    /// Whether an argument of the statement follows the comma at `self.at`: a name and `=`, or
    /// a name where the expression could only go on with an operator.
    fn argument_follows(&self) -> bool {
        let Some(word) = self.items.get(self.at + 1) else {
            return false;
        };
        if word.kind() != TokenKind::Word || !(self.is_argument)(self.source.slice(word.span())) {
            return false;
        }
        let next = self.items.get(self.at + 2).map(|item| item.kind());
        next == Some(TokenKind::Equals) || self.after_operand()
    }

    fn take(&mut self) {
        self.at += 1;
    }

    fn take_if(&mut self, kind: TokenKind) -> Option<Item> {
        let item = self.peek().filter(|item| item.kind() == kind)?;
        self.take();
        Some(item)
    }

    fn slice(&self, item: Item) -> &str {
        self.source.slice(item.span())
    }

    fn problem(&self, code: Code, span: Span, message: String) -> Problem {
        Problem {
            code,
            span,
            message,
            help: None,
            replacement: None,
        }
    }

    fn unexpected(&self, item: Item, expected: &str) -> Problem {
        let found = self.source.excerpt(item.span());
        let message = format!("expected {expected}, found `{found}`");
        let mut problem = self.problem(Code::Expression, item.span(), message);
        let after_break = self.at > 0 && self.items[self.at - 1].continues;
        let before = self
            .used()
            .next_back()
            .copied()
            .filter(|_| self.after_operand());
        let touches = before.is_some_and(|before| before.span().end == item.span().start);
        let number = |item: Item| item.kind() == TokenKind::Number;
        if found == "^" {
            problem.fix("a power is written `**`".to_string(), item.span(), "**");
        } else if matches!(found.as_ref(), "<" | ">" | "=") {
            problem.help = Some(COMPARISON.to_string());
        } else if found == "." {
            // .GT. and its like stand behind a value, names in place of one.
            let help = if before.is_some() {
                COMPARISON
            } else {
                NUMBERS
            };
            problem.help = Some(help.to_string());
        } else if let Some(before) =
            before.filter(|before| touches && number(*before) && number(item))
        {
            problem = self.not_a_number(before.span().to(item.span()));
        } else if before.is_some() && !after_break && self.begins_operand(item) {
            self.missing_operator(item, &mut problem);
        } else if after_break {
            problem.help = Some(
                "the comma that starts a continued line is not part of the expression; \
                 end the line before with a comma to separate arguments"
                    .to_string(),
            );
        }
        problem
    }

    /// Whether the expression so far may end here.
    fn after_operand(&self) -> bool {
        self.used().next_back().is_some_and(|item| {
            matches!(
                item.kind(),
                TokenKind::Number | TokenKind::Word | TokenKind::RightParenthesis
            ) || self.slice(*item) == "]"
        })
    }

    fn begins_operand(&self, item: Item) -> bool {
        matches!(
            item.kind(),
            TokenKind::Number | TokenKind::Word | TokenKind::LeftParenthesis
        )
    }

    /// Says what is missing between two operands: the comma before an argument of the statement,
    /// else a sign.
    fn missing_operator(&self, item: Item, problem: &mut Problem) {
        let start = Span::new(item.span().start, item.span().start);
        let is_word = item.kind() == TokenKind::Word;
        if self.brackets == 0 && is_word && (self.is_argument)(self.slice(item)) {
            let help = "arguments are separated by commas".to_string();
            problem.fix(help, start, ", ");
        } else {
            problem.fix("a product is written with `*`".to_string(), start, "*");
        }
    }

    /// Digits with something else among or behind them.
    fn not_a_number(&self, span: Span) -> Problem {
        let message = format!("`{}` is not a number", self.source.excerpt(span));
        let mut problem = self.problem(Code::InvalidValue, span, message);
        let text = self.source.slice(span);
        let digits = text.len()
            - text
                .trim_start_matches(|c: char| c.is_ascii_digit() || c == '.')
                .len();
        let (number, name) = text.split_at(digits);
        if let Some(number) = with_exponent(text) {
            let help = format!("D means degrees; with an exponent write {number}");
            problem.fix(help, span, number);
        } else if number.matches('.').count() > 1 {
            problem.help = Some("a number has one decimal point".to_string());
        } else if Function::from_name(name).is_some() || is_constant(name) {
            let product = format!("{number}*{name}");
            problem.fix(
                format!("a product is written with `*`: {product}"),
                span,
                product,
            );
        } else {
            problem.help =
                Some("write digits only, such as 1.5E-3, or 90D for degrees".to_string());
        }
        problem
    }

    fn unexpected_end(&self, expected: &str) -> Problem {
        let span = self.used().next_back().map_or_else(
            || {
                let before = self.at.min(self.items.len()).saturating_sub(1);
                self.items
                    .get(before)
                    .map_or(Span::default(), |item| item.span())
            },
            |item| item.span(),
        );
        let message = format!("the expression ends here, {expected} is missing");
        self.problem(Code::Expression, span, message)
    }

    fn enter(&mut self, item: Item) -> Result<(), Problem> {
        self.nesting += 1;
        if self.nesting > DEEPEST_NESTING {
            let message = format!("more than {DEEPEST_NESTING} levels of brackets and signs");
            return Err(self.too_deep(item.span(), message));
        }
        Ok(())
    }

    fn too_deep(&self, span: Span, message: String) -> Problem {
        let mut problem = self.problem(Code::Expression, span, message);
        problem.help = Some("split the expression into several VARIABLEs".to_string());
        problem
    }

    fn binary(&self, item: Item, left: Tree, right: Tree) -> Parsed {
        let operator = match item.kind() {
            TokenKind::Plus => BinaryOperator::Add,
            TokenKind::Minus => BinaryOperator::Subtract,
            TokenKind::Star => BinaryOperator::Multiply,
            TokenKind::Slash => BinaryOperator::Divide,
            TokenKind::Power => BinaryOperator::Power,
            _ => BinaryOperator::Cross,
        };
        let depth = left.depth.max(right.depth) + 1;
        if depth > DEEPEST {
            let message = format!("an expression of more than {DEEPEST} operations in a row");
            return Err(self.too_deep(item.span(), message));
        }
        let vector = operator.gives_vector(left.vector, right.vector);
        let vector = vector.ok_or_else(|| self.no_such_operation(item, &left, &right))?;
        let root = Expr::Binary {
            operator,
            left: Box::new(left.root),
            right: Box::new(right.root),
        };
        Ok(Tree {
            root,
            depth,
            vector,
        })
    }

    /// Reports operands that an operator does not take.
    fn no_such_operation(&self, item: Item, left: &Tree, right: &Tree) -> Problem {
        let name = |tree: &Tree| if tree.vector { "a vector" } else { "a number" };
        let sign = self.source.excerpt(item.span());
        let message = format!("`{sign}` does not join {} and {}", name(left), name(right));
        let mut problem = self.problem(Code::Expression, item.span(), message);
        problem.help = Some(
            "vectors are added to vectors, multiplied with numbers and by `*` (inner product) or \
             `%` (cross product) with vectors, and divided by numbers"
                .to_string(),
        );
        problem
    }

    fn sum(&mut self) -> Parsed {
        let mut left = self.product()?;
        while let Some(item) = self.peek() {
            if !matches!(item.kind(), TokenKind::Plus | TokenKind::Minus) {
                break;
            }
            self.take();
            let right = self.product()?;
            left = self.binary(item, left, right)?;
        }
        Ok(left)
    }

    fn product(&mut self) -> Parsed {
        let mut left = self.sign()?;
        while let Some(item) = self.peek() {
            let is_sign = matches!(item.kind(), TokenKind::Star | TokenKind::Slash);
            if !(is_sign || self.slice(item) == "%") {
                break;
            }
            self.take();
            let right = self.sign()?;
            left = self.binary(item, left, right)?;
        }
        Ok(left)
    }

    fn sign(&mut self) -> Parsed {
        let Some(item) = self.peek() else {
            return Err(self.unexpected_end("an operand"));
        };
        if !matches!(item.kind(), TokenKind::Plus | TokenKind::Minus) {
            return self.power();
        }
        self.enter(item)?;
        self.take();
        let operand = self.sign()?;
        self.nesting -= 1;
        if item.kind() == TokenKind::Plus {
            return Ok(operand);
        }
        if operand.depth >= DEEPEST {
            let message = format!("an expression of more than {DEEPEST} operations in a row");
            return Err(self.too_deep(item.span(), message));
        }
        Ok(Tree {
            root: Expr::Negate(Box::new(operand.root)),
            depth: operand.depth + 1,
            ..operand
        })
    }

    fn power(&mut self) -> Parsed {
        let base = self.primary()?;
        let Some(item) = self.take_if(TokenKind::Power) else {
            return Ok(base);
        };
        self.enter(item)?;
        let exponent = self.sign()?;
        self.nesting -= 1;
        self.binary(item, base, exponent)
    }

    fn primary(&mut self) -> Parsed {
        let Some(item) = self.peek() else {
            return Err(self.unexpected_end("an operand"));
        };
        match item.kind() {
            TokenKind::Number => {
                let text = self.slice(item);
                let Some(value) = number_value(text) else {
                    return Err(self.not_a_number(item.span()));
                };
                if !value.is_finite() {
                    let text = self.source.excerpt(item.span());
                    let message = format!("`{text}` is too large for a number");
                    return Err(self.problem(Code::OutOfRange, item.span(), message));
                }
                self.take();
                Ok(Tree::leaf(Expr::Number(value)))
            }
            TokenKind::Word => self.name(item),
            TokenKind::LeftParenthesis => {
                self.enter(item)?;
                self.take();
                self.brackets += 1;
                let inner = self.sum()?;
                self.close(item)?;
                self.nesting -= 1;
                Ok(inner)
            }
            _ if self.slice(item) == "[" => self.vector(item),
            _ => Err(self.unexpected(item, "a number, a name or `(`")),
        }
    }

    /// Three numbers in square brackets.
    fn vector(&mut self, open: Item) -> Parsed {
        self.enter(open)?;
        self.take();
        self.brackets += 1;
        let mut components = Vec::with_capacity(3);
        let mut depth = 0;
        for place in 0..3 {
            let component = self.sum()?;
            let end = if place < 2 { "," } else { "]" };
            match self.peek() {
                Some(item) if component.vector => {
                    let message = "a vector has numbers for components".to_string();
                    return Err(self.problem(Code::Expression, item.span(), message));
                }
                Some(item) if self.slice(item) == end => self.take(),
                Some(item) => return Err(self.unexpected(item, &format!("an operator or `{end}`"))),
                None => return Err(self.unexpected_end(&format!("`{end}`"))),
            }
            depth = depth.max(component.depth);
            components.push(component.root);
        }
        self.brackets -= 1;
        self.nesting -= 1;
        if depth >= DEEPEST {
            let message = format!("an expression of more than {DEEPEST} operations in a row");
            return Err(self.too_deep(open.span(), message));
        }
        Ok(Tree {
            root: Expr::Vector(components),
            depth: depth + 1,
            vector: true,
        })
    }

    /// Takes the bracket that closes the one at `open`.
    fn close(&mut self, open: Item) -> Result<Item, Problem> {
        let Some(item) = self.peek() else {
            let message = "this bracket is not closed".to_string();
            let mut problem = self.problem(Code::Expression, open.span(), message);
            problem.help = Some("write `)` where it ends".to_string());
            return Err(problem);
        };
        if item.kind() != TokenKind::RightParenthesis {
            return Err(self.unexpected(item, "an operator, `,` or `)`"));
        }
        self.brackets -= 1;
        self.take();
        Ok(item)
    }

    fn name(&mut self, item: Item) -> Parsed {
        let name = self.source.slice(item.span());
        self.take();
        let open = self
            .peek()
            .filter(|next| next.kind() == TokenKind::LeftParenthesis);
        if let Some(open) = open {
            return match Function::from_name(name) {
                Some(function) => self.call(item, function, open),
                None => Err(self.unknown(item, name)),
            };
        }
        let is = |constant: &str| name.eq_ignore_ascii_case(constant);
        let root = if is("TIME") {
            Expr::Time
        } else if is("MODE") {
            Expr::Mode
        } else if is("PI") {
            Expr::Number(std::f64::consts::PI)
        } else if is("DTOR") {
            Expr::Number(std::f64::consts::PI / 180.0)
        } else if is("RTOD") {
            Expr::Number(180.0 / std::f64::consts::PI)
        } else {
            return Err(self.unknown(item, name));
        };
        Ok(Tree::leaf(root))
    }

    fn unknown(&self, item: Item, name: &str) -> Problem {
        let shown = self.source.excerpt(item.span());
        if let Some(reason) = foreign::reason(name) {
            let message = format!("{shown} is not simulated: {reason}");
            return self.problem(Code::UnsupportedFunction, item.span(), message);
        }
        let next = self.items.get(self.at);
        let touches = next
            .is_some_and(|next| next.span().start == item.span().end && self.slice(*next) == ".");
        if touches {
            let message = format!("{shown} is no number of an element");
            let mut problem = self.problem(Code::Expression, item.span(), message);
            problem.help = Some(NUMBERS.to_string());
            return problem;
        }
        if is_constant(name) {
            let message = format!("{shown} takes no arguments");
            let mut problem = self.problem(Code::Expression, item.span(), message);
            problem.help = Some(format!("write {shown} alone, or {shown}*( for a product"));
            return problem;
        }
        let message = format!("no function or constant is called {shown}");
        let mut problem = self.problem(Code::UnknownFunction, item.span(), message);
        if let Some(function) = Function::from_name(name) {
            let function = function.name();
            problem.help = Some(format!("{function} takes arguments in brackets"));
            return problem;
        }
        let called = next.is_some_and(|next| next.kind() == TokenKind::LeftParenthesis);
        let constants = || names::nearest(name, CONSTANTS.into_iter());
        let functions = Function::ALL.iter().map(|function| function.name());
        let functions = || names::nearest(name, functions);
        let near = match called {
            true => functions().or_else(constants),
            false => constants().or_else(functions),
        };
        if let Some(near) = near {
            problem.fix(format!("is {near} meant?"), item.span(), near);
        }
        problem
    }

    fn call(&mut self, name: Item, function: Function, open: Item) -> Parsed {
        self.enter(open)?;
        self.take();
        self.brackets += 1;
        let mut arguments = Vec::new();
        let mut deepest = 0;
        loop {
            let next = self.peek().map(|item| item.kind());
            if arguments.is_empty() && next == Some(TokenKind::RightParenthesis) {
                break;
            }
            let first = self.at;
            let argument = self.sum()?;
            let place = self.span_from(first).unwrap_or(open.span());
            self.check_argument(function, arguments.len(), &argument, place)?;
            arguments.push(argument.root);
            deepest = deepest.max(argument.depth);
            let separator = match (function, arguments.len()) {
                (Function::If, 1) => TokenKind::Colon,
                _ => TokenKind::Comma,
            };
            match self.peek() {
                Some(item) if item.kind() == separator => self.take(),
                Some(item) if separator == TokenKind::Colon => {
                    let mut problem = self.unexpected(item, "`:` after the condition of IF");
                    if problem.help.is_none() {
                        let help = "write IF(condition: below 0, at 0, above 0)";
                        problem.help = Some(help.to_string());
                    }
                    return Err(problem);
                }
                _ => break,
            }
        }
        let close = self.close(open)?;
        self.nesting -= 1;
        let span = name.span().to(close.span());
        let (least, most) = function.argument_count();
        if !(least..=most).contains(&arguments.len()) {
            let count = match most {
                _ if least == most => least.to_string(),
                _ => format!("{least} to {most}"),
            };
            let message = format!(
                "{} takes {count} argument{}, found {}",
                function.name(),
                if most == 1 { "" } else { "s" },
                arguments.len()
            );
            let mut problem = self.problem(Code::ArgumentCount, span, message);
            problem.help = Some(format!(
                "write {}({})",
                function.name(),
                function.arguments()
            ));
            return Err(problem);
        }
        self.check_width(function, &arguments, span)?;
        if deepest >= DEEPEST {
            let message = format!("an expression of more than {DEEPEST} operations in a row");
            return Err(self.too_deep(span, message));
        }
        let root = Expr::Call {
            function,
            arguments,
            span,
        };
        Ok(Tree {
            root,
            depth: deepest + 1,
            vector: function.gives_vector(),
        })
    }

    /// A transition or the onset of a damping takes place over a width, where numbers give it.
    fn check_width(
        &self,
        function: Function,
        arguments: &[Expr],
        span: Span,
    ) -> Result<(), Problem> {
        let width = match (function, arguments) {
            (
                Function::Step | Function::Step5 | Function::Havsin,
                [_, Expr::Number(from), _, Expr::Number(to), _],
            ) => (to - from).abs(),
            (Function::Impact | Function::Bistop | Function::Sweep, [.., Expr::Number(depth)])
                if !(*depth > 0.0) =>
            {
                *depth
            }
            (Function::Sweep, [_, _, Expr::Number(from), _, Expr::Number(to), ..]) => to - from,
            _ => return Ok(()),
        };
        if width > 0.0 {
            return Ok(());
        }
        let name = function.name();
        let (message, help) = match function {
            Function::Sweep => (
                "SWEEP needs x1 above x0 and dx above 0".to_string(),
                "its frequency rises from x0 to x1, and it fades in from x0 to x0 + dx",
            ),
            Function::Impact | Function::Bistop => (
                format!("the last argument of {name} must be greater than 0"),
                "it is the depth at which the damping is complete",
            ),
            _ => (
                format!("{name} begins and ends at the same value"),
                "give its second and fourth argument a distance, or write a jump with IF",
            ),
        };
        let mut problem = self.problem(Code::OutOfRange, span, message);
        problem.help = Some(help.to_string());
        Err(problem)
    }

    fn check_argument(
        &self,
        function: Function,
        position: usize,
        argument: &Tree,
        span: Span,
    ) -> Result<(), Problem> {
        let expected = match (function.argument_kind(position), argument.root.as_id()) {
            (ArgumentKind::Real, _) if !argument.vector => return Ok(()),
            (ArgumentKind::Vector, _) if argument.vector => return Ok(()),
            (ArgumentKind::Real, _) => "a number, not a vector",
            (ArgumentKind::Vector, _) => "a vector",
            (ArgumentKind::Integer, Some(_))
            | (ArgumentKind::Order, Some(..=2))
            | (ArgumentKind::Coordinate, Some(1..=3)) => return Ok(()),
            (ArgumentKind::MarkerOrGround, Some(_)) => return Ok(()),
            (ArgumentKind::Marker | ArgumentKind::Element(_), Some(1..)) => return Ok(()),
            (ArgumentKind::Integer, None) => "a whole number",
            (ArgumentKind::Order, _) => "the order of a derivative, 0, 1 or 2",
            (ArgumentKind::Coordinate, _) => "a coordinate, 1, 2 or 3 for x, y or z",
            (ArgumentKind::Marker, _) => "the number of a marker",
            (ArgumentKind::MarkerOrGround, None) => "the number of a marker, or 0 for the ground",
            (ArgumentKind::Element(_), _) => "the number of an element",
        };
        let message = format!(
            "argument {} of {} is {expected}, found `{}`",
            position + 1,
            function.name(),
            self.source.excerpt(span)
        );
        Err(self.problem(Code::InvalidValue, span, message))
    }
}

/// Whether a name stands for a value without arguments.
fn is_constant(name: &str) -> bool {
    CONSTANTS
        .iter()
        .any(|constant| name.eq_ignore_ascii_case(constant))
}
