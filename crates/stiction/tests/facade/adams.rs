//! Runs against results of Adams: free fall exactly, and eleven models of one joint or spring.

use std::path::Path;

use crate::shared::{reference, run};
use results::ResFile;
use stiction::{Outcome, Project, RunOptions};

#[test]
fn free_fall_is_exact() {
    let Some(file) = reference("adams-results/free-fall/test.acf") else {
        return;
    };
    let project = Project::load(&file).unwrap_or_else(|error| panic!("{error}"));
    let (report, results) = run(&project, "free-fall", RunOptions::default());
    assert_eq!(report.outcome, Outcome::Completed);
    let Some(theirs) = reference("adams-results/free-fall/test.res") else {
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
        "RotSpring_Case01",
        "TranSpring_Case01",
    ];
    let mut failures = Vec::new();
    for case in cases {
        let folder = "adams-results/single-joint";
        let Some(model) = reference(&format!("{folder}/{case}.adm")) else {
            return;
        };
        let tables = model.with_extension("");
        let mut project = Project::load(&model).unwrap_or_else(|error| panic!("{error}"));
        project.push_dynamic(5.0, Some(500), None);
        // Well below the comparison, so that the difference is that of Adams and its six digits.
        let options = RunOptions { error: Some(1e-7) };
        let (report, results) = run(&project, case, options);
        assert_eq!(report.outcome, Outcome::Completed, "{case}");
        let position = request(&results, 1, 0).unwrap();
        let (far, _) = compare(&position, &table(&tables.join("Pos.txt")));
        let mut line = format!("{case:<20} position {far:.1e} m");
        let mut passed = far < 1e-3;
        // The constraint of the distance is a GCON, whose reaction is not reported yet.
        let has_reaction = case != "Distance_Case01";
        for (half, name) in [(0, "Rforce"), (1, "Rtorque")] {
            let Some(ours) = request(&results, 5, half).filter(|_| has_reaction) else {
                line += &format!(", {name} not compared");
                continue;
            };
            let (difference, peak) = compare(&ours, &table(&tables.join(format!("{name}.txt"))));
            line += &format!(", {name} {difference:.1e} of {peak:.1e}");
            // A table of zeros has rounding of its own as its peak: 1e-6 N or N m is nothing.
            passed &= difference < 2e-2 * peak || difference < 1e-6;
        }
        println!("{line}");
        if !passed {
            failures.push(line);
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}
