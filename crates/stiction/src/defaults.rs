//! Defaults of FRICTION arguments that a dataset leaves out.

use dataset::{Dataset, DefaultInUse};

use crate::channels::name;

/// The defaults in use of one FRICTION.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionDefaults {
    /// Id of the FRICTION.
    pub id: u32,
    /// Its name.
    pub name: String,
    /// Arguments and their values, plain numbers in the units of the model.
    pub defaults: Vec<DefaultInUse>,
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
                default.value
            )?;
        }
        Ok(())
    }
}

/// The defaults in use, by FRICTION; frictions without any are left out.
#[must_use]
pub fn defaults_in_use(dataset: &Dataset) -> Vec<FrictionDefaults> {
    let with_joint = dataset.frictions.iter().filter_map(|friction| {
        let joint = dataset.joints.by_id(friction.joint)?;
        Some(FrictionDefaults {
            id: friction.header.id,
            name: name(&friction.header, "FRICTION"),
            defaults: friction.defaults_in_use(joint.kind),
        })
    });
    with_joint
        .filter(|line| !line.defaults.is_empty())
        .collect()
}
