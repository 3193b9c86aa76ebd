//! Every real dataset and command file of the corpus: read, checked, assembled and run.
//!
//! `--nocapture` prints a table: statements, what is refused and why, diagnostics by code, and how a
//! run of the file's own commands, or of 0.1 s where it has none, ended.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use dataset::{Code, Language, Severity, Source, SyntaxTree};
use stiction::{Message, Outcome, Progress, Project, RunOptions, Session, Watch};

use crate::shared::scratch_folder;

/// Names in the corpus that are no part of the language: file, start of the message, and why.
const NOT_IN_THE_LANGUAGE: [(&str, &str, &str); 10] = [
    ("pm02.adm", "no statement is called LEONARDO", MADE_UP),
    ("prova.adm", "no statement is called LEOSILVA", MADE_UP),
    ("prova.adm", "no statement is called PIRLA", MADE_UP),
    ("prova.adm", "PART has no argument TUASORELLA", MADE_UP),
    (
        "prova.adm",
        "no function or constant is called CIAO",
        MADE_UP,
    ),
    (
        "prova.adm",
        "no function or constant is called LEO",
        MADE_UP,
    ),
    (
        "prova.adm",
        "no function or constant is called NAME",
        MADE_UP,
    ),
    (
        "pm03.adm",
        "no function or constant is called A",
        "a variable of another language",
    ),
    (
        "pm03.adm",
        "no function or constant is called COSIN",
        "for COS",
    ),
    (
        "pm03.adm",
        "no function or constant is called VR",
        "VR without markers",
    ),
];
/// A sample that tests how another reader copes with nonsense.
const MADE_UP: &str = "made up";

/// The files of real models in a folder and below.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    entries.sort();
    for path in entries {
        let extension = path
            .extension()
            .and_then(|e| e.to_str())
            .unwrap_or_default();
        if path.is_dir() {
            files(&path, found);
        } else if ["adm", "acf"].contains(&extension.to_ascii_lowercase().as_str()) {
            found.push(path);
        }
    }
}

/// Lets a run take so long; what it has not found wrong by then it will hardly find.
struct Patience(Instant);

const PATIENCE: Duration = Duration::from_secs(5);

impl Watch for Patience {
    fn progress(&mut self, _: &Progress) -> bool {
        self.0.elapsed() < PATIENCE
    }
}

/// How many statements a file has.
fn statements(path: &Path) -> usize {
    let Ok(source) = Source::from_bytes("file", &std::fs::read(path).unwrap()) else {
        return 0;
    };
    let commands = path.extension().is_some_and(|extension| extension == "acf");
    let language = match commands {
        true => Language::Commands,
        false => Language::Dataset,
    };
    SyntaxTree::new(&source, language).statements.len()
}

/// What became of a file.
struct Row {
    /// One or two words.
    fate: &'static str,
    /// Why.
    reason: String,
    messages: Vec<Message>,
}

/// The first error of some messages, in short.
fn first_error(messages: &[Message]) -> String {
    let errors = messages.iter().filter(|message| message.is_error());
    let mut names: Vec<&str> = errors
        .map(|message| message.diagnostic.message.as_str())
        .collect();
    let count = names.len();
    names.dedup();
    let first: String = names.first().unwrap_or(&"").chars().take(90).collect();
    format!("{count} errors: {first}")
}

