//! The section on random mechanisms: how many ended how, and what the failures teach.

use std::fmt::Write;

use super::trial::{Outcome, Trial};
use crate::bench::integrators::ALL;

/// A kind of ending with what it teaches, told by words of its message.
struct Lesson {
    words: &'static str,
    title: &'static str,
    teaches: &'static str,
}

const LESSONS: [Lesson; 8] = [
    Lesson {
        words: "velocities contradict",
        title: "The motion drives what is locked",
        teaches: "A motion was put into a joint whose freedom the rest of the mechanism locks. Assembly \
                  names the equations that cannot be met.",
    },
    Lesson {
        words: "cannot be assembled",
        title: "The joints cannot be assembled",
        teaches: "The joints contradict one another where the motion wants them.",
    },
    Lesson {
        words: " jams",
        title: "Friction jams",
        teaches: "The friction that a load causes adds more to the load than there was: beyond a gain of \
                  one Coulomb's law has no solution or several (Painlevé). The run names the friction and \
                  its gain.",
    },
    Lesson {
        words: "could not be solved with the shortest step",
        title: "The step has no solution",
        teaches: "A motion drives the mechanism on to where it does not reach (a rocker beyond its dead \
                  point), or it comes to a singular position. The time is the same with all integrators.",
    },
    Lesson {
        words: "error tolerance cannot be met",
        title: "The shortest step is too long",
        teaches: "The mechanism comes to a limit of its reach with unbounded velocities, or bristles on a \
                  part of hardly any mass move within the shortest step, a millionth of the longest.",
    },
    Lesson {
        words: "the energy is off",
        title: "**Energy beyond the tolerance**",
        teaches: "The run is wrong, and no error test has seen it.",
    },
    Lesson {
        words: "off by",
        title: "Redundant equations have become independent",
        teaches: "An equation that depended on others where the mechanism was assembled does not do so \
                  further on. The run says so; what it gives from there on is the motion without that \
                  equation.",
    },
    Lesson {
        words: "takes more than",
        title: "**Too many steps**",
        teaches: "Bristles that are faster than they are passive for (`v > 4 G/s1`, which the message file \
                  names) are ill-posed, and an error test that sees velocities follows every jitter.",
    },
];

/// The section; `trials` in the order of seeds.
pub(super) fn section(trials: &[Trial]) -> String {
    let steps: usize = trials.iter().map(|t| t.statistics.steps.steps).sum();
    let mut text = format!(
        "## Random mechanisms\n\n{} mechanisms, seeds {} to {}: trees with loops of 2 to 30 bodies, all kinds \
         of joints, friction (ORIGINAL or LUGRE) in every second one, lengths, masses, stiffnesses and \
         parameters of friction over four decades; integrators and ERROR (1e-3, 1e-4, 1e-5) by turns; \
         {steps} steps in all. A run is to end well or to say why not. It ends well when every number is \
         finite, every joint is closed to 1e-6 (told by its markers alone), and the balance of energy holds \
         to 100 ERROR, in units of the energy exchanged and of that which an error of one would be (`m |v| L \
         Ω + |Jω| Ω + m g L` with the length and largest rate that ERROR is a part of). More than 100,000 \
         steps count as hanging.\n\n",
        trials.len(),
        trials.first().map_or(0, |t| t.seed),
        trials.last().map_or(0, |t| t.seed),
    );
    text += &by_integrator(trials);
    text += "\nWhat did not end well, by seed:\n\n| | seeds | what it teaches |\n|---|---|---|\n";
    for lesson in &LESSONS {
        let of_lesson = trials.iter().filter(|t| lesson_of(t) == Some(lesson.title));
        let seeds: Vec<String> = of_lesson.map(|t| t.seed.to_string()).collect();
        if !seeds.is_empty() {
            let (count, seeds) = (seeds.len(), seeds.join(", "));
            let _ = writeln!(
                text,
                "| {} ({count}) | {seeds} | {} |",
                lesson.title, lesson.teaches
            );
        }
    }
    let unknown = trials.iter().filter(|t| lesson_of(t) == Some(""));
    for trial in unknown {
        let _ = writeln!(text, "| **Other** | {} | {} |", trial.seed, message(trial));
    }
    text + "\n"
}

/// How many ended how with each integrator.
fn by_integrator(trials: &[Trial]) -> String {
    let mut text =
        "| integrator | runs | with friction | ended well | refused, with a cause | reported | \
                    **wrong** | worst energy, ERROR |\n|---|---|---|---|---|---|---|---|\n"
            .to_owned();
    for integrator in &ALL {
        let own = || trials.iter().filter(|t| t.integrator == integrator.name);
        let count = |is: fn(&Outcome) -> bool| own().filter(|t| is(&t.outcome)).count();
        let energy = own().fold(0.0_f64, |most, t| match t.outcome {
            Outcome::Success { energy } => most.max(energy),
            _ => most,
        });
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} | {energy:.1} |",
            integrator.name,
            own().count(),
            own().filter(|t| t.frictions > 0).count(),
            count(|o| matches!(o, Outcome::Success { .. })),
            count(|o| matches!(o, Outcome::Refused { .. })),
            count(|o| matches!(o, Outcome::Reported { .. })),
            count(|o| matches!(o, Outcome::Wrong { .. })),
        );
    }
    text
}

fn message(trial: &Trial) -> &str {
    match &trial.outcome {
        Outcome::Success { .. } => "",
        Outcome::Refused { message }
        | Outcome::Reported { message }
        | Outcome::Wrong { message } => message,
    }
}

/// The title of what a run teaches, none where it ended well.
fn lesson_of(trial: &Trial) -> Option<&'static str> {
    if matches!(trial.outcome, Outcome::Success { .. }) {
        return None;
    }
    let message = message(trial);
    let lesson = LESSONS.iter().find(|lesson| message.contains(lesson.words));
    Some(lesson.map_or("", |lesson| lesson.title))
}
