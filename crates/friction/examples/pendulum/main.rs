//! Friction in a hand-written simulator: a pendulum on a pin swings until it sticks.
//!
//! `cargo run -p friction --example pendulum` prints angle, friction torque and energy over time. Give
//! `lugre` as argument for the other formulation. The loop is in `pendulum.rs` beside this file.
#![allow(clippy::print_stdout, reason = "the example prints its results")]

mod pendulum;

use friction::Law;
use friction::explicit::RevoluteStepper;
use friction::{Effect, Inputs, LuGre, Original, RevoluteLoad};
use pendulum::Pendulum;

fn main() {
    let law = if std::env::args().any(|argument| argument == "lugre") {
        Law::LuGre(LuGre {
            mu_static: 0.4,
            mu_dynamic: 0.3,
            bristle_stiffness: 1e5,
            damping: 100.0,
            viscous: 0.0,
            stribeck_velocity: 1e-3,
            stribeck_exponent: 2.0,
        })
    } else {
        Law::Original(Original {
            mu_static: 0.4,
            mu_dynamic: 0.3,
            // Well below the speed of the surfaces, which is some centimetres per second.
            transition_velocity: 1e-3,
            transition_coefficient: 1.5,
            // The joint holds with a creep of this size, here a tenth of a millimetre.
            max_deformation: 1e-4,
            effect: Effect::All,
        })
    };
    let pin = RevoluteLoad {
        inputs: Inputs::ALL,
        pin_radius: 0.05,
        friction_arm: 0.05,
        bending_reaction_arm: 1.0,
    };
    let mut pendulum = Pendulum {
        mass: 1.0,
        length: 1.0,
        angle: 60f64.to_radians(),
        rate: 0.0,
        friction: RevoluteStepper::new(law, pin),
        torque: 0.0,
        dissipated: 0.0,
    };
    let start = pendulum.energy();
    let (dt, steps_of_a_row) = (1e-4, 5000);
    println!("  time    angle   torque   energy  dissipated  residual");
    println!("     s      deg      N m        J           J         J");
    for row in 0..=60 {
        println!(
            "{:6.1} {:8.3} {:8.4} {:8.4} {:11.4} {:9.1e}",
            f64::from(row) * f64::from(steps_of_a_row) * dt,
            pendulum.angle.to_degrees(),
            pendulum.torque,
            pendulum.energy(),
            pendulum.dissipated,
            // What the step of first order makes of the balance, and what creep or bristles store.
            pendulum.energy() + pendulum.dissipated - start,
        );
        for _ in 0..steps_of_a_row {
            pendulum.step(dt);
        }
    }
}
