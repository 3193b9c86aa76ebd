//! The table of friction that a run ends with.

use dataset::{Code, Severity};
use friction::Effect;
use mechanics::model::{Label, Law};
use mechanics::{Snapshot, Tally};
use results::UnitNames;
use serde::{Deserialize, Serialize};

use crate::friction_detail::number;
use crate::text_table::text_table;
use crate::wrenches::Wrenches;

/// A drift above this part of the largest bristle deflection is told: below it is what the steps of
/// the integrator leave open.
const DRIFT: f64 = 1e-6;

/// Surfaces that have moved so many times the largest creep have not just crept.
const FAR: f64 = 10.0;

/// What the friction of one joint did during a run.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionReport {
    /// The FRICTION, as text such as `FRICTION/3 (HINGE)`.
    pub friction: Label,
    /// Its joint.
    pub joint: String,
    /// Largest magnitude of the friction force (sliding joint) or torque at an output.
    pub peak: f64,
    /// Time of the peak.
    pub peak_time: f64,
    /// Unit of time.
    pub time_unit: String,
    /// Unit of the peak.
    pub unit: String,
    /// Unit of the energy.
    pub energy_unit: String,
    /// Unit of creep and drift.
    pub length_unit: String,
    /// Outputs stuck, in transition and sliding.
    pub regimes: [usize; 3],
    /// Outputs at which the limit of the friction force or torque was reached.
    pub clipped: usize,
    /// Work that friction took out of the motion, as the integrator integrates it, force × length;
    /// it holds what is stored in the creep.
    pub work: f64,
    /// The energy that it dissipated: the work less what is stored.
    pub energy: f64,
    /// What happened step by step: stick intervals, largest creep, drift.
    pub tally: Tally,
    /// Its law.
    pub law: Law,
    /// Highest speed of the sliding surfaces at an output, length/time.
    pub fastest: f64,
    /// How far the surfaces have moved over each other, by their speeds at outputs.
    pub path: f64,
    /// Time and speed of the surfaces at the last output.
    last: (f64, f64),
}

impl FrictionReport {
    /// Whether it is LUGRE, which drifts.
    #[must_use]
    pub fn is_lugre(&self) -> bool {
        matches!(self.law, Law::LuGre(_))
    }

    /// What a user of the law should know of this run: LUGRE drifts, and its damping may give energy
    /// back; ORIGINAL may have moved at creeping speed only.
    #[must_use]
    pub fn remarks(&self) -> Vec<(Severity, Code, String)> {
        let tally = &self.tally;
        let mut remarks = Vec::new();
        remarks.extend(self.never_slides());
        let drift = tally.drift.iter().fold(0.0, |sum: f64, d| sum.hypot(*d));
        if self.is_lugre() && drift > DRIFT * tally.largest_creep {
            let text = format!(
                "{}: LUGRE has drifted by {drift:.3e} {} while the joint stuck, {:.3e} times the \
                 largest deflection of its bristles; ORIGINAL holds without drift",
                self.friction,
                self.length_unit,
                drift / tally.largest_creep
            );
            remarks.push((Severity::Note, Code::BristleDrift, text));
        }
        if let Some(time) = tally.not_passive {
            let text = format!(
                "{}: from time {time:.6} {} on DAMPING_COEFFICIENT is above 4 G/v, G being the level of \
                 the friction and v the speed of the surfaces: the bristles may give energy back to \
                 the motion; a smaller DAMPING_COEFFICIENT avoids it",
                self.friction, self.time_unit
            );
            remarks.push((Severity::Note, Code::BristlesNotPassive, text));
        }
        remarks
    }

    /// Surfaces that went far and were slower than the transition velocity at every step.
    fn never_slides(&self) -> Option<(Severity, Code, String)> {
        let Law::Original(law) = self.law else {
            return None;
        };
        let tally = &self.tally;
        let stuck = tally.sticking && tally.stick_end.is_none() && tally.sticks == 1;
        let far = self.path > FAR * law.max_deformation;
        if !stuck || !far || law.effect == Effect::Sliding {
            return None;
        }
        let (length, time) = (&self.length_unit, &self.time_unit);
        let text = format!(
            "{} never slides: its surfaces have moved {:.3e} {length} at up to {:.3e} {length}/{time}, \
             always below STICTION_TRANSITION_VELOCITY = {:e}, so that MU_DYNAMIC had no part in it; \
             give a transition velocity well below the speeds of the joint",
            self.friction, self.path, self.fastest, law.transition_velocity
        );
        Some((Severity::Warning, Code::NeverSlides, text))
    }
}

