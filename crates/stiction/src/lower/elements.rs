//! DIFF to differential states.

use dataset::DifferentialEquation;
use mechanics::model::{DifferentialState, Form, Model};

use super::expression::Reads;
use super::{Lowering, label};

impl Lowering<'_> {
    /// Differential equations in the order of the dataset.
    pub(super) fn differentials(&mut self, model: &mut Model) {
        let dataset = self.dataset;
        for equation in &dataset.differentials {
            model.states.extend(self.differential(equation));
        }
    }

    fn differential(&mut self, equation: &DifferentialEquation) -> Option<DifferentialState> {
        let function = self.function(equation, "DIFF", Reads::Solution, &equation.function)?;
        Some(DifferentialState {
            label: label("DIFF", &equation.header),
            form: if equation.implicit {
                Form::Implicit
            } else {
                Form::Explicit
            },
            function,
            start: equation.ic,
            start_rate: equation.ic_rate.unwrap_or(0.0),
            held_in_statics: equation.static_hold,
        })
    }
}
