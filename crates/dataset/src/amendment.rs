//! Statements as commands that give other arguments to an element: `BUSHING/3, K=10, 10, 10`.
//!
//! The statement is read again with the arguments of the command in the places of its own, so that
//! whatever a statement may say a command may say, too, except what [`FIXED`] keeps.

use crate::arguments;
use crate::change::{change, fixed, something};
use crate::checks;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Severity};
use crate::keywords::{Keyword, Kind, keyword};
use crate::model::{
    AmendedArgument, Amendment, Change, ChangeKind, CommandKind, Dataset, Element, Elements,
};
use crate::reader::{RawHead, read_statement};
use crate::reading::Reading;
use crate::source::{Source, Span};
use crate::statements::{Action, Builder, STATEMENTS};
use crate::syntax::{Item, Language, SyntaxTree, items, join};

/// The statements that commands can amend, and the arguments that stay as they are: what the element
/// connects, and what it starts from. Of the others commands only print the statement.
const FIXED: &[(&str, &[&str])] = &[
    ("BEAM", &["I", "J"]),
    ("BUSHING", &["I", "J"]),
    ("COUPLER", &["JOINTS", "TYPE"]),
    ("DIFF", &["IC", "IMPLICIT"]),
    ("FIELD", &["I", "J"]),
    ("GCON", &["I"]),
    ("GFORCE", &["I", "JFLOAT", "RM"]),
    (
        "MOTION",
        &[
            "JOINT",
            "I",
            "J",
            "ROTATIONAL",
            "TRANSLATIONAL",
            "X",
            "Y",
            "Z",
            "B1",
            "B2",
            "B3",
        ],
    ),
    (
        "PART",
        &[
            "GROUND", "CM", "IM", "QG", "REULER", "XG", "ZG", "VX", "VY", "VZ", "WX", "WY", "WZ",
            "VM", "WM", "EXACT",
        ],
    ),
    (
        "POINT_MASS",
        &["CM", "QG", "REULER", "XG", "ZG", "VX", "VY", "VZ", "EXACT"],
    ),
    ("SENSOR", &[]),
    ("SFORCE", &["TRANSLATIONAL", "ROTATIONAL", "ACTIONONLY"]),
    ("SPLINE", &["FILE"]),
    ("SPRINGDAMPER", &["I", "J", "TRANSLATIONAL", "ROTATIONAL"]),
    ("VARIABLE", &[]),
    ("VFORCE", &["I", "JFLOAT", "RM"]),
    ("VTORQUE", &["I", "JFLOAT", "RM"]),
];

/// Arguments that a new one takes the place of.
const REPLACED: &[(&str, &[&str])] = &[
    (
        "DISPLACEMENT",
        &["VELOCITY", "ACCELERATION", "ICDISP", "ICVEL"],
    ),
    ("VELOCITY", &["DISPLACEMENT", "ACCELERATION", "ICVEL"]),
    ("ACCELERATION", &["DISPLACEMENT", "VELOCITY"]),
    ("FXYZ", &["FX", "FY", "FZ"]),
    ("TXYZ", &["TX", "TY", "TZ"]),
    ("FX", &["FXYZ"]),
    ("FY", &["FXYZ"]),
    ("FZ", &["FXYZ"]),
    ("TX", &["TXYZ"]),
    ("TY", &["TXYZ"]),
    ("TZ", &["TXYZ"]),
    ("CRATIO", &["CMATRIX"]),
    ("CMATRIX", &["CRATIO"]),
    ("EQ", &["GE", "LE"]),
    ("GE", &["EQ", "LE"]),
    ("LE", &["EQ", "GE"]),
];

/// Whether a new argument takes the place of another one.
pub(crate) fn displaces(new: &str, old: &str) -> bool {
    let mut rules = REPLACED.iter();
    rules.any(|(keyword, others)| *keyword == new && others.contains(&old))
}

/// Prints the statement as it is now.
const LIST: &str = "LIST";

/// The arguments of a statement as a command.
pub(crate) fn with_list(keywords: &[Keyword]) -> Vec<Keyword> {
    let mut all = keywords.to_vec();
    all.push(keyword(LIST, Kind::Flag));
    all
}

