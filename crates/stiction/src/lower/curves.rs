//! CURVE to curves in space, PTCV to joints and CURVE(...) to lookups.

use std::collections::HashMap;
use std::sync::Arc;

use dataset::{Code, Expr};
use mechanics::curve::{Curve, Drawing, Undrawable};
use mechanics::expression::{Binary, Operation, Register};
use mechanics::model::{Joint, JointKind, JointStart, Model};
use nalgebra::Vector3;
use numerics::interpolation::Surface;

use super::expression::{Compiler, Refused};
use super::{Lowering, label};

/// The curves of a model, each drawn once; `None` where one cannot be drawn, which was reported.
pub(super) type Curves = HashMap<u32, Option<Arc<Curve>>>;

/// Cosine of the least turn of a curve of lines that counts as a corner, less than one.
const CORNER: f64 = 1.0 - 1e-9;

impl Lowering<'_> {
    /// Points on curves in the order of the dataset, behind all other joints.
    pub(super) fn point_curves(&mut self, model: &mut Model) {
        let dataset = self.dataset;
        let mut places = HashMap::new();
        for point in &dataset.point_curves {
            let Some(curve) = self.curve(point.curve) else {
                continue;
            };
            if let Some(corner) = self.corner(point.curve) {
                let message = format!(
                    "PTCV/{}: CURVE/{} has a corner at its point {corner}, which nothing can pass \
                     without a jump of its velocity",
                    point.header.id, point.curve
                );
                let help = "draw it with ORDER = 4";
                self.error(
                    Code::InvalidConnection,
                    point.header.span,
                    message,
                    Some(help),
                );
            }
            let place = *places.entry(point.curve).or_insert_with(|| {
                model.curves.push(Curve::clone(&curve));
                model.curves.len() - 1
            });
            model.joints.push(Joint {
                label: label("PTCV", &point.header),
                kind: JointKind::PointOnCurve { curve: place },
                i: self.marker_place(point.i),
                j: self.marker_place(point.rm),
                translation_start: JointStart::default(),
                rotation_start: JointStart::default(),
            });
        }
    }

    /// Points of a curve; none where the checks of the dataset have reported it.
    fn points(&self, id: u32) -> Vec<Vector3<f64>> {
        let curve = self.dataset.curves.by_id(id);
        let matrix = curve.and_then(|curve| self.dataset.matrices.by_id(curve.matrix?));
        let values = matrix.and_then(|matrix| matrix.by_rows());
        let values = values.unwrap_or_default();
        values
            .chunks_exact(3)
            .map(Vector3::from_column_slice)
            .collect()
    }

    fn curve(&mut self, id: u32) -> Option<Arc<Curve>> {
        if let Some(drawn) = self.curves.get(&id) {
            return drawn.clone();
        }
        let points = self.points(id);
        let given = self.dataset.curves.by_id(id)?;
        let drawing = if given.order == 2 {
            Drawing::Lines
        } else {
            Drawing::Spline
        };
        let drawn = Curve::through(&points, given.closed, drawing);
        if let Err(reason) = drawn {
            let (code, message, help) = match reason {
                Undrawable::FewPoints => (
                    Code::MissingElement,
                    format!("CURVE/{id} has no points that a curve can be drawn through"),
                    None,
                ),
                Undrawable::Coincident(place) => (
                    Code::InvalidValue,
                    format!(
                        "CURVE/{id}: point {} is the same as the one before it",
                        place + 1
                    ),
                    Some("take one of the two out of its MATRIX"),
                ),
            };
            self.error(code, given.header.span, message, help);
        }
        let drawn = drawn.ok().map(Arc::new);
        self.curves.insert(id, drawn.clone());
        drawn
    }

    /// The number, from 1, of the first point at which a curve of lines turns.
    fn corner(&self, id: u32) -> Option<usize> {
        let curve = self.dataset.curves.by_id(id)?;
        let points = self.points(id);
        let turns = |three: &[Vector3<f64>]| {
            let (before, behind) = (three[1] - three[0], three[2] - three[1]);
            before.dot(&behind) < CORNER * before.norm() * behind.norm()
        };
        let corner = points.windows(3).position(turns)?;
        // A closed one has a corner somewhere in any case.
        (curve.order == 2).then_some(corner + 2)
    }
}

impl Compiler {
    /// `CURVE(x, order, component, id)`: the parameter x goes from -1 to 1 along the curve.
    pub(super) fn curve_coordinate(
        &mut self,
        lowering: &mut Lowering,
        arguments: &[Expr],
    ) -> Result<Register, Refused> {
        let number = |k: usize| arguments.get(k).and_then(Expr::as_id);
        let (Some(order), Some(component @ 1..=3), Some(id)) = (number(1), number(2), number(3))
        else {
            return Err(Refused);
        };
        let curve = lowering.curve(id).ok_or(Refused)?;
        let table = Arc::new(Surface::from(curve.axis(component as usize - 1).clone()));
        // The curve's own parameter s = (x + 1) length/2, by which its derivatives are taken.
        let half = 0.5 * curve.length();
        let x = self.expr(lowering, &arguments[0])?;
        let [one, rate, scale] = [1.0, half, half.powi(order as i32)]
            .map(|value| self.program.push(Operation::Constant(value)));
        let from_start = self.program.push(Operation::Binary(Binary::Add, x, one));
        let s = self
            .program
            .push(Operation::Binary(Binary::Multiply, rate, from_start));
        let value = self.program.push_lookup(&table, order as usize, s, s);
        Ok(self
            .program
            .push(Operation::Binary(Binary::Multiply, scale, value)))
    }
}
