//! Frictionless mechanisms: end values, energy, redundant equations (validation cases D).

use mechanics::model::Model;
use mechanics::{Formulation, Owner, Settings, Simulation};
use nalgebra::Vector3;
use verification::{Case, Rule, Section, check};

use crate::runs::{angular_velocity, assembled, energy, every, go_on, run, settings, turned};
use crate::shared::{number, numbers, reference};
use mechanisms::builder::v;
use mechanisms::{
    andrews, body_angles, bricard, four_bar, four_bar_chain, free_body, pendulum, slider_crank, top,
};

/// Period of the pendulum of 1 m from the horizontal, g = 9.81: `4 K(sin 45°) / √g`.
const PENDULUM_PERIOD: f64 = 2.367_841_947_576_237_3;

/// Why errors at tolerances that fall by a factor of 100 each must fall too.
const FALLS: &str = "the error of a step is controlled, so that the global error of order 5 falls as \
                     tolerance^(5/6), by 46; five leaves room for the orders in between";

fn case<'a>(id: &'a str, model: &'a str, source: &'a str) -> Case<'a> {
    Case {
        section: Section::Frictionless,
        id,
        model,
        source,
        covers: &[],
    }
}

/// Runs to `end` and returns the simulation with the largest relative change of energy at 40
/// outputs.
fn watched(model: Model, end: f64, settings: &Settings) -> (Simulation, f64) {
    let start = energy(&assembled(model.clone()).snapshot());
    let scale = start.abs().max(1.0);
    let mut drift = 0.0_f64;
    let simulation = run(model, &every(end, 40), settings, |snapshot| {
        drift = drift.max((energy(snapshot) - start).abs() / scale);
    });
    (simulation, drift)
}

#[test]
fn pendulum_keeps_its_period_and_meets_the_elliptic_functions() {
    let exact = v(-0.275_087_462_576_116_9, -0.961_419_205_099_125, 0.0);
    for (formulation, id) in [(Formulation::I3, "D05 I3"), (Formulation::Si2, "D05 SI2")] {
        let [mut errors, mut drifts] = [const { Vec::new() }; 2];
        for tolerance in [1e-5, 1e-7, 1e-9, 1e-11] {
            let settings = settings(formulation, tolerance, 0.1);
            let period = run(pendulum(), &[PENDULUM_PERIOD], &settings, |_| {});
            let back = (period.state().centre(0) - v(-1.0, 0.0, 0.0)).norm();
            let (simulation, drift) = watched(pendulum(), 10.0, &settings);
            errors.push(back.max((simulation.state().centre(0) - exact).norm()));
            drifts.push(drift);
        }
        let case = case(
            id,
            "point pendulum of 1 m from the horizontal (IFToMM A01); error tolerances 1e-5 to 1e-11",
            "elliptic functions",
        );
        let rule = Rule::Falling(1e-6);
        check(&[
            case.vanishing("place after a period and at 10 s [m]", &errors, rule, FALLS),
            case.vanishing("energy over 10 s, relative", &drifts, rule, FALLS),
        ]);
    }
}

