//! The mechanisms of the table, and friction in their joints.

use friction::{Inputs, LuGre, Original};
use mechanics::Simulation;
use mechanics::model::{ForceAndTorque, Friction, FrictionJoint, JointKind, Label, Law, Model};
use mechanisms::builder::v;
use mechanisms::turning::{Pendulum, ball_pendulum, rotor, unbalanced_rotor};
use nalgebra::Vector3;
use stiction::Project;

/// A mechanism of the table.
pub(super) struct Entry {
    /// Its name, with that of the validation case.
    pub(super) name: &'static str,
    /// End of its run.
    pub(super) end: f64,
    /// Makes it, where what it is made from is there.
    pub(super) make: fn() -> Option<Model>,
}

/// All of them.
pub(super) const ALL: [Entry; 23] = [
    entry("pendulum (A01)", 5.0, || Some(mechanisms::pendulum())),
    entry("pendulum on a pin (B04)", 3.0, || Some(swinging().model())),
    entry("ball pendulum (B08)", 3.0, || {
        Some(ball_pendulum(
            std::f64::consts::FRAC_PI_3,
            v(0.5, 2.0, 8.0),
            None,
        ))
    }),
    entry("top (D08c)", 1.0, || Some(mechanisms::top())),
    entry("free body, Dzhanibekov (D08b)", 20.0, || {
        Some(mechanisms::free_body([1.0, 2.0, 3.0], v(0.01, 2.0, 0.02)))
    }),
    entry("rotor (B05a)", 3.0, || {
        Some(rotor(9.80665, 0.01, 0.01, 0.03, 50.0, original(1.0)))
    }),
    entry("rotor with a mass aside (B05)", 0.5, || {
        Some(unbalanced_rotor(0.1, original(1.0)))
    }),
    entry("sleeve (B07)", 0.5, || {
        let sleeve = mechanisms::Sleeve {
            weight: 2.0 * 9.80665,
            inertia: 0.0016,
            pin_radius: 0.04,
            start: [0.6, 20.0],
        };
        Some(sleeve.model(original(1.0)))
    }),
    entry("block drawn by a spring (A08)", 25.0, || {
        Some(mechanisms::drawn_block(original(1.0)))
    }),
    entry("block on a belt (C03)", 5.0, || {
        let belt = mechanisms::Belt {
            mass: 1.0,
            gravity: 9.81,
            stiffness: 20.0,
            speed: 0.1,
            start: 0.1,
        };
        Some(belt.model(original(1.0)))
    }),
    entry("slider-crank (C01)", 2.0, || {
        Some(mechanisms::slider_crank(None))
    }),
    entry("driven slider-crank (C01d)", 0.5, || {
        Some(mechanisms::driven_slider_crank(None))
    }),
    entry("four-bar (C02)", 2.0, || Some(mechanisms::four_bar(None))),
    entry("shafts with a cross (B09)", 1.0, || {
        Some(mechanisms::shafts(mechanisms::Cross::Hooke, [None; 2]))
    }),
    entry("spatial four-bar (C06)", 50.0, || {
        Some(mechanisms::rssr(0.0, 1f64.to_radians()).model)
    }),
    entry("Andrews' mechanism (D01)", 0.05, || {
        Some(mechanisms::andrews().model)
    }),
    entry("two four-bars (D06)", 10.0, || {
        Some(mechanisms::four_bar_chain(2))
    }),
    entry("Bricard's mechanism (D07)", 10.0, || {
        Some(mechanisms::bricard())
    }),
    entry("governor", 2.0, || Some(mechanisms::governor())),
    entry("chain of 10 rods", 1.0, || {
        Some(mechanisms::chains::chain(10).model)
    }),
    entry("spherical joint (D09)", 5.0, || {
        adams("single-joint/Spherical_Case01.adm")
    }),
    entry("universal joint (D09)", 5.0, || {
        adams("single-joint/Universal_Case01.adm")
    }),
    entry("delta robot", 0.8, || {
        let root = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../examples/delta-robot/delta.adm"
        );
        load(std::path::Path::new(root))
    }),
];

