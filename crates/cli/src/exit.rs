//! How the program ends.

use std::io::Write;

/// Exit statuses, the graver ones later.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Exit {
    Success,
    Different,
    Usage,
    Input,
    Assembly,
    Integration,
    Interrupted,
}

impl Exit {
    /// The number that the shell sees.
    pub(crate) fn code(self) -> u8 {
        match self {
            Self::Success => 0,
            Self::Different => 1,
            Self::Usage => 2,
            Self::Input => 3,
            Self::Assembly => 4,
            Self::Integration => 5,
            Self::Interrupted => 130,
        }
    }

    /// That of another program with the same numbers; others mean that it could not do its work.
    pub(crate) fn of_code(code: i32) -> Self {
        let all = [Self::Success, Self::Input, Self::Interrupted];
        let found = all.into_iter().find(|exit| i32::from(exit.code()) == code);
        found.unwrap_or(Self::Usage)
    }
}

/// Writes to standard error; a closed pipe is no reason to fail.
pub(crate) fn complain(text: &str) {
    let _ = std::io::stderr().lock().write_all(text.as_bytes());
}

/// Writes to standard output; a closed pipe is no reason to fail.
pub(crate) fn say(text: &str) {
    say_bytes(text.as_bytes());
}

/// Like [`say`] for a text in another encoding.
pub(crate) fn say_bytes(bytes: &[u8]) {
    let _ = std::io::stdout().lock().write_all(bytes);
}