#[test]
fn four_bar_chains_pass_their_singular_positions() {
    let Some(file) = reference("validation/data/D05_D06_benchmarks.json") else {
        return;
    };
    let both = [Formulation::Si2, Formulation::I3];
    for (loops, name, ids) in [
        (2, "A02_N2", ["D06 N = 2, SI2", "D06 N = 2, I3"]),
        (40, "A02_N40", ["D06 N = 40, SI2", "D06 N = 40, I3"]),
    ] {
        let mut simulation = Simulation::new(four_bar_chain(loops), 1.0);
        let assembly = simulation.assemble().expect("the chain assembles");
        assert_eq!(assembly.redundant.len(), 3 * loops);
        assert_eq!(simulation.system().degrees_of_freedom(), 1);
        simulation.solve_instant().expect("unique");
        let start = energy(&simulation.snapshot());
        let expected = number(&file, &format!("/cases/{name}/energy0"));
        assert!(
            (start - expected).abs() < 1e-9 * expected,
            "{start} {expected}"
        );
        for (formulation, id) in both.into_iter().zip(ids) {
            let [mut errors, mut drifts] = [const { Vec::new() }; 2];
            for tolerance in [1e-6, 1e-8] {
                let settings = settings(formulation, tolerance, 0.05);
                let mut at = simulation.clone();
                let mut drift = 0.0_f64;
                go_on(&mut at, &every(10.0, 40), &settings, |s| {
                    drift = drift.max((energy(s) - start).abs() / start);
                });
                let centre = at.state().centre(0);
                let x = number(&file, &format!("/cases/{name}/xB0_10"));
                let y = number(&file, &format!("/cases/{name}/yB0_10"));
                let error = (2.0 * centre - v(x, y, 0.0)).norm();
                errors.push(error);
                drifts.push(drift);
            }
            let case = case(
                id,
                "N four-bars of rods of 1 m, all joints revolute (IFToMM A02), five turns through \
                 ten singular positions; error tolerances 1e-6, 1e-8",
                "one equation of motion, integrated to 1e-13; Exudyn and Adams agree",
            );
            let why = "the last tolerance; an error of the phase may change its sign from one tolerance \
                       to the next, so that it need not fall where the energy does";
            let place = &errors[1..];
            let below = Rule::Below(5e-4);
            check(&[
                case.vanishing("place of the upright at 10 s [m]", place, below, why),
                case.vanishing(
                    "energy over 10 s, relative",
                    &drifts,
                    Rule::Falling(5e-4),
                    FALLS,
                ),
            ]);
        }
    }
}

#[test]
fn bricard_moves_with_one_redundant_equation() {
    let Some(file) = reference("validation/data/D07_bricard_ssc.json") else {
        return;
    };
    let mut simulation = Simulation::new(bricard(), 1.0);
    let assembly = simulation.assemble().expect("it assembles");
    assert_eq!(assembly.redundant.len(), 1, "{:?}", assembly.redundant);
    simulation.solve_instant().expect("unique");
    let [mut errors, mut drifts] = [const { Vec::new() }; 2];
    for tolerance in [1e-6, 1e-8, 1e-10] {
        let settings = settings(Formulation::Si2, tolerance, 0.05);
        let mut at = simulation.clone();
        let start = energy(&at.snapshot());
        let (mut drift, mut worst) = (0.0_f64, 0.0_f64);
        for (end, pointer) in [(1.0, "P3_1s"), (5.0, "P3_5s"), (10.0, "P3_10s")] {
            let begin = at.state().time;
            let outputs: Vec<f64> = every(end - begin, 20)
                .into_iter()
                .map(|t| begin + t)
                .collect();
            go_on(&mut at, &outputs, &settings, |s| {
                drift = drift.max((energy(s) - start).abs());
            });
            let snapshot = at.snapshot();
            let tip = snapshot.part(2).origin + snapshot.rotation(2) * v(0.0, 0.0, 0.5);
            let exact = numbers(&file, &format!("/cases/A04_slender/{pointer}"));
            let error = (tip - Vector3::from_column_slice(&exact)).norm();
            worst = worst.max(error);
        }
        errors.push(worst);
        drifts.push(drift);
    }
    let case = case(
        "D07",
        "Bricard's mechanism of thin rods, one redundant equation (IFToMM A04); error tolerances \
         1e-6 to 1e-10",
        "integrated to 1e-12 with all 30 equations",
    );
    let rule = Rule::Falling(1e-8);
    check(&[
        case.vanishing("P3 at 1, 5 and 10 s, worst [m]", &errors, rule, FALLS),
        case.vanishing("energy over 10 s [J]", &drifts, Rule::Falling(1e-7), FALLS),
    ]);
}

