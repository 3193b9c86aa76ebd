//! The equations of motion, numbered: residual parts and their exact derivatives.
//!
//! Velocities `u` are six numbers a body (centre of mass and rotation, ground axes), multipliers
//! `λ` one a constraint equation in force:
//!
//! ```text
//! M u̇ = Q(t, x, u) + f(t, x, u, λ) + Gᵀλ      Newton and Euler; f is joint friction
//! G u = rate,   G u̇ = acceleration             constraints, differentiated
//! ```
//!
//! [`System::evaluate`] brings everything that depends on time and state alone up to date, and
//! [`System::assemble`] builds the Newton matrix over `(δu, δλ̂)` that all solvers share,
//!
//! ```text
//! [ M − γ ∂(Q+f)/∂u − γ² ∂(Q+f+Gᵀλ)/∂x    −Gᵀ − ∂f/∂λ ]
//! [ G  (+ γ ∂(G u)/∂x)                           0       ]      λ̂ = γλ, δx = γ δu
//! ```
//!
//! At `γ = 0` it is the matrix of the instantaneous accelerations and reactions.

use nalgebra::{Matrix3, SMatrix, Vector3};
use numerics::linear::Matrix;

use crate::constraint::{Constraint, Evaluated, Form, Owner, list};
use crate::equation::{Equation, Local, LocalMatrix};
use crate::expression::{Input, Program};
use crate::joint_friction::{self, Contribution, Element, Memory, Share};
use crate::measure::{self, Order, Quantity};
use crate::model::{ForceKind, Level, Model, SingleForce};
use crate::rotation::skew;
use crate::scalar::Jet;
use crate::snapshot::Wrench;
use crate::state::{BodyFrame, MarkerFrame, State};

/// Which equations the constraint rows of the Newton matrix belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rows {
    /// `G δu`: positions, or accelerations at `γ = 0`.
    Position,
    /// `(G + γ ∂(G u)/∂x) δu`: velocities.
    Velocity,
}

/// History that the equations need beside the state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    /// Friction by element.
    pub frictions: Vec<Memory>,
    /// Last value of every measured rotation, which makes it continuous over many turns.
    pub angles: Vec<f64>,
}

/// A model's equations and the storage to evaluate them.
#[derive(Clone, Debug)]
pub struct System {
    pub(crate) model: Model,
    pub(crate) constraints: Vec<Constraint>,
    /// Constraint of each row in force.
    pub(crate) rows: Vec<usize>,
    /// Contributions to the reaction of each friction's joint.
    reactions: Vec<Vec<Contribution>>,
    /// What happened so far, as of the last accepted step.
    pub(crate) history: History,
    pub(crate) bodies: Vec<BodyFrame>,
    pub(crate) evaluated: Vec<Evaluated>,
    measures: Vec<f64>,
    /// Measures that the equations (not only outputs) read.
    needed: Vec<bool>,
    measure_bodies: Vec<Vec<usize>>,
    measure_slopes: Vec<Vec<[f64; 12]>>,
    time: f64,
    registers: Vec<f64>,
    adjoints: Vec<f64>,
    jets: Vec<Jet>,
}

