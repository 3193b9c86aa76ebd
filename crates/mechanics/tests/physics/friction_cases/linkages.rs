//! Friction in loops: slider-crank (C01a) and four-bar (C02a).

use friction::LuGre;
use friction::parameters::JointType;
use mechanics::model::Model;
use mechanics::{Formulation, Owner};
use serde_json::Value;
use verification::{Case, Claim, Rule, Section, check};

use super::{HALVINGS, TURNS, lugre, original};
use crate::runs::{Sample, every, run, settings, turned, turning_points};
use crate::shared::{number, reference, table};
use mechanisms::builder::Builder;
use mechanisms::{bristles, driven_slider_crank, four_bar, law, slider_crank};

/// Turning points of the crank (body 0) that starts at `start`, and its last angle.
fn crank(model: Model, start: f64, end: f64) -> (Vec<(f64, f64)>, f64) {
    crank_at(model, start, end, 1e-9)
}

/// The same at an ERROR.
fn crank_at(model: Model, start: f64, end: f64, error: f64) -> (Vec<(f64, f64)>, f64) {
    let mut samples = Vec::new();
    let mut angle = start;
    let mut last = 0.0;
    let outputs = every(end, (end * 2000.0) as usize);
    run(
        model,
        &outputs,
        &settings(Formulation::Si2, error, 0.01),
        |s| {
            let m = s.rotation(0);
            let now: f64 = m[(1, 0)].atan2(m[(0, 0)]);
            let step = now - last;
            angle += step - std::f64::consts::TAU * (step / std::f64::consts::TAU).round();
            last = now;
            let rate = s.state().velocities()[5];
            samples.push(Sample {
                time: s.time(),
                value: angle,
                rate,
            });
        },
    );
    (turning_points(&samples), angle)
}

/// Turns and the angle at rest; `slow` is the largest Vs for each.
fn study(
    case: &Case<'_>,
    exact: &Value,
    end: f64,
    turns: usize,
    slow: [f64; 2],
    model: impl Fn(f64) -> Model,
) -> Vec<Claim> {
    let start = number(exact, "/params/theta0");
    let last = exact["turning"].as_array().expect("a list").len() - 1;
    let at = |n: usize, key: &str| number(exact, &format!("/turning/{n}/{key}"));
    let after = at(turns - 1, "t") + 0.05;
    let runs = HALVINGS.map(|h| crank(model(slow[0] * h), start, after).0);
    let rest = HALVINGS.map(|h| crank(model(slow[1] * h), start, end).1);
    let rule = Rule::AtLeastOrder(1.0);
    let mut claims = Vec::new();
    for n in 0..turns {
        let angles = runs.each_ref().map(|t| t[n].1);
        let times = runs.each_ref().map(|t| t[n].0);
        let quantity = format!("angle of turn {} [rad]", n + 1);
        claims.push(case.limit(&quantity, &angles, at(n, "theta"), rule, TURNS));
        let quantity = format!("time of turn {} [s]", n + 1);
        claims.push(case.limit(&quantity, &times, at(n, "t"), rule, TURNS));
    }
    let quantity = format!("angle at rest, Vs from {} mm/s [rad]", 1e3 * slow[1]);
    claims.push(case.limit(&quantity, &rest, at(last, "theta"), rule, TURNS));
    claims
}

const SOURCE: &str = "exact stick and slip with every event located, Runge–Kutta 1e-12";

#[test]
fn slider_crank_with_friction_in_its_guide() {
    let Some(file) = reference("validation/data/C01_C02_mechanisms.json") else {
        return;
    };
    let case = Case {
        section: Section::Mechanism,
        id: "C01a",
        model: "crank 0.1 m, rod 0.3 m, slider; 1, 1.5, 2 kg; μs 0.25, μd 0.2 in the guide, from 20 rad/s; Vs from 80 mm/s",
        source: SOURCE,
        covers: &original(JointType::Translational, &["INPUTS"]),
    };
    let exact = &file["cases"]["C01a_slider_only"];
    check(&study(&case, exact, 2.2, 2, [8e-2, 4e-2], |vs| {
        slider_crank(Some(law(0.25, 0.2, vs, 1e-2 * vs)))
    }));
}

#[test]
fn four_bar_with_friction_in_its_pins() {
    let Some(file) = reference("validation/data/C01_C02_mechanisms.json") else {
        return;
    };
    let case = Case {
        section: Section::Mechanism,
        id: "C02a",
        model: "four-bar 0.1, 0.35, 0.3, 0.4 m; 1, 3.5, 3 kg; four pins of 15 mm, μs 0.25, μd 0.2, from 20 rad/s; Vs from 8 mm/s",
        source: SOURCE,
        covers: &original(JointType::Revolute, &["PIN_RADIUS", "INPUTS"]),
    };
    let exact = &file["cases"]["C02a_fourbar_pins"];
    check(&study(&case, exact, 3.2, 4, [8e-3, 1e-3], |vs| {
        four_bar(Some(law(0.25, 0.2, vs, 1e-2 * vs)))
    }));
}

