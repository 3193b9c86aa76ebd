//! The assembled Newton matrix against differences of the residual, over a model with every kind
//! of joint, motion, force, friction and system element, in general position.

use nalgebra::{Matrix3, Vector3};
use numerics::linear::Matrix;

use crate::constraint::Owner;
use crate::curve::{Curve, Drawing};
use crate::expression::{Binary, Input, Operation, Program, Unary};
use crate::force_element::{Acting, ForceComponent, ForceElement, Side};
use crate::measure::{Measure, Quantity};
use crate::model::{
    AlgebraicVariable, Body, Definition, DifferentialState, ForceAndTorque, ForceKind, Form,
    Friction, FrictionJoint, Joint, JointKind, JointStart, Label, Law, Level, Marker, Model,
    Motion, MotionFreedom, Pin, Reactions, SingleForce,
};
use crate::rotation::Quaternion;
use crate::state::State;
use crate::system::{Rows, System, Weights};

fn label(statement: &'static str, id: usize) -> Label {
    Label {
        statement,
        id: id as u32,
        name: String::new(),
    }
}

/// Deterministic numbers of either sign, of order one.
fn vector(seed: usize) -> Vector3<f64> {
    let s = seed as f64;
    Vector3::new(
        (1.7 * s + 0.3).sin(),
        (2.9 * s + 1.1).cos(),
        (0.8 * s * s + 0.5).sin(),
    )
}

const KINDS: [JointKind; 18] = [
    JointKind::Revolute,
    JointKind::Translational,
    JointKind::Cylindrical,
    JointKind::Spherical,
    JointKind::Planar,
    JointKind::Fixed,
    JointKind::Hooke,
    JointKind::Universal,
    JointKind::AtPoint,
    JointKind::Inline,
    JointKind::Inplane,
    JointKind::Orientation,
    JointKind::ParallelAxes,
    JointKind::Perpendicular,
    JointKind::Screw {
        pitch: 3.0,
        start: 0.4,
    },
    JointKind::ConstantVelocity { away: true },
    JointKind::RackPinion {
        pitch: -2.0,
        start: 0.3,
    },
    JointKind::PointOnCurve { curve: 0 },
];

/// A function of two inputs and time: `sin(a) b² + t`.
fn function(first: Input, second: Input) -> Program {
    let mut program = Program::default();
    let a = program.push(Operation::Input(first));
    let b = program.push(Operation::Input(second));
    let t = program.push(Operation::Input(Input::Time));
    let sine = program.push(Operation::Unary(Unary::Sin, a));
    let square = program.push(Operation::Binary(Binary::Multiply, b, b));
    let product = program.push(Operation::Binary(Binary::Multiply, sine, square));
    program.push(Operation::Binary(Binary::Add, product, t));
    program
}

fn of_time() -> Program {
    let mut program = Program::default();
    let t = program.push(Operation::Input(Input::Time));
    program.push(Operation::Unary(Unary::Sin, t));
    program
}

