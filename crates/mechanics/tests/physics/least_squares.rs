//! Reactions of redundant constraints by least squares, against closed forms and stiff joints.

use friction::{Inputs, TranslationalLoad};
use mechanics::expression::{Operation, Program};
use mechanics::measure::Quantity;
use mechanics::model::{
    ForceKind, FrictionJoint, GeneralConstraint, JointKind, Label, Law, Level, Model,
    MotionFreedom, Reactions,
};
use mechanics::{EquilibriumSettings, Formulation, Owner, Simulation};
use nalgebra::Vector3;

use crate::runs::{assembled, every, run, settings};
use mechanisms::builder::{Builder, axes_with_z, v};
use mechanisms::turning::bearing_load;
use mechanisms::{bristles, law};

const GRAVITY: f64 = 9.81;

fn shared(b: Builder, length: Option<f64>) -> Model {
    Model {
        reactions: Reactions::LeastSquares { length },
        ..b.model
    }
}

/// A constant force on a body at a point.
fn push(b: &mut Builder, body: usize, at: Vector3<f64>, along: Vector3<f64>, force: f64) {
    let axes = axes_with_z(along);
    let (i, j) = (b.marker(Some(body), at, axes), b.marker(None, at, axes));
    b.force(ForceKind::AlongZ, i, j, Program::constant(force));
}

fn force(simulation: &Simulation, joint: usize) -> Vector3<f64> {
    simulation.snapshot().reaction(Owner::Joint(joint)).force
}

/// Reactions that differ from `expected` by more than rounding are no least-squares ones.
fn assert_close(found: f64, expected: f64, what: &str) {
    // Sums of a hundred terms of the size of the weight.
    assert!(
        (found - expected).abs() < 1e-11,
        "{what}: {found} {expected}"
    );
}

#[test]
fn table_on_four_legs() {
    // Its feet slide on the ground; the load is off the centre. Legs as equally stiff springs: with
    // the legs at (±a, ±b) F = W/4 (1 ± x/a ± y/b), though three of them would hold it.
    let (a, b, x, y) = (0.8, 0.5, 0.2, -0.1);
    let mut table = Builder::new(v(0.0, 0.0, -GRAVITY));
    let top = table.body(3.0, [1.0; 3], v(x, y, 0.0));
    let feet = [(a, b), (a, -b), (-a, -b), (-a, b)];
    for (fx, fy) in feet {
        let at = v(fx, fy, -0.7);
        table.joint(JointKind::Inplane, Some(top), None, at, Vector3::z());
    }
    let simulation = assembled(shared(table, None));
    for (joint, (fx, fy)) in feet.into_iter().enumerate() {
        let expected = 3.0 * GRAVITY / 4.0 * (1.0 + x / fx * (fx / a).powi(2) + y / fy);
        assert_close(force(&simulation, joint).z, expected, "leg");
    }
}

#[test]
fn door_on_two_hinges() {
    // A couple of horizontal forces at a distance h, and the moments of both hinges, hold the moment
    // M of the weight. The least of 2 F² + 2 (T/L)² with F h + 2 T = M has T = F L² 2/h.
    let (height, length, mass, width) = (1.4, 0.3, 20.0, 0.9);
    let mut door = Builder::new(v(0.0, 0.0, -GRAVITY));
    let leaf = door.body(mass, [2.0, 2.0, 1.0], v(width / 2.0, 0.0, 0.0));
    for z in [-height / 2.0, height / 2.0] {
        let at = v(0.0, 0.0, z);
        door.joint(JointKind::Revolute, Some(leaf), None, at, Vector3::z());
    }
    let moment = mass * GRAVITY * width / 2.0;
    let simulation = assembled(shared(door, Some(length)));
    let couple = moment / (height + 4.0 * length * length / height);
    for (joint, sign) in [(0, 1.0), (1, -1.0)] {
        let reaction = simulation.snapshot().reaction(Owner::Joint(joint));
        assert_close(reaction.force.z, mass * GRAVITY / 2.0, "weight");
        assert_close(reaction.force.x, sign * couple, "couple");
        let torque = 2.0 * couple * length * length / height;
        assert_close(reaction.torque.y, -torque, "torque");
    }
}

#[test]
fn motions_share_with_one_another_and_with_joints() {
    // A slide in two guides, each driven, drives a second time what the other does already.
    let mut b = Builder::new(Vector3::zeros());
    let slide = b.body(2.0, [1.0; 3], Vector3::zeros());
    for y in [-0.5, 0.5] {
        let at = v(0.0, y, 0.0);
        let guide = b.joint(
            JointKind::Translational,
            Some(slide),
            None,
            at,
            Vector3::x(),
        );
        b.drive(guide, MotionFreedom::Along(2), Level::Position, 1.0);
    }
    push(&mut b, slide, v(0.3, 0.0, 0.0), Vector3::x(), 6.0);
    let simulation = assembled(shared(b, None));
    for motion in 0..2 {
        let reaction = simulation.snapshot().reaction(Owner::Motion(motion));
        assert_close(reaction.force.x, -3.0, "motion");
    }
}

