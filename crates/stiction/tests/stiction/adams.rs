//! Runs against results of Adams: free fall exactly, nine models of one joint and two of one spring.

use std::path::Path;

use results::ResFile;
use stiction::Project;

use crate::shared::{complete, run_dynamic, run_text};

#[test]
fn free_fall_is_exact() {
    let Some(file) = reference_data::path("adams-results/free-fall/test.acf") else {
        return;
    };
    let project = Project::load(&file).unwrap_or_else(|error| panic!("{error}"));
    let results = complete(&project, None);
    let Some(theirs) = reference_data::path("adams-results/free-fall/test.res") else {
        return;
    };
    let theirs = ResFile::read(theirs).unwrap();
    let g = 386.0885827;
    let (times, y) = (
        results.get("time.TIME").unwrap(),
        results.get("PART_2_XFORM.Y").unwrap(),
    );
    assert_eq!(times.len(), theirs.get("time.TIME").unwrap().len());
    for (t, y) in times.iter().zip(&y) {
        // A parabola is what a formula of order two follows; rounding of 12 inches.
        assert!((y + 0.5 * g * t * t).abs() < 1e-11, "{t}: {y}");
    }
    let adams = theirs.get("PART_2_XFORM.Y").unwrap();
    let far = y
        .iter()
        .zip(&adams)
        .fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    println!("free fall: largest difference from Adams {far:.2e} in (its own error)");
    // Adams starts with first-order steps and keeps that error of 1.5e-4 in.
    assert!(far < 2e-4);
}

/// Well below what is compared, so that the differences are those of Adams and its six digits.
const TIGHT: Option<f64> = Some(1e-7);
/// Largest difference of positions, m.
const POSITION: f64 = 1e-3;
/// Largest difference of reactions, part of their peak.
const REACTION: f64 = 2e-2;

/// Columns of numbers under three lines of heads, and the time.
fn table(path: &Path) -> Vec<Vec<f64>> {
    let text = std::fs::read_to_string(path).unwrap();
    let rows = text.lines().skip(3).filter(|line| !line.trim().is_empty());
    rows.map(|line| {
        line.split_whitespace()
            .map(|word| word.parse().unwrap())
            .collect()
    })
    .collect()
}

/// Rows of three components of a request: those of the first or second half of its columns.
fn request(results: &ResFile, id: u32, half: usize) -> Option<Vec<[f64; 3]>> {
    let entity = results
        .entities
        .iter()
        .position(|entity| entity.kind == "Request" && entity.object_id == Some(id))?;
    let names: Vec<&str> = results.entities[entity]
        .components
        .iter()
        .map(|c| c.name.as_str())
        .collect();
    let wanted: [&[&str]; 3] = match half {
        0 => [&["X", "F2", "FX"], &["Y", "F3", "FY"], &["Z", "F4", "FZ"]],
        _ => [&["F6", "TX"], &["F7", "TY"], &["F8", "TZ"]],
    };
    let columns = wanted.map(|any| names.iter().position(|name| any.contains(name)));
    let steps = results.data.iter().skip(1).flat_map(|block| {
        (0..block.times.len())
            .map(|step| block.row(step))
            .collect::<Vec<_>>()
    });
    let row = |values: &[f64]| {
        columns.map(|column| column.map_or(0.0, |c| values[results.column_of(entity, c)]))
    };
    Some(steps.map(row).collect())
}

/// Largest difference between rows of ours and the table, and the table's largest value.
fn compare(ours: &[[f64; 3]], table: &[Vec<f64>]) -> (f64, f64) {
    assert_eq!(ours.len(), table.len());
    let (mut difference, mut peak) = (0.0_f64, 0.0_f64);
    for (row, theirs) in ours.iter().zip(table) {
        for axis in 0..3 {
            difference = difference.max((row[axis] - theirs[axis + 1]).abs());
            peak = peak.max(theirs[axis + 1].abs());
        }
    }
    (difference, peak)
}

