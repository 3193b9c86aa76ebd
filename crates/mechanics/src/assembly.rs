//! Initial positions and velocities that meet the constraints, and redundant equations.
//!
//! Positions: Gauss-Newton steps, each the smallest weighted change of positions and rotations
//! that meets the linearised constraints. Components given as EXACT weigh so much that they stay.
//! Redundant equations do no harm there: a small number on the diagonal of the multipliers selects
//! the smallest ones (Tikhonov). Velocities: one such step. Then the equations that depend on
//! others are found (`numerics::rank`), and what they say must hold anyway.

use nalgebra::Vector3;
use numerics::linear::{Matrix, SparseLu};
use numerics::rank::independent_rows;

use crate::constraint::{Form, Owner, codirected_axes, name};
use crate::equation::Equation;
use crate::model::{Label, Level, MotionFreedom};
use crate::state::State;
use crate::system::System;

/// What is left of a row, relative to its length, for it to count as independent. Datasets carry
/// six to ten digits, so equations that are redundant by design are dependent to that accuracy.
const RANK_TOLERANCE: f64 = 1e-5;
/// Equations that were dropped must hold to this accuracy (lengths relative to the model's).
const CONSISTENT: f64 = 1e-4;
/// Iterations before assembly is given up.
const ITERATIONS: usize = 60;
/// Largest rotation in one step, 30 degrees, as the default of the IC statement.
const LARGEST_TURN: f64 = std::f64::consts::FRAC_PI_6;
/// Weight of components that must stay, against one for the others.
const EXACT_WEIGHT: f64 = 1e10;
/// Weight of velocities that were given, against one for the others.
const GIVEN_WEIGHT: f64 = 1e6;
/// Diagonal of the multipliers that makes redundant equations harmless.
const REGULARISATION: f64 = 1e-10;
/// Where steps no longer lessen the error, that number grows up to this.
const LARGEST_REGULARISATION: f64 = 1.0;
/// What an error of a constraint equation is.
const LENGTH: &str = "units of length";
const ANGLE: &str = "radians";

/// An equation found redundant and dropped.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Redundancy {
    /// The element that it belongs to.
    pub owner: Label,
    /// The equation, in terms of the axes of I and J.
    pub equation: String,
}

/// How far assembly moved a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// The body.
    pub body: Label,
    /// Displacement of its centre of mass.
    pub distance: f64,
    /// Rotation, radians.
    pub angle: f64,
}

/// How far assembly changed a body's velocity.
#[derive(Clone, Debug, PartialEq)]
pub struct VelocityChange {
    /// The body.
    pub body: Label,
    /// Change of the velocity of its centre of mass.
    pub linear: f64,
    /// Change of its angular velocity, radians per time.
    pub angular: f64,
}

/// What assembly did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Assembly {
    /// Bodies that were moved, beyond rounding.
    pub moved: Vec<Moved>,
    /// Bodies whose given velocities were changed, beyond rounding.
    pub velocity_changes: Vec<VelocityChange>,
    /// Equations that were dropped because they depend on others.
    pub redundant: Vec<Redundancy>,
    /// Frictions whose joint's reaction is not unique for that reason, by place in the model.
    pub not_unique: Vec<usize>,
    /// Iterations on the positions.
    pub iterations: usize,
}

/// A constraint equation that could not be met.
#[derive(Clone, Debug, PartialEq)]
pub struct Unmet {
    /// The element that it belongs to.
    pub owner: Label,
    /// The equation, in terms of the axes of I and J.
    pub equation: String,
    /// How far it is from being met: a length, an angle in radians, or their rate.
    pub error: f64,
    /// What the error is, for messages.
    pub quantity: &'static str,
}

impl std::fmt::Display for Unmet {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            owner,
            equation,
            error,
            quantity,
        } = self;
        write!(f, "{owner}, {equation}: off by {error:.3e} {quantity}")
    }
}

