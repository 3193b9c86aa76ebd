//! LINEAR/EIGENSOL: the modes of the model at the present instant.

use dataset::Eigensolution;
use mechanics::linearization::Mode;
use serde::{Deserialize, Serialize};

use crate::failure;
use crate::lower;
use crate::project::second;
use crate::runner::{Halt, Runner};
use crate::session::{Outcome, OutputError};
use crate::text_table::text_table;

/// What moves, for a component of the small motion of a body.
const COMPONENTS: [&str; 6] = ["X", "Y", "Z", "about X", "about Y", "about Z"];

/// The modes that a LINEAR/EIGENSOL found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModeReport {
    /// Time of the model.
    pub time: f64,
    /// Real eigenvalues and then conjugate pairs, each by magnitude.
    pub modes: Vec<ModeLine>,
}

/// A mode of a [`ModeReport`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModeLine {
    /// Real and imaginary part of the eigenvalue, cycles/second; of a conjugate pair the one with
    /// the positive imaginary part.
    pub value: [f64; 2],
    /// What moves most: a part and a direction. None with NOVECTOR.
    pub moves: Option<String>,
}

impl ModeLine {
    /// Magnitude of the eigenvalue, cycles/second: the frequency that the mode would have without
    /// damping.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        self.value[0].hypot(self.value[1])
    }

    /// Damping ratio, negative for a mode that grows; zero for one without a frequency.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        if self.frequency() == 0.0 {
            0.0
        } else {
            -self.value[0] / self.frequency()
        }
    }
}

impl std::fmt::Display for ModeReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        writeln!(f, "modes at time {}:", self.time)?;
        if self.modes.is_empty() {
            return writeln!(f, "none: the model has no degrees of freedom");
        }
        let heads = [
            "mode",
            "moves most",
            "Hz",
            "damping ratio",
            "real (Hz)",
            "imaginary (Hz)",
        ];
        let rows = self.modes.iter().enumerate().map(|(place, mode)| {
            [
                (place + 1).to_string(),
                mode.moves.clone().unwrap_or_default(),
                format!("{:.6e}", mode.frequency()),
                without_sign_of_zero(format!("{:.4}", mode.damping_ratio())),
                // Adding zero makes the zero of an undamped mode a plain one.
                format!("{:.6e}", mode.value[0] + 0.0),
                format!("{:.6e}", mode.value[1]),
            ]
        });
        f.write_str(&text_table(heads, 2, rows))
    }
}

/// A number as it is written, but a zero without a sign.
fn without_sign_of_zero(text: String) -> String {
    match text.strip_prefix('-') {
        Some(zero) if zero.parse() == Ok(0.0) => zero.to_owned(),
        _ => text,
    }
}

impl Runner<'_> {
    /// Linearises the model and writes its modes to the message file.
    pub(crate) fn eigensolution(&mut self, asked: &Eigensolution) -> Result<(), Halt> {
        self.prepare(lower::Mode::Linear)?;
        let markers = &self.dataset.markers;
        let reference = asked.reference.and_then(|(id, _)| markers.position(id));
        let source = self.session.project.model_source();
        let failed = |error: &mechanics::RunError| {
            let message = failure::of_linearization(&self.dataset, source, error);
            Halt::located(Outcome::IntegrationFailed, &message)
        };
        let linear = self.simulation.linearize(reference);
        let mut linear = linear.map_err(|error| failed(&error))?;
        if !asked.damping {
            linear = linear.without_damping();
        }
        let time = linear.time;
        let modes = linear.modes(asked.vectors).map_err(|error| {
            failed(&mechanics::RunError {
                time,
                message: error.to_string(),
                element: None,
                cause: mechanics::Cause::NotLinear,
            })
        })?;
        let cycles = second(&self.dataset) / std::f64::consts::TAU;
        let lines = modes.iter().map(|mode| ModeLine {
            value: [mode.value.re, mode.value.im].map(|part| part * cycles),
            moves: self.moves_most(mode),
        });
        let report = ModeReport {
            time,
            modes: lines.collect(),
        };
        self.log_modes(&report)?;
        if let Some((first, last)) = asked.shapes {
            for (place, mode) in modes.iter().enumerate() {
                let number = place + 1;
                if (first as usize..=last as usize).contains(&number) {
                    self.log_shape(number, mode)?;
                }
            }
        }
        self.modes.push(report);
        Ok(())
    }

    fn log_modes(&mut self, report: &ModeReport) -> Result<(), OutputError> {
        let values: Vec<[f64; 2]> = report.modes.iter().map(|mode| mode.value).collect();
        self.log.eigenvalues(report.time, &values)?;
        self.log.note(&report.to_string())
    }

    /// The component of a shape that is largest, rotations counted by the model's length.
    fn moves_most(&self, mode: &Mode) -> Option<String> {
        let largest = mode.largest()?;
        let body = &self.simulation.model().bodies[largest / 6];
        Some(format!("{} {}", body.label, COMPONENTS[largest % 6]))
    }

    /// The whole shape of a mode: amplitude and phase of every component that moves.
    fn log_shape(&mut self, number: usize, mode: &Mode) -> Result<(), OutputError> {
        let bodies = &self.simulation.model().bodies;
        let moving = mode
            .shape
            .iter()
            .enumerate()
            .filter(|(_, c)| c.norm() > 0.0);
        let rows = moving.map(|(k, component)| {
            [
                bodies[k / 6].label.to_string(),
                COMPONENTS[k % 6].to_owned(),
                format!("{:.5e}", component.re),
                format!("{:.5e}", component.im),
            ]
        });
        let table = text_table(["part", "motion", "real", "imaginary"], 2, rows);
        self.log.note(&format!("shape of mode {number}:\n{table}"))
    }
}
