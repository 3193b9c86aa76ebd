//! Progress on standard error, and Ctrl-C.

use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use stiction::{Progress, Watch};

use crate::arguments::ProgressKind;
use crate::exit::complain;

/// Divisions of the bar.
const BAR: u64 = 1000;
/// Time between two lines of plain or JSON progress.
const INTERVAL: Duration = Duration::from_millis(500);

enum Display {
    None,
    Bar(ProgressBar),
    Lines { json: bool, last: Option<Instant> },
}

/// Shows progress and stops the run after Ctrl-C.
pub(crate) struct Monitor {
    display: Display,
    started: Instant,
    interrupted: Arc<AtomicBool>,
}

impl Monitor {
    /// Shows progress as asked for, and takes over Ctrl-C.
    pub(crate) fn new(kind: ProgressKind) -> Self {
        let interrupted = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&interrupted);
        let handler = ctrlc::set_handler(move || {
            // Whoever asks twice does not want to wait for the end of a step.
            if flag.swap(true, Ordering::SeqCst) {
                std::process::exit(i32::from(crate::exit::Exit::Interrupted.code()));
            }
        });
        if let Err(error) = handler {
            complain(&format!("warning: Ctrl-C will not keep results: {error}\n"));
        }
        let display = match kind {
            ProgressKind::Auto if std::io::stderr().is_terminal() => Display::Bar(bar()),
            ProgressKind::Auto | ProgressKind::None => Display::None,
            ProgressKind::Plain => Display::Lines {
                json: false,
                last: None,
            },
            ProgressKind::Json => Display::Lines {
                json: true,
                last: None,
            },
        };
        Self {
            display,
            started: Instant::now(),
            interrupted,
        }
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        if let Display::Bar(bar) = &self.display {
            bar.finish_and_clear();
        }
    }
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::new(BAR);
    let style =
        ProgressStyle::with_template("[{elapsed}] {wide_bar} {percent:>3} %  {msg}  ETA {eta}");
    if let Ok(style) = style {
        bar.set_style(style);
    }
    bar
}

impl Monitor {
    /// Shows a share of the way, with a text on the bar or with a line, of JSON or not; returns
    /// whether to go on.
    fn show(
        &mut self,
        share: f64,
        text: impl FnOnce() -> String,
        line: impl FnOnce(bool) -> String,
    ) -> bool {
        match &mut self.display {
            Display::None => {}
            Display::Bar(bar) => {
                bar.set_position((share * BAR as f64) as u64);
                bar.set_message(text());
            }
            Display::Lines { json, last } => {
                if last.is_none_or(|last| last.elapsed() >= INTERVAL) || share >= 1.0 {
                    *last = Some(Instant::now());
                    complain(&line(*json));
                }
            }
        }
        !self.interrupted.load(Ordering::SeqCst)
    }

    /// Shows how far a study is; returns whether to go on.
    pub(crate) fn cases(&mut self, done: usize, failed: usize, cases: usize) -> bool {
        let elapsed = self.started.elapsed().as_secs_f64();
        let text = || format!("{done} of {cases} cases, {failed} failed");
        self.show(done as f64 / cases.max(1) as f64, text, |json| match json {
            true => {
                let value = serde_json::json!({
                    "done": done,
                    "failed": failed,
                    "cases": cases,
                    "elapsed": elapsed,
                });
                format!("{value}\n")
            }
            false => format!("{done} of {cases} cases, {failed} failed, {elapsed:.1} s\n"),
        })
    }
}

impl Watch for Monitor {
    fn progress(&mut self, progress: &Progress) -> bool {
        let share = if progress.end > 0.0 {
            progress.time / progress.end
        } else {
            1.0
        };
        let elapsed = self.started.elapsed().as_secs_f64();
        let speed = progress.time / elapsed.max(1e-9);
        let (time, end) = (progress.time, progress.end);
        let text = || format!("t = {time:.6} of {end:.6}, {speed:.3}/s");
        self.show(share, text, |json| line(json, progress, elapsed, speed))
    }
}

fn line(json: bool, progress: &Progress, elapsed: f64, speed: f64) -> String {
    let remaining = (progress.end - progress.time).max(0.0) / speed.max(1e-300);
    let steps = progress.statistics.steps.steps;
    if json {
        let value = serde_json::json!({
            "time": progress.time,
            "end": progress.end,
            "steps": steps,
            "elapsed": elapsed,
            "speed": speed,
            "eta": remaining,
        });
        return format!("{value}\n");
    }
    format!(
        "t = {:.6} of {:.6}, {steps} steps, {elapsed:.1} s, {speed:.3}/s, ETA {remaining:.1} s\n",
        progress.time, progress.end
    )
}
