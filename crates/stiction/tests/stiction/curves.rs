//! PTCV and CURVE against closed forms: beads on a ring, on a bowl and in a turning tube.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use crate::shared::{last, refusal, run_text};

/// MATRIX/1 and CURVE/1 through points.
fn curve(points: &[[f64; 3]], arguments: &str) -> String {
    let rows = points
        .iter()
        .map(|[x, y, z]| format!(", {x:e}, {y:e}, {z:e}\n"));
    let values: String = rows.collect();
    format!(
        "MATRIX/1, FULL=RORDER, ROWS={}, COLUMNS=3, VALUES={}CURVE/1, MATRIX=1, CURVE_POINTS, {arguments}\n",
        points.len(),
        values.trim_start_matches(", ")
    )
}

/// A ring of radius 2 in the xz plane, `count` points evenly round it from (2, 0, 0) on.
fn ring(count: usize) -> String {
    let at = |k: usize| {
        let a = TAU * (k % count) as f64 / count as f64;
        [2.0 * a.cos(), 0.0, 2.0 * a.sin()]
    };
    curve(&(0..=count).map(at).collect::<Vec<_>>(), "CLOSED")
}

const GROUND: &str = "curves
PART/1, GROUND
MARKER/1, PART=1
MARKER/9, PART=1, FLOATING
ACCGRAV/KGRAV=-10
";

#[test]
fn a_bead_on_a_ring_swings_as_a_pendulum_and_goes_round() {
    // A bead of mass 3 at (2, 0, 0) that falls down the ring: a pendulum of length 2 about y, which
    // a part on a pin computes without a curve. It passes the point where the curve closes.
    for speed in [0.0, -9.5] {
        let text = format!(
            "{GROUND}{}PART/2, MASS=3, CM=20, IP=1, 1, 1, QG=2, 0, 0, VZ={speed}
MARKER/20, PART=2
PTCV/1, I=20, JFLOAT=9, RM=1, CURVE=1
REQUEST/1, F2=PTCV(1,0,2,1)\\F3=PTCV(1,0,3,1)\\F4=PTCV(1,0,4,1)\\F6=PTCV(1,1,6,1)\\F7=PTCV(1,1,4,1)\\
PART/3, MASS=3, CM=30, IP=1E-9, 1E-9, 1E-9, QG=2, 0, 0, VZ={speed}, WY={turn}
MARKER/30, PART=3
MARKER/31, PART=3, QP=-2, 0, 0, REULER=0, 90D, 0
MARKER/2, PART=1, REULER=0, 90D, 0
JOINT/1, REVOLUTE, I=31, J=2
END
",
            ring(96),
            turn = -speed / 2.0,
        );
        let results = run_text(&text, 2.0, 100, Some(1e-9));
        let column = |name: &str| results.get(name).unwrap();
        let mut farthest = 0.0_f64;
        for row in 1..column("PART_2_XFORM.X").len() {
            let [x, z, vx, vz] =
                ["X", "Z", "VX", "VZ"].map(|n| column(&format!("PART_2_XFORM.{n}"))[row]);
            let pinned = ["X", "Z"].map(|n| column(&format!("PART_3_XFORM.{n}"))[row]);
            // The ring through 96 points is a circle to 5/384 (2π/96)⁴·2 = 5e-7, of which the
            // swings make some ten times as much.
            let apart = (x - pinned[0]).hypot(z - pinned[1]);
            assert!(apart < 1e-5, "{speed} {row}: {apart}");
            assert!((x.hypot(z) - 2.0).abs() < 1e-6);
            // Energy: the reaction does no work. 1e-9 a step over some thousand steps.
            let energy = 0.5 * (vx * vx + vz * vz) + 10.0 * z;
            assert!(
                (energy - 0.5 * speed * speed).abs() < 1e-4,
                "{row}: {energy}"
            );
            // What holds the bead on the circle: m (v²/r - g z/r) towards the centre; the
            // curvature of the spline is that of the circle to (2π/96)²/12.
            let towards = 3.0 * ((vx * vx + vz * vz) / 2.0 - 5.0 * z);
            let inwards =
                -(x * column("REQUEST_1.F2")[row] + z * column("REQUEST_1.F4")[row]) / 2.0;
            assert!(
                (inwards - towards).abs() < 2e-3 * (1.0 + towards.abs()),
                "{inwards} {towards}"
            );
            assert!(column("REQUEST_1.F3")[row].abs() < 1e-9);
            // On the curve it acts at the bead.
            assert!(column("REQUEST_1.F6")[row].abs() < 1e-9);
            farthest = farthest.max(-x);
        }
        assert!(farthest > 1.9);
    }
}

#[test]
fn a_bead_slides_through_a_bowl() {
    // From rest at x = -2 on z = x²/2: at the bottom v² = 2 g h with h = 2, and the reaction is
    // m (g + v² z'') = 1·(10 + 40).
    let at = |k: usize| {
        let x = -2.5 + 0.05 * k as f64;
        [x, 0.0, 0.5 * x * x]
    };
    let points: Vec<_> = (0..=100).map(at).collect();
    let text = format!(
        "{GROUND}{}POINT_MASS/2, MASS=1, CM=20, QG=-2, 0, 2
MARKER/20, POINT_MASS=2
PTCV/1, I=20, JFLOAT=9, RM=1, CURVE=1
SENSOR/1, GE, VALUE=0, ERROR=1E-9, RETURN, FUNCTION=DX(20)
REQUEST/1, F2=PTCV(1,0,4,1)\\F3=VM(20)\\F4=DX(20)\\
END
",
        curve(&points, "OPEN, ORDER=4")
    );
    let results = run_text(&text, 1.5, 15000, Some(1e-9));
    let place = last(&results, "REQUEST_1.F4");
    // The last output is up to 1e-4 s · 6.3 past the bottom.
    assert!(place.abs() < 1e-3, "{place}");
    let speed = last(&results, "REQUEST_1.F3");
    assert!((speed - 40.0_f64.sqrt()).abs() < 1e-5, "{speed}");
    // z'' of a spline through points 0.05 apart, and the place.
    let force = last(&results, "REQUEST_1.F2");
    assert!((force - 50.0).abs() < 0.05, "{force}");
}

