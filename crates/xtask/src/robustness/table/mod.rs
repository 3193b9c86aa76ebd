//! The table of mechanisms, integrators, errors and frictions.

mod models;
mod track;

use std::fmt::Write;

use mechanics::model::Model;

use super::side_by_side;
use crate::bench::integrators::{ALL as INTEGRATORS, FOR_REFERENCES, Integrator};
use models::{Choice, Entry};
use track::{Missing, Track};

/// Powers of ten of ERROR.
const POWERS: [i32; 6] = [-3, -4, -5, -6, -7, -8];
/// ERROR of references.
const REFERENCE: f64 = 1e-10;
/// Attempts at steps after which a run is given up,
const MOST_STEPS: usize = 30_000;
/// those of references,
const MOST_REFERENCE_STEPS: usize = 200_000;
/// and of second runs, which of first order take ten times as many.
const MOST_SECOND_STEPS: usize = 400_000;
/// Part by which weights, velocities, masses and inertia are larger for the sensitivity.
const DISTURBANCE: f64 = 1e-6;
/// Times ERROR that a success may be off, where the mechanism does not magnify it.
const GOOD: f64 = 100.0;

/// What came of a run.
enum Cell {
    /// Error in units of ERROR, whether the check of accuracy warns of it, and steps.
    Success {
        error: f64,
        warned: bool,
        steps: usize,
    },
    Refused(String),
    GivenUp,
}

/// All runs of a mechanism with one friction.
struct Block {
    friction: Choice,
    /// How many times a small change of weights, velocities, masses and inertia is larger in the places.
    sensitivity: f64,
    /// By how much the two references differ; none where there is one alone.
    agreement: Option<f64>,
    /// By integrator and ERROR.
    cells: Vec<Vec<Cell>>,
}

/// Whether a success is a good one.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Verdict {
    Good,
    GoodButWarned,
    Warned,
    /// Beyond, but by no more than the references differ by.
    Unknown,
    Silent,
}

/// Kinds of cells.
const KINDS: usize = 7;

/// Of an error that is known up to what the references differ by.
fn verdict(error: f64, known_to: f64, warned: bool) -> Verdict {
    match (error <= GOOD, warned) {
        (true, false) => Verdict::Good,
        (true, true) => Verdict::GoodButWarned,
        (false, true) => Verdict::Warned,
        (false, false) if error - known_to <= GOOD => Verdict::Unknown,
        (false, false) => Verdict::Silent,
    }
}

/// What is told of a mechanism.
#[derive(Default)]
struct Told {
    text: String,
    /// Runs of each integrator by kind.
    counts: [[usize; KINDS]; INTEGRATORS.len()],
    causes: String,
}

/// The section; mechanisms whose name contains one of `names`, or all.
pub(super) fn section(names: &[String]) -> String {
    let wanted = |name: &str| names.is_empty() || names.iter().any(|part| name.contains(part));
    let entries: Vec<&Entry> = models::ALL.iter().filter(|e| wanted(e.name)).collect();
    let mut all = Told::default();
    for told in side_by_side(&entries, |entry| tell(entry)) {
        all.text += &told.text;
        all.causes += &told.causes;
        let counts = all.counts.iter_mut().flatten();
        for (all, count) in counts.zip(told.counts.iter().flatten()) {
            *all += count;
        }
    }
    heading() + &summary(&all.counts) + &refusals(&all.causes) + &all.text
}

/// Measures a mechanism with all frictions.
fn tell(entry: &Entry) -> Told {
    let mut told = Told::default();
    let Some(model) = (entry.make)() else {
        return told;
    };
    let text = &mut told.text;
    let _ = writeln!(
        text,
        "\n### {}, {} s\n\n| friction | sensitivity | references differ by | integrator | {} |\n\
         |---|---|---|---|{}",
        entry.name,
        entry.end,
        POWERS.map(|p| format!("1e{p}")).join(" | "),
        "---|".repeat(POWERS.len())
    );
    for choice in Choice::ALL {
        let Some(model) = models::with_friction(model.clone(), choice) else {
            continue;
        };
        match measure(&model, entry, choice) {
            Ok(block) => *text += &rows(&block, entry, &mut told.counts, &mut told.causes),
            Err(message) => {
                let name = choice.name();
                let _ = writeln!(told.causes, "* {}, {name}: {message}", entry.name);
                let _ = writeln!(text, "| {name} | no reference | | | | | | | | |");
            }
        }
    }
    told
}

