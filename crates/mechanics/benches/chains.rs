//! How the cost of assembly and steps grows with the number of bodies.
//!
//! A spatial chain of hinged rods, without and with loops (a strut over every ten rods) and friction in
//! every hinge. Prints the time of assembly, of the first steps (which search the order of the pivots)
//! and of a later step.
//!
//! `cargo bench -p mechanics --bench chains`
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]

use std::time::Instant;

use mechanics::model::Model;
use mechanics::{Ending, Formulation, Observer, Settings, Simulation, Snapshot, StepReport};
use mechanisms::chains;

/// `count` rods in a row from ground.
fn chain(count: usize, loops: bool, friction: bool) -> Model {
    let mut chain = chains::chain(count);
    if friction {
        chains::hinge_friction(&mut chain, |_| {
            mechanisms::law(0.1, 0.05, 0.05, 0.01).into()
        });
    }
    if loops {
        chains::brace(&mut chain);
    }
    chain.model
}

/// Ends a run after so many steps.
struct Steps(usize);
impl Observer for Steps {
    fn step(&mut self, _: &StepReport) -> bool {
        self.0 -= 1;
        self.0 > 0
    }
    fn output(&mut self, _: &Snapshot<'_>) -> bool {
        true
    }
}

fn main() {
    // Arguments: sizes instead of those below; cargo passes `--bench`, too.
    let given: Vec<usize> = std::env::args().filter_map(|a| a.parse().ok()).collect();
    let sizes = if given.is_empty() {
        vec![3, 10, 30, 100, 300, 1000, 3000]
    } else {
        given
    };
    println!("bodies loops friction  assembly  first 4 steps  step [us]  a body  matrices a step");
    for (loops, friction) in [(false, false), (false, true), (true, false), (true, true)] {
        for &count in &sizes {
            let mut simulation = Simulation::new(chain(count, loops, friction), 1.0);
            let start = Instant::now();
            simulation.assemble().expect("the chain is assembled");
            let assembly = start.elapsed().as_secs_f64();
            let settings = Settings {
                formulation: Formulation::Si2,
                error: 1e-4,
                highest_order: 5,
                longest_step: 0.01,
                shortest_step: 1e-9,
                first_step: Some(1e-4),
                newton_iterations: 10,
            };
            let mut run = |steps: usize| {
                let before = simulation.statistics();
                let start = Instant::now();
                let ending = simulation
                    .run(1e3, [0.0; 0], &settings, &mut Steps(steps))
                    .expect("the chain moves");
                assert_eq!(ending, Ending::Stopped);
                let after = simulation.statistics();
                let done = after.steps.steps - before.steps.steps;
                let matrices = after.work.factorisations - before.work.factorisations;
                (start.elapsed().as_secs_f64(), matrices as f64 / done as f64)
            };
            let (first, _) = run(4);
            let steps = (20_000 / count).clamp(30, 400);
            let (time, matrices) = run(steps);
            let step = 1e6 * time / steps as f64;
            println!(
                "{count:6} {loops:5} {friction:8} {assembly:8.3} s {first:12.3} s {step:10.1} {:7.2} {matrices:16.2}",
                step / count as f64
            );
        }
    }
}
