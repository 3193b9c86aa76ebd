//! The table of friction that a run ends with.

use friction::Regime;
use mechanics::Snapshot;
use results::UnitNames;

/// What the friction of one joint did during a run, seen at the output times.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionReport {
    /// The FRICTION, such as `FRICTION/3 (HINGE)`.
    pub friction: String,
    /// Its joint.
    pub joint: String,
    /// Largest magnitude of the friction force (sliding joint) or torque.
    pub peak: f64,
    /// Time of the peak.
    pub peak_time: f64,
    /// Unit of time.
    pub time_unit: String,
    /// Unit of the peak.
    pub unit: String,
    /// Unit of the energy.
    pub energy_unit: String,
    /// Outputs stuck, in transition and sliding.
    pub regimes: [usize; 3],
    /// Outputs at which the limit of the friction force or torque was reached.
    pub clipped: usize,
    /// Work done against friction by the trapezoidal rule over the outputs, force × length; it
    /// holds what is stored in the creep.
    pub energy: f64,
    last: Option<(f64, f64)>,
}

/// An empty report for each friction of a model.
pub(crate) fn reports(snapshot: &Snapshot<'_>, units: &UnitNames) -> Vec<FrictionReport> {
    let model = snapshot.model();
    let report = |friction: &mechanics::model::Friction| FrictionReport {
        friction: friction.label.to_string(),
        joint: model.joints[friction.joint].label.to_string(),
        peak: 0.0,
        peak_time: snapshot.time(),
        time_unit: units.time.clone(),
        unit: if friction.load.has_force_load() {
            units.force.clone()
        } else {
            units.torque()
        },
        energy_unit: units.torque(),
        regimes: [0; 3],
        clipped: 0,
        energy: 0.0,
        last: None,
    };
    model.frictions.iter().map(report).collect()
}

/// Adds an output to the reports of a model's frictions.
pub(crate) fn add(reports: &mut [FrictionReport], snapshot: &Snapshot<'_>) {
    for (place, report) in reports.iter_mut().enumerate() {
        let values = snapshot.friction(place);
        let slides = snapshot.model().frictions[place].load.has_force_load();
        let force = if slides { values.force } else { values.torque };
        let power = values.power;
        if force.norm() > report.peak {
            report.peak = force.norm();
            report.peak_time = snapshot.time();
        }
        report.regimes[match values.regime {
            Regime::Stuck => 0,
            Regime::Transition => 1,
            Regime::Sliding => 2,
        }] += 1;
        report.clipped += usize::from(values.clipped);
        if let Some((time, before)) = report.last {
            report.energy += 0.5 * (power + before) * (snapshot.time() - time);
        }
        report.last = Some((snapshot.time(), power));
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
        "friction", "joint", "peak", "at time", "stuck", "trans.", "sliding", "energy",
    ];
    let mut rows = vec![heads.map(str::to_owned)];
    for report in reports {
        let outputs: usize = report.regimes.iter().sum();
        let share = |count: usize| format!("{:.0} %", 100.0 * count as f64 / outputs.max(1) as f64);
        let clipped = if report.clipped > 0 { " (limited)" } else { "" };
        rows.push([
            report.friction.clone(),
            report.joint.clone(),
            format!("{:.4e} {}{clipped}", report.peak, report.unit),
            format!("{:.4} {}", report.peak_time, report.time_unit),
            share(report.regimes[0]),
            share(report.regimes[1]),
            share(report.regimes[2]),
            format!("{:.3e} {}", report.energy, report.energy_unit),
        ]);
    }
    let width = |k: usize| {
        rows.iter()
            .map(|row| row[k].chars().count())
            .max()
            .unwrap_or(0)
    };
    let widths: [usize; 8] = std::array::from_fn(width);
    let mut table = String::new();
    for row in &rows {
        let cells = row
            .iter()
            .zip(widths)
            .enumerate()
            .map(|(k, (cell, width))| {
                if k < 2 {
                    format!("{cell:<width$}")
                } else {
                    format!("{cell:>width$}")
                }
            });
        let line: Vec<String> = cells.collect();
        table += line.join("  ").trim_end();
        table.push('\n');
    }
    table
}
