//! Reductions: one number of a run, such as `max_abs(guide.force)`.

use stiction::sink::{DataKind, Header, Layout, Sink};
use stiction::{ArgumentError, OutputError, Project, RunReport};

use crate::channel::{self, Channel};

/// What is made of the values of a channel, or of the sticks of a friction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Min,
    Max,
    MaxAbs,
    Mean,
    Last,
    StuckShare,
    LongestStick,
}

/// Names of the reductions.
const KINDS: [(&str, Kind); 7] = [
    ("min", Kind::Min),
    ("max", Kind::Max),
    ("max_abs", Kind::MaxAbs),
    ("mean", Kind::Mean),
    ("last", Kind::Last),
    ("stuck_share", Kind::StuckShare),
    ("longest_stick", Kind::LongestStick),
];

#[derive(Clone, Debug, PartialEq)]
enum Source {
    Channel(Channel),
    /// Place of a friction.
    Sticks(usize),
}

/// A reduction of a model.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Reduction {
    kind: Kind,
    source: Source,
    /// Unit of the number, empty for a plain one.
    pub(crate) unit: String,
}

impl Reduction {
    /// Reads a reduction.
    pub(crate) fn new(
        text: &str,
        project: &Project,
        layout: &Layout,
    ) -> Result<Self, ArgumentError> {
        let parts = text
            .trim()
            .strip_suffix(')')
            .and_then(|text| text.split_once('('));
        let Some((name, of)) = parts else {
            return Err(ArgumentError::Value(format!(
                "{text:?} is no reduction; write it as max_abs(guide.force) or longest_stick(guide)"
            )));
        };
        let (name, of) = (name.trim(), of.trim());
        let found = KINDS
            .iter()
            .find(|(known, _)| known.eq_ignore_ascii_case(name));
        let Some((_, kind)) = found else {
            return Err(ArgumentError::Unknown {
                what: "reduction",
                name: name.to_owned(),
                known: KINDS.map(|(name, _)| name.to_owned()).into(),
            });
        };
        let (source, unit) = match kind {
            Kind::StuckShare | Kind::LongestStick => {
                let source = Source::Sticks(channel::friction(project, layout, of)?);
                let unit = match kind {
                    Kind::LongestStick => project.unit_names().time,
                    _ => String::new(),
                };
                (source, unit)
            }
            _ => {
                let channel = channel::find(project, layout, of)?;
                let unit = channel.unit.clone();
                (Source::Channel(channel), unit)
            }
        };
        Ok(Self {
            kind: *kind,
            source,
            unit,
        })
    }
}

/// What has been seen of a channel.
#[derive(Clone, Copy, Debug)]
struct Seen {
    least: f64,
    most: f64,
    last: f64,
    /// Integral over time.
    integral: f64,
}

/// Takes the rows of a run and reduces them.
pub(crate) struct Reducer<'a> {
    reductions: Vec<&'a Reduction>,
    seen: Vec<Option<Seen>>,
    /// First and last time.
    times: Option<(f64, f64)>,
}

impl<'a> Reducer<'a> {
    pub(crate) fn new(reductions: Vec<&'a Reduction>) -> Self {
        Self {
            seen: vec![None; reductions.len()],
            reductions,
            times: None,
        }
    }

    /// The numbers, after a run that gave this report; `None` where a run had no output.
    pub(crate) fn values(&self, report: &RunReport) -> Vec<Option<f64>> {
        let each = self.reductions.iter().zip(&self.seen);
        each.map(|(reduction, seen)| self.value(reduction, seen.as_ref(), report))
            .collect()
    }

    fn value(&self, reduction: &Reduction, seen: Option<&Seen>, report: &RunReport) -> Option<f64> {
        let (first, last) = self.times?;
        let duration = last - first;
        match reduction.source {
            Source::Channel(_) => {
                let seen = seen?;
                Some(match reduction.kind {
                    Kind::Min => seen.least,
                    Kind::Max => seen.most,
                    Kind::MaxAbs => seen.least.abs().max(seen.most.abs()),
                    Kind::Mean if duration > 0.0 => seen.integral / duration,
                    _ => seen.last,
                })
            }
            Source::Sticks(place) => {
                let tally = &report.frictions.get(place)?.tally;
                let present = match tally.sticking {
                    true => last - tally.stick_start,
                    false => 0.0,
                };
                Some(match reduction.kind {
                    Kind::LongestStick => tally.longest_stick.max(present),
                    _ if duration > 0.0 => tally.stuck_time / duration,
                    _ => f64::from(u8::from(tally.sticking)),
                })
            }
        }
    }
}

impl Sink for Reducer<'_> {
    fn begin(&mut self, _: &Header, _: &Layout) -> Result<(), OutputError> {
        Ok(())
    }

    fn row(&mut self, _: DataKind, time: f64, values: &[f64]) -> Result<(), OutputError> {
        let before = self.times.map(|(_, last)| last);
        let step = before.map_or(0.0, |before| time - before);
        for (reduction, seen) in self.reductions.iter().zip(&mut self.seen) {
            let Source::Channel(channel) = &reduction.source else {
                continue;
            };
            let value = channel.value(values);
            let seen = seen.get_or_insert(Seen {
                least: value,
                most: value,
                last: value,
                integral: 0.0,
            });
            // The value is taken linear between two outputs.
            seen.integral += 0.5 * step * (seen.last + value);
            seen.least = seen.least.min(value);
            seen.most = seen.most.max(value);
            seen.last = value;
        }
        let first = self.times.map_or(time, |(first, _)| first);
        self.times = Some((first, time));
        Ok(())
    }
}
