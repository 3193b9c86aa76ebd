//! The switches in the functions of a model: what they read, how far that is from a jump.

use super::System;
use crate::expression::{Branch, Input, Program};
use crate::model::{Definition, DifferentialState, Element, Form, Label};
use crate::scalar::Jet;
use serde::{Deserialize, Serialize};

/// Variables that read one another, one behind the other, through which units are followed.
const NESTING: usize = 3;

/// Whose function a switch is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
enum Host {
    Force(usize),
    Constraint(usize),
    Motion(usize),
    State(usize),
    Algebraic(usize),
}

/// A switch of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct SwitchPlace {
    host: Host,
    switch: usize,
}

/// What a switch shows at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Reading {
    /// Its argument.
    pub(crate) argument: f64,
    /// How much it would jump if a boundary of its cells were there.
    pub(crate) jump: f64,
}

/// What counts as one for the quantities of a model, so that an error tolerance can be told in the
/// unit of any function of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Units<'a> {
    pub(crate) length: f64,
    pub(crate) rate: f64,
    pub(crate) states: &'a [f64],
}

/// How an instant goes on, beside the velocities.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Course<'a> {
    /// Accelerations, then rates of differential states.
    pub(crate) rates: &'a [f64],
    /// Rates of these.
    pub(crate) rate_changes: &'a [f64],
    /// Rates of the algebraic variables.
    pub(crate) variable_rates: &'a [f64],
}

impl System {
    /// Number of switches, active or not.
    #[must_use]
    pub(crate) fn switch_count(&self) -> usize {
        self.hosts()
            .map(|host| self.program(host).map_or(0, Program::switch_count))
            .sum()
    }

    /// All switches, function by function.
    pub(crate) fn switches(&self) -> Vec<SwitchPlace> {
        let of_host = |host| {
            let count = self.program(host).map_or(0, Program::switch_count);
            (0..count).map(move |switch| SwitchPlace { host, switch })
        };
        self.hosts().flat_map(of_host).collect()
    }

    fn hosts(&self) -> impl Iterator<Item = Host> + use<> {
        let model = &self.model;
        (0..model.forces.len())
            .map(Host::Force)
            .chain((0..model.constraints.len()).map(Host::Constraint))
            .chain((0..model.motions.len()).map(Host::Motion))
            .chain((0..model.states.len()).map(Host::State))
            .chain((0..model.algebraics.len()).map(Host::Algebraic))
    }

    fn program(&self, host: Host) -> Option<&Program> {
        let model = &self.model;
        Some(match host {
            Host::Force(place) => &model.forces[place].function,
            Host::Constraint(place) => &model.constraints[place].function,
            Host::Motion(place) => &model.motions[place].function,
            Host::State(place) => &model.states[place].function,
            Host::Algebraic(place) => return model.algebraics[place].definition.function(),
        })
    }

    fn program_mut(&mut self, host: Host) -> Option<&mut Program> {
        let model = &mut self.model;
        Some(match host {
            Host::Force(place) => &mut model.forces[place].function,
            Host::Constraint(place) => &mut model.constraints[place].function,
            Host::Motion(place) => &mut model.motions[place].function,
            Host::State(place) => &mut model.states[place].function,
            Host::Algebraic(place) => match &mut model.algebraics[place].definition {
                Definition::Function(_, function) => function,
                Definition::Acceleration(_) | Definition::Force(_) => return None,
            },
        })
    }

    /// Whether the element of a switch acts.
    pub(crate) fn switch_acts(&self, place: SwitchPlace) -> bool {
        match place.host {
            Host::Force(force) => self.model.is_active(Element::Force(force)),
            Host::Constraint(general) => self.model.is_active(Element::Constraint(general)),
            Host::Motion(motion) => self.model.is_active(Element::Motion(motion)),
            Host::State(_) | Host::Algebraic(_) => true,
        }
    }

    /// Whether a bend of the function is a jump of velocities or accelerations, as in constraints.
    pub(crate) fn switch_constrains(&self, place: SwitchPlace) -> bool {
        matches!(place.host, Host::Constraint(_) | Host::Motion(_))
    }

    /// Whether a switch jumps again and again as its argument goes on.
    pub(crate) fn is_stairs(&self, place: SwitchPlace) -> bool {
        self.switch_program(place).is_stairs(place.switch)
    }