#[test]
fn tops_turn_as_their_closed_forms() {
    let mut errors = [const { Vec::new() }; 3];
    for tolerance in [1e-6, 1e-8, 1e-10] {
        let settings = settings(Formulation::Si2, tolerance, 0.1);
        let body_rates =
            |s: &Simulation| s.state().orientation(0).matrix().transpose() * angular_velocity(s, 0);
        // a: ω₁ + iω₂ turns at (I₃ − I₁)/I₁ ω₃ = 1.5.
        let model = free_body([1.0, 1.0, 2.0], v(0.1, 0.0, 1.5));
        let (a, _) = watched(model, 10.0, &settings);
        let exact = v(0.1 * 15.0_f64.cos(), 0.1 * 15.0_f64.sin(), 1.5);
        errors[0].push((body_rates(&a) - exact).norm());
        // b: period of the elliptic functions.
        let rates = v(0.01, 2.0, 0.02);
        let model = free_body([1.0, 2.0, 3.0], rates);
        let (b, _) = watched(model, 19.001_635_511_000_25, &settings);
        errors[1].push((body_rates(&b) - rates).norm());
        // c: ten nutations later the axis has the same tilt, ten steps of precession on.
        let (c, _) = watched(top(), 10.0 * 0.292_029_523_143_378, &settings);
        let turned = 10.0 * 0.615_137_203_969_709_8_f64;
        let tilt = std::f64::consts::FRAC_PI_6;
        let exact = v(
            tilt.sin() * turned.cos(),
            tilt.sin() * turned.sin(),
            tilt.cos(),
        );
        errors[2].push((c.state().centre(0) - 0.1 * exact).norm() / 0.1);
    }
    let source = "closed form";
    let free = case(
        "D08a",
        "free symmetric body, 1, 1, 2 kg m²; error tolerances 1e-6 to 1e-10",
        source,
    );
    let unstable = case(
        "D08b",
        "free body turning about its unstable axis, 1, 2, 3 kg m² (Dzhanibekov); error tolerances \
         1e-6 to 1e-10",
        source,
    );
    let heavy = case(
        "D08c",
        "heavy top at 100 rad/s; error tolerance 1e-10",
        source,
    );
    check(&[
        free.vanishing(
            "rates at 10 s [rad/s]",
            &errors[0],
            Rule::Falling(1e-6),
            FALLS,
        ),
        unstable.vanishing(
            "rates after a period [rad/s]",
            &errors[1],
            Rule::Falling(2e-5),
            FALLS,
        ),
        heavy.worst(
            "axis after ten nutations, of one",
            errors[2][2],
            1e-6,
            "the phase of 3 s at 100 rad/s",
        ),
    ]);
}

/// Largest errors of angles (relative), rates and reactions (of the largest) of Andrews' mechanism,
/// given the published coordinates, rates and multipliers where there are any.
fn andrews_errors(settings: &Settings, end: f64, [q, rates, forces]: [&[f64]; 3]) -> [f64; 3] {
    let system = andrews();
    let mut simulation = Simulation::new(system.model, 1.0);
    let assembly = simulation.assemble().expect("it assembles");
    assert_eq!(assembly.redundant.len(), 9);
    simulation.solve_instant().expect("unique");
    go_on(&mut simulation, &[end], settings, |_| {});
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let (angles, exact_rates) = (body_angles(q), body_angles(rates));
    let mut errors = [0.0_f64; 3];
    for body in 0..7 {
        let turn = simulation.state().orientation(body).matrix();
        let angle = system.angles[body] + turn[(1, 0)].atan2(turn[(0, 0)]);
        let difference = angle - angles[body];
        let turns = (difference / std::f64::consts::TAU).round();
        let error = (difference - std::f64::consts::TAU * turns).abs();
        errors[0] = errors[0].max(error / angles[body].abs().max(1.0));
        let rate = angular_velocity(&simulation, body).z;
        errors[1] = errors[1].max((rate - exact_rates[body]).abs() / largest(rates));
    }
    for (joint, force) in system.closing.into_iter().zip(forces.chunks_exact(2)) {
        let reaction = simulation.snapshot().reaction(Owner::Joint(joint)).force;
        let error = (reaction - v(force[0], force[1], 0.0)).norm();
        errors[2] = errors[2].max(error / largest(forces));
    }
    errors
}

