//! The algebraic variables of a model: what functions read that is solved together with the motion.

use serde::{Deserialize, Serialize};
use std::collections::{HashMap, HashSet};

use dataset::Code;
use mechanics::expression::{Input, Operation, Program};
use mechanics::model::{AlgebraicVariable, Definition, Form, Label, Model};
use mechanics::{Acting, ForceComponent, ForceElement, Owner};

use super::expression::{Compiler, Reads, variables_of};
use super::{Lowering, label};

/// An algebraic variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub(super) enum Unknown {
    /// A VARIABLE that depends on itself, by its id.
    Variable(u32),
    /// A measure of acceleration, by its place.
    Acceleration(usize),
    /// A component of a force.
    Force(ForceComponent),
}

/// The algebraic variables of a model, each once, in the order in which functions first need them.
///
/// Like the measures they keep their numbers through all changes of the model.
#[derive(Clone, Debug, Default)]
pub(super) struct Unknowns {
    list: Vec<Unknown>,
    places: HashMap<Unknown, usize>,
}

impl Unknowns {
    /// All of them.
    pub(super) fn list(&self) -> &[Unknown] {
        &self.list
    }

    /// These ones.
    pub(super) fn of_list(list: &[Unknown]) -> Self {
        let places = list.iter().enumerate();
        Self {
            list: list.to_vec(),
            places: places.map(|(place, unknown)| (*unknown, place)).collect(),
        }
    }

    /// Place of an unknown, a new one where there is none yet.
    pub(super) fn place(&mut self, unknown: Unknown) -> usize {
        *self.places.entry(unknown).or_insert_with(|| {
            self.list.push(unknown);
            self.list.len() - 1
        })
    }

    /// Place of a VARIABLE that depends on itself; `None` for the others, which are part of the
    /// functions that read them.
    pub(super) fn of_variable(&self, id: u32) -> Option<usize> {
        self.places.get(&Unknown::Variable(id)).copied()
    }
}

impl Lowering<'_> {
    /// Makes a variable of each circle of VARIABLEs an unknown, so that none is left.
    pub(super) fn break_circles(&mut self) {
        let dataset = self.dataset;
        let mut done = HashSet::new();
        for variable in &dataset.variables {
            // Depth first on a stack of its own; what is open is on the path.
            let mut stack = vec![variable.header.id];
            let mut open = HashSet::new();
            while let Some(&top) = stack.last() {
                if done.contains(&top) {
                    stack.pop();
                } else if open.insert(top) {
                    let function = dataset.variables.by_id(top).map(|v| &v.function);
                    let read = function.map(|f| variables_of(self, &f.root));
                    for id in read.unwrap_or_default() {
                        if self.measures.unknowns.of_variable(id).is_some() {
                            continue;
                        }
                        if open.contains(&id) {
                            self.measures.unknowns.place(Unknown::Variable(id));
                        } else {
                            stack.push(id);
                        }
                    }
                } else {
                    open.remove(&top);
                    done.insert(top);
                    stack.pop();
                }
            }
        }
    }

    /// The definitions of all unknowns; call it after the other functions, which decide what is one.
    pub(super) fn algebraics(&mut self, model: &mut Model) {
        let mut place = 0;
        // The function of a variable may need further unknowns.
        while let Some(unknown) = self.measures.unknowns.list.get(place).copied() {
            model.algebraics.extend(self.algebraic(unknown, model));
            place += 1;
        }
    }

    fn algebraic(&mut self, unknown: Unknown, model: &Model) -> Option<AlgebraicVariable> {
        let at_marker = |place: usize, name: &str| Label {
            statement: "MARKER",
            id: model.markers[place].id,
            name: name.to_owned(),
        };
        Some(match unknown {
            Unknown::Variable(id) => {
                let variable = self.dataset.variables.by_id(id)?;
                let mut compiler = Compiler::new(Reads::Solution);
                let owner = format!("VARIABLE/{id}");
                let value = compiler.add(self, &owner, &variable.function).ok()?;
                let function = compiler.finish(value);
                if copies(&function, self.measures.unknowns.of_variable(id)) {
                    let message = format!("{owner} is defined by nothing but its own value");
                    self.error(
                        Code::CircularVariables,
                        variable.function.span,
                        message,
                        None,
                    );
                }
                AlgebraicVariable {
                    label: label("VARIABLE", &variable.header),
                    definition: Definition::Function(Form::Explicit, function),
                    start: variable.ic.unwrap_or(0.0),
                }
            }
            Unknown::Acceleration(measure) => AlgebraicVariable {
                label: at_marker(self.measures.get(measure).i, "acceleration"),
                definition: Definition::Acceleration(measure),
                start: 0.0,
            },
            Unknown::Force(component) => AlgebraicVariable {
                label: match component.acting {
                    Acting::Element(element, _) => element_label(model, element).clone(),
                    Acting::Between { i, .. } => at_marker(i, "force"),
                },
                definition: Definition::Force(component),
                start: 0.0,
            },
        })
    }
}

/// Whether a function is the value of the unknown itself.
fn copies(function: &Program, unknown: Option<usize>) -> bool {
    let mut copy = Program::default();
    if let Some(place) = unknown {
        copy.push(Operation::Input(Input::Algebraic(place)));
    }
    *function == copy
}

fn element_label(model: &Model, element: ForceElement) -> &Label {
    match element {
        ForceElement::Constraint(Owner::Joint(place)) => &model.joints[place].label,
        ForceElement::Constraint(Owner::Motion(place)) => &model.motions[place].label,
        ForceElement::Constraint(Owner::General(place)) => &model.constraints[place].label,
        ForceElement::Applied { first, .. } => &model.forces[first].label,
        ForceElement::Friction(place) => &model.frictions[place].label,
    }
}
