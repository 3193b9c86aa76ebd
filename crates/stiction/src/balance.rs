//! Where the energy of a run went: what the bodies gained, what was put in, what friction took.
//!
//! The balance is one of the whole model, with works that the integrator integrates by its own
//! formula beside the motion:
//!
//! ```text
//! kinetic + weight + stored changes + dissipated - work of forces - work of motions = residual
//! ```
//!
//! Without errors of integration the residual is zero, so it is a check that needs no reference. It
//! holds over dynamic simulations; equilibria and assemblies move the model without doing work, and
//! what they change between two simulations is left out.

use mechanics::{Snapshot, gravity_energy, kinetic_energy};
use results::UnitNames;
use serde::{Deserialize, Serialize};

use crate::text_table::text_table;
use crate::wrenches::Wrenches;

/// A residual above this part of the energy exchanged is worth a warning: ten times what runs with
/// the default error stay below.
const SUSPICIOUS: f64 = 1e-3;
/// A residual below this part of the energy that is there is rounding, however little is exchanged.
const ROUNDING: f64 = 1e-12;

/// An energy of the model over a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyTerm {
    /// At the start of the first dynamic simulation.
    pub start: f64,
    /// At the end of the last one.
    pub end: f64,
    /// Sum of the changes during the dynamic simulations: `end - start` unless equilibria or
    /// assemblies came between them.
    pub change: f64,
}

/// Energy balance of the dynamic simulations of a run, all in the model's unit force · length.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyBalance {
    /// Unit of the energies.
    pub unit: String,
    /// Kinetic energy of the parts.
    pub kinetic: EnergyTerm,
    /// Potential energy of their weight, zero at the origin of the ground.
    pub weight: EnergyTerm,
    /// Energy stored in the creep and the bristles of frictions.
    pub stored: EnergyTerm,
    /// Work that forces put in, springs among them.
    pub forces: f64,
    /// Work that motions put in.
    pub motions: f64,
    /// What friction dissipated: the work that it took out less what has been stored since.
    pub dissipated: f64,
    /// The energy exchanged: the largest of the totals, over the outputs, of the magnitudes by which
    /// the kinetic energy, the potential energy, and the works of forces, of motions and of friction
    /// changed from one output to the next. It grows with the length of a run, as does the error.
    pub exchanged: f64,
    /// Energy that the parts have at velocities of the size of the error tolerance, from which none can
    /// be told.
    #[serde(default)]
    pub error: f64,
}

impl EnergyBalance {
    /// What the integration lost (negative) or made up (positive).
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.kinetic.change + self.weight.change + self.stored.change + self.dissipated
            - self.forces
            - self.motions
    }

    /// Magnitude of the residual as a part of the energy exchanged; zero where none was.
    #[must_use]
    pub fn residual_share(&self) -> f64 {
        if self.exchanged > 0.0 {
            self.residual().abs() / self.exchanged
        } else {
            0.0
        }
    }
}

impl EnergyBalance {
    /// Whether more is unaccounted for than good runs leave.
    pub(crate) fn is_suspicious(&self) -> bool {
        let terms = [&self.kinetic, &self.weight, &self.stored];
        let present = terms.map(|term| term.start.abs().max(term.end.abs()));
        let present = present.into_iter().fold(0.0, f64::max);
        let residual = self.residual().abs();
        let floor = self.error.max(ROUNDING * present);
        residual > SUSPICIOUS * self.exchanged && residual > floor
    }
}

impl std::fmt::Display for EnergyBalance {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        // Adding zero makes the zero plain that a sum of nothing leaves negative.
        let number = |value: f64| format!("{:.6e}", value + 0.0);
        let term = |name: &str, term: &EnergyTerm| {
            [
                name.to_owned(),
                number(term.start),
                number(term.end),
                number(term.change),
            ]
        };
        let work =
            |name: &str, work: f64| [name.to_owned(), String::new(), String::new(), number(work)];
        let heads = ["", "start", "end", "change"];
        let rows = [
            term("kinetic", &self.kinetic),
            term("potential (weight)", &self.weight),
            term("stored in creep and bristles", &self.stored),
            work("dissipated by friction", self.dissipated),
            work("work of forces", self.forces),
            work("work of motions", self.motions),
            work("residual", self.residual()),
        ];
        write!(f, "{}", text_table(heads, 1, rows))?;
        writeln!(
            f,
            "The residual is {:.2e} of the energy exchanged, {:.6e} {}.",
            self.residual_share(),
            self.exchanged,
            self.unit
        )
    }
}

/// Kinetic energy, potential energy, works of forces, of motions and of friction.
type Sums = [f64; 5];

/// Keeps the energy balance of a run, and what each friction dissipated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct EnergyAccount {
    unit: String,
    balance: Option<EnergyBalance>,
    /// Sums of the changes so far, and of their magnitudes.
    changes: Sums,
    exchanged: Sums,
    /// Values at the last output of the dynamic simulation that goes on.
    last: Option<Sums>,
    /// Stored energy and work of each friction there.
    last_frictions: Vec<[f64; 2]>,
    dissipated: Vec<f64>,
}

