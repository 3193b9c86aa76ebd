//! Blocks on springs and belts (9.7, 9.10, C03).

use friction::parameters::JointType;
use mechanics::Formulation;
use mechanics::model::Model;
use nalgebra::Matrix3;
use verification::{Case, Rule, Section, check};

use super::{HALVINGS, LIMIT, TURNS, original};
use crate::runs::{Sample, every, run, settings, turning_points};
use crate::shared::{number, reference, table};
use mechanisms::builder::v;
use mechanisms::sliding::{Block, place, speed};
use mechanisms::{Belt, law};

/// 9.7: mass on a spring, `μ_s = μ_d`: the amplitude falls by `2 μ m g / k` each half swing.
#[test]
fn spring_and_mass() {
    let turns = HALVINGS.map(|h| {
        let mut block = Block::new(law(0.2, 0.2, 2e-3 * h, 2e-5 * h));
        (block.mass, block.gravity, block.slope) = (1.0, 9.81, 0.0);
        let mut b = block.builder();
        // A spring as long as wanted, so that its force is that of its stretch along x.
        let axes = Matrix3::identity();
        let i = b.marker(Some(0), v(0.0, 0.0, 0.0), axes);
        let j = b.marker(None, v(-1.0, 0.0, 0.0), axes);
        b.spring(i, j, 100.0, 0.9);
        let mut samples = Vec::new();
        run(
            b.model,
            &every(0.9, 18_000),
            &settings(Formulation::Si2, 1e-11, 0.01),
            |s| {
                samples.push(Sample {
                    time: s.time(),
                    value: place(s) + 0.1,
                    rate: speed(s),
                });
            },
        );
        turning_points(&samples)
    });
    let covers = original(JointType::Translational, &[]);
    let case = Case {
        section: Section::Joint,
        id: "9.7",
        model: "1 kg on a spring of 100 N/m, stretched by 0.1 m, μs = μd = 0.2, Vs from 2 mm/s",
        source: "closed form, decrement 2 μ m g/k each half swing of π √(m/k)",
        covers: &covers,
    };
    let time = 2.0 * std::f64::consts::PI / 10.0;
    check(&[
        case.limit(
            "x of turn 1 [m]",
            &turns.each_ref().map(|t| t[0].1),
            -0.060_76,
            Rule::AtLeastOrder(1.0),
            TURNS,
        ),
        case.limit(
            "x of turn 2 [m]",
            &turns.each_ref().map(|t| t[1].1),
            0.021_52,
            Rule::AtLeastOrder(1.0),
            TURNS,
        ),
        case.limit(
            "time of turn 2 [s]",
            &turns.each_ref().map(|t| t[1].0),
            time,
            Rule::Order(1.0),
            LIMIT,
        ),
    ]);
}

/// Place and speed of the block at equal intervals.
fn samples(model: Model, end: f64, count: usize, error: f64) -> Vec<Sample> {
    let mut samples = Vec::new();
    let settings = settings(Formulation::Si2, error, 0.01);
    run(model, &every(end, count), &settings, |s| {
        samples.push(Sample {
            time: s.time(),
            value: place(s),
            rate: speed(s),
        });
    });
    samples
}

/// 9.10: the period of stick and slip with this very law.
#[test]
fn belt_with_the_law_itself() {
    let periods = [(1e-2, 1e-3), (1e-3, 1e-4), (1e-4, 1e-5)].map(|(vs, dm)| {
        let belt = Belt {
            mass: 1.0,
            gravity: 9.81,
            stiffness: 100.0,
            speed: 0.1,
            start: 0.1,
        };
        // Every second turn is a farthest point; the first cycle starts otherwise.
        let samples = samples(belt.model(law(0.3, 0.2, vs, dm)), 4.0, 8000, 1e-9);
        let turns = turning_points(&samples);
        turns[6].0 - turns[4].0
    });
    let covers = original(
        JointType::Translational,
        &["TRANSITION_VELOCITY_COEFFICIENT"],
    );
    let case = Case {
        section: Section::Joint,
        id: "9.10",
        model: "1 kg on a belt of 0.1 m/s, spring 100 N/m, μs 0.3, μd 0.2, Vs 1e-2, 1e-3, 1e-4 m/s",
        source: "specification 9.10, the law itself",
        covers: &covers,
    };
    check(&[case.values(
        "period [s]",
        &periods,
        &[0.703_075, 0.677_820, 0.671_488],
        2e-6,
        "six digits are given",
    )]);
}

