//! Small motions: eigenvalues against closed forms.

use mechanics::expression::{Binary, Input, Operation, Program};
use mechanics::linearization::Mode;
use mechanics::measure::Quantity;
use mechanics::model::{
    AlgebraicVariable, Definition, DifferentialState, ForceKind, Form, FrictionJoint,
    GeneralConstraint, JointKind, Label, Level, MotionFreedom,
};
use mechanics::{EquilibriumSettings, Simulation};
use nalgebra::{Complex, Matrix3, Vector3};

use mechanisms::builder::{Builder, v};

/// Rounding of a dense eigenvalue problem of a few rows, whose condition is of order ten.
const ROUNDING: f64 = 1e-11;

const STATICS: EquilibriumSettings = EquilibriumSettings {
    error: 1e-12,
    imbalance: 1e-10,
    stability: 1e-5,
    iterations: 50,
    angle_limit: 0.2,
    translation_limit: 20.0,
};

fn modes_from(builder: Builder, reference: Option<usize>) -> Vec<Mode> {
    let mut simulation = Simulation::new(builder.model, 1.0);
    simulation.assemble().unwrap();
    let linear = simulation.linearize(reference).unwrap();
    linear.modes(true).unwrap()
}

fn modes(builder: Builder) -> Vec<Mode> {
    modes_from(builder, None)
}

fn assert_values(modes: &[Mode], expected: &[Complex<f64>], tolerance: f64) {
    let values: Vec<Complex<f64>> = modes.iter().map(|mode| mode.value).collect();
    assert_eq!(values.len(), expected.len(), "{values:?}");
    let scale = expected.iter().map(|e| e.norm()).fold(1.0, f64::max);
    for (value, expected) in values.iter().zip(expected) {
        let error = (value - expected).norm() / scale;
        assert!(
            error <= tolerance,
            "{values:?} is not {expected}: {error:e}"
        );
    }
}

fn imaginary(rate: f64) -> Complex<f64> {
    Complex::new(0.0, rate)
}

/// `stiffness · (length − place)  − damping · speed` along z of `j` on `i`.
fn spring_along_z(b: &mut Builder, i: usize, j: usize, stiffness: f64, damping: f64) {
    let place = b.measure(Quantity::Displacement(2), i, j);
    let speed = b.measure(Quantity::Velocity(2), i, j);
    let function = linear(&[(-stiffness, place), (-damping, speed)]);
    let kind = ForceKind::AlongAxis { frame: j, axis: 2 };
    b.force(kind, i, j, function);
}

/// A sum of measures with factors.
fn linear(terms: &[(f64, usize)]) -> Program {
    let mut program = Program::default();
    let mut sum = program.push(Operation::Constant(0.0));
    for &(factor, measure) in terms {
        let factor = program.push(Operation::Constant(factor));
        let value = program.push(Operation::Input(Input::Measure(measure)));
        let term = program.push(Operation::Binary(Binary::Multiply, factor, value));
        sum = program.push(Operation::Binary(Binary::Add, sum, term));
    }
    program
}

/// A body of `mass` that slides along z, and the markers of its guide on it and on ground.
fn slider(b: &mut Builder, mass: f64, z: f64) -> (usize, usize, usize) {
    let body = b.body(mass, [1.0, 2.0, 3.0], v(0.0, 0.0, z));
    let joint = b.joint(
        JointKind::Translational,
        Some(body),
        None,
        v(0.0, 0.0, z),
        Vector3::z(),
    );
    let joint = &b.model.joints[joint];
    (body, joint.i, joint.j)
}

/// Three masses between walls: `ω = 2 √(k/m) sin(jπ/8)`.
#[test]
fn a_chain_of_masses_and_springs() {
    let mut b = Builder::new(Vector3::zeros());
    let mut last = b.marker(None, Vector3::zeros(), Matrix3::identity());
    for place in 1..=3 {
        let (_, i, _) = slider(&mut b, 2.0, f64::from(place));
        b.spring(i, last, 50.0, 1.0);
        last = i;
    }
    let wall = b.marker(None, v(0.0, 0.0, 4.0), Matrix3::identity());
    b.spring(wall, last, 50.0, 1.0);
    let modes = modes(b);
    let rate = |j: f64| 10.0 * (j * std::f64::consts::PI / 8.0).sin();
    let expected = [1.0, 2.0, 3.0].map(|j| imaginary(rate(j)));
    assert_values(&modes, &expected, ROUNDING);
    // The first shape moves all the same way, the ends by sin 45° of the middle.
    let along = |body: usize| modes[0].shape[6 * body + 2].re;
    assert!((along(1) - 1.0).abs() < ROUNDING);
    for end in [0, 2] {
        assert!((along(end) - 0.5_f64.sqrt()).abs() < 1e-7, "{}", along(end));
    }
}

