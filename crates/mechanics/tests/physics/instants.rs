//! Single instants against formulas by hand: accelerations, reactions and friction together.

use friction::parameters::JointType;
use mechanics::expression::Program;
use mechanics::model::{ForceKind, FrictionJoint, JointKind};
use mechanics::{Owner, Simulation};
use nalgebra::Vector3;
use verification::{Case, Coverage, Section, check};

use crate::oracle::{psi, root};
use crate::runs::{assembled, run, settings};
use crate::shared::{number, reference};
use mechanisms::builder::{Builder, axes_with_z, v};
use mechanisms::law;
use mechanisms::sliding::Block;
use mechanisms::turning::Pendulum;

/// Angular acceleration about z.
fn acceleration(simulation: &Simulation) -> f64 {
    simulation.snapshot().part_acceleration(0).angular.z
}

/// Reaction on the body away from its centre along the arm, and across towards larger angles.
fn radial_and_tangential(simulation: &Simulation, angle: f64) -> (f64, f64) {
    let force = simulation.snapshot().reaction(Owner::Joint(0)).force;
    let to_pin = Vector3::new(-angle.sin(), angle.cos(), 0.0);
    let onwards = Vector3::new(angle.cos(), angle.sin(), 0.0);
    (force.dot(&to_pin), force.dot(&onwards))
}

#[test]
fn rod_on_a_pin_with_friction_meets_the_reference() {
    let Some(file) = reference("validation/data/B04_pendulum.json") else {
        return;
    };
    let table = "/cases/b_uniform_rod/instantaneous";
    let case = Case {
        section: Section::Joint,
        id: "B04b instants",
        model: "rod of 1 kg and 1 m on a pin of 0.05 m, μs 0.4, μd 0.3: five states",
        source: "equation of motion with the friction of the same reaction, 1e-13",
        covers: &[Coverage {
            joint: JointType::Revolute,
            formulation: verification::Formulation::Original,
            arguments: &["PIN_RADIUS", "MU_DYNAMIC", "INPUTS"],
        }],
    };
    let mut claims = Vec::new();
    for n in 0..5 {
        let given = |key: &str| number(&file, &format!("{table}/{n}/{key}"));
        // At rest the direction is that of the motion about to begin: slow, yet sliding.
        let rate = if given("omega") == 0.0 {
            1e-6 * given("dir")
        } else {
            given("omega")
        };
        let pendulum = Pendulum {
            length: 0.5,
            pin_radius: 0.05,
            inertia: 1.0 / 12.0,
            gravity: 9.80665,
            angle: given("theta"),
            rate,
            law: law(0.4, 0.3, 1e-9, 1e-9).into(),
        };
        let simulation = assembled(pendulum.model());
        let (radial, tangential) = radial_and_tangential(&simulation, pendulum.angle);
        let torque = simulation.snapshot().friction(0).torque.z;
        assert!(torque * rate < 0.0, "friction brakes");
        claims.push(case.values(
            &format!("θ″, T, N radial, N tangential of state {}", n + 1),
            &[acceleration(&simulation), torque.abs(), radial, tangential],
            &["alpha", "T", "N_radial", "N_tangential"].map(given),
            1e-10,
            "rounding of numbers of ten; a rate of 1e-6 for one of zero",
        ));
    }
    check(&claims);
}

#[test]
fn point_mass_on_a_pin_meets_the_closed_form() {
    // T = μ Rp |F| with F itself depending on T through the acceleration: with m = L = 1 and
    // κ = a/√(1−a²), a = μ Rp/L, θ'' = −g sin θ − κ s (θ'² + g cos θ).
    let (mu, radius, g) = (0.3, 0.05, 9.81);
    let (mut ours, mut closed) = (Vec::new(), Vec::new());
    for (angle, rate) in [(0.3, 2.0), (-1.0, -0.5), (1.2, 4.0), (2.5, 7.0)] {
        let pendulum = Pendulum {
            length: 1.0,
            pin_radius: radius,
            inertia: 0.0,
            gravity: g,
            angle,
            rate,
            law: law(mu, mu, 1e-4, 1e-6).into(),
        };
        let simulation = assembled(pendulum.model());
        let a: f64 = mu * radius;
        let kappa = a / (1.0 - a * a).sqrt();
        let load: f64 = rate * rate + g * angle.cos();
        let across = -kappa * rate.signum() * load.abs();
        let (radial, tangential) = radial_and_tangential(&simulation, angle);
        ours.extend([acceleration(&simulation), radial, tangential]);
        closed.extend([-g * angle.sin() + across, load, across]);
    }
    let case = Case {
        section: Section::Joint,
        id: "9.11 instants",
        model: "a point of 1 kg at 1 m on a pin of 0.05 m, μ 0.3: four states",
        source: "closed form, specification 9.11",
        covers: &[Coverage {
            joint: JointType::Revolute,
            formulation: verification::Formulation::Original,
            arguments: &["PIN_RADIUS", "MU_DYNAMIC"],
        }],
    };
    check(&[case.values(
        "θ″, N radial, N tangential",
        &ours,
        &closed,
        1e-12,
        "rounding of numbers of fifty",
    )]);
}

