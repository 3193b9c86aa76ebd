//! Where two documents differ that should be the same.

use super::Document;
use crate::diagnostic::{Code, Diagnostic, Severity};
use crate::source::{Source, Span};

/// The error for a text that would not say what the document of `source` says, so that nothing is
/// written. That is a defect, or the text is such that no other says the same.
pub(crate) fn difference(source: &Source, before: &Document, after: &Document) -> Diagnostic {
    let pairs = before.statements.iter().zip(&after.statements);
    let place = pairs.take_while(|(before, after)| before == after).count();
    let label = match before.statements.get(place) {
        Some(statement) => match statement.id {
            Some(id) => format!("{}/{id}", statement.name),
            None => statement.name.clone(),
        },
        None => "the end".to_string(),
    };
    let message = format!("what would be written says something else at {label}");
    let mut error = Diagnostic::new(
        Severity::Error,
        Code::Syntax,
        source.name(),
        Span::default(),
        message,
    );
    for (what, document) in [("is", before), ("would be", after)] {
        if let Some(statement) = document.statements.get(place) {
            let text: String = format!("{statement:?}").chars().take(1000).collect();
            error.note(format!("it {what} {text}"));
        }
    }
    error.help("nothing is written; write the statement in another way");
    error
}
