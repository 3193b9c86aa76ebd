//! What a dataset means in mechanics, seen in the results of short runs.

use crate::shared::{last, run_text};

#[test]
fn a_hanging_pound_mass_weighs_a_pound_force() {
    // UCF = 386.0886: 67.31782 lbm under 386.0885827 in/s^2 is 67.31782 lbf.
    let text = "hanging in inches and pounds
UNITS/SYSTEM=IPS
ACCGRAV/JGRAV=-386.0885827
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=67.31782, CM=20, IP=500, 500, 500
MARKER/20, PART=2, QP=0, -10, 0
MARKER/21, PART=2
JOINT/1, REVOLUTE, I=21, J=1
END
";
    let results = run_text(text, 0.1, 2, None);
    // The standard gravity of the pound force and the dataset's differ in the ninth digit.
    assert!((last(&results, "JOINT_1.FY") - 67.31782).abs() < 1e-6);
}

#[test]
fn inertia_is_shifted_and_turned_from_im() {
    // A box about its corner along turned axes: about the centre, xx = 2, yy = 3, zz = 4 along the
    // part. It spins about a fixed axis z through its centre under a torque of 8: 2 rad/s^2.
    let steiner = "PART/2, MASS=1, CM=20, IM=21, IP=6, 7, 10
MARKER/20, PART=2
! The corner at (1, 2, 1) with x and y swapped in effect: turned by 90 degrees about z.
MARKER/21, PART=2, QP=1, 2, 1, REULER=90D, 0, 0
";
    // About (1, 2, 1): xx = 2 + 5 = 7, yy = 3 + 2 = 5, zz = 4 + 5 = 9, xy = 2, xz = 1, yz = 2;
    // along axes turned by 90 degrees: XX = yy, YY = xx, XY = -xy, XZ = yz, YZ = -xz.
    let steiner = steiner.replace("IP=6, 7, 10", "IP=5, 7, 9, -2, 2, -1");
    let direct = "PART/2, MASS=1, CM=20, IP=2, 3, 4
MARKER/20, PART=2
MARKER/21, PART=2
";
    let model = |part: &str| {
        format!(
            "inertia
PART/1, GROUND
MARKER/1, PART=1
{part}
SFORCE/1, ROTATIONAL, I=22, J=1, ACTIONONLY, FUNCTION=8
MARKER/22, PART=2
SFORCE/2, ROTATIONAL, I=22, J=2, ACTIONONLY, FUNCTION=3
MARKER/2, PART=1, REULER=90D, 90D, 0
END
"
        )
    };
    let one = run_text(&model(&steiner), 0.1, 10, None);
    let other = run_text(&model(direct), 0.1, 10, None);
    for component in ["WX", "WY", "WZ", "WDX", "WDY", "WDZ"] {
        let name = format!("PART_2_XFORM.{component}");
        let (a, b) = (last(&one, &name), last(&other, &name));
        // Rounding of the shift; both take the same steps.
        assert!((a - b).abs() < 1e-9, "{name}: {a} and {b}");
    }
    // At the start, at rest: 8/zz about z and 3/xx about x (the z axis of MARKER/2 is x).
    assert!((one.get("PART_2_XFORM.WDZ").unwrap()[1] - 2.0).abs() < 1e-12);
    assert!((one.get("PART_2_XFORM.WDX").unwrap()[1] - 1.5).abs() < 1e-12);
}

#[test]
fn initial_velocities_have_their_axes() {
    // VX along ground unless VM says otherwise; WZ about the axes of the centre of mass.
    let text = "initial velocities
PART/1, GROUND
MARKER/1, PART=1, REULER=90D, 0, 0
PART/2, MASS=1, CM=20, IP=1, 1, 1, QG=5, 0, 0, REULER=0, 90D, 0, VX=2, WZ=3
MARKER/20, PART=2
PART/3, MASS=1, CM=30, IP=1, 1, 1, VX=2, VM=1, WX=3, WM=1
MARKER/30, PART=3
END
";
    let results = run_text(text, 0.01, 1, None);
    let start = |name: &str| results.get(name).unwrap()[1];
    let expected = [
        ("PART_2_XFORM.VX", 2.0),
        // Turned by 90 degrees about x, z of the part is -y of ground.
        ("PART_2_XFORM.WY", -3.0),
        ("PART_2_XFORM.WZ", 0.0),
        // x of MARKER/1 is y of ground.
        ("PART_3_XFORM.VX", 0.0),
        ("PART_3_XFORM.VY", 2.0),
        ("PART_3_XFORM.WY", 3.0),
    ];
    for (name, value) in expected {
        assert!(
            (start(name) - value).abs() < 1e-12,
            "{name} is {}",
            start(name)
        );
    }
}