/// C03: period, farthest points and speed of stick and slip.
#[test]
fn belt_with_stick_and_slip() {
    let Some(file) = reference("validation/data/C03_C04_C05.json") else {
        return;
    };
    let of = |key: &str| number(&file, &format!("/cases/C03_m1_k20_vb0.1_mu0.15_0.10/{key}"));
    let belt = Belt {
        mass: 1.0,
        gravity: 9.81,
        stiffness: 20.0,
        speed: 0.1,
        start: 0.0,
    };
    let runs = HALVINGS.map(|h| {
        let vs = 4e-4 * h;
        let samples = samples(
            belt.model(law(0.15, 0.10, vs, 1e-2 * vs)),
            5.0,
            20_000,
            1e-10,
        );
        let turns = turning_points(&samples);
        let slowest = samples.iter().fold(0.0_f64, |m, s| m.min(s.rate));
        // Farthest points of the second and third cycle, and the nearest between.
        (turns[4].0 - turns[2].0, turns[2].1, turns[3].1, slowest)
    });
    let covers = original(JointType::Translational, &[]);
    let case = Case {
        section: Section::Mechanism,
        id: "C03",
        model: "1 kg on a belt of 0.1 m/s, spring 20 N/m, μs 0.15, μd 0.1; Vs from 0.4 mm/s",
        source: "closed form of exact stick and slip",
        covers: &covers,
    };
    let why = "between Vs^0.5 and Vs^0.6 at break-away, as the reference observes";
    let rule = Rule::AtLeastOrder(0.5);
    check(&[
        case.limit("period [s]", &runs.map(|r| r.0), of("period"), rule, why),
        case.limit("largest x [m]", &runs.map(|r| r.1), of("x_max"), rule, why),
        case.limit("smallest x [m]", &runs.map(|r| r.2), of("x_min"), rule, why),
        case.limit(
            "smallest v [m/s]",
            &runs.map(|r| r.3),
            of("v_min"),
            rule,
            why,
        ),
    ]);
}

/// A12d: how far the law itself is from exact stick and slip on the belt of C03.
#[test]
fn belt_against_exact_stick_and_slip() {
    let Some(file) = reference("validation/data/A12_original_law.json") else {
        return;
    };
    let Some(exact) = reference_data::path("validation/data/C03_belt_m1_k20.csv").map(table) else {
        return;
    };
    let belt = Belt {
        mass: 1.0,
        gravity: 9.81,
        stiffness: 20.0,
        speed: 0.1,
        start: 0.0,
    };
    let times: Vec<f64> = exact[1..].iter().map(|row| row[0]).collect();
    let levels = ["0.002", "0.001", "0.0005"];
    let farthest = [2e-3, 1e-3, 5e-4].map(|vs| {
        let settings = settings(Formulation::Si2, 1e-10, 0.01);
        let (mut row, mut largest) = (1, 0.0_f64);
        run(
            belt.model(law(0.15, 0.1, vs, 0.1 * vs)),
            &times,
            &settings,
            |s| {
                largest = largest.max((place(s) - exact[row][1]).abs());
                row += 1;
            },
        );
        largest
    });
    let case = Case {
        section: Section::Mechanism,
        id: "A12d",
        model: "1 kg on a belt of 0.1 m/s, spring 20 N/m, μs 0.15, μd 0.1, 5 s; Vs from 2 mm/s, Dm = 0.1 s Vs",
        source: "the law itself and exact stick and slip, 50 instants",
        covers: &[],
    };
    check(&[case.values(
        "largest distance from exact stick and slip [m]",
        &farthest,
        &levels.map(|vs| number(&file, &format!("/cases/d_belt/max_dev/{vs}"))),
        2e-7,
        "how the displacement within the step that enters the stick regime counts as creep is ours",
    )]);
}