#[test]
fn functions_share_with_joints() {
    // A function that holds what a joint holds already, at the centre of mass of the part.
    let mut b = Builder::new(v(0.0, 0.0, -GRAVITY));
    let plate = b.body(2.0, [1.0; 3], Vector3::zeros());
    let held = b.joint(
        JointKind::Fixed,
        Some(plate),
        None,
        Vector3::zeros(),
        Vector3::z(),
    );
    let joint = &b.model.joints[held];
    let (i, j) = (joint.i, joint.j);
    let height = b.measure(Quantity::Displacement(2), i, j);
    let mut function = Program::default();
    function.push(Operation::Input(mechanics::expression::Input::Measure(
        height,
    )));
    b.model.constraints.push(GeneralConstraint {
        label: Label {
            statement: "GCON",
            id: 1,
            name: String::new(),
        },
        i: Some(i),
        j: Some(j),
        function,
    });
    let simulation = assembled(shared(b, None));
    assert_close(force(&simulation, held).z, GRAVITY, "joint");
    let function = simulation.snapshot().reaction(Owner::General(0)).force.z;
    assert_close(function, GRAVITY, "function");
}

/// A slide of 10 kg on two guides at y = 0.3 and 0.7 that moves along z, drawn by `PULL` at y = 0.8 and
/// pressed by 100 N so that both have the same share.
///
/// Friction `f` of each guide, loaded by force and bending, takes off the moment that bends both:
/// `2 T = 0.8 PULL − (0.3 + 0.7) f` with `f = μ (50 + 15 T)`.
fn guided(law: impl Into<Law>, speed: f64) -> Model {
    let mut b = Builder::new(Vector3::zeros());
    let slide = b.body(10.0, [1.0; 3], Vector3::zeros());
    b.model.bodies[slide].velocity.z = speed;
    let law = law.into();
    for y in [0.3, 0.7] {
        let at = v(0.0, y, 0.0);
        let guide = b.joint(
            JointKind::Translational,
            Some(slide),
            None,
            at,
            Vector3::z(),
        );
        let load = TranslationalLoad {
            inputs: Inputs::ALL,
            reaction_arm: 1.0,
            bending_factor: 1.5,
            initial_overlap: 0.1,
            overlap_sign: 0.0,
        };
        b.friction(guide, law, FrictionJoint::Translational(load));
    }
    push(&mut b, slide, v(0.0, 0.8, 0.0), Vector3::z(), PULL);
    push(&mut b, slide, v(0.0, 0.5, 0.0), Vector3::x(), 100.0);
    shared(b, None)
}

const PULL: f64 = 100.0;

/// The friction of each guide at the coefficient `mu`.
fn guide_friction(mu: f64) -> f64 {
    let bending = (0.8 * PULL - mu * 50.0) / (2.0 + 15.0 * mu);
    mu * (50.0 + 15.0 * bending)
}

#[test]
fn friction_that_loads_itself_follows_the_shared_reactions() {
    // With μ = 0.3 what a change of the friction brings about is 2.25 times as large, with the opposite
    // sign: friction of the last step or iteration would swing up.
    let model = guided(law(0.4, 0.3, 0.05, 0.01), 1.0);
    let friction = guide_friction(0.3);
    let simulation = assembled(model.clone());
    for guide in 0..2 {
        let found = -simulation.snapshot().friction(guide).force.z;
        assert_close(found, friction, "friction");
    }
    let acceleration = (PULL - 2.0 * friction) / 10.0;
    for formulation in [
        Formulation::Si2,
        Formulation::I3,
        Formulation::Adams,
        Formulation::Hht { alpha: -0.1 },
    ] {
        let settings = settings(formulation, 1e-8, 0.1);
        let end = run(model.clone(), &[0.2], &settings, |_| {});
        let speed = end.state().velocities()[2];
        // Constant acceleration: what Newton's iteration leaves, in some tens of steps.
        let error = (speed - 1.0 - 0.2 * acceleration).abs();
        assert!(error < 1e-6, "{formulation:?}: {error:e}");
    }
    // Bristles that slide have the dynamic coefficient, too, once they have settled.
    let soft = friction::LuGre {
        damping: 1.0,
        ..bristles(0.4, 0.3)
    };
    let settings = settings(Formulation::Si2, 1e-8, 0.1);
    let end = run(guided(soft, 1.0), &[0.2], &settings, |_| {});
    let found = -end.snapshot().friction(1).force.z;
    assert!((found - friction).abs() < 1e-4, "{found} {friction}");
}