/// Assembly failed.
#[derive(Clone, Debug, PartialEq)]
pub enum AssemblyError {
    /// The constraints cannot be met together.
    Inconsistent {
        /// Equations that are not met in the positions given, the largest error first.
        given: Vec<Unmet>,
        /// Equations that are not met in the best positions found, the largest error first.
        unmet: Vec<Unmet>,
    },
    /// A joint's axes are opposite instead of co-directed.
    Opposite {
        /// The joint.
        joint: Label,
        /// Axis 0, 1 or 2 (x, y or z).
        axis: usize,
    },
    /// Velocities that the constraints prescribe contradict one another.
    Velocities {
        /// Elements whose equations are not met, with the error left, the largest first.
        unmet: Vec<Unmet>,
    },
    /// A function of time or displacement gives no number.
    NotANumber {
        /// The element.
        element: String,
    },
}

impl std::fmt::Display for AssemblyError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let list = |unmet: &[Unmet]| {
            let lines: Vec<String> = unmet.iter().take(10).map(ToString::to_string).collect();
            lines.join("; ")
        };
        match self {
            Self::Inconsistent { given, unmet } => {
                write!(
                    f,
                    "the joints cannot be assembled; not met in the positions given: {}; not met in \
                     the best positions found: {}",
                    list(given),
                    list(unmet)
                )
            }
            Self::Opposite { joint, axis } => write!(
                f,
                "{joint} has opposite {0} axes of its I and J markers; they must point the same way",
                ["x", "y", "z"][*axis]
            ),
            Self::Velocities { unmet } => {
                write!(
                    f,
                    "the initial velocities contradict one another; not met: {}",
                    list(unmet)
                )
            }
            Self::NotANumber { element } => {
                write!(
                    f,
                    "{element} gives a value that is not a finite number at the start"
                )
            }
        }
    }
}

impl std::error::Error for AssemblyError {}

/// A displacement or velocity that a joint or motion starts with.
struct Start {
    equation: Equation,
    i: usize,
    j: usize,
    displacement: Option<f64>,
    velocity: Option<f64>,
    label: Label,
}

/// One row of the assembly equations: error, wanted rate, and Jacobian by body, scaled.
struct Row {
    error: f64,
    rate: f64,
    blocks: Vec<(usize, [f64; 6])>,
    in_position: bool,
    in_velocity: bool,
    /// What errors and rates are multiplied with to become dimensionless, and what they are.
    scale: f64,
    quantity: &'static str,
    label: Label,
    name: String,
}

impl System {
    /// A length that is typical of the model: the farthest marker from its body's centre of mass,
    /// or from ground's origin where no body has one.
    #[must_use]
    pub fn length_scale(&self) -> f64 {
        let used = self.constraints.iter().filter_map(|c| match c.form {
            Form::Pair { i, j, .. } => Some([i, j]),
            Form::Function => None,
        });
        let used = used.chain(self.model.forces.iter().map(|force| [force.i, force.j]));
        let mut largest = [0.0_f64; 2];
        for marker in used.flatten().map(|m| &self.model.markers[m]) {
            let on = usize::from(marker.body.is_none());
            largest[on] = largest[on].max(marker.offset.norm());
        }
        let gyration = self
            .model
            .bodies
            .iter()
            .filter(|b| b.mass > 0.0)
            .map(|b| (b.inertia.trace() / (2.0 * b.mass)).sqrt());
        let gyration = gyration.fold(0.0_f64, f64::max);
        if largest[0].max(gyration) > 0.0 {
            largest[0].max(gyration)
        } else if largest[1] > 0.0 {
            largest[1]
        } else {
            1.0
        }
    }

    /// The state that the model gives, before assembly.
    #[must_use]
    pub fn given_state(&self, time: f64) -> State {
        let bodies = &self.model.bodies;
        let mut values = vec![0.0; 13 * bodies.len()];
        let (positions, velocities) = values.split_at_mut(7 * bodies.len());
        for (place, body) in bodies.iter().enumerate() {
            let centre = body.origin + body.orientation.matrix() * body.centre;
            positions[7 * place..7 * place + 3].copy_from_slice(centre.as_slice());
            body.orientation
                .normalized()
                .write(&mut positions[7 * place + 3..7 * place + 7]);
            velocities[6 * place..6 * place + 3].copy_from_slice(body.velocity.as_slice());
            velocities[6 * place + 3..6 * place + 6]
                .copy_from_slice(body.angular_velocity.as_slice());
        }
        State { time, values }
    }

