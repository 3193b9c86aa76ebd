//! The page docs/performance.md: the machine, the ratios that are aimed at, and all tables.

use std::fmt::Write;
use std::process::Command;

use super::matched::{Matched, time_at};
use super::tables::{cell, names, section};
use super::work_precision::Measured;

/// A ratio that is aimed at: the time of a peer over the least of ours at an error.
struct Target {
    case: &'static str,
    /// How the name of the peer begins.
    peer: &'static str,
    error: f64,
    least: f64,
}

const TARGETS: [Target; 12] = [
    target("andrews", "Exudyn", 1e-4, 30.0),
    target("andrews", "Exudyn", 1e-6, 100.0),
    target("four-bar-2", "Exudyn", 1e-4, 30.0),
    target("four-bar-2", "Exudyn", 1e-6, 30.0),
    target("four-bar-40", "Exudyn", 1e-4, 30.0),
    target("four-bar-40", "Exudyn", 1e-6, 30.0),
    target("chain-10", "Exudyn", 1e-5, 10.0),
    target("chain-100", "Exudyn", 1e-5, 10.0),
    target("chain-1000", "Exudyn", 1e-5, 10.0),
    target("chain-10", "MuJoCo", 1e-5, 0.5),
    target("chain-100", "MuJoCo", 1e-5, 0.5),
    target("chain-1000", "MuJoCo", 1e-5, 0.5),
];

const fn target(case: &'static str, peer: &'static str, error: f64, least: f64) -> Target {
    Target {
        case,
        peer,
        error,
        least,
    }
}

/// The most milliseconds that our best integrator is to take for a case, at an error.
const LIMITS: [(&str, f64, f64); 2] = [("lugre-pendulum", 1e-4, 45.0), ("stick-slip", 1e-5, 50.0)];

/// The page; `others` are the sections before the cases, `versions` those of the peers.
pub(crate) fn page(measured: &[Measured], others: &str, versions: Option<&str>) -> String {
    let mut text = format!(
        "# Performance\n\nWritten by `cargo xtask bench`. {}\n\nPeers: {}. Times are medians of the \
         solver alone, of one thread: processor time of the thread for ours, of the process for the \
         peers, by turns in one run. Between measured errors, error and time are taken as powers of one \
         another, and no lucky error counts.\n\n",
        machine(),
        versions.unwrap_or("none")
    );
    text += "## Ratios\n\nThe time of the peer's best method over that of our best integrator, at the same \
             error.\n\n| case | peer | error | ours, ms | peer, ms | ratio | aimed at | |\n\
             |---|---|---|---|---|---|---|---|\n";
    for target in &TARGETS {
        text += &ratio(target, measured);
    }
    text += "\n## Times\n\nThe time of our best integrator at an error.\n\n\
             | case | error | ours, ms | aimed at | |\n|---|---|---|---|---|\n";
    for (case, error, most) in LIMITS {
        let ours = best(measured, case, error, |name| !is_peer(name));
        let verdict = match ours {
            Some(ours) if 1e3 * ours.time <= most => "met",
            Some(_) => "**short**",
            None => "**not measured**",
        };
        let _ = writeln!(
            text,
            "| `{case}` | {error:.0e} | {} | {most} | {verdict} |",
            cell(ours)
        );
    }
    text += "\n";
    text += others;
    for case in measured {
        let picture = super::picture::file(case.case.name);
        text += &section(case, &format!("![Error against time]({picture})\n\n"));
    }
    text
}

fn is_peer(name: &str) -> bool {
    name.starts_with("Exudyn") || name.starts_with("MuJoCo")
}

/// The least time of the chosen integrators or peers at an error.
fn best(
    measured: &[Measured],
    case: &str,
    error: f64,
    chosen: impl Fn(&str) -> bool,
) -> Option<Matched> {
    let case = measured.iter().find(|m| m.case.name == case)?;
    let all = names(&case.rows).into_iter().filter(|name| chosen(name));
    let times = all.filter_map(|name| time_at(&case.rows, name, error));
    times.min_by(|a, b| a.time.total_cmp(&b.time))
}

fn ratio(target: &Target, measured: &[Measured]) -> String {
    let (case, error) = (target.case, target.error);
    let ours = best(measured, case, error, |name| !is_peer(name));
    let peer = best(measured, case, error, |name| name.starts_with(target.peer));
    let (found, verdict) = match (ours, peer) {
        (Some(ours), Some(peer)) => {
            let ratio = peer.time / ours.time;
            let verdict = if ratio >= target.least {
                "met"
            } else {
                "**short**"
            };
            (format!("{ratio:.1}"), verdict)
        }
        _ => (String::new(), "**not measured**"),
    };
    let mut line = String::new();
    let _ = writeln!(
        line,
        "| `{}` | {} | {:.0e} | {} | {} | {found} | {} | {verdict} |",
        target.case,
        target.peer,
        target.error,
        cell(ours),
        cell(peer),
        target.least
    );
    line
}

/// Processor, cores, compiler and commit.
fn machine() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find(|line| line.starts_with("model name"));
    let model = model.and_then(|line| line.split(": ").nth(1));
    let cores = std::thread::available_parallelism().map_or(0, std::num::NonZero::get);
    let said = |program: &str, arguments: &[&str]| {
        let output = Command::new(program).args(arguments).output().ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        Some(text.trim().to_owned())
    };
    let unknown = || "unknown".to_owned();
    format!(
        "Machine: {}, {cores} cores, {} {}; {}; commit {} of {}.",
        model.unwrap_or("unknown processor"),
        std::env::consts::OS,
        std::env::consts::ARCH,
        said("rustc", &["--version"]).unwrap_or_else(unknown),
        said("git", &["rev-parse", "--short", "HEAD"]).unwrap_or_else(unknown),
        said("git", &["log", "-1", "--format=%cs"]).unwrap_or_else(unknown),
    )
}
