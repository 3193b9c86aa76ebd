//! Static equilibrium: positions and reactions at which nothing accelerates.
//!
//! ```text
//! Q(x) + f(x, λ) + Gᵀλ = 0,   g(x) = 0        at rest
//! ```
//!
//! together with the system elements, whose states rest, too (or keep their value: `STATIC_HOLD`),
//!
//! by Newton's method on the same matrix as the dynamics, with its mass and velocity parts reduced
//! to a small multiple (STABILITY), which decides where the stiffness does not: bodies that may turn
//! freely stay as they are. Steps are limited, and shortened until the imbalance falls, or else the
//! step that would follow it with the same matrix (Deuflhard, *Newton Methods for Nonlinear Problems*,
//! section 3.3): a slender beam that bends is stretched by the square of its rotation, and its axial
//! stiffness makes more of that than of the load. Where the
//! forces would do negative work along a step, it leads to an unstable equilibrium; the multiple is
//! then raised until the step follows the forces.
//!
//! Friction holds by its creep, whose anchor is where the joint stood: the stiffness of the law. The
//! bristles of LuGre keep their deflection, as any deflection is steady at rest.

use nalgebra::Vector3;
use numerics::linear::{FrontalLu, Matrix};

use crate::instant::Failure;
use crate::model::{Element, Law, Level};
use crate::state::{State, VELOCITIES};
use crate::system::{Rows, System, Weights};

/// How an equilibrium is found: the EQUILIBRIUM statement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquilibriumSettings {
    /// ERROR: largest change of a displacement (length) or rotation (radians) in the last iteration.
    pub error: f64,
    /// IMBALANCE: largest force (or torque) left over.
    pub imbalance: f64,
    /// STABILITY: part of mass and damping that is added to the stiffness.
    pub stability: f64,
    /// MAXIT: most iterations.
    pub iterations: usize,
    /// ALIMIT: largest rotation of a body in an iteration, radians.
    pub angle_limit: f64,
    /// TLIMIT: largest displacement of a body in an iteration, length.
    pub translation_limit: f64,
}

/// An equilibrium that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquilibriumReport {
    /// Iterations that it took.
    pub iterations: usize,
    /// Largest force or torque left over.
    pub imbalance: f64,
}

/// Further iterations while they still improve a solution that is accurate enough.
const POLISHING: usize = 3;
/// Halvings of a step before the multiple of the mass is raised instead.
const HALVINGS: usize = 10;
/// Smallest and largest multiple when it is raised.
const STABILITIES: [f64; 2] = [1e-6, 1e12];
/// A joint whose friction uses this part of its coefficient is at its limit.
const SATURATED: f64 = 0.99;

/// Storage of the iteration.
pub(crate) struct Statics {
    matrix: Matrix,
    factors: FrontalLu,
    right: Vec<f64>,
    change: Vec<f64>,
    next: Vec<f64>,
    along: Vec<f64>,
    zero: Vec<f64>,
    /// What multiplies changes of states and algebraic variables, by their place, in merits and
    /// sizes; one for the others, which have units of their own.
    element_weights: Vec<f64>,
    /// A force that is typical of the model: the imbalances are compared by it.
    force: f64,
}

impl Statics {
    pub(crate) fn new(system: &System) -> Self {
        let n = system.rate_count();
        let size = system.unknown_count();
        Self {
            matrix: Matrix::new(size),
            factors: FrontalLu::new(system.elimination_groups()),
            right: vec![0.0; size],
            change: vec![0.0; size],
            next: vec![0.0; size],
            along: vec![0.0; size],
            zero: vec![0.0; n],
            element_weights: vec![1.0; size],
            force: 1.0,
        }
    }

