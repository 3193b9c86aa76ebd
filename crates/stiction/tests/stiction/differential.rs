//! DIFF against closed forms: filters, oscillators, implicit equations, forces that read states,
//! static solutions.

use crate::runs::complete_commands;
use crate::shared::{GROUND, last, run_text, scratch_folder, slider};

#[test]
fn filters_and_oscillators_without_any_body() {
    // A resistor and capacitor under a ramp, and y'' = -w² y as two equations, one from the other.
    let text = format!(
        "circuit
{GROUND}DIFF/1, IC=0.3, FUNCTION=(2*TIME-DIF(1))/0.25
DIFF/2, IC=1.5, FUNCTION=DIF(3)
DIFF/3, FUNCTION=-9*DIF(2)
REQUEST/1, F2=DIF(1)\\F3=DIF1(1)\\F4=DIF(2)*DIF1(3)\\
END
"
    );
    let results = run_text(&text, 2.0, 20, Some(1e-8));
    let (t, tau) = (2.0_f64, 0.25);
    let decay = (-t / tau).exp();
    let y = 2.0 * (t - tau * (1.0 - decay)) + 0.3 * decay;
    let rate = 2.0 * (1.0 - decay) - 0.3 / tau * decay;
    let swing = 1.5 * (3.0 * t).cos();
    // An error of 1e-8 a step over some hundred steps.
    for (name, wanted) in [
        ("DIFF_1.Q", y),
        ("DIFF_1.QDOT", rate),
        ("REQUEST_1.F2", y),
        ("REQUEST_1.F3", rate),
        ("DIFF_2.Q", swing),
        ("DIFF_3.Q", -4.5 * (3.0 * t).sin()),
        ("REQUEST_1.F4", -9.0 * swing * swing),
    ] {
        let found = last(&results, name);
        assert!((found - wanted).abs() < 2e-5, "{name}: {found} {wanted}");
    }
    // The rate at the start is that of the equation, not a guess.
    assert_eq!(results.get("DIFF_2.QDOT").unwrap()[1], 0.0);
    assert!((results.get("DIFF_1.QDOT").unwrap()[1] + 1.2).abs() < 1e-14);
}

#[test]
fn small_and_large_states_are_equally_accurate() {
    // The same equation in units a million times smaller and larger.
    let text = format!(
        "scales
{GROUND}DIFF/1, IC=1E-6, FUNCTION=-DIF(1)
DIFF/2, IC=1E6, FUNCTION=-DIF(2)
END
"
    );
    let results = run_text(&text, 1.0, 10, Some(1e-6));
    for (name, scale) in [("DIFF_1.Q", 1e-6), ("DIFF_2.Q", 1e6)] {
        let error = (last(&results, name) / scale - (-1.0_f64).exp()).abs();
        // Some ten steps of 1e-6 each.
        assert!(error < 2e-5, "{name}: {error:e}");
    }
}

#[test]
fn an_implicit_equation_is_solved_for_its_rate() {
    // y'³ + y' = 2 y from y = 1, where the rate r is 1: t = ∫ (3 r² + 1)/(2 r) dr, as
    // y = (r³ + r)/2.
    let text = format!(
        "implicit
{GROUND}DIFF/1, IC=1,0.9, IMPLICIT, FUNCTION=DIF1(1)**3+DIF1(1)-2*DIF(1)
END
"
    );
    let results = run_text(&text, 1.5, 10, Some(1e-8));
    let rate = last(&results, "DIFF_1.QDOT");
    let time = 0.75 * (rate * rate - 1.0) + 0.5 * rate.ln();
    // An error of 1e-8 a step over some hundred steps.
    assert!((time - 1.5).abs() < 1e-5, "{time}");
    let state = last(&results, "DIFF_1.Q");
    assert!((state - 0.5 * (rate.powi(3) + rate)).abs() < 1e-9);
    assert!((results.get("DIFF_1.QDOT").unwrap()[1] - 1.0).abs() < 1e-12);
}

