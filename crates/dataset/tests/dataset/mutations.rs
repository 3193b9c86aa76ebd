//! Damaged files: whatever the text, the reader neither panics nor loses a byte.
//!
//! The environment variable `STICTION_FUZZ_MUTATIONS` sets the number of damaged texts.

use dataset::{
    Diagnostic, Language, Source, SyntaxTree, edit, format, from_json, parse_change, read_commands,
    read_dataset, to_json,
};

/// Every reader, every diagnostic rendered, every token put back.
fn read_every_way(bytes: &[u8]) -> usize {
    let Ok(source) = Source::from_bytes("damaged", bytes) else {
        return 0;
    };
    for language in [Language::Dataset, Language::Commands, Language::Statements] {
        assert_round_trip(&source, language);
    }
    let (dataset, diagnostics) = read_dataset(&source);
    let mut count = check(&source, &diagnostics);
    let (file, diagnostics) = read_commands(&source);
    count += check(&source, &diagnostics);
    let mut changed = dataset;
    for command in file.commands {
        if let dataset::CommandKind::Change(change) = command.kind {
            count += check(&source, &changed.apply(&change));
        }
    }
    let (_, diagnostics) = parse_change(&source);
    count += check(&source, &diagnostics);
    for language in [Language::Dataset, Language::Commands] {
        count += lay_out(&source, language);
    }
    // Dear, so of some texts alone.
    if bytes.len().is_multiple_of(16) {
        write_changes(&source);
    }
    match to_json(&source) {
        Ok(json) => {
            let json = Source::from_text("JSON", json);
            if let Err(errors) = from_json(&json) {
                panic!("{}", errors[0].render(&json));
            }
        }
        Err(errors) => count += check(&source, &errors),
    }
    if let Err(errors) = from_json(&source) {
        count += check(&source, &errors);
    }
    count
}

/// Changes are written into a damaged text, or it is said why not.
fn write_changes(source: &Source) {
    for change in [
        "FRICTION/1, MU_STATIC=0.25, INPUTS=PRELOAD",
        "SFORCE/1, FUNCTION=TIME",
        "MOTION/1, VELOCITY",
        "PART/2, MASS=3",
        "INTEGRATOR/ERROR=1E-5",
    ] {
        if let Err(errors) = edit(source, &[change.to_owned()]) {
            assert!(!errors.is_empty());
        }
    }
}

/// What can be laid out is stable; that it says the same is checked by [`format`] itself, which
/// would refuse with an error that the readers do not find.
fn lay_out(source: &Source, language: Language) -> usize {
    match format(source, language) {
        Ok(text) => {
            let text = Source::from_text("laid out", text);
            let again = format(&text, language);
            assert_eq!(again.as_deref(), Ok(text.text()), "of {:?}", source.text());
            0
        }
        Err(errors) => {
            let lost = errors
                .iter()
                .find(|error| error.message.starts_with("what would be"));
            assert!(lost.is_none(), "{lost:?} of {:?}", source.text());
            check(source, &errors)
        }
    }
}

fn check(source: &Source, diagnostics: &[Diagnostic]) -> usize {
    for diagnostic in diagnostics {
        let span = diagnostic.span;
        assert!(
            span.start <= span.end && span.end <= source.text().len(),
            "{diagnostic:?}"
        );
        assert!(
            source.text().get(span.start..span.end).is_some(),
            "{diagnostic:?}"
        );
        assert!(!diagnostic.render(source).is_empty());
    }
    diagnostics.len()
}

fn assert_round_trip(source: &Source, language: Language) {
    let tree = SyntaxTree::new(source, language);
    let mut end = 0;
    for token in &tree.tokens {
        let span = token.span();
        assert_eq!(span.start, end, "a gap or an overlap");
        assert!(span.end > span.start, "an empty token");
        end = span.end;
    }
    assert_eq!(end, source.text().len(), "text is lost at the end");
}

#[test]
fn tokens_give_every_file_back() {
    let folders = ["corpus", "adams-results"].map(reference_data::path);
    let mut count = 0;
    for path in folders
        .into_iter()
        .flatten()
        .flat_map(|folder| reference_data::models(&folder))
    {
        let bytes = std::fs::read(&path).expect("the file can be read");
        let source = Source::from_bytes("file", &bytes).expect("the file is text");
        let back: Vec<u8> = source
            .text()
            .chars()
            .map(|character| character as u8)
            .collect();
        assert!(
            bytes == back,
            "{} is not decoded faithfully",
            path.display()
        );
        assert_round_trip(&source, Language::Dataset);
        assert_round_trip(&source, Language::Commands);
        count += 1;
    }
    println!("{count} files");
}

#[test]
fn damaged_files_never_panic() {
    let count = damaged_texts::each("STICTION_FUZZ_MUTATIONS", 20_000, read_every_way);
    println!("{count} messages, none lost");
    assert!(count > 0, "damage without a message");
}