fn model(law: &Law) -> Model {
    let bodies = 5;
    let mut model = Model {
        gravity: vector(99),
        ..Model::default()
    };
    for body in 0..bodies {
        let r = vector(body + 40);
        model.bodies.push(Body {
            label: label("PART", body + 2),
            mass: 1.0 + 0.3 * body as f64,
            inertia: Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 2.5)) + 0.1 * r * r.transpose(),
            centre: Vector3::zeros(),
            origin: vector(body),
            orientation: Quaternion::exp(&vector(body + 10)),
            velocity: vector(body + 20),
            // A point mass does not turn.
            angular_velocity: if body == 4 {
                Vector3::zeros()
            } else {
                0.7 * vector(body + 30)
            },
            exact: [false; 6],
            given_velocity: [false; 6],
            rotates: body != 4,
        });
    }
    let helix = |k: usize| {
        let a = 0.4 * k as f64;
        Vector3::new(1.5 * a.cos(), a.sin(), 0.3 * a - 1.0)
    };
    let points: Vec<_> = (0..20).map(helix).collect();
    let curve = Curve::through(&points, false, Drawing::Spline);
    model.curves.push(curve.unwrap());
    let marker = |model: &mut Model, body: Option<usize>| {
        let seed = 50 + model.markers.len();
        model.markers.push(Marker {
            id: seed as u32,
            body,
            offset: 0.6 * vector(seed),
            axes: Quaternion::exp(&vector(seed + 1)).matrix(),
        });
        seed - 50
    };
    for (place, kind) in KINDS.into_iter().enumerate() {
        let on = [
            Some(place % bodies),
            if place % 3 == 0 {
                None
            } else {
                Some((place + 2) % bodies)
            },
        ];
        let [i, j] = on.map(|body| marker(&mut model, body));
        model.joints.push(Joint {
            label: label("JOINT", place + 1),
            kind,
            i,
            j,
            translation_start: JointStart::default(),
            rotation_start: JointStart::default(),
        });
    }
    let levels = [Level::Position, Level::Velocity];
    for (place, freedom) in [MotionFreedom::AboutZ, MotionFreedom::Along(1)]
        .into_iter()
        .enumerate()
    {
        let [i, j] = [Some(place), Some(place + 1)].map(|body| marker(&mut model, body));
        model.motions.push(Motion {
            label: label("MOTION", place + 1),
            i,
            j,
            freedom,
            level: levels[place],
            function: of_time(),
            start: JointStart::default(),
        });
    }
    let kinds = [
        ForceKind::LineOfSight,
        ForceKind::AlongZ,
        ForceKind::AboutZ,
        ForceKind::AboutZActionOnly,
        // Their axes are on the third body of the force, on ground, on J and on I (below).
        ForceKind::AlongAxis { frame: 2, axis: 0 },
        ForceKind::AboutAxis { frame: 2, axis: 1 },
        ForceKind::AlongAxis { frame: 3, axis: 1 },
        ForceKind::AlongAxis { frame: 1, axis: 2 },
        ForceKind::AboutAxis { frame: 0, axis: 2 },
    ];
    for (place, kind) in kinds.into_iter().enumerate() {
        let on = [
            Some(place % bodies),
            if place == 1 {
                None
            } else {
                Some((place + 1) % bodies)
            },
        ];
        let [i, j] = on.map(|body| marker(&mut model, body));
        let k = marker(&mut model, Some((place + 3) % bodies));
        let ground = marker(&mut model, None);
        let kind = match kind {
            ForceKind::AlongAxis { frame, axis } => {
                let frame = [i, j, k, ground][frame];
                ForceKind::AlongAxis { frame, axis }
            }
            ForceKind::AboutAxis { frame, axis } => {
                let frame = [i, j, k, ground][frame];
                ForceKind::AboutAxis { frame, axis }
            }
            kind => kind,
        };
        let measures = model.measures.len();
        for quantity in [Quantity::Displacement(1), Quantity::Velocity(0)] {
            model.measures.push(Measure {
                quantity,
                i,
                j: k,
                k: j,
                l: k,
            });
        }
        model.forces.push(SingleForce {
            label: label("SFORCE", place + 1),
            i,
            j,
            kind,
            function: function(Input::Measure(measures), Input::Measure(measures + 1)),
        });
    }
    add_elements(&mut model);
    let inputs = friction::Inputs::ALL;
    let pin = friction::RevoluteLoad {
        inputs,
        pin_radius: 0.3,
        friction_arm: 0.5,
        bending_reaction_arm: 0.7,
    };
    let sleeve = friction::CylindricalLoad {
        inputs,
        pin_radius: 0.3,
        bending_factor: 1.2,
        initial_overlap: 3.0,
        overlap_sign: -1.0,
    };
    let loads = [
        (2, FrictionJoint::Cylindrical(sleeve)),
        (6, FrictionJoint::Pin(Pin::HookeI, pin)),
        (6, FrictionJoint::Pin(Pin::HookeJ, pin)),
        (7, FrictionJoint::Pin(Pin::UniversalI, pin)),
        (7, FrictionJoint::Pin(Pin::UniversalJ, pin)),
        (0, FrictionJoint::Revolute(pin)),
        (
            1,
            FrictionJoint::Translational(friction::TranslationalLoad {
                inputs,
                reaction_arm: 0.4,
                bending_factor: 1.2,
                initial_overlap: 3.0,
                overlap_sign: 1.0,
            }),
        ),
        (
            3,
            FrictionJoint::Spherical(friction::SphericalLoad {
                inputs,
                ball_radius: 0.6,
            }),
        ),
    ];
    for (joint, load) in loads {
        model.frictions.push(Friction {
            label: label("FRICTION", joint + 1),
            joint,
            law: *law,
            load,
            preload: ForceAndTorque::both(0.2),
            // The limit of the force is reached by some of the larger reactions.
            maximum: ForceAndTorque {
                force: 0.5,
                torque: 1e40,
            },
            inactive_static: false,
        });
    }
    model
}

