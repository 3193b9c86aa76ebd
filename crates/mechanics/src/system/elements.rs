//! The equations of system elements: right-hand sides and their derivatives.
//!
//! In the unknowns of a step, `δy` of a state and `γ δw` of a variable (see [`super`]),
//!
//! ```text
//! ẏ = f:   δy − γ δf        0 = f:   −γ δf
//! w = f:   γ δw − γ δf      0 = f:   −γ δf
//! ```
//!
//! In an equilibrium states rest, `0 = f`, or keep their value, `δy = 0`.

use numerics::linear::Matrix;

use super::System;
use super::newton_matrix::Weights;
use crate::expression::Program;
use crate::model::{Definition, Form, Label};

impl System {
    /// `f` of the differential states; zero for one that a static solution holds.
    pub(crate) fn state_functions(&mut self, out: &mut [f64]) {
        for (place, out) in out.iter_mut().enumerate() {
            *out = if self.holds(place) {
                0.0
            } else {
                self.model.states[place]
                    .function
                    .evaluate(&mut self.registers, |input| self.inputs.read(input))
            };
        }
    }

    /// Whether a state keeps its value at the present kind of instant.
    fn holds(&self, state: usize) -> bool {
        self.statics && self.model.states[state].held_in_statics
    }

    /// What the algebraic variables lack: `f − w`, or `f`; then what the unknowns of shared reactions
    /// lack.
    pub(crate) fn algebraic_residual(&mut self, multipliers: &[f64], out: &mut [f64]) {
        let (mut registers, adjoints) = self.take_scratch();
        let (out, of_sharing) = out.split_at_mut(self.model.algebraics.len());
        for (place, out) in out.iter_mut().enumerate() {
            let own = self.inputs.algebraics[place];
            *out = match &self.model.algebraics[place].definition {
                Definition::Function(form, function) => {
                    let value = function.evaluate(&mut registers, |input| self.inputs.read(input));
                    match form {
                        Form::Explicit => value - own,
                        Form::Implicit => value,
                    }
                }
                Definition::Acceleration(measure) => {
                    self.acceleration_value(*measure, &self.inputs.rates) - own
                }
                Definition::Force(component) => {
                    self.component_value(place, component, multipliers, &mut registers) - own
                }
            };
        }
        self.return_scratch(registers, adjoints);
        self.sharing_residual(multipliers, of_sharing);
    }

    /// The first system element whose function is not a number.
    pub(crate) fn element_not_a_number(&mut self) -> Option<&Label> {
        let states = self.model.states.iter();
        let states = states.map(|state| (&state.label, &state.function));
        let algebraics = self.model.algebraics.iter();
        let algebraics = algebraics
            .filter_map(|variable| Some((&variable.label, variable.definition.function()?)));
        let (registers, inputs) = (&mut self.registers, &self.inputs);
        states.chain(algebraics).find_map(|(label, function)| {
            let value = function.evaluate(registers, |input| inputs.read(input));
            (!value.is_finite()).then_some(label)
        })
    }

    /// Rows of the states and of the algebraic variables.
    pub(super) fn assemble_elements(
        &mut self,
        weights: &Weights,
        multipliers: &[f64],
        matrix: &mut Matrix,
    ) {
        let (mut registers, mut adjoints) = self.take_scratch();
        let first = self.velocity_count();
        for (place, state) in self.model.states.iter().enumerate() {
            let row = first + place;
            let (own, scale) = match state.form {
                _ if self.holds(place) => (1.0, 0.0),
                Form::Explicit => (weights.mass, -1.0),
                Form::Implicit => (0.0, -1.0),
            };
            matrix.add(row, row, own);
            let function = &state.function;
            function.evaluate(&mut registers, |input| self.inputs.read(input));
            self.add_row(
                function,
                row,
                scale,
                weights,
                &registers,
                &mut adjoints,
                matrix,
            );
        }
        let first = self.rate_count() + self.row_count();
        for (place, variable) in self.model.algebraics.iter().enumerate() {
            let row = first + place;
            match &variable.definition {
                Definition::Function(form, function) => {
                    let own = match form {
                        Form::Explicit => 1.0,
                        Form::Implicit => 0.0,
                    };
                    matrix.add(row, row, own);
                    function.evaluate(&mut registers, |input| self.inputs.read(input));
                    self.add_row(
                        function,
                        row,
                        -1.0,
                        weights,
                        &registers,
                        &mut adjoints,
                        matrix,
                    );
                }
                Definition::Acceleration(measure) => {
                    matrix.add(row, row, 1.0);
                    self.assemble_acceleration(*measure, row, weights, matrix);
                }
                Definition::Force(component) => {
                    matrix.add(row, row, 1.0);
                    let scratch = [registers.as_mut_slice(), adjoints.as_mut_slice()];
                    self.assemble_component(
                        place,
                        component,
                        row,
                        weights,
                        multipliers,
                        scratch,
                        matrix,
                    );
                }
            }
        }
        self.return_scratch(registers, adjoints);
    }

    /// Adds `scale` times the gradient of a function, evaluated in `registers`, to a row.
    fn add_row(
        &self,
        function: &Program,
        row: usize,
        scale: f64,
        weights: &Weights,
        registers: &[f64],
        adjoints: &mut [f64],
        matrix: &mut Matrix,
    ) {
        function.gradient(registers, adjoints, |input, slope| {
            self.columns(input, scale * slope, weights, |column, value| {
                matrix.add(row, column, value);
            });
        });
    }
}
