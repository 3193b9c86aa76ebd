//! Too many equations, contradictory ones, parts without mass, prescribed motion.

use mechanics::model::{JointKind, Level, Model, MotionFreedom};
use mechanics::{AssemblyError, Formulation, Owner, Simulation};
use nalgebra::{Matrix3, Vector3};

use crate::runs::{every, run, settings};
use mechanisms::builder::{Builder, axes_with_z, v};
use mechanisms::{four_bar, law, pendulum};

fn four_bar_with_friction() -> Model {
    four_bar(Some(law(0.25, 0.2, 1e-3, 1e-5)))
}

#[test]
fn planar_four_bar_reports_three_redundant_equations_and_doubtful_frictions() {
    let mut simulation = Simulation::new(four_bar_with_friction(), 1.0);
    let assembly = simulation.assemble().expect("it assembles");
    let named: Vec<String> = assembly
        .redundant
        .iter()
        .map(|r| format!("{}, {}", r.owner, r.equation))
        .collect();
    println!(
        "redundant: {named:?}; frictions not unique: {:?}",
        assembly.not_unique
    );
    assert_eq!(assembly.redundant.len(), 3);
    assert_eq!(assembly.not_unique, [0, 1, 2, 3]);
    assert_eq!(simulation.system().degrees_of_freedom(), 1);
}

#[test]
fn joint_off_by_a_millimetre_is_named() {
    let mut model = four_bar_with_friction();
    let ground = model.joints[3].j;
    model.markers[ground].offset.z += 1e-3;
    let error = Simulation::new(model, 1.0)
        .assemble()
        .expect_err("the loop does not close");
    println!("{error}");
    let AssemblyError::Inconsistent { given, unmet } = &error else {
        panic!("{error:?}")
    };
    // Where it was given, the gap is that of one joint; the best positions spread it.
    assert_eq!((given[0].owner.id, given.len()), (4, 1), "{error}");
    assert!((given[0].error - 1e-3).abs() < 1e-12, "{error}");
    assert!(unmet.iter().any(|u| u.owner.id == 4), "{error}");
    assert!(unmet.iter().all(|u| u.error < 2e-3), "{error}");
}

#[test]
fn opposite_axes_are_named() {
    let mut b = Builder::new(v(0.0, -9.81, 0.0));
    let body = b.rod(1.0, Vector3::zeros(), v(1.0, 0.0, 0.0));
    let i = b.marker(Some(body), Vector3::zeros(), axes_with_z(Vector3::z()));
    let j = b.marker(None, Vector3::zeros(), axes_with_z(-Vector3::z()));
    b.joint_of_markers(JointKind::Revolute, i, j);
    let error = Simulation::new(b.model, 1.0)
        .assemble()
        .expect_err("the axes are opposite");
    println!("{error}");
    assert!(
        matches!(&error, AssemblyError::Opposite { joint, axis: 2 } if joint.id == 1),
        "{error:?}"
    );
}

#[test]
fn part_without_mass_may_move_where_its_motion_is_determined() {
    // The pendulum again, its arm a part without mass that carries the mass in a fixed joint.
    let mut b = Builder::new(v(0.0, -9.81, 0.0));
    let arm = b.body(0.0, [0.0; 3], v(-0.4, 0.0, 0.0));
    let mass = b.body(1.0, [0.0; 3], v(-1.0, 0.0, 0.0));
    b.pin(Some(arm), None, Vector3::zeros());
    b.joint(
        JointKind::Fixed,
        Some(mass),
        Some(arm),
        v(-1.0, 0.0, 0.0),
        Vector3::z(),
    );
    let assembly = Simulation::new(b.model.clone(), 1.0).assemble();
    assert_eq!(assembly.expect("it assembles").massless, []);
    let settings = settings(Formulation::Si2, 1e-9, 0.1);
    let with_arm = run(b.model, &[2.0], &settings, |_| {});
    let without = run(pendulum(), &[2.0], &settings, |_| {});
    let difference = (with_arm.state().centre(1) - without.state().centre(0)).norm();
    // Both meet the closed form to about 1e-7 at this error.
    assert!(difference < 1e-6, "{difference:e}");
}

#[test]
fn free_part_without_mass_is_named() {
    let mut b = Builder::new(v(0.0, -9.81, 0.0));
    b.rod(1.0, Vector3::zeros(), v(1.0, 0.0, 0.0));
    b.pin(Some(0), None, Vector3::zeros());
    let loose = b.body(0.0, [0.0; 3], v(1.0, 0.0, 0.0));
    b.joint(
        JointKind::Spherical,
        Some(loose),
        Some(0),
        v(1.0, 0.0, 0.0),
        Vector3::z(),
    );
    let mut simulation = Simulation::new(b.model, 1.0);
    let assembly = simulation.assemble().expect("positions are fine");
    let [free] = assembly.massless.as_slice() else {
        panic!("{:?}", assembly.massless)
    };
    assert_eq!((free.body.id, free.turns), (2, true));
    let error = simulation
        .solve_instant()
        .expect_err("nothing determines its rotation");
    println!("{error}");
    assert!(error.message.contains("PART/2"), "{error}");
}

/// The pendulum driven at `rate`, by position or by velocity.
fn driven(level: Level, rate: f64) -> Model {
    let mut b = Builder { model: pendulum() };
    b.drive(0, MotionFreedom::AboutZ, level, rate);
    b.spin(0, v(0.0, 0.0, rate), Vector3::zeros());
    b.model
}

