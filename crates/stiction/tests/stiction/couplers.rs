//! COUPLER, GEAR and SCREW against closed forms: gears, racks, a winch, a differential, a nut.

use crate::shared::{last, run_text};

/// Rotors 2, 3 and 4 about z of ground with inertias 2, 3 and 5, and a slide 5 of mass 4 along z.
const MACHINE: &str = "machine
PART/1, GROUND
MARKER/1, PART=1
MARKER/9, PART=1, QP=0, 0, 7
PART/2, MASS=1, CM=20, IP=3, 3, 2
MARKER/20, PART=2
MARKER/21, PART=2, REULER=180D, 0, 0
PART/3, MASS=1, CM=30, IP=3, 3, 3
MARKER/30, PART=3
MARKER/31, PART=3, REULER=-100D, 0, 0
PART/4, MASS=1, CM=40, IP=3, 3, 5
MARKER/40, PART=4
PART/5, MASS=4, CM=50, IP=1, 1, 1, QG=0, 0, 2
MARKER/50, PART=5
JOINT/1, REVOLUTE, I=21, J=1
JOINT/2, REVOLUTE, I=31, J=1
JOINT/3, REVOLUTE, I=40, J=1
JOINT/4, TRANSLATIONAL, I=50, J=9
SFORCE/1, ROTATIONAL, I=20, J=1, FUNCTION=10
REQUEST/1, F2=AZ(20,1)\\F3=AZ(30,1)\\F4=AZ(40,1)\\
";

/// `Σ s q = 0` with inertias `m` under a torque of ten on the first: the multiplier is
/// `−10 s₁/m₁ / Σ s²/m` and the accelerations are `(10 e₁ + λ s)/m`.
fn accelerations(inertias: &[f64], scales: &[f64]) -> (Vec<f64>, f64) {
    let stiffness: f64 = inertias.iter().zip(scales).map(|(m, s)| s * s / m).sum();
    let multiplier = -10.0 * scales[0] / inertias[0] / stiffness;
    let mut force = vec![0.0; inertias.len()];
    force[0] = 10.0;
    let all = force.iter().zip(scales).zip(inertias);
    let accelerations = all.map(|((f, s), m)| (f + multiplier * s) / m).collect();
    (accelerations, multiplier * scales[0])
}

#[test]
fn gears_turn_in_proportion_over_many_turns() {
    // The angles start at 180 and -100 degrees; the sum stays what it is there.
    let text = format!("{MACHINE}COUPLER/1, JOINTS=1, 2, TYPE=R:R, SCALES=1, -3\nEND\n");
    let t = 4.0;
    let results = run_text(&text, t, 40, Some(1e-8));
    let (wanted, torque) = accelerations(&[2.0, 3.0], &[1.0, -3.0]);
    let angles = ["F2", "F3"].map(|name| last(&results, &format!("REQUEST_1.{name}")));
    for (angle, acceleration) in angles.iter().zip(&wanted) {
        let wanted = 0.5 * acceleration * t * t;
        // The integrator's error of 1e-8 a step over some hundred steps.
        assert!((angle - wanted).abs() < 1e-5, "{angle} {wanted}");
    }
    assert!(angles[0] > 5.0 * std::f64::consts::TAU);
    // The gear holds back the first rotor.
    assert!((last(&results, "COUPLER_1.TZ") - torque).abs() < 1e-6);
    assert!(last(&results, "PART_4_XFORM.WZ").abs() < 1e-12);
}

#[test]
fn a_winch_pulls_a_slide() {
    // One scale is that of the second joint; types follow from the joints.
    let text = format!("{MACHINE}COUPLER/1, JOINTS=1, 4, SCALES=-0.5\nEND\n");
    let results = run_text(&text, 1.0, 10, Some(1e-8));
    let (wanted, torque) = accelerations(&[2.0, 4.0], &[1.0, -0.5]);
    let found = last(&results, "PART_5_XFORM.ACCZ");
    assert!((found - wanted[1]).abs() < 1e-6, "{found} {}", wanted[1]);
    assert!((last(&results, "COUPLER_1.TZ") - torque).abs() < 1e-6);
    // It starts where it stands, although the joint's displacement is -5 there.
    assert!((results.get("PART_5_XFORM.Z").unwrap()[1] - 2.0).abs() < 1e-12);
}

#[test]
fn a_differential_splits_the_torque() {
    let text = format!("{MACHINE}COUPLER/1, JOINTS=1, 2, 3, TYPE=R:R:R, SCALES=2, -1, -1\nEND\n");
    let results = run_text(&text, 1.0, 10, Some(1e-8));
    let (wanted, _) = accelerations(&[2.0, 3.0, 5.0], &[2.0, -1.0, -1.0]);
    for (part, wanted) in [2, 3, 4].into_iter().zip(wanted) {
        let found = last(&results, &format!("PART_{part}_XFORM.WDZ"));
        assert!(
            (found - wanted).abs() < 1e-6,
            "PART/{part}: {found} {wanted}"
        );
    }
}