/// What outputs change of a [`FrictionReport`].
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Counted {
    peak: (f64, f64),
    regimes: [usize; 3],
    clipped: usize,
    energies: (f64, f64),
    tally: Tally,
    fastest: f64,
    path: f64,
    last: (f64, f64),
}

impl FrictionReport {
    pub(crate) fn counted(&self) -> Counted {
        Counted {
            peak: (self.peak, self.peak_time),
            regimes: self.regimes,
            clipped: self.clipped,
            energies: (self.work, self.energy),
            tally: self.tally,
            fastest: self.fastest,
            path: self.path,
            last: self.last,
        }
    }

    pub(crate) fn set_counted(&mut self, counted: Counted) {
        (self.peak, self.peak_time) = counted.peak;
        (self.regimes, self.clipped) = (counted.regimes, counted.clipped);
        (self.work, self.energy) = counted.energies;
        self.tally = counted.tally;
        (self.fastest, self.path, self.last) = (counted.fastest, counted.path, counted.last);
    }
}

/// An empty report for each friction of a model.
pub(crate) fn reports(snapshot: &Snapshot<'_>, units: &UnitNames) -> Vec<FrictionReport> {
    let model = snapshot.model();
    let report = |friction: &mechanics::model::Friction| FrictionReport {
        friction: friction.label.clone(),
        joint: model.joints[friction.joint].label.to_string(),
        peak: 0.0,
        peak_time: snapshot.time(),
        time_unit: units.time.clone(),
        unit: if friction.load.has_force_load() {
            units.force.clone()
        } else {
            units.torque()
        },
        energy_unit: units.energy(),
        length_unit: units.length.clone(),
        regimes: [0; 3],
        clipped: 0,
        work: 0.0,
        energy: 0.0,
        tally: Tally::default(),
        law: friction.law,
        fastest: 0.0,
        path: 0.0,
        last: (snapshot.time(), 0.0),
    };
    model.frictions.iter().map(report).collect()
}

/// Adds an output, up to which the frictions have dissipated so much, to their reports.
pub(crate) fn add(reports: &mut [FrictionReport], wrenches: &Wrenches<'_>, dissipated: &[f64]) {
    let snapshot = wrenches.snapshot();
    for (place, (report, &energy)) in reports.iter_mut().zip(dissipated).enumerate() {
        let values = wrenches.friction(place);
        let slides = snapshot.model().frictions[place].load.has_force_load();
        let force = if slides { values.force } else { values.torque };
        if force.norm() > report.peak {
            report.peak = force.norm();
            report.peak_time = snapshot.time();
        }
        report.regimes[number(values.regime)] += 1;
        report.clipped += usize::from(values.clipped);
        let (time, speed) = (snapshot.time(), values.velocity.norm());
        let (before, slower) = std::mem::replace(&mut report.last, (time, speed));
        // RELOAD goes back in time.
        report.path += (time - before).max(0.0) * 0.5 * (speed + slower);
        report.fastest = report.fastest.max(speed);
        report.work = snapshot.works()[place];
        report.energy = energy;
        report.tally = *snapshot.tally(place);
    }
}

/// The reports as a table for people.
///
/// ```
/// assert_eq!(stiction::friction_table(&[]), "");
/// ```
#[must_use]
pub fn friction_table(reports: &[FrictionReport]) -> String {
    if reports.is_empty() {
        return String::new();
    }
    let heads = [
        "friction",
        "joint",
        "peak",
        "at time",
        "stuck",
        "trans.",
        "sliding",
        "sticks",
        "largest creep",
        "dissipated",
    ];
    let rows = reports.iter().map(|report| {
        let outputs: usize = report.regimes.iter().sum();
        let share = |count: usize| format!("{:.0} %", 100.0 * count as f64 / outputs.max(1) as f64);
        let clipped = if report.clipped > 0 { " (limited)" } else { "" };
        [
            report.friction.to_string(),
            report.joint.clone(),
            format!("{:.4e} {}{clipped}", report.peak, report.unit),
            format!("{:.4} {}", report.peak_time, report.time_unit),
            share(report.regimes[0]),
            share(report.regimes[1]),
            share(report.regimes[2]),
            report.tally.sticks.to_string(),
            format!("{:.3e} {}", report.tally.largest_creep, report.length_unit),
            format!("{:.3e} {}", report.energy, report.energy_unit),
        ]
    });
    text_table(heads, 2, rows)
}
