//! A pendulum on a pin with friction: the loop of a simulator in one function.

use friction::Resultant;
use friction::explicit::RevoluteStepper;

/// Gravity, m/s².
pub(crate) const GRAVITY: f64 = 9.81;

/// A point mass on a massless rod that turns about a pin. SI units.
pub(crate) struct Pendulum {
    /// Mass, kg.
    pub(crate) mass: f64,
    /// Distance from pin to mass, m.
    pub(crate) length: f64,
    /// Angle from hanging down, rad.
    pub(crate) angle: f64,
    /// Angular rate, rad/s.
    pub(crate) rate: f64,
    /// Friction of the pin; the pendulum is the I part, the ground the J part.
    pub(crate) friction: RevoluteStepper,
    /// Friction torque of the last step, N m.
    pub(crate) torque: f64,
    /// Energy that friction has taken out so far, J.
    pub(crate) dissipated: f64,
}

impl Pendulum {
    /// One step `dt` of the semi-implicit Euler formula.
    pub(crate) fn step(&mut self, dt: f64) {
        // What the simulator has to supply: the reaction of the joint on the I part, friction
        // excluded, in axes whose z is the pin. Here x points from the mass to the pin. Friction of
        // the last step is in the tangential part: the torque of the pin pushes the rod sideways.
        let radial = self.mass * (self.length * self.rate.powi(2) + GRAVITY * self.angle.cos());
        let tangential = self.torque / self.length;
        let (force, moment) = ([radial, tangential, 0.0], [0.0; 3]);

        // Friction, a torque about the pin on the I part, with its slope over the surface velocity.
        let Resultant {
            force: [torque],
            by_velocity: [[slope]],
            ..
        } = self.friction.step(self.rate, force, moment, dt);

        // The simulator's own step. Dividing by `inertia - dt * slope` instead of the inertia takes
        // the slope of friction at the end of the step, and makes every step stable.
        let inertia = self.mass * self.length.powi(2);
        let weight = -self.mass * GRAVITY * self.length * self.angle.sin();
        let slope = slope * self.friction.load.pin_radius;
        let change = dt * (weight + torque) / (inertia - dt * slope);
        self.rate += change;
        self.angle += dt * self.rate;
        self.torque = torque + slope * change;
        self.dissipated -= dt * self.torque * self.rate;
    }

    /// Kinetic and potential energy, the latter from the lowest point, J.
    pub(crate) fn energy(&self) -> f64 {
        let speed = self.length * self.rate;
        let height = self.length * (1.0 - self.angle.cos());
        self.mass * (0.5 * speed * speed + GRAVITY * height)
    }
}
