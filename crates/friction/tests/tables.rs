//! The original law against tables of closed forms (A01, A02, A12).

mod shared;

use friction::step::step5;
use friction::{Effect, Original};
use shared::{law, of_the_law, reference, table};
use verification::check;

/// Numbers of a table that is not all but empty.
fn long_table(text: &str) -> Vec<Vec<f64>> {
    let rows = table(text);
    assert!(rows.len() > 10);
    rows
}

#[test]
fn quintic_table_a01() {
    let Some(text) = reference("validation/data/A01_step5.csv") else {
        return;
    };
    let errors = long_table(&text)
        .into_iter()
        .map(|row| (step5(row[0], 0.0, 0.0, 1.0, 1.0).value - row[1]).abs());
    let case = of_the_law("A01", "the quintic step from 0 to 1", "exact");
    let worst = errors.fold(0.0, f64::max);
    check(&[case.worst("STEP5 on 0..1", worst, 1e-15, "rounding")]);
}

#[test]
fn coefficient_tables_a02() {
    let Some(text) = reference("validation/data/A02_mu_original.json") else {
        return;
    };
    let data: serde_json::Value = serde_json::from_str(&text).unwrap();
    let mut sliding = Vec::new();
    for set in data["sets"].as_object().unwrap().values() {
        let number = |key: &str| set[key].as_f64().unwrap();
        let law = Original {
            mu_static: number("mu_static"),
            mu_dynamic: number("mu_dynamic"),
            transition_velocity: number("vt"),
            transition_coefficient: number("c"),
            max_deformation: 0.01,
            effect: Effect::All,
        };
        let speeds = set["v"].as_array().unwrap();
        for (v, mu) in speeds
            .iter()
            .zip(set["mu_quintic_ADAMS"].as_array().unwrap())
        {
            let ours = -law.evaluate(&[v.as_f64().unwrap()], &[0.0]).mu[0];
            let exact = mu.as_f64().unwrap();
            // Relative to the coefficient, which is zero at rest.
            sliding.push((ours - exact).abs() / number("mu_static"));
        }
    }
    let [mut mu, mut beta, mut mu1] = [const { Vec::new() }; 3];
    for row in data["stiction_table_mu_s0.3_vs0.1_dmax0.01"]
        .as_array()
        .unwrap()
    {
        let number = |key: &str| row[key].as_f64().unwrap();
        let c = law(Effect::All).evaluate(&[number("v")], &[number("creep")]);
        mu.push((-c.mu[0] - number("mu_signed")).abs());
        beta.push((c.beta - number("beta")).abs());
        mu1.push((c.mu1 - number("mu1")).abs());
    }
    assert_eq!(sliding.len() + mu.len(), 119);
    let largest = |errors: &[f64]| errors.iter().copied().fold(0.0, f64::max);
    let case = of_the_law(
        "A02",
        "the original law: three sets of μs, μd, Vs and c over all regimes; stuck states with creep",
        "closed form, full precision",
    );
    check(&[
        case.worst(
            "μ by speed, of μs",
            largest(&sliding),
            1e-12,
            "rounding of c Vs",
        ),
        case.worst(
            "μ by speed and creep",
            largest(&mu),
            1e-15,
            "rounding of terms of 0.3",
        ),
        case.worst("β", largest(&beta), 1e-14, "rounding"),
        case.worst("μ1", largest(&mu1), 1e-14, "rounding"),
    ]);
}

#[test]
fn coefficient_table_a12() {
    let Some(text) = reference("validation/data/A12_mu_table.csv") else {
        return;
    };
    let law = Original {
        mu_dynamic: 0.25,
        ..law(Effect::All)
    };
    let errors = long_table(&text).into_iter().map(|row| {
        let c = law.evaluate(&[row[0]], &[row[1]]);
        (-c.mu[0] - row[2]).abs()
    });
    let case = of_the_law(
        "A12",
        "the original law, μs 0.3, μd 0.25, Vs 0.1, Dm 0.01: a table over speed and creep",
        "closed form, full precision",
    );
    let worst = errors.fold(0.0, f64::max);
    check(&[case.worst("μ", worst, 1e-15, "rounding of terms of 0.3")]);
}