#[test]
fn friction_holds_an_equilibrium_with_shared_reactions() {
    // At rest each guide holds half of the pull, and the moment that is left bends both.
    let mut simulation = assembled(guided(law(0.9, 0.8, 0.05, 0.01), 0.0));
    let tight = EquilibriumSettings {
        error: 1e-12,
        imbalance: 1e-9,
        stability: 1e-5,
        iterations: 50,
        angle_limit: 0.17,
        translation_limit: 1.0,
    };
    let found = simulation.find_equilibrium(0.0, &tight);
    found.expect("friction holds it");
    for guide in 0..2 {
        let values = simulation.snapshot().friction(guide);
        assert!((values.force.z + PULL / 2.0).abs() < 1e-9, "{values:?}");
        let bending = (0.8 * PULL - PULL / 2.0) / 2.0;
        let load = 50.0 + 15.0 * bending;
        assert!((values.load.value - load).abs() < 1e-9, "{values:?}");
    }
}

/// A four-bar whose rods lie beside one another, so that its pins bend, joined in an `order`.
fn offset_four_bar(order: [usize; 4], reactions: Reactions, law: Law) -> Model {
    let mut b = Builder::new(v(0.0, -GRAVITY, 0.0));
    let points = [[0.0, 0.0], [0.2, 0.3], [1.1, 0.8], [1.0, 0.0]];
    let at = |point: usize, z: f64| v(points[point][0], points[point][1], z);
    for rod in 0..3 {
        let z = 0.1 * rod as f64;
        b.rod_with_axial_inertia(1.0 + rod as f64, 0.01, at(rod, z), at(rod + 1, z));
    }
    for point in order {
        let on = [Some(0), Some(1), Some(2), None];
        let j = point.checked_sub(1).and_then(|before| on[before]);
        let pin = b.pin(on[point], j, at(point, 0.1 * point as f64 - 0.05));
        b.friction(pin, law, bearing_load(0.03, 0.04, 0.05));
        if point == 0 {
            b.start_turning(pin, 6.0);
        }
    }
    Model {
        reactions,
        ..b.model
    }
}

#[test]
fn it_does_not_matter_which_equations_are_dropped() {
    let orders = [[0, 1, 2, 3], [3, 1, 0, 2]];
    let laws: [Law; 2] = [
        law(0.25, 0.2, 0.05, 1e-3).into(),
        bristles(0.25, 0.2).into(),
    ];
    for (law, formulation) in laws.into_iter().zip([Formulation::Si2, Formulation::I3]) {
        let ends = |reactions: Reactions| {
            orders.map(|order| {
                let model = offset_four_bar(order, reactions, law);
                let settings = settings(formulation, 1e-7, 0.01);
                let end = run(model, &every(0.3, 3), &settings, |_| {});
                let first = order.iter().position(|point| *point == 0);
                let friction = end
                    .snapshot()
                    .friction(first.expect("it is there"))
                    .torque
                    .z;
                [end.state().velocities()[5], friction]
            })
        };
        let [a, b] = ends(Reactions::LeastSquares { length: None });
        // The error of the run, and that of bristles, which is larger.
        let bounds = [1e-5, 1e-3];
        for (k, bound) in bounds.into_iter().enumerate() {
            assert!((a[k] - b[k]).abs() < bound, "{law:?}: {a:?} {b:?}");
        }
        let [a, b] = ends(Reactions::OfKept);
        assert!((a[0] - b[0]).abs() > 1e-2, "{law:?}: {a:?} {b:?}");
    }
}

#[test]
fn inexact_equations_that_are_dropped_move_nothing() {
    // A pin that leans by 2e-6, which six digits of a dataset leave.
    let mut model = offset_four_bar(
        [0, 1, 2, 3],
        Reactions::OfKept,
        law(0.0, 0.0, 0.05, 1e-3).into(),
    );
    model.frictions.clear();
    let leaning = &mut model.markers[6];
    leaning.axes = axes_with_z(v(2e-6, 1e-6, 1.0));
    let kept = assembled(model.clone());
    model.reactions = Reactions::LeastSquares { length: None };
    let least = assembled(model);
    let angular = |simulation: &Simulation| simulation.snapshot().part_acceleration(1).angular.z;
    let bending = least.snapshot().reaction(Owner::Joint(3)).torque.norm();
    assert!(bending > 0.1, "the last pin has its share: {bending}");
    let change = (angular(&kept) - angular(&least)).abs();
    assert!(change < 1e-11 * angular(&kept).abs(), "{change:e}");
}
