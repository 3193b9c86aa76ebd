//! What the friction of a joint did over a run.

use std::fmt;

use super::record::{Record, Records};
use super::sticks::{StickInterval, intervals};
use super::{CAUSES, REGIMES, Units, label, percent, quantity};
use crate::text_table::text_table;

/// More stick intervals than this are not printed.
const PRINTED_STICKS: usize = 20;

/// The largest friction of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Magnitude of the friction force where the joint slides, else of the torque.
    pub value: f64,
    /// When.
    pub time: f64,
    /// Share of each cause in it ([`CAUSES`]), before any limit.
    pub shares: [f64; 4],
}

/// When the limit of the friction force or torque was reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limited {
    /// First output at which it was.
    pub first: f64,
    /// Last one.
    pub last: f64,
    /// Number of outputs.
    pub outputs: usize,
}

/// What the friction of a joint did over a run, from its outputs.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionHistory {
    /// Id of the FRICTION.
    pub id: u32,
    /// Its name.
    pub name: String,
    /// Units of everything here.
    pub units: Units,
    /// Times of the first and last output.
    pub span: [f64; 2],
    /// Number of outputs.
    pub outputs: usize,
    /// Share of the outputs stuck, in transition and sliding.
    pub regimes: [f64; 3],
    /// Number of sticks, counted step by step.
    pub stick_count: usize,
    /// Time spent sticking, counted step by step.
    pub stuck_time: f64,
    /// The stick intervals.
    pub sticks: Vec<StickInterval>,
    /// The largest friction at an output.
    pub peak: Peak,
    /// Share of each cause ([`CAUSES`]) in the friction on average over time, before any limit.
    pub mean_shares: [f64; 4],
    /// Largest creep, or largest bristle deflection of LUGRE.
    pub largest_creep: f64,
    /// Where the limit of the friction was reached.
    pub limited: Option<Limited>,
    /// Work that the friction took out of the motion.
    pub work: f64,
    /// Energy stored in creep or bristles at the end.
    pub stored: f64,
    /// Energy dissipated.
    pub dissipated: f64,
    /// LUGRE alone: drift at the end, by component.
    pub drift: Option<Vec<(String, f64)>>,
}

impl FrictionHistory {
    /// From all outputs; `None` without any.
    pub(super) fn new(records: &Records<'_>) -> Option<Self> {
        let all = records.all();
        let (first, last) = (all.first()?, all.last()?);
        let peak = all.iter().fold(first, |best, record| {
            if record.magnitude() > best.magnitude() {
                record
            } else {
                best
            }
        });
        let mut limits = all.iter().filter(|record| record.limited());
        let limited = limits.next().map(|first| {
            let (last, more) = limits.fold((first, 0), |(_, count), record| (record, count + 1));
            Limited {
                first: first.time(),
                last: last.time(),
                outputs: 1 + more,
            }
        });
        Some(Self {
            id: records.id,
            name: records.name.clone(),
            units: records.units.clone(),
            span: [first.time(), last.time()],
            outputs: all.len(),
            regimes: over_time(&all, |record| {
                let mut regimes = [0.0; 3];
                regimes[record.regime()] = 1.0;
                regimes
            }),
            stick_count: last.sticks(),
            stuck_time: last.stuck_time(),
            sticks: intervals(&all),
            peak: Peak {
                value: peak.magnitude(),
                time: peak.time(),
                shares: shares(peak.causes()),
            },
            mean_shares: over_time(&all, |record| record.causes()),
            largest_creep: last.largest_creep(),
            limited,
            work: last.work(),
            stored: last.stored(),
            dissipated: last.dissipated(),
            drift: records.is_lugre().then(|| last.drifts()),
        })
    }

    /// `FRICTION/3 (HINGE)`.
    #[must_use]
    pub fn label(&self) -> String {
        label(self.id, &self.name)
    }
}

/// Parts of a sum; zeros where there is none.
pub(super) fn shares<const N: usize>(parts: [f64; N]) -> [f64; N] {
    let whole: f64 = parts.iter().sum();
    parts.map(|part| if whole > 0.0 { part / whole } else { 0.0 })
}

