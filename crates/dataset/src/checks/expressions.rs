//! The markers and elements that expressions name exist, and FRICTION is read where it may be.

use super::references;
use crate::diagnostic::{Code, Diagnostics};
use crate::expression::{ArgumentKind, ElementKind, Expr, Expression, Function};
use crate::model::{Dataset, RequestKind};
use crate::source::Span;

/// What an expression belongs to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    /// An element that can move the model.
    Motion,
    /// A REQUEST or SENSOR.
    Output,
}

/// Every expression of a dataset, and what it belongs to.
fn all(dataset: &Dataset) -> impl Iterator<Item = (&Expression, Place)> {
    let constraints = dataset.constraints.iter().map(|element| &element.function);
    let motions = dataset.motions.iter().map(|element| &element.function);
    let forces = dataset
        .single_forces
        .iter()
        .map(|element| &element.function);
    let vectors = [
        &dataset.vector_forces,
        &dataset.vector_torques,
        &dataset.general_forces,
    ];
    let vectors = vectors.into_iter().flat_map(|list| list.iter());
    let vectors =
        vectors.flat_map(|element| element.components.iter().chain(&element.vectors).flatten());
    let variables = dataset.variables.iter().map(|element| &element.function);
    let differentials = dataset
        .differentials
        .iter()
        .map(|element| &element.function);
    let requests = dataset
        .requests
        .iter()
        .flat_map(|request| match &request.kind {
            RequestKind::Functions(functions) => functions.as_slice(),
            _ => &[],
        });
    let moving = constraints
        .chain(motions)
        .chain(forces)
        .chain(vectors)
        .chain(variables)
        .chain(differentials);
    let sensors = dataset
        .sensors
        .iter()
        .flat_map(|element| [Some(&element.function), element.evaluate.as_ref()])
        .flatten();
    let outputs = requests.flatten().chain(sensors);
    let moving = moving.map(|expression| (expression, Place::Motion));
    moving.chain(outputs.map(|expression| (expression, Place::Output)))
}

/// An argument of a call that is a number without point, sign or name.
struct Named {
    /// Of the call.
    span: Span,
    function: Function,
    position: usize,
    id: u32,
}

impl Named {
    fn kind(&self) -> ArgumentKind {
        self.function.argument_kind(self.position)
    }

    fn is_marker(&self) -> bool {
        let kind = self.kind();
        matches!(kind, ArgumentKind::Marker | ArgumentKind::MarkerOrGround)
    }
}

/// Calls `each` with every argument of an expression that may name an element.
fn visit_named(expression: &Expression, each: &mut impl FnMut(Named)) {
    expression.root.visit(&mut |call| {
        let Expr::Call {
            function,
            arguments,
            span,
        } = call
        else {
            return;
        };
        for (position, argument) in arguments.iter().enumerate() {
            if let Some(id) = argument.as_id() {
                each(Named {
                    span: *span,
                    function: *function,
                    position,
                    id,
                });
            }
        }
    });
}

/// Checks every expression of a dataset.
pub(super) fn check_all(dataset: &Dataset, diagnostics: &mut Diagnostics) {
    let mut missing = Vec::new();
    for (expression, place) in all(dataset) {
        friction(expression, place, diagnostics);
        visit_named(expression, &mut |named| {
            floating(dataset, &named, diagnostics);
            if !exists(dataset, named.kind(), named.id) {
                missing.push(named);
            }
        });
    }
    report(dataset, missing, diagnostics);
}

/// Calls `mark` with the numbers in calls that name markers, or may name some.
pub(crate) fn named_markers(dataset: &Dataset, mark: &mut impl FnMut(u32)) {
    for (expression, _) in all(dataset) {
        visit_named(expression, &mut |named| {
            if named.is_marker() || named.function == Function::User {
                mark(named.id);
            }
        });
    }
}

/// Reports a floating marker in a function other than those of the forces that act on it.
fn floating(dataset: &Dataset, named: &Named, diagnostics: &mut Diagnostics) {
    use Function as F;
    let of_forces = matches!(
        named.function,
        F::Fx | F::Fy | F::Fz | F::Fm | F::Tx | F::Ty | F::Tz | F::Tm | F::Fxyz | F::Txyz
    );
    if !named.is_marker() || of_forces && named.position < 2 {
        return;
    }
    let marker = dataset.markers.by_id(named.id);
    if marker.is_some_and(|marker| marker.floating) {
        references::report_floating(named.id, named.span, diagnostics);
    }
}

