//! Where the bodies are and how they move.
//!
//! The integrator's vector holds seven numbers of position a body (centre of mass in ground, unit
//! quaternion of the part), then six of velocity a body (velocity of the centre of mass and angular
//! velocity, both along ground axes), then the differential states of system elements, then the
//! bristle deflections of LuGre frictions, the works of frictions, forces and motions, and last, where
//! functions jump, what their switches share between the two sides of a jump.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::model::{Body, Marker};
use crate::rotation::Quaternion;

/// Numbers of position for each body.
pub const POSITIONS: usize = 7;
/// Numbers of velocity for each body.
pub const VELOCITIES: usize = 6;

/// Time, positions and velocities of all bodies.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Time.
    pub time: f64,
    /// Positions, velocities, differential states, bristle deflections, works and shares; see the
    /// module's description.
    pub values: Vec<f64>,
    bodies: usize,
    states: usize,
    bristles: usize,
    shares: usize,
}

impl State {
    /// A state from positions and then velocities of its bodies.
    #[must_use]
    pub fn new(time: f64, values: Vec<f64>) -> Self {
        Self {
            time,
            bodies: values.len() / (POSITIONS + VELOCITIES),
            states: 0,
            bristles: 0,
            shares: 0,
            values,
        }
    }

    /// Appends differential states, unless it has some, and bristle deflections and works, all zero.
    pub(crate) fn extend(&mut self, states: &[f64], bristles: usize, works: usize) {
        if self.states != states.len() {
            self.values.truncate(self.motions());
            self.values.extend_from_slice(states);
            self.states = states.len();
        }
        self.bristles = bristles;
        self.shares = 0;
        let size = self.rate_range().end + bristles + works;
        self.values.resize(size, 0.0);
    }

    /// Whether it holds the same numbers of everything as another.
    pub(crate) fn has_layout_of(&self, other: &Self) -> bool {
        let counts = |state: &Self| {
            (
                state.bodies,
                state.states,
                state.bristles,
                state.values.len(),
            )
        };
        counts(self) == counts(other)
    }

    /// Number of bodies.
    #[must_use]
    pub fn bodies(&self) -> usize {
        self.bodies
    }

    /// How many of the values are positions and velocities.
    pub(crate) fn motions(&self) -> usize {
        (POSITIONS + VELOCITIES) * self.bodies
    }

    /// Places of the velocities among the values.
    fn velocity_range(&self) -> std::ops::Range<usize> {
        POSITIONS * self.bodies..self.motions()
    }

    /// Places among the values of what has a rate: velocities, then differential states.
    pub(crate) fn rate_range(&self) -> std::ops::Range<usize> {
        POSITIONS * self.bodies..self.motions() + self.states
    }

    /// Places of the differential states among the values.
    pub(crate) fn state_range(&self) -> std::ops::Range<usize> {
        self.motions()..self.motions() + self.states
    }

    /// The differential states, in the order of [`crate::model::Model::states`].
    #[must_use]
    pub fn states(&self) -> &[f64] {
        &self.values[self.state_range()]
    }

    /// The differential states.
    pub(crate) fn states_mut(&mut self) -> &mut [f64] {
        let range = self.state_range();
        &mut self.values[range]
    }

    /// Places of the bristle deflections among the values.
    pub(crate) fn bristle_range(&self) -> std::ops::Range<usize> {
        let first = self.state_range().end;
        first..first + self.bristles
    }

    /// Places of the works among the values.
    pub(crate) fn work_range(&self) -> std::ops::Range<usize> {
        self.bristle_range().end..self.values.len() - self.shares
    }

    /// Gives the state this number of shares of switches, zero where they are new. It has them while
    /// it is integrated.
    pub(crate) fn set_shares(&mut self, count: usize) {
        self.values.resize(self.work_range().end + count, 0.0);
        self.shares = count;
    }

    /// Places of the shares of switches among the values.
    pub(crate) fn share_range(&self) -> std::ops::Range<usize> {
        self.work_range().end..self.values.len()
    }

    /// Works so far: what each friction took out, then what forces and what motions put in.
    #[must_use]
    pub fn works(&self) -> &[f64] {
        &self.values[self.work_range()]
    }

    /// Centre of mass of a body in ground.
    #[must_use]
    pub fn centre(&self, body: usize) -> Vector3<f64> {
        Vector3::from_column_slice(&self.values[body * POSITIONS..body * POSITIONS + 3])
    }

    /// Orientation of a body.
    #[must_use]
    pub fn orientation(&self, body: usize) -> Quaternion {
        Quaternion::from_slice(&self.values[body * POSITIONS + 3..(body + 1) * POSITIONS])
    }

    /// Velocities of all bodies, six each.
    #[must_use]
    pub fn velocities(&self) -> &[f64] {
        &self.values[self.bodies * POSITIONS..self.motions()]
    }

    /// Velocities of all bodies, six each.
    pub fn velocities_mut(&mut self) -> &mut [f64] {
        let range = self.bodies * POSITIONS..self.motions();
        &mut self.values[range]
    }

    /// Gives every quaternion its length of one back.
    pub(crate) fn normalize(&mut self) {
        for body in 0..self.bodies {
            let place = body * POSITIONS + 3;
            let q = self.orientation(body).normalized();
            q.write(&mut self.values[place..place + 4]);
        }
    }

    /// Displaces all bodies: six numbers a body, `δr` and the small rotation `δθ`, ground axes.
    pub fn displace(&mut self, change: &[f64]) {
        for (body, change) in change.chunks_exact(VELOCITIES).enumerate() {
            let place = body * POSITIONS;
            for axis in 0..3 {
                self.values[place + axis] += change[axis];
            }
            let theta = Vector3::from_column_slice(&change[3..6]);
            let turned = Quaternion::exp(&theta)
                .times(&self.orientation(body))
                .normalized();
            turned.write(&mut self.values[place + 3..place + POSITIONS]);
        }
    }

