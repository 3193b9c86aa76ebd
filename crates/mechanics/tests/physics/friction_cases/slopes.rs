//! Blocks on slopes and guides against exact stick and slip (B01, B02, B03, B10, B11; 9.5, 9.14).

use friction::Inputs;
use friction::parameters::JointType;
use mechanics::Formulation;
use mechanics::expression::Program;
use mechanics::model::ForceKind;
use nalgebra::Vector3;
use serde_json::Value;
use verification::{Case, Claim, Rule, Section, check};

use super::{HALVINGS, LIMIT, TURNS, UNLOADED, original};
use crate::runs::{run, settings};
use crate::shared::{number, reference};
use mechanisms::builder::{Builder, axes_with_z};
use mechanisms::law;
use mechanisms::sliding::{Block, place, speed};

/// Where a block of the reference stands and its friction at the end, for one Vs and Dm.
fn end_of(case: &Value, transition_velocity: f64, max_deformation: f64) -> (f64, f64) {
    let parameter = |name: &str| number(case, &format!("/params/{name}"));
    // The law wants coefficients above zero; where the reference has none, the load is left out.
    let only_preload = parameter("mu_s") == 0.0;
    let at_least = |mu: f64| if mu == 0.0 { 1.0 } else { mu };
    let law = law(
        at_least(parameter("mu_s")),
        at_least(parameter("mu_d")),
        transition_velocity,
        max_deformation,
    );
    let mut block = Block::new(law);
    block.slope = parameter("angle_deg");
    block.velocity = parameter("v0");
    block.bending = parameter("Tm");
    block.torsion = parameter("Tn");
    block.load.initial_overlap = parameter("Xs");
    block.load.reaction_arm = parameter("Rn");
    block.preload = parameter("preload");
    block.maximum = parameter("Fmax");
    if only_preload {
        block.load.inputs = Inputs {
            preload: true,
            ..Inputs::NONE
        };
    }
    let end = number(case, "/t/8");
    let simulation = run(
        block.model(),
        &[end],
        &settings(Formulation::Si2, 1e-10, 0.02),
        |_| {},
    );
    let snapshot = simulation.snapshot();
    (place(&snapshot), snapshot.friction(0).force.z)
}

/// Id, model, name in the file, arguments.
const BLOCKS: [(&str, &str, &str, &[&str]); 9] = [
    (
        "B01 stick",
        "2 kg on 30° at rest, μs 0.6, μd 0.5: sticks",
        "stick_mu_s_0.60",
        &["INPUTS"],
    ),
    (
        "B01 threshold",
        "2 kg on 30° at rest, μs 0.5773 just below tan 30°: slides",
        "threshold_minus",
        &[],
    ),
    (
        "B01 launch, stick",
        "2 kg on 30° launched up at 3 m/s, μs 0.6, μd 0.5: stops and sticks",
        "launch_up_then_stick",
        &[],
    ),
    (
        "B01 launch, slide",
        "2 kg on 30° launched up at 3 m/s, μs 0.3, μd 0.25: turns and slides back",
        "launch_up_then_slide_back",
        &[],
    ),
    (
        "B02a",
        "2 kg on 30°, μs 0.4, guide bent by 0.3 of the normal force over an overlap of 0.5 m: sticks",
        "bending_offset_stick",
        &["INPUTS", "INITIAL_OVERLAP", "BENDING_FACTOR"],
    ),
    (
        "B03",
        "2 kg on 30°, μs 0.3, μd 0.25, torque of 0.4 N m about the guide on an arm of 0.05 m: slides",
        "torsion_Rn_0.05",
        &["INPUTS", "REACTION_ARM"],
    ),
    (
        "B10 slope",
        "2 kg on 30°, μs 0.3, preload 5 N: sticks",
        "preload_5N",
        &["INPUTS", "FRICTION_FORCE_PRELOAD"],
    ),
    (
        "B10 flat",
        "2 kg on the flat at 2 m/s, preload 5 N alone: stops at 0.8 m",
        "preload_only_flat",
        &["INPUTS", "FRICTION_FORCE_PRELOAD"],
    ),
    (
        "B11",
        "2 kg on 30°, μs 0.6, friction at most 2 N: slides",
        "fmax_clip_2N",
        &["MAX_FRICTION_FORCE"],
    ),
];

