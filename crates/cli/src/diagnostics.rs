//! Diagnostics as JSON, and what the command line says about them.

use clap::Args;
use stiction::{LevelError, Levels, Message, Severity};

/// Version of the shape of the JSON; see docs/diagnostics.md.
pub(crate) const VERSION: u32 = 1;

/// Which warnings are told and which are errors.
#[derive(Debug, Args)]
pub(crate) struct LevelArguments {
    /// Treat the warnings or remarks of this code as errors; `warnings` means every warning
    #[arg(long, value_name = "CODE")]
    deny: Vec<String>,
    /// Do not tell the warnings or remarks of this code
    #[arg(long, value_name = "CODE")]
    allow: Vec<String>,
}

impl LevelArguments {
    /// The levels that they ask for.
    pub(crate) fn levels(&self) -> Result<Levels, LevelError> {
        let mut levels = Levels::default();
        for code in &self.deny {
            levels.deny(code)?;
        }
        for code in &self.allow {
            levels.allow(code)?;
        }
        Ok(levels)
    }
}

/// How many errors and warnings there are, for a last line.
pub(crate) fn counts(messages: &[Message]) -> String {
    let of = |severity, word: &str| {
        let severities = messages.iter().map(|m| m.diagnostic.severity);
        match severities.filter(|s| *s == severity).count() {
            0 => None,
            1 => Some(format!("1 {word}")),
            count => Some(format!("{count} {word}s")),
        }
    };
    let counts = [
        of(Severity::Error, "error"),
        of(Severity::Warning, "warning"),
    ];
    let counts: Vec<String> = counts.into_iter().flatten().collect();
    match counts.is_empty() {
        true => "no errors, no warnings".to_owned(),
        false => counts.join(", "),
    }
}