/// Checks the calls of `FRICTION(id, index)`, of which only outputs may read all.
fn friction(expression: &Expression, place: Place, diagnostics: &mut Diagnostics) {
    expression.root.visit(&mut |node| {
        let Expr::Call {
            function: Function::Friction,
            arguments,
            span,
        } = node
        else {
            return;
        };
        let index = arguments.get(1).and_then(Expr::as_id).unwrap_or(0);
        if !(1..=26).contains(&index) {
            let message = "the index of FRICTION goes from 1 to 26";
            diagnostics.error(Code::OutOfRange, *span, message).help(
                "1-6 force and torque, 7-13 coefficients, 14-19 velocity, 20-25 creep, 26 BETA",
            );
        }
        if place == Place::Motion && index > 6 {
            let message = "FRICTION of an index from 7 on can be read by a REQUEST or SENSOR only";
            diagnostics
                .error(Code::UnsupportedFunction, *span, message)
                .help("the force and torque, 1 to 6, can be read everywhere");
        }
    });
}

/// Reports what does not exist.
fn report(dataset: &Dataset, missing: Vec<Named>, diagnostics: &mut Diagnostics) {
    if missing.is_empty() {
        return;
    }
    let markers = references::sorted(&dataset.markers);
    let variables = references::sorted(&dataset.variables);
    for named in missing {
        let id = named.id;
        let (name, near) = match named.kind() {
            ArgumentKind::Element(ElementKind::Variable) => {
                ("VARIABLE", references::nearest(&variables, id))
            }
            ArgumentKind::Element(element) => (statement(element), None),
            _ => ("MARKER", references::nearest(&markers, id)),
        };
        references::report(diagnostics, name, id, named.span, near);
    }
}

/// Elements that a dataset cannot hold count as present: their functions are refused later.
fn exists(dataset: &Dataset, kind: ArgumentKind, id: u32) -> bool {
    let element = match kind {
        ArgumentKind::Real
        | ArgumentKind::Vector
        | ArgumentKind::Integer
        | ArgumentKind::Order
        | ArgumentKind::Coordinate => return true,
        ArgumentKind::MarkerOrGround if id == 0 => return true,
        ArgumentKind::Marker | ArgumentKind::MarkerOrGround => {
            return dataset.markers.position(id).is_some();
        }
        ArgumentKind::Element(element) => element,
    };
    let position = match element {
        ElementKind::Joint => dataset.joints.position(id),
        ElementKind::Primitive => dataset.primitives.position(id),
        ElementKind::Motion => dataset.motions.position(id),
        ElementKind::SingleForce => dataset.single_forces.position(id),
        ElementKind::SpringDamper => dataset.spring_dampers.position(id),
        ElementKind::VectorForce => dataset.vector_forces.position(id),
        ElementKind::VectorTorque => dataset.vector_torques.position(id),
        ElementKind::GeneralForce => dataset.general_forces.position(id),
        ElementKind::Bushing => dataset.bushings.position(id),
        ElementKind::Field => dataset.fields.position(id),
        ElementKind::Beam => dataset.beams.position(id),
        ElementKind::PointCurve => dataset.point_curves.position(id),
        ElementKind::Curve => dataset.curves.position(id),
        ElementKind::Spline => dataset.splines.position(id),
        ElementKind::Variable => dataset.variables.position(id),
        ElementKind::Differential => dataset.differentials.position(id),
        ElementKind::Array => dataset.arrays.position(id),
        ElementKind::Friction => dataset.frictions.position(id),
        ElementKind::PlantInput => dataset.plant_inputs.position(id),
        ElementKind::PlantOutput => dataset.plant_outputs.position(id),
        ElementKind::Sensor => dataset.sensors.position(id),
        ElementKind::Other => return true,
    };
    position.is_some()
}

const fn statement(element: ElementKind) -> &'static str {
    match element {
        ElementKind::Joint => "JOINT",
        ElementKind::Primitive => "JPRIM",
        ElementKind::Motion => "MOTION",
        ElementKind::SingleForce => "SFORCE",
        ElementKind::SpringDamper => "SPRINGDAMPER",
        ElementKind::VectorForce => "VFORCE",
        ElementKind::VectorTorque => "VTORQUE",
        ElementKind::GeneralForce => "GFORCE",
        ElementKind::Bushing => "BUSHING",
        ElementKind::Field => "FIELD",
        ElementKind::Beam => "BEAM",
        ElementKind::PointCurve => "PTCV",
        ElementKind::Curve => "CURVE",
        ElementKind::Spline => "SPLINE",
        ElementKind::Variable => "VARIABLE",
        ElementKind::Differential => "DIFF",
        ElementKind::Array => "ARRAY",
        ElementKind::Friction => "FRICTION",
        ElementKind::PlantInput => "PINPUT",
        ElementKind::PlantOutput => "POUTPUT",
        ElementKind::Sensor => "SENSOR",
        ElementKind::Other => "element",
    }
}
