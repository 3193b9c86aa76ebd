//! From text to a [`Document`].

use super::{Body, Document, Number, Statement, Value};
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::keywords::{self, Kind};
use crate::parts::{Part, Parts, errors_of_the_text};
use crate::reader::view_name;
use crate::source::{Source, Span};
use crate::syntax::{Item, Language, StatementTokens, SyntaxTree, Token, TokenKind, items};
use std::collections::HashMap;

/// The document of a text, and the errors that leave open what the text says.
pub(crate) fn read(source: &Source, language: Language) -> (Document, Vec<Diagnostic>) {
    let tree = SyntaxTree::new(source, language);
    let mut reader = Reader {
        source,
        tree: &tree,
        language,
        diagnostics: Diagnostics::new(source),
        document: Document::default(),
        comments: Vec::new(),
    };
    let mut buffer = Vec::new();
    let mut at = 0;
    let mut end = tree.end;
    for statement in &tree.statements {
        reader.between(at, statement.tokens.start);
        at = statement.tokens.end;
        let stops = reader.statement(statement, &mut buffer);
        if stops && language == Language::Commands {
            end = Some(at - 1);
            break;
        }
    }
    let last = end.unwrap_or(tree.tokens.len());
    if last >= at {
        reader.between(at, last);
    }
    let comments = reader.take_comments(None);
    let (mut document, diagnostics) = (reader.document, reader.diagnostics);
    document.comments = comments;
    if let Some(end) = end {
        let rest = Span::new(tree.tokens[end].span().end, source.text().len());
        document.rest = source.slice(rest).trim_ascii().to_string();
    }
    (document, errors_of_the_text(diagnostics))
}

struct Reader<'a> {
    source: &'a Source,
    tree: &'a SyntaxTree,
    language: Language,
    diagnostics: Diagnostics<'a>,
    document: Document,
    /// The comments since the statement before, as positions of tokens.
    comments: Vec<usize>,
}

