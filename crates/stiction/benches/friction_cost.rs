//! What friction costs: mechanisms with and without their FRICTION statements, in one run.
//!
//! Prints steps, rejections, residuals, factorisations and time per accepted step for both, and a
//! stuck mechanism whose steps are limited by its outputs only.
//!
//! `cargo bench -p stiction --bench friction_cost`
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]

use std::path::Path;
use std::time::Instant;

use stiction::{Outcome, Progress, Project, RunOptions, RunReport, Session, Watch};

/// Runs whose median is taken.
const RUNS: usize = 9;

struct Silent;

impl Watch for Silent {
    fn progress(&mut self, _: &Progress) -> bool {
        true
    }
}

/// Elapsed seconds and report of one run.
fn run(project: &Project, folder: &Path) -> (f64, RunReport) {
    let session = Session::new(project).expect("the model is simulated");
    let options = RunOptions {
        error: Some(1e-6),
        ..RunOptions::default()
    };
    let start = Instant::now();
    let report = session
        .run(folder, options, &mut Silent)
        .expect("files are written");
    assert_eq!(report.outcome, Outcome::Completed);
    (start.elapsed().as_secs_f64(), report)
}

/// The text of a dataset without its FRICTION statements.
fn without_friction(text: &str) -> String {
    let mut kept = String::new();
    let mut inside = false;
    for line in text.lines() {
        let continued = line.starts_with(',');
        inside = line.starts_with("FRICTION/") || inside && continued;
        if !inside {
            kept.push_str(line);
            kept.push('\n');
        }
    }
    kept
}

fn project(path: &Path, end: f64, steps: u32) -> Project {
    let mut project = Project::load(path).expect("the model is read");
    project.push_dynamic(end, Some(steps), None);
    project
}

/// A block below its angle of friction, whose steps only its outputs keep short.
const HELD: &str = "A block held on an incline of 10 degrees
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1, REULER=0, 80D, 0
PART/2, MASS=1, CM=20, IP=1, 1, 1, REULER=0, 80D, 0
MARKER/20, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=1
FRICTION/1, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2
ACCGRAV/KGRAV=-9.81
INTEGRATOR/GSTIFF, SI2
END
";

fn stuck(folder: &Path) {
    let path = folder.join("held.adm");
    std::fs::write(&path, HELD).expect("a dataset is written");
    let mut project = Project::load(&path).expect("the model is read");
    project.push_dynamic(10.0, Some(1), None);
    let (_, settled) = run(&project, folder);
    project.push_dynamic(1e6, Some(100), None);
    let (_, held) = run(&project, folder);
    println!(
        "stuck: {} steps for the first 10 s, then {} for 1e6 s with 100 outputs",
        settled.statistics.steps.steps,
        held.statistics.steps.steps - settled.statistics.steps.steps,
    );
}

fn main() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let folder = std::env::temp_dir().join(format!("stiction-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for results");
    println!(
        "{:<34} {:>7} {:>9} {:>10} {:>9} {:>10}",
        "model", "steps", "rejected", "residuals", "matrices", "us/step"
    );
    for (name, end, steps) in [
        ("delta-robot/delta.adm", 1.0, 20),
        ("pendulum/pendulum.adm", 20.0, 20),
    ] {
        let path = examples.join(name);
        let text = std::fs::read_to_string(&path).expect("the example is there");
        let bare = folder.join("without.adm");
        std::fs::write(&bare, without_friction(&text)).expect("a dataset is written");
        let models = [project(&path, end, steps), project(&bare, end, steps)];
        let mut times = [Vec::new(), Vec::new()];
        let mut reports = [None, None];
        // One after the other, so that both see the same machine.
        for _ in 0..RUNS {
            for k in 0..2 {
                let (time, report) = run(&models[k], &folder);
                times[k].push(time);
                reports[k] = Some(report);
            }
        }
        let mut per_step = [0.0; 2];
        for k in 0..2 {
            times[k].sort_by(f64::total_cmp);
            let report = reports[k].take().expect("a run");
            let (steps, work) = (report.statistics.steps, report.statistics.work);
            per_step[k] = 1e6 * times[k][RUNS / 2] / steps.steps as f64;
            println!(
                "{:<34} {:>7} {:>9} {:>10} {:>9} {:>10.1}",
                format!("{name}{}", ["", " without"][k]),
                steps.steps,
                steps.rejections + steps.failures,
                work.residuals,
                work.factorisations,
                per_step[k],
            );
        }
        println!(
            "{name}: {:.2} times the cost per step\n",
            per_step[0] / per_step[1]
        );
    }
    stuck(&folder);
    std::fs::remove_dir_all(&folder).expect("the folder is removed");
}