#[test]
fn springs_push_apart_when_short_and_variables_are_read_through() {
    let text = "springs and outputs
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1, 1, 1, QG=3, 0, 0
MARKER/20, PART=2
SPRINGDAMPER/1, I=20, J=1, TRANSLATIONAL, K=10, C=0, LENGTH=5, FORCE=1
VARIABLE/1, FUNCTION=2*VARVAL(2)
VARIABLE/2, FUNCTION=DX(20) + IF(TIME-1: 10, 20, 30)
VARIABLE/3, FUNCTION=FX(20, 1) + SPDP(1, 1, 2, 0) + ACCX(20)
REQUEST/1, FORCE, I=20, J=1
REQUEST/2, F2=VARVAL(1)\\ F3=FX(1, 20, 0)\\, CNAMES=\"\", \"TWICE\", \"BACK\"
END
";
    let results = run_text(text, 0.001, 1, None);
    let start = |name: &str| results.get(name).unwrap()[1];
    // F = -10 (3 - 5) + 1 = 21 on I along x; a = 10.5.
    let expected = [
        ("SPRINGDAMPER_1.FX", 21.0),
        ("PART_2_XFORM.ACCX", 10.5),
        ("VARIABLE_1.Q", 26.0),
        ("VARIABLE_2.Q", 13.0),
        ("VARIABLE_3.Q", 10.5),
        ("REQUEST_1.FM", 21.0),
        ("REQUEST_1.FX", 21.0),
        ("REQUEST_2.TWICE", 26.0),
        ("REQUEST_2.BACK", -21.0),
    ];
    for (name, value) in expected {
        assert!(
            (start(name) - value).abs() < 1e-12,
            "{name} is {}",
            start(name)
        );
    }
}

#[test]
fn reactions_on_j_take_the_torque_about_j() {
    // A beam fixed 1 m from the wall's marker cannot be: the markers coincide in a fixed joint, so
    // a translational joint 2 m out along z carries the weight with a torque about each end.
    let text = "reactions
ACCGRAV/JGRAV=-10
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=20, IP=1, 1, 1, QG=0, 0, 2
MARKER/20, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=1
REQUEST/1, F2=JOINT(1, 0, 3, 0)\\ F3=JOINT(1, 0, 6, 0)\\ F4=JOINT(1, 1, 3, 0)\\ F6=JOINT(1, 1, 6, 0)\\
END
";
    let results = run_text(text, 0.01, 1, None);
    let start = |name: &str| results.get(name).unwrap()[1];
    // On I 10 N up, no torque about I. On J 10 N down at 2 m along z: (0,0,2) x (0,-10,0) = 20 x.
    let expected = [
        ("REQUEST_1.F2", 10.0),
        ("REQUEST_1.F3", 0.0),
        ("REQUEST_1.F4", -10.0),
        ("REQUEST_1.F6", 20.0),
    ];
    for (name, value) in expected {
        assert!(
            (start(name) - value).abs() < 1e-9,
            "{name} is {}",
            start(name)
        );
    }
}

