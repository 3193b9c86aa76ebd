//! Applied forces to single-component forces; SFORCE, SPRINGDAMPER and those given by components.

use std::ops::Range;

use dataset::{
    Dataset, Element, Elements, Expr, ForceDirection, Function, Header, SpringDamper, Switchable,
    VectorForce,
};
use mechanics::expression::{Binary, Input, Operation, Program, Register, Unary};
use mechanics::model::{ForceKind, Label, Model, SingleForce};

use super::expression::Reads;
use super::{Lowering, label};

/// A type of applied force.
pub(crate) struct Applied {
    /// What ACTIVATE calls it.
    pub(crate) kind: Switchable,
    /// What results call it.
    pub(crate) name: &'static str,
    /// Number of components of an element among the model's forces.
    components: usize,
    elements: fn(&Dataset) -> &dyn Headers,
}

/// The applied forces in the order of the model's list.
pub(crate) const APPLIED: [Applied; 8] = [
    Applied {
        kind: Switchable::SingleForce,
        name: "Single_Component_Force",
        components: 1,
        elements: |dataset| &dataset.single_forces,
    },
    Applied {
        kind: Switchable::SpringDamper,
        name: "Spring_Damper",
        components: 1,
        elements: |dataset| &dataset.spring_dampers,
    },
    Applied {
        kind: Switchable::VectorForce,
        name: "Vector_Force",
        components: 3,
        elements: |dataset| &dataset.vector_forces,
    },
    Applied {
        kind: Switchable::VectorTorque,
        name: "Vector_Torque",
        components: 3,
        elements: |dataset| &dataset.vector_torques,
    },
    Applied {
        kind: Switchable::GeneralForce,
        name: "General_Force",
        components: 6,
        elements: |dataset| &dataset.general_forces,
    },
    Applied {
        kind: Switchable::Bushing,
        name: "Bushing",
        components: 6,
        elements: |dataset| &dataset.bushings,
    },
    Applied {
        kind: Switchable::Field,
        name: "Field",
        components: 6,
        elements: |dataset| &dataset.fields,
    },
    Applied {
        kind: Switchable::Beam,
        name: "Beam",
        components: 6,
        elements: |dataset| &dataset.beams,
    },
];

/// The headers of a list of elements.
trait Headers {
    fn count(&self) -> usize;
    fn header(&self, position: usize) -> &Header;
    fn position_of(&self, id: u32) -> Option<usize>;
}

impl<T: Element> Headers for Elements<T> {
    fn count(&self) -> usize {
        self.len()
    }

    fn header(&self, position: usize) -> &Header {
        self[position].header()
    }

    fn position_of(&self, id: u32) -> Option<usize> {
        self.position(id)
    }
}

impl Applied {
    /// The elements in the order of the dataset, with the places of their components among the
    /// model's forces.
    pub(crate) fn elements<'a>(
        &self,
        dataset: &'a Dataset,
    ) -> impl Iterator<Item = (&'a Header, Range<usize>)> + use<'a> {
        let (first, components) = (self.first(dataset), self.components);
        let elements = (self.elements)(dataset);
        (0..elements.count()).map(move |position| {
            let start = first + position * components;
            (elements.header(position), start..start + components)
        })
    }

    /// Places of the components of one element.
    fn places(&self, dataset: &Dataset, id: u32) -> Option<Range<usize>> {
        let position = (self.elements)(dataset).position_of(id)?;
        let start = self.first(dataset) + position * self.components;
        Some(start..start + self.components)
    }

    /// Place of the first component of the first element.
    fn first(&self, dataset: &Dataset) -> usize {
        let before = APPLIED.iter().take_while(|other| other.kind != self.kind);
        before
            .map(|other| other.components * (other.elements)(dataset).count())
            .sum()
    }
}

/// Places among the model's forces of the components of an applied force.
pub(super) fn applied_places(dataset: &Dataset, kind: Switchable, id: u32) -> Option<Range<usize>> {
    let applied = APPLIED.iter().find(|applied| applied.kind == kind)?;
    applied.places(dataset, id)
}