/// A rod on a pin, hanging and standing; its constraint force is the stiffness.
#[test]
fn a_pendulum_hangs_and_stands() {
    for (side, is_stable) in [(-1.0, true), (1.0, false)] {
        let mut b = Builder::new(v(0.0, -9.81, 0.0));
        let rod = b.rod(1.5, Vector3::zeros(), v(0.0, 0.8 * side, 0.0));
        b.pin(Some(rod), None, Vector3::zeros());
        // m g l/2 over m l²/3
        let rate = (1.5 * 9.81 / 0.8_f64).sqrt();
        let expected = if is_stable {
            vec![imaginary(rate)]
        } else {
            vec![Complex::new(-rate, 0.0), Complex::new(rate, 0.0)]
        };
        assert_values(&modes(b), &expected, ROUNDING);
    }
}

/// The tension of a pendulum that swings through its lowest place does not show in the equation of
/// its angle, nor does where its marker stands.
#[test]
fn a_swinging_pendulum_has_the_modes_of_its_angle() {
    let mut b = Builder::new(v(0.0, -9.81, 0.0));
    let rod = b.rod(1.5, Vector3::zeros(), v(0.0, -0.8, 0.0));
    b.spin(rod, v(0.0, 0.0, 3.0), Vector3::zeros());
    b.pin(Some(rod), None, Vector3::zeros());
    let rate = (1.5 * 9.81 / 0.8_f64).sqrt();
    // Rates of the basis are differences of fourth order with steps of 5e-3.
    assert_values(&modes(b), &[imaginary(rate)], 1e-9);
}

/// A pendulum at the end of a general constraint on its distance, which curves with both bodies.
#[test]
fn a_general_constraint_holds_a_pendulum() {
    let mut b = Builder::new(v(0.0, -9.81, 0.0));
    // The point mass hangs below a body that turns about x and carries the centre off its axis.
    let bob = b.body(2.0, [0.3, 0.4, 0.5], v(0.0, -1.7, 0.0));
    b.joint(
        JointKind::Planar,
        Some(bob),
        None,
        v(0.0, -1.7, 0.0),
        Vector3::z(),
    );
    let on_bob = b.marker(Some(bob), v(0.0, -1.2, 0.0), Matrix3::identity());
    let ground = b.marker(None, Vector3::zeros(), Matrix3::identity());
    let distance = b.measure(Quantity::Distance, on_bob, ground);
    let mut function = linear(&[(1.0, distance)]);
    let length = function.push(Operation::Constant(1.2));
    let sum = length - 1;
    function.push(Operation::Binary(Binary::Subtract, sum, length));
    b.model.constraints.push(GeneralConstraint {
        label: Label {
            statement: "GCON",
            id: 1,
            name: String::new(),
        },
        i: Some(on_bob),
        j: Some(ground),
        function,
    });
    // Double pendulum of a massless string l = 1.2 and a body hung 0.5 above its centre:
    // m l² θ̈ + m l a φ̈ + m g l θ = 0, m l a θ̈ + (I + m a²) φ̈ + m g a φ = 0
    let (m, l, a, inertia, g) = (2.0, 1.2, 0.5, 0.5, 9.81);
    let quadratic: [f64; 3] = [
        m * l * l * (inertia + m * a * a) - (m * l * a) * (m * l * a),
        -(m * l * l * m * g * a + (inertia + m * a * a) * m * g * l),
        m * g * l * m * g * a,
    ];
    let root = (quadratic[1] * quadratic[1] - 4.0 * quadratic[0] * quadratic[2]).sqrt();
    let square = |sign: f64| (-quadratic[1] + sign * root) / (2.0 * quadratic[0]);
    let expected = [square(-1.0), square(1.0)].map(|square| imaginary(square.sqrt()));
    assert_values(&modes(b), &expected, ROUNDING);
}