#[test]
fn motions_drive_and_report_their_torque() {
    // A flywheel of zz = 2 at 3 t^2: 6 rad/s^2 need 12; a slider at 4 m/s from 0.5 m.
    let text = "motions
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=20, IP=1, 1, 2
MARKER/20, PART=2
JOINT/1, REVOLUTE, I=20, J=1
MOTION/1, JOINT=1, ROTATIONAL, FUNCTION=3*TIME**2
PART/3, MASS=1, CM=30, IP=1, 1, 1, QG=0, 0, 0.5
MARKER/30, PART=3
JOINT/2, TRANSLATIONAL, I=30, J=1
MOTION/2, I=30, J=1, Z, VELOCITY, FUNCTION=4, ICDISP=0.5
PART/4, MASS=1, CM=40, IP=1, 1, 1
MARKER/40, PART=4
JOINT/3, REVOLUTE, I=40, J=1
MOTION/3, I=40, J=1, B3, VELOCITY, FUNCTION=90D
REQUEST/1, F2=MOTION(1, 0, 8, 0)\\ F3=AZ(20, 1)\\ F4=AZ(40, 1)\\
END
";
    let results = run_text(text, 2.0, 20, None);
    let expected = [
        ("MOTION_1.TZ", 12.0),
        ("REQUEST_1.F2", 12.0),
        ("REQUEST_1.F3", 12.0),
        ("PART_3_XFORM.Z", 8.5),
        ("PART_3_XFORM.VZ", 4.0),
        ("PART_4_XFORM.WZ", std::f64::consts::FRAC_PI_2),
        ("REQUEST_1.F4", std::f64::consts::PI),
    ];
    for (name, value) in expected {
        // The tolerance of the integration is 1e-6 a step; velocity constraints drift by it.
        assert!(
            (last(&results, name) - value).abs() < 1e-5,
            "{name} is {}",
            last(&results, name)
        );
    }
}

#[test]
fn initial_conditions_of_joints_are_met() {
    let text = "initial conditions
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=20, IP=1, 1, 1
MARKER/20, PART=2
JOINT/1, REVOLUTE, I=20, J=1, IC=30D, 2
PART/3, MASS=1, CM=30, IP=1, 1, 1
MARKER/30, PART=3
JOINT/2, CYLINDRICAL, I=30, J=1, ICTRAN=0.25, 3, ICROT=-90D, 1
VARIABLE/1, FUNCTION=AZ(20, 1)
VARIABLE/2, FUNCTION=AZ(30, 1)
END
";
    let results = run_text(text, 0.01, 1, None);
    let start = |name: &str| results.get(name).unwrap()[1];
    let expected = [
        ("VARIABLE_1.Q", std::f64::consts::FRAC_PI_6),
        ("PART_2_XFORM.WZ", 2.0),
        ("PART_3_XFORM.Z", 0.25),
        ("PART_3_XFORM.VZ", 3.0),
        ("VARIABLE_2.Q", -std::f64::consts::FRAC_PI_2),
        ("PART_3_XFORM.WZ", 1.0),
    ];
    for (name, value) in expected {
        // Assembly stops at 1e-14 of the model's length.
        assert!(
            (start(name) - value).abs() < 1e-9,
            "{name} is {}",
            start(name)
        );
    }
}

#[test]
fn point_masses_and_general_constraints_swing_as_a_pendulum() {
    // A point mass kept at 2 m by a GCON, and the same as a part on a hinge without inertia.
    let text = "pendulums
ACCGRAV/KGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1, REULER=0, 90D, 0
POINT_MASS/2, MASS=3, CM=20, QG=2, 0, 0
MARKER/20, POINT_MASS=2
GCON/1, FUNCTION=DM(20, 1) - 2
PART/3, MASS=3, CM=30, QG=2, 0, 0
MARKER/30, PART=3
MARKER/31, PART=3, QP=-2, 0, 0, REULER=0, 90D, 0
JOINT/1, REVOLUTE, I=31, J=1
END
";
    let results = run_text(text, 1.0, 10, None);
    for axis in ["X", "Y", "Z"] {
        let point = last(&results, &format!("POINT_MASS_2_XFORM.{axis}"));
        let part = last(&results, &format!("PART_3_XFORM.{axis}"));
        // Both within the accumulated tolerance of 1e-6 a step.
        assert!((point - part).abs() < 2e-5, "{axis}: {point} and {part}");
    }
    assert!(last(&results, "PART_3_XFORM.Z") < -1.0);
}