impl System {
    /// Numbers the equations of a model; all constraint equations are in force at first.
    #[must_use]
    pub fn new(model: Model) -> Self {
        let constraints = list(&model);
        let evaluated = constraints
            .iter()
            .map(|c| Evaluated::new(c.bodies.len()))
            .collect();
        let reactions = model
            .frictions
            .iter()
            .map(|friction| reaction_of(&constraints, friction.joint))
            .collect();
        let mut needed = vec![false; model.measures.len()];
        let functions = model.forces.iter().map(|f| &f.function);
        let functions = functions.chain(model.constraints.iter().map(|c| &c.function));
        let mut longest = 0;
        for function in functions.chain(model.motions.iter().map(|m| &m.function)) {
            longest = longest.max(function.len());
            for input in function.inputs() {
                if let Input::Measure(measure) = input {
                    needed[measure] = true;
                }
            }
        }
        let measure_bodies: Vec<Vec<usize>> = model
            .measures
            .iter()
            .map(|measure| {
                let markers = measure.markers();
                let mut bodies: Vec<usize> = markers
                    .iter()
                    .filter_map(|&m| model.markers[m].body)
                    .collect();
                bodies.sort_unstable();
                bodies.dedup();
                bodies
            })
            .collect();
        let history = History {
            frictions: Vec::new(),
            angles: vec![0.0; model.measures.len()],
        };
        let mut system = Self {
            bodies: vec![BodyFrame::at_rest(); model.bodies.len()],
            measures: vec![0.0; model.measures.len()],
            measure_slopes: measure_bodies
                .iter()
                .map(|b| vec![[0.0; 12]; b.len()])
                .collect(),
            measure_bodies,
            needed,
            rows: Vec::new(),
            reactions,
            history,
            constraints,
            evaluated,
            time: 0.0,
            registers: vec![0.0; longest],
            adjoints: vec![0.0; longest],
            jets: vec![
                Jet {
                    value: 0.0,
                    rate: 0.0,
                    acceleration: 0.0
                };
                longest
            ],
            model,
        };
        let all = vec![true; system.constraints.len()];
        system.set_active(&all);
        system
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Number of velocities.
    #[must_use]
    pub fn velocity_count(&self) -> usize {
        6 * self.model.bodies.len()
    }

    /// Number of constraint equations in force.
    #[must_use]
    pub fn row_count(&self) -> usize {
        self.rows.len()
    }

    /// Degrees of freedom: those of the free bodies less the constraint equations in force.
    #[must_use]
    pub fn degrees_of_freedom(&self) -> usize {
        let free: usize = self
            .model
            .bodies
            .iter()
            .map(|b| if b.rotates { 6 } else { 3 })
            .sum();
        free.saturating_sub(self.rows.len())
    }

    /// Chooses the constraint equations in force.
    pub(crate) fn set_active(&mut self, active: &[bool]) {
        self.rows.clear();
        for (place, (constraint, &active)) in self.constraints.iter_mut().zip(active).enumerate() {
            constraint.row = active.then_some(self.rows.len());
            if active {
                self.rows.push(place);
            }
        }
    }

    /// Frame of a marker on the bodies as they were evaluated last.
    #[must_use]
    pub fn marker(&self, marker: usize) -> MarkerFrame {
        MarkerFrame::new(&self.model.markers[marker], &self.bodies)
    }

    /// Frames of the bodies as they were evaluated last.
    #[must_use]
    pub fn body(&self, body: usize) -> &BodyFrame {
        &self.bodies[body]
    }

    fn measure_frames(&self, measure: usize) -> [MarkerFrame; 4] {
        self.model.measures[measure]
            .markers()
            .map(|m| self.marker(m))
    }

    /// Value of a measure of displacement or velocity; rotations are continuous over many turns.
    pub(crate) fn measure_value(&self, place: usize) -> f64 {
        let [i, j, k, l] = self.measure_frames(place);
        let quantity = self.model.measures[place].quantity;
        let value = measure::value(quantity, [&i, &j, &k, &l]);
        match quantity {
            Quantity::Rotation(_) => nearest_turn(value, self.history.angles[place]),
            _ => value,
        }
    }

    /// Brings positions, constraints and measures up to date with `state`; with `derivatives` also
    /// what [`System::assemble`] needs.
    pub(crate) fn evaluate(&mut self, state: &State, derivatives: bool) {
        self.time = state.time;
        for (place, body) in self.bodies.iter_mut().enumerate() {
            body.update(state, place, &self.model.bodies[place]);
        }
        for place in 0..self.model.measures.len() {
            let order = self.model.measures[place].quantity.order();
            if self.needed[place] && order != Order::Acceleration {
                self.measures[place] = self.measure_value(place);
            }
        }
        if derivatives || self.constraints.iter().any(|c| c.form == Form::Function) {
            self.evaluate_slopes();
        }
        for place in 0..self.constraints.len() {
            match self.constraints[place].form {
                Form::Pair { equation, i, j } => {
                    self.evaluate_pair(place, equation, i, j, derivatives);
                }
                Form::Function => self.evaluate_function(place),
            }
        }
    }

    fn evaluate_slopes(&mut self) {
        for place in 0..self.model.measures.len() {
            let quantity = self.model.measures[place].quantity;
            if !self.needed[place] || quantity.order() == Order::Acceleration {
                continue;
            }
            let [i, j, k, l] = self.measure_frames(place);
            for (&body, slopes) in self.measure_bodies[place]
                .iter()
                .zip(&mut self.measure_slopes[place])
            {
                *slopes = measure::slopes(quantity, [&i, &j, &k, &l], body);
                if !self.model.bodies[body].rotates {
                    slopes[3..6].fill(0.0);
                    slopes[9..12].fill(0.0);
                }
            }
        }
    }

    fn evaluate_pair(
        &mut self,
        place: usize,
        equation: Equation,
        i: usize,
        j: usize,
        derivatives: bool,
    ) {
        let (i, j) = (self.marker(i), self.marker(j));
        let row = equation.evaluate(&i, &j);
        let constraint = &self.constraints[place];
        let (mut value, mut rate, mut acceleration) = (row.value, 0.0, 0.0);
        if let Owner::Motion(motion) = constraint.owner {
            let drive = self.model.motions[motion]
                .function
                .run(&mut self.jets, |input| {
                    debug_assert_eq!(input, Input::Time, "motions depend on time only");
                    Jet {
                        value: self.time,
                        rate: 1.0,
                        acceleration: 0.0,
                    }
                });
            match constraint.level {
                Level::Position => {
                    value -= drive.value;
                    if equation == Equation::AboutZ {
                        value = nearest_turn(value, 0.0);
                    }
                    rate = drive.rate;
                    acceleration = drive.acceleration;
                }
                Level::Velocity => {
                    value = 0.0;
                    rate = drive.value;
                    acceleration = drive.rate;
                }
                Level::Acceleration => {
                    value = 0.0;
                    acceleration = drive.value;
                }
            }
        }
        let evaluated = &mut self.evaluated[place];
        evaluated.error = value;
        evaluated.rate = rate;
        evaluated.acceleration = acceleration - row.bias;
        evaluated.local = row.jacobian;
        self.release_point_masses(place);
        let evaluated = &mut self.evaluated[place];
        let sides = [i.body, j.body];
        spread(&sides, &evaluated.local, &mut evaluated.jacobian);
        if derivatives {
            evaluated.stiffness = equation.stiffness(&i, &j);
            let u = crate::equation::local_velocities(&i, &j);
            let change = evaluated.stiffness.tr_mul(&u);
            spread(&sides, &change, &mut evaluated.rate_change);
        }
    }

    /// A point mass does not turn: its rotations take no part.
    fn release_point_masses(&mut self, place: usize) {
        if let Form::Pair { i, j, .. } = self.constraints[place].form {
            for (marker, rotation) in [(i, 3), (j, 9)] {
                let body = self.model.markers[marker].body;
                if body.is_some_and(|body| !self.model.bodies[body].rotates) {
                    self.evaluated[place]
                        .local
                        .fixed_rows_mut::<3>(rotation)
                        .fill(0.0);
                }
            }
        }
    }

    /// A general constraint: value and gradient by measures, rates along the motion by jets.
    fn evaluate_function(&mut self, place: usize) {
        let Owner::General(general) = self.constraints[place].owner else {
            return;
        };
        let function = &self.model.constraints[general].function;
        let time = self.time;
        let measures = &self.measures;
        let value = function.evaluate(&mut self.registers, |input| read(input, time, measures));
        let evaluated = &mut self.evaluated[place];
        evaluated.error = value;
        for block in &mut evaluated.jacobian {
            block.fill(0.0);
        }
        let bodies = &self.constraints[place].bodies;
        function.gradient(&self.registers, &mut self.adjoints, |input, slope| {
            if let Input::Measure(measure) = input {
                let motions = self.measure_bodies[measure]
                    .iter()
                    .zip(&self.measure_slopes[measure]);
                for (body, slopes) in motions {
                    if let Ok(block) = bodies.binary_search(body) {
                        for k in 0..6 {
                            evaluated.jacobian[block][k] += slope * slopes[k];
                        }
                    }
                }
            }
        });
        let model = &self.model;
        let frames = &self.bodies;
        let jet = function.run(&mut self.jets, |input| match input {
            Input::Measure(measure) => {
                let [i, j, k, l] = model.measures[measure]
                    .markers()
                    .map(|m| MarkerFrame::new(&model.markers[m], frames));
                let mut jet = measure::jet(model.measures[measure].quantity, [&i, &j, &k, &l]);
                jet.value = measures[measure];
                jet
            }
            Input::Time => Jet {
                value: time,
                rate: 1.0,
                acceleration: 0.0,
            },
            Input::Result(_) => Jet {
                value: f64::NAN,
                rate: 0.0,
                acceleration: 0.0,
            },
        });
        // G u + ∂g/∂t is the rate of the jet; what remains beside G u is prescribed.
        let along: f64 = bodies
            .iter()
            .zip(&evaluated.jacobian)
            .map(|(&body, row)| {
                let frame = &frames[body];
                (0..3)
                    .map(|k| row[k] * frame.velocity[k] + row[3 + k] * frame.omega[k])
                    .sum::<f64>()
            })
            .sum();
        evaluated.rate = along - jet.rate;
        evaluated.acceleration = -jet.acceleration;
    }

    /// `M w` in ground axes: mass and inertia times six numbers a body.
    pub(crate) fn mass_times(&self, w: &[f64], out: &mut [f64]) {
        for (place, (body, frame)) in self.model.bodies.iter().zip(&self.bodies).enumerate() {
            let w = &w[6 * place..6 * place + 6];
            let out = &mut out[6 * place..6 * place + 6];
            for k in 0..3 {
                out[k] = body.mass * w[k];
            }
            let turn = frame.inertia * Vector3::new(w[3], w[4], w[5]);
            out[3..].copy_from_slice(turn.as_slice());
        }
    }

    /// Sum of all forces `Q + f + Gᵀλ` at the state evaluated last.
    pub(crate) fn forces(&mut self, multipliers: &[f64], out: &mut [f64]) {
        for (place, (body, frame)) in self.model.bodies.iter().zip(&self.bodies).enumerate() {
            let weight = body.mass * self.model.gravity;
            let gyroscopic = -frame.omega.cross(&(frame.inertia * frame.omega));
            out[6 * place..6 * place + 3].copy_from_slice(weight.as_slice());
            out[6 * place + 3..6 * place + 6].copy_from_slice(gyroscopic.as_slice());
        }
        for (row, &place) in self.rows.iter().enumerate() {
            let evaluated = &self.evaluated[place];
            for (&body, block) in self.constraints[place]
                .bodies
                .iter()
                .zip(&evaluated.jacobian)
            {
                for k in 0..6 {
                    out[6 * body + k] += multipliers[row] * block[k];
                }
            }
        }
        for place in 0..self.model.forces.len() {
            let (i, j) = self.force_markers(place);
            let value = self.force_value(place);
            let direction = direction(self.model.forces[place].kind, &i, &j);
            self.add_local(&[i.body, j.body], &(value * direction), out);
        }
        for place in 0..self.model.frictions.len() {
            let (element, i, j) = self.friction(place, multipliers);
            self.add_local(&[i.body, j.body], &element.force, out);
        }
    }

    fn add_local(&self, sides: &[Option<usize>; 2], local: &Local, out: &mut [f64]) {
        for (side, body) in sides.iter().enumerate() {
            if let Some(body) = *body {
                let count = if self.model.bodies[body].rotates {
                    6
                } else {
                    3
                };
                for k in 0..count {
                    out[6 * body + k] += local[6 * side + k];
                }
            }
        }
    }

    fn force_markers(&self, place: usize) -> (MarkerFrame, MarkerFrame) {
        let force = &self.model.forces[place];
        (self.marker(force.i), self.marker(force.j))
    }

    /// Value of a single-component force at the state evaluated last.
    pub(crate) fn force_value(&mut self, place: usize) -> f64 {
        let (time, measures) = (self.time, &self.measures);
        let function: &Program = &self.model.forces[place].function;
        function.evaluate(&mut self.registers, |input| read(input, time, measures))
    }

    /// Generalised force of a single-component force of one unit, for outputs.
    pub(crate) fn force_direction(&self, force: &SingleForce) -> Local {
        direction(force.kind, &self.marker(force.i), &self.marker(force.j))
    }

    /// Reaction of a joint or motion on the part of its marker I, at the origin of I, ground axes.
    pub(crate) fn reaction_on_i(&self, owner: Owner, multipliers: &[f64]) -> Wrench {
        let mut wrench = Wrench::default();
        let constraints = self.constraints.iter().zip(&self.evaluated);
        for (constraint, evaluated) in constraints.filter(|(c, _)| c.owner == owner) {
            let (Form::Pair { i, .. }, Some(row)) = (constraint.form, constraint.row) else {
                continue;
            };
            let local = multipliers[row] * evaluated.local;
            let force = Vector3::new(local[0], local[1], local[2]);
            let torque = Vector3::new(local[3], local[4], local[5]);
            wrench.force += force;
            wrench.torque += torque - self.marker(i).arm.cross(&force);
        }
        wrench
    }

    /// Replaces parameters and functions; the numbering of equations and the history stay. Returns
    /// whether the pattern of the Newton matrix stays, too.
    pub(crate) fn replace_model(&mut self, model: Model) -> bool {
        let fresh = Self::new(model);
        let inputs = |model: &Model| -> Vec<Input> {
            model
                .forces
                .iter()
                .flat_map(|force| force.function.inputs())
                .collect()
        };
        let same_pattern = inputs(&fresh.model) == inputs(&self.model);
        let same = fresh.constraints.len() == self.constraints.len()
            && fresh.bodies.len() == self.bodies.len()
            && fresh.model.measures.len() == self.model.measures.len()
            && fresh.model.frictions.len() == self.model.frictions.len();
        assert!(
            same,
            "a changed model must keep the numbering of its equations"
        );
        let active: Vec<bool> = self.constraints.iter().map(|c| c.row.is_some()).collect();
        let history = std::mem::take(&mut self.history);
        *self = fresh;
        self.set_active(&active);
        self.history = history;
        same_pattern
    }

    /// Reaction of a friction's joint on I at marker I, along the axes of J.
    fn reaction(
        &self,
        place: usize,
        j: &MarkerFrame,
        multipliers: &[f64],
    ) -> (Vector3<f64>, Vector3<f64>) {
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for contribution in &self.reactions[place] {
            let Some(row) = self.constraints[contribution.constraint].row else {
                continue;
            };
            match contribution.share {
                Share::Force(axis) => force[axis] += multipliers[row],
                Share::Moment => {
                    moment += multipliers[row] * self.moment_axis(contribution.constraint, j);
                }
            }
        }
        (force, moment)
    }

    /// Direction along the axes of J of the moment that an equation between axes applies to I.
    fn moment_axis(&self, constraint: usize, j: &MarkerFrame) -> Vector3<f64> {
        j.axes.transpose() * self.evaluated[constraint].local.fixed_rows::<3>(3)
    }

    /// Change of the reaction moment along the axes of J with the local motions.
    fn moment_change(
        &self,
        place: usize,
        i: &MarkerFrame,
        j: &MarkerFrame,
        multipliers: &[f64],
    ) -> SMatrix<f64, 3, 12> {
        let mut by_turn = Matrix3::zeros();
        for contribution in &self.reactions[place] {
            let constraint = &self.constraints[contribution.constraint];
            let Form::Pair {
                equation: Equation::Axes(k, l),
                ..
            } = constraint.form
            else {
                continue;
            };
            if let Some(row) = constraint.row {
                // δ(A_Jᵀ (a × b)) = A_Jᵀ b× a× (δθ_I − δθ_J), as b is fixed to J.
                by_turn += multipliers[row] * skew(&j.axis(l)) * skew(&i.axis(k));
            }
        }
        let by_turn = j.axes.transpose() * by_turn;
        let mut change = SMatrix::<f64, 3, 12>::zeros();
        change.fixed_columns_mut::<3>(3).copy_from(&by_turn);
        change.fixed_columns_mut::<3>(9).copy_from(&-by_turn);
        change
    }

    /// Friction element `place` with derivatives, and the frames of its joint's markers.
    pub(crate) fn friction(
        &self,
        place: usize,
        multipliers: &[f64],
    ) -> (Element, MarkerFrame, MarkerFrame) {
        let friction = &self.model.frictions[place];
        let joint = &self.model.joints[friction.joint];
        let (i, j) = (self.marker(joint.i), self.marker(joint.j));
        let (force, moment) = self.reaction(place, &j, multipliers);
        let memory = &self.history.frictions[place];
        let element =
            joint_friction::evaluate(friction, memory, &i, &j, force.into(), moment.into());
        (element, i, j)
    }

    /// Builds the Newton matrix of the module's description at the state evaluated last with
    /// derivatives; `w` is what multiplies the mass matrix in the residual (`u̇` times `γ`).
    pub(crate) fn assemble(
        &mut self,
        rows: Rows,
        gamma: f64,
        w: &[f64],
        multipliers: &[f64],
        matrix: &mut Matrix,
    ) {
        matrix.start();
        self.assemble_bodies(gamma, w, matrix);
        let n = self.velocity_count();
        for (row, &place) in self.rows.iter().enumerate() {
            let evaluated = &self.evaluated[place];
            let constraint = &self.constraints[place];
            let moves = rows == Rows::Velocity && constraint.level == Level::Position
                || constraint.level == Level::Velocity;
            for (block, &body) in constraint.bodies.iter().enumerate() {
                for k in 0..6 {
                    let g = evaluated.jacobian[block][k];
                    let change = evaluated.rate_change[block][k];
                    let rate = if moves { gamma * change } else { 0.0 };
                    matrix.add(n + row, 6 * body + k, g + rate);
                    matrix.add(6 * body + k, n + row, -g);
                }
            }
            if let Form::Pair { i, j, .. } = constraint.form {
                let sides = [i, j].map(|m| self.model.markers[m].body);
                let scale = -gamma * gamma * multipliers[row];
                self.add_local_matrix(&sides, &evaluated.stiffness, scale, matrix);
            }
        }
        self.assemble_forces(gamma, matrix);
        self.assemble_frictions(gamma, multipliers, matrix);
        matrix.compress();
    }

    fn assemble_bodies(&self, gamma: f64, w: &[f64], matrix: &mut Matrix) {
        for (place, (body, frame)) in self.model.bodies.iter().zip(&self.bodies).enumerate() {
            let first = 6 * place;
            for k in 0..3 {
                matrix.add(first + k, first + k, body.mass);
            }
            let inertia = frame.inertia;
            // δ(I w) = δθ × I w − I (δθ × w), the turning of the inertia with the body.
            let turning = |w: &Vector3<f64>| -skew(&(inertia * w)) + inertia * skew(w);
            let omega = frame.omega;
            let w = Vector3::from_column_slice(&w[first + 3..first + 6]);
            // Q = −ω × I ω
            let by_omega: Matrix3<f64> = skew(&(inertia * omega)) - skew(&omega) * inertia;
            let by_theta = -skew(&omega) * turning(&omega);
            let block = inertia + gamma * (turning(&w) - by_omega) - gamma * gamma * by_theta;
            for r in 0..3 {
                for c in 0..3 {
                    matrix.add(first + 3 + r, first + 3 + c, block[(r, c)]);
                }
            }
        }
    }

    fn assemble_forces(&mut self, gamma: f64, matrix: &mut Matrix) {
        for place in 0..self.model.forces.len() {
            let (i, j) = self.force_markers(place);
            let value = self.force_value(place);
            let force = &self.model.forces[place];
            let direction = direction(force.kind, &i, &j);
            let turning = direction_stiffness(force.kind, &i, &j);
            let sides = [i.body, j.body];
            self.add_local_matrix(&sides, &turning, -gamma * gamma * value, matrix);
            force
                .function
                .gradient(&self.registers, &mut self.adjoints, |input, slope| {
                    let Input::Measure(measure) = input else {
                        return;
                    };
                    let motions = self.measure_bodies[measure]
                        .iter()
                        .zip(&self.measure_slopes[measure]);
                    for (&body, slopes) in motions {
                        for k in 0..6 {
                            let change =
                                slope * (gamma * gamma * slopes[k] + gamma * slopes[6 + k]);
                            for (side, on) in sides.iter().enumerate() {
                                let Some(on) = *on else { continue };
                                for r in 0..6 {
                                    let entry = -direction[6 * side + r] * change;
                                    matrix.add(6 * on + r, 6 * body + k, entry);
                                }
                            }
                        }
                    }
                });
        }
    }

    fn assemble_frictions(&self, gamma: f64, multipliers: &[f64], matrix: &mut Matrix) {
        let n = self.velocity_count();
        for place in 0..self.model.frictions.len() {
            let (element, i, j) = self.friction(place, multipliers);
            let sides = [i.body, j.body];
            let turning = element.by_reaction.fixed_columns::<3>(3)
                * self.moment_change(place, &i, &j, multipliers);
            let moving =
                gamma * element.by_velocity + gamma * gamma * (element.by_position + turning);
            self.add_local_matrix(&sides, &moving, -1.0, matrix);
            for contribution in &self.reactions[place] {
                let Some(row) = self.constraints[contribution.constraint].row else {
                    continue;
                };
                let by_multiplier: Local = match contribution.share {
                    Share::Force(axis) => element.by_reaction.column(axis).into_owned(),
                    Share::Moment => {
                        let axis = self.moment_axis(contribution.constraint, &j);
                        element.by_reaction.fixed_columns::<3>(3) * axis
                    }
                };
                for (side, body) in sides.iter().enumerate() {
                    let Some(body) = *body else { continue };
                    for r in 0..6 {
                        matrix.add(6 * body + r, n + row, -by_multiplier[6 * side + r]);
                    }
                }
            }
        }
    }

    fn add_local_matrix(
        &self,
        sides: &[Option<usize>; 2],
        local: &LocalMatrix,
        scale: f64,
        matrix: &mut Matrix,
    ) {
        let turns = |body: usize| self.model.bodies[body].rotates;
        for (row_side, row_body) in sides.iter().enumerate() {
            let Some(row_body) = *row_body else { continue };
            for (column_side, column_body) in sides.iter().enumerate() {
                let Some(column_body) = *column_body else {
                    continue;
                };
                for r in 0..6 {
                    for c in 0..6 {
                        let free = (r < 3 || turns(row_body)) && (c < 3 || turns(column_body));
                        let entry = local[(6 * row_side + r, 6 * column_side + c)];
                        let value = if free { scale * entry } else { 0.0 };
                        matrix.add(6 * row_body + r, 6 * column_body + c, value);
                    }
                }
            }
        }
    }

    /// Friction and angles start anew where the bodies stand: stuck without creep.
    pub(crate) fn start_history(&mut self) {
        self.history.frictions = self
            .model
            .frictions
            .iter()
            .map(|friction| {
                let joint = &self.model.joints[friction.joint];
                Memory::at(friction, &self.marker(joint.i), &self.marker(joint.j))
            })
            .collect();
        self.history.angles.fill(0.0);
        self.remember_angles();
    }

    /// Takes over the present displacements and velocities of the joints as accepted ones, after a
    /// step of length `size`.
    pub(crate) fn accept_frictions(&mut self, size: f64) {
        for (place, friction) in self.model.frictions.iter().enumerate() {
            let joint = &self.model.joints[friction.joint];
            let (i, j) = (self.marker(joint.i), self.marker(joint.j));
            self.history.frictions[place].accept(friction, &i, &j, size);
        }
    }

    /// Takes over the present rotations as the last accepted ones.
    pub(crate) fn remember_angles(&mut self) {
        for place in 0..self.model.measures.len() {
            if matches!(self.model.measures[place].quantity, Quantity::Rotation(_)) {
                self.history.angles[place] = self.measure_value(place);
            }
        }
    }
}

/// `value` plus the whole turns that bring it closest to `reference`.
fn nearest_turn(value: f64, reference: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    value + turn * ((reference - value) / turn).round()
}

fn read(input: Input, time: f64, measures: &[f64]) -> f64 {
    match input {
        Input::Time => time,
        Input::Measure(measure) => measures[measure],
        // Results are refused in equations when the model is built.
        Input::Result(_) => f64::NAN,
    }
}

fn spread(sides: &[Option<usize>; 2], local: &Local, blocks: &mut [[f64; 6]]) {
    let mut block = 0;
    for (side, body) in sides.iter().enumerate() {
        if body.is_some() {
            for k in 0..6 {
                blocks[block][k] = local[6 * side + k];
            }
            block += 1;
        }
    }
}

fn reaction_of(constraints: &[Constraint], joint: usize) -> Vec<Contribution> {
    let of_joint = constraints
        .iter()
        .enumerate()
        .filter(|(_, c)| c.owner == Owner::Joint(joint));
    of_joint
        .filter_map(|(constraint, c)| {
            let share = match c.form {
                Form::Pair {
                    equation: Equation::Along(axis),
                    ..
                } => Share::Force(axis),
                Form::Pair { .. } => Share::Moment,
                Form::Function => return None,
            };
            Some(Contribution { constraint, share })
        })
        .collect()
}

/// Generalised force of one unit of a single-component force.
fn direction(kind: ForceKind, i: &MarkerFrame, j: &MarkerFrame) -> Local {
    let mut local = Local::zeros();
    match kind {
        ForceKind::LineOfSight => {
            let d = i.origin - j.origin;
            // Coincident markers have no line: the force is then zero, as its direction is unknown.
            let n = d.try_normalize(0.0).unwrap_or_else(Vector3::zeros);
            local.fixed_rows_mut::<3>(0).copy_from(&n);
            local.fixed_rows_mut::<3>(3).copy_from(&i.arm.cross(&n));
            local.fixed_rows_mut::<3>(6).copy_from(&-n);
            local.fixed_rows_mut::<3>(9).copy_from(&-j.arm.cross(&n));
        }
        ForceKind::AlongZ => {
            let z = j.axis(2);
            local.fixed_rows_mut::<3>(0).copy_from(&z);
            local.fixed_rows_mut::<3>(3).copy_from(&i.arm.cross(&z));
        }
        ForceKind::AboutZ => {
            let z = j.axis(2);
            local.fixed_rows_mut::<3>(3).copy_from(&z);
            local.fixed_rows_mut::<3>(9).copy_from(&-z);
        }
        ForceKind::AboutZActionOnly => {
            local.fixed_rows_mut::<3>(3).copy_from(&j.axis(2));
        }
    }
    local
}

/// Change of [`direction`] with the local motions.
fn direction_stiffness(kind: ForceKind, i: &MarkerFrame, j: &MarkerFrame) -> LocalMatrix {
    let mut matrix = LocalMatrix::zeros();
    let mut put = |row: usize, column: usize, block: Matrix3<f64>| {
        let mut view = matrix.fixed_view_mut::<3, 3>(row, column);
        view += block;
    };
    let z = skew(&j.axis(2));
    match kind {
        ForceKind::LineOfSight => {
            let d = i.origin - j.origin;
            let length = d.norm();
            if length == 0.0 {
                return matrix;
            }
            let n = d / length;
            let across = (Matrix3::identity() - n * n.transpose()) / length;
            let (rho_i, rho_j, n) = (skew(&i.arm), skew(&j.arm), skew(&n));
            // δd = δr_I − ρ_I× δθ_I − δr_J + ρ_J× δθ_J;  δn = across δd
            let changes = [across, -across * rho_i, -across, across * rho_j];
            for (column, change) in changes.into_iter().enumerate() {
                put(0, 3 * column, change);
                put(3, 3 * column, rho_i * change);
                put(6, 3 * column, -change);
                put(9, 3 * column, -rho_j * change);
            }
            // δρ × n = n× ρ× δθ
            put(3, 3, n * rho_i);
            put(9, 9, -n * rho_j);
        }
        ForceKind::AlongZ => {
            let rho = skew(&i.arm);
            put(0, 9, -z);
            put(3, 3, z * rho);
            put(3, 9, -rho * z);
        }
        ForceKind::AboutZ => {
            put(3, 9, -z);
            put(9, 9, z);
        }
        ForceKind::AboutZActionOnly => put(3, 9, -z),
    }
    matrix
}
