//! Reactions of constraints that depend on one another, shared by least squares.
//!
//! The equations of motion have the multipliers `μ` of the equations that were kept, whose force on the
//! bodies is `Gₖᵀμ`. Any reactions `λ` of all equations, the dropped ones too, with `Gᵀλ = Gₖᵀμ` give the
//! same motion. Of those the least have, with the weight `w` of each equation,
//!
//! ```text
//! Σ (λ/w)² least   ⇔   λ = w² G ζ        ζ a displacement of the bodies
//! ```
//!
//! (the weighted Moore-Penrose inverse; Wojtyra, Pękal and Frączek, *Utilization of the Moore-Penrose
//! inverse in the modeling of overconstrained mechanisms with frictionless and frictional joints*,
//! Mechanism and Machine Theory 153, 2020). `ζ` is how the bodies would move if the joints gave way: the
//! reactions are those of springs, one in the place of each equation, of the stiffness `w²`, in the limit of
//! large stiffness. With forces `w` is one, with torques a length.
//!
//! With `Ĝ = w G D`, where `D` divides rotations by that length, `ζ = D z`, `μ̂ = μ/w` and parts
//! `λ̂ = λ/w`, those of the kept equations being `μ̂ − κ`, the unknowns are `z` and `y` (six a body), `ν` and
//! `κ` (one a kept equation) and the `λ̂` of the dropped ones,
//!
//! ```text
//! S z = Ĝₖᵀ ν             Ĝₖ z = μ̂ − κ        of the displacements that would do one
//! S y = Ĝₖᵀ κ − Ĝ_dᵀ λ̂    Ĝₖ y = 0            κ balances what the dropped equations have
//! λ̂ = Ĝ_d z
//! ```
//!
//! `y` is zero where the dropped equations depend on the kept ones exactly; the numbers of a dataset leave
//! it a little, which must not move anything. Which displacement `z` is does not matter, as the constraints
//! leave no other motion. `S` is the stiffness of springs against all relative motion of the markers of each
//! joint, so that bodies follow one another: with a displacement as small as can be, far bodies of a long
//! chain would have to do with one another. The unknowns are ones of Newton's iteration beside the
//! multipliers: so friction and what else reads reactions has those of the same instant, and the fronts of
//! the elimination stay small.

use nalgebra::{Matrix6, Vector6};
use numerics::linear::Matrix;
use serde::{Deserialize, Serialize};

use super::System;
use crate::constraint::{Evaluated, Form};
use crate::equation::Equation;
use crate::model::Reactions;
use crate::rotation::skew;

/// Unknowns a body: `z`, then `y`.
const A_BODY: usize = 12;

/// Where the unknowns of an equation are, behind those of the bodies too.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
enum Part {
    /// Of one that was kept: `ν`, then `κ`, and its row.
    Kept { nu: usize, kappa: usize, row: usize },
    /// Of one that was dropped: `λ̂`.
    Dropped(usize),
}

/// An equation that takes part.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Shared {
    constraint: usize,
    /// `w`.
    weight: f64,
    part: Part,
}

/// Which equations share their reactions, and the numbering of the unknowns for it. Those come after the
/// algebraic variables.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Sharing {
    /// What torques are divided by.
    length: f64,
    /// The equations, ascending, and the place of each among them, by constraint.
    equations: Vec<Shared>,
    of_constraint: Vec<Option<usize>>,
    /// Place of each body among those that the equations act on.
    of_body: Vec<Option<usize>>,
    /// The markers of the joints and motions that they belong to.
    links: Vec<[usize; 2]>,
    /// A body of each part of the mechanism that no such markers connect with ground.
    anchors: Vec<usize>,
    /// Number of unknowns.
    count: usize,
}

impl Sharing {
    /// Number of unknowns.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Where the unknowns of a body start among all of them.
    fn body(&self, body: usize) -> usize {
        A_BODY * self.of_body[body].expect("a shared equation acts on it")
    }

    fn equation(&self, constraint: usize) -> Option<&Shared> {
        let place = self.of_constraint.get(constraint).copied().flatten();
        place.map(|place| &self.equations[place])
    }