/// States and variables that read everything and one another, and forces that read them.
fn add_elements(model: &mut Model) {
    let readings = [
        [Input::Measure(1), Input::State(1)],
        [Input::Algebraic(0), Input::StateRate(2)],
        [Input::State(0), Input::Measure(2)],
        [Input::StateRate(1), Input::Measure(0)],
    ];
    for (place, [a, b]) in readings.into_iter().enumerate() {
        model.states.push(DifferentialState {
            label: label("DIFF", place + 1),
            form: [Form::Explicit, Form::Implicit][place % 2],
            function: function(a, b),
            start: 0.3 + 0.2 * place as f64,
            start_rate: 0.0,
            held_in_statics: false,
        });
    }
    let readings = [
        [Input::Algebraic(0), Input::Measure(3)],
        [Input::Algebraic(1), Input::State(3)],
        [Input::StateRate(0), Input::Algebraic(0)],
    ];
    for (place, [a, b]) in readings.into_iter().enumerate() {
        let form = [Form::Explicit, Form::Implicit][place % 2];
        model.algebraics.push(AlgebraicVariable {
            label: label("VARIABLE", place + 1),
            definition: Definition::Function(form, function(a, b)),
            start: 0.0,
        });
    }
    add_accelerations(model);
    add_components(model);
    let readings = [
        [Input::State(0), Input::Algebraic(1)],
        [Input::StateRate(2), Input::Algebraic(2)],
        [Input::Algebraic(3), Input::Algebraic(7)],
    ];
    for (force, [a, b]) in model.forces.iter_mut().zip(readings) {
        force.function = function(a, b);
    }
}

/// Variables that are accelerations between markers of four bodies, the last one a point mass.
fn add_accelerations(model: &mut Model) {
    let quantities = [
        Quantity::Acceleration(1),
        Quantity::AccelerationMagnitude,
        Quantity::AngularAcceleration(2),
        Quantity::AngularAccelerationMagnitude,
    ];
    for (place, quantity) in quantities.into_iter().enumerate() {
        let [i, j, k, l] = [0, 2, 4, 6].map(|first| (first + 5 * place) % model.markers.len());
        model.measures.push(Measure {
            quantity,
            i,
            j,
            k,
            l,
        });
        let measure = model.measures.len() - 1;
        model.algebraics.push(AlgebraicVariable {
            label: label("VARIABLE", 10 + place),
            definition: Definition::Acceleration(measure),
            start: 0.0,
        });
    }
}

/// Variables that are components of every kind of force, on either side.
fn add_components(model: &mut Model) {
    let constraints = [0, 1, 6, 7, 11, 14].map(Owner::Joint);
    let constraints = constraints
        .into_iter()
        .chain([Owner::Motion(0), Owner::Motion(1)])
        .map(ForceElement::Constraint);
    let applied = [0, 1, 2, 3, 4, 5].map(|first| ForceElement::Applied { first, count: 1 });
    // Components of one element share their markers.
    let (i, j) = (model.forces[6].i, model.forces[6].j);
    (model.forces[7].i, model.forces[7].j) = (i, j);
    let several = ForceElement::Applied { first: 6, count: 2 };
    let frictions = [0, 5, 6, 7].map(ForceElement::Friction);
    let elements: Vec<ForceElement> = constraints
        .chain(applied)
        .chain([several])
        .chain(frictions)
        .collect();
    let both = elements
        .into_iter()
        .flat_map(|element| [Side::I, Side::J].map(|side| Acting::Element(element, side)));
    let joint = &model.joints[0];
    let between = [[joint.i, joint.j], [joint.j, joint.i]].map(|[i, j]| Acting::Between { i, j });
    for (place, acting) in both.chain(between).enumerate() {
        for torque in [false, true] {
            model.algebraics.push(AlgebraicVariable {
                label: label("VARIABLE", 100 + model.algebraics.len()),
                definition: Definition::Force(ForceComponent {
                    acting,
                    torque,
                    axis: place % 3,
                    frame: (7 * place) % model.markers.len(),
                }),
                start: 0.0,
            });
        }
    }
}

