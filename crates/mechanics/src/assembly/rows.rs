//! The constraint equations and initial conditions in dimensionless form, as assembly solves them.

use super::report::Unmet;
use crate::constraint::{Evaluated, Form, name};
use crate::equation::{Axis, Equation, Local, Pair};
use crate::model::{Element, Label, Level, MotionFreedom};
use crate::system::System;

/// What an error of a constraint equation is.
const LENGTH: &str = "units of length";
const ANGLE: &str = "radians";

/// A displacement or velocity that a joint or motion starts with.
pub(super) struct Start {
    equation: Equation,
    i: usize,
    j: usize,
    displacement: Option<f64>,
    velocity: Option<f64>,
    label: Label,
}

/// A body and the part of a row in its motions.
pub(super) type Block = (usize, [f64; 6]);

/// One row of the assembly equations: error, wanted rate, and Jacobian by body, scaled.
pub(super) struct Row {
    pub(super) error: f64,
    pub(super) rate: f64,
    pub(super) blocks: Vec<Block>,
    pub(super) in_position: bool,
    pub(super) in_velocity: bool,
    /// What errors and rates are multiplied with to become dimensionless, and what they are.
    pub(super) scale: f64,
    pub(super) quantity: &'static str,
    pub(super) label: Label,
    pub(super) name: String,
}

impl System {
    pub(super) fn starts(&self) -> Vec<Start> {
        let mut starts = Vec::new();
        for (place, joint) in self.model.joints.iter().enumerate() {
            if !self.model.is_active(Element::Joint(place)) {
                continue;
            }
            let given = [
                (Equation::Along(2), joint.translation_start),
                (Equation::About(Axis::Z), joint.rotation_start),
            ];
            for (equation, start) in given {
                if start.displacement.is_some() || start.velocity.is_some() {
                    starts.push(Start {
                        equation,
                        i: joint.i,
                        j: joint.j,
                        displacement: start.displacement,
                        velocity: start.velocity,
                        label: joint.label.clone(),
                    });
                }
            }
        }
        for motion in self
            .model
            .motions
            .iter()
            .enumerate()
            .filter(|(place, _)| self.model.is_active(Element::Motion(*place)))
            .map(|(_, motion)| motion)
            .filter(|motion| motion.level != Level::Position)
        {
            let equation = match motion.freedom {
                MotionFreedom::Along(axis) => Equation::Along(axis),
                MotionFreedom::AboutZ => Equation::About(Axis::Z),
            };
            starts.push(Start {
                equation,
                i: motion.i,
                j: motion.j,
                displacement: motion.start.displacement,
                velocity: match motion.level {
                    Level::Acceleration => motion.start.velocity,
                    _ => None,
                },
                label: motion.label.clone(),
            });
        }
        starts
    }

    /// Rows in dimensionless form: displacements in units of the model's length.
    pub(super) fn assembly_rows(&self, starts: &[Start], length: f64) -> Vec<Row> {
        let mut rows = Vec::with_capacity(self.rows.len() + starts.len());
        for (constraint, evaluated) in self.constraints.iter().zip(&self.evaluated) {
            if constraint.row.is_none() {
                continue;
            }
            let (scale, quantity) = scale_of(constraint.form, evaluated, length);
            let blocks = evaluated.blocks(constraint);
            rows.push(Row {
                error: scale * evaluated.error,
                rate: scale * evaluated.rate,
                blocks: blocks
                    .map(|(body, g)| (body, scaled(g, scale, length)))
                    .collect(),
                in_position: constraint.level == Level::Position,
                in_velocity: constraint.level != Level::Acceleration,
                scale,
                quantity,
                label: self.owner_label(constraint.owner).clone(),
                name: name(constraint.form),
            });
        }
        for start in starts {
            let (i, j) = (self.marker(start.i), self.marker(start.j));
            let mut jacobian = Local::zeros();
            let value = start
                .equation
                .evaluate(&Pair::new(&i, &j), &[], &mut jacobian);
            let along = matches!(start.equation, Equation::Along(_));
            let (scale, quantity) = if along {
                (1.0 / length, LENGTH)
            } else {
                (1.0, ANGLE)
            };
            let mut blocks = Vec::new();
            for (side, body) in [(0, i.body), (6, j.body)] {
                if let Some(body) = body {
                    let g = std::array::from_fn(|k| jacobian[side + k]);
                    blocks.push((body, scaled(&g, scale, length)));
                }
            }
            let mut error = value - start.displacement.unwrap_or(value);
            if !along {
                error -= std::f64::consts::TAU * (error / std::f64::consts::TAU).round();
            }
            rows.push(Row {
                error: scale * error,
                rate: scale * start.velocity.unwrap_or(0.0),
                blocks,
                in_position: start.displacement.is_some(),
                in_velocity: start.velocity.is_some(),
                scale,
                quantity,
                label: start.label.clone(),
                name: "initial condition".to_owned(),
            });
        }
        rows
    }
}

