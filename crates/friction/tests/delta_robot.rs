//! The law against a real run of Adams Solver C++ 2015.1: twelve frictions on spherical joints,
//! 200 output points, 17 digits.
mod shared;

use friction::parameters::JointType;
use friction::{Effect, Inputs, Original, Regime, SphericalLoad, resultant};
use shared::{norm, reference};
use std::collections::HashMap;
use verification::{Case, Coverage, Formulation, Section, check};

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

/// The run and its model.
struct Run {
    columns: Columns,
    rows: Vec<Vec<f64>>,
    model: HashMap<(String, u32), HashMap<String, String>>,
}

impl Run {
    fn read() -> Option<Self> {
        let folder = "adams-results/delta-robot-friction";
        let (columns, rows) = read_results(&reference(&format!("{folder}/delta_robot.res"))?);
        let model = read_dataset(&reference(&format!("{folder}/delta_robot.adm"))?);
        Some(Self {
            columns,
            rows,
            model,
        })
    }

    fn vector(&self, row: &[f64], kind: &str, id: u32, names: [&str; 3]) -> [f64; 3] {
        names.map(|name| row[self.columns[&(kind.to_string(), id, name.to_string())]])
    }

    fn argument(&self, statement: &str, id: u32, key: &str) -> Option<&str> {
        self.model
            .get(&(statement.to_string(), id))?
            .get(key)
            .map(String::as_str)
    }

    fn id(&self, statement: &str, id: u32, key: &str) -> u32 {
        self.argument(statement, id, key).unwrap().parse().unwrap()
    }

    fn law(&self, friction: u32) -> Original {
        let number = |key| {
            self.argument("FRICTION", friction, key)
                .unwrap()
                .parse()
                .unwrap()
        };
        Original {
            mu_static: number("MU_STATIC"),
            mu_dynamic: number("MU_DYNAMIC"),
            transition_velocity: 0.1,
            transition_coefficient: 1.5,
            max_deformation: 0.01,
            effect: Effect::All,
        }
    }

    /// Load of a friction: the size of its joint's reaction (ball radius 1).
    fn load(&self, row: &[f64], friction: u32) -> f64 {
        let joint = self.id("FRICTION", friction, "JOINT");
        let force = self.vector(row, "Joint", joint, ["FX", "FY", "FZ"]);
        let ball = SphericalLoad {
            inputs: Inputs::ALL,
            ball_radius: 1.0,
        };
        ball.evaluate(force).value
    }

    /// Axes of a marker in ground: pose of its part (none of ground's) times its own.
    fn axes(&self, row: &[f64], marker: u32) -> Rotation {
        let own = self
            .argument("MARKER", marker, "REULER")
            .map_or([0.0; 3], |text| {
                let mut numbers = text.split(',').map(|x| x.trim().parse().unwrap());
                core::array::from_fn(|_| numbers.next().unwrap())
            });
        let part = self.id("MARKER", marker, "PART");
        let pose = match self.argument("PART", part, "MASS") {
            Some(_) => rotation(self.vector(row, "Part", part, ["PSI", "THETA", "PHI"])),
            None => rotation([0.0; 3]),
        };
        let own = rotation(own);
        core::array::from_fn(|i| {
            core::array::from_fn(|j| (0..3).map(|k| pose[i][k] * own[k][j]).sum())
        })
    }

    fn angular_velocity(&self, row: &[f64], marker: u32) -> [f64; 3] {
        let part = self.id("MARKER", marker, "PART");
        match self.argument("PART", part, "MASS") {
            Some(_) => self.vector(row, "Part", part, ["WX", "WY", "WZ"]),
            None => [0.0; 3],
        }
    }
}

const FRICTIONS: std::ops::RangeInclusive<u32> = 1..=12;
const TORQUE: [&str; 3] = ["TX", "TY", "TZ"];
const CASE: Case<'_> = Case {
    section: Section::Law,
    id: "RD3",
    model: "the law on the states of a delta robot with twelve spherical frictions, 2400 samples, 30 stuck",
    source: "a run of Adams Solver C++ 2015.1, 17 digits",
    covers: &[Coverage {
        joint: JointType::Spherical,
        formulation: Formulation::Original,
        arguments: &[
            "MU_STATIC",
            "MU_DYNAMIC",
            "STICTION_TRANSITION_VELOCITY",
            "TRANSITION_VELOCITY_COEFFICIENT",
            "MAX_STICTION_DEFORMATION",
            "BALL_RADIUS",
        ],
    }],
};
const CREEP: [&str; 3] = ["CREEP_AX", "CREEP_AY", "CREEP_AZ"];