    /// Moves `state` (at rest) to an equilibrium, from reactions that are those of the start when
    /// the model is let go there; `length` is typical of the model.
    pub(crate) fn solve(
        &mut self,
        system: &mut System,
        state: &mut State,
        multipliers: &mut [f64],
        settings: &EquilibriumSettings,
        length: f64,
    ) -> Result<EquilibriumReport, Failure> {
        let mut stability = settings.stability;
        let mut polished = 0;
        let mut moved = f64::INFINITY;
        self.weigh(system, state, multipliers);
        self.force = system.typical_force(multipliers);
        for iteration in 0..settings.iterations {
            let merit = self.residual(system, state, multipliers, length)?;
            let imbalance = self.imbalance(system);
            let balanced = imbalance <= settings.imbalance && moved <= settings.error;
            let report = EquilibriumReport {
                iterations: iteration,
                imbalance,
            };
            if balanced && polished == POLISHING {
                return Ok(report);
            }
            let step = self.step(
                system,
                state,
                multipliers,
                settings,
                &mut stability,
                merit,
                length,
            );
            match step {
                Ok(size) => moved = size,
                // No step makes it better: rounding, where it is good enough already.
                Err(_) if imbalance <= settings.imbalance => return Ok(report),
                Err(failure) => return Err(failure),
            }
            polished += usize::from(balanced);
        }
        Err(Failure::NoEquilibrium {
            unknown: self.largest(system),
        })
    }

    /// One step: Newton's, limited and shortened, or with more of the mass. Returns its size.
    fn step(
        &mut self,
        system: &mut System,
        state: &mut State,
        multipliers: &mut [f64],
        settings: &EquilibriumSettings,
        stability: &mut f64,
        merit: f64,
        length: f64,
    ) -> Result<f64, Failure> {
        let moving = system.velocity_count();
        let n = system.rate_count();
        let residual = self.right.clone();
        let (start, start_multipliers) = (state.clone(), multipliers.to_vec());
        system.evaluate(state, true);
        loop {
            let weights = Weights::equilibrium(*stability);
            system.assemble(
                Rows::Position,
                weights,
                &self.zero,
                &start_multipliers,
                &mut self.matrix,
            );
            let solved = self.factors.factor(&self.matrix);
            self.change.copy_from_slice(&residual);
            if solved.is_ok() {
                self.factors.solve(&mut self.change);
            }
            let fine = solved.is_ok() && self.change.iter().all(|c| c.is_finite());
            let uphill = fine && self.curvature(system) < 0.0;
            if fine && !uphill {
                let limit = self.limit(settings, moving);
                let mut part = limit;
                for _ in 0..HALVINGS {
                    let step: Vec<f64> = self.change[..n].iter().map(|c| part * c).collect();
                    state.clone_from(&start);
                    state.displace(&step[..moving]);
                    for (y, change) in state.states_mut().iter_mut().zip(&step[moving..]) {
                        *y += change;
                    }
                    for (row, multiplier) in multipliers.iter_mut().enumerate() {
                        *multiplier = start_multipliers[row] + part * self.change[n + row];
                    }
                    let trial = self.residual(system, state, multipliers, length)?;
                    let closer = self.comes_closer(system, part, length);
                    if trial < (1.0 - 1e-4 * part) * merit || closer {
                        *stability = (0.1 * *stability).max(settings.stability);
                        return Ok(self.moved(&step));
                    }
                    part *= 0.5;
                }
            }
            *stability = (10.0 * *stability).max(STABILITIES[0]);
            if *stability > STABILITIES[1] {
                state.clone_from(&start);
                multipliers.copy_from_slice(&start_multipliers);
                self.residual(system, state, multipliers, length)?;
                return Err(Failure::NoEquilibrium {
                    unknown: self.largest(system),
                });
            }
            state.clone_from(&start);
            multipliers.copy_from_slice(&start_multipliers);
            system.evaluate(state, true);
        }
    }