    fn starts(&self) -> Vec<Start> {
        let mut starts = Vec::new();
        for joint in &self.model.joints {
            let given = [
                (Equation::Along(2), joint.translation_start),
                (Equation::AboutZ, joint.rotation_start),
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
            .filter(|m| m.level != Level::Position)
        {
            let equation = match motion.freedom {
                MotionFreedom::Along(axis) => Equation::Along(axis),
                MotionFreedom::AboutZ => Equation::AboutZ,
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

    /// Brings `state` onto the constraints with as little change as needed, finds redundant
    /// equations and drops them, and starts the history of friction there.
    ///
    /// # Errors
    /// [`AssemblyError`] where the constraints contradict one another.
    pub fn assemble_initial(&mut self, state: &mut State) -> Result<Assembly, AssemblyError> {
        let given = state.clone();
        let length = self.length_scale();
        let all = vec![true; self.constraints.len()];
        self.set_active(&all);
        self.history.angles.fill(0.0);
        let starts = self.starts();
        let exact = self.position_weights();
        let iterations = self.assemble_positions(state, &starts, &exact, length)?;
        let (active, order) = self.independent(length);
        self.set_active(&active);
        // What inaccurate redundant equations left over is now removed from the others.
        self.assemble_positions(state, &starts, &exact, length)?;
        self.check_directions()?;
        let not_unique = self.not_unique(&active, length);
        self.assemble_velocities(state, &starts, length)?;
        self.start_history();
        let redundant = order
            .into_iter()
            .filter(|&place| !active[place])
            .map(|place| Redundancy {
                owner: self.owner_label(self.constraints[place].owner).clone(),
                equation: name(self.constraints[place].form),
            })
            .collect();
        Ok(Assembly {
            moved: self.moved(&given, state, length),
            velocity_changes: self.velocity_changes(&given, state, length),
            redundant,
            not_unique,
            iterations,
        })
    }

    /// Weights of the position components: large for those that must stay.
    fn position_weights(&self) -> Vec<f64> {
        let weights = self.model.bodies.iter().flat_map(|body| body.exact);
        weights
            .map(|exact| if exact { EXACT_WEIGHT } else { 1.0 })
            .collect()
    }

    fn velocity_weights(&self) -> Vec<f64> {
        let weights = self
            .model
            .bodies
            .iter()
            .flat_map(|body| body.given_velocity);
        weights
            .map(|given| if given { GIVEN_WEIGHT } else { 1.0 })
            .collect()
    }

    /// Rows in dimensionless form: displacements in units of the model's length.
    fn assembly_rows(&self, starts: &[Start], length: f64) -> Vec<Row> {
        let mut rows = Vec::with_capacity(self.rows.len() + starts.len());
        for (constraint, evaluated) in self.constraints.iter().zip(&self.evaluated) {
            if constraint.row.is_none() {
                continue;
            }
            let (scale, quantity) = match constraint.form {
                Form::Pair {
                    equation: Equation::Along(_),
                    ..
                } => (1.0 / length, LENGTH),
                Form::Pair { .. } => (1.0, ANGLE),
                // Unknown dimension: scaled by the gradient where it is known.
                Form::Function => (gradient_scale(&evaluated.jacobian, length), ""),
            };
            let blocks = constraint.bodies.iter().zip(&evaluated.jacobian);
            rows.push(Row {
                error: scale * evaluated.error,
                rate: scale * evaluated.rate,
                blocks: blocks
                    .map(|(&body, g)| (body, scaled(g, scale, length)))
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
            let row = start.equation.evaluate(&i, &j);
            let along = matches!(start.equation, Equation::Along(_));
            let (scale, quantity) = if along {
                (1.0 / length, LENGTH)
            } else {
                (1.0, ANGLE)
            };
            let mut blocks = Vec::new();
            for (side, body) in [(0, i.body), (6, j.body)] {
                if let Some(body) = body {
                    let g = std::array::from_fn(|k| row.jacobian[side + k]);
                    blocks.push((body, scaled(&g, scale, length)));
                }
            }
            let mut error = row.value - start.displacement.unwrap_or(row.value);
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

    /// Rows at `state`, those that say nothing of positions emptied.
    fn position_rows(&mut self, state: &State, starts: &[Start], length: f64) -> Vec<Row> {
        self.evaluate(state, false);
        let mut rows = self.assembly_rows(starts, length);
        for row in rows.iter_mut().filter(|row| !row.in_position) {
            row.error = 0.0;
            row.blocks.iter_mut().for_each(|block| block.1 = [0.0; 6]);
        }
        rows
    }

    fn assemble_positions(
        &mut self,
        state: &mut State,
        starts: &[Start],
        weights: &[f64],
        length: f64,
    ) -> Result<usize, AssemblyError> {
        let n = self.velocity_count();
        let mut least = Least::new(n, self.row_count() + starts.len());
        let mut regularisation = REGULARISATION;
        let mut best = f64::INFINITY;
        let mut kept = state.clone();
        let given = unmet(&self.position_rows(state, starts, length), |row| row.error);
        for iteration in 0..ITERATIONS {
            let mut rows = self.position_rows(state, starts, length);
            if rows.iter().any(|row| !row.error.is_finite()) {
                return Err(AssemblyError::NotANumber {
                    element: self.find_not_a_number(),
                });
            }
            let error = rows.iter().fold(0.0_f64, |m, row| m.max(row.error.abs()));
            if error < 1e-14 {
                return Ok(iteration);
            }
            if error < 0.9 * best {
                best = error;
                kept.clone_from(state);
            } else {
                // Redundant equations that contradict one another leave an error that no step
                // removes; smaller multipliers keep the steps from running away with it.
                regularisation *= 100.0;
                if regularisation > LARGEST_REGULARISATION {
                    break;
                }
                state.clone_from(&kept);
                rows = self.position_rows(state, starts, length);
            }
            let right: Vec<f64> = rows.iter().map(|row| -row.error).collect();
            let mut change = least.solve(&rows, weights, &vec![0.0; n], &right, regularisation);
            for body in change.chunks_exact_mut(6) {
                let turn = Vector3::from_column_slice(&body[3..6]).norm();
                let limit = (LARGEST_TURN / turn.max(1e-300)).min(1.0);
                for k in 0..6 {
                    body[k] *= if k < 3 { limit * length } else { limit };
                }
            }
            state.displace(&change);
        }
        state.clone_from(&kept);
        self.evaluate(state, false);
        if best < CONSISTENT {
            return Ok(ITERATIONS);
        }
        let unmet = unmet(&self.position_rows(&kept, starts, length), |row| row.error);
        Err(AssemblyError::Inconsistent { given, unmet })
    }

    fn assemble_velocities(
        &mut self,
        state: &mut State,
        starts: &[Start],
        length: f64,
    ) -> Result<(), AssemblyError> {
        self.evaluate(state, false);
        let n = self.velocity_count();
        let mut rows = self.assembly_rows(starts, length);
        for row in &mut rows {
            if !row.in_velocity {
                row.rate = 0.0;
                row.blocks.iter_mut().for_each(|block| block.1 = [0.0; 6]);
            }
        }
        let mut wanted = state.velocities().to_vec();
        wanted
            .iter_mut()
            .enumerate()
            .filter(|(k, _)| k % 6 < 3)
            .for_each(|(_, v)| *v /= length);
        let right: Vec<f64> = rows.iter().map(|row| row.rate).collect();
        let mut least = Least::new(n, rows.len());
        let weights = self.velocity_weights();
        let mut velocities = least.solve(&rows, &weights, &wanted, &right, REGULARISATION);
        // A second pass removes what the regularisation left of the first.
        let missing: Vec<f64> = rows
            .iter()
            .map(|row| row.rate - along(row, &velocities))
            .collect();
        let correction = least.solve(&rows, &weights, &vec![0.0; n], &missing, REGULARISATION);
        for (v, c) in velocities.iter_mut().zip(correction) {
            *v += c;
        }
        let size = velocities.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let size = rows.iter().fold(size, |m, row| m.max(row.rate.abs()));
        let unmet = unmet(&rows, |row| row.rate - along(row, &velocities));
        let largest = rows.iter().fold(0.0_f64, |m, row| {
            m.max((row.rate - along(row, &velocities)).abs())
        });
        if !(largest <= CONSISTENT * size.max(1e-12)) {
            return Err(AssemblyError::Velocities { unmet });
        }
        for (k, (u, v)) in state
            .velocities_mut()
            .iter_mut()
            .zip(&velocities)
            .enumerate()
        {
            *u = if k % 6 < 3 { v * length } else { *v };
        }
        self.evaluate(state, false);
        Ok(())
    }

    /// Which equations to keep: those of joints that lock most come first, so that the equation
    /// dropped is that of the element that is most likely meant as the extra one.
    fn independent(&mut self, length: f64) -> (Vec<bool>, Vec<usize>) {
        let count = |owner: Owner| self.constraints.iter().filter(|c| c.owner == owner).count();
        let mut order: Vec<(usize, usize)> = self
            .constraints
            .iter()
            .enumerate()
            .map(|(place, c)| {
                let rank = match c.owner {
                    Owner::Joint(_) => 6 - count(c.owner).min(6),
                    Owner::Motion(_) => 7,
                    Owner::General(_) => 8,
                };
                (rank, place)
            })
            .collect();
        order.sort_unstable();
        let rows = self.assembly_rows(&[], length);
        let n = self.velocity_count();
        let full: Vec<Vec<f64>> = order
            .iter()
            .map(|&(_, place)| expand(&rows[place], n))
            .collect();
        let kept = independent_rows(&full, RANK_TOLERANCE);
        let mut active = vec![false; self.constraints.len()];
        for (&(_, place), kept) in order.iter().zip(kept) {
            active[place] = kept;
        }
        (active, order.into_iter().map(|(_, place)| place).collect())
    }

    /// Frictions of joints whose multipliers take part in a dependency.
    fn not_unique(&mut self, active: &[bool], length: f64) -> Vec<usize> {
        let n = self.velocity_count();
        let all: Vec<bool> = vec![true; active.len()];
        self.set_active(&all);
        let rows = self.assembly_rows(&[], length);
        self.set_active(active);
        let dropped: Vec<usize> = (0..active.len()).filter(|&place| !active[place]).collect();
        if dropped.is_empty() || self.model.frictions.is_empty() {
            return Vec::new();
        }
        let kept: Vec<usize> = (0..active.len()).filter(|&place| active[place]).collect();
        let kept_rows: Vec<&Row> = kept.iter().map(|&place| &rows[place]).collect();
        let mut touched = vec![false; self.model.joints.len()];
        let mut touch = |place: usize| {
            if let Owner::Joint(joint) = self.constraints[place].owner {
                touched[joint] = true;
            }
        };
        let mut least = Least::new(n, kept.len());
        for &place in &dropped {
            touch(place);
            // The dropped row as a combination of kept ones: rest + Gᵀ c = row, G rest = 0.
            let coefficients = least.combination(&kept_rows, &expand(&rows[place], n));
            for (&place, c) in kept.iter().zip(coefficients) {
                if c.abs() > 1e-6 {
                    touch(place);
                }
            }
        }
        let frictions = self.model.frictions.iter().enumerate();
        frictions
            .filter(|(_, friction)| touched[friction.joint])
            .map(|(place, _)| place)
            .collect()
    }

    /// The equations of a joint also hold with opposite axes; that is not what the joint means.
    fn check_directions(&self) -> Result<(), AssemblyError> {
        for joint in &self.model.joints {
            let (i, j) = (self.marker(joint.i), self.marker(joint.j));
            for &axis in codirected_axes(joint.kind) {
                if i.axis(axis).dot(&j.axis(axis)) < 0.0 {
                    return Err(AssemblyError::Opposite {
                        joint: joint.label.clone(),
                        axis,
                    });
                }
            }
        }
        Ok(())
    }

    fn moved(&self, given: &State, state: &State, length: f64) -> Vec<Moved> {
        let mut moved = Vec::new();
        for (place, body) in self.model.bodies.iter().enumerate() {
            let distance = (state.centre(place) - given.centre(place)).norm();
            let before = given.orientation(place).matrix();
            let angle =
                crate::rotation::log(&(state.orientation(place).matrix() * before.transpose()))
                    .norm();
            if distance > 1e-7 * length || angle > 1e-7 {
                moved.push(Moved {
                    body: body.label.clone(),
                    distance,
                    angle,
                });
            }
        }
        moved
    }

    fn velocity_changes(&self, given: &State, state: &State, length: f64) -> Vec<VelocityChange> {
        let mut changes = Vec::new();
        for (place, body) in self.model.bodies.iter().enumerate() {
            let part = |state: &State, from: usize| {
                let first = 6 * place + from;
                Vector3::from_column_slice(&state.velocities()[first..first + 3])
            };
            let linear = (part(state, 0) - part(given, 0)).norm();
            let angular = (part(state, 3) - part(given, 3)).norm();
            let given = body.given_velocity.contains(&true);
            if given && (linear > 1e-7 * length || angular > 1e-7) {
                changes.push(VelocityChange {
                    body: body.label.clone(),
                    linear,
                    angular,
                });
            }
        }
        changes
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

fn expand(row: &Row, n: usize) -> Vec<f64> {
    let mut full = vec![0.0; n];
    for (body, block) in &row.blocks {
        for k in 0..6 {
            full[6 * body + k] += block[k];
        }
    }
    full
}

fn along(row: &Row, velocities: &[f64]) -> f64 {
    let products = row.blocks.iter().flat_map(|(body, block)| {
        block
            .iter()
            .zip(&velocities[6 * body..])
            .map(|(g, v)| g * v)
    });
    products.sum()
}

/// The rows whose dimensionless `error` is beyond rounding, the largest first.
fn unmet(rows: &[Row], error: impl Fn(&Row) -> f64) -> Vec<Unmet> {
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

/// The smallest weighted change that meets linear equations: `[W −Gᵀ; G ε] [x; μ] = [W x₀; b]`.
struct Least {
    n: usize,
    rows: usize,
    matrix: Matrix,
    factors: SparseLu,
}

impl Least {
    fn new(n: usize, rows: usize) -> Self {
        Self {
            n,
            rows,
            matrix: Matrix::new(n + rows),
            factors: SparseLu::new(),
        }
    }

    fn factor<'a>(
        &mut self,
        rows: impl Iterator<Item = &'a Row>,
        weights: &[f64],
        regularisation: f64,
    ) {
        self.matrix.start();
        for (k, weight) in weights.iter().enumerate() {
            self.matrix.add(k, k, *weight);
        }
        for (place, row) in rows.enumerate() {
            let place = self.n + place;
            self.matrix.add(place, place, regularisation);
            for (body, block) in &row.blocks {
                for (k, g) in block.iter().enumerate() {
                    self.matrix.add(place, 6 * body + k, *g);
                    self.matrix.add(6 * body + k, place, -g);
                }
            }
        }
        self.matrix.compress();
        // The diagonal is positive, so the matrix has an inverse whatever the rows are.
        let factored = self.factors.factor(&self.matrix);
        debug_assert!(factored.is_ok(), "a regularised matrix has an inverse");
    }

    fn solve(
        &mut self,
        rows: &[Row],
        weights: &[f64],
        wanted: &[f64],
        right: &[f64],
        regularisation: f64,
    ) -> Vec<f64> {
        self.factor(rows.iter(), weights, regularisation);
        let mut solution: Vec<f64> = wanted.iter().zip(weights).map(|(x, w)| x * w).collect();
        solution.extend_from_slice(right);
        if self.factors.fill() > 0 {
            self.factors.solve(&mut solution);
        }
        solution.truncate(self.n);
        solution
    }

    /// Coefficients with which `rows` combine to `target` as nearly as possible.
    fn combination(&mut self, rows: &[&Row], target: &[f64]) -> Vec<f64> {
        self.factor(rows.iter().copied(), &vec![1.0; self.n], REGULARISATION);
        let mut solution = target.to_vec();
        solution.resize(self.n + self.rows, 0.0);
        self.factors.solve(&mut solution);
        solution.split_off(self.n).into_iter().map(|c| -c).collect()
    }
}
