//! Texts made to hurt: whatever the size and the nesting, the answer is a message, in linear time
//! and on a small stack.

use dataset::{
    Diagnostic, Language, Source, format, from_json, parse_change, read_commands, read_dataset,
    to_json,
};
use std::fmt::Write;

/// The repetitions of what is repeated, which the environment variable `STICTION_HOSTILE` sets: with
/// a million an algorithm of quadratic time would not end.
fn many() -> usize {
    let wanted = std::env::var("STICTION_HOSTILE").ok();
    wanted.and_then(|text| text.parse().ok()).unwrap_or(100_000)
}

/// Half the stack that a thread has.
const STACK: usize = 1 << 20;

fn check(source: &Source, diagnostics: &[Diagnostic]) -> usize {
    assert!(diagnostics.len() <= 10_001, "{}", diagnostics.len());
    for diagnostic in diagnostics {
        let span = diagnostic.span;
        assert!(source.text().get(span.start..span.end).is_some());
        assert!(diagnostic.render(source).len() < 4000);
    }
    diagnostics.len()
}

/// Everything that reads a text; the number of messages.
fn read_every_way(name: &str, bytes: &[u8]) -> usize {
    let begin = std::time::Instant::now();
    let source = match Source::from_bytes(name, bytes) {
        Ok(source) => source,
        Err(refused) => {
            let unread = Source::from_text(name, String::new());
            return check(&unread, &[*refused]);
        }
    };
    let mut count = check(&source, &read_dataset(&source).1);
    count += check(&source, &read_commands(&source).1);
    count += check(&source, &parse_change(&source).1);
    for language in [Language::Dataset, Language::Commands] {
        if let Err(errors) = format(&source, language) {
            count += check(&source, &errors);
        }
    }
    if let Err(errors) = to_json(&source) {
        count += check(&source, &errors);
    }
    if let Err(errors) = from_json(&source) {
        count += check(&source, &errors);
    }
    let seconds = begin.elapsed().as_secs_f64();
    println!(
        "{name}: {} bytes, {count} messages, {seconds:.1} s",
        bytes.len()
    );
    count
}

/// Reads the texts on a thread with a small stack; every one of them has something wrong.
fn survive(texts: Vec<(&'static str, Vec<u8>)>) {
    let thread = std::thread::Builder::new().stack_size(STACK);
    let work = move || {
        for (name, bytes) in texts {
            assert!(read_every_way(name, &bytes) > 0, "{name}");
        }
    };
    let thread = thread.spawn(work).expect("a thread");
    thread.join().expect("no panic");
}

fn repeated(before: &str, piece: &str, after: &str) -> Vec<u8> {
    format!("title\n{before}{}{after}\n", piece.repeat(many())).into_bytes()
}

#[test]
fn nesting() {
    let variable = "VARIABLE/1, FUNCTION = ";
    let variables = (1..100_000).fold(String::from("title\n"), |mut text, id| {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "VARIABLE/{id}, FUNCTION = VARVAL({})", id + 1);
        text
    });
    survive(vec![
        ("brackets", repeated(variable, "(", "")),
        (
            "closed brackets",
            repeated(variable, "(1", &")".repeat(many())),
        ),
        ("signs", repeated(variable, "-", "1")),
        ("powers", repeated(variable, "2**", "1")),
        ("terms", repeated(variable, "1+", "1")),
        ("calls", repeated(variable, "IF(1:", "")),
        ("wrong arguments", repeated("PART/1, (", "(A,", "")),
        ("a chain of variables", variables.into_bytes()),
        ("JSON lists", b"[".repeat(many())),
        ("JSON objects", b"{\"statements\":".repeat(many())),
    ]);
}

#[test]
fn repetition() {
    let statements = (1..=many()).fold(String::from("title\n"), |mut text, id| {
        let _ = writeln!(text, "PART/{id}");
        text
    });
    survive(vec![
        ("statements", statements.into_bytes()),
        ("the same statement", repeated("", "PART/1\n", "")),
        ("unknown statements", repeated("", "PRAT/1\n", "")),
        ("unknown arguments", repeated("PART/1", ", GRUND", "")),
        ("the same argument", repeated("OUTPUT/", ", REQSAVE", "")),
        (
            "arguments without effect",
            repeated("OUTPUT/", ", GRSAVE", ", X"),
        ),
        ("numbers", repeated("PART/1, QG = 1", ", 1", "")),
        ("identifiers", repeated("COUPLER/1, JOINTS = 1", ", 1", "")),
        ("names", repeated("PART/1, EXACT = X", ":X", "")),
        ("texts", repeated("REQUEST/1, CNAMES = \"\"", ", \"\"", "")),
        ("a text", repeated("REQUEST/1, COMMENT = a", " a", "")),
        ("graphics", repeated("GRAPHICS/1", ", A = 1", "")),
    ]);
}

#[test]
fn marks() {
    survive(vec![
        ("semicolons", repeated("PART", ";", "")),
        ("commas", repeated("PART/1", ",", "")),
        ("lines of commas", repeated("PART/1", "\n,", "")),
        ("lines that continue", repeated("PART/1", "&\n", "")),
        (
            "comments",
            repeated("PART/1\n", "! adams_view_name='a'\n", ""),
        ),
        ("a comment", repeated("PART/1 ", "!", "")),
        ("quotes", repeated("PART/1, ", "\"", "")),
        ("backslashes", repeated("PART/1, ", "\\", "")),
        ("empty lines", repeated("PART/1", "\r\n", "PART")),
        ("a stray number", repeated("GRAPHICS/1, ", "1 ", "")),
    ]);
}

#[test]
fn bytes() {
    let latin1 = b"t\xB7\r\nPART/1, MASS = \xE9\r\n".repeat(1000);
    survive(vec![
        ("digits", repeated("PART/1, MASS = 1", "0", "")),
        ("small digits", repeated("PART/1, MASS = 0.", "0", "1D, X")),
        ("an identifier", repeated("PART/", "9", "")),
        ("a name", repeated("", "A", "/1")),
        ("an argument", repeated("PART/1, ", "A", "")),
        ("one line", repeated("", "MARKER/1, PART = 2; ", "")),
        ("Latin-1", latin1),
        (
            "some NULs",
            repeated("PART/1, ", "aaaaaaaaaaaaaaaaaaaaaaaaa\0", ""),
        ),
        ("NULs", b"\0".repeat(many())),
        ("no UTF-8", b"\xFF".repeat(many())),
        (
            "JSON digits",
            [
                b"{\"version\": 1".to_vec(),
                b"0".repeat(many()),
                b"}".to_vec(),
            ]
            .concat(),
        ),
        ("nothing", Vec::new()),
    ]);
}