fn look(path: &Path) -> Row {
    let refused = |messages: Vec<Message>| Row {
        fate: "refused",
        reason: first_error(&messages),
        messages,
    };
    let mut project = match Project::load(path) {
        Ok(project) => project,
        Err(error) => return refused(error.messages),
    };
    let mut messages = match stiction::check(&project) {
        Ok(report) => report.messages,
        Err(error) => return refused(error.messages),
    };
    if messages.iter().any(Message::is_error) {
        let of_assembly = |m: &Message| m.diagnostic.code == Code::Assembly;
        let physical = messages.iter().any(of_assembly);
        let fate = if physical { "not assembled" } else { "refused" };
        let reason = first_error(&messages);
        return Row {
            fate,
            reason,
            messages,
        };
    }
    if project.is_dataset_alone() {
        let second = project
            .dataset()
            .units
            .as_ref()
            .and_then(|units| units.time);
        let second = second.map_or(1.0, |unit| 1.0 / unit.si());
        project.push_dynamic(0.1 * second, Some(10), None);
    }
    let folder = scratch_folder();
    let session = Session::new(&project).unwrap();
    let report = session
        .run(
            &folder,
            RunOptions::default(),
            &mut Patience(Instant::now()),
        )
        .unwrap();
    std::fs::remove_dir_all(folder).unwrap();
    messages.extend(report.messages);
    let short = |text: &str| text.lines().next().unwrap_or("").to_owned();
    let (fate, reason) = match report.outcome {
        Outcome::Completed => ("completed", format!("to {}", report.time)),
        Outcome::Interrupted => ("out of time", format!("at {}", report.time)),
        Outcome::Refused(text) => ("not carried out", short(&text)),
        Outcome::AssemblyFailed(text) => ("no start", short(&text)),
        Outcome::IntegrationFailed(text) => ("stopped", short(&text)),
    };
    Row {
        fate,
        reason,
        messages,
    }
}

/// The codes of messages with how often they come, the errors first.
fn by_code(messages: &[Message]) -> String {
    let mut counts: BTreeMap<(Severity, &str), usize> = BTreeMap::new();
    for message in messages {
        let diagnostic = &message.diagnostic;
        let key = (diagnostic.severity, diagnostic.code.as_str());
        *counts.entry(key).or_default() += 1;
    }
    let counts = counts.iter().map(|((severity, code), count)| {
        format!("{} {count} {code}", &severity.as_str()[..1].to_uppercase())
    });
    counts.collect::<Vec<_>>().join(", ")
}

/// Names that the language does not have, where the file is not known to be wrong.
fn unknown(file: &str, messages: &[Message]) -> Vec<String> {
    let is_unknown = |message: &&Message| {
        matches!(
            message.diagnostic.code,
            Code::UnknownStatement
                | Code::UnknownArgument
                | Code::UnknownFunction
                | Code::AmbiguousName
        )
    };
    let known = |message: &&Message| {
        NOT_IN_THE_LANGUAGE
            .iter()
            .any(|(of, text, _)| *of == file && message.diagnostic.message.starts_with(text))
    };
    let unknown = messages.iter().filter(is_unknown).filter(|m| !known(m));
    unknown.map(ToString::to_string).collect()
}

/// Whether a file ends in success or a run that is cut short here, or says why it does not: an error
/// of the file where it is refused, and a reason of mechanics where it is run.
fn has_reason(row: &Row) -> bool {
    let physical = |code: Code| {
        matches!(
            code,
            Code::Assembly | Code::Integration | Code::Equilibrium | Code::Jam
        )
    };
    let mut errors = row.messages.iter().filter(|message| message.is_error());
    match row.fate {
        "completed" | "out of time" => true,
        "refused" => errors.next().is_some(),
        _ => errors.any(|error| physical(error.diagnostic.code)),
    }
}

#[test]
fn every_file_is_read_and_what_is_not_refused_runs() {
    let Some(corpus) = reference_data::path("corpus") else {
        return;
    };
    let mut found = Vec::new();
    files(&corpus, &mut found);
    assert!(found.len() > 70, "the corpus has 78 files");
    let mut fates: BTreeMap<&str, usize> = BTreeMap::new();
    let mut wrong = Vec::new();
    for path in &found {
        let row = look(path);
        let file = path.strip_prefix(&corpus).unwrap().display().to_string();
        println!(
            "{file}\n    {} statements; {}, {}\n    {}",
            statements(path),
            row.fate,
            row.reason,
            by_code(&row.messages)
        );
        *fates.entry(row.fate).or_default() += 1;
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        wrong.extend(unknown(&name, &row.messages));
        if !has_reason(&row) {
            wrong.push(format!(
                "{file}: {}, {}, without a reason\n",
                row.fate, row.reason
            ));
        }
    }
    println!("{} files: {fates:?}", found.len());
    assert!(wrong.is_empty(), "{}", wrong.concat());
}
