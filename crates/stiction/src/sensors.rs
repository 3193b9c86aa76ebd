//! SENSORs: events that are looked for at the outputs of a simulation.

use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;

use dataset::{Comparison, Dataset, Sensor, Switchable};
use mechanics::expression::Program;
use mechanics::{Observer, Snapshot, StepReport};
use serde::{Deserialize, Serialize};

use crate::lower::{Lowered, Outputs};
use crate::recorder::{Observe, Stop};
use crate::wrenches::Wrenches;

/// The active sensors of a simulation.
#[derive(Clone, Debug)]
pub(crate) struct Sensors {
    watched: Vec<Watched>,
    outputs: Outputs,
}

/// A sensor while a simulation runs.
#[derive(Clone, Debug)]
struct Watched {
    sensor: Sensor,
    /// Place among the sensors of the dataset.
    place: usize,
    function: Program,
    /// EVALUATE.
    evaluate: Option<Program>,
    last: Held,
}

/// What a sensor found at the output before.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Held {
    /// Function less VALUE.
    before: Option<f64>,
    /// Whether the event held.
    held: bool,
}

/// What an event does to a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Effect {
    /// Nothing.
    None,
    /// RETURN: it ends the simulation.
    Return,
    /// HALT: it ends the run.
    Halt,
}

/// A sensor whose event has occurred.
#[derive(Clone, Debug)]
pub(crate) struct Event {
    /// What it does.
    pub(crate) effect: Effect,
    /// What to tell about it.
    pub(crate) text: String,
    /// The sensor and what it keeps, if anything.
    pub(crate) keeps: Option<(u32, f64)>,
}

impl Event {
    fn new(sensor: &Sensor, time: f64, function: f64, evaluated: Option<f64>) -> Self {
        let (effect, then) = match (sensor.halts, sensor.returns) {
            (true, _) => (Effect::Halt, "; HALT: the run ends here"),
            (false, true) => (Effect::Return, "; RETURN: the simulation ends here"),
            (false, false) => (Effect::None, ""),
        };
        let id = sensor.header.id;
        let kept = evaluated.map_or_else(String::new, |value| format!(", SENVAL({id}) is {value}"));
        let text = format!(
            "SENSOR/{id} at time {time}: its function is {function} ({} {}){kept}{then}",
            sensor.comparison.keyword(),
            sensor.value,
        );
        Self {
            effect,
            text,
            keeps: evaluated.map(|value| (id, value)),
        }
    }
}

impl Sensors {
    /// The active sensors of a dataset, whose functions are in `outputs`.
    pub(crate) fn new(dataset: &Dataset, outputs: &Outputs) -> Self {
        let all = dataset.sensors.iter().zip(&outputs.sensors).enumerate();
        let active =
            all.filter(|(_, (sensor, _))| dataset.is_active(Switchable::Sensor, sensor.header.id));
        Self {
            watched: active
                .map(|(place, (sensor, (function, evaluate)))| Watched {
                    sensor: sensor.clone(),
                    place,
                    function: function.clone(),
                    evaluate: evaluate.clone(),
                    last: Held::default(),
                })
                .collect(),
            outputs: outputs.clone(),
        }
    }

    /// What they found at the output before.
    pub(crate) fn held(&self) -> Vec<Held> {
        self.watched.iter().map(|watched| watched.last).collect()
    }

    /// Takes over what they found at the output before.
    pub(crate) fn hold(&mut self, held: &[Held]) {
        for (watched, last) in self.watched.iter_mut().zip(held) {
            watched.last = *last;
        }
    }

    /// Takes over functions that have been lowered anew.
    pub(crate) fn renew(&mut self, outputs: &Outputs) {
        for watched in &mut self.watched {
            let (function, evaluate) = outputs.sensors[watched.place].clone();
            (watched.function, watched.evaluate) = (function, evaluate);
        }
        self.outputs = outputs.clone();
    }