/// A statement as a command.
pub(crate) fn amend(reading: &mut Reading, keywords: &[Keyword]) -> Option<CommandKind> {
    let name = reading.name;
    match FIXED.iter().find(|(statement, _)| *statement == name) {
        Some((_, kept)) => fixed(reading, kept),
        None => {
            let all: Vec<_> = keywords.iter().map(|keyword| keyword.name.full).collect();
            let all: Vec<_> = all.into_iter().filter(|name| *name != LIST).collect();
            fixed(reading, &all);
        }
    }
    something(reading);
    let source = reading.diagnostics.source;
    let arguments = reading.arguments().iter();
    let arguments = arguments
        .filter(|argument| argument.keyword != LIST)
        .map(|argument| {
            let items = &reading.items[argument.items.clone()];
            AmendedArgument {
                keyword: argument.keyword,
                text: text(source, items, argument.keyword, keywords),
                span: argument.span.to(span_of(items).unwrap_or(argument.span)),
            }
        });
    let amendment = Amendment {
        statement: name,
        id: reading.id,
        arguments: arguments.collect(),
        list: reading.has(LIST),
    };
    Some(change(reading, ChangeKind::Amendment(amendment)))
}

/// From the first item to the last.
fn span_of(items: &[Item]) -> Option<Span> {
    let (first, last) = (items.first()?, items.last()?);
    Some(first.span().to(last.span()))
}

/// An argument on one line; an expression with the mark of its end.
pub(crate) fn text(source: &Source, items: &[Item], keyword: &str, keywords: &[Keyword]) -> String {
    let is_expression = keywords
        .iter()
        .any(|rule| rule.name.full == keyword && matches!(rule.kind, Kind::Expression));
    if !is_expression {
        return join(source, items);
    }
    // The comma that continues an expression is no part of it.
    let kept = items.iter().filter(|item| !item.continues);
    let kept: Vec<Item> = kept.copied().collect();
    join(source, &kept).trim_end_matches('\\').to_owned() + "\\"
}

/// The arguments of a statement that is read on its own.
fn arguments_of(text: &str, keywords: &[Keyword]) -> Vec<(&'static str, String)> {
    let source = Source::from_text("", text.to_owned());
    let tree = SyntaxTree::new(&source, Language::Statements);
    let mut diagnostics = Diagnostics::new(&source);
    let mut buffer = Vec::new();
    let Some(statement) = tree.statements.first() else {
        return Vec::new();
    };
    items(&tree.tokens, statement, &mut buffer);
    let Some(raw) = RawHead::read(&buffer, &mut diagnostics) else {
        return Vec::new();
    };
    let rest = &buffer[raw.rest..];
    let read = arguments::read(rest, "", keywords, &mut diagnostics);
    let each = read.iter().map(|argument| {
        let items = &rest[argument.items.clone()];
        let text = self::text(&source, items, argument.keyword, keywords);
        (argument.keyword, text)
    });
    each.collect()
}

impl Dataset {
    /// Gives an element other arguments if nothing is wrong with them; `None` if it does not exist.
    pub(crate) fn amend(
        &mut self,
        amendment: &Amendment,
        change: &Change,
        diagnostics: &mut Diagnostics,
    ) -> Option<()> {
        let (name, id) = (amendment.statement, amendment.id);
        let rule = STATEMENTS.iter().find(|rule| rule.name.full == name)?;
        let Action::Read(Some(keywords), _) = rule.action else {
            return None;
        };
        let before = self.text_of(name, id)?;
        if amendment.arguments.is_empty() {
            return Some(());
        }
        let given = |keyword: &str| amendment.arguments.iter().any(|a| a.keyword == keyword);
        let replaced = |keyword: &str| {
            let mut news = amendment.arguments.iter();
            given(keyword) || news.any(|new| displaces(new.keyword, keyword))
        };
        let mut text = format!("{name}/{id}");
        let kept = arguments_of(&before, keywords);
        let kept = kept.iter().filter(|(keyword, _)| !replaced(keyword));
        for (_, argument) in kept {
            text += &format!("\n, {argument}");
        }
        // Where each new argument ends in the text.
        let mut ends = Vec::with_capacity(amendment.arguments.len());
        let own = text.len();
        for argument in &amendment.arguments {
            text += &format!("\n, {}", argument.text);
            ends.push(text.len());
        }
        // What is wrong with the text stands at the argument of the command that it is about.
        let place = |span: Span| {
            let argument = ends.partition_point(|end| *end <= span.start);
            let argument = amendment.arguments.get(argument);
            argument
                .filter(|_| span.start >= own)
                .map_or(change.span, |argument| argument.span)
        };
        let mut builder = Builder::default();
        let wrong = read(&text, &change.source, &mut builder);
        if let Some(found) = wrong.into_iter().next() {
            let error = diagnostics.error(found.code, place(found.span), found.message);
            error.help = found.help;
            return Some(());
        }
        let missing = builder
            .references
            .iter()
            .find(|reference| !checks::references::exists(self, reference.target, reference.id));
        if let Some(reference) = missing {
            let (name, id) = (reference.target.statement(), reference.id);
            let message = format!("there is no {name}/{id}");
            diagnostics.error(Code::MissingElement, place(reference.span), message);
            return Some(());
        }
        self.exchange(name, id, &mut builder.dataset)?;
        let source = Source::from_text(&change.source, String::new());
        let mut checked = Diagnostics::new(&source);
        checks::elements(self, &mut checked);
        let wrong = checked.finish().into_iter();
        if let Some(found) = wrong.into_iter().find(|d| d.severity == Severity::Error) {
            let error = diagnostics.error(found.code, place(found.span), found.message);
            error.help = found.help;
            return self.exchange(name, id, &mut builder.dataset);
        }
        self.texts.amend(name, id, text);
        Some(())
    }

