//! Entities and components of a `.res`: what is reported about a part, a joint, a friction, ...
//!
//! Names, units and order are those of Adams. Meaning, with the sign and frame of each:
//!
//! | entity | components |
//! |---|---|
//! | part | pose of the part's frame in ground (`PSI THETA PHI` body-fixed 3-1-3 angles), velocity and acceleration of its origin and angular ones, global components |
//! | joint, primitive, motion, force | force and torque on the part of the I marker, at the I marker, global components; friction excluded |
//! | friction | force and torque on the part of the I marker, J axes; coefficient, surface velocity and creep, I axes |
//!
//! Beside those, `friction_detail.rs` has an entity of our own for each friction, and `energy.rs` one
//! for the model.

use crate::units::UnitNames;

/// One column of results.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Component {
    /// Name within its entity, for example `FX`.
    pub name: String,
    /// Unit, empty for plain numbers.
    pub unit: String,
    /// Label for plots; requests have one.
    pub label: Option<String>,
}

impl Component {
    /// A component without a label.
    pub fn new(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            unit: unit.into(),
            label: None,
        }
    }
}

/// A thing of the model with its columns of results.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Entity {
    /// Name of the result set, for example `PART_2_XFORM`.
    pub name: String,
    /// Name of the element of the model, for example `PART_2`.
    pub element: Option<String>,
    /// Type, for example `Part`, `Joint`, `Friction`; empty if unknown.
    pub kind: String,
    /// Id of the element in the dataset.
    pub object_id: Option<u32>,
    /// Columns in the order of the file.
    pub components: Vec<Component>,
}

impl Entity {
    pub(crate) fn of(kind: &str, name: &str, id: u32, components: Vec<Component>) -> Self {
        Self {
            name: name.into(),
            element: Some(name.into()),
            kind: kind.into(),
            object_id: Some(id),
            components,
        }
    }

    /// A part: pose, velocity and acceleration, three blocks of six components.
    pub fn part(name: &str, id: u32, units: &UnitNames) -> Self {
        let components = [
            (["X", "Y", "Z"], units.length.clone()),
            (["PSI", "THETA", "PHI"], units.angle.clone()),
            (["VX", "VY", "VZ"], units.velocity()),
            (["WX", "WY", "WZ"], units.angular_velocity()),
            (["ACCX", "ACCY", "ACCZ"], units.acceleration()),
            (["WDX", "WDY", "WDZ"], units.angular_acceleration()),
        ];
        let part = Self::of("Part", name, id, triples(components));
        Self {
            name: format!("{name}_XFORM"),
            ..part
        }
    }

    /// Anything that is reported as a force and a torque on the I marker's part.
    ///
    /// `kind` is `Joint`, `Primitive_Joint`, `Motion`, `Single_Component_Force`, `Spring_Damper`, ...
    pub fn reaction(kind: &str, name: &str, id: u32, units: &UnitNames) -> Self {
        let components = [
            (["FX", "FY", "FZ"], units.force.clone()),
            (["TX", "TY", "TZ"], units.torque()),
        ];
        Self::of(kind, name, id, triples(components))
    }

    /// A state variable: `Q`, a plain number.
    pub fn variable(name: &str, id: u32) -> Self {
        Self::of("ADAMS_Variable", name, id, vec![Component::new("Q", "")])
    }

    /// A differential equation: its state `Q` and the rate of that, plain numbers.
    pub fn differential(name: &str, id: u32) -> Self {
        let components = ["Q", "QDOT"].map(|name| Component::new(name, ""));
        Self::of("Differential_Equation", name, id, components.to_vec())
    }

    /// A linear system of `count` states: `X1`, `X2`, ...
    pub fn linear_system(kind: &str, name: &str, id: u32, count: usize) -> Self {
        Self::of(kind, name, id, numbered("X", count))
    }

    /// A plant input of `count` variables: `IN1`, `IN2`, ...
    pub fn plant_input(name: &str, id: u32, count: usize) -> Self {
        Self::of("Plant_Input", name, id, numbered("IN", count))
    }

    /// A plant output of `count` variables: `OUT1`, `OUT2`, ...
    pub fn plant_output(name: &str, id: u32, count: usize) -> Self {
        Self::of("Plant_Output", name, id, numbered("OUT", count))
    }

    /// A friction: its 26 components.
    ///
    /// `W*` is a surface velocity and `CREEP_A*` a length also for rotations.
    pub fn friction(name: &str, id: u32, units: &UnitNames) -> Self {
        let none = String::new();
        let mut components = triples([
            (["FX", "FY", "FZ"], units.force.clone()),
            (["TX", "TY", "TZ"], units.torque()),
            (["MUX", "MUY", "MUZ"], none.clone()),
            (["MURX", "MURY", "MURZ"], none),
        ]);
        components.push(Component::new("MU1", ""));
        components.extend(triples([
            (["VX", "VY", "VZ"], units.velocity()),
            (["WX", "WY", "WZ"], units.velocity()),
            (["CREEP_X", "CREEP_Y", "CREEP_Z"], units.length.clone()),
            (["CREEP_AX", "CREEP_AY", "CREEP_AZ"], units.length.clone()),
        ]));
        components.push(Component::new("BETA", ""));
        Self::of("Friction", name, id, components)
    }

    /// A request with the given columns; columns without a label get their name as one, because
    /// readers of requests expect a label.
    pub fn request(name: &str, id: u32, components: Vec<Component>) -> Self {
        let labelled = components
            .into_iter()
            .map(|component| Component {
                label: component.label.or_else(|| Some(component.name.clone())),
                ..component
            })
            .collect();
        Self::of("Request", name, id, labelled)
    }
}

pub(crate) fn triples<const N: usize>(groups: [([&str; 3], String); N]) -> Vec<Component> {
    groups
        .into_iter()
        .flat_map(|(names, unit)| names.map(|name| Component::new(name, unit.clone())))
        .collect()
}

fn numbered(prefix: &str, count: usize) -> Vec<Component> {
    (1..=count)
        .map(|k| Component::new(format!("{prefix}{k}"), ""))
        .collect()
}