    /// `D`.
    fn unit(&self, motion: usize) -> f64 {
        if motion % 6 < 3 {
            1.0
        } else {
            1.0 / self.length
        }
    }

    /// A block of `Ĝ`.
    fn scaled(&self, shared: &Shared, block: &[f64; 6]) -> [f64; 6] {
        std::array::from_fn(|k| shared.weight * block[k] * self.unit(k))
    }
}

/// The weight of an equation: reactions divided by it are forces, or torques over the length.
fn weight(form: Form, evaluated: &Evaluated, length: f64) -> f64 {
    match form {
        Form::Pair {
            equation: Equation::Along(_) | Equation::Thread { .. } | Equation::OnCurve { .. },
            ..
        } => 1.0,
        Form::Pair { .. } => length,
        // The largest force that a unit multiplier applies to a body, torques divided by the length.
        Form::Function => {
            let square = |k: usize, g: f64| if k < 3 { g * g } else { (g / length).powi(2) };
            let blocks = evaluated.jacobian.iter();
            let sizes = blocks.map(|block| (0..6).map(|k| square(k, block[k])).sum::<f64>());
            let largest = sizes.fold(0.0_f64, f64::max).sqrt();
            if largest > 0.0 && largest.is_finite() {
                1.0 / largest
            } else {
                1.0
            }
        }
    }
}

impl System {
    /// Chooses the equations that share their reactions, with weights as the bodies stand: those of
    /// loops where some were dropped, if the model wants it so.
    pub(crate) fn share_reactions(&mut self) {
        self.sharing = Sharing::default();
        let Reactions::LeastSquares { length } = self.model.reactions else {
            return;
        };
        let places = self.constraints_of_dependent_loops();
        if places.is_empty() {
            return;
        }
        let length = length.unwrap_or_else(|| self.length_scale());
        let mut sharing = Sharing {
            length,
            of_constraint: vec![None; self.constraints.len()],
            of_body: vec![None; self.bodies.len()],
            ..Sharing::default()
        };
        let mut bodies = 0;
        for &place in &places {
            for &body in &self.constraints[place].bodies {
                sharing.of_body[body].get_or_insert_with(|| {
                    bodies += 1;
                    bodies - 1
                });
            }
        }
        sharing.count = A_BODY * bodies;
        let mut next = || {
            sharing.count += 1;
            sharing.count - 1
        };
        for place in places {
            let constraint = &self.constraints[place];
            let part = match constraint.row {
                Some(row) => Part::Kept {
                    nu: next(),
                    kappa: next(),
                    row,
                },
                None => Part::Dropped(next()),
            };
            sharing.of_constraint[place] = Some(sharing.equations.len());
            sharing.equations.push(Shared {
                constraint: place,
                weight: weight(constraint.form, &self.evaluated[place], length),
                part,
            });
        }
        self.sharing = sharing;
        self.link_shared();
    }

    /// Finds the links of the shared equations, and what they leave afloat.
    fn link_shared(&mut self) {
        let ground = self.bodies.len();
        // The next body towards the one that stands for all that are connected.
        let mut towards: Vec<usize> = (0..=ground).collect();
        let find = |towards: &mut Vec<usize>, mut body: usize| {
            while towards[body] != body {
                towards[body] = towards[towards[body]];
                body = towards[body];
            }
            body
        };
        let sharing = &mut self.sharing;
        for shared in &sharing.equations {
            let Form::Pair { i, j, .. } = self.constraints[shared.constraint].form else {
                continue;
            };
            if sharing.links.last() == Some(&[i, j]) {
                continue;
            }
            sharing.links.push([i, j]);
            let [a, b] = [i, j].map(|marker| self.model.markers[marker].body.unwrap_or(ground));
            let [a, b] = [find(&mut towards, a), find(&mut towards, b)];
            // Ground stands for all that it is connected with.
            towards[a.min(b)] = a.max(b);
        }
        for body in 0..ground {
            if sharing.of_body[body].is_some() && find(&mut towards, body) == body {
                sharing.anchors.push(body);
            }
        }
    }

