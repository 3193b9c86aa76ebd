//! Time, work and memory of the delta-robot replay: 1 s, 200 intervals with a restart each.
//!
//! `cargo bench -p stiction --bench delta_robot`; the reference data are needed.
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]

use std::path::Path;
use std::time::Instant;

struct Unwatched;
impl stiction::Watch for Unwatched {
    fn progress(&mut self, _: &stiction::Progress) -> bool {
        true
    }
}

/// Largest resident memory of this process so far, in megabytes, where the system tells.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1024.0)
}

fn main() {
    let file = "adams-results/delta-robot-friction/delta_robot_replay.acf";
    let Some(model) = reference_data::path(file) else {
        return;
    };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("delta-robot-bench");
    std::fs::create_dir_all(&folder).expect("a folder for the results");
    println!("error     median   min      max      steps  rejected  residuals  factorisations");
    for error in [1e-4, 1e-6, 1e-8] {
        let mut times = Vec::new();
        let mut statistics = None;
        for _ in 0..9 {
            let start = Instant::now();
            let project = stiction::Project::load(&model).expect("the model is read");
            let session = stiction::Session::new(&project).expect("the model is simulated");
            let options = stiction::RunOptions {
                error: Some(error),
                ..stiction::RunOptions::default()
            };
            let report = session
                .run(&folder, options, &mut Unwatched)
                .expect("results are written");
            times.push(start.elapsed().as_secs_f64());
            statistics = Some(report.statistics);
        }
        times.sort_by(f64::total_cmp);
        let s = statistics.expect("there was a run");
        println!(
            "{error:<9.0e} {:.3} s  {:.3} s  {:.3} s  {:5}  {:8}  {:9}  {:14}",
            times[times.len() / 2],
            times[0],
            times[times.len() - 1],
            s.steps.steps,
            s.steps.rejections,
            s.work.residuals,
            s.work.factorisations
        );
    }
    if let Some(memory) = peak_memory() {
        println!("peak memory {memory:.1} MB");
    }
}
