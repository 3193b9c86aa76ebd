//! Results do not depend on how a dataset says the same thing: order of statements, ids, units.

use std::path::Path;

use results::ResFile;

use crate::shared::run_text;

/// Steps of the dynamic blocks of the named component.
fn series(results: &ResFile, component: &str) -> Vec<f64> {
    results
        .get(component)
        .unwrap_or_else(|error| panic!("{component}: {error}"))
}

/// The dataset's title, and its statements each with the comments before it. Requests are left
/// out: their functions take ids and components alike.
fn statements(text: &str) -> (&str, Vec<String>) {
    let mut lines = text.lines();
    let title = lines.next().unwrap();
    let mut statements: Vec<String> = Vec::new();
    let mut comments = String::new();
    for line in lines {
        match line.trim_start().chars().next() {
            Some('!') | None => comments += &format!("{line}\n"),
            Some(',') => {
                *statements.last_mut().unwrap() += &format!("{comments}{line}\n");
                comments.clear();
            }
            Some(_) => {
                statements.push(format!("{comments}{line}\n"));
                comments.clear();
            }
        }
    }
    statements.retain(|text| {
        let statement = text
            .lines()
            .find(|line| !line.trim_start().starts_with('!'));
        !statement.is_some_and(|line| line.starts_with("REQUEST") || line.starts_with("END"))
    });
    (title, statements)
}

fn joined(title: &str, statements: &[String]) -> String {
    format!("{title}\n{}END\n", statements.concat())
}

/// Every id of the dataset replaced by another, in statements and in functions of markers.
fn renumbered(text: &str) -> String {
    let (title, body) = text.split_once('\n').unwrap();
    let mut out = format!("{title}\n");
    for line in body.lines() {
        if line.trim_start().starts_with('!') {
            out += &format!("{line}\n");
            continue;
        }
        let mut rest = line;
        while let Some(place) = rest.find(|c: char| c.is_ascii_digit()) {
            let digits = rest[place..].find(|c: char| !c.is_ascii_digit());
            let after = digits.map_or(rest.len(), |digits| place + digits);
            let (before, number) = (&rest[..place], &rest[place..after]);
            out += before;
            let next = rest[after..].chars().next();
            let id = is_id_place(&out) && !matches!(next, Some('.' | 'E' | 'D'));
            match number.parse::<u32>() {
                Ok(value) if id => out += &(value * 3 + 7).to_string(),
                _ => out += number,
            }
            rest = &rest[after..];
        }
        out += &format!("{rest}\n");
    }
    out
}

/// Whether the text so far ends where an id is due.
fn is_id_place(text: &str) -> bool {
    let line = text.rsplit('\n').next().unwrap();
    let keys = [" I=", " J=", "PART=", "CM=", "JOINT=", "RM="];
    let statement = line.ends_with('/') && !line.contains(' ');
    let open = line.rfind('(').map(|at| &line[at..]);
    let function = line.rfind('(').is_some_and(|at| {
        let name = line[..at]
            .rsplit(|c: char| !c.is_ascii_alphanumeric())
            .next()
            .unwrap();
        ["AZ", "WZ", "DX", "DY", "DZ", "VARVAL", "VX", "VY", "VZ"].contains(&name)
    });
    let inside = open.is_some_and(|open| {
        !open.contains(')')
            && open[1..]
                .chars()
                .all(|c| c.is_ascii_digit() || ", ".contains(c))
    });
    statement || keys.iter().any(|key| line.ends_with(key)) || (function && inside)
}

#[test]
fn order_of_statements_and_ids_do_not_matter() {
    let example =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/delta-robot/delta.adm");
    let text = std::fs::read_to_string(example).unwrap();
    let (title, mut statements) = statements(&text);
    let given = run_text(&joined(title, &statements), 0.4, 40, Some(1e-7));
    // A step that is prime to any count of statements visits them all in another order.
    let count = statements.len();
    statements = (0..count)
        .map(|k| statements[(k * 7919 + 13) % count].clone())
        .collect();
    let changed = renumbered(&joined(title, &statements));
    let changed = run_text(&changed, 0.4, 40, Some(1e-7));
    let mut worst = 0.0_f64;
    for entity in &given.entities {
        for component in &entity.components {
            // Euler angles jump at their ends; positions and forces of all elements do not.
            let angle = ["PSI", "THETA", "PHI", "TIME"].contains(&component.name.as_str());
            if angle || entity.kind.is_empty() {
                continue;
            }
            let name = format!("{}.{}", entity.name, component.name);
            let (a, b) = (series(&given, &name), series(&changed, &name));
            assert_eq!(a.len(), b.len(), "{name}");
            let peak = a.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let error = a
                .iter()
                .zip(&b)
                .fold(0.0_f64, |m, (x, y)| m.max((x - y).abs()));
            // Components that are zero but for rounding have no peak to compare with.
            if peak > 1e-9 {
                worst = worst.max(error / peak.max(1e-3));
            }
        }
    }
    println!("shuffled and renumbered: largest difference {worst:.2e} of each component's peak");
    // Sums are taken in another order, so that steps are accepted at other times; what differs is
    // the integration error, 1e-8 a step (a tenth of ERROR), amplified in accelerations by stick and slip.
    assert!(worst < 1e-4);
}

