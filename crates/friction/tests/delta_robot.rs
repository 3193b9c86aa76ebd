//! The law against a real run of Adams Solver C++ 2015.1: twelve frictions on spherical joints,
//! 200 output points, 17 digits.
#![allow(
    clippy::print_stdout,
    reason = "the largest errors are what this test shows"
)]

mod shared;

use friction::{Effect, Inputs, Original, Regime, SphericalLoad, resultant};
use shared::{norm, reference};
use std::collections::HashMap;

type Rotation = [[f64; 3]; 3];
/// Position in a row by entity type, object id and component name.
type Columns = HashMap<(String, u32, String), usize>;

/// Value of an attribute of an XML line.
fn attribute<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    line.split_once(&format!(" {name}=\""))?.1.split('"').next()
}

/// The columns and the rows of the dynamic simulation.
fn read_results(text: &str) -> (Columns, Vec<Vec<f64>>) {
    let mut ids = HashMap::new();
    let mut entity = (String::new(), 0);
    for line in text.lines() {
        if line.starts_with("<Entity") {
            entity = (
                attribute(line, "entType").unwrap_or("").to_string(),
                attribute(line, "objectId").map_or(0, |id| id.parse().unwrap()),
            );
        } else if line.starts_with("<Component") {
            let name = attribute(line, "name").unwrap().to_string();
            let id: usize = attribute(line, "id").unwrap().parse().unwrap();
            ids.insert((entity.0.clone(), entity.1, name), id - 1);
        }
    }
    let dynamic = text.split_once("<Data name=\"dynamic_001\"").unwrap().1;
    let rows = dynamic
        .split("<Step type=\"dynamic\">")
        .skip(1)
        .map(|step| {
            let values = step.split_once("</Step>").unwrap().0;
            values
                .split_whitespace()
                .map(|x| x.parse().unwrap())
                .collect()
        })
        .collect();
    (ids, rows)
}

/// Arguments of the statements of a dataset: `("MARKER", 7) -> {"PART": "1", "REULER": "..."}`.
fn read_dataset(text: &str) -> HashMap<(String, u32), HashMap<String, String>> {
    let mut statements = HashMap::new();
    let mut current = (String::new(), 0);
    for line in text.lines().filter(|line| !line.starts_with('!')) {
        if let Some(argument) = line.strip_prefix(',') {
            if let Some((key, value)) = argument.split_once('=') {
                let arguments: &mut HashMap<String, String> =
                    statements.entry(current.clone()).or_default();
                arguments.insert(key.trim().to_string(), value.trim().to_string());
            }
        } else if let Some((keyword, id)) = line.split_once('/') {
            current = (keyword.to_string(), id.trim().parse().unwrap_or(0));
        }
    }
    statements
}

/// Rotation of a frame given by body-fixed 3-1-3 angles: columns are its axes.
fn rotation(angles: [f64; 3]) -> Rotation {
    let [(s1, c1), (s2, c2), (s3, c3)] = angles.map(f64::sin_cos);
    [
        [c1 * c3 - s1 * c2 * s3, -c1 * s3 - s1 * c2 * c3, s1 * s2],
        [s1 * c3 + c1 * c2 * s3, -s1 * s3 + c1 * c2 * c3, -c1 * s2],
        [s2 * s3, s2 * c3, c2],
    ]
}

fn times(a: &Rotation, x: [f64; 3]) -> [f64; 3] {
    a.map(|row| row[0] * x[0] + row[1] * x[1] + row[2] * x[2])
}

fn times_transposed(a: &Rotation, x: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|j| (0..3).map(|i| a[i][j] * x[i]).sum())
}

fn relative(actual: &[f64; 3], expected: &[f64; 3]) -> f64 {
    norm(&core::array::from_fn::<f64, 3, _>(|i| {
        actual[i] - expected[i]
    })) / norm(expected)
}

