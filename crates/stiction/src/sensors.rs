//! SENSORs: events that are looked for at the outputs of a motion.

use std::io::Write;

use dataset::{Comparison, Dataset, Sensor, Switchable};
use mechanics::expression::Program;
use mechanics::{Observer, Snapshot, StepReport};

use crate::lower::Outputs;
use crate::recorder::{Observe, Stop};
use crate::wrenches::Wrenches;

/// The active sensors of a simulation.
#[derive(Clone, Debug)]
pub(crate) struct Sensors<'a> {
    watched: Vec<Watched<'a>>,
    outputs: Outputs,
}

/// A sensor while a simulation runs.
#[derive(Clone, Debug)]
struct Watched<'a> {
    sensor: &'a Sensor,
    function: Program,
    /// Function less VALUE at the output before.
    before: Option<f64>,
    /// Whether the event held at the output before.
    held: bool,
}

/// A sensor whose event has occurred.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Event<'a> {
    /// The sensor.
    pub(crate) sensor: &'a Sensor,
    /// When.
    time: f64,
    /// The value of its function.
    function: f64,
}

impl Event<'_> {
    /// Whether it ends the simulation.
    pub(crate) fn ends(&self) -> bool {
        self.sensor.returns || self.sensor.halts
    }
}

impl std::fmt::Display for Event<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Sensor {
            header,
            comparison,
            value,
            ..
        } = self.sensor;
        let then = match (self.sensor.halts, self.sensor.returns) {
            (true, _) => "; HALT: the run ends here",
            (false, true) => "; RETURN: the simulation ends here",
            (false, false) => "",
        };
        write!(
            f,
            "SENSOR/{} at time {}: its function is {} ({} {value}){then}",
            header.id,
            self.time,
            self.function,
            comparison.keyword(),
        )
    }
}

impl<'a> Sensors<'a> {
    /// The active sensors of a dataset, whose functions are in `outputs`.
    pub(crate) fn new(dataset: &'a Dataset, outputs: &Outputs) -> Self {
        let all = dataset.sensors.iter().zip(&outputs.sensors);
        let active =
            all.filter(|(sensor, _)| dataset.is_active(Switchable::Sensor, sensor.header.id));
        Self {
            watched: active
                .map(|(sensor, function)| Watched {
                    sensor,
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
    pub(crate) fn events(&mut self, snapshot: &Snapshot<'_>) -> Vec<Event<'a>> {
        if self.watched.is_empty() {
            return Vec::new();
        }
        let wrenches = Wrenches::new(snapshot);
        let mut events = Vec::new();
        for watched in &mut self.watched {
            let sensor = watched.sensor;
            let results = |number: usize| self.outputs.results[number].value(&wrenches);
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
            if holds && !std::mem::replace(&mut watched.held, holds) {
                events.push(Event {
                    sensor,
                    time: snapshot.time(),
                    function,
                });
            }
            watched.held = holds;
        }
        events
    }
}

/// Takes steps and outputs to the files and looks for events at the outputs.
pub(crate) struct Sensing<'a, 's, W: Write> {
    pub(crate) rows: Observe<'a, W>,
    pub(crate) sensors: Sensors<'s>,
    /// The event that ended the simulation.
    pub(crate) ended: Option<Event<'s>>,
}

impl<W: Write> Observer for Sensing<'_, '_, W> {
    fn step(&mut self, report: &StepReport) -> bool {
        self.rows.step(report)
    }

    fn output(&mut self, snapshot: &Snapshot<'_>) -> bool {
        if !self.rows.output(snapshot) {
            return false;
        }
        for event in self.sensors.events(snapshot) {
            if let Err(error) = self.rows.log.note(&event.to_string()) {
                self.rows.stop = Some(Stop::Output(error));
                return false;
            }
            if event.ends() {
                self.ended = Some(event);
            }
        }
        self.ended.is_none()
    }
}