/// Residual of the step equations at `γ`, as functions of `(δu, δΛ)` from a base point.
struct Residual {
    system: System,
    base: State,
    past: Vec<f64>,
    impulses: Vec<f64>,
    gamma: f64,
    rows: Rows,
}

impl Residual {
    fn move_to(&mut self, change: &[f64]) -> (State, Vec<f64>) {
        let moving = self.system.velocity_count();
        let n = self.system.rate_count();
        let mut state = self.base.clone();
        let step: Vec<f64> = change[..moving].iter().map(|u| self.gamma * u).collect();
        state.displace(&step);
        for (u, c) in state.velocities_mut().iter_mut().zip(change) {
            *u += c;
        }
        for (y, c) in state.states_mut().iter_mut().zip(&change[moving..]) {
            *y += c;
        }
        let multipliers: Vec<f64> = self
            .impulses
            .iter()
            .zip(&change[n..])
            .map(|(impulse, c)| (impulse + c) / self.gamma)
            .collect();
        self.system.evaluate(&state, true);
        (state, multipliers)
    }

    fn at(&mut self, change: &[f64]) -> Vec<f64> {
        let n = self.system.rate_count();
        let (state, multipliers) = self.move_to(change);
        let w = self.take_change(&state, &multipliers);
        let mut residual = vec![0.0; n + multipliers.len()];
        let mut force = vec![0.0; n];
        self.system.mass_times(&w, &mut residual[..n]);
        self.system.forces(&multipliers, &mut force);
        for k in 0..n {
            residual[k] -= self.gamma * force[k];
        }
        for (row, &place) in self.system.rows.iter().enumerate() {
            let evaluated = &self.system.evaluated[place];
            let constraint = &self.system.constraints[place];
            let rate = evaluated.rate_of(constraint, state.velocities()) - evaluated.rate;
            let position = self.rows == Rows::Position && constraint.level == Level::Position;
            residual[n + row] = if position {
                evaluated.error / self.gamma
            } else {
                rate
            };
        }
        let first = n + self.system.row_count();
        self.system
            .algebraic_residual(&multipliers, &mut residual[first..]);
        for r in &mut residual[first..] {
            *r *= -self.gamma;
        }
        residual
    }

    /// Velocities and states less their past, as the functions read them.
    fn take_change(&mut self, state: &State, multipliers: &[f64]) -> Vec<f64> {
        let rates = state.values[state.rate_range()].iter();
        let change: Vec<f64> = rates.zip(&self.past).map(|(u, p)| u - p).collect();
        self.system
            .set_solution(&change, 1.0 / self.gamma, multipliers);
        change
    }
}

/// With a transition velocity that the random velocities lie below, creep and velocity both take
/// part; with one far below them the joints slide.
fn original(transition_velocity: f64) -> Law {
    Law::Original(friction::Original {
        mu_static: 0.4,
        mu_dynamic: 0.3,
        transition_velocity,
        transition_coefficient: 1.5,
        max_deformation: 2.0,
        effect: friction::Effect::All,
    })
}

fn bristles() -> Law {
    Law::LuGre(friction::LuGre {
        mu_static: 0.4,
        mu_dynamic: 0.3,
        bristle_stiffness: 2.0,
        damping: 0.5,
        viscous: 0.3,
        stribeck_velocity: 2.0,
        stribeck_exponent: 1.5,
    })
}

