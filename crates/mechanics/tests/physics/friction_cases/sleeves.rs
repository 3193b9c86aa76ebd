//! Sleeves that slide along and turn about their axis (B07, B12c; 9.13).

use friction::parameters::JointType;
use mechanics::{Formulation, Snapshot};
use verification::{Case, Claim, Rule, Section, check};

use super::{HALVINGS, UNLOADED, lugre, original};
use crate::oracle::{self, runge_kutta};
use crate::runs::{run, settings};
use crate::shared::{number, reference};
use mechanisms::{Sleeve, bristles, law};

/// Place along the axis.
fn place(s: &Snapshot<'_>) -> f64 {
    s.state().centre(0).x
}

/// Rates along and about the axis.
fn rates(s: &Snapshot<'_>) -> [f64; 2] {
    [s.state().velocities()[0], s.state().velocities()[3]]
}

/// Angle about the axis within half a turn of `near`.
fn angle(s: &Snapshot<'_>, near: f64) -> f64 {
    let m = s.rotation(0);
    let angle: f64 = m[(2, 1)].atan2(m[(1, 1)]);
    angle + std::f64::consts::TAU * ((near - angle) / std::f64::consts::TAU).round()
}

/// Place and angle where a sleeve stops, approached in Vs and Dm.
fn stops(case: &Case<'_>, sleeve: &Sleeve, mu: f64, end: f64, exact: [f64; 2]) -> Vec<Claim> {
    let ends = HALVINGS.map(|h| {
        let model = sleeve.model(law(mu, mu, 4e-3 * h, 4e-5 * h));
        let end = run(
            model,
            &[end],
            &settings(Formulation::Si2, 1e-10, 0.02),
            |_| {},
        );
        [place(&end.snapshot()), angle(&end.snapshot(), exact[1])]
    });
    vec![
        case.limit(
            "z at rest [m]",
            &ends.map(|e| e[0]),
            exact[0],
            Rule::Order(2.0),
            UNLOADED,
        ),
        case.limit(
            "θ at rest [rad]",
            &ends.map(|e| e[1]),
            exact[1],
            Rule::AtLeastOrder(2.0),
            UNLOADED,
        ),
    ]
}

/// Rates while it slides, which Vs plays no part in.
fn slides(sleeve: &Sleeve, mu: f64, times: &[f64]) -> Vec<[f64; 2]> {
    let mut seen = Vec::new();
    let settings = settings(Formulation::Si2, 1e-11, 0.02);
    run(
        sleeve.model(law(mu, mu, 1e-4, 1e-6)),
        times,
        &settings,
        |s| {
            seen.push(rates(s));
        },
    );
    seen
}

const SOURCE: &str = "closed form: θ′/θ′₀ = (z′/z′₀)^(m Rp²/I), quadrature for times";
const SLIDING: &str = "a hundred steps of an error of 1e-11, relative to rates of 20";
const ARGUMENTS: &[&str] = &["PIN_RADIUS", "INPUTS"];

#[test]
fn spinning_frees_axial_motion() {
    let Some(file) = reference("validation/data/B07_cylindrical.json") else {
        return;
    };
    let covers = original(JointType::Cylindrical, ARGUMENTS);
    let mut claims = Vec::new();
    for (id, name, model, inertia) in [
        ("B07a", "a_hoop", "I = m Rp²", 0.0032),
        ("B07b", "b_disk", "I = m Rp²/2", 0.0016),
    ] {
        let model = format!(
            "sleeve of 2 kg on a horizontal axis of 0.04 m, {model}, μ 0.25, from 0.6 m/s and 20 rad/s; Vs from 4 mm/s"
        );
        let case = Case {
            section: Section::Joint,
            id,
            model: &model,
            source: SOURCE,
            covers: &covers,
        };
        let sleeve = Sleeve {
            weight: 2.0 * 9.80665,
            inertia,
            pin_radius: 0.04,
            start: [0.6, 20.0],
        };
        let at = |key: &str| number(&file, &format!("/cases/{name}/{key}"));
        let exact = [at("z_stop"), at("theta_stop")];
        claims.extend(stops(&case, &sleeve, 0.25, at("t_stop") + 0.3, exact));
        if name == "b_disk" {
            let row = |k: usize, key: &str| at(&format!("table/{k}/{key}"));
            let times = [0, 1, 2, 3].map(|k| row(k, "t"));
            let seen = slides(&sleeve, 0.25, &times).concat();
            let exact = [0, 1, 2, 3]
                .map(|k| [row(k, "zdot"), row(k, "thetadot")])
                .concat();
            let quantity = "z′, θ′ at four times [m/s, rad/s]";
            claims.push(case.values(quantity, &seen, &exact, 1e-8, SLIDING));
        }
    }
    check(&claims);
}

