//! SFORCE and SPRINGDAMPER to single-component forces.

use dataset::{Expr, ForceDirection, Function, SpringDamper};
use mechanics::expression::{Binary, Input, Operation, Program, Unary};
use mechanics::model::{ForceKind, Model, SingleForce};

use super::expression::Reads;
use super::{Lowering, label};

impl Lowering<'_> {
    /// Single-component forces in the order of the dataset, then spring-dampers.
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