/// `m z̈ + c ż + k z = 0` below and above critical damping, and without its damper.
#[test]
fn a_damped_oscillator() {
    let (mass, stiffness) = (2.0, 50.0);
    for damping in [4.0, 40.0] {
        let mut b = Builder::new(Vector3::zeros());
        let (_, i, j) = slider(&mut b, mass, 0.0);
        spring_along_z(&mut b, i, j, stiffness, damping);
        let half = 0.5 * damping / mass;
        let inside = Complex::new(half * half - stiffness / mass, 0.0).sqrt();
        let expected = if inside.im == 0.0 {
            vec![-half + inside, -half - inside]
        } else {
            vec![-half + inside]
        };
        assert_values(&modes(b.clone()), &expected, ROUNDING);
        let mut simulation = Simulation::new(b.model, 1.0);
        simulation.assemble().unwrap();
        let linear = simulation.linearize(None).unwrap().without_damping();
        assert_values(&linear.modes(false).unwrap(), &[imaginary(5.0)], ROUNDING);
    }
}

/// A symmetric rotor on a ball with torsional springs: forward and backward whirl, the roots of
/// `It s² ∓ i Ia Ω s + k = 0`.
#[test]
fn a_rotor_whirls_forward_and_backward() {
    let (transverse, axial, omega, stiffness) = (0.7, 1.1, 20.0, 300.0);
    let mut b = Builder::new(Vector3::zeros());
    let rotor = b.body(3.0, [transverse, transverse, axial], Vector3::zeros());
    b.spin(rotor, v(0.0, 0.0, omega), Vector3::zeros());
    b.joint(
        JointKind::Spherical,
        Some(rotor),
        None,
        Vector3::zeros(),
        Vector3::z(),
    );
    // The ends of a shaft between springs on ground; a shaft of ±1 has 2 k a² of stiffness.
    for end in [-1.0, 1.0] {
        for axis in 0..2 {
            let i = b.marker(Some(rotor), v(0.0, 0.0, end), Matrix3::identity());
            let j = b.marker(None, v(0.0, 0.0, end), Matrix3::identity());
            let place = b.measure(Quantity::Displacement(axis), i, j);
            let kind = ForceKind::AlongAxis { frame: j, axis };
            b.force(kind, i, j, linear(&[(-0.5 * stiffness, place)]));
        }
    }
    let half = 0.5 * axial * omega / transverse;
    let root = (half * half + stiffness / transverse).sqrt();
    // The rotor's own turning has two zeros.
    let zero = Complex::new(0.0, 0.0);
    let expected = [zero, zero, imaginary(root - half), imaginary(root + half)];
    // The zeros are a double root: half the digits.
    assert_values(&modes(b), &expected, 1e-7);
}

/// A rod hinged across a shaft that turns steadily flaps at the rate of the shaft, seen from it.
#[test]
fn a_rod_flaps_on_a_turning_shaft() {
    let omega = 7.0;
    let mut b = Builder::new(Vector3::zeros());
    let shaft = b.body(1.0, [1.0; 3], Vector3::zeros());
    let bearing = b.joint(
        JointKind::Revolute,
        Some(shaft),
        None,
        Vector3::zeros(),
        Vector3::z(),
    );
    b.drive(bearing, MotionFreedom::AboutZ, Level::Velocity, omega);
    let rod = b.rod(2.0, Vector3::zeros(), v(1.5, 0.0, 0.0));
    b.joint(
        JointKind::Revolute,
        Some(rod),
        Some(shaft),
        Vector3::zeros(),
        Vector3::y(),
    );
    let reference = b.marker(Some(shaft), Vector3::zeros(), Matrix3::identity());
    let spin = v(0.0, 0.0, omega);
    b.spin(shaft, spin, Vector3::zeros());
    b.spin(rod, spin, Vector3::zeros());
    let modes = modes_from(b, Some(reference));
    // Rates of the basis are differences of fourth order with steps of 5e-3.
    assert_values(&modes, &[imaginary(omega)], 1e-9);
}