#[test]
fn a_force_and_a_state_drive_each_other() {
    // An actuator y' = (f - y)/τ pulls a mass to x = 1. Two more equations integrate its power and
    // its acceleration: the kinetic energy and the velocity, whatever the motion is.
    let text = slider(
        "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=2, FUNCTION=DIF(1)
DIFF/1, FUNCTION=(8*(1-DX(21,1))-DIF(1))/0.1
DIFF/2, FUNCTION=DIF(1)*VX(21,1)
DIFF/3, FUNCTION=DIF(1)/2
",
    );
    let results = run_text(&text, 2.0, 20, Some(1e-9));
    let velocity = last(&results, "PART_2_XFORM.VX");
    let work = last(&results, "DIFF_2.Q");
    // An error of 1e-9 a step over some thousand steps.
    assert!(
        (work - velocity * velocity).abs() < 1e-5,
        "{work} {velocity}"
    );
    assert!((last(&results, "DIFF_3.Q") - velocity).abs() < 1e-6);
    let acceleration = last(&results, "PART_2_XFORM.ACCX");
    assert!((acceleration - 0.5 * last(&results, "DIFF_1.Q")).abs() < 1e-12);
    assert!(velocity.abs() > 0.1);
}

#[test]
fn states_rest_at_an_equilibrium_or_hold_their_value() {
    // A spring of 50 against gravity 2·10 with a controller: the integral of the error decides the
    // force where it may; held at 5 it leaves the spring to carry the rest.
    let model = |hold: &str| {
        slider(&format!(
            "ACCGRAV/IGRAV=-10
SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=2, K=50, C=20, LENGTH=1
SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=2, FUNCTION=DIF(1)
DIFF/1, IC=5, FUNCTION=3*(1.2-DX(21,1)){hold}
DIFF/2, IC=1, FUNCTION=DIF(1)-4*DIF(2)
"
        ))
        .replace(
            "PART/2, MASS=2, CM=20,",
            "PART/2, MASS=2, CM=20, QG=0.9, 0, 0,",
        )
    };
    for (hold, place, force) in [("", 1.2, 30.0), (", STATIC_HOLD", 0.7, 5.0)] {
        let results = complete_commands(&model(hold), "SIMULATE/STATIC");
        let found = last(&results, "PART_2_XFORM.X");
        // The tolerance of the equilibrium is 1e-4; Newton's last steps go far below it.
        assert!((found - place).abs() < 1e-8, "{found} {place}");
        assert!((last(&results, "DIFF_1.Q") - force).abs() < 1e-6);
        // A filter follows in either case.
        assert!((last(&results, "DIFF_2.Q") - force / 4.0).abs() < 1e-6);
    }
}

#[test]
fn a_motion_from_an_equilibrium_stays_there() {
    let text = slider(
        "ACCGRAV/IGRAV=-10
SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=2, FUNCTION=200*(1-DX(21,1))-30*VX(21,1)+DIF(1)
DIFF/1, FUNCTION=3*(1.2-DX(21,1))
",
    );
    let results = complete_commands(&text, "SIMULATE/STATIC\nSIMULATE/DYNAMIC, END=1, STEPS=10");
    assert!((last(&results, "PART_2_XFORM.X") - 1.2).abs() < 1e-7);
    assert!((last(&results, "DIFF_1.Q") - 60.0).abs() < 1e-5);
}

#[test]
fn states_go_on_across_commands() {
    let text = format!(
        "ramp
{GROUND}VARIABLE/1, FUNCTION=2
DIFF/1, FUNCTION=VARVAL(1)
END
"
    );
    let commands = "SIMULATE/DYNAMIC, END=1, STEPS=4\nVARIABLE/1, FUNCTION=-1\n\
                    SIMULATE/DYNAMIC, END=3, STEPS=4";
    let results = complete_commands(&text, commands);
    assert!(last(&results, "DIFF_1.Q").abs() < 1e-9);
}

#[test]
fn what_cannot_be_solved_is_named() {
    // An implicit equation without a rate to solve for that others read, one that is no number.
    for (equation, name) in [
        ("DIFF/7, IMPLICIT, FUNCTION=DIF(7)-TIME+0*DIF1(7)", "DIFF/7"),
        ("DIFF/8, FUNCTION=SQRT(-1-TIME)", "DIFF/8"),
    ] {
        let text = format!("unsolvable\n{GROUND}{equation}\nEND\n");
        let folder = scratch_folder();
        let file = folder.join("model.adm");
        std::fs::write(&file, text).unwrap();
        let mut project = stiction::Project::load(&file).unwrap();
        project.push_dynamic(1.0, Some(4), None);
        let (report, _) = crate::shared::run(&project, stiction::RunOptions::default());
        std::fs::remove_dir_all(folder).unwrap();
        let stiction::Outcome::AssemblyFailed(text) = report.outcome else {
            panic!("{:?}", report.outcome)
        };
        assert!(text.contains(name), "{text}");
    }
}