/// C01d: the torque that keeps the crank at 30 rad/s, without integration of its motion.
#[test]
fn torque_of_a_crank_at_constant_speed() {
    let Some(rows) =
        reference_data::path("validation/data/C01d_inverse_dynamics_30radps.csv").map(table)
    else {
        return;
    };
    // The crank starts at 0.5 rad.
    let full = std::f64::consts::TAU;
    let mut times: Vec<(f64, &Vec<f64>)> = rows
        .iter()
        .map(|row| ((row[0] - 0.5).rem_euclid(full) / 30.0, row))
        .collect();
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    let outputs: Vec<f64> = times.iter().map(|(time, _)| *time).collect();
    let torques = |law| {
        let mut torques = Vec::new();
        let settings = settings(Formulation::Si2, 1e-9, 1e-3);
        run(driven_slider_crank(law), &outputs, &settings, |s| {
            torques.push(s.reaction(Owner::Motion(0)).torque.z);
        });
        torques
    };
    let work = |law| {
        let settings = settings(Formulation::Si2, 1e-9, 1e-5);
        let end = run(driven_slider_crank(law), &[full / 30.0], &settings, |_| {});
        *end.state().works().last().expect("the work of motions")
    };
    let column = |k: usize| times.iter().map(|(_, row)| row[k]).collect::<Vec<f64>>();
    let law = law(0.25, 0.2, 1e-5, 1e-7);
    let (with, without) = (torques(Some(law)), torques(None));
    let covers = [
        original(JointType::Translational, &["INPUTS"]),
        original(JointType::Revolute, &["PIN_RADIUS", "INPUTS"]),
    ]
    .concat();
    let case = Case {
        section: Section::Mechanism,
        id: "C01d",
        model: "the slider-crank of C01 at 30 rad/s, μ 0.2 in the guide and in its pins of 15 mm",
        source: "Newton and Euler's equations with friction of the same reactions, 1e-13",
        covers: &covers,
    };
    let exact = column(1);
    let why = "the position of the crank is prescribed: the solver's equations at an instant";
    let works = "the power jumps where a joint turns back, within a step of 10 µs";
    check(&[
        case.values("drive torque at 24 angles [N m]", &with, &exact, 1e-8, why),
        case.values(
            "the same without friction [N m]",
            &without,
            &column(2),
            1e-8,
            why,
        ),
        case.values(
            "work of a turn, with and without friction [J]",
            &[work(Some(law)), work(None)],
            &[12.252_386_296_5, 0.0],
            5e-4,
            works,
        ),
    ]);
}

/// C02b: without weight the path does not depend on the speed: three times as fast, a third of the time.
#[test]
fn four_bar_without_weight_scales_with_its_speed() {
    let angles = |faster: f64| {
        let vs = 1e-3 * faster;
        let mut b = Builder {
            model: four_bar(Some(law(0.25, 0.2, vs, 1e-5))),
        };
        b.model.gravity.fill(0.0);
        b.start_turning(0, 20.0 * faster);
        let mut angles = Vec::new();
        // Unwrapped by hand: it turns less than half a turn between outputs.
        let settings = settings(Formulation::Si2, 1e-11, 0.01 / faster);
        run(
            b.model,
            &[0.1, 0.25, 0.5, 1.0].map(|t| t / faster),
            &settings,
            |s| {
                angles.push(turned(s, 0));
            },
        );
        angles
    };
    let case = Case {
        section: Section::Mechanism,
        id: "C02b",
        model: "the four-bar of C02 without weight, at 20 and 60 rad/s, Vs 1 and 3 mm/s",
        source: "scaling of time: Coulomb friction and inertia forces both go with the speed squared",
        covers: &original(JointType::Revolute, &["PIN_RADIUS"]),
    };
    check(&[case.values(
        "angle of the crank at 0.1, 0.25, 0.5, 1 s and at a third of these, within a turn [rad]",
        &angles(3.0),
        &angles(1.0),
        1e-8,
        "other steps at the start; the error of a step is 1e-11",
    )]);
}

/// C01a with bristles from soft to nearly rigid: the load of the guide passes zero and changes sides.
#[test]
fn slider_crank_with_bristles_in_its_guide() {
    let Some(file) = reference("validation/data/C01_C02_mechanisms.json") else {
        return;
    };
    let first_turn = |stiffness: f64, error: f64| {
        let bristles = LuGre {
            bristle_stiffness: stiffness,
            damping: 100.0,
            ..bristles(0.25, 0.2)
        };
        let mut model = slider_crank(Some(law(0.25, 0.2, 1e-2, 1e-4)));
        model.frictions[0].law = bristles.into();
        crank_at(model, 0.5, 1.1, error).0[0]
    };
    let at = |key: &str| number(&file, &format!("/cases/C01a_slider_only/turning/0/{key}"));
    let case = Case {
        section: Section::Mechanism,
        id: "C01a bristles",
        model: "the slider-crank of C01a on bristles, s1 100 N s/m, vs 1 mm/s; s0 from 1e5 N/m, doubled three times, and 1e9",
        source: SOURCE,
        covers: &lugre(JointType::Translational, &["INPUTS"]),
    };
    let turns = HALVINGS.map(|h| first_turn(1e5 / h, 1e-9));
    // Below this ERROR a third of the runs on bristles so stiff are off by up to 7e-5.
    let stiff = first_turn(1e9, 1e-8);
    let soft = "the bristles give way by 1/s0";
    let rigid = "what is left of vs";
    check(&[
        case.limit(
            "time of turn 1 [s]",
            &turns.map(|t| t.0),
            at("t"),
            Rule::Order(1.0),
            soft,
        ),
        case.limit(
            "angle of turn 1 [rad]",
            &turns.map(|t| t.1),
            at("theta"),
            Rule::Order(1.0),
            soft,
        ),
        case.values(
            "time of turn 1, s0 1e9 [s]",
            &[stiff.0],
            &[at("t")],
            1e-5,
            rigid,
        ),
        case.values(
            "angle of turn 1, s0 1e9 [rad]",
            &[stiff.1],
            &[at("theta")],
            1e-5,
            rigid,
        ),
    ]);
    // Soft bristles let it swing: no reference, but no failure.
    assert!(first_turn(1e2, 1e-9).1 < at("theta"));
}
