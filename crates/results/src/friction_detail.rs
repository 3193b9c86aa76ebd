//! The entity of our own that says where the friction of a joint came from.
//!
//! Adams has 26 components for a friction and no more. What we know beyond them stands in an entity
//! of another type, `Stiction_Friction`, after all entities of Adams, so that readers which look for
//! theirs find them where they were. Its result set is the friction's with `_DETAIL` behind, its
//! element and id are those of the friction.
//!
//! | component | unit | what |
//! |---|---|---|
//! | `REGIME` | | 0 stuck, 1 transition, 2 sliding |
//! | `LOAD` | load | effective load on the sliding surfaces, the sum of the next three |
//! | `LOAD_REACTION` `LOAD_BENDING` `LOAD_TORSION` | load | the part of the joint's reaction force, bending and torsional moment in it |
//! | `BY_PRELOAD` `BY_REACTION` `BY_BENDING` `BY_TORSION` | load | friction at the surfaces by its cause, before any limit |
//! | `LIMITED` | | 1 where the limit of the friction force or torque was reached, else 0 |
//! | `POWER` | power | rate at which the friction takes energy out of the motion |
//! | `WORK` | energy | what it took out in the dynamic simulations so far |
//! | `STORED` | energy | what its creep or its bristles hold |
//! | `DISSIPATED` | energy | `WORK` less what has been stored since |
//! | `STICKS` | | number of stick intervals that have begun |
//! | `STICK_START` | time | when the present or last one began |
//! | `STICK_END` | time | when the last complete one ended, 0 until there is one: the joint sticks where this is not after `STICK_START` |
//! | `STUCK_TIME` | time | time spent sticking so far |
//! | `LARGEST_CREEP` | length | largest creep so far, of LUGRE the largest bristle deflection |
//! | `FRICTION` | load | friction force on the part of I where the joint slides, else torque: about one axis with its sign, in a spherical joint its magnitude |
//! | `VELOCITY` | velocity | velocity of the surfaces of that, I relative to J, likewise |
//! | `BRISTLE_X`.. `BRISTLE_AX`.. | length | LUGRE alone: bristle deflection of sliding and of turning, where the joint has it, in the axes of the creep |
//! | `DRIFT_Z` `DRIFT_A` or `DRIFT_AX`.. | length | LUGRE alone: how far the surfaces moved while they stuck beyond what the bristles gave way, along and about the axis or about the axes of J |
//!
//! Nothing is known of what Adams reports of LUGRE beyond the 26; so its bristles stand here, and the
//! entity of Adams keeps its length.
//!
//! The load is a force where the joint slides, else a torque. What is counted (`STICKS` to
//! `LARGEST_CREEP` and the drift) is as of the end of an accepted step, one of the two that enclose
//! the output.

use crate::channels::{Component, Entity, triples};
use crate::units::UnitNames;

/// Type of the entity in a `.res`.
pub const FRICTION_DETAIL: &str = "Stiction_Friction";

/// Which motions of the sliding surfaces a joint has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SurfaceMotion {
    /// Sliding along an axis.
    Sliding,
    /// Turning about an axis.
    Turning,
    /// Both.
    SlidingAndTurning,
    /// Turning about a point.
    TurningAboutPoint,
}

impl SurfaceMotion {
    /// Whether the load is a force, not a torque.
    pub fn slides(self) -> bool {
        matches!(self, Self::Sliding | Self::SlidingAndTurning)
    }

    /// Whether there is turning.
    pub fn turns(self) -> bool {
        self != Self::Sliding
    }

    fn drifts(self) -> &'static [&'static str] {
        match self {
            Self::Sliding => &["DRIFT_Z"],
            Self::Turning => &["DRIFT_A"],
            Self::SlidingAndTurning => &["DRIFT_Z", "DRIFT_A"],
            Self::TurningAboutPoint => &["DRIFT_AX", "DRIFT_AY", "DRIFT_AZ"],
        }
    }
}

impl Entity {
    /// What a friction did and why, with the deflection of its bristles where it has some; see the
    /// [module](crate::friction_detail).
    ///
    /// ```
    /// use results::{Entity, SurfaceMotion, UnitNames};
    /// let units = UnitNames::default();
    /// let detail = Entity::friction_detail("PIN", 3, SurfaceMotion::Turning, false, &units);
    /// assert_eq!(detail.name, "PIN_DETAIL");
    /// assert_eq!(detail.components[1].name, "LOAD");
    /// assert_eq!(detail.components[1].unit, "newton-meter");
    /// let lugre = Entity::friction_detail("PIN", 3, SurfaceMotion::Turning, true, &units);
    /// assert_eq!(lugre.components.len(), detail.components.len() + 4);
    /// ```
    pub fn friction_detail(
        name: &str,
        id: u32,
        motion: SurfaceMotion,
        bristles: bool,
        units: &UnitNames,
    ) -> Self {
        let load = if motion.slides() {
            units.force.clone()
        } else {
            units.torque()
        };
        let none = String::new();
        let groups: [(&[&str], String); 11] = [
            (&["REGIME"], none.clone()),
            (
                &["LOAD", "LOAD_REACTION", "LOAD_BENDING", "LOAD_TORSION"],
                load.clone(),
            ),
            (
                &["BY_PRELOAD", "BY_REACTION", "BY_BENDING", "BY_TORSION"],
                load.clone(),
            ),
            (&["LIMITED"], none.clone()),
            (&["POWER"], units.power()),
            (&["WORK", "STORED", "DISSIPATED"], units.energy()),
            (&["STICKS"], none),
            (
                &["STICK_START", "STICK_END", "STUCK_TIME"],
                units.time.clone(),
            ),
            (&["LARGEST_CREEP"], units.length.clone()),
            (&["FRICTION"], load),
            (&["VELOCITY"], units.velocity()),
        ];
        let mut components: Vec<Component> = groups
            .into_iter()
            .flat_map(|(names, unit)| {
                names
                    .iter()
                    .map(move |name| Component::new(*name, unit.clone()))
            })
            .collect();
        if bristles {
            let length = || units.length.clone();
            if motion.slides() {
                components.extend(triples([(
                    ["BRISTLE_X", "BRISTLE_Y", "BRISTLE_Z"],
                    length(),
                )]));
            }
            if motion.turns() {
                components.extend(triples([(
                    ["BRISTLE_AX", "BRISTLE_AY", "BRISTLE_AZ"],
                    length(),
                )]));
            }
            let drifts = motion.drifts().iter();
            components.extend(drifts.map(|name| Component::new(*name, length())));
        }
        let detail = Self::of(FRICTION_DETAIL, name, id, components);
        Self {
            name: format!("{name}_DETAIL"),
            ..detail
        }
    }
}