impl EnergyAccount {
    pub(crate) fn new(frictions: usize, units: &UnitNames) -> Self {
        Self {
            unit: units.energy(),
            balance: None,
            changes: [0.0; 5],
            exchanged: [0.0; 5],
            last: None,
            last_frictions: vec![[0.0; 2]; frictions],
            dissipated: vec![0.0; frictions],
        }
    }

    /// What each friction dissipated so far.
    pub(crate) fn dissipated(&self) -> &[f64] {
        &self.dissipated
    }

    /// The balance so far; `None` before the first dynamic simulation.
    pub(crate) fn balance(&self) -> Option<&EnergyBalance> {
        self.balance.as_ref()
    }

    /// The channels of energy at an instant that is counted already: [`results::ENERGY_COMPONENTS`].
    pub(crate) fn energies(&self, wrenches: &Wrenches<'_>) -> [f64; 7] {
        let snapshot = wrenches.snapshot();
        let (model, state) = (snapshot.model(), snapshot.state());
        let frictions = 0..self.dissipated.len();
        let stored = frictions.fold(0.0, |sum, place| sum + wrenches.friction(place).stored);
        let balance = self.balance.as_ref();
        let so_far = |term: fn(&EnergyBalance) -> f64| balance.map_or(0.0, term);
        [
            kinetic_energy(model, state),
            gravity_energy(model, state),
            stored,
            so_far(|balance| balance.forces),
            so_far(|balance| balance.motions),
            so_far(|balance| balance.dissipated),
            so_far(EnergyBalance::residual),
        ]
    }

    /// What follows is no dynamic simulation.
    pub(crate) fn pause(&mut self) {
        self.last = None;
    }

    /// The start of a dynamic simulation whose velocities may be off by `error`.
    pub(crate) fn begin(&mut self, wrenches: &Wrenches<'_>, error: f64) {
        let sums = self.take(wrenches);
        let stored = self.stored();
        self.last = Some(sums);
        let term = |start: f64| EnergyTerm {
            start,
            end: start,
            change: 0.0,
        };
        let balance = self.balance.get_or_insert_with(|| EnergyBalance {
            unit: self.unit.clone(),
            kinetic: term(sums[0]),
            weight: term(sums[1]),
            stored: term(stored),
            ..EnergyBalance::default()
        });
        let bodies = wrenches.snapshot().model().bodies.iter();
        let mass: f64 = bodies.map(|body| body.mass).sum();
        balance.error = balance.error.max(0.5 * mass * error * error);
    }

    /// An output; counts within a dynamic simulation only.
    pub(crate) fn output(&mut self, wrenches: &Wrenches<'_>) {
        let Some(last) = self.last else { return };
        let before = self.last_frictions.clone();
        let stored_before = self.stored();
        let sums = self.take(wrenches);
        let stored = self.stored();
        self.last = Some(sums);
        for k in 0..sums.len() {
            self.changes[k] += sums[k] - last[k];
            self.exchanged[k] += (sums[k] - last[k]).abs();
        }
        let frictions = before.iter().zip(&self.last_frictions);
        for (dissipated, (before, now)) in self.dissipated.iter_mut().zip(frictions) {
            *dissipated += (now[1] - before[1]) - (now[0] - before[0]);
        }
        let Some(balance) = &mut self.balance else {
            return;
        };
        let [kinetic, weight, forces, motions, _] = self.changes;
        (balance.kinetic.end, balance.kinetic.change) = (sums[0], kinetic);
        (balance.weight.end, balance.weight.change) = (sums[1], weight);
        balance.stored.end = stored;
        balance.stored.change += stored - stored_before;
        (balance.forces, balance.motions) = (forces, motions);
        balance.dissipated = total(self.dissipated.iter());
        balance.exchanged = self.exchanged.into_iter().fold(0.0, f64::max);
    }

    /// Energies and works of an instant; keeps those of the frictions.
    fn take(&mut self, wrenches: &Wrenches<'_>) -> Sums {
        let snapshot: &Snapshot<'_> = wrenches.snapshot();
        let (model, state) = (snapshot.model(), snapshot.state());
        let (frictions, others) = snapshot.works().split_at(self.last_frictions.len());
        for (place, (last, work)) in self.last_frictions.iter_mut().zip(frictions).enumerate() {
            *last = [wrenches.friction(place).stored, *work];
        }
        let taken = total(frictions.iter());
        let kinetic = kinetic_energy(model, state);
        [
            kinetic,
            gravity_energy(model, state),
            others[0],
            others[1],
            taken,
        ]
    }

    fn stored(&self) -> f64 {
        total(self.last_frictions.iter().map(|last| &last[0]))
    }
}

/// Sum of values, which of none is a plain zero.
fn total<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    values.fold(0.0, |sum, value| sum + value)
}