impl Lowering<'_> {
    /// All applied forces, in the order of [`APPLIED`] and of the dataset.
    pub(super) fn forces(&mut self, model: &mut Model) {
        let dataset = self.dataset;
        for force in &dataset.single_forces {
            let function = self.function(force, "SFORCE", Reads::Solution, &force.function);
            let Some(function) = function else { continue };
            model.forces.push(SingleForce {
                label: label("SFORCE", &force.header),
                i: self.marker_place(force.i),
                j: self.marker_place(force.j),
                kind: match (force.direction, force.action_only) {
                    (ForceDirection::Translational, false) => ForceKind::LineOfSight,
                    (ForceDirection::Translational, true) => ForceKind::AlongZ,
                    (ForceDirection::Rotational, false) => ForceKind::AboutZ,
                    (ForceDirection::Rotational, true) => ForceKind::AboutZActionOnly,
                },
                function,
            });
        }
        for spring in &dataset.spring_dampers {
            let function = self.spring(spring);
            model.forces.push(SingleForce {
                label: label("SPRINGDAMPER", &spring.header),
                i: self.marker_place(spring.i),
                j: self.marker_place(spring.j),
                kind: match spring.direction {
                    ForceDirection::Translational => ForceKind::LineOfSight,
                    ForceDirection::Rotational => ForceKind::AboutZ,
                },
                function,
            });
        }
        for force in &dataset.vector_forces {
            self.components(model, "VFORCE", force, 0..3);
        }
        for force in &dataset.vector_torques {
            self.components(model, "VTORQUE", force, 3..6);
        }
        for force in &dataset.general_forces {
            self.components(model, "GFORCE", force, 0..6);
        }
        self.elastic_forces(model);
    }

    /// Components of a VFORCE, VTORQUE or GFORCE, three forces and then three torques along RM.
    fn components(
        &mut self,
        model: &mut Model,
        statement: &'static str,
        force: &VectorForce,
        components: Range<usize>,
    ) {
        let ends = [force.i, force.j_float, force.rm].map(|id| self.marker_place(id));
        for component in components {
            let given = (&force.components[component], &force.vectors[component / 3]);
            let function = match given {
                (Some(function), _) => self.function(force, statement, Reads::Solution, function),
                (None, Some(vector)) => self.component_of(force, statement, vector, component % 3),
                (None, None) => Some(Program::constant(0.0)),
            };
            let Some(function) = function else { continue };
            let label = label(statement, &force.header);
            model
                .forces
                .push(component_force(label, ends, component, function));
        }
    }

    /// `−C q' − K (q − LENGTH) + FORCE` with `q` the distance, or the angle about z of J.
    fn spring(&mut self, spring: &SpringDamper) -> Program {
        let (displacement, rate) = match spring.direction {
            ForceDirection::Translational => (Function::Dm, Function::Vr),
            ForceDirection::Rotational => (Function::Az, Function::Wz),
        };
        let mut program = Program::default();
        let displacement = self.measured(&mut program, displacement, spring.i, spring.j);
        let rate = self.measured(&mut program, rate, spring.i, spring.j);
        let constant = |program: &mut Program, value| program.push(Operation::Constant(value));
        let binary = |program: &mut Program, f, a, b| program.push(Operation::Binary(f, a, b));
        let free = constant(&mut program, spring.free_length);
        let stretch = binary(&mut program, Binary::Subtract, displacement, free);
        let stiffness = constant(&mut program, spring.stiffness);
        let elastic = binary(&mut program, Binary::Multiply, stiffness, stretch);
        let damping = constant(&mut program, spring.damping);
        let viscous = binary(&mut program, Binary::Multiply, damping, rate);
        let sum = binary(&mut program, Binary::Add, elastic, viscous);
        let resisting = program.push(Operation::Unary(Unary::Negate, sum));
        let preload = constant(&mut program, spring.preload);
        binary(&mut program, Binary::Add, resisting, preload);
        program
    }

    /// A coordinate of marker I in marker J, or its rate as seen from J, along the axes of J.
    pub(super) fn measured(
        &mut self,
        program: &mut Program,
        function: Function,
        i: u32,
        j: u32,
    ) -> Register {
        let [i, j] = [i, j].map(|id| Expr::Number(f64::from(id)));
        // Marker i, marker j, the axes and the observer; functions with fewer markers read no more.
        let arguments = [i, j.clone(), j.clone(), j];
        let (dataset, ground) = (self.dataset, self.ground);
        let marker = |id: Option<u32>| {
            id.and_then(|id| dataset.markers.position(id))
                .unwrap_or(ground)
        };
        let operation = match self.measures.of_call(function, &arguments, marker) {
            Some(measure) => Operation::Input(Input::Measure(measure)),
            // Only measures are asked for.
            None => Operation::Constant(f64::NAN),
        };
        program.push(operation)
    }
}

/// Component 0 to 5 (three forces, three torques) on marker I along the axes of the marker `frame`.
pub(super) fn component_force(
    label: Label,
    [i, j, frame]: [usize; 3],
    component: usize,
    function: Program,
) -> SingleForce {
    let axis = component % 3;
    let kind = if component < 3 {
        ForceKind::AlongAxis { frame, axis }
    } else {
        ForceKind::AboutAxis { frame, axis }
    };
    SingleForce {
        label,
        i,
        j,
        kind,
        function,
    }
}
