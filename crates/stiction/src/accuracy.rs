//! How accurate a run is, told by a second run with a tenth of ERROR.

use dataset::{Code, Severity};
use mechanics::model::{Label, Model};
use mechanics::{Comparison, Deviation, Motion, Spread};
use results::UnitNames;

use crate::about::about;
use crate::message::Message;
use crate::project::Project;
use crate::text_table::text_table;

/// Errors of a step below which an estimate is not told: rounding and Newton's iteration are there.
const FINEST: f64 = 1e-3;
/// Estimates up to this, as a part of the mechanism's length or in radians, can be extrapolated: beyond
/// it both runs are too far apart to tell how errors grow.
const NEAR: f64 = 0.1;
/// The smallest ERROR that is recommended.
const SMALLEST: f64 = 1e-10;

/// How far a run is from a second one with a tenth of ERROR, over all outputs that both have.
#[derive(Clone, Debug, PartialEq)]
pub struct AccuracyReport {
    /// Number of outputs compared.
    pub outputs: usize,
    /// Number of outputs found that only one of the runs has: an event has come at another one.
    pub unmatched: usize,
    /// The largest distance of a centre of mass from where the second run has it; none where nothing
    /// was compared.
    pub distance: Option<BodyDeviation>,
    /// The largest rotation of a body from its orientation in the second run.
    pub rotation: Option<BodyDeviation>,
    /// The first output at which the estimate of the error is above a hundred errors of a step.
    pub inaccurate: Option<BodyDeviation>,
    /// ERROR with which the estimate should come below that, where the two runs allow to tell.
    pub remedy: Option<f64>,
    /// Frictions and differential states.
    pub elements: Vec<ElementDeviation>,
    /// What first failed in the second run.
    pub second_failure: Option<SecondFailure>,
    /// Unit of the times.
    pub time_unit: String,
}

/// Why a second run, or a command of it, did not come to its end.
#[derive(Clone, Debug, PartialEq)]
pub struct SecondFailure {
    /// Time of the model; none where it is not the model that failed.
    pub time: Option<f64>,
    /// Why.
    pub cause: String,
}

/// How far a body is from where the second run has it.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyDeviation {
    /// The body, as text such as `PART/2 (CRANK)`.
    pub body: Label,
    /// Difference of both runs, in `unit`.
    pub difference: f64,
    /// The error that follows from it: twice the difference, or more towards rounding.
    pub estimate: f64,
    /// One error of a step: ERROR times the length of the mechanism for a distance, ERROR radians for a
    /// rotation.
    pub step_error: f64,
    /// The unit of length, or `rad`.
    pub unit: String,
    /// When, in the unit of time.
    pub time: f64,
}

/// The largest difference of a friction or differential state from that of the second run.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementDeviation {
    /// The element, as text such as `FRICTION/3 (HINGE)`.
    pub element: Label,
    /// `force` or `torque` of a friction, `state`.
    pub quantity: &'static str,
    /// Difference of both runs, in `unit`.
    pub difference: f64,
    /// Largest magnitude at an output of the run.
    pub largest: f64,
    /// Unit; empty for states, whose unit no one gives.
    pub unit: String,
    /// When the difference was largest.
    pub time: f64,
}

impl AccuracyReport {
    /// Of the comparison of two runs of a model.
    pub(crate) fn new(comparison: &Comparison, model: &Model, units: &UnitNames) -> Self {
        let body = |deviation: Deviation| BodyDeviation {
            body: model.bodies[deviation.body].label.clone(),
            difference: deviation.difference,
            estimate: deviation.estimate(),
            step_error: deviation.step_error,
            unit: match deviation.motion {
                Motion::Distance => units.length.clone(),
                Motion::Rotation => units.angle.clone(),
            },
            time: deviation.time,
        };
        let element = |element: &Label, quantity, unit: &str, spread: &Spread| ElementDeviation {
            element: element.clone(),
            quantity,
            difference: spread.difference,
            largest: spread.magnitude,
            unit: unit.to_owned(),
            time: spread.time,
        };
        let frictions = model.frictions.iter().zip(&comparison.frictions);
        let frictions = frictions.flat_map(|(friction, [force, torque])| {
            [
                element(&friction.label, "force", &units.force, force),
                element(&friction.label, "torque", &units.torque(), torque),
            ]
        });
        let states = model.states.iter().zip(&comparison.states);
        let states = states.map(|(state, spread)| element(&state.label, "state", "", spread));
        // A hinge has no friction force.
        let elements = frictions.chain(states);
        let elements = elements.filter(|element| element.largest + element.difference != 0.0);
        Self {
            outputs: comparison.instants,
            unmatched: 0,
            distance: comparison.distance.map(body),
            rotation: comparison.rotation.map(body),
            inaccurate: comparison.inaccurate.map(body),
            remedy: None,
            elements: elements.collect(),
            second_failure: None,
            time_unit: units.time.clone(),
        }
    }

    /// Whether the estimate of the error stayed within a hundred errors of a step at all outputs.
    #[must_use]
    pub fn is_accurate(&self) -> bool {
        self.inaccurate.is_none()
    }

    /// How accurate the bodies are, on one line.
    #[must_use]
    pub fn summary(&self) -> String {
        let (Some(distance), Some(rotation)) = (&self.distance, &self.rotation) else {
            return "accuracy: no output of the second run was there to compare".to_owned();
        };
        let word = if self.is_accurate() { "" } else { "only " };
        format!(
            "{word}accurate to about {}, {}, by a second run with a tenth of ERROR",
            distance.words(),
            rotation.words(),
        )
    }