    /// Writes the rates of the positions at `values`, which are laid out like the state's own:
    /// `q̇ = ½ ω q`.
    pub(crate) fn write_position_slopes(&self, values: &[f64], slopes: &mut [f64]) {
        let velocities = &values[self.velocity_range()];
        for (body, u) in velocities.chunks_exact(VELOCITIES).enumerate() {
            let place = body * POSITIONS;
            slopes[place..place + 3].copy_from_slice(&u[..3]);
            let q = Quaternion::from_slice(&values[place + 3..place + POSITIONS]);
            let half = Quaternion::from_vector(0.5 * Vector3::from_column_slice(&u[3..]));
            half.times(&q)
                .write(&mut slopes[place + 3..place + POSITIONS]);
        }
    }

    /// Writes the second derivatives of the positions at `values` with `slopes`, both laid out like the
    /// state's own: `q̈ = ½ (ω̇ q + ω q̇)`.
    pub(crate) fn write_position_curvatures(
        &self,
        values: &[f64],
        slopes: &[f64],
        curvatures: &mut [f64],
    ) {
        let velocities = &values[self.velocity_range()];
        let accelerations = &slopes[self.velocity_range()];
        let pairs = velocities.chunks_exact(VELOCITIES);
        let pairs = pairs.zip(accelerations.chunks_exact(VELOCITIES));
        for (body, (u, a)) in pairs.enumerate() {
            let place = body * POSITIONS;
            curvatures[place..place + 3].copy_from_slice(&a[..3]);
            let turn = place + 3..place + POSITIONS;
            let half = |u: &[f64]| Quaternion::from_vector(0.5 * Vector3::from_column_slice(u));
            let by_rate = half(&u[3..]).times(&Quaternion::from_slice(&slopes[turn.clone()]));
            let by_turn = half(&a[3..]).times(&Quaternion::from_slice(&values[turn.clone()]));
            by_rate.plus(&by_turn).write(&mut curvatures[turn]);
        }
    }
}

/// What the equations need of a body at an instant.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct BodyFrame {
    /// Centre of mass in ground.
    pub centre: Vector3<f64>,
    /// Part axes to ground axes.
    pub rotation: Matrix3<f64>,
    /// Velocity of the centre of mass, ground axes.
    pub velocity: Vector3<f64>,
    /// Angular velocity, ground axes.
    pub omega: Vector3<f64>,
    /// Mass divided by the unit consistency factor.
    pub mass: f64,
    /// Inertia about the centre of mass, ground axes.
    pub inertia: Matrix3<f64>,
}

impl BodyFrame {
    pub(crate) const fn at_rest() -> Self {
        Self {
            centre: Vector3::new(0.0, 0.0, 0.0),
            rotation: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
            velocity: Vector3::new(0.0, 0.0, 0.0),
            omega: Vector3::new(0.0, 0.0, 0.0),
            mass: 0.0,
            inertia: Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
        }
    }

    pub(crate) fn update(&mut self, state: &State, place: usize, body: &Body) {
        let u = &state.velocities()[place * VELOCITIES..(place + 1) * VELOCITIES];
        self.centre = state.centre(place);
        self.rotation = state.orientation(place).matrix();
        self.velocity = Vector3::from_column_slice(&u[..3]);
        self.omega = Vector3::from_column_slice(&u[3..]);
        self.mass = body.mass;
        self.inertia = self.rotation * body.inertia * self.rotation.transpose();
    }
}

/// What the equations need of a marker at an instant.
#[derive(Clone, Copy, Debug)]
pub struct MarkerFrame {
    /// The body it is fixed to; `None` is ground.
    pub body: Option<usize>,
    /// Origin in ground.
    pub origin: Vector3<f64>,
    /// Origin from the body's centre of mass, ground axes; zero on ground.
    pub arm: Vector3<f64>,
    /// Columns: the marker's axes along ground axes.
    pub axes: Matrix3<f64>,
    /// Velocity of the origin, ground axes.
    pub velocity: Vector3<f64>,
    /// Angular velocity, ground axes.
    pub omega: Vector3<f64>,
}

impl MarkerFrame {
    /// The frame of `marker` on bodies that stand as `bodies`.
    #[must_use]
    pub fn new(marker: &Marker, bodies: &[BodyFrame]) -> Self {
        let mut new = Self {
            body: None,
            origin: Vector3::zeros(),
            arm: Vector3::zeros(),
            axes: Matrix3::zeros(),
            velocity: Vector3::zeros(),
            omega: Vector3::zeros(),
        };
        new.update(marker, bodies);
        new
    }

    /// Brings it up to date with the bodies.
    pub(crate) fn update(&mut self, marker: &Marker, bodies: &[BodyFrame]) {
        self.body = marker.body;
        match marker.body {
            None => {
                self.origin = marker.offset;
                self.axes = marker.axes;
            }
            Some(place) => {
                let body = &bodies[place];
                self.arm = body.rotation * marker.offset;
                self.origin = body.centre + self.arm;
                self.axes = body.rotation * marker.axes;
                self.velocity = body.velocity + body.omega.cross(&self.arm);
                self.omega = body.omega;
            }
        }
    }

    /// One of its axes along ground axes.
    #[must_use]
    pub fn axis(&self, k: usize) -> Vector3<f64> {
        self.axes.column(k).into_owned()
    }
}