#[test]
fn a_nut_runs_down_its_screw() {
    // Mass 4, inertia 0.02 about the axis, pitch 0.5: a = -g/(1 + J (2 pi/p)^2/m), over many turns
    // from an angle of 180 degrees.
    let text = "nut
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=4, CM=20, IP=0.02, 0.02, 0.02, QG=0, 0, 3
MARKER/20, PART=2
MARKER/21, PART=2, REULER=180D, 0, 0
JOINT/1, SCREW, I=21, J=1, PITCH=0.5
ACCGRAV/KGRAV=-10
REQUEST/1, F2=JOINT(1,0,4,0)\\F3=JOINT(1,0,8,0)\\F4=AZ(20,1)\\
END
";
    let t = 3.0;
    let results = run_text(text, t, 30, Some(1e-8));
    let per_length = std::f64::consts::TAU / 0.5;
    let acceleration = -10.0 / (1.0 + 0.02 * per_length * per_length / 4.0);
    let wanted = 3.0 + 0.5 * acceleration * t * t;
    let found = last(&results, "PART_2_XFORM.Z");
    // The integrator's error of 1e-8 a step over some hundred steps.
    assert!((found - wanted).abs() < 1e-5, "{found} {wanted}");
    let turned = last(&results, "REQUEST_1.F4");
    assert!(
        (turned - per_length * (found - 3.0)).abs() < 1e-7,
        "{turned}"
    );
    assert!(turned.abs() > 5.0 * std::f64::consts::TAU);
    // The thread carries what does not accelerate and turns the nut.
    let (force, torque) = (
        last(&results, "REQUEST_1.F2"),
        last(&results, "REQUEST_1.F3"),
    );
    assert!(
        (force - 4.0 * (10.0 + acceleration)).abs() < 1e-6,
        "{force}"
    );
    assert!(
        (torque - 0.02 * per_length * acceleration).abs() < 1e-6,
        "{torque}"
    );
}

#[test]
fn gears_mesh_where_their_teeth_touch() {
    // Wheels of radius 0.5 about (0, 0) and of radius 0.25 about (0.75, 0), and a rack that the
    // small wheel moves along y at (1, 0). The second joint has the carrier at its I marker.
    let text = "gears
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, QP=0.75, 0, 0
MARKER/3, PART=1, QP=1, 0, 0, REULER=0, -90D, 0
MARKER/4, PART=1, QP=0.5, 0, 0, REULER=0, -90D, 0
PART/2, MASS=1, CM=20, IP=2, 2, 2
MARKER/20, PART=2
PART/3, MASS=1, CM=30, IP=0.5, 0.5, 0.5, QG=0.75, 0, 0
MARKER/30, PART=3
PART/4, MASS=4, CM=40, IP=1, 1, 1, QG=1, 0, 0
MARKER/40, PART=4, REULER=0, -90D, 0
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, REVOLUTE, I=2, J=30
JOINT/3, TRANSLATIONAL, I=40, J=3
GEAR/1, JOINTS=1, 2, CV=4
GEAR/2, JOINTS=2, 3, CV=3
VTORQUE/1, I=20, JFLOAT=9, RM=1, TZ=10\\
MARKER/9, PART=1, FLOATING
END
";
    let t = 2.0;
    let results = run_text(text, t, 20, Some(1e-8));
    // At rim speed v: w1 = v/0.5, w2 = -v/0.25, and the rack moves with the other side of the small
    // wheel, at -v. The inertia at the rim is 2/0.25 + 0.5/0.0625 + 4 and the force 10/0.5.
    let rim = (10.0 / 0.5) / (2.0 / 0.25 + 0.5 / 0.0625 + 4.0) * t;
    let wanted = [
        ("2_XFORM.WZ", rim / 0.5),
        ("3_XFORM.WZ", -rim / 0.25),
        ("4_XFORM.VY", -rim),
    ];
    for (name, wanted) in wanted {
        let found = last(&results, &format!("PART_{name}"));
        // The integrator's error of 1e-8 a step over some hundred steps.
        assert!((found - wanted).abs() < 1e-5, "{name}: {found} {wanted}");
    }
    // The first gear holds its wheel back with the torque that does not turn it.
    let held = 2.0 * rim / 0.5 / t - 10.0;
    assert!((last(&results, "GEAR_1.TZ") - held).abs() < 1e-6);
}

/// A pinion 2 of radius 0.5 and inertia 2 about z at the origin, and a rack 3 of mass 4 that slides
/// along x on the line y = `side`.
fn rack_and_pinion(side: f64, diameter: f64) -> String {
    format!(
        "rack and pinion
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, QP=0, {side}, 0, REULER=90D, 90D, 0
PART/2, MASS=1, CM=20, IP=2, 2, 2
MARKER/20, PART=2
MARKER/21, PART=2, REULER=160D, 0, 0
PART/3, MASS=4, CM=30, IP=1, 1, 1, QG=3, {side}, 0
MARKER/30, PART=3, REULER=90D, 90D, 0
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, TRANSLATIONAL, I=30, J=2
JOINT/3, RACKPIN, I=21, J=30, PD={diameter}
SFORCE/1, ROTATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=10
REQUEST/1, F2=JOINT(3,0,2,0)\\F3=JOINT(3,0,8,0)\\F4=AZ(20,1)\\F5=JOINT(3,1,2,0)\\
END
"
    )
}

