//! What an expression costs with its gradient, against the same written by hand with its derivatives.
//!
//! The forms are those that real datasets use most: springs of DM and VR, contacts, dampers, angles,
//! IF, STEP, states. Value and gradient of both are compared before they are timed.
//!
//! `cargo bench -p stiction --bench expressions`
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]

use std::hint::black_box;
use std::time::Instant;

use mechanics::expression::{Input, Program};
use stiction::Project;

/// Evaluations in one measurement, and measurements whose median is taken.
const EVALUATIONS: usize = 200_000;
const RUNS: usize = 21;

/// Value, and slopes by what is read, in the order in which the form names it.
type Byhand = fn(&[f64; 4]) -> (f64, [f64; 4]);

fn step(x: f64, [x0, h0, x1, h1]: [f64; 4]) -> (f64, f64) {
    let s = (x - x0) / (x1 - x0);
    if s <= 0.0 {
        (h0, 0.0)
    } else if s >= 1.0 {
        (h1, 0.0)
    } else {
        let rise = h1 - h0;
        let slope = rise * 6.0 * s * (1.0 - s) / (x1 - x0);
        (h0 + rise * s * s * (3.0 - 2.0 * s), slope)
    }
}

/// The forms, what is read in their order, and the same by hand.
const FORMS: [(&str, [f64; 4], Byhand); 10] = [
    (
        "-100*(DM(20,1)-17.7)-3*VR(20,1)",
        [18.0, 0.4, 0.0, 0.0],
        |x| {
            (
                -100.0 * (x[0] - 17.7) - 3.0 * x[1],
                [-100.0, -3.0, 0.0, 0.0],
            )
        },
    ),
    (
        "IMPACT(DZ(20,1),VZ(20,1),1,1E5,2.2,50,0.1)",
        [0.95, -0.3, 0.0, 0.0],
        |x| {
            let depth = 1.0 - x[0];
            if depth <= 0.0 {
                return (0.0, [0.0; 4]);
            }
            let elastic = 1e5 * depth.powf(2.2);
            let stiffness = -2.2 * elastic / depth;
            let (share, slope) = step(x[0], [0.9, 1.0, 1.0, 0.0]);
            let value = elastic - 50.0 * x[1] * share;
            if value <= 0.0 {
                return (0.0, [0.0; 4]);
            }
            let by_x = stiffness - 50.0 * x[1] * slope;
            (value, [by_x, -50.0 * share, 0.0, 0.0])
        },
    ),
    ("-0.5*WZ(20,1)", [2.0, 0.0, 0.0, 0.0], |x| {
        (-0.5 * x[0], [-0.5, 0.0, 0.0, 0.0])
    }),
    (
        "-40*DZ(20,1,1)-2*VZ(20,1,1)+TIME",
        [0.3, -0.2, 0.5, 0.0],
        |x| (-40.0 * x[0] - 2.0 * x[1] + x[2], [-40.0, -2.0, 1.0, 0.0]),
    ),
    ("-30*(AZ(20,1)-30D)-WZ(20,1)", [0.7, 2.0, 0.0, 0.0], |x| {
        let value = -30.0 * (x[0] - 30.0_f64.to_radians()) - x[1];
        (value, [-30.0, -1.0, 0.0, 0.0])
    }),
    (
        "IF(DZ(20,1)-0.1: 0, 0, -1E4*(DZ(20,1)-0.1)-10*VZ(20,1))",
        [0.3, 0.3, 0.2, 0.0],
        |x| {
            if x[0] - 0.1 <= 0.0 {
                (0.0, [0.0; 4])
            } else {
                (-1e4 * (x[1] - 0.1) - 10.0 * x[2], [0.0, -1e4, -10.0, 0.0])
            }
        },
    ),
    (
        "STEP(TIME,0,0,1,50)*SIN(6*TIME)",
        [0.4, 0.4, 0.0, 0.0],
        |x| {
            let (value, slope) = step(x[0], [0.0, 0.0, 1.0, 50.0]);
            let (sine, cosine) = (6.0 * x[1]).sin_cos();
            (value * sine, [slope * sine, 6.0 * value * cosine, 0.0, 0.0])
        },
    ),
    ("DIF(1)*3+VARVAL(1)", [0.8, 0.3, 0.0, 0.0], |x| {
        // VARIABLE/1 is 2 DX.
        (x[0] * 3.0 + 2.0 * x[1], [3.0, 2.0, 0.0, 0.0])
    }),
    ("SQRT(DX(20,1)**2+DY(20,1)**2)", [0.6, 0.8, 0.0, 0.0], |x| {
        let value = (x[0] * x[0] + x[1] * x[1]).sqrt();
        (value, [x[0] / value, x[1] / value, 0.0, 0.0])
    }),
    (
        "(DX(20,1)*VX(20,1)+DY(20,1)*VY(20,1))/2",
        [0.6, 1.2, 0.8, -0.4],
        |x| {
            let value = (x[0] * x[1] + x[2] * x[3]) / 2.0;
            (value, [x[1] / 2.0, x[0] / 2.0, x[3] / 2.0, x[2] / 2.0])
        },
    ),
];