#[test]
fn andrews_mechanism_meets_the_published_end_values() {
    let Some(file) = reference("validation/published/ivp_testset_reference.json") else {
        return;
    };
    let [q, rates, forces] =
        ["q", "qdot", "lam"].map(|key| numbers(&file, &format!("/andrews/{key}")));
    let model = "Andrews' squeezing mechanism, nine redundant equations";
    // Observed 3.4e-9 and 5.0e-9 with SI2, 7.8e-8 and 1.1e-7 with I3, whose tolerance holds for
    // positions only.
    // Beyond the last of each it is rounding that is left.
    for (formulation, id, bound, tolerances) in [
        (Formulation::Si2, "D01 SI2", 1e-7, [1e-4, 1e-6, 1e-8]),
        (Formulation::I3, "D01 I3", 1e-6, [1e-6, 1e-8, 1e-10]),
    ] {
        let mut all = [const { Vec::new() }; 3];
        for tolerance in tolerances {
            let settings = settings(formulation, tolerance, 1e-3);
            let errors = andrews_errors(&settings, 0.03, [&q, &rates, &forces]);
            for (all, error) in all.iter_mut().zip(errors) {
                all.push(error);
            }
        }
        let model = format!("{model}; error tolerances {tolerances:?}");
        let case = case(id, &model, "IVP test set, published to 16 digits");
        let rule = Rule::Falling(bound);
        check(&[
            case.vanishing("angles at 0.03 s, relative", &all[0], rule, FALLS),
            case.vanishing("rates at 0.03 s, of the largest", &all[1], rule, FALLS),
            case.worst(
                "reactions at 0.03 s, of the largest",
                all[2][2],
                1e-6,
                "the published reactions are good to about 7e-8",
            ),
        ]);
    }
    let Some(file) = reference("validation/data/D01_D03_ivp_testset.json") else {
        return;
    };
    let [q, rates] = ["q_005", "v_005"].map(|key| numbers(&file, &format!("/andrews/{key}")));
    let settings = settings(Formulation::Si2, 1e-11, 1e-3);
    let errors = andrews_errors(&settings, 0.05, [&q, &rates, &[]]);
    let case = case("D01 on", model, "integrated to 1e-13");
    let why = "fifty thousandths of a second at 1000 rad/s and an error of 1e-11 a step";
    check(&[case.worst("angles at 0.05 s, relative", errors[0], 1e-7, why)]);
}

#[test]
fn linkages_without_friction_meet_the_reference() {
    let Some(file) = reference("validation/data/C01_C02_mechanisms.json") else {
        return;
    };
    let cases = [
        ("C01", "C01 without friction", slider_crank(None), 0.5),
        ("C02", "C02 without friction", four_bar(None), 0.3),
    ];
    for (name, id, model, angle) in cases {
        let exact = number(&file, &format!("/cases/{name}_frictionless/theta2"));
        let exact_rate = number(&file, &format!("/cases/{name}_frictionless/omega2"));
        let [mut errors, mut rates, mut drifts] = [const { Vec::new() }; 3];
        for tolerance in [1e-7, 1e-9, 1e-11] {
            let settings = settings(Formulation::Si2, tolerance, 0.02);
            let (simulation, drift) = watched(model.clone(), 2.0, &settings);
            let error = angle + turned(&simulation.snapshot(), 0) - exact;
            let turns = (error / std::f64::consts::TAU).round();
            errors.push((error - std::f64::consts::TAU * turns).abs());
            rates.push((angular_velocity(&simulation, 0).z - exact_rate).abs() / exact_rate);
            drifts.push(drift);
        }
        let case = case(
            id,
            "the linkage of the case of this name, without friction, six turns; error tolerances \
             1e-7 to 1e-11",
            "one equation of motion, integrated to 1e-12",
        );
        let rule = Rule::Falling(1e-5);
        check(&[
            case.vanishing("angle of the crank at 2 s [rad]", &errors, rule, FALLS),
            case.vanishing("rate of the crank at 2 s, relative", &rates, rule, FALLS),
            case.vanishing("energy over 2 s, relative", &drifts, rule, FALLS),
        ]);
    }
}