fn heading() -> String {
    format!(
        "## Mechanisms, integrators, errors, frictions\n\nThe mechanisms of the validation cases and of the \
         tests, each without friction and with ORIGINAL and LUGRE friction (0.25 and 0.2, pins of a \
         twentieth of the length, Vs = vs = 0.01 of it per second, Dm and the deflection under the weight \
         1e-4 of it) in all joints that can have it, at six values of ERROR.\n\nA cell has the error in \
         units of ERROR, and the steps. The error is the largest distance of a body from its place in the \
         reference as a part of the length of the mechanism (that which ERROR is a part of), or its largest \
         rotation from there in radians, over ten outputs. ERROR is one of each step: over a run errors \
         add up, and the mechanism magnifies them. *Sensitivity* is how many times a relative change of \
         weights, initial velocities, inertia about one axis and every second mass is larger in those \
         places. The reference is our own run at {REFERENCE:e}: SI2 for all but backward differentiation, \
         for which it is Adams (SI2 where Adams has none), and I3 with LUGRE; both differ by what is said; \
         Adams goes on by SI2 where bristles are stiff.\n\nThe check of accuracy (docs/accuracy.md: a second run with a tenth \
         of ERROR, which the program makes of every run) was made of every cell. A success within {GOOD} ERROR is plain, and one \
         beyond of which the check warns *in italics*; `w` is a warning. One in **bold** is beyond without a \
         warning: a silent failure; with a question mark it is beyond by less than the references differ, and \
         not known. `refused` runs say why not, see below; `long` ones were given up after {MOST_STEPS} \
         attempts at steps.\n\nWhat it teaches: NEWMARK with its default GAMMA of 0.7 is of first order and loses \
         energy, so that its error falls with the root of ERROR only; no local test makes that good, and tight \
         errors take too many steps. HHT is of second order; \
         NEWMARK integrates bristles (LUGRE) to first order, too. Bends of the laws, where stick begins and \
         breaks away, are seen by the error tests of all (docs/decisions/0011), but for bristles in I3, whose \
         rough reactions leave no velocities to test. Singular positions \
         (two four-bars) and positions beside an unstable axis (Dzhanibekov) magnify more than small changes of \
         the parameters tell, and no test of a step sees that: with `--unchecked` all in italics are \
         silent.\n\n"
    )
}

/// Measures a mechanism with its friction.
fn measure(model: &Model, entry: &Entry, friction: Choice) -> Result<Block, String> {
    let reference = |integrator: &Integrator, model: &Model| {
        let settings = integrator.settings(REFERENCE, entry.end);
        Track::of(model, entry.end, &settings, MOST_REFERENCE_STEPS)
    };
    let name = match friction {
        Choice::LuGre => "GSTIFF, I3",
        Choice::Off | Choice::Original => "Adams",
    };
    let other = INTEGRATORS.iter().find(|i| i.name == name);
    let ours = match reference(&FOR_REFERENCES, model) {
        Ok(track) => track,
        Err(Missing::Refused(message)) => return Err(message),
        Err(Missing::GivenUp) => return Err("the reference takes too many steps".to_owned()),
    };
    let other = other.and_then(|other| reference(other, model).ok());
    let disturbed = models::disturbed(model.clone(), DISTURBANCE);
    let disturbed = reference(&FOR_REFERENCES, &disturbed).ok();
    let sensitivity = disturbed.map_or(f64::NAN, |d| d.distance(&ours) / DISTURBANCE);
    let cells = INTEGRATORS.iter().map(|integrator| {
        let backward = integrator.name.starts_with("GSTIFF");
        let reference = match &other {
            Some(other) if backward => other,
            _ => &ours,
        };
        let cell = |power: i32| {
            let error = 10f64.powi(power);
            let settings = integrator.settings(error, entry.end);
            match Track::of(model, entry.end, &settings, MOST_STEPS) {
                Ok(track) => Cell::Success {
                    error: track.distance(reference) / error,
                    warned: warned(model, entry, &settings, &track),
                    steps: track.steps,
                },
                Err(Missing::Refused(message)) => Cell::Refused(message),
                Err(Missing::GivenUp) => Cell::GivenUp,
            }
        };
        POWERS.map(cell).into()
    });
    Ok(Block {
        friction,
        sensitivity,
        agreement: other.as_ref().map(|other| other.distance(&ours)),
        cells: cells.collect(),
    })
}