fn check(law: &Law, rows: Rows) {
    let system = System::new(model(law));
    let base = system.given_state(0.3);
    check_system(system, base, rows);
}

fn check_system(system: System, base: State, rows: Rows) {
    let n = system.rate_count();
    let moving = system.velocity_count();
    let size = system.unknown_count();
    let past: Vec<f64> = (0..n).map(|k| 0.5 * vector(k)[k % 3]).collect();
    let impulses: Vec<f64> = (0..size - n).map(|k| vector(k + 7)[k % 3]).collect();
    let shared = n + system.first_shared();
    let mut residual = Residual {
        system,
        base,
        past,
        impulses,
        gamma: 0.2,
        rows,
    };
    let zero = vec![0.0; size];
    residual.move_to(&zero);
    // Derivatives of joints are exact where these hold their markers together.
    residual.system.join_markers();
    // Friction starts a little before the base point, so that there is creep.
    let start: Vec<f64> = (0..size).map(|k| 0.3 * vector(k + 3)[0]).collect();
    residual.move_to(&start);
    residual.system.start_history();
    let deflections: Vec<f64> = (0..residual.system.bristle_count())
        .map(|k| 0.2 * vector(k + 5)[1])
        .collect();
    let gamma = residual.gamma;
    residual.system.set_bristles(&deflections, gamma);

    let (state, multipliers) = residual.move_to(&zero);
    let w = residual.take_change(&state, &multipliers);
    let mut matrix = Matrix::new(size);
    residual.system.assemble(
        rows,
        Weights::step(1.0, residual.gamma, residual.gamma),
        &w,
        &multipliers,
        &mut matrix,
    );
    let assembled = matrix.to_dense();
    for column in 0..size {
        let turns = column >= moving || column % 6 < 3 || column / 6 != 4;
        // Sixth-order differences: truncation h⁶, far below the rounding of 1e-13/h.
        let h = 1e-3;
        let mut slope = vec![0.0; size];
        for (factor, weight) in [(1.0, 45.0), (2.0, -9.0), (3.0, 1.0)] {
            for sign in [1.0, -1.0] {
                let mut change = zero.clone();
                change[column] = sign * factor * h;
                for (s, r) in slope.iter_mut().zip(residual.at(&change)) {
                    *s += sign * weight * r / (60.0 * h);
                }
            }
        }
        for row in 0..size {
            let entry = assembled[row * size + column];
            let error = (entry - slope[row]).abs();
            // The point mass's rotations are not unknowns of the motion: their inertia alone stays.
            // How shares change with the bodies is left out.
            let left_out = row >= shared && column < moving;
            if turns && !left_out && (row >= moving || row % 6 < 3 || row / 6 != 4) {
                let places = (
                    residual.system.describe(row),
                    residual.system.describe(column),
                );
                assert!(error < 1e-8, "{places:?}: {entry} {}", slope[row]);
            }
        }
    }
}

#[test]
fn stuck_friction_and_velocity_rows() {
    check(&original(5.0), Rows::Velocity);
}

#[test]
fn sliding_friction_and_position_rows() {
    check(&original(0.05), Rows::Position);
}

#[test]
fn bristles_and_velocity_rows() {
    check(&bristles(), Rows::Velocity);
}

#[test]
fn shared_reactions() {
    let mut model = model(&original(5.0));
    model.reactions = Reactions::LeastSquares { length: Some(0.7) };
    let mut system = System::new(model);
    let base = system.given_state(0.3);
    system.evaluate(&base, false);
    // Every fourth equation is dropped; whether it depends on the others is nothing to derivatives.
    let in_force: Vec<bool> = (0..system.constraints.len()).map(|k| k % 4 != 2).collect();
    system.set_active(&in_force);
    system.share_reactions();
    // The equations are those of one loop.
    let shared = system.multiplier_count() - system.first_shared();
    let dropped = system.constraints.len() - system.row_count();
    assert_eq!(shared, 12 * 5 + 2 * system.row_count() + dropped);
    check_system(system, base, Rows::Position);
}