    /// The relative motion of the markers of a link, that of the origin of I seen from J and the rotation,
    /// as two bodies cause it by their `z`.
    fn link(&self, [i, j]: [usize; 2]) -> [(Option<usize>, Matrix6<f64>); 2] {
        let [i, j] = [i, j].map(|marker| self.frame(marker));
        let reach = j.arm + (i.origin - j.origin);
        [(i.body, i.arm, 1.0), (j.body, reach, -1.0)].map(|(body, arm, sign)| {
            let mut motion = sign * Matrix6::identity();
            if body.is_some_and(|body| self.model.bodies[body].rotates) {
                let by_turn = -sign / self.sharing.length * skew(&arm);
                motion.fixed_view_mut::<3, 3>(0, 3).copy_from(&by_turn);
            }
            (body, motion)
        })
    }

    /// Where the unknowns start among multipliers.
    pub(crate) fn first_shared(&self) -> usize {
        self.rows.len() + self.model.algebraics.len()
    }

    /// The group of each unknown: that of its body, or of its equation.
    pub(super) fn sharing_groups(&self) -> Vec<Option<u32>> {
        let mut groups = vec![None; self.sharing.count];
        for (body, place) in self.sharing.of_body.iter().enumerate() {
            if let Some(place) = place {
                groups[A_BODY * place..A_BODY * (place + 1)].fill(Some(body as u32));
            }
        }
        let equations = self.sharing.equations.iter();
        let bodies = self.bodies_of(equations.clone().map(|shared| &shared.constraint));
        for (shared, body) in equations.zip(bodies) {
            match shared.part {
                Part::Kept { nu, kappa, .. } => (groups[nu], groups[kappa]) = (body, body),
                Part::Dropped(part) => groups[part] = body,
            }
        }
        groups
    }

    /// The body's motion (`Ok`) or the constraint (`Err`) that an unknown belongs to.
    pub(crate) fn shared_place(&self, unknown: usize) -> Option<Result<usize, usize>> {
        let of_equation = |shared: &&Shared| match shared.part {
            Part::Kept { nu, kappa, .. } => nu == unknown || kappa == unknown,
            Part::Dropped(part) => part == unknown,
        };
        if let Some(shared) = self.sharing.equations.iter().find(of_equation) {
            return Some(Err(shared.constraint));
        }
        let place = Some(unknown / A_BODY);
        let body = self.sharing.of_body.iter().position(|of| *of == place)?;
        Some(Ok(6 * body + unknown % 6))
    }

    /// The multiplier of a constraint equation, as its element's reaction has it: zero where it was
    /// dropped and reactions are not shared.
    pub(crate) fn multiplier(&self, constraint: usize, multipliers: &[f64]) -> f64 {
        let mut sum = 0.0;
        self.multiplier_parts(constraint, |place, slope| sum += slope * multipliers[place]);
        sum
    }

    /// Calls `add(place, slope)` for every place among the multipliers that the multiplier of a constraint
    /// equation is a sum of.
    pub(crate) fn multiplier_parts(&self, constraint: usize, mut add: impl FnMut(usize, f64)) {
        let row = self.constraints[constraint].row;
        if let Some(row) = row {
            add(row, 1.0);
        }
        let Some(shared) = self.sharing.equation(constraint) else {
            return;
        };
        let first = self.first_shared();
        match shared.part {
            Part::Kept { kappa, .. } => add(first + kappa, -shared.weight),
            Part::Dropped(part) => add(first + part, shared.weight),
        }
    }

    /// `Ĝ` times `z` (`first` zero) or `y` (six) for one equation.
    fn shared_along(&self, shared: &Shared, unknowns: &[f64], first: usize) -> f64 {
        let constraint = &self.constraints[shared.constraint];
        let blocks = self.evaluated[shared.constraint].blocks(constraint);
        blocks
            .map(|(body, block)| {
                let from = self.sharing.body(body) + first;
                let block = self.sharing.scaled(shared, block);
                (0..6).map(|k| block[k] * unknowns[from + k]).sum::<f64>()
            })
            .sum()
    }

