//! Applied forces to single-component forces; SFORCE, SPRINGDAMPER and those given by components.

use std::ops::Range;

use dataset::{
    Dataset, Element, Elements, Expr, ForceDirection, Function, SpringDamper, Switchable,
    VectorForce,
};
use mechanics::expression::{Binary, Input, Operation, Program, Unary};
use mechanics::model::{ForceKind, Label, Model, SingleForce};

use super::expression::Reads;
use super::{Lowering, label};

/// The applied forces in the order of the model's list: type, name in results, and number of
/// components of an element.
pub(crate) const APPLIED: [(Switchable, &str, usize); 8] = [
    (Switchable::SingleForce, "Single_Component_Force", 1),
    (Switchable::SpringDamper, "Spring_Damper", 1),
    (Switchable::VectorForce, "Vector_Force", 3),
    (Switchable::VectorTorque, "Vector_Torque", 3),
    (Switchable::GeneralForce, "General_Force", 6),
    (Switchable::Bushing, "Bushing", 6),
    (Switchable::Field, "Field", 6),
    (Switchable::Beam, "Beam", 6),
];

/// Headers of the elements of one type of applied force, in the order of the dataset.
pub(crate) fn applied_headers(dataset: &Dataset, kind: Switchable) -> Vec<&dataset::Header> {
    fn headers<T: Element>(list: &Elements<T>) -> Vec<&dataset::Header> {
        list.iter().map(Element::header).collect()
    }
    match kind {
        Switchable::SingleForce => headers(&dataset.single_forces),
        Switchable::SpringDamper => headers(&dataset.spring_dampers),
        Switchable::VectorForce => headers(&dataset.vector_forces),
        Switchable::VectorTorque => headers(&dataset.vector_torques),
        Switchable::GeneralForce => headers(&dataset.general_forces),
        Switchable::Bushing => headers(&dataset.bushings),
        Switchable::Field => headers(&dataset.fields),
        Switchable::Beam => headers(&dataset.beams),
        Switchable::Joint
        | Switchable::Primitive
        | Switchable::Motion
        | Switchable::Constraint
        | Switchable::Friction
        | Switchable::Sensor => Vec::new(),
    }
}

/// Places among the model's forces of the components of an applied force, which is at `position`
/// among those of its type.
pub(super) fn applied_places(dataset: &Dataset, kind: Switchable, position: usize) -> Range<usize> {
    let mut first = 0;
    for (other, _, components) in APPLIED {
        if other == kind {
            let start = first + position * components;
            return start..start + components;
        }
        first += components * applied_headers(dataset, other).len();
    }
    first..first
}

impl Lowering<'_> {
    /// All applied forces, in the order of [`APPLIED`] and of the dataset.
    pub(super) fn forces(&mut self, model: &mut Model) {
        let dataset = self.dataset;
        for force in &dataset.single_forces {
            let function = self.function(force, "SFORCE", Reads::Velocities, &force.function);
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
            let function = match &force.components[component] {
                Some(function) => self.function(force, statement, Reads::Velocities, function),
                None => Some(Program::constant(0.0)),
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
        let id = |id: u32| Expr::Number(f64::from(id));
        let (i, j) = (id(spring.i), id(spring.j));
        // The angular velocity is resolved along the axes of J.
        let (displacement, rate) = match spring.direction {
            ForceDirection::Translational => (Function::Dm, Function::Vr),
            ForceDirection::Rotational => (Function::Az, Function::Wz),
        };
        let axes = if spring.direction == ForceDirection::Rotational {
            vec![i.clone(), j.clone(), j.clone()]
        } else {
            vec![i.clone(), j.clone()]
        };
        let mut program = Program::default();
        let mut input = |program: &mut Program, function, arguments: &[Expr]| {
            let (dataset, ground) = (self.dataset, self.ground);
            let marker = |id: Option<u32>| {
                id.and_then(|id| dataset.markers.position(id))
                    .unwrap_or(ground)
            };
            match self.measures.of_call(function, arguments, marker) {
                Some(measure) => program.push(Operation::Input(Input::Measure(measure))),
                // DM, VR, AZ and WZ are measures.
                None => program.push(Operation::Constant(f64::NAN)),
            }
        };
        let displacement = input(&mut program, displacement, &[i, j]);
        let rate = input(&mut program, rate, &axes);
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