#[test]
fn coefficients_and_torques_of_a_real_run() {
    let Some(run) = Run::read() else { return };
    let (mut samples, mut stuck) = (0, 0);
    let [
        mut worst_mu,
        mut worst_mu1,
        mut worst_beta,
        mut worst_torque,
    ] = [0.0f64; 4];
    for row in &run.rows {
        for friction in FRICTIONS {
            let of_friction = |names| run.vector(row, "Friction", friction, names);
            let velocity = of_friction(["WX", "WY", "WZ"]);
            let c = run.law(friction).evaluate(&velocity, &of_friction(CREEP));
            worst_mu = worst_mu.max(relative(&c.mu, &of_friction(["MURX", "MURY", "MURZ"])));
            let [mu1, beta, _] = of_friction(["MU1", "BETA", "BETA"]);
            worst_beta = worst_beta.max((c.beta - beta).abs() / beta);
            if mu1 == 0.0 {
                assert_eq!(
                    c.mu1, 0.0,
                    "friction {friction} sticks where Adams does not"
                );
            } else {
                worst_mu1 = worst_mu1.max((c.mu1 - mu1).abs() / mu1);
                stuck += 1;
            }
            let torque = resultant(&c, run.load(row, friction), 0.0, 1e40).force;
            let expected = norm(&of_friction(TORQUE));
            worst_torque = worst_torque.max((norm(&torque) - expected).abs() / expected);
            samples += 1;
        }
    }
    assert_eq!((samples, stuck), (2400, 30));
    check(&[
        CASE.worst("MUR, relative", worst_mu, 1e-12, "rounding, observed 2e-15"),
        CASE.worst("MU1, relative", worst_mu1, 1e-12, "rounding"),
        CASE.worst("BETA, relative", worst_beta, 1e-12, "rounding"),
        CASE.worst(
            "size of the torque, relative",
            worst_torque,
            1e-10,
            "rounding of a difference",
        ),
    ]);
}

/// The torque as a vector in J axes, from the motion of the parts alone: the law evaluated in the
/// axes of the J marker.
///
/// The axes of `W`, `MUR` and `CREEP_A` in the results are those of the I marker as they stood,
/// relative to J, where the stick began; they do not turn with the creep. So the law works in axes
/// fixed to J, and the creep, which is the rotation since then, is the same in both I axes.
#[test]
fn torque_vectors_of_a_real_run() {
    let Some(run) = Run::read() else { return };
    let [mut moving, mut sticking] = [0.0f64; 2];
    for row in &run.rows {
        for friction in FRICTIONS {
            let joint = run.id("FRICTION", friction, "JOINT");
            let (i, j) = (run.id("JOINT", joint, "I"), run.id("JOINT", joint, "J"));
            let (i_axes, j_axes) = (run.axes(row, i), run.axes(row, j));
            let (of_i, of_j) = (run.angular_velocity(row, i), run.angular_velocity(row, j));
            let relative_velocity = core::array::from_fn(|k| of_i[k] - of_j[k]);
            let velocity = times_transposed(&j_axes, relative_velocity);
            let creep = times(&i_axes, run.vector(row, "Friction", friction, CREEP));
            let c = run
                .law(friction)
                .evaluate(&velocity, &times_transposed(&j_axes, creep));
            let torque = resultant(&c, run.load(row, friction), 0.0, 1e40).force;
            let error = relative(&torque, &run.vector(row, "Friction", friction, TORQUE));
            match c.regime {
                Regime::Stuck => sticking = sticking.max(error),
                Regime::Transition | Regime::Sliding => moving = moving.max(error),
            }
        }
    }
    let why = "the dataset gives the angles of the markers with ten digits; the axes of the I marker \
               now would be wrong by up to 6e-4, the creep angle";
    check(&[
        CASE.worst("torque vector moving, relative", moving, 1e-9, why),
        CASE.worst("torque vector stuck, relative", sticking, 1e-9, why),
    ]);
}
