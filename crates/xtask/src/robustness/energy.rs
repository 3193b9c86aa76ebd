//! The energy balance of a run, and what may be missing in it.

use mechanics::{Snapshot, gravity_energy, kinetic_energy};
use nalgebra::Vector3;

/// Energies and works of an instant: kinetic, of weight, out by friction, in by forces, in by motions.
type Terms = [f64; 5];

/// Signs of the terms in what must stay the same.
const SIGNS: Terms = [1.0, 1.0, 1.0, -1.0, -1.0];

/// The balance so far.
pub(super) struct Balance {
    last: Terms,
    residual: f64,
    /// Magnitudes by which the terms changed.
    exchanged: Terms,
    /// Energy that an error of one would be, at the rate of an error of ERROR.
    unit: f64,
    error: f64,
    length: f64,
    rate: f64,
}

impl Balance {
    pub(super) fn start(snapshot: &Snapshot<'_>, error: f64, length: f64) -> Self {
        let mut balance = Self {
            last: terms(snapshot),
            residual: 0.0,
            exchanged: [0.0; 5],
            unit: 0.0,
            error,
            length,
            rate: 1.0,
        };
        balance.observe(snapshot);
        balance
    }

    /// The next output.
    pub(super) fn output(&mut self, snapshot: &Snapshot<'_>) {
        let now = terms(snapshot);
        for k in 0..SIGNS.len() {
            let change = now[k] - self.last[k];
            self.residual += SIGNS[k] * change;
            self.exchanged[k] += change.abs();
        }
        self.last = now;
        self.observe(snapshot);
    }

    /// ERROR is a part of the length and of the largest rate so far, for all bodies alike: such an
    /// error of a body's velocity and place changes its energy by `m |v| L Ω + |Jω| Ω + m g L`. A body at
    /// rest, too, has the energy of an error of its velocity: none has less than `ERROR L Ω`.
    fn observe(&mut self, snapshot: &Snapshot<'_>) {
        let (model, state) = (snapshot.model(), snapshot.state());
        let mut impulse = 0.0;
        let mut weight = 0.0;
        let mut mass = 0.0;
        let velocities = state.velocities().chunks_exact(6);
        for (place, (body, u)) in model.bodies.iter().zip(velocities).enumerate() {
            let speed = Vector3::from_column_slice(&u[..3]).norm();
            let omega = Vector3::from_column_slice(&u[3..]);
            let rotation = state.orientation(place).matrix();
            let spin = (body.inertia * (rotation.transpose() * omega)).norm();
            self.rate = self.rate.max(speed / self.length).max(omega.amax());
            impulse += body.mass * speed * self.length + spin;
            weight += body.mass * model.gravity.norm() * self.length;
            mass += body.mass;
        }
        impulse += mass * self.error * self.rate * self.length.powi(2);
        self.unit = self.unit.max(impulse * self.rate + weight);
    }

    /// What is missing, as a part of the energy that an error of one would be and of the energy
    /// exchanged.
    pub(super) fn share(&self) -> f64 {
        let exchanged = self.exchanged.into_iter().fold(0.0, f64::max);
        let scale = self.unit + exchanged;
        if scale > 0.0 {
            self.residual.abs() / scale
        } else {
            self.residual.abs()
        }
    }
}

fn terms(snapshot: &Snapshot<'_>) -> Terms {
    let (model, state) = (snapshot.model(), snapshot.state());
    let (frictions, others) = snapshot.works().split_at(model.frictions.len());
    [
        kinetic_energy(model, state),
        gravity_energy(model, state),
        frictions.iter().sum(),
        others[0],
        others[1],
    ]
}