#[test]
fn a_bead_in_a_turning_tube_flies_out() {
    // r'' = ω² r from r = 0.5 at rest in the tube: r = 0.5 cosh ωt; the tube pushes it sideways with
    // 2 m ω r'. The tube of straight lines turns about y.
    let points = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [9.0, 0.0, 0.0]];
    let text = format!(
        "tube
PART/1, GROUND
MARKER/1, PART=1, REULER=0, 90D, 0
PART/3, MASS=5, CM=30, IP=7, 7, 7, WY=3
MARKER/30, PART=3, REULER=0, 90D, 0
MARKER/31, PART=3
MARKER/9, PART=3, FLOATING
JOINT/1, REVOLUTE, I=30, J=1
MOTION/1, JOINT=1, ROTATIONAL, FUNCTION=3*TIME
PART/2, MASS=2, CM=20, IP=1, 1, 1, QG=0.5, 0, 0, VZ=-1.5
MARKER/20, PART=2
{}PTCV/1, I=20, JFLOAT=9, RM=31, CURVE=1
REQUEST/1, F2=DX(20,31,31)\\F3=PTCV(1,0,1,31)\\F4=PTCV(1,1,4,31)\\F6=PTCV(1,1,7,31)\\F7=MOTION(1,0,8,1)\\
END
",
        curve(&points, "OPEN, ORDER=2")
    );
    let t: f64 = 0.9;
    let results = run_text(&text, t, 30, Some(1e-9));
    let (r, rate) = (0.5 * (3.0 * t).cosh(), 1.5 * (3.0 * t).sinh());
    let found = last(&results, "REQUEST_1.F2");
    // The integrator's error of 1e-9 a step over some hundred steps, times cosh 2.7.
    assert!((found - r).abs() < 1e-5, "{found} {r}");
    let push = 2.0 * 2.0 * 3.0 * rate;
    assert!((last(&results, "REQUEST_1.F3") - push).abs() < 1e-4 * push);
    // On the tube it acts where the bead is: about there without a torque, and the drive has to
    // hold the lever of r.
    assert!((last(&results, "REQUEST_1.F4").abs() - push).abs() < 1e-4 * push);
    assert!(last(&results, "REQUEST_1.F6").abs() < 1e-9);
    let drive = last(&results, "REQUEST_1.F7");
    assert!((drive.abs() - push * r).abs() < 1e-4 * push * r, "{drive}");
}

#[test]
fn a_function_reads_the_coordinates_of_a_curve() {
    let mut text = format!(
        "{GROUND}{}PART/2, MASS=1, CM=20, IP=1, 1, 1\nMARKER/20, PART=2\n",
        ring(200)
    );
    for (component, request) in [(1, 1), (3, 3)] {
        write!(text, "REQUEST/{request}, ").unwrap();
        for order in 0..3 {
            write!(
                text,
                "F{}=CURVE(2*TIME-1,{order},{component},1)\\",
                order + 2
            )
            .unwrap();
        }
        text += "\n";
    }
    let results = run_text(&(text + "END\n"), 1.0, 7, None);
    let time = results.get("time.TIME").unwrap();
    for (row, t) in time.iter().enumerate().skip(2) {
        // The parameter from -1 to 1 goes round once: the angle is π (x + 1) = 2π t.
        let a = TAU * t;
        let wanted = [
            [2.0 * a.cos(), -2.0 * PI * a.sin(), -2.0 * PI * PI * a.cos()],
            [2.0 * a.sin(), 2.0 * PI * a.cos(), -2.0 * PI * PI * a.sin()],
        ];
        for (request, wanted) in [1, 3].into_iter().zip(wanted) {
            for (order, wanted) in wanted.into_iter().enumerate() {
                let name = format!("REQUEST_{request}.F{}", order + 2);
                let found = results.get(&name).unwrap()[row];
                // h⁴, h³ and h² of a spline through 200 points round a circle.
                let tolerance = [1e-7, 1e-5, 1e-2][order];
                assert!(
                    (found - wanted).abs() < tolerance,
                    "{name} {t}: {found} {wanted}"
                );
            }
        }
    }
}

#[test]
fn curves_that_a_point_cannot_follow_are_refused() {
    let bead = "PART/2, MASS=1, CM=20, IP=1, 1, 1
MARKER/20, PART=2
PTCV/1, I=20, JFLOAT=9, RM=1, CURVE=1
END
";
    let corner = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [2.0, 1.0, 0.0]];
    let said = refusal(&format!("{GROUND}{}{bead}", curve(&corner, "ORDER=2")));
    assert!(
        said.contains("CURVE/1 has a corner at its point 2"),
        "{said}"
    );
    assert!(said.contains("ORDER = 4"), "{said}");
    let doubled = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 1.0, 0.0]];
    let said = refusal(&format!("{GROUND}{}{bead}", curve(&doubled, "OPEN")));
    assert!(
        said.contains("point 3 is the same as the one before it"),
        "{said}"
    );
    let few = refusal(&format!("{GROUND}{}{bead}", curve(&corner[..2], "OPEN")));
    assert!(few.contains("needs at least 4 points"), "{few}");
}
