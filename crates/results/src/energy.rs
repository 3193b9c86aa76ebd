//! The entity of our own that says where the energy of the model was at each output.
//!
//! It stands after all others in a `.res`, of the type `Stiction_Energy` and without an element.
//!
//! | component | what |
//! |---|---|
//! | `KINETIC` | kinetic energy of the parts |
//! | `WEIGHT` | potential energy of their weight, zero at the origin of the ground |
//! | `STORED` | energy in the creep and the bristles of frictions |
//! | `WORK_OF_FORCES` `WORK_OF_MOTIONS` | what they put in during the dynamic simulations so far; springs are forces |
//! | `DISSIPATED` | what friction dissipated during them |
//! | `RESIDUAL` | changes of the first three and dissipation less the works: zero but for the error of the integration |
//!
//! All are in force · length. Equilibria and assemblies between two simulations change the first three
//! without doing work, and are left out of the residual.

use crate::channels::{Component, Entity};
use crate::units::UnitNames;

/// Type of the entity in a `.res`.
pub const ENERGY: &str = "Stiction_Energy";

/// Its components in their order.
pub const ENERGY_COMPONENTS: [&str; 7] = [
    "KINETIC",
    "WEIGHT",
    "STORED",
    "WORK_OF_FORCES",
    "WORK_OF_MOTIONS",
    "DISSIPATED",
    "RESIDUAL",
];

impl Entity {
    /// The energies of the model; see the [module](crate::energy).
    ///
    /// ```
    /// use results::{Entity, UnitNames};
    /// let energy = Entity::energy(&UnitNames::default());
    /// assert_eq!(energy.name, "ENERGY_BALANCE");
    /// assert_eq!(energy.components[0].unit, "newton-meter");
    /// ```
    pub fn energy(units: &UnitNames) -> Self {
        let components = ENERGY_COMPONENTS.map(|name| Component::new(name, units.energy()));
        Self {
            name: "ENERGY_BALANCE".to_owned(),
            element: None,
            kind: ENERGY.to_owned(),
            object_id: None,
            components: components.to_vec(),
        }
    }
}