    /// Whether the step that would follow `part` of the last one, with the same matrix, is shorter
    /// than that one: the natural monotonicity test. It does not depend on the scale of the forces.
    fn comes_closer(&mut self, system: &System, part: f64, length: f64) -> bool {
        self.next.copy_from_slice(&self.right);
        self.factors.solve(&mut self.next);
        let n = system.velocity_count();
        let size = |change: &[f64]| {
            let bodies = change[..n].chunks_exact(VELOCITIES);
            let elements = system.element_places();
            let elements = elements.map(|k| (self.element_weights[k] * change[k]).powi(2));
            let moved = bodies
                .map(|body| {
                    let moved = Vector3::from_column_slice(&body[..3]).norm() / length;
                    let turned = Vector3::from_column_slice(&body[3..]).norm();
                    moved * moved + turned * turned
                })
                .sum::<f64>();
            (moved + elements.sum::<f64>()).sqrt()
        };
        size(&self.next) < (1.0 - 0.25 * part) * size(&self.change)
    }

    /// `δᵀKδ` of the step: what the forces do along it once the constraints are met. Below zero it
    /// leads to an unstable equilibrium. System elements may make forces, too (a controller), or be
    /// at odds with them on the way (an integral of an error): the larger of the values with the
    /// elements that follow the step and that stay counts.
    fn curvature(&mut self, system: &System) -> f64 {
        let staying = self.curvature_along(system, false);
        if staying >= 0.0 || !system.has_elements() {
            return staying;
        }
        self.curvature_along(system, true)
    }

    fn curvature_along(&mut self, system: &System, elements_follow: bool) -> f64 {
        let n = system.velocity_count();
        self.along.fill(0.0);
        self.along[..n].copy_from_slice(&self.change[..n]);
        if elements_follow {
            for k in system.element_places() {
                self.along[k] = self.change[k];
            }
        }
        self.matrix.multiply(&self.along, &mut self.next);
        (0..n).map(|k| self.along[k] * self.next[k]).sum()
    }

    /// Part of the step that the limits leave.
    fn limit(&self, settings: &EquilibriumSettings, n: usize) -> f64 {
        let mut part = 1.0_f64;
        for body in self.change[..n].chunks_exact(VELOCITIES) {
            let moved = Vector3::from_column_slice(&body[..3]).norm();
            let turned = Vector3::from_column_slice(&body[3..]).norm();
            part = part
                .min(settings.translation_limit / moved.max(1e-300))
                .min(settings.angle_limit / turned.max(1e-300));
        }
        part
    }

    /// Unbalanced forces and unmet constraints at `state`; returns their size, which falls along
    /// Newton's step.
    fn residual(
        &mut self,
        system: &mut System,
        state: &State,
        multipliers: &[f64],
        length: f64,
    ) -> Result<f64, Failure> {
        let moving = system.velocity_count();
        let n = system.rate_count();
        system.evaluate(state, false);
        system.set_solution(&self.zero, 1.0, multipliers);
        system.forces(multipliers, &mut self.right[..n]);
        for (row, &place) in system.rows.iter().enumerate() {
            let error = system.evaluated[place].error;
            self.right[n + row] = if system.levels[row] == Level::Position {
                -error
            } else {
                0.0
            };
        }
        let first = n + system.row_count();
        system.algebraic_residual(multipliers, &mut self.right[first..]);
        if self.right.iter().any(|r| !r.is_finite()) {
            return Err(Failure::NotANumber {
                element: system.find_not_a_number(),
            });
        }
        let weight = self.force;
        let forces = self.right[..moving].chunks_exact(VELOCITIES).map(|body| {
            let force = Vector3::from_column_slice(&body[..3]).norm() / weight;
            let torque = Vector3::from_column_slice(&body[3..]).norm() / (weight * length);
            force * force + torque * torque
        });
        let errors = self.right[n..first].iter();
        let errors = errors.map(|e| (e / length) * (e / length));
        let elements = system.element_places();
        let elements = elements.map(|k| (self.element_weights[k] * self.right[k]).powi(2));
        Ok((forces.sum::<f64>() + errors.sum::<f64>() + elements.sum::<f64>()).sqrt())
    }

