//! LSE and TFSISO to differential states, and what ARYVAL reads.

use std::collections::HashMap;

use dataset::{ArrayKind, Dataset, LinearStateEquations, Matrix, TransferFunction};
use mechanics::model::{DifferentialState, Form, Label, Model};

use super::expression::{Compiler, Reads};
use super::{Lowering, label};

/// A value that a linear combination takes a multiple of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Term {
    /// A differential state, by its place.
    State(usize),
    /// A VARIABLE, by its id.
    Variable(u32),
}

/// A sum of multiples.
pub(super) type Combination = Vec<(Term, f64)>;

/// `x' = A x + B u`, `y = C x + D u`.
#[derive(Clone, Debug)]
struct LinearSystem {
    label: Label,
    rates: Vec<Combination>,
    start: Vec<f64>,
    held: bool,
}

/// What an element of an array is.
#[derive(Clone, Debug)]
pub(super) enum ArrayElement<'a> {
    /// A multiple of states and variables: a state, an input or an output.
    Combination(&'a Combination),
    /// A number.
    Number(f64),
}

/// The linear systems of a dataset, and the arrays by what their elements are.
#[derive(Clone, Debug, Default)]
pub(super) struct LinearSystems {
    systems: Vec<LinearSystem>,
    arrays: HashMap<u32, Vec<Combination>>,
}

/// Entries of a matrix by rows.
type Rows = Vec<Vec<(usize, f64)>>;

impl LinearSystems {
    /// Those of a dataset; their states follow the differential equations.
    pub(super) fn new(dataset: &Dataset) -> Self {
        let mut made = Self::default();
        for array in &dataset.arrays {
            if let ArrayKind::Inputs(variables) = &array.kind {
                let elements = variables.iter().map(|id| vec![(Term::Variable(*id), 1.0)]);
                made.arrays.insert(array.header.id, elements.collect());
            }
        }
        let mut first = dataset.differentials.len();
        for equations in &dataset.linear_equations {
            first += made.add_equations(dataset, equations, first);
        }
        for function in &dataset.transfer_functions {
            first += made.add_transfer_function(function, first);
        }
        made
    }

    fn add_equations(
        &mut self,
        dataset: &Dataset,
        equations: &LinearStateEquations,
        first: usize,
    ) -> usize {
        let rows = |id: Option<u32>| {
            let matrix = id.and_then(|id| dataset.matrices.by_id(id))?;
            // What does not fit has been reported by the checks of the dataset.
            let mut rows: Rows = vec![Vec::new(); matrix.rows.min(Matrix::MOST)];
            for &(row, column, value) in &matrix.entries {
                if let Some(row) = rows.get_mut(row) {
                    row.push((column, value));
                }
            }
            Some(rows)
        };
        let Some(a) = rows(Some(equations.a)) else {
            return 0;
        };
        let states = a.len();
        let [b, c, d] = [equations.b, equations.c, equations.d].map(rows);
        let start = equations.ic.and_then(|id| dataset.arrays.by_id(id));
        let start = match start.map(|array| &array.kind) {
            Some(ArrayKind::Numbers(numbers)) => numbers.clone(),
            _ => vec![0.0; states],
        };
        let inputs = self.inputs(equations.inputs);
        let rates = combine(Some(a), b, first, &inputs);
        let outputs = combine(c, d, first, &inputs);
        self.name_states(equations.states, first, states);
        self.arrays
            .extend(equations.outputs.map(|id| (id, outputs)));
        self.systems.push(LinearSystem {
            label: label("LSE", &equations.header),
            rates,
            start,
            held: equations.static_hold,
        });
        states
    }

