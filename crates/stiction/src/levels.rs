//! Which messages are told, and which count as errors.

use dataset::{Code, Diagnostic, Severity};

use crate::message::Message;

/// What is done about a message by its code: `--allow` and `--deny` of the program.
///
/// Errors stay errors. A warning or remark that is allowed is not told; one that is denied is an
/// error.
///
/// ```
/// let mut levels = stiction::Levels::default();
/// levels.allow("ignored")?;
/// levels.deny("warnings")?;
/// let error = levels.deny("static-below-dynamc").unwrap_err();
/// assert!(error.to_string().ends_with("is static-below-dynamic meant?"));
/// # Ok::<(), stiction::LevelError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Levels {
    allowed: Vec<Code>,
    denied: Vec<Code>,
    deny_warnings: bool,
}

/// A code that cannot be allowed or denied.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LevelError {
    /// No message has it.
    #[error("no message has the code {code}{}", meant(.nearest))]
    Unknown {
        /// As it was written.
        code: String,
        /// The code that may have been meant.
        nearest: Option<Code>,
    },
    /// It is allowed and denied.
    #[error("{0} is both allowed and denied")]
    Both(&'static str),
}

fn meant(nearest: &Option<Code>) -> String {
    nearest.map_or_else(
        || "; docs/diagnostics.md lists them".to_owned(),
        |code| format!("; is {} meant?", code.as_str()),
    )
}

/// Stands for every warning.
const WARNINGS: &str = "warnings";

impl Levels {
    /// Leaves out the messages of this code that are no errors.
    ///
    /// # Errors
    /// [`LevelError`] where the code does not exist or is denied.
    pub fn allow(&mut self, code: &str) -> Result<(), LevelError> {
        let code = find(code)?;
        self.allowed.push(code);
        self.contradiction(code)
    }

    /// Turns the messages of this code into errors; `warnings` stands for every warning that is not
    /// allowed.
    ///
    /// # Errors
    /// [`LevelError`] where the code does not exist or is allowed.
    pub fn deny(&mut self, code: &str) -> Result<(), LevelError> {
        if code == WARNINGS {
            self.deny_warnings = true;
            return Ok(());
        }
        let code = find(code)?;
        self.denied.push(code);
        self.contradiction(code)
    }

    fn contradiction(&self, code: Code) -> Result<(), LevelError> {
        if self.allowed.contains(&code) && self.denied.contains(&code) {
            Err(LevelError::Both(code.as_str()))
        } else {
            Ok(())
        }
    }

    /// The message as it is told; `None` where it is allowed.
    pub(crate) fn judge(&self, mut message: Message) -> Option<Message> {
        let Diagnostic { code, severity, .. } = message.diagnostic;
        let warning = severity == Severity::Warning;
        if message.is_error() {
            return Some(message);
        }
        if self.denied.contains(&code) {
            message.diagnostic.severity = Severity::Error;
        } else if self.allowed.contains(&code) {
            return None;
        } else if self.deny_warnings && warning {
            message.diagnostic.severity = Severity::Error;
        }
        Some(message)
    }

    /// The messages that are told.
    pub(crate) fn judge_all(&self, messages: Vec<Message>) -> Vec<Message> {
        let judged = messages.into_iter().filter_map(|m| self.judge(m));
        judged.collect()
    }
}

fn find(code: &str) -> Result<Code, LevelError> {
    Code::named(code).ok_or_else(|| LevelError::Unknown {
        code: code.to_owned(),
        nearest: Code::nearest(code),
    })
}
