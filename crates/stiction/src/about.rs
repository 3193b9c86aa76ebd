//! Messages about elements of the mechanical model, at the statements that they come from.

use dataset::{Code, Dataset, Diagnostic, Severity, Source, Span};
use mechanics::model::Label;

/// A message about an element, or about the model as a whole at its first line.
pub(crate) fn about(
    dataset: &Dataset,
    source: &Source,
    severity: Severity,
    code: Code,
    element: Option<&Label>,
    text: String,
) -> Diagnostic {
    let header = element.and_then(|element| dataset.header(element.statement, element.id));
    let span = header.map_or_else(Span::default, |header| header.span);
    Diagnostic::new(severity, code, source.name(), span, text)
}