/// The program of a form.
fn program(form: &str) -> Program {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let file = folder.join("form.adm");
    let text = format!(
        "form\nPART/1, GROUND\nMARKER/1, PART=1\nPART/2, MASS=1, CM=20, IP=1, 1, 1\n\
         MARKER/20, PART=2\nVARIABLE/1, FUNCTION=2*DX(20,1)\nDIFF/1, IC=0, FUNCTION=1\n\
         SFORCE/1, TRANSLATIONAL, I=20, J=1, FUNCTION={form}\nEND\n"
    );
    std::fs::write(&file, text).expect("the file is written");
    let project = Project::load(&file).unwrap_or_else(|error| panic!("{error}"));
    let simulation = project
        .simulation()
        .unwrap_or_else(|error| panic!("{error}"));
    simulation.model().forces[0].function.clone()
}

/// Where a value is in the table that both read.
fn slot(input: Input) -> usize {
    match input {
        Input::Time => 8,
        Input::Measure(place) => place,
        Input::State(place) => 9 + place,
        other => panic!("{other:?}"),
    }
}

/// Median nanoseconds of one evaluation.
fn time(mut evaluate: impl FnMut()) -> f64 {
    let mut measured: Vec<f64> = (0..RUNS)
        .map(|_| {
            let start = Instant::now();
            for _ in 0..EVALUATIONS {
                evaluate();
            }
            1e9 * start.elapsed().as_secs_f64() / EVALUATIONS as f64
        })
        .collect();
    measured.sort_by(f64::total_cmp);
    measured[RUNS / 2]
}

fn main() {
    println!("{:<60}{:>10}{:>10}{:>8}", "form", "ns", "by hand", "ratio");
    for (form, values, by_hand) in FORMS {
        let program = program(form);
        let slots: Vec<usize> = program.inputs().map(slot).collect();
        // The variable comes first in the program.
        let order: Vec<usize> = match form.starts_with("DIF") {
            true => slots.iter().rev().copied().collect(),
            false => slots.clone(),
        };
        let mut table = [0.0; 12];
        for (slot, value) in order.iter().zip(values) {
            table[*slot] = value;
        }
        let mut registers = vec![0.0; program.len()];
        let mut adjoints = vec![0.0; program.len()];
        let mut slopes = [0.0; 12];
        let mut evaluate = |table: &[f64; 12], slopes: &mut [f64; 12]| {
            let value = program.evaluate(&mut registers, |input| table[slot(input)]);
            program.gradient(&registers, &mut adjoints, |input, slope| {
                slopes[slot(input)] += slope;
            });
            value
        };
        let value = evaluate(&table, &mut slopes);
        let (expected, by) = by_hand(&values);
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-12 * (1.0 + b.abs());
        assert!(close(value, expected), "{form}: {value} {expected}");
        let mut wanted = [0.0; 12];
        for (slot, slope) in order.iter().zip(by) {
            wanted[*slot] += slope;
        }
        for (slope, wanted) in slopes.iter().zip(wanted) {
            assert!(close(*slope, wanted), "{form}: {slopes:?} {wanted}");
        }
        let ours = time(|| {
            slopes.fill(0.0);
            black_box(evaluate(black_box(&table), &mut slopes));
            black_box(&slopes);
        });
        let mut sums = [0.0; 12];
        let hand = time(|| {
            sums.fill(0.0);
            let table = black_box(&table);
            let mut read = [0.0; 4];
            for (value, slot) in read.iter_mut().zip(&order) {
                *value = table[*slot];
            }
            let (value, by) = by_hand(&read);
            for (slot, slope) in order.iter().zip(by) {
                sums[*slot] += slope;
            }
            black_box(value);
            black_box(&sums);
        });
        println!("{form:<60}{ours:>10.1}{hand:>10.1}{:>8.2}", ours / hand);
    }
}