    /// The events that begin at an instant. One of EQ is also that the function has passed VALUE
    /// since the output before; none is told again while it lasts.
    ///
    /// # Errors
    /// What to say of a function that is not a number, which no comparison holds for.
    pub(crate) fn events(&mut self, wrenches: &Wrenches<'_>) -> Result<Vec<Event>, String> {
        let snapshot = wrenches.snapshot();
        let mut events = Vec::new();
        for watched in &mut self.watched {
            let sensor = &watched.sensor;
            let results = |number: usize| self.outputs.results[number].value(wrenches);
            let function = snapshot.evaluate(&watched.function, &results);
            if function.is_nan() {
                return Err(format!(
                    "SENSOR/{} at time {}: its function is not a number",
                    sensor.header.id,
                    snapshot.time()
                ));
            }
            let difference = function - sensor.value;
            let holds = match sensor.comparison {
                Comparison::GreaterOrEqual => difference >= -sensor.error,
                Comparison::LessOrEqual => difference <= sensor.error,
                Comparison::Equal => {
                    let passed = watched
                        .last
                        .before
                        .is_some_and(|before| before * difference < 0.0);
                    passed || difference.abs() <= sensor.error
                }
            };
            watched.last.before = Some(difference);
            if holds && !watched.last.held {
                let evaluate = watched.evaluate.as_ref();
                let evaluated = evaluate.map(|function| snapshot.evaluate(function, &results));
                events.push(Event::new(sensor, snapshot.time(), function, evaluated));
            }
            watched.last.held = holds;
        }
        Ok(events)
    }
}

/// Takes up what sensors keep.
pub(crate) struct Keeping<'a> {
    reads: &'a BTreeSet<u32>,
    kept: &'a mut BTreeMap<u32, f64>,
    /// Whether functions of the model have become other ones.
    pub(crate) changes_functions: bool,
}

impl<'a> Keeping<'a> {
    /// Into `kept`, of the sensors that a lowered model reads and of the others.
    pub(crate) fn new(lowered: &'a Lowered, kept: &'a mut BTreeMap<u32, f64>) -> Self {
        Self {
            reads: &lowered.reads_sensors,
            kept,
            changes_functions: false,
        }
    }

    fn take(&mut self, (id, value): (u32, f64)) {
        let before = self.kept.insert(id, value);
        self.changes_functions |= self.reads.contains(&id) && before != Some(value);
    }
}

/// Takes steps and outputs to the files and looks for events at the outputs.
pub(crate) struct Sensing<'a, 'p, W: Write> {
    pub(crate) rows: Observe<'a, 'p, W>,
    pub(crate) sensors: &'a mut Sensors,
    /// What events have done to the run.
    pub(crate) effect: Effect,
    pub(crate) keeping: Keeping<'a>,
}

impl<W: Write> Observer for Sensing<'_, '_, W> {
    fn step(&mut self, report: &StepReport) -> bool {
        self.rows.step(report)
    }

    fn pauses(&mut self) -> bool {
        self.rows.pauses()
    }

    fn output(&mut self, snapshot: &Snapshot<'_>) -> bool {
        let wrenches = Wrenches::new(snapshot);
        if !self.rows.output(&wrenches) {
            return false;
        }
        let events = match self.sensors.events(&wrenches) {
            Ok(events) => events,
            Err(text) => {
                self.rows.stop = Some(Stop::NotFinite(text));
                return false;
            }
        };
        for event in events {
            let told = if event.keeps.is_some_and(|(_, value)| !value.is_finite()) {
                Err(Stop::NotFinite(format!(
                    "{}: EVALUATE gives no finite number",
                    event.text
                )))
            } else {
                self.rows.log.note(&event.text).map_err(Stop::Output)
            };
            if let Err(stop) = told {
                self.rows.stop = Some(stop);
                return false;
            }
            self.effect = self.effect.max(event.effect);
            if let Some(keeps) = event.keeps {
                self.keeping.take(keeps);
            }
        }
        self.effect == Effect::None && !self.keeping.changes_functions
    }
}
