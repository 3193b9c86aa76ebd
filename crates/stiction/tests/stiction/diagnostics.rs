//! `docs/diagnostics.md` is made of the table of codes and of examples that really give them.
//!
//! The example of a code is the file of its name in `tests/diagnostics`, `.adm` or `.acf`. With the
//! environment variable `STICTION_UPDATE_DIAGNOSTICS` set the document is written anew.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use dataset::Code;
use stiction::{Message, Project, RunOptions, Session};

use crate::shared::{GoOn, scratch_folder};

/// Codes whose example cannot be a file of the repository.
const WITHOUT_EXAMPLE: [(Code, &str); 3] = [
    (Code::TooLarge, "A file of 4 GB gives it."),
    (
        Code::StepReactions,
        "No small model is known that gives it for sure.",
    ),
    (
        Code::StudyFile,
        "`stiction sweep` says it of a study file, which is neither a dataset nor a command file.",
    ),
];

/// Longer examples are cut here.
const LINES: usize = 40;

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/diagnostics")
}

fn document() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/diagnostics.md")
}

/// All that is said of a model: by `check`, and by a run where it can be simulated.
fn told(path: &Path) -> Vec<Message> {
    let mut project = match Project::load(path) {
        Ok(project) => project,
        Err(error) => return error.messages,
    };
    let mut messages = match stiction::check(&project) {
        Ok(report) => report.messages,
        Err(error) => return error.messages,
    };
    if messages.iter().any(Message::is_error) {
        return messages;
    }
    if project.is_dataset_alone() {
        project.push_dynamic(1.0, Some(100), None);
    }
    let folder = scratch_folder();
    let session = Session::new(&project).unwrap();
    let options = RunOptions {
        check_accuracy: true,
        ..RunOptions::default()
    };
    let report = session.run(&folder, options, &mut GoOn);
    messages.extend(report.unwrap().messages);
    std::fs::remove_dir_all(folder).unwrap();
    messages
}

/// The text of an example, one that is made where it is too long for a file, and its name.
fn example(code: Code) -> Option<(String, String)> {
    for extension in ["adm", "acf"] {
        let name = format!("{}.{extension}", code.as_str());
        if let Ok(bytes) = std::fs::read(examples().join(&name)) {
            return Some((name, String::from_utf8(bytes).expect("examples are UTF-8")));
        }
    }
    let long = (code == Code::TooMany).then(|| "title\n".to_owned() + &"PRAT/2\n".repeat(10_002));
    long.map(|text| ("too-many.adm".to_owned(), text))
}

/// The example as it is shown.
fn shown(text: &str) -> String {
    let visible = |c: char| match c {
        '\n' => "\n".to_owned(),
        c if c.is_control() => "\u{b7}".to_owned(),
        c => c.to_string(),
    };
    let count = text.lines().count();
    let lines: Vec<&str> = text.lines().take(LINES).collect();
    let mut shown: String = lines.join("\n").chars().map(visible).collect();
    if count > LINES {
        let _ = write!(shown, "\n... and so on, {count} lines");
    }
    shown
}

fn section(code: Code, folder: &Path) -> String {
    let mut text = format!("### {}\n\n{}\n\n", code.as_str(), code.meaning().trim());
    if let Some((_, reason)) = WITHOUT_EXAMPLE.iter().find(|(without, _)| *without == code) {
        let _ = writeln!(text, "{reason}\n\n**Cure.** {}\n", code.cure());
        return text;
    }
    let (name, example) = example(code)
        .unwrap_or_else(|| panic!("{}: it has no example in tests/diagnostics", code.as_str()));
    let path = folder.join(&name);
    std::fs::write(&path, &example).unwrap();
    let messages = told(&path);
    let of_code: Vec<&Message> = messages
        .iter()
        .filter(|message| message.diagnostic.code == code)
        .collect();
    let all = || messages.iter().map(ToString::to_string).collect::<String>();
    assert!(!of_code.is_empty(), "{name} does not give it:\n{}", all());
    let prefix = format!("{}/", folder.display());
    let _ = write!(text, "`{name}`:\n\n```text\n{}\n```\n\n", shown(&example));
    let first = of_code[0].to_string().replace(&prefix, "");
    let _ = write!(text, "says\n\n```text\n{first}```\n\n");
    let _ = writeln!(text, "**Cure.** {}\n", code.cure());
    text
}