    /// What the unknowns lack of their equations.
    pub(super) fn sharing_residual(&self, multipliers: &[f64], out: &mut [f64]) {
        let unknowns = &multipliers[self.first_shared()..];
        out.fill(0.0);
        for &body in &self.sharing.anchors {
            let from = self.sharing.body(body);
            for k in from..from + A_BODY {
                out[k] = -unknowns[k];
            }
        }
        for &link in &self.sharing.links {
            let sides = self.link(link);
            for first in [0, 6] {
                let mut relative = Vector6::zeros();
                for (body, motion) in &sides {
                    if let Some(body) = *body {
                        let from = self.sharing.body(body) + first;
                        relative += motion * Vector6::from_column_slice(&unknowns[from..from + 6]);
                    }
                }
                for (body, motion) in &sides {
                    if let Some(body) = *body {
                        let from = self.sharing.body(body) + first;
                        let pull = motion.tr_mul(&relative);
                        for k in 0..6 {
                            out[from + k] -= pull[k];
                        }
                    }
                }
            }
        }
        for shared in &self.sharing.equations {
            let along = self.shared_along(shared, unknowns, 0);
            let [of_z, of_y] = shared.part.forces(unknowns);
            match shared.part {
                Part::Kept { nu, kappa, row } => {
                    out[nu] = multipliers[row] / shared.weight - unknowns[kappa] - along;
                    out[kappa] = -self.shared_along(shared, unknowns, 6);
                }
                Part::Dropped(part) => out[part] = along - unknowns[part],
            }
            let constraint = &self.constraints[shared.constraint];
            for (body, block) in self.evaluated[shared.constraint].blocks(constraint) {
                let from = self.sharing.body(body);
                let block = self.sharing.scaled(shared, block);
                for k in 0..6 {
                    out[from + k] += block[k] * of_z;
                    out[from + 6 + k] += block[k] * of_y;
                }
            }
        }
    }

    /// Rows of the unknowns. How `Ĝ` changes with the bodies is left out: friction follows the shares by a
    /// part `μ` of the load over a length of the mechanism, far less than it follows creep or inertia
    /// follows a step.
    pub(super) fn assemble_sharing(&self, matrix: &mut Matrix) {
        let n = self.rate_count();
        let first = n + self.first_shared();
        for &body in &self.sharing.anchors {
            let from = first + self.sharing.body(body);
            for k in from..from + A_BODY {
                matrix.add(k, k, 1.0);
            }
        }
        for &link in &self.sharing.links {
            let sides = self.link(link);
            for (row, by_row) in &sides {
                for (column, by_column) in &sides {
                    let (Some(row), Some(column)) = (*row, *column) else {
                        continue;
                    };
                    let block = by_row.tr_mul(by_column).transpose().data.0;
                    for of in [0, 6] {
                        let (row, column) = (self.sharing.body(row), self.sharing.body(column));
                        matrix.add_block(first + row + of, first + column + of, &block);
                    }
                }
            }
        }
        for shared in &self.sharing.equations {
            match shared.part {
                Part::Kept { nu, kappa, row } => {
                    matrix.add(first + nu, first + kappa, 1.0);
                    matrix.add(first + nu, n + row, -1.0 / shared.weight);
                }
                Part::Dropped(part) => matrix.add(first + part, first + part, 1.0),
            }
            let constraint = &self.constraints[shared.constraint];
            for (body, block) in self.evaluated[shared.constraint].blocks(constraint) {
                let from = first + self.sharing.body(body);
                let block = self.sharing.scaled(shared, block);
                let opposite = block.map(|g| -g);
                match shared.part {
                    Part::Kept { nu, kappa, .. } => {
                        matrix.add_block(first + nu, from, &[block]);
                        matrix.add_block(first + kappa, from + 6, &[block]);
                        matrix.add_block(from, first + nu, &opposite.map(|g| [g]));
                        matrix.add_block(from + 6, first + kappa, &opposite.map(|g| [g]));
                    }
                    Part::Dropped(part) => {
                        matrix.add_block(first + part, from, &[opposite]);
                        matrix.add_block(from + 6, first + part, &block.map(|g| [g]));
                    }
                }
            }
        }
    }
}

impl Part {
    /// What multiplies `Ĝᵀ` in the equations of `z` and of `y`.
    fn forces(self, unknowns: &[f64]) -> [f64; 2] {
        match self {
            Self::Kept { nu, kappa, .. } => [unknowns[nu], unknowns[kappa]],
            Self::Dropped(part) => [0.0, -unknowns[part]],
        }
    }
}
