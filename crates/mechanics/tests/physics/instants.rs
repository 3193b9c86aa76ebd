//! Single instants against formulas by hand: accelerations, reactions and friction together.

use mechanics::expression::Program;
use mechanics::model::{ForceKind, FrictionJoint, JointKind};
use mechanics::{Owner, Simulation};
use nalgebra::Vector3;

use crate::builder::{Builder, axes_with_z, v};
use crate::runs::assembled;
use crate::shared::{number, reference};
use crate::systems::law;
use crate::systems::sliding::Block;
use crate::systems::turning::Pendulum;

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
    println!(
        "\nB04 b, single instants: errors of acceleration, torque, radial, tangential reaction"
    );
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
            law: law(0.4, 0.3, 1e-9, 1e-9),
        };
        let simulation = assembled(pendulum.model());
        let (radial, tangential) = radial_and_tangential(&simulation, pendulum.angle);
        let torque = simulation.snapshot().friction(0).force[0];
        let errors = [
            acceleration(&simulation) - given("alpha"),
            torque.abs() - given("T"),
            radial - given("N_radial"),
            tangential - given("N_tangential"),
        ];
        println!(
            "theta {:>5.2} omega {rate:>8.1e}: {}",
            pendulum.angle,
            errors.map(|e| format!("{e:>9.1e}")).join(" ")
        );
        assert!(torque * rate < 0.0, "friction brakes");
        // Rounding of numbers of ten; the rate of 1e-6 changes the reaction by its square.
        assert!(errors.iter().all(|e| e.abs() < 1e-10), "{n}: {errors:?}");
    }
}

#[test]
fn point_mass_on_a_pin_meets_the_closed_form() {
    // T = μ Rp |F| with F itself depending on T through the acceleration: with m = L = 1 and
    // κ = a/√(1−a²), a = μ Rp/L, θ'' = −g sin θ − κ s (θ'² + g cos θ).
    let (mu, radius, g) = (0.3, 0.05, 9.81);
    for (angle, rate) in [(0.3, 2.0), (-1.0, -0.5), (1.2, 4.0), (2.5, 7.0)] {
        let pendulum = Pendulum {
            length: 1.0,
            pin_radius: radius,
            inertia: 0.0,
            gravity: g,
            angle,
            rate,
            law: law(mu, mu, 1e-4, 1e-6),
        };
        let simulation = assembled(pendulum.model());
        let a: f64 = mu * radius;
        let kappa = a / (1.0 - a * a).sqrt();
        let load: f64 = rate * rate + g * angle.cos();
        let exact = -g * angle.sin() - kappa * rate.signum() * load.abs();
        let error = acceleration(&simulation) - exact;
        let (radial, tangential) = radial_and_tangential(&simulation, angle);
        // Rounding of numbers of fifty.
        assert!(error.abs() < 1e-12, "{angle} {rate}: {error:e}");
        assert!((radial - load).abs() < 1e-12);
        assert!((tangential + kappa * rate.signum() * load.abs()).abs() < 1e-12);
    }
}

/// A block of 2 kg whose centre is `height` above its guide (friction 0.2, overlap 0.1 m), sliding
/// at 1 m/s.
fn high_block(height: f64, gravity: f64, push: f64) -> Simulation {
    let law = law(0.2, 0.2, 1e-4, 1e-6);
    let mut load = Block::new(law).load;
    load.initial_overlap = 0.1;
    let mut b = Builder::new(v(0.0, -gravity, 0.0));
    let block = b.body(2.0, [0.1; 3], v(0.0, height, 0.0));
    let x = Vector3::x();
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
    let mut simulation = Simulation::new(b.model, 1.0);
    simulation.assemble().expect("it assembles");
    simulation
}

#[test]
fn bending_of_a_guide_feeds_back_into_its_friction() {
    // The inertia force at the centre bends the guide by m |a| h, which adds μ m |a| h/Xs.
    let acceleration = |mut simulation: Simulation| {
        simulation.solve_instant().expect("the gain is below one");
        simulation.snapshot().part_acceleration(0).linear.x
    };
    // Braking energises itself: |a| = μ g / (1 − μ h/Xs).
    let braking = acceleration(high_block(0.3, 9.80665, 0.0));
    assert!((braking + 0.2 * 9.80665 / 0.4).abs() < 1e-12, "{braking}");
    // Driven by P in the guide, without weight: a = P / (m (1 + μ h/Xs)).
    let driven = acceleration(high_block(0.3, 0.0, 5.0));
    assert!((driven - 5.0 / (2.0 * 1.6)).abs() < 1e-12, "{driven}");
    // A gain over one has no solution: an error, not numbers.
    let error = high_block(0.6, 9.80665, 0.0).solve_instant();
    println!("{}", error.expect_err("it jams"));
}