    /// The controllable canonical form: with the denominator `s^n + a_{n-1} s^{n-1} + ... + a_0` and
    /// the numerator `b_n s^n + ... + b_0` (both divided by the first coefficient of the denominator)
    /// `x_k' = x_{k+1}`, `x_n' = u - Σ a_k x_k` and `y = b_n u + Σ (b_k - b_n a_k) x_k` (Ogata,
    /// *Modern Control Engineering*, section 9-2).
    fn add_transfer_function(&mut self, function: &TransferFunction, first: usize) -> usize {
        let states = function.denominator.len().saturating_sub(1);
        let Some(leading) = function.denominator.last().copied() else {
            return 0;
        };
        let a = |k: usize| function.denominator[k] / leading;
        let b = |k: usize| function.numerator.get(k).map_or(0.0, |b| b / leading);
        let inputs = self.inputs(Some(function.input));
        let input = |factor: f64| inputs.iter().map(move |id| (Term::Variable(*id), factor));
        let state = |k: usize, factor: f64| (Term::State(first + k), factor);
        let mut rates: Vec<Combination> = (1..states).map(|k| vec![state(k, 1.0)]).collect();
        let last = (0..states).map(|k| state(k, -a(k)));
        rates.push(last.chain(input(1.0)).collect());
        let through = b(states);
        let output = (0..states).map(|k| state(k, b(k) - through * a(k)));
        let output: Combination = if through == 0.0 {
            output.collect()
        } else {
            output.chain(input(through)).collect()
        };
        self.name_states(function.states, first, states);
        self.arrays.insert(function.output, vec![output]);
        self.systems.push(LinearSystem {
            label: label("TFSISO", &function.header),
            rates,
            start: vec![0.0; states],
            held: function.static_hold,
        });
        states
    }

    /// The variables of an array of inputs.
    fn inputs(&self, array: Option<u32>) -> Vec<u32> {
        let elements = array.and_then(|id| self.arrays.get(&id));
        let terms = elements.into_iter().flatten().flatten();
        let variables = terms.filter_map(|(term, _)| match term {
            Term::Variable(id) => Some(*id),
            Term::State(_) => None,
        });
        variables.collect()
    }

    fn name_states(&mut self, array: u32, first: usize, count: usize) {
        let states = (first..first + count).map(|place| vec![(Term::State(place), 1.0)]);
        self.arrays.insert(array, states.collect());
    }

    /// What `ARYVAL(array, element)` reads, the elements counted from 1.
    pub(super) fn element<'a>(
        &'a self,
        dataset: &Dataset,
        array: u32,
        element: u32,
    ) -> Option<ArrayElement<'a>> {
        let place = element.checked_sub(1)? as usize;
        if let ArrayKind::Numbers(numbers) = &dataset.arrays.by_id(array)?.kind {
            return numbers.get(place).copied().map(ArrayElement::Number);
        }
        let combination = self.arrays.get(&array)?.get(place)?;
        Some(ArrayElement::Combination(combination))
    }
}

/// Rows `M x + N u` of a system; a matrix that is not given is zero.
fn combine(
    by_state: Option<Rows>,
    by_input: Option<Rows>,
    first: usize,
    inputs: &[u32],
) -> Vec<Combination> {
    let count = [&by_state, &by_input].map(|rows| rows.as_ref().map_or(0, Vec::len));
    let row = |rows: &Option<Rows>, row: usize| -> Vec<(usize, f64)> {
        let rows = rows.as_ref().and_then(|rows| rows.get(row));
        let entries = rows.into_iter().flatten().copied();
        entries.filter(|(_, value)| *value != 0.0).collect()
    };
    (0..count[0].max(count[1]))
        .map(|place| {
            let states = row(&by_state, place).into_iter();
            let states = states.map(|(k, value)| (Term::State(first + k), value));
            let by_input = row(&by_input, place).into_iter();
            let variables =
                by_input.filter_map(|(k, value)| Some((Term::Variable(*inputs.get(k)?), value)));
            states.chain(variables).collect()
        })
        .collect()
}

impl Lowering<'_> {
    /// The states of LSE and TFSISO, which follow those of DIFF.
    pub(super) fn linear_states(&mut self, model: &mut Model) {
        let systems = std::mem::take(&mut self.linear_systems.systems);
        for system in &systems {
            for (combination, start) in system.rates.iter().zip(&system.start) {
                let mut compiler = Compiler::new(Reads::Solution);
                compiler.owner = format!("{}/{}", system.label.statement, system.label.id);
                let Ok(rate) = compiler.combination(self, combination) else {
                    continue;
                };
                model.states.push(DifferentialState {
                    label: system.label.clone(),
                    form: Form::Explicit,
                    function: compiler.finish(rate),
                    start: *start,
                    start_rate: 0.0,
                    held_in_statics: system.held,
                });
            }
        }
        self.linear_systems.systems = systems;
    }
}