#[test]
fn blocks_on_slopes() {
    let Some(file) = reference("validation/data/B01_translational.json") else {
        return;
    };
    let cases = file["cases"].as_object().expect("cases");
    let mut claims = Vec::new();
    for (id, model, name, arguments) in BLOCKS {
        let exact = &cases[name];
        let covers = original(JointType::Translational, arguments);
        let case = Case {
            section: Section::Joint,
            id,
            model,
            source: "closed form of exact stick and slip",
            covers: &covers,
        };
        // The last 5e-5 of the threshold take long to cross: a finer law shows its order.
        let finest = if name == "threshold_minus" { 1e-4 } else { 1.0 };
        let ends = HALVINGS.map(|h| end_of(exact, 0.02 * h * finest, 0.002 * h * finest));
        // On the way through zero velocity the errors before and after cancel in part.
        let (rule, why) = match name {
            "preload_only_flat" => (Rule::Order(2.0), UNLOADED),
            "launch_up_then_slide_back" => (Rule::AtLeastOrder(1.0), TURNS),
            _ => (Rule::Order(1.0), LIMIT),
        };
        let places = ends.map(|(x, _)| x);
        claims.push(case.limit("x(2) [m]", &places, number(exact, "/x/8"), rule, why));
        let (tolerance, why) = match name {
            "preload_only_flat" => (1e-4, "the stop is 0.2 s before the end; the creep fades"),
            _ => (1e-6, "at rest the creep holds the load; the rest fades"),
        };
        let force = number(exact, "/friction/8");
        claims.push(case.values("friction(2) [N]", &[ends[3].1], &[force], tolerance, why));
    }
    assert_eq!(BLOCKS.len(), cases.len());
    check(&claims);
}

/// 9.5: from rest on 20°, with the law itself and in its limit.
#[test]
fn block_slips_from_rest() {
    let slip = |transition_velocity: f64, max_deformation: f64| {
        let mut block = Block::new(law(0.3, 0.2, transition_velocity, max_deformation));
        (block.gravity, block.slope) = (9.81, 20.0);
        let settings = settings(Formulation::Si2, 1e-10, 0.02);
        let end = run(block.model(), &[1.0], &settings, |_| {});
        (place(&end.snapshot()), speed(&end.snapshot()))
    };
    let covers = original(
        JointType::Translational,
        &["TRANSITION_VELOCITY_COEFFICIENT"],
    );
    let case = Case {
        section: Section::Joint,
        id: "9.5",
        model: "a block from rest on 20°, μs 0.3, μd 0.2, (Vs, Dm) = (0.1, 0.01), (0.01, 0.001), (0.001, 1e-5)",
        source: "specification 9.5, the law itself",
        covers: &covers,
    };
    let ours = [(0.1, 0.01), (0.01, 0.001), (0.001, 1e-5)].map(|(vs, dm)| slip(vs, dm));
    let limit = HALVINGS.map(|h| slip(0.02 * h, 2e-3 * h).0);
    let digits = "eight digits are given; the step that leaves the stick regime adds to it";
    check(&[
        case.values(
            "x(1) [m]",
            &ours.map(|o| o.0),
            &[0.681_437_02, 0.748_233_76, 0.755_010_26],
            2e-8,
            digits,
        ),
        case.values(
            "v(1) [m/s]",
            &ours.map(|o| o.1),
            &[1.429_513_38, 1.503_932_74, 1.510_779_89],
            2e-8,
            digits,
        ),
        case.limit(
            "x(1) to exact stick and slip [m]",
            &limit,
            0.755_770_3,
            Rule::Order(1.0),
            LIMIT,
        ),
    ]);
}

/// Pushed along x by a constant force through the guide.
fn pushed(block: &Block, force: f64) -> Builder {
    let mut b = block.builder();
    let axes = axes_with_z(Vector3::x());
    let [i, j] = [Some(0), None].map(|on| b.marker(on, Vector3::zeros(), axes));
    b.force(ForceKind::AlongZ, i, j, Program::constant(force));
    b
}

