//! Equilibrium held by friction (9.17).

use friction::parameters::JointType;
use mechanics::rotation::log;
use mechanics::{EquilibriumSettings, Formulation, Owner, Simulation};
use verification::{Case, Coverage, Section, check};

use super::original;
use crate::oracle::psi;
use crate::runs::{go_on, settings};

use mechanisms::sliding::{Block, place};
use mechanisms::{Cross, bristles, law, shafts};

const TIGHT: EquilibriumSettings = EquilibriumSettings {
    error: 1e-12,
    imbalance: 1e-10,
    stability: 1e-5,
    iterations: 50,
    angle_limit: 0.17,
    translation_limit: 1.0,
};

/// A block on a slope, assembled: `μ_s` 0.3, default Vs and Dm, g = 9.81 m/s².
fn block(slope: f64, law: impl Into<mechanics::model::Law>, inactive: bool) -> Simulation {
    let mut block = Block::new(law);
    (block.gravity, block.slope) = (9.81, slope);
    let mut model = block.model();
    model.frictions[0].inactive_static = inactive;
    let mut simulation = Simulation::new(model, 1.0);
    simulation.assemble().expect("it assembles");
    simulation
}

#[test]
fn friction_holds_on_slopes() {
    let covers = original(JointType::Translational, &["INPUTS", "INACTIVE", "EFFECT"]);
    let case = Case {
        section: Section::Statics,
        id: "9.17",
        model: "a block on a slope, μs 0.3, Dm 0.01, by static equilibrium",
        source: "specification 9.4: μs ψ(d/Dm) = tan α",
        covers: &covers,
    };
    let slopes = [5.0, 10.0, 15.0, 16.5];
    let exact = [
        1.581_527_9e-3,
        3.384_218_7e-3,
        6.119_933_7e-3,
        8.203_029_8e-3,
    ];
    let [mut creep, mut excess, mut moved] = [const { Vec::new() }; 3];
    for slope in slopes {
        let mut simulation = block(slope, law(0.3, 0.2, 0.1, 0.01), false);
        simulation
            .find_equilibrium(0.0, &TIGHT)
            .expect("friction holds");
        let s = simulation.snapshot();
        let d = s.friction(0).creep.translation.z;
        creep.push(d);
        excess.push((0.3 * psi(d / 0.01) - slope.to_radians().tan()).abs());
        assert!((place(&s) - d).abs() < 1e-12, "it moved by its creep");
        // The creep goes on into dynamics: nothing moves there.
        let before = place(&s);
        let mut drift = 0.0_f64;
        go_on(
            &mut simulation,
            &[1.0, 10.0],
            &settings(Formulation::Si2, 1e-9, 1.0),
            |s| drift = drift.max((place(s) - before).abs()),
        );
        moved.push(drift);
    }
    let largest = |errors: &[f64]| errors.iter().copied().fold(0.0, f64::max);
    check(&[
        case.values(
            "creep at 5, 10, 15, 16.5° [m]",
            &creep,
            &exact,
            1e-10,
            "eight digits are given",
        ),
        case.worst(
            "μs ψ(d/Dm) − tan α",
            largest(&excess),
            1e-11,
            "the imbalance allowed, 1e-10 N of 19 N",
        ),
        case.worst(
            "motion in 10 s of dynamics that follow [m]",
            largest(&moved),
            1e-10,
            "the creep is carried over; the error of the equilibrium",
        ),
    ]);
}

#[test]
fn friction_that_cannot_hold_is_named() {
    // Above atan 0.3 = 16.7° there is no equilibrium.
    let steep = block(17.0, law(0.3, 0.2, 0.1, 0.01), false)
        .find_equilibrium(0.0, &TIGHT)
        .expect_err("nothing holds");
    assert!(steep.to_string().contains("FRICTION/1"), "{steep}");
    // INACTIVE=STATIC: no friction, no equilibrium; dynamics from there sticks.
    let mut simulation = block(10.0, law(0.3, 0.2, 0.1, 0.01), true);
    simulation
        .find_equilibrium(0.0, &TIGHT)
        .expect_err("friction is left out of statics");
    let mut end = 0.0;
    let times = [50.0, 100.0];
    go_on(
        &mut simulation,
        &times,
        &settings(Formulation::Si2, 1e-9, 10.0),
        |s| end = place(s),
    );
    let case = Case {
        section: Section::Statics,
        id: "9.17 INACTIVE",
        model: "the block on 10° with INACTIVE=STATIC: no equilibrium is found; dynamics from there",
        source: "specification 9.4, equilibrium creep",
        covers: &[Coverage {
            joint: JointType::Translational,
            formulation: verification::Formulation::Original,
            arguments: &["INACTIVE"],
        }],
    };
    let digits = "eight digits are given";
    check(&[case.values("x(100) [m]", &[end], &[3.384_218_7e-3], 1e-9, digits)]);
}

#[test]
fn bristles_keep_their_deflection_in_statics() {
    let mut simulation = block(10.0, bristles(0.4, 0.3), false);
    let settings = settings(Formulation::Si2, 1e-10, 0.1);
    go_on(&mut simulation, &[5.0], &settings, |_| {});
    let before = simulation.snapshot().friction(0).deflection.translation.z;
    simulation
        .find_equilibrium(5.0, &TIGHT)
        .expect("the bristles hold");
    let after = simulation.snapshot().friction(0).deflection.translation.z;
    // s0 z = m g sin α at rest.
    let exact = 2.0 * 9.81 * 10.0_f64.to_radians().sin() / 1e5;
    let case = Case {
        section: Section::Statics,
        id: "9.17 LUGRE",
        model: "the block on 10° on bristles, s0 1e5: dynamics to rest, then equilibrium",
        source: "s0 z = m g sin α",
        covers: &super::lugre(JointType::Translational, &[]),
    };
    let why = "the rest of the motion after 5 s";
    check(&[case.values(
        "z before and after [m]",
        &[before, after],
        &[exact; 2],
        1e-10,
        why,
    )]);
}

/// Shafts whose turning is prescribed: every step of the iteration only meets constraints.
#[test]
fn what_is_driven_has_an_equilibrium_at_any_time() {
    for cross in [Cross::Hooke, Cross::Universal] {
        let friction = law(0.1, 0.1, 0.1, 0.01);
        let mut simulation = Simulation::new(shafts(cross, [Some(friction); 2]), 1.0);
        simulation.assemble().expect("it assembles");
        // 10 rad/s: from step to step by 6 degrees, then by 17.
        for time in [0.01, 0.02, 0.03, 0.06, 0.09] {
            simulation
                .find_equilibrium(time, &TIGHT)
                .unwrap_or_else(|error| panic!("{error}"));
            let turned = log(&simulation.snapshot().rotation(0)).z;
            assert!((turned - 10.0 * time).abs() < 1e-10, "{turned} at {time}");
            // The cross passes the torque of 5 on the output as between 5 cos 30° and 5/cos 30°;
            // creep takes up to 0.1 of the loads on the pins more or less.
            let torque = simulation.snapshot().reaction(Owner::Motion(0)).torque.z;
            assert!((4.2..5.9).contains(&torque.abs()), "{torque} at {time}");
        }
    }
}