const HEAD: &str = "# Diagnostics

Made from the table of codes in `crates/dataset/src/diagnostic/code.rs` and the examples in
`crates/stiction/tests/diagnostics`, each of which is run by the test that writes this page:

```sh
STICTION_UPDATE_DIAGNOSTICS=1 cargo test -p stiction --test stiction diagnostics
```

Every message has a code that stays, a severity (error, warning or note), a place, the message,
notes and help. `stiction check` prints all of them, `stiction run` writes them into the message
file and its `run.json`, and prints those of the run itself.

* `--allow CODE` leaves out warnings and notes of this code; errors cannot be allowed.
* `--deny CODE` makes errors of them, and `--deny warnings` of every warning that is not allowed.
* `check` ends with 0, with 3 where there is an error, with 4 where the model cannot be assembled;
  `run` with 3 and 4 likewise and with 5 where the integration fails.

## JSON

`stiction check --format json` prints one object; `run.json` holds the same `diagnostics`:

```text
{
  \"version\": 1,                      grows when a name or meaning below changes
  \"diagnostics\": [
    {
      \"code\": \"unknown-argument\",    as below
      \"severity\": \"error\",           or warning, note
      \"message\": \"...\",              one line
      \"file\": \"arm.adm\",
      \"span\": {
        \"start\": { \"offset\": 210, \"line\": 10, \"column\": 40 },
        \"end\": { \"offset\": 219, \"line\": 10, \"column\": 49 }
      },
      \"notes\": [],                   one line each
      \"help\": \"is MU_DYNAMIC meant?\",  or null
      \"replacement\": {               or null: what a program may put there
        \"span\": { ... },
        \"text\": \"MU_DYNAMIC\"
      }
    }
  ],
  \"model\": { ... }                   elements, degrees of freedom, redundant equations, ...;
                                     null where the files cannot be read
}
```

Lines and columns are counted from 1, columns in characters; offsets are bytes of the text as UTF-8
(a file in Latin-1 is decoded first). The end is behind the last character.

## Codes

";

/// The text with `#` for numbers with a fraction or exponent, which follow the integrator.
fn masked(text: &str) -> String {
    let belongs = |c: char| c.is_ascii_digit() || matches!(c, '.' | 'e' | '+' | '-');
    let mut masked = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let number = &rest[start..];
        let end = number.find(|c| !belongs(c)).unwrap_or(number.len());
        let real = number[..end].contains(['.', 'e']);
        masked += &rest[..start];
        masked += if real { "#" } else { &number[..end] };
        rest = &number[end..];
    }
    masked + rest
}

#[test]
fn the_document_is_made_of_the_codes() {
    let folder = scratch_folder();
    for entry in std::fs::read_dir(examples()).unwrap() {
        let path = entry.unwrap().path();
        std::fs::copy(&path, folder.join(path.file_name().unwrap())).unwrap();
    }
    let mut text = HEAD.to_owned();
    for code in Code::ALL {
        text += &section(*code, &folder);
    }
    std::fs::remove_dir_all(folder).unwrap();
    let text = text.trim_end().to_owned() + "\n";
    if std::env::var_os("STICTION_UPDATE_DIAGNOSTICS").is_some() {
        std::fs::write(document(), text).unwrap();
        return;
    }
    let written = std::fs::read_to_string(document()).unwrap_or_default();
    let (text, written) = (masked(&text), masked(&written));
    let stale = text
        .lines()
        .zip(written.lines())
        .find(|(new, old)| new != old);
    assert!(
        text == written,
        "docs/diagnostics.md is stale{}; renew it with\n  STICTION_UPDATE_DIAGNOSTICS=1 cargo test \
         -p stiction --test stiction diagnostics",
        stale.map_or(String::new(), |(new, old)| format!(
            " at `{old}`, now `{new}`"
        ))
    );
}

#[test]
fn every_example_belongs_to_a_code() {
    for entry in std::fs::read_dir(examples()).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        assert!(
            name == "model" || Code::named(&name).is_some(),
            "{} belongs to no code",
            path.display()
        );
    }
}