/// What errors of an equation are multiplied with to become dimensionless, and what they are.
pub(super) fn scale_of(form: Form, evaluated: &Evaluated, length: f64) -> (f64, &'static str) {
    match form {
        Form::Pair {
            equation: Equation::Along(_) | Equation::Thread { .. } | Equation::OnCurve { .. },
            ..
        } => (1.0 / length, LENGTH),
        Form::Pair { .. } => (1.0, ANGLE),
        // Unknown dimension: scaled by the gradient where it is known.
        Form::Function => (gradient_scale(&evaluated.jacobian, length), ""),
    }
}

fn scaled(g: &[f64; 6], scale: f64, length: f64) -> [f64; 6] {
    std::array::from_fn(|k| g[k] * scale * if k < 3 { length } else { 1.0 })
}

fn gradient_scale(jacobian: &[[f64; 6]], length: f64) -> f64 {
    let size = |g: &[f64; 6]| scaled(g, 1.0, length).iter().map(|v| v * v).sum::<f64>();
    let norm = jacobian.iter().map(size).sum::<f64>().sqrt();
    if norm > 0.0 && norm.is_finite() {
        1.0 / norm
    } else {
        1.0
    }
}

/// The bodies that rows are about, ascending.
pub(super) fn bodies_of<'a>(rows: impl Iterator<Item = &'a Row>) -> Vec<usize> {
    let bodies = rows.flat_map(|row| row.blocks.iter().map(|block| block.0));
    let mut bodies: Vec<usize> = bodies.collect();
    bodies.sort_unstable();
    bodies.dedup();
    bodies
}

impl Row {
    /// Its blocks by place among `bodies`, which are all that it is about, ascending.
    pub(super) fn among(&self, bodies: &[usize]) -> Vec<Block> {
        let place = |body: &usize| bodies.binary_search(body).unwrap_or_default();
        let blocks = self.blocks.iter();
        blocks.map(|(body, g)| (place(body), *g)).collect()
    }
}

/// Blocks over `bodies` bodies as a full row.
pub(super) fn expand(blocks: &[Block], bodies: usize) -> Vec<f64> {
    let mut full = vec![0.0; 6 * bodies];
    for (body, block) in blocks {
        for k in 0..6 {
            full[6 * body + k] += block[k];
        }
    }
    full
}

pub(super) fn along(row: &Row, velocities: &[f64]) -> f64 {
    let products = row.blocks.iter().flat_map(|(body, block)| {
        block
            .iter()
            .zip(&velocities[6 * body..])
            .map(|(g, v)| g * v)
    });
    products.sum()
}

/// The rows whose dimensionless `error` is beyond rounding, the largest first.
pub(super) fn unmet(rows: &[Row], error: impl Fn(&Row) -> f64) -> Vec<Unmet> {
    let mut unmet: Vec<(f64, Unmet)> = rows
        .iter()
        .map(|row| (error(row).abs(), row))
        .filter(|(error, _)| !(*error <= 1e-12))
        .map(|(error, row)| {
            let unmet = Unmet {
                owner: row.label.clone(),
                equation: row.name.clone(),
                error: error / row.scale,
                quantity: row.quantity,
            };
            (error, unmet)
        })
        .collect();
    unmet.sort_by(|a, b| b.0.total_cmp(&a.0));
    unmet.into_iter().map(|(_, unmet)| unmet).collect()
}