/// Whether the check of accuracy warns of a run: by a second run, or because that does not come to its end.
fn warned(model: &Model, entry: &Entry, settings: &mechanics::Settings, track: &Track) -> bool {
    Track::of(model, entry.end, &settings.tighter(), MOST_SECOND_STEPS)
        .map_or(true, |second| track.is_inaccurate(&second, settings))
}

fn rows(
    block: &Block,
    entry: &Entry,
    counts: &mut [[usize; KINDS]],
    causes: &mut String,
) -> String {
    let mut text = String::new();
    for ((integrator, cells), counts) in INTEGRATORS.iter().zip(&block.cells).zip(counts) {
        let _ = write!(
            text,
            "| {} | {:.1} | {} | {} |",
            block.friction.name(),
            block.sensitivity,
            block
                .agreement
                .map_or_else(|| "no Adams".to_owned(), |a| format!("{a:.0e}")),
            integrator.name
        );
        for (cell, power) in cells.iter().zip(POWERS) {
            let (place, words) = match cell {
                Cell::Success {
                    error,
                    warned,
                    steps,
                } => {
                    let known_to = block.agreement.unwrap_or(0.0) / 10f64.powi(power);
                    let verdict = verdict(*error, known_to, *warned);
                    let error = if *error < 9.95 {
                        format!("{error:.1}")
                    } else {
                        format!("{error:.0}")
                    };
                    match verdict {
                        Verdict::Good => (0, format!("{error}, {steps}")),
                        Verdict::GoodButWarned => (1, format!("{error} w, {steps}")),
                        Verdict::Warned => (2, format!("*{error}* w, {steps}")),
                        Verdict::Unknown => (3, format!("{error} ?, {steps}")),
                        Verdict::Silent => (4, format!("**{error}**, {steps}")),
                    }
                }
                Cell::Refused(message) => {
                    let _ = writeln!(
                        causes,
                        "* {}, {}, {}, 1e{power}: {message}",
                        entry.name,
                        block.friction.name(),
                        integrator.name
                    );
                    (5, "refused".to_owned())
                }
                Cell::GivenUp => (6, "long".to_owned()),
            };
            counts[place] += 1;
            let _ = write!(text, " {words} |");
        }
        text.push('\n');
    }
    text
}

fn summary(counts: &[[usize; KINDS]]) -> String {
    let mut text =
        "| integrator | within 100 ERROR | the same, but warned of | beyond, and warned of | not known | \
                    **beyond, silent** | refused | long |\n|---|---|---|---|---|---|---|---|\n"
            .to_owned();
    for (integrator, counts) in INTEGRATORS.iter().zip(counts) {
        let counts = counts.map(|count| count.to_string()).join(" | ");
        let _ = writeln!(text, "| {} | {counts} |", integrator.name);
    }
    text
}

fn refusals(causes: &str) -> String {
    if causes.is_empty() {
        return String::new();
    }
    format!("\nWhat was refused, and why:\n\n{causes}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The arms of the governor pull alike, so that its collar has no load but rounding, which no error
    /// test of bristles is to follow: it took 10,000 steps and more, and was refused at 1e-8.
    #[test]
    fn bristles_without_load_take_no_short_steps() {
        let entry = models::ALL.iter().find(|entry| entry.name == "governor");
        let entry = entry.expect("it is in the table");
        let model = (entry.make)().expect("it needs no data");
        let model =
            models::with_friction(model, Choice::LuGre).expect("it has joints with friction");
        let adams = INTEGRATORS.iter().find(|i| i.name == "Adams");
        let adams = adams.expect("it is an integrator");
        let track = |integrator: &Integrator, error| {
            Track::of(
                &model,
                entry.end,
                &integrator.settings(error, entry.end),
                MOST_STEPS,
            )
        };
        let Ok(reference) = track(&FOR_REFERENCES, 1e-9) else {
            panic!("the reference fails");
        };
        for error in [1e-6, 1e-7, 1e-8] {
            let Ok(run) = track(adams, error) else {
                panic!("{error:e} fails");
            };
            // Some hundred steps, each with a tenth of ERROR.
            assert!(
                run.steps < 2_000 && run.distance(&reference) < 100.0 * error,
                "{error:e}"
            );
        }
    }
}
