//! What of a model in JSON no dataset can hold, found by writing it and reading it back.

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::document::{self, Body, Document, Statement};
use crate::source::{Source, Span};
use crate::syntax::Language;

/// Where a statement and its arguments stand.
pub(super) struct Places {
    pub(super) statement: Span,
    /// The way to it from the root.
    pub(super) path: String,
    pub(super) arguments: Vec<Span>,
}

/// The errors of a document whose text does not read back as the same: statement by statement,
/// argument by argument.
pub(super) fn unwritable(
    source: &Source,
    document: &Document,
    places: &[Places],
) -> Vec<Diagnostic> {
    let mut diagnostics = Diagnostics::new(source);
    for (statement, places) in document.statements.iter().zip(places) {
        if trouble(source, statement.clone()).is_none() {
            continue;
        }
        let mut found = false;
        if let Body::Arguments(arguments) = &statement.body {
            for (argument, span) in arguments.iter().zip(&places.arguments) {
                let alone = Statement {
                    body: Body::Arguments(vec![argument.clone()]),
                    name: statement.name.clone(),
                    id: statement.id,
                    view_name: None,
                    comments: Vec::new(),
                };
                if let Some(problem) = trouble(source, alone) {
                    found = true;
                    report(&mut diagnostics, *span, &places.path, &argument.0, problem);
                }
            }
        }
        if !found {
            report(
                &mut diagnostics,
                places.statement,
                &places.path,
                &statement.name,
                Trouble::Different,
            );
        }
    }
    let errors = diagnostics.finish();
    if !errors.is_empty() {
        return errors;
    }
    let mut diagnostics = Diagnostics::new(source);
    report(
        &mut diagnostics,
        Span::default(),
        "the model",
        "the model",
        Trouble::Different,
    );
    diagnostics.finish()
}

/// What is wrong with the text of a statement.
enum Trouble {
    /// It is an error of the language.
    Error(Box<Diagnostic>),
    /// It says something else.
    Different,
}

/// Writes a statement and reads it back.
fn trouble(source: &Source, statement: Statement) -> Option<Trouble> {
    let document = Document {
        statements: vec![statement],
        ..Document::default()
    };
    let written = Source::from_text(source.name(), document::write(&document));
    let (after, errors) = document::read(&written, Language::Dataset);
    match errors.into_iter().next() {
        Some(error) => Some(Trouble::Error(Box::new(error))),
        None => (after != document).then_some(Trouble::Different),
    }
}

fn report(diagnostics: &mut Diagnostics, span: Span, path: &str, name: &str, problem: Trouble) {
    match problem {
        Trouble::Error(problem) => {
            let error = diagnostics.error(problem.code, span, problem.message);
            error.help = problem.help;
            error.note(format!("this is {name} of {path}"));
        }
        Trouble::Different => {
            let message = format!("a dataset cannot hold {name} like this");
            diagnostics
                .error(Code::InvalidValue, span, message)
                .note(format!("this is in {path}"))
                .help(
                    "texts are on one line and without quotes; names are words; `!`, `;` and `&` \
                     stand in texts only",
                );
        }
    }
}
