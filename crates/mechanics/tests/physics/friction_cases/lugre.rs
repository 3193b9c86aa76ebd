//! Bristles in joints (B12, C03; 9.9).

use friction::LuGre;
use friction::parameters::JointType;
use mechanics::Formulation;
use mechanics::expression::{Binary, Input, Operation, Program, Unary};
use mechanics::model::{ForceKind, Law};
use nalgebra::Vector3;
use verification::{Case, Section, check};

use super::lugre;
use crate::oracle::{self, runge_kutta};
use crate::runs::{run, settings, turned};
use crate::shared::{number, reference, table};
use mechanisms::Belt;
use mechanisms::builder::axes_with_z;
use mechanisms::sliding::{Block, place, speed};
use mechanisms::turning::Pendulum;
use mechanisms::{bristles, law};

/// B12a: from rest on three slopes.
#[test]
fn blocks_on_bristles() {
    let Some(file) = reference("validation/data/B12_lugre_joints.json") else {
        return;
    };
    let covers = lugre(JointType::Translational, &[]);
    let mut claims = Vec::new();
    for (slope, id, name) in [
        (15.0, "B12a 15°", "a_15deg"),
        (20.0, "B12a 20°", "a_20deg"),
        (25.0, "B12a 25°", "a_25deg"),
    ] {
        let case = Case {
            section: Section::Joint,
            id,
            model: "2 kg from rest on a slope, bristles s0 1e5, s1 300, vs 1 mm/s, μs 0.4, μd 0.3",
            source: "Runge–Kutta 1e-11",
            covers: &covers,
        };
        let mut block = Block::new(bristles(0.4, 0.3));
        block.slope = slope;
        let settings = settings(Formulation::Si2, 1e-11, 0.01);
        let end = run(block.model(), &[1.0], &settings, |_| {});
        let s = end.snapshot();
        let at = |key: &str| number(&file, &format!("/cases/{name}/{key}"));
        let why = "the error of a step is 1e-11; the reference is good to 1e-11";
        let ours = [place(&s), s.friction(0).deflection.translation.z];
        claims.push(case.values("x, z at 1 s [m]", &ours, &[at("x1"), at("z1")], 1e-9, why));
        claims.push(case.values("v at 1 s [m/s]", &[speed(&s)], &[at("v1")], 1e-10, why));
        let file_name = format!("validation/data/B12a_incline_{slope}deg.csv");
        let Some(rows) = reference_data::path(&file_name).map(table) else {
            continue;
        };
        let times: Vec<f64> = rows[1..].iter().map(|row| row[0]).collect();
        let mut worst = 0.0_f64;
        let mut next = rows[1..].iter();
        run(block.model(), &times, &settings, |s| {
            let row = next.next().expect("a row for every output");
            let z = s.friction(0).deflection.translation.z;
            worst = worst.max((place(s) - row[1]).abs()).max((z - row[3]).abs());
        });
        claims.push(case.worst("x and z at 21 times [m]", worst, 1e-9, why));
    }
    check(&claims);
}