#[test]
fn motions_drive_a_model_without_freedoms() {
    for level in [Level::Position, Level::Velocity] {
        let rate = 3.0;
        let mut simulation = Simulation::new(driven(level, rate), 1.0);
        simulation.assemble().expect("it assembles");
        assert_eq!(simulation.system().degrees_of_freedom(), 0);
        let (mut place, mut torque) = (0.0_f64, 0.0_f64);
        let settings = settings(Formulation::Si2, 1e-9, 0.1);
        run(driven(level, rate), &every(10.0, 50), &settings, |s| {
            let (sine, cosine) = (rate * s.time()).sin_cos();
            place = place.max((s.state().centre(0) - v(-cosine, -sine, 0.0)).norm());
            // The weight at −cosine turns back with g cosine about z.
            let drive = s.reaction(Owner::Motion(0)).torque.z;
            torque = torque.max((drive + 9.81 * cosine).abs());
        });
        println!("{level:?}: place {place:.1e}, torque {torque:.1e}");
        // A motion by position holds the place to rounding; one by velocity is integrated, with
        // about 300 steps of an error of 1e-9 at most.
        let bound = if level == Level::Position {
            1e-12
        } else {
            3e-7
        };
        assert!(
            place < bound && torque < 10.0 * bound,
            "{level:?} {place:e} {torque:e}"
        );
    }
}

#[test]
fn assembly_changes_as_little_as_needed_and_says_so() {
    // A rod on a ball joint whose markers are apart by a small `gap`.
    let gap = v(1e-3, -2e-3, 0.5e-3);
    let make = || {
        let mut b = Builder::new(Vector3::zeros());
        let rod = b.rod(1.0, Vector3::zeros(), v(1.0, 0.0, 0.0));
        let i = b.marker(Some(rod), Vector3::zeros(), Matrix3::identity());
        let j = b.marker(None, gap, Matrix3::identity());
        b.joint_of_markers(JointKind::Spherical, i, j);
        b.model
    };
    let mut simulation = Simulation::new(make(), 1.0);
    let length = simulation.system().length_scale();
    let assembly = simulation.assemble().expect("it assembles");
    let moved = &assembly.moved[0];
    assert_eq!(moved.body.id, 1);
    // Least |δr|²/length² + |δθ|² with δr + δθ × ρ = gap: δr = length² μ and δθ = ρ × μ with
    // (length² + ρ² − ρρᵀ) μ = gap.
    let arm = v(-0.5, 0.0, 0.0);
    let square = length * length;
    let matrix = (square + arm.norm_squared()) * Matrix3::identity() - arm * arm.transpose();
    let multiplier = matrix.try_inverse().expect("it is positive") * gap;
    let (distance, angle) = ((square * multiplier).norm(), arm.cross(&multiplier).norm());
    // Second order in the gap: 4e-6 of rotation squared.
    assert!(
        (moved.distance - distance).abs() < 1e-5,
        "{moved:?} {distance}"
    );
    assert!((moved.angle - angle).abs() < 1e-5, "{moved:?} {angle}");
    let tip = simulation.snapshot().marker(0).origin;
    assert!((tip - gap).norm() < 1e-13);
    // What must stay, stays.
    let mut model = make();
    model.bodies[0].exact = [false, false, false, true, true, true];
    let assembly = Simulation::new(model, 1.0)
        .assemble()
        .expect("it assembles");
    assert!(assembly.moved[0].angle < 1e-9, "{:?}", assembly.moved);
    assert!((assembly.moved[0].distance - gap.norm()).abs() < 1e-9);
}

#[test]
fn every_loop_of_a_row_of_four_bars_has_its_redundant_equations() {
    // Each four-bar hangs on the coupler of the one before, so that the loops share bodies in pairs.
    const LOOPS: usize = 12;
    let mut b = Builder::new(v(0.0, -9.81, 0.0));
    let mut base = None;
    for k in 0..LOOPS {
        let at = |x: f64, y: f64| v(3.0 * k as f64 + x, y, 0.0);
        let points = [at(0.0, 0.0), at(0.2, 1.0), at(1.5, 1.4), at(1.2, 0.0)];
        let [crank, coupler, rocker] =
            [0, 1, 2].map(|rod| b.rod(1.0, points[rod], points[rod + 1]));
        b.pin(Some(crank), base, points[0]);
        b.pin(Some(coupler), Some(crank), points[1]);
        b.pin(Some(rocker), Some(coupler), points[2]);
        b.pin(Some(rocker), base, points[3]);
        base = Some(coupler);
    }
    // What hangs on the last coupler alone is no part of a loop, but a joint doubled is one.
    let hanging = b.rod(1.0, v(0.0, 9.0, 0.0), v(0.0, 8.0, 0.0));
    b.pin(Some(hanging), base, v(0.0, 9.0, 0.0));
    b.pin(Some(hanging), base, v(0.0, 9.0, 0.0));
    let mut simulation = Simulation::new(b.model, 1.0);
    let assembly = simulation.assemble().expect("it assembles");
    let dropped = |joint: usize| {
        let of_joint = assembly.redundant.iter();
        of_joint
            .filter(|r| r.owner.id as usize == joint + 1)
            .count()
    };
    // The last joint of each planar loop keeps two equations.
    let counts: Vec<usize> = (0..4 * LOOPS + 2).map(dropped).collect();
    let mut expected: Vec<usize> = [[0, 0, 0, 3]; LOOPS].concat();
    expected.extend([0, 5]);
    assert_eq!(counts, expected);
    assert_eq!(simulation.system().degrees_of_freedom(), LOOPS + 1);
}