#[test]
fn single_joints_match_adams() {
    let cases = [
        "Revolute_Case01",
        "Spherical_Case01",
        "Universal_Case01",
        "Universal_Case03",
        "Prismatic_Case01",
        "Prismatic_Case03",
        "Cylindrical_Case01",
        "Cylindrical_Case03",
        "Distance_Case01",
    ];
    let mut failures = Vec::new();
    for case in cases {
        let folder = "adams-results/single-joint";
        let Some(model) = reference_data::path(&format!("{folder}/{case}.adm")) else {
            return;
        };
        let tables = model.with_extension("");
        let results = run_dynamic(&model, 5.0, 500, TIGHT);
        let position = request(&results, 1, 0).unwrap();
        let (far, _) = compare(&position, &table(&tables.join("Pos.txt")));
        let mut line = format!("{case:<20} position {far:.1e} m");
        let mut passed = far < POSITION;
        for (half, name) in [(0, "Rforce"), (1, "Rtorque")] {
            let ours = request(&results, 5, half).unwrap();
            let (difference, peak) = compare(&ours, &table(&tables.join(format!("{name}.txt"))));
            line += &format!(", {name} {difference:.1e} of {peak:.1e}");
            // A table of zeros has rounding of its own as its peak: 1e-6 N or N m is nothing.
            passed &= difference < REACTION * peak || difference < 1e-6;
        }
        println!("{line}");
        if !passed {
            failures.push(line);
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

/// A text of a dataset and what it becomes.
type Change = (&'static str, &'static str);

/// A model of one spring, changed to what its tables are of, run; rows of three components each.
fn run_spring(case: &str, changes: &[Change], columns: [&str; 9]) -> Option<[Vec<[f64; 3]>; 3]> {
    let file = reference_data::path(&format!("adams-results/single-joint/{case}.adm"))?;
    let mut text = String::from_utf8_lossy(&std::fs::read(file).unwrap()).into_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "{case} has no {from}");
        text = text.replace(from, to);
    }
    let results = run_text(&text, 5.0, 500, TIGHT);
    let columns = columns.map(|name| results.get(name).unwrap());
    let rows = |first: usize| -> Vec<[f64; 3]> {
        // The first step is the model as given, all zeros.
        (1..columns[0].len())
            .map(|k| [0, 1, 2].map(|axis| columns[first + axis][k]))
            .collect()
    };
    Some([rows(0), rows(3), rows(6)])
}

/// The datasets of the two springs are not those that made the tables. The tables follow a spring
/// and damper in all their digits: K = 10 N/m and C = 0.5 N s/m on a vertical line that is
/// unstretched at the start, and KT = 200 N m/rad and CT = 10 N m s/rad. With these put in, and the
/// spring turned to the vertical, the datasets are run against the tables, which hold the force and
/// torque on ground.
#[test]
fn springs_match_adams() {
    let vertical = [
        ("- 100.0*(dm(204,205)-2.0)", "- 10.0*(dm(204,205)-2.0)"),
        ("- 1.0*vr(204,205)", "- 0.5*vr(204,205)"),
        (", QP = 0, 2, 0", ", QP = 0, 0, 0"),
        (
            "MARKER/204\n, PART = 1",
            "MARKER/204\n, PART = 1, QP = 0, 0, 2",
        ),
    ];
    let torsion = [
        ("- 1.0*RTOD*(az(207,208)", "- 200*(az(207,208)"),
        ("- 5.0E-002*RTOD*wz", "- 10*wz"),
    ];
    let place = ["REQUEST_1.X", "REQUEST_1.Y", "REQUEST_1.Z"];
    let spring = [
        "sforce.FX",
        "sforce.FY",
        "sforce.FZ",
        "sforce.TX",
        "sforce.TY",
        "sforce.TZ",
    ];
    let cases: [(&str, &[Change], [&str; 3]); 2] = [
        (
            "TranSpring_Case01",
            &vertical,
            ["sforce.FX", "sforce.FY", "sforce.FZ"],
        ),
        (
            "RotSpring_Case01",
            &torsion,
            ["JOINT_1.FX", "JOINT_1.FY", "JOINT_1.FZ"],
        ),
    ];
    for (case, changes, force) in cases {
        let [x, y, z] = place;
        let [fx, fy, fz] = force;
        let columns = [x, y, z, fx, fy, fz, spring[3], spring[4], spring[5]];
        let Some(ours) = run_spring(case, changes, columns) else {
            return;
        };
        let mut line = format!("{case:<20}");
        for (ours, name) in ours.iter().zip(["Pos", "Rforce", "Rtorque"]) {
            let Some(file) =
                reference_data::path(&format!("adams-results/single-joint/{case}/{name}.txt"))
            else {
                return;
            };
            let (difference, peak) = compare(ours, &table(&file));
            line += &format!(" {name} {difference:.1e} of {peak:.1e}");
            let allowed = if name == "Pos" {
                POSITION
            } else {
                REACTION * peak
            };
            assert!(difference <= allowed, "{line}");
        }
        println!("{line}");
    }
}
