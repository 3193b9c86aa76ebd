//! One layout for datasets and command files.

mod layout;
mod line;

use crate::diagnostic::Diagnostic;
use crate::document;
use crate::source::{Source, Span};
use crate::syntax::{Language, SyntaxTree, TokenKind};

/// Lays a dataset or command file out anew. Only blanks, line ends, marks of continuation and `;`
/// change; words, numbers, texts and comments stay as they are written.
///
/// * In a dataset the head of a statement and each of its arguments stand on a line of their own,
///   as Adams View writes them. A command stands on one line where 80 columns hold it.
/// * The lines within one value (the rows of a matrix, a long IF) stay as the author broke them.
///   A line of numbers, texts or an expression beyond 80 columns is broken behind a comma or an
///   operator, with the comma that continues it at the start of the next line.
/// * Comments and `adams_view_name` lines stay where they are, and so does the first line. Between
///   statements at most one blank line stays. What follows END or STOP is not touched.
/// * A statement whose arguments are not known keeps its lines.
/// * Line ends are those of the first line.
///
/// Laying out what is laid out changes nothing.
///
/// ```
/// use dataset::{Language, Source, format};
/// let text = "title\nPART/1,GROUND ! fixed\n\n\nMARKER/1, PART=1 ,QP=0,0,\n,1\nEND";
/// let source = Source::from_text("m.adm", text.to_string());
/// let expected = "title\nPART/1\n, GROUND ! fixed\n\nMARKER/1\n, PART = 1\n, QP = 0,0,\n, 1\nEND\n";
/// assert_eq!(format(&source, Language::Dataset).unwrap(), expected);
/// ```
///
/// # Errors
/// The errors that leave open what the text says: then there is no layout of it. What is only not
/// simulated, and what is wrong with the model as a whole, is no hindrance.
pub fn format(source: &Source, language: Language) -> Result<String, Vec<Diagnostic>> {
    let (before, errors) = document::read(source, language);
    if !errors.is_empty() {
        return Err(errors);
    }
    let tree = SyntaxTree::new(source, language);
    let written = Source::from_text(source.name(), layout::text(source, &tree, language));
    let (after, errors) = document::read(&written, language);
    let same = errors.is_empty() && before == after;
    if same && comments(source, language) == comments(&written, language) {
        return Ok(written.text().to_string());
    }
    Err(vec![document::difference(source, &before, &after)])
}

/// All comments of a text, without blanks at their ends.
fn comments(source: &Source, language: Language) -> Vec<String> {
    let tree = SyntaxTree::new(source, language);
    let comments = tree
        .tokens
        .iter()
        .filter(|token| token.kind == TokenKind::Comment);
    let text = |span: Span| source.slice(span).trim_ascii_end().to_string();
    comments.map(|token| text(token.span())).collect()
}