/// Blocks of 2 kg whose centres are at `heights` above their guides (friction 0.2, overlap 0.1 m),
/// sliding at 1 m/s.
fn high_blocks(heights: &[f64], gravity: f64, push: f64) -> Simulation {
    let law = law(0.2, 0.2, 1e-4, 1e-6);
    let mut load = Block::new(law).load;
    load.initial_overlap = 0.1;
    let mut b = Builder::new(v(0.0, -gravity, 0.0));
    let x = Vector3::x();
    for &height in heights {
        let block = b.body(2.0, [0.1; 3], v(0.0, height, 0.0));
        let joint = b.joint(
            JointKind::Translational,
            Some(block),
            None,
            v(0.0, 0.0, 0.0),
            x,
        );
        b.friction(joint, law, FrictionJoint::Translational(load));
        b.model.bodies[block].velocity = x;
        b.model.bodies[block].given_velocity = [true; 6];
        let markers = [Some(block), None].map(|on| b.marker(on, Vector3::zeros(), axes_with_z(x)));
        b.force(
            ForceKind::AlongZ,
            markers[0],
            markers[1],
            Program::constant(push),
        );
    }
    let mut simulation = Simulation::new(b.model, 1.0);
    simulation.assemble().expect("it assembles");
    simulation
}

fn high_block(height: f64, gravity: f64, push: f64) -> Simulation {
    high_blocks(&[height], gravity, push)
}

/// Of many frictions the largest gain is estimated: the one that jams is found among a hundred.
#[test]
fn one_of_many_frictions_jams() {
    let mut heights: Vec<f64> = (0..100)
        .map(|k| 0.05 + 0.35 * f64::from(k) / 99.0)
        .collect();
    high_blocks(&heights, 9.80665, 0.0)
        .solve_instant()
        .expect("all gains are 0.8 or less");
    heights[37] = 0.55;
    let error = high_blocks(&heights, 9.80665, 0.0)
        .solve_instant()
        .expect_err("gain 1.1");
    let message = error.to_string();
    assert!(
        message.contains("FRICTION/38 jams") && message.contains("adds 1.100 times"),
        "{message}"
    );
}

#[test]
fn bending_of_a_guide_feeds_back_into_its_friction() {
    let acceleration = |mut simulation: Simulation| {
        simulation.solve_instant().expect("the gain is below one");
        simulation.snapshot().part_acceleration(0).linear.x
    };
    let case = Case {
        section: Section::Mechanism,
        id: "C04a",
        model: "2 kg with its centre 0.3 m above a guide of overlap 0.1 m, μ 0.2, sliding at 1 m/s",
        source: "closed form: |a| = μ g/(1 − μ h/Xs) braking, a = P/(m (1 + μ h/Xs)) driven",
        covers: &[Coverage {
            joint: JointType::Translational,
            formulation: verification::Formulation::Original,
            arguments: &["INITIAL_OVERLAP", "BENDING_FACTOR", "INPUTS"],
        }],
    };
    let braking = acceleration(high_block(0.3, 9.80665, 0.0));
    let driven = acceleration(high_block(0.3, 0.0, 5.0));
    let rounding = "rounding";
    check(&[
        case.values(
            "braking itself harder [m/s²]",
            &[braking],
            &[-4.903_325],
            1e-12,
            rounding,
        ),
        case.values(
            "driven by 5 N without weight [m/s²]",
            &[driven],
            &[1.5625],
            1e-12,
            rounding,
        ),
    ]);
    // A gain of one and more has no solution: an error that names friction and gain, not numbers.
    let mut gains = Vec::new();
    for height in [0.5, 0.6, 1.0] {
        let error = high_block(height, 9.80665, 0.0)
            .solve_instant()
            .expect_err("it jams");
        let message = error.to_string();
        assert!(message.contains("FRICTION/1"), "{message}");
        let words = message
            .split("adds ")
            .nth(1)
            .and_then(|rest| rest.split(' ').next());
        gains.push(
            words
                .and_then(|word| word.parse().ok())
                .expect("the gain is said"),
        );
    }
    let case = Case {
        id: "C04a jams",
        model: "the same with its centre 0.5, 0.6, 1 m above: it jams, which is reported",
        source: "gain μ h/Xs",
        ..case
    };
    check(&[case.values(
        "gain in the message",
        &gains,
        &[1.0, 1.2, 2.0],
        6e-4,
        "three decimals",
    )]);
}

