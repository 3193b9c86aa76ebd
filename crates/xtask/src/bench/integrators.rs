//! The integrators that are measured: the one place that lists them.

use mechanics::{Corrector, Formulation, Settings};

/// A choice of the INTEGRATOR statement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Integrator {
    /// Its arguments.
    pub(crate) name: &'static str,
    formulation: Formulation,
}

/// All choices.
pub(crate) const ALL: [Integrator; 5] = [
    Integrator {
        name: "GSTIFF, SI2",
        formulation: Formulation::Si2,
    },
    Integrator {
        name: "GSTIFF, I3",
        formulation: Formulation::I3,
    },
    Integrator {
        name: "HHT",
        formulation: Formulation::Hht { alpha: -0.3 },
    },
    Integrator {
        name: "NEWMARK",
        formulation: Formulation::Newmark {
            beta: 0.36,
            gamma: 0.7,
        },
    },
    Integrator {
        name: "Adams",
        formulation: Formulation::Adams,
    },
];

/// The choice that references are computed with.
pub(crate) const FOR_REFERENCES: Integrator = ALL[0];

/// Part of a run that its longest step is: output steps where nothing else is said.
const OUTPUT_STEPS: f64 = 50.0;

impl Integrator {
    /// The settings of a dataset that says nothing but the integrator and its ERROR, for a run to
    /// `end`.
    pub(crate) fn settings(&self, error: f64, end: f64) -> Settings {
        let longest_step = end / OUTPUT_STEPS;
        Settings {
            formulation: self.formulation,
            error,
            highest_order: 12,
            longest_step,
            shortest_step: (1e-6 * longest_step).min(1e-9),
            first_step: None,
            corrector: Corrector::default(),
            interpolates: true,
        }
    }
}
