//! Megabytes of a dataset read a second: `cargo bench -p dataset --bench parse`.
//!
//! The text is a machine as Adams View writes it, many times over with identifiers of its own:
//! small (the editor case: the time from a keystroke to the diagnostics) and large. Each figure is
//! the best of several runs, since other programs only make a run slower.
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]

use dataset::{Language, Source, SyntaxTree, read_dataset};
use std::fmt::Write;
use std::hint::black_box;
use std::time::Instant;

const HEAD: &str = "Adams View model name: many machines
!
!-------------------------------- SYSTEM UNITS ---------------------------------
!
UNITS/
, FORCE = NEWTON
, MASS = KILOGRAM
, LENGTH = MILLIMETER
, TIME = SECOND
!
PART/1
, GROUND
!
";

/// The machine whose identifiers start at `id`.
fn machine(text: &mut String, id: usize) -> std::fmt::Result {
    let [cm, pivot, base] = [id, id + 1, id + 2];
    let x = id as f64 * 0.731;
    writeln!(
        text,
        "!                        adams_view_name='machine.PART_{id}'\nPART/{id}\n\
         , MASS = 1.273{id}E-002\n, CM = {cm}\n, IP = 1.042353938E-003, 9.999956288E-004, 1.5E-003\n\
         , QG = {x}, 0, 1501.999999\n, REULER = 90D, 45.00001813D, 179.9885408D\n!"
    )?;
    for (marker, part) in [(cm, id), (pivot, id), (base, 1)] {
        writeln!(
            text,
            "!                        adams_view_name='MARKER_{marker}'\nMARKER/{marker}\n\
             , PART = {part}\n, QP = 1002.602635, {x}, 1501.999999\n\
             , REULER = 90D, 90.00001813D, 179.9885408D\n!"
        )?;
    }
    writeln!(
        text,
        "!                        adams_view_name='JOINT_{id}'\nJOINT/{id}\n, REVOLUTE\n\
         , I = {pivot}\n, J = {base}\n!\n\
         FRICTION/{id}\n, JOINT = {id}\n, MU_STATIC = 0.3\n, MU_DYNAMIC = 0.2\n\
         , PIN_RADIUS = 12.5\n, FRICTION_ARM = 12.5\n, BENDING_REACTION_ARM = 40\n\
         , STICTION_TRANSITION_VELOCITY = 0.1\n, MAX_STICTION_DEFORMATION = 0.01\n!\n\
         SFORCE/{id}\n, ROTATIONAL\n, I = {pivot}\n, J = {base}\n\
         , FUNCTION = -1.0E+002*(AZ({pivot},{base}) - 30D) - 0.5*WZ({pivot},{base},{base})\n\
         , + STEP(TIME, 0.1, 0, 0.2, 1)*SIN(2*PI*TIME)\n!\n\
         VARIABLE/{id}\n, FUNCTION = 0.5*TIME + DM({pivot},{base})\n!\n\
         GRAPHICS/{id}\n, CYLINDER\n, CM = {base}\n, LENGTH = 0.8\n, RADIUS = 0.05\n!\n\
         REQUEST/{id}\n, F2 = AZ({pivot},{base})\\\n, F3 = WZ({pivot},{base},{base})\\\n\
         , CNAMES = \"\", \"angle\", \"rate\"\n!"
    )
}

/// At least `bytes` bytes of machines.
fn text(bytes: usize) -> String {
    let mut text = String::with_capacity(bytes + 4000);
    text.push_str(HEAD);
    let mut id = 10;
    while text.len() < bytes {
        // Writing to a String cannot fail.
        let _ = machine(&mut text, id);
        id += 10;
    }
    text.push_str("OUTPUT/\n, REQSAVE\n!\nEND\n");
    text
}

/// The shortest time of several runs, seconds.
fn best<T>(runs: usize, mut run: impl FnMut() -> T) -> f64 {
    (0..runs)
        .map(|_| {
            let begin = Instant::now();
            let result = black_box(run());
            let seconds = begin.elapsed().as_secs_f64();
            drop(result);
            seconds
        })
        .fold(f64::INFINITY, f64::min)
}

fn main() {
    for (name, bytes, runs) in [("400 kB", 400_000, 40), ("100 MB", 100_000_000, 3)] {
        let bytes = text(bytes).into_bytes();
        let Ok(source) = Source::from_bytes("bench.adm", &bytes) else {
            println!("the text is refused");
            return;
        };
        let (dataset, diagnostics) = read_dataset(&source);
        if let Some(first) = diagnostics.first() {
            println!("{}", first.render(&source));
            return;
        }
        drop(dataset);
        let decode = best(runs, || Source::from_bytes("bench.adm", &bytes));
        let tree = best(runs, || SyntaxTree::new(&source, Language::Dataset));
        let read = best(runs, || read_dataset(&source));
        let total = decode + read;
        let rate = |seconds: f64| bytes.len() as f64 / seconds * 1e-6;
        println!(
            "{name}: {:.2} ms from bytes to diagnostics, {:.0} MB/s on one core \
             (decode {:.0} MB/s, statements {:.0} MB/s, read and check {:.0} MB/s)",
            total * 1e3,
            rate(total),
            rate(decode),
            rate(tree),
            rate(read),
        );
    }
}