    /// Whether the jump of a switch shows in the motion and the differential states alone, in no other
    /// switch.
    pub(crate) fn switch_may_be_dull(&self, place: SwitchPlace) -> bool {
        let hidden = |input: Input| matches!(input, Input::Algebraic(_) | Input::StateRate(_));
        let read = |other: &SwitchPlace| {
            let program = self.switch_program(*other);
            program.argument_inputs(other.switch).any(hidden)
        };
        matches!(place.host, Host::Force(_) | Host::State(_))
            && !self.switch_program(place).feeds_switch(place.switch)
            && !self.switches().iter().any(read)
    }

    /// A cell of a switch and the next one above it, or the two that there are.
    pub(crate) fn switch_neighbours(&self, place: SwitchPlace, cell: f64) -> [f64; 2] {
        if self.is_stairs(place) {
            [cell, cell + 1.0]
        } else {
            [-1.0, 1.0]
        }
    }

    /// The element of a switch.
    pub(crate) fn switch_label(&self, place: SwitchPlace) -> &Label {
        let model = &self.model;
        match place.host {
            Host::Force(place) => &model.forces[place].label,
            Host::Constraint(place) => &model.constraints[place].label,
            Host::Motion(place) => &model.motions[place].label,
            Host::State(place) => &model.states[place].label,
            Host::Algebraic(place) => &model.algebraics[place].label,
        }
    }

    /// The function of a switch; every switch has one.
    fn switch_program(&self, place: SwitchPlace) -> &Program {
        self.program(place.host).expect("a switch is in a function")
    }

    /// The cell of an argument of a switch.
    pub(crate) fn switch_cell(&self, place: SwitchPlace, argument: f64) -> f64 {
        let program = self.switch_program(place);
        program.switch_cell(place.switch, argument)
    }

    /// Ends of a cell of a switch.
    pub(crate) fn cell_ends(&self, place: SwitchPlace, cell: f64) -> (f64, f64) {
        self.switch_program(place).cell_ends(place.switch, cell)
    }

    /// How far an argument of a switch is outside of a cell: negative within.
    pub(crate) fn outside_cell(&self, place: SwitchPlace, cell: f64, argument: f64) -> f64 {
        let program = self.switch_program(place);
        program.outside_cell(place.switch, cell, argument)
    }

    /// The cells between which a switch goes when it leaves one for another, and where they meet.
    pub(crate) fn switch_sides(&self, place: SwitchPlace, cells: [f64; 2]) -> (f64, f64, f64) {
        let program = self.switch_program(place);
        program.switch_sides(place.switch, cells)
    }