/// Shares of what is summed over time by the trapezoidal rule; outputs of one time count alike.
fn over_time<const N: usize>(
    records: &[Record<'_>],
    parts: impl Fn(&Record<'_>) -> [f64; N],
) -> [f64; N] {
    let mut sums = [0.0; N];
    for pair in records.windows(2) {
        let half = 0.5 * (pair[1].time() - pair[0].time());
        let (a, b) = (parts(&pair[0]), parts(&pair[1]));
        for k in 0..N {
            sums[k] += half * (a[k] + b[k]);
        }
    }
    match records {
        [only] => shares(parts(only)),
        _ => shares(sums),
    }
}

impl fmt::Display for FrictionHistory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let units = &self.units;
        let time = |time: f64| format!("{time:.6} {}", units.time);
        writeln!(
            f,
            "{} from {} to {}, {} outputs\n",
            self.label(),
            time(self.span[0]),
            time(self.span[1]),
            self.outputs
        )?;
        let mut facts = vec![
            [
                "dissipated".to_owned(),
                quantity(self.dissipated, &units.energy),
            ],
            [
                "stored at the end".to_owned(),
                quantity(self.stored, &units.energy),
            ],
            [
                "largest friction".to_owned(),
                quantity(self.peak.value, &units.load),
            ],
            ["  at".to_owned(), time(self.peak.time)],
        ];
        for (regime, share) in REGIMES.iter().zip(self.regimes) {
            facts.push([
                (*regime).to_owned(),
                format!("{} of the outputs", percent(share)),
            ]);
        }
        let creep = if self.drift.is_some() {
            "largest bristle deflection"
        } else {
            "largest creep"
        };
        facts.push([
            creep.to_owned(),
            quantity(self.largest_creep, &units.length),
        ]);
        for (component, drift) in self.drift.iter().flatten() {
            let axis = component.trim_start_matches("DRIFT_");
            facts.push([
                format!("drift while stuck, {axis}"),
                quantity(*drift, &units.length),
            ]);
        }
        facts.push([
            "limit of the friction".to_owned(),
            match self.limited {
                None => "never reached".to_owned(),
                Some(limited) => format!(
                    "reached at {} outputs, {} to {}",
                    limited.outputs,
                    time(limited.first),
                    time(limited.last)
                ),
            },
        ]);
        write!(f, "{}", text_table(["", ""], 2, facts))?;
        let heads = ["made by", "on average", "at the largest"];
        let rows = (0..4).map(|k| {
            [
                CAUSES[k].to_owned(),
                percent(self.mean_shares[k]),
                percent(self.peak.shares[k]),
            ]
        });
        write!(f, "\n{}", text_table(heads, 1, rows))?;
        self.write_sticks(f)
    }
}

impl FrictionHistory {
    fn write_sticks(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.sticks.is_empty() {
            return writeln!(f, "\nIt never stuck.");
        }
        let unit = &self.units.time;
        let start = format!("stuck from ({unit})");
        let heads = [start.as_str(), "to", "for", ""];
        let rows = self.sticks.iter().take(PRINTED_STICKS).map(|stick| {
            let remark = match (stick.sticks, stick.end) {
                (1, None) => "to the end".to_owned(),
                (1, Some(_)) => String::new(),
                (several, _) => {
                    format!("{several} sticks, too short to be told apart at the outputs")
                }
            };
            [
                format!("{:.6}", stick.start),
                stick.end.map_or(String::new(), |end| format!("{end:.6}")),
                format!("{:.6}", stick.stuck),
                remark,
            ]
        });
        write!(f, "\n{}", text_table(heads, 0, rows))?;
        if let [_, .., last] = self.sticks.get(PRINTED_STICKS - 1..).unwrap_or_default() {
            let more = self.sticks.len() - PRINTED_STICKS;
            let end = last
                .end
                .map_or("the end".to_owned(), |end| format!("{end:.6}"));
            writeln!(
                f,
                "and {more} more, the last from {:.6} to {end}",
                last.start
            )?;
        }
        Ok(())
    }
}