#[test]
fn push_off_the_axis_slides_or_sticks_whatever_its_size() {
    // A push P at the height h presses the guide with P h/Xs: no weight, no other load.
    let pushed = |height: f64, push: f64, speed: f64| {
        let mut block = Block::new(law(0.2, 0.2, 1e-4, 1e-6));
        (block.gravity, block.slope, block.velocity) = (0.0, 0.0, speed);
        (block.load.initial_overlap, block.bending) = (0.1, push * height);
        let mut b = block.builder();
        let axes = axes_with_z(Vector3::x());
        let [i, j] = [Some(0), None].map(|on| b.marker(on, Vector3::zeros(), axes));
        b.force(ForceKind::AlongZ, i, j, Program::constant(push));
        b.model
    };
    let sliding = assembled(pushed(0.3, 5.0, 1.0));
    let acceleration = sliding.snapshot().part_acceleration(0).linear.x;
    // Below the limit it creeps to where μ ψ(d/Dm) h/Xs = 1, for any push.
    let creep = root(0.0, 1e-6, |d| 1.0 / 1.2 - psi(d / 1e-6));
    let mut ours = Vec::new();
    for push in [5.0, 500.0] {
        let settings = settings(mechanics::Formulation::Si2, 1e-12, 0.1);
        let end = run(pushed(0.6, push, 0.0), &[5.0], &settings, |_| {});
        ours.push(end.state().centre(0).x);
    }
    let case = Case {
        section: Section::Mechanism,
        id: "C04a push",
        model: "2 kg pushed at 0.3 and 0.6 m from the axis of a guide of overlap 0.1 m, μ 0.2, without weight",
        source: "closed form: slides with (P − μ P h/Xs)/m below μ h/Xs = 1, sticks from there on",
        covers: &[Coverage {
            joint: JointType::Translational,
            formulation: verification::Formulation::Original,
            arguments: &["INITIAL_OVERLAP", "BENDING_FACTOR", "INPUTS"],
        }],
    };
    check(&[
        case.values(
            "acceleration at 0.3 m, 5 N [m/s²]",
            &[acceleration],
            &[1.0],
            1e-12,
            "rounding",
        ),
        case.values(
            "x at 0.6 m after 5 s, 5 and 500 N [m]",
            &ours,
            &[creep; 2],
            1e-9,
            "the creep that holds; the error of the integrator",
        ),
    ]);
}

/// What is saved of one model is no state of another; the simulation stays as it is then.
#[test]
fn a_saved_state_fits_its_own_model_only() {
    let model = |bodies: usize| {
        let mut model = Builder::new(v(0.0, 0.0, -10.0));
        for _ in 0..bodies {
            model.body(1.0, [1.0; 3], v(0.0, 0.0, 0.0));
        }
        model.model
    };
    let saved = assembled(model(1)).save();
    let mut other = assembled(model(2));
    let before = other.save();
    assert_eq!(
        other.restore(model(2), &saved),
        Err(mechanics::ForeignState)
    );
    assert_eq!(other.save(), before);
    assert_eq!(other.restore(model(1), &saved), Ok(()));
    assert_eq!(other.save(), saved);
}