    /// The text of the statement of an element, as commands have changed it last; `None` where there
    /// is no such element.
    #[must_use]
    pub fn text_of(&self, statement: &'static str, id: u32) -> Option<String> {
        let header = self.header(statement, id)?;
        self.texts.of(statement, id, header.span)
    }

    /// Exchanges an element with that of another dataset; the place and name of the first stay.
    fn exchange(&mut self, statement: &str, id: u32, other: &mut Self) -> Option<()> {
        match statement {
            "BEAM" => exchange(&mut self.beams, &mut other.beams, id),
            "BUSHING" => exchange(&mut self.bushings, &mut other.bushings, id),
            "COUPLER" => exchange(&mut self.couplers, &mut other.couplers, id),
            "DIFF" => exchange(&mut self.differentials, &mut other.differentials, id),
            "FIELD" => exchange(&mut self.fields, &mut other.fields, id),
            "GFORCE" => exchange(&mut self.general_forces, &mut other.general_forces, id),
            "SFORCE" => exchange(&mut self.single_forces, &mut other.single_forces, id),
            "VARIABLE" => exchange(&mut self.variables, &mut other.variables, id),
            "VFORCE" => exchange(&mut self.vector_forces, &mut other.vector_forces, id),
            "VTORQUE" => exchange(&mut self.vector_torques, &mut other.vector_torques, id),
            "GCON" => exchange(&mut self.constraints, &mut other.constraints, id),
            "MOTION" => exchange(&mut self.motions, &mut other.motions, id),
            "PART" => exchange(&mut self.parts, &mut other.parts, id),
            "POINT_MASS" => exchange(&mut self.point_masses, &mut other.point_masses, id),
            "SENSOR" => exchange(&mut self.sensors, &mut other.sensors, id),
            "SPLINE" => exchange(&mut self.splines, &mut other.splines, id),
            "SPRINGDAMPER" => exchange(&mut self.spring_dampers, &mut other.spring_dampers, id),
            _ => None,
        }
    }
}

fn exchange<T: Element>(list: &mut Elements<T>, other: &mut Elements<T>, id: u32) -> Option<()> {
    let (ours, theirs) = (list.by_id_mut(id)?, other.by_id_mut(id)?);
    std::mem::swap(ours, theirs);
    std::mem::swap(ours.header_mut(), theirs.header_mut());
    Some(())
}

/// Reads one statement into `builder`; returns what is wrong with it.
fn read(text: &str, source: &str, builder: &mut Builder) -> Vec<Diagnostic> {
    let source = Source::from_text(source, text.to_owned());
    let tree = SyntaxTree::new(&source, Language::Statements);
    let mut diagnostics = Diagnostics::new(&source);
    let mut buffer = Vec::new();
    for statement in &tree.statements {
        items(&tree.tokens, statement, &mut buffer);
        read_statement(&tree.tokens, statement, &buffer, builder, &mut diagnostics);
    }
    let mut found = diagnostics.finish();
    found.retain(|diagnostic| diagnostic.severity == Severity::Error);
    found
}