    /// What has to be said beside the figures.
    pub(crate) fn messages(&self, project: &Project) -> Vec<Message> {
        let source = project.model_source();
        let new = |code, element: Option<&Label>, text| {
            let (dataset, severity) = (project.dataset(), Severity::Warning);
            about(dataset, source, severity, code, element, text)
        };
        let inaccurate = self.inaccurate.iter().map(|first| {
            let mut warning = new(Code::Inaccurate, Some(&first.body), self.inaccuracy(first));
            warning
                .note(
                    "results after that time are not those of the model to the accuracy asked for; the \
                     shape of their curves may still be right",
                )
                .note(
                    "ERROR is that of a step: errors of steps add up, and the motion magnifies them",
                )
                .help(self.cure());
            warning
        });
        let failed = self.second_failure.iter().map(|failure| {
            let unit = &self.time_unit;
            let when = failure.time.map(|time| format!(" at time {time:.6} {unit}"));
            let text = format!(
                "the second run, with a tenth of ERROR, failed{}: {}; the accuracy told is that of the \
                 outputs that both runs have",
                when.unwrap_or_default(),
                failure.cause
            );
            let mut warning = new(Code::AccuracyUnknown, None, text);
            warning.help("cure what the second run failed of, or ask with a larger ERROR");
            warning
        });
        let unmatched = (self.unmatched > 0 && self.second_failure.is_none()).then(|| {
            let text = format!(
                "the second run, with a tenth of ERROR, has other outputs, at least {} without a \
                 counterpart of the same time: what ends or changes a simulation, such as a SENSOR, \
                 comes at another output there; the outputs that both runs have are compared",
                self.unmatched
            );
            let mut warning = new(Code::AccuracyUnknown, None, text);
            warning.help("give INTEGRATOR a smaller ERROR, with which the times of events agree");
            warning
        });
        let messages = inaccurate.chain(failed).chain(unmatched);
        messages
            .map(|diagnostic| Message::new(diagnostic, source))
            .collect()
    }

    /// From when on the run is inaccurate, and how inaccurate it becomes.
    fn inaccuracy(&self, first: &BodyDeviation) -> String {
        let time = &self.time_unit;
        let mut text = format!(
            "from time {:.6} {time} on the run is less accurate than 100 ERROR: {} is off by about \
             {:.1e} {} there, {} ERROR",
            first.time,
            first.body,
            first.estimate,
            first.unit,
            first.multiple()
        );
        let worst = [&self.distance, &self.rotation].into_iter().flatten();
        let worst = worst.max_by(|a, b| a.errors().total_cmp(&b.errors()));
        if let Some(worst) = worst.filter(|worst| worst.time != first.time) {
            text += &format!(
                "; {} by {:.1e} {}, {} ERROR, at time {:.6} {time}",
                worst.body,
                worst.estimate,
                worst.unit,
                worst.multiple(),
                worst.time
            );
        }
        text
    }

    /// What to do about it.
    fn cure(&self) -> String {
        match self.remedy {
            Some(error) => format!(
                "INTEGRATOR with ERROR = {error:e} should bring it below a hundred of the present ERROR"
            ),
            None => "give INTEGRATOR a smaller ERROR, or with FIXIT shorter steps; where that does not \
                     help, small causes have large effects here, and no single motion can be predicted \
                     for long"
                .to_owned(),
        }
    }
}

/// The ERROR to recommend where the largest deviation is too large; `error` is that of the run, whose
/// errors are a power `exponent` of it, and `length` the typical length of the model.
pub(crate) fn remedy(largest: Deviation, error: f64, exponent: f64, length: f64) -> Option<f64> {
    let unit = match largest.motion {
        Motion::Distance => length,
        Motion::Rotation => 1.0,
    };
    let smaller = error * largest.remedy(exponent);
    // A power of ten below it; rounding is not to make the next one of it.
    let smaller = 10f64.powf((smaller.log10() + 1e-9).floor());
    (largest.estimate() <= NEAR * unit && smaller >= SMALLEST).then_some(smaller)
}

impl BodyDeviation {
    /// The estimate in errors of a step.
    #[must_use]
    pub fn errors(&self) -> f64 {
        self.estimate / self.step_error
    }

    /// These as text.
    fn multiple(&self) -> String {
        match self.errors() {
            errors if errors < 10.0 => format!("{errors:.2}"),
            errors if errors < 1e5 => format!("{errors:.1}"),
            errors => format!("{errors:.1e}"),
        }
    }

    /// In words, such as `3.1e-6 meter (0.30 ERROR, PART/2 at time 1.25)`.
    fn words(&self) -> String {
        if self.errors() < FINEST {
            let finest = FINEST * self.step_error;
            return format!("{finest:.1e} {} or better ({FINEST} ERROR)", self.unit);
        }
        format!(
            "{:.1e} {} ({} ERROR, {} at time {:.6})",
            self.estimate,
            self.unit,
            self.multiple(),
            self.body,
            self.time
        )
    }
}

/// The [`summary`](AccuracyReport::summary), and a table of frictions and states.
impl std::fmt::Display for AccuracyReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        writeln!(f, "{}", self.summary())?;
        if self.elements.is_empty() {
            return Ok(());
        }
        let heads = ["largest difference of", "", "", "of its largest", "at time"];
        let rows = self.elements.iter().map(|element| {
            [
                element.element.to_string(),
                element.quantity.to_owned(),
                format!("{:.2e} {}", element.difference, element.unit)
                    .trim_end()
                    .to_owned(),
                format!("{:.2e}", element.part()),
                format!("{:.4} {}", element.time, self.time_unit),
            ]
        });
        f.write_str(&text_table(heads, 2, rows))
    }
}

impl ElementDeviation {
    /// The difference as a part of the largest magnitude; infinite where the run has none.
    #[must_use]
    pub fn part(&self) -> f64 {
        self.difference / self.largest
    }
}