impl Reader<'_> {
    fn slice(&self, token: &Token) -> &str {
        self.source.slice(token.span())
    }

    /// Takes what stands between statements. A comment on the line of a statement belongs to it.
    fn between(&mut self, from: usize, to: usize) {
        let mut same_line = true;
        for (index, token) in (from..).zip(&self.tree.tokens[from..to]) {
            match token.kind {
                TokenKind::Line => {
                    let line = self.slice(token).to_string();
                    if !self.document.title.is_empty() {
                        self.document.title.push('\n');
                    }
                    self.document.title.push_str(line.trim_ascii_end());
                }
                TokenKind::Newline => same_line = false,
                TokenKind::Comment => {
                    let text = self.slice(token);
                    let names = text.contains("adams_view_name");
                    let before = self.document.statements.last().is_some();
                    if same_line && before && !names {
                        let text = comment(text);
                        let last = self.document.statements.last_mut();
                        if let (Some(last), Some(text)) = (last, text) {
                            last.comments.push(text);
                        }
                    } else {
                        self.comments.push(index);
                    }
                }
                _ => {}
            }
        }
    }

    /// The comments so far, but for the one at `name`.
    fn take_comments(&mut self, name: Option<usize>) -> Vec<String> {
        let comments = std::mem::take(&mut self.comments);
        let others = comments.into_iter().filter(|index| Some(*index) != name);
        others
            .filter_map(|index| comment(self.slice(&self.tree.tokens[index])))
            .collect()
    }

    /// Takes one statement; whether it is STOP.
    fn statement(&mut self, statement: &StatementTokens, buffer: &mut Vec<Item>) -> bool {
        items(&self.tree.tokens, statement, buffer);
        let Some(parts) = Parts::new(buffer, self.language, &mut self.diagnostics) else {
            return false;
        };
        let written = self.source.slice(parts.head.name);
        let name = match parts.grammar {
            Some(grammar) => grammar.name.to_string(),
            None => written.to_ascii_uppercase(),
        };
        let known = parts.grammar.and_then(|grammar| grammar.identified);
        let identified = known.unwrap_or(parts.head.number.is_some());
        let id = parts.head.id(&name, identified, &mut self.diagnostics);
        let view_name = match self.language {
            Language::Dataset => view_name(&self.tree.tokens, statement, self.source),
            _ => None,
        };
        let named_by = statement.name_comment.filter(|_| view_name.is_some());
        let mut comments = self.take_comments(named_by);
        let body = parts
            .arguments
            .and_then(|parts| self.arguments(&parts, buffer));
        let body = match body {
            Some(arguments) => {
                // Comments of a text are in the text.
                comments.extend(self.comments_inside(statement));
                Body::Arguments(arguments)
            }
            None => Body::Text(self.text(statement, parts.head.head)),
        };
        let stops = name == "STOP";
        self.document.statements.push(Statement {
            name,
            id: identified.then_some(id),
            view_name,
            comments,
            body,
        });
        stops
    }

    /// The comments in a statement. One that names the next statement is left for that.
    fn comments_inside(&mut self, statement: &StatementTokens) -> Vec<String> {
        let mut comments = Vec::new();
        for index in statement.tokens.clone() {
            let token = self.tree.tokens[index];
            if token.kind == TokenKind::Comment {
                if self.slice(&token).contains("adams_view_name") {
                    self.comments.push(index);
                } else {
                    comments.extend(comment(self.slice(&token)));
                }
            }
        }
        comments
    }

    fn arguments(&self, parts: &[Part], items: &[Item]) -> Option<Vec<(String, Value)>> {
        let mut arguments: Vec<(String, Value)> = Vec::with_capacity(parts.len());
        let mut places = HashMap::new();
        for part in parts {
            let value = self.value(part, items)?;
            let place = *places.entry(part.name.clone()).or_insert(arguments.len());
            match (arguments.get_mut(place), value) {
                (None, value) => arguments.push((part.name.to_string(), value)),
                (Some((_, Value::Rows(rows))), Value::Rows(more)) => rows.extend(more),
                (Some(_), _) => return None,
            }
        }
        Some(arguments)
    }

    fn value(&self, part: &Part, items: &[Item]) -> Option<Value> {
        let Some(value) = &part.value else {
            let text = part.text(self.source, items);
            return Some(text.map_or(Value::Flag, Value::Raw));
        };
        Some(match value {
            keywords::Value::Flag => Value::Flag,
            keywords::Value::Reals(values) => {
                let numbers = values.iter();
                let numbers = numbers.map(|(_, span)| Number::of_text(self.source.slice(*span)));
                let mut numbers = numbers.collect::<Option<Vec<_>>>()?;
                match part.kind {
                    Some(Kind::Real) => Value::Number(numbers.pop()?),
                    Some(Kind::RealsEach) => Value::Rows(vec![numbers]),
                    _ => Value::Numbers(numbers),
                }
            }
            keywords::Value::Integers(values) => match part.kind {
                Some(Kind::Integer | Kind::Id) => Value::Integer(values.first()?.0),
                _ => Value::Integers(values.iter().map(|(value, _)| *value).collect()),
            },
            keywords::Value::Words(spans) => {
                let word = |span: &Span| self.source.slice(*span).to_string();
                match part.kind {
                    Some(Kind::Word) => Value::Word(spans.first().map(word)?),
                    Some(Kind::IdsOrAll) => Value::Word("ALL".to_string()),
                    _ => Value::Words(spans.iter().map(word).collect()),
                }
            }
            keywords::Value::Text(text) => Value::Text(text.clone()),
            keywords::Value::Strings(texts) => Value::Strings(texts.clone()),
            keywords::Value::Expression(expression) => {
                Value::Expression(with_plain_blanks(&expression.text))
            }
        })
    }

    /// The text behind the head of a statement, its lines trimmed.
    fn text(&self, statement: &StatementTokens, head: Span) -> String {
        let span = Span::new(head.end, self.tree.span(statement).end);
        text_of_lines(self.source.slice(span))
    }
}

/// The text of a comment; `None` where it is empty.
fn comment(text: &str) -> Option<String> {
    let text = text.strip_prefix('!').unwrap_or(text).trim_ascii_end();
    (!text.is_empty()).then(|| text.to_string())
}

/// An expression with a blank behind each comma and no other, wherever its lines are broken.
fn with_plain_blanks(expression: &str) -> String {
    let marks = expression.chars().filter(|mark| !mark.is_whitespace());
    let solid: String = marks.collect();
    solid.replace(',', ", ")
}

/// A text without empty lines and without blanks at the ends of the others.
pub(crate) fn text_of_lines(text: &str) -> String {
    let lines = text.lines().map(str::trim_ascii);
    let lines: Vec<&str> = lines.filter(|line| !line.is_empty()).collect();
    lines.join("\n")
}