/// B02b: pushed along a guide that bends, whose overlap stays or grows.
#[test]
fn guides_that_bend() {
    let Some(file) = reference("validation/data/B02_overlap_delta.json") else {
        return;
    };
    let covers = original(
        JointType::Translational,
        &["INITIAL_OVERLAP", "OVERLAP_DELTA", "INPUTS"],
    );
    let mut claims = Vec::new();
    for (name, id, overlap_sign) in [
        ("CONSTANT", "B02b constant", 0.0),
        ("INCREASE", "B02b increase", 1.0),
    ] {
        let at = |k: usize, key: &str| number(&file, &format!("/cases/{name}/{k}/{key}"));
        let times: Vec<f64> = (0..5).map(|k| at(k, "t")).collect();
        let mut errors = Vec::new();
        let mut force = 0.0_f64;
        for h in HALVINGS {
            let mut block = Block::new(law(0.3, 0.25, 5e-3 * h, 5e-4 * h));
            block.slope = 0.0;
            block.bending = 3.0;
            block.load.initial_overlap = 0.5;
            block.load.overlap_sign = overlap_sign;
            let settings = settings(Formulation::Si2, 1e-10, 0.02);
            let (mut k, mut worst) = (0, 0.0_f64);
            run(pushed(&block, 12.0).model, &times, &settings, |s| {
                worst = worst.max((place(s) - at(k, "x")).abs());
                // The friction where it stands: the overlap grows with the displacement.
                let overlap = 0.5 + overlap_sign * place(s);
                let exact = 0.25 * (2.0 * 9.80665 + 3.0 / overlap);
                force = force.max((s.friction(0).force.z + exact).abs());
                k += 1;
            });
            errors.push(worst);
        }
        let case = Case {
            section: Section::Joint,
            id,
            model: "2 kg pushed by 12 N, guide bent by 3 N m over an overlap of 0.5 m, μd 0.25",
            source: "closed form v(x), quadrature t(x)",
            covers: &covers,
        };
        claims.push(case.vanishing("x at five times [m]", &errors, Rule::Order(1.0), LIMIT));
        claims.push(case.worst("friction at x(t) [N]", force, 1e-12, "rounding"));
    }
    check(&claims);
}

/// 9.14: pushed off the axis, so that the push bends the guide; velocity at 0.1 m.
#[test]
fn guides_pushed_off_their_axis() {
    let covers = original(
        JointType::Translational,
        &["INITIAL_OVERLAP", "OVERLAP_DELTA", "BENDING_FACTOR"],
    );
    let mut claims: Vec<Claim> = Vec::new();
    for (id, overlap_sign, exact) in [
        ("9.14 constant", 0.0, 2.051_243_53),
        ("9.14 increase", 1.0, 2.066_670_70),
        ("9.14 decrease", -1.0, 2.024_049_01),
    ] {
        let at_mark = |vs: f64| {
            let mut block = Block::new(law(0.2, 0.2, vs, 1e-2 * vs));
            (block.gravity, block.slope, block.bending) = (9.81, 0.0, 50.0 * 0.1);
            block.load.initial_overlap = 0.25;
            block.load.overlap_sign = overlap_sign;
            speed_at(pushed(&block, 50.0), 0.1)
        };
        let case = Case {
            section: Section::Joint,
            id,
            model: "2 kg pushed by 50 N at 0.1 m from the guide, overlap 0.25 m, μ 0.2",
            source: "specification 9.14, closed form of the work",
            covers: &covers,
        };
        let ours = HALVINGS.map(|h| at_mark(4e-2 * h));
        claims.push(case.limit(
            "v at x = 0.1 m [m/s]",
            &ours,
            exact,
            Rule::Order(2.0),
            "the work below Vs, O(Vs²), is missing",
        ));
    }
    check(&claims);
}

/// Speed where a block passes `mark`: by Newton's iteration for the time, which a run to it each time
/// gives place and speed for.
fn speed_at(b: Builder, mark: f64) -> f64 {
    let settings = settings(Formulation::Si2, 1e-11, 0.02);
    let (mut time, mut at) = (0.1, 0.0);
    for _ in 0..6 {
        let end = run(b.model.clone(), &[time], &settings, |_| {});
        at = speed(&end.snapshot());
        let step = (mark - place(&end.snapshot())) / at;
        time += step;
        if step.abs() < 1e-12 {
            break;
        }
    }
    at
}