    /// The name of the function that a switch is.
    pub(crate) fn switch_name(&self, place: SwitchPlace) -> &'static str {
        self.switch_program(place).switch_name(place.switch)
    }

    /// Whether a switch depends on nothing but time.
    pub(crate) fn is_switch_of_time(&self, place: SwitchPlace) -> bool {
        self.switch_program(place).is_switch_of_time(place.switch)
    }

    pub(crate) fn set_branch(&mut self, place: SwitchPlace, branch: Branch) {
        if let Some(program) = self.program_mut(place.host) {
            program.set_branch(place.switch, branch);
        }
    }

    /// Every switch goes by its argument.
    pub(crate) fn free_switches(&mut self) {
        for place in self.switches() {
            self.set_branch(place, Branch::Free);
        }
    }

    /// Time for switches that depend on nothing else; everything else stays as evaluated last.
    pub(crate) fn set_time(&mut self, time: f64) {
        self.inputs.time = time;
    }

    /// Reads switches at the instant evaluated last.
    pub(crate) fn read_switches(
        &mut self,
        places: impl Iterator<Item = SwitchPlace>,
        readings: &mut [Reading],
    ) {
        let mut registers = std::mem::take(&mut self.registers);
        let mut last = None;
        for (place, reading) in places.zip(readings) {
            let program = self.switch_program(place);
            // Switches of one function follow one another.
            if last.replace(place.host) != Some(place.host) {
                program.evaluate(&mut registers, |input| self.inputs.read(input));
            }
            *reading = Reading {
                argument: program.switch_argument(place.switch, &registers),
                jump: program.switch_jump(place.switch, &registers),
            };
        }
        self.registers = registers;
    }

    /// The argument of a switch and its rate, at the instant evaluated last with its slopes; of the second
    /// rate only what time and the curvature of the function make.
    pub(crate) fn switch_motion(&mut self, place: SwitchPlace, course: &Course<'_>) -> Jet {
        let mut jets = std::mem::take(&mut self.jets);
        let program = self.switch_program(place);
        let motion = program.argument_motion(place.switch, &mut jets, |input| Jet {
            value: self.inputs.read(input),
            rate: self.input_rate(input, course),
            acceleration: 0.0,
        });
        self.jets = jets;
        motion
    }

    fn input_rate(&self, input: Input, course: &Course<'_>) -> f64 {
        let states = self.velocity_count();
        match input {
            Input::Time => 1.0,
            Input::Measure(measure) => {
                let motions = self.measure_bodies[measure]
                    .iter()
                    .zip(&self.measure_slopes[measure]);
                let rate = |(&body, slopes): (&usize, &[f64; 12])| -> f64 {
                    let frame = &self.bodies[body];
                    let accelerations = &course.rates[6 * body..6 * body + 6];
                    let rates = frame.velocity.iter().chain(&frame.omega);
                    let rates = rates.chain(accelerations);
                    slopes.iter().zip(rates).map(|(s, rate)| s * rate).sum()
                };
                motions.map(rate).sum()
            }
            Input::State(state) => course.rates[states + state],
            Input::StateRate(state) => course.rate_changes[states + state],
            Input::Algebraic(variable) => course.variable_rates[variable],
            Input::Result(_) => 0.0,
        }
    }

    /// How far the argument of a switch moves when what it reads moves by one unit each; zero where
    /// that is not known.
    pub(crate) fn switch_unit(&mut self, place: SwitchPlace, units: &Units<'_>) -> f64 {
        self.evaluate_slopes();
        let variables = self.variable_units(units);
        let (mut registers, mut adjoints) = self.take_scratch();
        let program = self.switch_program(place);
        program.evaluate(&mut registers, |input| self.inputs.read(input));
        let mut sum = 0.0;
        program.argument_gradient(place.switch, &registers, &mut adjoints, |input, slope| {
            sum += slope.abs() * self.input_unit(input, units, &variables);
        });
        self.return_scratch(registers, adjoints);
        if sum.is_finite() { sum } else { 0.0 }
    }

    /// The same for the algebraic variables; the magnitude of those that are no functions.
    fn variable_units(&mut self, units: &Units<'_>) -> Vec<f64> {
        let magnitudes = self.inputs.algebraics.iter().map(|w| w.abs());
        let mut found: Vec<f64> = magnitudes.collect();
        let (mut registers, mut adjoints) = self.take_scratch();
        for _ in 0..NESTING {
            for place in 0..found.len() {
                let definition = &self.model.algebraics[place].definition;
                if let Definition::Function(Form::Explicit, function) = definition {
                    function.evaluate(&mut registers, |input| self.inputs.read(input));
                    let mut sum = 0.0;
                    function.gradient(&registers, &mut adjoints, |input, slope| {
                        sum += slope.abs() * self.input_unit(input, units, &found);
                    });
                    found[place] = sum;
                }
            }
        }
        self.return_scratch(registers, adjoints);
        found
    }

    /// How fast differential states change when what their functions read, the states themselves and
    /// time left out, is one unit each; zero where that is not known.
    pub(crate) fn state_units(&mut self, units: &Units<'_>) -> Vec<f64> {
        self.evaluate_slopes();
        let variables = self.variable_units(units);
        let (mut registers, mut adjoints) = self.take_scratch();
        let unit = |(place, state): (usize, &DifferentialState)| {
            let function = &state.function;
            function.evaluate(&mut registers, |input| self.inputs.read(input));
            let mut sum = 0.0;
            function.gradient(&registers, &mut adjoints, |input, slope| {
                if !matches!(input, Input::State(own) | Input::StateRate(own) if own == place) {
                    sum += slope.abs() * self.input_unit(input, units, &variables);
                }
            });
            match state.form {
                Form::Explicit if f64::is_finite(sum) => sum,
                Form::Explicit => 0.0,
                Form::Implicit => f64::INFINITY,
            }
        };
        let found = self.model.states.iter().enumerate().map(unit).collect();
        self.return_scratch(registers, adjoints);
        found
    }

    fn input_unit(&self, input: Input, units: &Units<'_>, variables: &[f64]) -> f64 {
        let parts = |slopes: &[f64], length: f64, angle: f64| -> f64 {
            let weighted = slopes
                .iter()
                .zip([length, length, length, angle, angle, angle]);
            weighted.map(|(slope, unit)| slope.abs() * unit).sum()
        };
        match input {
            Input::Time => 0.0,
            Input::Measure(measure) => self.measure_slopes[measure]
                .iter()
                .map(|slopes| {
                    parts(&slopes[..6], units.length, 1.0)
                        + parts(&slopes[6..], units.length * units.rate, units.rate)
                })
                .sum(),
            Input::State(state) => units.states[state],
            Input::Algebraic(variable) => variables[variable],
            Input::StateRate(_) => self.inputs.read(input).abs(),
            Input::Result(_) => 0.0,
        }
    }
}