#[test]
fn a_pinion_rolls_along_its_rack_over_many_turns() {
    let t = 4.0;
    for (side, diameter, sign) in [(-0.5, 1.0, 1.0), (0.5, 1.0, -1.0), (-0.5, -1.0, -1.0)] {
        let results = run_text(&rack_and_pinion(side, diameter), t, 40, Some(1e-8));
        // The bottom of a wheel that turns about +z moves along +x: a = r T/(J + m r²) there.
        let acceleration = sign * 0.5 * 10.0 / (2.0 + 4.0 * 0.25);
        let found = last(&results, "PART_3_XFORM.X") - 3.0;
        let wanted = 0.5 * acceleration * t * t;
        // The integrator's error of 1e-8 a step over some hundred steps.
        assert!((found - wanted).abs() < 1e-5, "{side}: {found} {wanted}");
        let turned = last(&results, "REQUEST_1.F4");
        assert!((turned - sign * found / 0.5).abs() < 1e-6, "{turned}");
        assert!(turned.abs() > 4.0 * std::f64::consts::TAU);
        // The teeth push the rack, and hold the pinion back by the lever of its radius.
        let [force, torque, back] =
            ["F2", "F3", "F5"].map(|name| last(&results, &format!("REQUEST_1.{name}")));
        assert!((back - 4.0 * acceleration).abs() < 1e-8, "{back}");
        assert!((force + back).abs() < 1e-9);
        assert!((torque + sign * 0.5 * back).abs() < 1e-8, "{torque}");
    }
}

#[test]
fn a_rack_needs_a_side_for_its_pinion() {
    let refused = crate::shared::refusal(&rack_and_pinion(0.0, 1.0));
    assert!(
        refused.contains("the way that the rack moves is not known"),
        "{refused}"
    );
    assert!(
        refused.contains("half of PD off the origin of I"),
        "{refused}"
    );
}

/// Shaft 2 about z and shaft 3 along an axis that is bent by 40 degrees towards y, joined at the
/// origin. Shaft 2 is driven at 3 rad/s.
fn bent_shafts(joint: &str) -> String {
    format!(
        "bent shafts
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, REULER=180D, 40D, 0
PART/2, MASS=1, CM=20, IP=2, 2, 1
MARKER/20, PART=2
MARKER/21, PART=2, REULER=0, 180D, 0
PART/3, MASS=1, CM=30, IP=2, 2, 0.5, REULER=180D, 40D, 0
MARKER/30, PART=3
JOINT/1, REVOLUTE, I=20, J=1
MOTION/1, JOINT=1, ROTATIONAL, FUNCTION=3*TIME
JPRIM/1, PARALLEL_AXES, I=30, J=2
{joint}
SFORCE/1, ROTATIONAL, I=30, J=2, ACTIONONLY, FUNCTION=5
REQUEST/1, F2=WZ(30,2,2)\\F3=MOTION(1,0,8,0)\\
END
"
    )
}

#[test]
fn bent_shafts_turn_evenly_with_a_constant_velocity_joint() {
    // z of MARKER/21 points down the shaft, away from the joint, that of MARKER/20 the other way:
    // both make shaft 3 turn by 3 as well, and the torque of 5 on it is held by as much.
    for marker in [21, 20] {
        let joint = format!("JOINT/2, CONVEL, I={marker}, J=30");
        let results = run_text(&bent_shafts(&joint), 2.0, 40, Some(1e-8));
        let rates = results.get("REQUEST_1.F2").unwrap();
        let torques = results.get("REQUEST_1.F3").unwrap();
        for (rate, torque) in rates.iter().zip(torques).skip(1) {
            // Constraint and balance of one instant, met to the tolerance of 1e-8.
            assert!((rate - 3.0).abs() < 1e-7, "{rate}");
            assert!((torque + 5.0).abs() < 1e-6, "{torque}");
        }
    }
    // With a cross in place of it the rate goes up and down by the cosine of the bend.
    let crossed = run_text(
        &bent_shafts("JOINT/2, HOOKE, I=20, J=30"),
        2.0,
        40,
        Some(1e-8),
    );
    let rates = crossed.get("REQUEST_1.F2").unwrap();
    let fastest = rates.iter().skip(1).fold(0.0_f64, |a, b| a.max(b.abs()));
    let bend = 40.0_f64.to_radians().cos();
    assert!((fastest - 3.0 / bend).abs() < 0.02, "{fastest}");
}