    /// Largest force or torque left over; of system elements what is left relative to their values.
    fn imbalance(&self, system: &System) -> f64 {
        let places = (0..system.velocity_count()).chain(system.element_places());
        places.fold(0.0_f64, |largest, k| largest.max(self.left(k)))
    }

    fn left(&self, place: usize) -> f64 {
        (self.element_weights[place] * self.right[place]).abs()
    }

    /// The equation that lacks most.
    fn largest(&self, system: &System) -> usize {
        let places = (0..system.velocity_count()).chain(system.element_places());
        places
            .max_by(|&a, &b| self.left(a).total_cmp(&self.left(b)))
            .unwrap_or(0)
    }

    /// Size of a step of positions and states.
    fn moved(&self, step: &[f64]) -> f64 {
        let weighted = step.iter().zip(&self.element_weights);
        weighted.fold(0.0_f64, |m, (change, weight)| {
            m.max((change * weight).abs())
        })
    }

    /// Weights of the system elements: their values count relative to those at the start, and at
    /// least relative to one.
    fn weigh(&mut self, system: &System, state: &State, multipliers: &[f64]) {
        let values = state
            .states()
            .iter()
            .chain(&multipliers[system.row_count()..]);
        for (place, value) in system.element_places().zip(values) {
            self.element_weights[place] = 1.0 / value.abs().max(1.0);
        }
    }
}

fn largest_of(values: &[f64]) -> f64 {
    values.iter().fold(0.0_f64, |m, v| m.max(v.abs()))
}

impl System {
    /// The larger of weights, forces and reactions at the instant evaluated last.
    pub(crate) fn typical_force(&mut self, multipliers: &[f64]) -> f64 {
        let weights = self.model.bodies.iter().map(|body| body.mass);
        let weight = weights.sum::<f64>() * self.model.gravity.norm();
        let applied: Vec<f64> = (0..self.model.forces.len())
            .map(|place| self.force_value(place))
            .collect();
        let largest = largest_of(&multipliers[..self.first_shared()])
            .max(largest_of(&applied))
            .max(weight);
        if largest > 0.0 { largest } else { 1.0 }
    }

    /// What may keep the model from an equilibrium, for the message of a failure.
    pub(crate) fn explain_no_equilibrium(&self, multipliers: &[f64]) -> String {
        let mut causes = Vec::new();
        for (place, friction) in self.model.frictions.iter().enumerate() {
            if !self.model.is_active(Element::Friction(place)) {
                continue;
            }
            let label = &friction.label;
            if friction.inactive_static {
                causes.push(format!(
                    "{label} is INACTIVE in static solutions and holds nothing"
                ));
                continue;
            }
            match &friction.law {
                Law::Original(law) => {
                    let values = self.friction_values(place, multipliers);
                    if law.effect == friction::Effect::Sliding {
                        causes.push(format!(
                            "{label} has EFFECT = SLIDING, which holds nothing at rest"
                        ));
                    } else if values.clipped {
                        causes.push(format!("{label} is at its MAX_FRICTION limit"));
                    } else if values.mu.norm() >= SATURATED * law.mu_static
                        && values.load.value == 0.0
                    {
                        causes.push(format!("{label} is saturated: its preload holds no more"));
                    } else if values.mu.norm() >= SATURATED * law.mu_static {
                        causes.push(format!(
                            "{label} is saturated: its load calls for more than MU_STATIC = {}",
                            law.mu_static
                        ));
                    }
                }
                Law::LuGre(_) => causes.push(format!(
                    "{label} is LUGRE, whose bristles keep their deflection in static solutions \
                     and take up no further load"
                )),
            }
        }
        if causes.is_empty() {
            causes.push(
                "likely causes: a part that is free to move under a constant force, or forces that \
                 drive the model"
                    .to_owned(),
            );
        }
        causes.join("; ")
    }
}
