//! Defaults of FRICTION arguments that a dataset leaves out.

use dataset::{Dataset, DefaultInUse, Dimension, FrictionQuantity};
use results::UnitNames;

use crate::channels::{name, unit_names};

/// The defaults in use of one FRICTION.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionDefaults {
    /// Id of the FRICTION.
    pub id: u32,
    /// Its name.
    pub name: String,
    /// Arguments and their values, plain numbers in the units of the model.
    pub defaults: Vec<DefaultInUse>,
    /// Units of the model.
    pub units: UnitNames,
}

/// A value of a quantity with its unit, `1e40` rather than its forty digits.
pub(crate) fn with_unit(quantity: FrictionQuantity, value: f64, units: &UnitNames) -> String {
    let number = format!("{value:?}");
    let number = number.strip_suffix(".0").unwrap_or(&number);
    let unit = match quantity.dimension() {
        Dimension::Number => return number.to_owned(),
        Dimension::Length => units.length.clone(),
        Dimension::Velocity => units.velocity(),
        Dimension::Force => units.force.clone(),
        Dimension::Torque => units.torque(),
        Dimension::Stiffness => format!("{}/{}", units.force, units.length),
        Dimension::Damping => format!("{}-{}/{}", units.force, units.time, units.length),
    };
    format!("{number} {unit}")
}

impl std::fmt::Display for FrictionDefaults {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "FRICTION/{} ({}), defaults in use:", self.id, self.name)?;
        for (place, default) in self.defaults.iter().enumerate() {
            let separator = if place == 0 { " " } else { ", " };
            write!(
                f,
                "{separator}{}={}",
                default.quantity.keyword(),
                with_unit(default.quantity, default.value, &self.units)
            )?;
        }
        Ok(())
    }
}

/// The defaults in use, by FRICTION; frictions without any are left out.
#[must_use]
pub fn defaults_in_use(dataset: &Dataset) -> Vec<FrictionDefaults> {
    let units = unit_names(dataset);
    let with_joint = dataset.frictions.iter().filter_map(|friction| {
        let joint = dataset.joints.by_id(friction.joint)?;
        Some(FrictionDefaults {
            id: friction.header.id,
            name: name(&friction.header, "FRICTION"),
            defaults: friction.defaults_in_use(joint.kind),
            units: units.clone(),
        })
    });
    with_joint
        .filter(|line| !line.defaults.is_empty())
        .collect()
}