/// A free body has six freedoms without stiffness: twelve zeros.
#[test]
fn a_free_body_has_zeros_only() {
    let mut b = Builder::new(v(0.0, 0.0, -9.81));
    b.body(1.0, [1.0, 2.0, 2.5], v(0.3, 0.2, 0.1));
    let modes = modes(b);
    assert_eq!(modes.len(), 12);
    assert!(modes.iter().all(|mode| mode.value.norm() == 0.0));
}

/// A free mass on a rail goes on as it does: two zeros, of one shape.
#[test]
fn a_free_mass_has_one_shape_for_both_zeros() {
    let mut b = Builder::new(Vector3::zeros());
    slider(&mut b, 3.0, 0.5);
    let modes = modes(b);
    assert_eq!(modes.len(), 2);
    for mode in modes {
        assert_eq!(mode.value.norm(), 0.0);
        let along: Vec<f64> = mode.shape.iter().map(|s| s.norm()).collect();
        assert_eq!(along, [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    }
}

/// Two masses on a free rail, coupled by a spring: `ω² = k (1/m₁ + 1/m₂)`, and two zeros.
#[test]
fn free_masses_move_together_and_against_one_another() {
    let mut b = Builder::new(Vector3::zeros());
    let (_, first, _) = slider(&mut b, 1.0, 0.0);
    let (_, second, _) = slider(&mut b, 4.0, 2.0);
    b.spring(first, second, 80.0, 2.0);
    let zero = Complex::new(0.0, 0.0);
    assert_values(&modes(b), &[zero, zero, imaginary(10.0)], ROUNDING);
}

/// A part without mass between two springs in series.
#[test]
fn a_part_without_mass_adds_no_mode() {
    let mut b = Builder::new(Vector3::zeros());
    let (_, between, ground) = slider(&mut b, 0.0, 0.0);
    let (_, mass, _) = slider(&mut b, 2.0, 1.0);
    spring_along_z(&mut b, between, ground, 100.0, 0.0);
    // Not at rest as it starts.
    b.spring(between, mass, 100.0, 1.1);
    let mut simulation = Simulation::new(b.model, 1.0);
    simulation.assemble().unwrap();
    // Its acceleration is anything until it is known to rest.
    assert!(simulation.linearize(None).is_err());
    simulation.find_equilibrium(0.0, &STATICS).unwrap();
    let linear = simulation.linearize(None).unwrap();
    assert_values(&linear.modes(true).unwrap(), &[imaginary(5.0)], ROUNDING);
}

/// A block on a horizontal joint with friction under its weight; the joint.
fn block_on_a_joint(mass: f64, gravity: f64, law: impl Into<friction::Law>) -> (Builder, usize) {
    let mut b = Builder::new(v(0.0, -gravity, 0.0));
    let body = b.body(mass, [1.0; 3], Vector3::zeros());
    let joint = b.joint(
        JointKind::Translational,
        Some(body),
        None,
        Vector3::zeros(),
        Vector3::z(),
    );
    let load = FrictionJoint::Translational(friction::TranslationalLoad {
        inputs: friction::Inputs::ALL,
        reaction_arm: 1.0,
        bending_factor: 1.0,
        initial_overlap: 1000.0,
        overlap_sign: 0.0,
    });
    b.friction(joint, law, load);
    (b, joint)
}

/// A block that sticks is a spring of `1.875 μs N/Dm` and a damper of `1.875 μs N/Vs`
/// (`friction::Original`).
#[test]
fn a_stuck_block_rings_on_its_creep() {
    let (mu, deformation, transition) = (0.4, 1e-3, 0.5);
    let (mass, gravity) = (2.0, 9.81);
    let law = friction::Original {
        mu_static: mu,
        mu_dynamic: 0.3,
        transition_velocity: transition,
        transition_coefficient: 1.5,
        max_deformation: deformation,
        effect: friction::Effect::All,
    };
    let (b, joint) = block_on_a_joint(mass, gravity, law);
    let weight = mass * gravity;
    let stiffness = 1.875 * mu * weight / deformation;
    let half = 0.5 * 1.875 * mu * weight / transition / mass;
    let rate = (stiffness / mass - half * half).sqrt();
    assert_values(&modes(b.clone()), &[Complex::new(-half, rate)], ROUNDING);
    // Pushed by half of what it holds, it rings lower: the law is softer there. The creep d solves
    // psi(d/Dm) = 0.5/mu with psi = (15 x − 10 x³ + 3 x⁵)/8, and its slope is 15 (1 − x²)²/8.
    let mut pushed = b;
    let push = 0.5 * mu * weight;
    let (i, j) = (pushed.model.joints[joint].i, pushed.model.joints[joint].j);
    pushed.force(ForceKind::AlongZ, i, j, Program::constant(push));
    let mut simulation = Simulation::new(pushed.model, 1.0);
    simulation.assemble().unwrap();
    simulation.find_equilibrium(0.0, &STATICS).unwrap();
    let modes = simulation.linearize(None).unwrap().modes(false).unwrap();
    let x = simulation.state().centre(0).z / deformation;
    let slope = 1.875 * (1.0 - x * x) * (1.0 - x * x);
    assert!(x > 0.2 && x < 0.4, "{x}");
    let stiffness = slope * mu * weight / deformation;
    let rate = (stiffness / mass - half * half).sqrt();
    assert_values(&modes, &[Complex::new(-half, rate)], 1e-7);
}

/// The bristles of LuGre are its spring and damper at rest.
#[test]
fn a_stuck_block_rings_on_its_bristles() {
    let (s0, s1, s2, mass) = (1e4, 30.0, 0.5, 2.0);
    let law = friction::LuGre {
        mu_static: 0.4,
        mu_dynamic: 0.3,
        bristle_stiffness: s0,
        damping: s1,
        viscous: s2,
        stribeck_velocity: 0.01,
        stribeck_exponent: 2.0,
    };
    let (b, _) = block_on_a_joint(mass, 9.81, law);
    let half = 0.5 * (s1 + s2) / mass;
    let rate = (s0 / mass - half * half).sqrt();
    // The spring is a difference over 1e-6 of a damper: 1e-16 · (s1 + s2)/1e-6 of s0.
    assert_values(&modes(b), &[Complex::new(-half, rate)], 1e-9);
}

/// A spring whose force follows the displacement through a filter of first order, `T ẏ = x − y`:
/// `(m s² + c s)(T s + 1) + k = 0`; with the filter as an algebraic variable in between.
#[test]
fn a_filter_adds_its_eigenvalue() {
    let (mass, stiffness, time) = (2.0, 50.0, 0.3);
    let mut b = Builder::new(Vector3::zeros());
    let (_, i, j) = slider(&mut b, mass, 0.0);
    let place = b.measure(Quantity::Displacement(2), i, j);
    let label = |statement| Label {
        statement,
        id: 1,
        name: String::new(),
    };
    // w = x − y, T ẏ = w
    let mut lag = Program::default();
    let x = lag.push(Operation::Input(Input::Measure(place)));
    let y = lag.push(Operation::Input(Input::State(0)));
    lag.push(Operation::Binary(Binary::Subtract, x, y));
    b.model.algebraics.push(AlgebraicVariable {
        label: label("VARIABLE"),
        definition: Definition::Function(Form::Explicit, lag),
        start: 0.0,
    });
    let mut rate = Program::default();
    let w = rate.push(Operation::Input(Input::Algebraic(0)));
    let constant = rate.push(Operation::Constant(time));
    rate.push(Operation::Binary(Binary::Divide, w, constant));
    b.model.states.push(DifferentialState {
        label: label("DIFF"),
        form: Form::Explicit,
        function: rate,
        start: 0.0,
        start_rate: 0.0,
        held_in_statics: false,
    });
    let mut force = Program::default();
    let y = force.push(Operation::Input(Input::State(0)));
    let factor = force.push(Operation::Constant(-stiffness));
    force.push(Operation::Binary(Binary::Multiply, factor, y));
    b.force(ForceKind::AlongAxis { frame: j, axis: 2 }, i, j, force);
    let modes = modes(b);
    assert_eq!(modes.len(), 2);
    for mode in &modes {
        let s = mode.value;
        let terms = [
            mass * s * s * (s * time + 1.0),
            Complex::new(stiffness, 0.0),
        ];
        assert!((terms[0] + terms[1]).norm() < 1e-10 * stiffness, "{s}");
    }
    assert!(modes[0].value.im == 0.0 && modes[1].value.im > 0.0);
}