#[test]
fn samples_of_a_real_run() {
    let folder = "adams-results/delta-robot-friction";
    let (Some(results), Some(dataset)) = (
        reference(&format!("{folder}/delta_robot.res")),
        reference(&format!("{folder}/delta_robot.adm")),
    ) else {
        return;
    };
    let (ids, rows) = read_results(&results);
    let model = read_dataset(&dataset);
    let argument = |statement: &str, id: u32, key: &str| {
        model
            .get(&(statement.to_string(), id))
            .and_then(|arguments| arguments.get(key))
    };
    let id_of = |statement: &str, id: u32, key: &str| -> u32 {
        argument(statement, id, key).unwrap().parse().unwrap()
    };
    let vector = |row: &[f64], kind: &str, id: u32, names: [&str; 3]| {
        names.map(|name| row[ids[&(kind.to_string(), id, name.to_string())]])
    };
    // Marker orientation in ground: part's pose (ground: none) times the marker's REULER.
    let orient = |row: &[f64], marker: u32, x: [f64; 3]| {
        let part = id_of("MARKER", marker, "PART");
        let angles = argument("MARKER", marker, "REULER").map_or([0.0; 3], |text| {
            let mut numbers = text.split(',').map(|x| x.trim().parse().unwrap());
            core::array::from_fn(|_| numbers.next().unwrap())
        });
        let in_part = times(&rotation(angles), x);
        match argument("PART", part, "MASS") {
            Some(_) => times(
                &rotation(vector(row, "Part", part, ["PSI", "THETA", "PHI"])),
                in_part,
            ),
            None => in_part,
        }
    };
    let axes = |row: &[f64], marker: u32| -> Rotation {
        let columns =
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|e| orient(row, marker, e));
        core::array::from_fn(|i| core::array::from_fn(|j| columns[j][i]))
    };

    let (mut samples, mut stuck) = (0, 0);
    let [mut worst_mu, mut worst_mu1, mut worst_beta, mut worst_size] = [0.0f64; 4];
    let mut worst_torque = [0.0f64; 2];
    for row in &rows {
        for friction in 1..=12 {
            let number = |key: &str| {
                argument("FRICTION", friction, key)
                    .unwrap()
                    .parse()
                    .unwrap()
            };
            let law = Original {
                mu_static: number("MU_STATIC"),
                mu_dynamic: number("MU_DYNAMIC"),
                transition_velocity: 0.1,
                transition_coefficient: 1.5,
                max_deformation: 0.01,
                effect: Effect::All,
            };
            let of_friction = |names| vector(row, "Friction", friction, names);
            let velocity = of_friction(["WX", "WY", "WZ"]);
            let creep = of_friction(["CREEP_AX", "CREEP_AY", "CREEP_AZ"]);
            let expected_mu = of_friction(["MURX", "MURY", "MURZ"]);
            let [expected_mu1, expected_beta, _] = of_friction(["MU1", "BETA", "BETA"]);
            let c = law.evaluate(&velocity, &creep);
            worst_mu = worst_mu.max(relative(&c.mu, &expected_mu));
            worst_beta = worst_beta.max((c.beta - expected_beta).abs() / expected_beta);
            if expected_mu1 == 0.0 {
                assert_eq!(
                    c.mu1, 0.0,
                    "friction {friction} sticks where Adams does not"
                );
            } else {
                worst_mu1 = worst_mu1.max((c.mu1 - expected_mu1).abs() / expected_mu1);
                stuck += 1;
            }

            let joint = id_of("FRICTION", friction, "JOINT");
            let reaction = vector(row, "Joint", joint, ["FX", "FY", "FZ"]);
            let torque_j = of_friction(["TX", "TY", "TZ"]);
            let load = SphericalLoad {
                inputs: Inputs::ALL,
                ball_radius: 1.0,
            }
            .evaluate(reaction);
            let torque_i = resultant(&c, load.value, 0.0, 1e40).force;
            worst_size =
                worst_size.max((norm(&torque_i) - norm(&torque_j)).abs() / norm(&torque_j));
            let i_axes = axes(row, id_of("JOINT", joint, "I"));
            let j_axes = axes(row, id_of("JOINT", joint, "J"));
            let turned = times_transposed(&j_axes, times(&i_axes, torque_i));
            let kind = usize::from(c.regime == Regime::Stuck);
            worst_torque[kind] = worst_torque[kind].max(relative(&turned, &torque_j));
            samples += 1;
        }
    }
    println!("{samples} samples, {stuck} stuck; largest relative errors:");
    println!("  MUR {worst_mu:.2e}  MU1 {worst_mu1:.2e}  BETA {worst_beta:.2e}");
    println!("  |T| {worst_size:.2e}");
    let [moving, sticking] = worst_torque;
    println!("  T turned from I to J axes: {moving:.2e} moving, {sticking:.2e} stuck");
    assert_eq!((samples, stuck), (2400, 30));
    assert!(worst_mu < 1e-12 && worst_mu1 < 1e-12 && worst_beta < 1e-12);
    assert!(worst_size < 1e-10);
    // As vectors the torques agree only as far as the run's own printed orientations do with them:
    // to the tolerance of its corrector while moving, and by the creep angle (below 1e-3 rad) in
    // the stuck samples. A wrong frame or sign would be an error of order 1.
    assert!(moving < 1e-5 && sticking < 1e-3);
}