/// C03: a belt so fast that the block never sticks.
#[test]
fn fast_belt() {
    let belt = Belt {
        mass: 3.0,
        gravity: 9.80665,
        stiffness: 1000.0,
        speed: 0.5,
        start: 0.0,
    };
    let samples = samples(belt.model(law(0.4, 0.3, 1e-3, 1e-5)), 2.0, 400, 1e-10);
    let (middle, rate) = (0.3 * 3.0 * 9.80665 / 1000.0, (1000.0_f64 / 3.0).sqrt());
    let errors = samples
        .iter()
        .map(|s| (s.value - middle * (1.0 - (rate * s.time).cos())).abs());
    let case = Case {
        section: Section::Mechanism,
        id: "C03 fast",
        model: "3 kg on a belt of 0.5 m/s, spring 1000 N/m, μs 0.4, μd 0.3: it never sticks",
        source: "closed form x = xd (1 − cos ωt)",
        covers: &original(JointType::Translational, &[]),
    };
    check(&[case.worst(
        "x over 2 s [m]",
        errors.fold(0.0, f64::max),
        1e-8,
        "steps of an error of 1e-10, some hundred of them",
    )]);
}

/// A12c: a mass pulled by a spring whose end runs away, seen from that end: a belt.
#[test]
fn mass_pulled_by_a_spring() {
    let Some(file) = reference("validation/data/A12_original_law.json") else {
        return;
    };
    let of = |key: &str| number(&file, &format!("/cases/c_rabinowicz/{key}"));
    let belt = Belt {
        mass: 1.0,
        gravity: 10.0,
        stiffness: 2.0,
        speed: 0.1,
        start: 0.1,
    };
    let ends = [2e-3, 1e-3, 5e-4, 2.5e-4].map(|vs| {
        let settings = settings(Formulation::Si2, 1e-10, 0.01);
        let model = belt.model(law(0.15, 0.1, vs, 0.1 * vs));
        let end = run(model, &[20.0], &settings, |_| {});
        0.1 * 20.0 - place(&end.snapshot())
    });
    let case = Case {
        section: Section::Mechanism,
        id: "A12c",
        model: "1 kg pulled at 0.1 m/s by a spring of 2 N/m under 10 N, μs 0.15, μd 0.1; Vs from 2 mm/s, Dm = 0.1 s Vs",
        source: "the law itself, integrated to 1e-9; exact stick and slip",
        covers: &original(
            JointType::Translational,
            &["TRANSITION_VELOCITY_COEFFICIENT"],
        ),
    };
    check(&[
        case.values(
            "x(20) at the first Vs [m]",
            &ends[..1],
            &[of("x_orig_20")],
            1e-6,
            "errors of a step of 1e-10, some thousand of them, and the break-aways magnify them",
        ),
        case.limit(
            "x(20) [m]",
            &ends,
            of("x_exact_20"),
            Rule::AtLeastOrder(0.5),
            "between Vs^0.5 and Vs^0.6 at break-away, as the reference observes",
        ),
    ]);
}

/// Stick and slip on a belt, at errors of a step of 1e-7 and 1e-8: what the run is off by follows them,
/// though the law bends where stick begins and where it breaks away.
#[test]
fn sticks_and_slips_are_as_accurate_as_steps() {
    let belt = Belt {
        mass: 1.0,
        gravity: 9.81,
        stiffness: 20.0,
        speed: 0.1,
        start: 0.1,
    };
    let model = belt.model(law(0.25, 0.2, 1.7e-3, 1.7e-5));
    let length = mechanics::Simulation::new(model.clone(), 1.0)
        .system()
        .length_scale();
    let outputs: Vec<f64> = (1..=10).map(|k| 0.5 * f64::from(k)).collect();
    let places = |formulation, error| {
        let mut places = Vec::new();
        let settings = settings(formulation, error, 0.1);
        run(model.clone(), &outputs, &settings, |s| {
            places.push(place(s));
        });
        places
    };
    let exact = places(Formulation::Adams, 1e-11);
    for formulation in [Formulation::Si2, Formulation::I3, Formulation::Adams] {
        for error in [1e-7, 1e-8] {
            let places = places(formulation, error);
            let pairs = places.iter().zip(&exact);
            let off = pairs.fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())) / length;
            println!("{formulation:?}, {error:e}: {:.0} errors", off / error);
            // Some hundred steps, of which the breaks magnify those before them about five times. Where
            // a bend is not seen it is several thousand.
            assert!(off < 1500.0 * error, "{formulation:?}: {off:e}");
        }
    }
}
