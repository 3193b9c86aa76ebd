//! Diagnostics with the text that they mark.

use dataset::{Code, Dataset, Diagnostic, Severity, Source, read_dataset};

/// A diagnostic with the text that it marks.
#[derive(Debug, PartialEq)]
pub(crate) struct Marked {
    pub(crate) code: Code,
    pub(crate) severity: Severity,
    /// The text under the caret.
    pub(crate) text: String,
    pub(crate) message: String,
}

/// A diagnostic about `source`.
pub(crate) fn marked(diagnostic: &Diagnostic, source: &Source) -> Marked {
    let span = diagnostic.span;
    Marked {
        code: diagnostic.code,
        severity: diagnostic.severity,
        text: source.text()[span.start..span.end].to_string(),
        message: diagnostic.message.clone(),
    }
}

/// The dataset of a text in which nothing is wrong.
pub(crate) fn model(text: &str) -> Dataset {
    let source = Source::from_text("test.adm", text.to_string());
    let (dataset, diagnostics) = read_dataset(&source);
    let rendered = diagnostics.iter().map(|found| found.render(&source));
    assert_eq!(rendered.collect::<String>(), "");
    dataset
}

/// The `Debug` text of a model or a command file without what a layout may change: places, and
/// blanks in the texts of expressions, and the texts of commands.
pub(crate) fn without_places(debug: &str) -> String {
    let mut out = String::with_capacity(debug.len());
    let mut rest = debug;
    let marks = ["Span { start: ", "echo: \"", " text: \""];
    while let Some((at, mark)) = marks
        .iter()
        .filter_map(|mark| rest.find(mark).map(|at| (at, *mark)))
        .min()
    {
        out.push_str(&rest[..at + mark.len()]);
        rest = &rest[at + mark.len()..];
        if mark.starts_with("Span") {
            let end = rest.find('}').expect("a span ends");
            rest = &rest[end..];
        } else {
            let ends = ["\", ", "\" }"].map(|end| rest.find(end));
            let end = ends.into_iter().flatten().min().expect("a text ends");
            // The echo of a command is its text, which may have other commas as well.
            if mark.starts_with(" text") {
                out.extend(rest[..end].chars().filter(|character| *character != ' '));
            }
            rest = &rest[end..];
        }
    }
    out.push_str(rest);
    out
}