/// 9.13: three inertias.
#[test]
fn sliding_and_spinning_cylinders() {
    let covers = original(JointType::Cylindrical, ARGUMENTS);
    let mut claims = Vec::new();
    for (id, ratio, time, stop, at) in [
        (
            "9.13 1",
            1.0,
            0.447_213_595,
            [0.223_606_8, 8.944_271_91],
            [0.776_393_2, 1.552_786_4],
        ),
        (
            "9.13 0.5",
            0.5,
            0.295_788_55,
            [0.169_672_33, 4.850_698_5],
            [0.752_333_43, 1.132_011_19],
        ),
        (
            "9.13 4",
            4.0,
            1.627_683_47,
            [0.337_507_09, 32.967_08],
            [0.791_462_22, 1.886_416_31],
        ),
    ] {
        let model = format!(
            "sleeve of 2 kg under 50 N, Rp 0.05 m, I = {ratio} m Rp², μ 0.2, from 1 m/s and Rp θ′ 2 m/s; Vs 0.5 mm/s"
        );
        let case = Case {
            section: Section::Joint,
            id,
            model: &model,
            source: "specification 9.13, the same closed form",
            covers: &covers,
        };
        let sleeve = Sleeve {
            weight: 50.0,
            inertia: ratio * 2.0 * 0.05 * 0.05,
            pin_radius: 0.05,
            start: [1.0, 40.0],
        };
        let settings = settings(Formulation::Si2, 1e-10, 0.02);
        let model = sleeve.model(law(0.2, 0.2, 5e-4, 5e-6));
        let end = run(model, &[time + 0.4], &settings, |_| {});
        let ours = [place(&end.snapshot()), angle(&end.snapshot(), stop[1])];
        let digits = "seven digits are given; the work below Vs is O(Vs²)";
        claims.push(case.values("z at rest [m]", &ours[..1], &stop[..1], 5e-8, digits));
        claims.push(case.values("θ at rest [rad]", &ours[1..], &stop[1..], 5e-6, digits));
        let [z, theta] = slides(&sleeve, 0.2, &[0.1])[0];
        let quantity = "z′, Rp θ′ at 0.1 s [m/s]";
        let digits = "nine digits are given";
        claims.push(case.values(quantity, &[z, 0.05 * theta], &at, 1e-8, digits));
    }
    check(&claims);
}

/// B12c: bristles that lean along and about the axis.
#[test]
fn sleeve_on_bristles() {
    let sleeve = Sleeve {
        weight: 2.0 * 9.80665,
        inertia: 0.0016,
        pin_radius: 0.04,
        start: [0.6, 20.0],
    };
    let law = bristles(0.4, 0.3);
    // z, Rp θ, their rates, bristles.
    let rate = |s: &[f64; 6]| {
        let (z_rate, force) = oracle::bristles(&law, [s[2], s[3]], [s[4], s[5]], sleeve.weight);
        let turning = 0.04 * 0.04 / sleeve.inertia;
        [
            s[2],
            s[3],
            force[0] / 2.0,
            turning * force[1],
            z_rate[0],
            z_rate[1],
        ]
    };
    let start = [0.0, 0.0, 0.6, 0.8, 0.0, 0.0];
    let exact = [0.1, 0.25, 0.4].map(|t| runge_kutta(start, t, 40_000, rate));
    let mut ours = Vec::new();
    run(
        sleeve.model(law),
        &[0.1, 0.25, 0.4],
        &settings(Formulation::Si2, 1e-10, 0.01),
        |s| {
            let deflection = s.friction(0).deflection;
            let theta = angle(s, exact[ours.len()][1] / 0.04);
            let leaning = [deflection.translation.z, deflection.rotation.z];
            ours.push([place(s), 0.04 * theta, leaning[0], leaning[1]]);
        },
    );
    let case = Case {
        section: Section::Joint,
        id: "B12c",
        model: "the sleeve of B07b on bristles, s0 1e5, s1 300, vs 1 mm/s, μs 0.4, μd 0.3",
        source: "equations (1) to (3) for two components, Runge–Kutta with steps of 10 µs",
        covers: &lugre(JointType::Cylindrical, ARGUMENTS),
    };
    let pick = |k: usize, l: usize| {
        let ours: Vec<f64> = ours.iter().flat_map(|o| [o[k], o[k + 1]]).collect();
        let exact: Vec<f64> = exact.iter().flat_map(|e| [e[l], e[l + 1]]).collect();
        (ours, exact)
    };
    let (places, exact_places) = pick(0, 0);
    let (leaning, exact_leaning) = pick(2, 4);
    let why = "a thousand steps of an error of 1e-10";
    check(&[
        case.values(
            "z, Rp θ at 0.1, 0.25, 0.4 s [m]",
            &places,
            &exact_places,
            1e-9,
            why,
        ),
        case.values(
            "deflections there [m]",
            &leaning,
            &exact_leaning,
            1e-11,
            why,
        ),
    ]);
}