/// A pendulum on a pin with friction, in units of `1/scale` metres.
fn pendulum(unit: &str, scale: f64) -> String {
    let (length, inertia) = (0.4 * scale, 0.02 * scale * scale);
    format!(
        "A pendulum with pin friction
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH={unit}, TIME=SECOND
ACCGRAV/JGRAV={gravity}
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=3, IP={inertia}, {inertia}, {inertia}, QG={length}, 0, 0
MARKER/2, PART=2, QP=-{length}, 0, 0
MARKER/3, PART=2
JOINT/1, REVOLUTE, I=2, J=1
SFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION={torque}*SIN(3*TIME)
FRICTION/1, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, PIN_RADIUS={radius}
, FRICTION_ARM={radius}, BENDING_REACTION_ARM={radius}
, STICTION_TRANSITION_VELOCITY={velocity}, MAX_STICTION_DEFORMATION={creep}
END
",
        gravity = -9.80665 * scale,
        torque = scale,
        radius = 0.02 * scale,
        velocity = 0.001 * scale,
        creep = 1e-5 * scale,
    )
}

#[test]
fn units_of_length_do_not_matter() {
    let metres = run_text(&pendulum("METER", 1.0), 3.0, 60, Some(1e-6));
    let millimetres = run_text(&pendulum("MILLIMETER", 1000.0), 3.0, 60, Some(1e-6));
    let components = [
        ("PART_2_XFORM.X", 1e3),
        ("PART_2_XFORM.VY", 1e3),
        ("PART_2_XFORM.WZ", 1.0),
        ("JOINT_1.FX", 1.0),
        ("JOINT_1.FY", 1.0),
        ("FRICTION_1.TZ", 1e3),
    ];
    for (name, factor) in components {
        let a: Vec<f64> = series(&metres, name).iter().map(|x| x * factor).collect();
        let b = series(&millimetres, name);
        let peak = b.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let error = a
            .iter()
            .zip(&b)
            .fold(0.0_f64, |m, (x, y)| m.max((x - y).abs()));
        println!(
            "{name}: millimetres differ by {:.1e} of the peak {peak:.3e}",
            error / peak.max(1e-300)
        );
        // The error test has the same tolerance in both, so that the same steps are taken; what
        // is left is rounding, amplified by the friction law.
        assert!(error <= 1e-7 * peak, "{name}");
    }
}

/// A double pendulum in space of the given masses (kg), in units of which a metre and a kilogram have so
/// many.
fn pendulums([first, second]: [f64; 2], metre: f64, kilogram: f64) -> String {
    let body = |mass: f64| {
        let inertia = |kg_m2: f64| mass * kilogram * kg_m2 * metre * metre;
        format!(
            "MASS={:E}, IP={:E}, {:E}, {:E}",
            mass * kilogram,
            inertia(1e-7),
            inertia(8.34e-4),
            inertia(8.34e-4)
        )
    };
    // The units are not named, so that the numbers alone say which they are.
    format!(
        "Two bars in space
ACCGRAV/KGRAV={:E}
PART/1, GROUND
MARKER/1, PART=1, REULER=0, 90D, 0
PART/2, CM=20, {}
MARKER/20, PART=2, QP={:E}, 0, 0
MARKER/21, PART=2, REULER=0, 90D, 0
MARKER/22, PART=2, QP={:E}, 0, 0, REULER=0, 60D, 0
PART/3, CM=30, {}, QG={:E}, 0, 0
MARKER/30, PART=3, QP={:E}, 0, 0
MARKER/31, PART=3, REULER=0, 60D, 0
JOINT/1, REVOLUTE, I=21, J=1
JOINT/2, REVOLUTE, I=31, J=22
REQUEST/1, F2=AZ(21, 1)\\F3=AZ(31, 22)
INTEGRATOR/GSTIFF, SI2, ERROR=1E-5
END
",
        -9.81 * metre,
        body(first),
        0.05 * metre,
        0.1 * metre,
        body(second),
        0.1 * metre,
        0.05 * metre,
    )
}

/// The steps that are taken are the same whatever the units and whatever all masses are multiplied by.
#[test]
fn masses_of_any_magnitude_take_the_same_steps() {
    let end = |text: &str| {
        let results = run_text(text, 2.0, 40, None);
        let angles = ["F2", "F3"].map(|c| series(&results, &format!("REQUEST_1.{c}")));
        angles.concat()
    };
    let worst = |a: &[f64], b: &[f64]| {
        let pairs = a.iter().zip(b);
        pairs.fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs()))
    };
    let usual = end(&pendulums([1.0; 2], 1.0, 1.0));
    let scales = [
        (1e6, 1.0, 1.0),
        (1e-6, 1.0, 1.0),
        (1e-12, 1.0, 1.0),
        (1e-14, 1.0, 1.0),
        (1.0, 1e3, 1.0),
        (1.0, 1e6, 1.0),
        (1e-9, 1.0, 1e-3),
        (1e-9, 1e3, 1e-3),
        (1e-12, 1e6, 1e6),
    ];
    for (mass, metre, kilogram) in scales {
        let other = end(&pendulums([mass; 2], metre, kilogram));
        let off = worst(&usual, &other);
        println!("mass {mass:e} kg, metre {metre:e}, kilogram {kilogram:e}: {off:.1e}");
        // Rounding of 1e-16 over some hundred steps of a motion that makes it grow tenfold; another step
        // would differ by the tolerance.
        assert!(off < 1e-10);
    }
    // A part that is a million times lighter than the other, and all of it tiny.
    let light = end(&pendulums([1.0, 1e-6], 1.0, 1.0));
    let tiny = end(&pendulums([1e-9, 1e-15], 1.0, 1.0));
    let off = worst(&light, &tiny);
    println!("one of a millionth: {off:.1e}");
    // A thousand steps of a light one that is thrown about, in which rounding grows a millionfold.
    assert!(off < 1e-8);
}