/// B12b: pendulums on a pin with bristles, whose load follows from the motion.
#[test]
fn pendulums_on_bristles() {
    let law = bristles(0.4, 0.3);
    let (length, radius, g, start) = (0.5, 0.05, 9.80665, 1.0);
    let covers = lugre(JointType::Revolute, &["PIN_RADIUS", "INPUTS"]);
    let mut claims = Vec::new();
    for (id, inertia) in [("B12b point", 0.0), ("B12b rod", 1.0 / 12.0)] {
        // θ, θ′, z: the load N follows from θ″, which follows from N: a few fixed-point steps.
        let rate = |s: &[f64; 3]| {
            let [theta, omega, z] = *s;
            let along = length * omega * omega + g * theta.cos();
            let mut alpha = -g / length * theta.sin();
            let mut z_rate = 0.0;
            for _ in 0..30 {
                let across = length * alpha + g * theta.sin();
                let ([rate], [force]) =
                    oracle::bristles(&law, [radius * omega], [z], along.hypot(across));
                let before = alpha;
                z_rate = rate;
                alpha = (radius * force - g * length * theta.sin()) / (length * length + inertia);
                if (alpha - before).abs() < 1e-14 {
                    break;
                }
            }
            [omega, alpha, z_rate]
        };
        let times = [0.4, 1.0, 2.0];
        let exact = times.map(|t| runge_kutta([start, 0.0, 0.0], t, (8e4 * t) as usize, rate));
        let pendulum = Pendulum {
            length,
            pin_radius: radius,
            inertia,
            gravity: g,
            angle: start,
            rate: 0.0,
            law: law.into(),
        };
        let [mut angles, mut deflections] = [const { Vec::new() }; 2];
        let settings = settings(Formulation::Si2, 1e-11, 0.01);
        run(pendulum.model(), &times, &settings, |s| {
            angles.push(start + turned(s, 0));
            deflections.push(s.friction(0).deflection.rotation.z);
        });
        let case = Case {
            section: Section::Joint,
            id,
            model: "1 kg at 0.5 m (a point, or a rod of 1 m) on a pin of 0.05 m, from 1 rad, bristles of B12",
            source: "one equation with T = Rp F(Rp θ′, N), N the reaction of the same instant, Runge–Kutta with 80000 steps a second",
            covers: &covers,
        };
        let why = "a thousand steps of an error of 1e-11; the reference is good to 1e-9";
        claims.push(case.values(
            "θ at 0.4, 1, 2 s [rad]",
            &angles,
            &exact.map(|e| e[0]),
            1e-8,
            why,
        ));
        claims.push(case.values(
            "z there [m]",
            &deflections,
            &exact.map(|e| e[2]),
            1e-11,
            why,
        ));
    }
    check(&claims);
}

/// C03: the belt with bristles.
#[test]
fn belt_on_bristles() {
    let Some(rows) = reference_data::path("validation/data/C03_belt_m1_k20_lugre.csv").map(table)
    else {
        return;
    };
    let law = LuGre {
        damping: 1e5_f64.sqrt(),
        ..bristles(0.15, 0.10)
    };
    let belt = Belt {
        mass: 1.0,
        gravity: 9.81,
        stiffness: 20.0,
        speed: 0.1,
        start: 0.0,
    };
    let times: Vec<f64> = rows[1..].iter().map(|row| row[0]).collect();
    let [mut x, mut z, mut f] = [0.0_f64; 3];
    let mut next = rows[1..].iter();
    run(
        belt.model(law),
        &times,
        &settings(Formulation::Si2, 1e-11, 0.01),
        |s| {
            let row = next.next().expect("a row for every output");
            // The reference counts the velocity of the belt against the block.
            let friction = s.friction(0);
            x = x.max((place(s) - row[1]).abs());
            z = z.max((friction.deflection.translation.z + row[3]).abs());
            f = f.max((friction.force.z - row[4]).abs());
        },
    );
    let case = Case {
        section: Section::Mechanism,
        id: "C03 bristles",
        model: "1 kg on a belt of 0.1 m/s, spring 20 N/m, bristles s0 1e5, s1 √1e5, vs 1 mm/s, μs 0.15, μd 0.1",
        source: "Runge–Kutta, agreeing with Radau to 5e-12",
        covers: &lugre(JointType::Translational, &[]),
    };
    let why = "three cycles of stick and slip with an error of 1e-11 a step";
    check(&[
        case.worst("x at 50 times to 5 s [m]", x, 5e-8, why),
        case.worst("z there [m]", z, 5e-11, why),
        case.worst("friction there [N]", f, 2e-6, "the same through s0, s1"),
    ]);
}

