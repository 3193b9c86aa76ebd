//! SENSORs: events that are looked for at the outputs of a simulation.

use std::io::Write;

use dataset::{Comparison, Dataset, Sensor, Switchable};
use mechanics::expression::Program;
use mechanics::{Observer, Snapshot, StepReport};

use crate::lower::Outputs;
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
    function: Program,
    /// Function less VALUE at the output before.
    before: Option<f64>,
    /// Whether the event held at the output before.
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
}

impl Event {
    fn new(sensor: &Sensor, time: f64, function: f64) -> Self {
        let (effect, then) = match (sensor.halts, sensor.returns) {
            (true, _) => (Effect::Halt, "; HALT: the run ends here"),
            (false, true) => (Effect::Return, "; RETURN: the simulation ends here"),
            (false, false) => (Effect::None, ""),
        };
        let text = format!(
            "SENSOR/{} at time {time}: its function is {function} ({} {}){then}",
            sensor.header.id,
            sensor.comparison.keyword(),
            sensor.value,
        );
        Self { effect, text }
    }
}

impl Sensors {
    /// The active sensors of a dataset, whose functions are in `outputs`.
    pub(crate) fn new(dataset: &Dataset, outputs: &Outputs) -> Self {
        let all = dataset.sensors.iter().zip(&outputs.sensors);
        let active =
            all.filter(|(sensor, _)| dataset.is_active(Switchable::Sensor, sensor.header.id));
        Self {
            watched: active
                .map(|(sensor, function)| Watched {
                    sensor: sensor.clone(),
                    function: function.clone(),
                    before: None,
                    held: false,
                })
                .collect(),
            outputs: outputs.clone(),
        }
    }

    /// The events that begin at an instant. One of EQ is also that the function has passed VALUE
    /// since the output before; none is told again while it lasts.
    pub(crate) fn events(&mut self, wrenches: &Wrenches<'_>) -> Vec<Event> {
        let snapshot = wrenches.snapshot();
        let mut events = Vec::new();
        for watched in &mut self.watched {
            let sensor = &watched.sensor;
            let results = |number: usize| self.outputs.results[number].value(wrenches);
            let function = snapshot.evaluate(&watched.function, &results);
            let difference = function - sensor.value;
            let holds = match sensor.comparison {
                Comparison::GreaterOrEqual => difference >= -sensor.error,
                Comparison::LessOrEqual => difference <= sensor.error,
                Comparison::Equal => {
                    let passed = watched
                        .before
                        .is_some_and(|before| before * difference < 0.0);
                    passed || difference.abs() <= sensor.error
                }
            };
            watched.before = Some(difference);
            if holds && !watched.held {
                events.push(Event::new(sensor, snapshot.time(), function));
            }
            watched.held = holds;
        }
        events
    }
}

/// Takes steps and outputs to the files and looks for events at the outputs.
pub(crate) struct Sensing<'a, 'p, W: Write> {
    pub(crate) rows: Observe<'a, 'p, W>,
    pub(crate) sensors: &'a mut Sensors,
    /// What events have done to the run.
    pub(crate) effect: Effect,
}

impl<W: Write> Observer for Sensing<'_, '_, W> {
    fn step(&mut self, report: &StepReport) -> bool {
        self.rows.step(report)
    }

    fn output(&mut self, snapshot: &Snapshot<'_>) -> bool {
        let wrenches = Wrenches::new(snapshot);
        if !self.rows.output(&wrenches) {
            return false;
        }
        for event in self.sensors.events(&wrenches) {
            if let Err(error) = self.rows.log.note(&event.text) {
                self.rows.stop = Some(Stop::Output(error));
                return false;
            }
            self.effect = self.effect.max(event.effect);
        }
        self.effect == Effect::None
    }
}