const fn entry(name: &'static str, end: f64, make: fn() -> Option<Model>) -> Entry {
    Entry { name, end, make }
}

fn swinging() -> Pendulum {
    Pendulum {
        length: 0.5,
        pin_radius: 0.05,
        inertia: 1.0 / 12.0,
        gravity: 9.80665,
        angle: std::f64::consts::FRAC_PI_3,
        rate: 0.0,
        law: original(1.0).into(),
    }
}

fn adams(file: &str) -> Option<Model> {
    load(&reference_data::path(&format!("adams-results/{file}"))?)
}

fn load(path: &std::path::Path) -> Option<Model> {
    let simulation = Project::load(path).ok()?.simulation().ok()?;
    Some(simulation.model().clone())
}

/// The friction of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Choice {
    Off,
    Original,
    LuGre,
}

impl Choice {
    pub(super) const ALL: [Self; 3] = [Self::Off, Self::Original, Self::LuGre];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::Original => "ORIGINAL",
            Self::LuGre => "LUGRE",
        }
    }
}

/// Coefficients 0.25 and 0.2, and displacements and velocities small beside a length.
fn original(length: f64) -> Original {
    mechanisms::law(0.25, 0.2, 1e-2 * length, 1e-4 * length)
}

/// The same coefficients; bristles that yield under a force by 1e-4 of a length.
fn lugre(length: f64, force: f64) -> LuGre {
    LuGre {
        bristle_stiffness: 1e4 * force / length,
        damping: 20.0 * force / length,
        stribeck_velocity: 1e-2 * length,
        ..mechanisms::bristles(0.25, 0.2)
    }
}

/// The mechanism with this friction in all joints that can have it, on pins of a twentieth of its
/// length; none where no joint can.
pub(super) fn with_friction(mut model: Model, choice: Choice) -> Option<Model> {
    model.frictions.clear();
    if choice == Choice::Off {
        return Some(model);
    }
    let length = Simulation::new(model.clone(), 1.0).system().length_scale();
    let mass: f64 = model.bodies.iter().map(|body| body.mass).sum();
    let gravity = model.gravity.norm();
    let force = mass * if gravity > 0.0 { gravity } else { length };
    let law: Law = match choice {
        Choice::LuGre => lugre(length, force).into(),
        _ => original(length).into(),
    };
    for joint in 0..model.joints.len() {
        let Some(load) = load_of(model.joints[joint].kind, length) else {
            continue;
        };
        model.frictions.push(Friction {
            label: Label {
                statement: "FRICTION",
                id: joint as u32 + 1,
                name: String::new(),
            },
            joint,
            law,
            load,
            preload: ForceAndTorque::both(0.0),
            maximum: ForceAndTorque::both(1e40),
            inactive_static: false,
        });
    }
    (!model.frictions.is_empty()).then_some(model)
}

fn load_of(kind: JointKind, length: f64) -> Option<FrictionJoint> {
    let inputs = Inputs {
        bending_moment: false,
        torsional_moment: false,
        ..Inputs::ALL
    };
    mechanisms::joint_load(kind, inputs, length, 0.05 * length, 0.05 * length)
}

/// Weights, velocities, the inertia of all bodies about their x axes and the mass of every second one
/// larger by a part `part`.
pub(super) fn disturbed(mut model: Model, part: f64) -> Model {
    let more = 1.0 + part;
    model.gravity *= more;
    let scale = |v: &mut Vector3<f64>| *v *= more;
    for (place, body) in model.bodies.iter_mut().enumerate() {
        scale(&mut body.velocity);
        scale(&mut body.angular_velocity);
        body.inertia[(0, 0)] *= more;
        if place % 2 == 0 {
            body.mass *= more;
        }
    }
    for joint in &mut model.joints {
        for start in [&mut joint.translation_start, &mut joint.rotation_start] {
            start.velocity = start.velocity.map(|velocity| more * velocity);
        }
    }
    model
}