/// 9.9: a load that comes and goes below the limit makes bristles drift, and creep not.
#[test]
fn cycled_blocks() {
    let (limit, part, period) = (1.5, 0.95, 100.0);
    let places = |law: Law| {
        let mut block = Block::new(law);
        (block.mass, block.gravity, block.slope) = (1.0, 10.0, 0.0);
        let mut b = block.builder();
        let axes = axes_with_z(Vector3::x());
        let [i, j] = [Some(0), None].map(|on| b.marker(on, Vector3::zeros(), axes));
        // From zero to the part of the limit and back: (1 − cos)/2.
        let mut force = Program::default();
        let time = force.push(Operation::Input(Input::Time));
        let rate = force.push(Operation::Constant(std::f64::consts::TAU / period));
        let angle = force.push(Operation::Binary(Binary::Multiply, rate, time));
        let cosine = force.push(Operation::Unary(Unary::Cos, angle));
        let one = force.push(Operation::Constant(1.0));
        let rising = force.push(Operation::Binary(Binary::Subtract, one, cosine));
        let size = force.push(Operation::Constant(0.5 * part * limit));
        force.push(Operation::Binary(Binary::Multiply, size, rising));
        b.force(ForceKind::AlongZ, i, j, force);
        let mut places = Vec::new();
        let settings = settings(Formulation::Si2, 1e-10, 1.0);
        run(
            b.model,
            &[1.0, 2.0, 3.0, 4.0].map(|k| k * period),
            &settings,
            |s| {
                places.push(place(s));
            },
        );
        places
    };
    let soft = LuGre {
        damping: 1e5_f64.sqrt(),
        viscous: 0.4,
        ..bristles(0.15, 0.10)
    };
    let (drifting, held) = (
        places(soft.into()),
        places(law(0.15, 0.10, 1e-3, 1.5e-5).into()),
    );
    let exact = -(limit / 1e5) * (1.0_f64 - part * part).ln();
    let drifts: Vec<f64> = drifting.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let case = Case {
        section: Section::Joint,
        id: "9.9 joint",
        model: "1 kg under 10 N, loaded to 0.95 of its limit and back in 100 s, four times; s0 1e5, s1 √1e5, s2 0.4",
        source: "quasi-static closed form −(Fs/s0) ln(1 − a²) a cycle",
        covers: &lugre(JointType::Translational, &["VISCOUS_FRICTION_COEFFICIENT"]),
    };
    let slow = "one percent: the rate of the load, 0.03 N/s, is not zero";
    let original = "creep goes back to where it began; the rest of the motion";
    check(&[
        case.values(
            "drift a cycle, LUGRE [m]",
            &drifts,
            &[exact; 3],
            3.5e-7,
            slow,
        ),
        case.values(
            "place after each cycle, ORIGINAL [m]",
            &held,
            &[0.0; 4],
            1e-9,
            original,
        ),
    ]);
}

/// A pendulum of 0.5 m on a pin of 0.05 m swings out on stiff bristles. Where they slide the formulas of
/// Adams would take 8 to 18 times the steps of backward differentiation, which goes on in their place.
/// Without friction it does not.
#[test]
fn stiff_bristles_do_not_keep_adams_at_short_steps() {
    let stiff = LuGre {
        bristle_stiffness: 1e7,
        ..bristles(0.4, 0.3)
    };
    let pendulum = Pendulum {
        length: 0.5,
        pin_radius: 0.05,
        inertia: 1.0 / 12.0,
        gravity: 9.80665,
        angle: 1.0,
        rate: 0.0,
        law: stiff.into(),
    };
    let model = pendulum.model();
    let swing = |model: &mechanics::model::Model, formulation, error| {
        let mut angle = 0.0;
        let settings = mechanics::Settings {
            highest_order: 12,
            ..settings(formulation, error, 0.04)
        };
        let end = run(model.clone(), &[2.0], &settings, |s| angle = turned(s, 0));
        (angle, end.statistics())
    };
    let (exact, _) = swing(&model, Formulation::Si2, 1e-11);
    for error in [1e-6, 1e-7, 1e-8] {
        let (_, si2) = swing(&model, Formulation::Si2, error);
        let (angle, adams) = swing(&model, Formulation::Adams, error);
        let [most, steps] = [si2.steps.steps, adams.steps.steps];
        println!("{error:e}: {steps} steps, SI2 {most}");
        assert!(steps < 2 * most && adams.stiff_from.is_some());
        // Some hundred steps of a tenth of ERROR.
        assert!((angle - exact).abs() < 60.0 * error, "{error:e}");
    }
    let mut free = model;
    free.frictions.clear();
    let (_, smooth) = swing(&free, Formulation::Adams, 1e-8);
    assert_eq!(smooth.stiff_from, None);
}
