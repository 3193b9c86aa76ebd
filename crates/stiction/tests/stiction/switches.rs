//! Functions that jump, met where they jump, and motions that stay there, against closed forms.

use results::ResFile;
use stiction::{Outcome, Project, RunOptions, RunReport};

use crate::shared::{run_with_log, scratch_folder};

/// Results, report and message file of a run.
struct Ran {
    results: ResFile,
    report: RunReport,
    log: String,
}

impl Ran {
    fn column(&self, column: &str) -> Vec<f64> {
        let name = format!("REQUEST_1.{column}");
        self.results.get(&name).unwrap_or_else(|_| panic!("{name}"))
    }

    /// The largest difference of a column from a function of time.
    fn error(&self, column: &str, exact: impl Fn(f64) -> f64) -> f64 {
        let values = self.column(column);
        let pairs = self
            .results
            .get("time.TIME")
            .unwrap()
            .into_iter()
            .zip(values);
        pairs.fold(0.0_f64, |worst, (t, value)| {
            worst.max((value - exact(t)).abs())
        })
    }

    fn steps(&self) -> usize {
        self.report.statistics.steps.steps
    }
}

/// A block of 2 kg on a guide along z with the statements given, and requests of its place (F2),
/// velocity (F3) and acceleration (F4).
fn block(statements: &str, integrator: &str) -> String {
    format!(
        "A block on a guide
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=1
REQUEST/1, F2=DZ(20, 1)\\F3=VZ(20, 1)\\F4=ACCZ(20, 1)
{statements}
INTEGRATOR/GSTIFF, {integrator}
END
"
    )
}

fn force(function: &str) -> String {
    format!("SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION={function}")
}

fn carry_out(text: &str, end: f64, steps: u32) -> (RunReport, ResFile, String) {
    let folder = scratch_folder();
    let file = folder.join("model.adm");
    std::fs::write(&file, text).unwrap();
    let mut project = Project::load(&file).unwrap_or_else(|error| panic!("{error}"));
    project.push_dynamic(end, Some(steps), None);
    let ran = run_with_log(&project, RunOptions::default());
    std::fs::remove_dir_all(folder).unwrap();
    ran
}

/// The same of what must go through.
fn run(text: &str, end: f64, steps: u32) -> Ran {
    let (report, results, log) = carry_out(text, end, steps);
    assert_eq!(report.outcome, Outcome::Completed, "{log}");
    Ran {
        results,
        report,
        log,
    }
}

const BOTH: [&str; 2] = ["SI2", "I3"];
const ERRORS: [f64; 3] = [1e-4, 1e-6, 1e-8];

/// Runs a block with a force by both formulations and with all errors; gives each run to `check` with
/// its error.
fn sweep(statements: &str, end: f64, steps: u32, mut check: impl FnMut(&Ran, f64)) {
    for formulation in BOTH {
        for error in ERRORS {
            let integrator = format!("{formulation}, ERROR={error:E}");
            let ran = run(&block(statements, &integrator), end, steps);
            let counts = ran.report.statistics.steps;
            println!(
                "{integrator}: {} steps, {} rejected, {} starts",
                counts.steps, counts.rejections, counts.starts
            );
            check(&ran, error);
        }
    }
}

#[test]
fn a_square_wave_is_followed_from_corner_to_corner() {
    // Acceleration ±2 for 0.1 s each. Between the jumps the velocity is a line, which the formulas
    // take exactly: what is left is rounding, unless a jump is stepped over.
    let velocity = |t: f64| {
        let t = t % 0.2;
        if t < 0.1 { 2.0 * t } else { 0.4 - 2.0 * t }
    };
    sweep(
        &force("IF(SIN(10*PI*TIME): -4, 0, 4)"),
        2.0,
        97,
        |ran, _| {
            // Velocities of I3 are places with twelve digits divided by short steps.
            assert!(ran.error("F3", velocity) < 1e-9);
            let counts = ran.report.statistics.steps;
            assert_eq!(counts.rejections, 0);
            // Twenty jumps, and up to as many steps between two as a start takes.
            assert!(counts.starts <= 22 && counts.steps < 700);
        },
    );
}

#[test]
fn oscillations_within_a_step_are_not_stepped_over() {
    // Acceleration ±0.5: the velocity is a triangle of 200 Hz and stays below 0.00125, in steps that
    // would be a hundred periods long.
    let velocity = |t: f64| {
        let t = t % 0.005;
        0.5 * t.min(0.005 - t)
    };
    for wave in ["SIN(2*PI*200*TIME)", "COS(2*PI*200*(TIME-0.00125))"] {
        for error in [1e-2, 1e-3, 1e-6] {
            let text = block(
                &force(&format!("SIGN(1, {wave})")),
                &format!("SI2, ERROR={error:E}"),
            );
            let ran = run(&text, 1.0, 97);
            assert!(ran.error("F3", velocity) < 1e-10, "{wave} {error}");
            assert!(ran.report.statistics.steps.starts <= 402);
        }
    }
    // A pulse of 1 ms between two points at which the argument has the same value; its first bend is
    // all that tells of it.
    let pulse = force("IF(ABS(TIME-0.612)-0.0005: 1000, 0, 0)");
    for error in [1e-2, 1e-4, 1e-6] {
        let ran = run(&block(&pulse, &format!("SI2, ERROR={error:E}")), 1.0, 10);
        let velocity = |t: f64| if t < 0.612 { 0.0 } else { 0.5 };
        assert!(ran.error("F3", velocity) < 1e-10, "{error}");
    }
}

#[test]
fn a_force_that_alternates_along_the_way_keeps_the_energy() {
    // The force ∓0.1 N turns every 0.01 m: v² + 0.1 w = 1 with the way w since it was last -0.1 N,
    // there and back.
    let function = "-SIGN(0.1, SIN(2*PI*50*DZ(20, 1)))";
    for formulation in BOTH {
        for error in ERRORS {
            // With a longest step, by which all is slow.
            let integrator = format!("{formulation}, ERROR={error:E}, HMAX=1000");
            let text = block(&force(function), &integrator).replace("MASS=2", "MASS=2, VZ=1");
            let ran = run(&text, 2.0, 97);
            let pairs = ran.column("F2").into_iter().zip(ran.column("F3")).skip(1);
            let worst = pairs.fold(0.0_f64, |worst, (z, v)| {
                let way = z.rem_euclid(0.02);
                worst.max((v * v + 0.1 * way.min(0.02 - way) - 1.0).abs())
            });
            let counts = ran.report.statistics.steps;
            println!("{integrator}: {worst:.1e}, {counts:?}");
            // Two hundred steps, from jump to jump, that may each be off by the tolerance in v.
            assert!(worst < 2.0 * 200.0 * error, "{worst:e}");
            assert!((195..=205).contains(&counts.starts) && !ran.log.contains("chatter"));
        }
    }
}

#[test]
fn jumps_that_nothing_can_be_told_of_cost_nothing() {
    // A thousand million teeth are their mean, a hundred thousand stairs their slope: v = t/4, v = t²/4.
    type Velocity = fn(f64) -> f64;
    let tests: [(&str, Velocity); 3] = [
        ("MOD(1E9*TIME, 1)", |t| 0.25 * t),
        ("ANINT(1E5*TIME)/1E5", |t| 0.25 * t * t),
        ("TIME + SIGN(1E-9, SIN(1000*TIME))", |t| 0.25 * t * t),
    ];
    for (function, velocity) in tests {
        for formulation in BOTH {
            for error in [1e-3, 1e-5] {
                let integrator = format!("{formulation}, ERROR={error:E}");
                let ran = run(&block(&force(function), &integrator), 1.0, 50);
                let worst = ran.error("F3", velocity);
                println!(
                    "{function}, {integrator}: {worst:.1e}, {} steps",
                    ran.steps()
                );
                // A hundred steps, each off by a tenth of the tolerance where a jump is passed over.
                assert!(worst < 10.0 * error);
                assert!(ran.steps() < 200);
                assert!(ran.report.statistics.steps.starts < 5);
            }
        }
    }
    // A spring of 100 N/m whose place comes in 12 bits: ω² = 50.
    let spring = force("-100*ANINT(4096*DZ(20, 1))/4096");
    let text = block(&spring, "SI2, ERROR=1E-3").replace("MASS=2", "MASS=2, VZ=1");
    let ran = run(&text, 1.0, 50);
    let omega = 50.0_f64.sqrt();
    // Fifty steps of an error of 1e-3.
    let place = ran.column("F2").into_iter().skip(1);
    let times = ran.results.get("time.TIME").unwrap().into_iter().skip(1);
    let worst = times.zip(place).fold(0.0_f64, |worst, (t, z)| {
        worst.max((z - (omega * t).sin() / omega).abs())
    });
    assert!(
        worst < 1e-2 && ran.steps() < 200,
        "{worst:e} {}",
        ran.steps()
    );
    // What another switch reads is met however small it is in the motion.
    let gate = force("IF(MOD(TIME, 0.1) - 0.05: 0, 0, 4)");
    let ran = run(&block(&gate, "SI2, ERROR=1E-2"), 1.0, 50);
    let velocity = |t: f64| {
        let n = (t / 0.1 + 1e-12).floor();
        0.1 * n + 2.0 * (t - 0.1 * n - 0.05).max(0.0)
    };
    assert!(ran.error("F3", velocity) < 1e-9);
}

#[test]
fn saw_teeth_and_stairs_are_followed() {
    // A hundred teeth of 2 MOD(t, 0.01)/m = t mod 0.01.
    let saw = |t: f64| {
        let n = (t / 0.01).floor();
        let rest = t - 0.01 * n;
        0.5e-4 * n + 0.5 * rest * rest
    };
    sweep(&force("2*MOD(TIME, 0.01)"), 1.0, 97, |ran, error| {
        assert!(ran.error("F3", saw) < 1e-3 * error);
        let counts = ran.report.statistics.steps;
        // At a tight error the step that grows behind a jump may be tried once too long.
        assert!(counts.rejections <= 100 && counts.starts <= 102 && counts.steps < 2500);
    });
    // Integral of the integer part of 10 t, and of the nearest integer, half a stair before it.
    let stairs = |t: f64| {
        let n = (10.0 * t).floor();
        0.1 * n * (n - 1.0) / 2.0 + n * (t - 0.1 * n)
    };
    let velocity = |t: f64| 0.5 * (stairs(t) + stairs(t + 0.05));
    sweep(
        &force("AINT(10*TIME) + ANINT(10*TIME)"),
        1.0,
        97,
        |ran, error| {
            // Velocities of I3 have what the iteration leaves of positions, divided by the step.
            assert!(ran.error("F3", velocity) < 3.0 * error);
            let counts = ran.report.statistics.steps;
            assert!(counts.rejections == 0 && counts.starts <= 22 && counts.steps < 700);
        },
    );
}

#[test]
fn a_jump_at_an_output_has_the_value_that_the_function_has_there() {
    let forces = "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=IF(TIME-0.5: 1, 5, 3)
SFORCE/2, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=IF(TIME: 50, 40, 0)
SFORCE/3, TRANSLATIONAL, ACTIONONLY, I=20, J=1
, FUNCTION=2*IF(TIME-0.5: 0, 0, 1) + IF(TIME-0.5000001: 0, 0, 1)
REQUEST/2, F2=SFORCE(1, 0, 4, 1)\\F3=SFORCE(2, 0, 4, 1)";
    let velocity = |t: f64| {
        0.5 * t + (t - 0.5).max(0.0) + (t - 0.5).max(0.0) + 0.5 * (t - 0.500_000_1).max(0.0)
    };
    sweep(forces, 1.0, 10, |ran, error| {
        assert!(ran.error("F3", velocity) < 0.1 * error);
        let rows = ran.results.get("time.TIME").unwrap();
        let jump = ran.results.get("REQUEST_2.F2").unwrap();
        let start = ran.results.get("REQUEST_2.F3").unwrap();
        let mut seen = [false; 2];
        for (t, (jump, start)) in rows.iter().zip(jump.iter().zip(&start)).skip(1) {
            let held = if *t < 0.5 {
                1.0
            } else if *t > 0.5 {
                3.0
            } else {
                5.0
            };
            assert_eq!(*jump, held, "{t}");
            assert_eq!(*start, if *t > 0.0 { 0.0 } else { 40.0 }, "{t}");
            seen[0] |= *t == 0.5;
            seen[1] |= *t == 0.0;
        }
        assert_eq!(seen, [true; 2]);
        assert!(ran.steps() < 150);
    });
}

#[test]
fn a_relay_about_a_place_swings_without_loss() {
    // z'' = ∓2 about 0.09: parabolas with a period of four times √0.09.
    let quarter = 0.3;
    let place = |t: f64| {
        let u = t % (4.0 * quarter);
        if u < quarter {
            u * u
        } else if u < 3.0 * quarter {
            0.18 - (u - 2.0 * quarter).powi(2)
        } else {
            (u - 4.0 * quarter).powi(2)
        }
    };
    sweep(
        &force("-SIGN(4, DZ(20, 1) - 0.09)"),
        12.0,
        97,
        |ran, error| {
            // Each of the twenty jumps may be met late by a few hundredths of the tolerance, which the
            // following ones carry on.
            assert!(ran.error("F2", place) < 20.0 * error);
            let counts = ran.report.statistics.steps;
            assert!(counts.rejections == 0 && counts.starts <= 22 && counts.steps < 1000);
            assert!(!ran.log.contains("chatter"));
        },
    );
}

#[test]
fn bends_are_stepped_over_and_keep_the_energy() {
    // A ball of 2 kg falls 0.1 m under 10 m/s² onto a spring of 800 N/m.
    let floor = "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1
, FUNCTION=IF(DZ(20, 1) + 0.1: -800*(DZ(20, 1) + 0.1), 0, 0) - 20";
    sweep(floor, 5.0, 97, |ran, error| {
        let (z, v) = (ran.column("F2"), ran.column("F3"));
        let energy = |(z, v): (&f64, &f64)| v * v + 20.0 * z + 400.0 * (z + 0.1).min(0.0).powi(2);
        let worst = z
            .iter()
            .zip(&v)
            .map(energy)
            .fold(0.0_f64, |m, e| m.max(e.abs()));
        println!("energy off by {worst:.1e} of 2 J");
        // Twenty bends within two thousand steps; at a bend the order is lost, as without a search.
        assert!(worst < 100.0 * error.powf(2.0 / 3.0));
        let counts = ran.report.statistics.steps;
        assert!(counts.steps < 2500 && !ran.log.contains("chatter"));
    });
}

#[test]
fn a_force_that_pushes_back_to_a_line_makes_the_motion_slide_along_it() {
    // Accelerated by 5 m/s² until z + v = 0.1; from there on, both sides push back to the line (Filippov
    // 1988): v = 0.1 - z.
    let t1 = (26.0_f64.sqrt() - 5.0) / 5.0;
    let rest = 0.1 - 2.5 * t1 * t1;
    let velocity = |t: f64| {
        if t < t1 {
            5.0 * t
        } else {
            rest * (t1 - t).exp()
        }
    };
    let place = |t: f64| {
        if t < t1 {
            2.5 * t * t
        } else {
            0.1 - rest * (t1 - t).exp()
        }
    };
    let acceleration = |t: f64| if t < t1 { 5.0 } else { -rest * (t1 - t).exp() };
    let function = "IF(DZ(20, 1) + VZ(20, 1) - 0.1: 10, 0, -10)";
    sweep(&force(function), 2.0, 97, |ran, error| {
        // The line is a width wide: the tolerance in z plus that in v.
        assert!(ran.error("F2", place) < 3.0 * error && ran.error("F3", velocity) < 3.0 * error);
        let times = ran.results.get("time.TIME").unwrap();
        for (t, a) in times.iter().zip(ran.column("F4")).skip(2) {
            // A thousandth of the jump of 10 m/s² is what a step may make the share wrong by; the
            // first ones are not tested.
            assert!((a - acceleration(*t)).abs() < 3e-2, "{t} {a}");
        }
        assert!(ran.steps() < 300);
        assert!(
            ran.log
                .contains("note[chatter]: SFORCE/1: IF jumps to and fro"),
            "{}",
            ran.log
        );
    });
}

/// Place and velocity of 2 kg under 15 sin 3t and dry friction of 10 N, by its closed form.
fn stick_slip(time: f64) -> (f64, f64) {
    let (mut start, mut place) = (0.0_f64, 0.0);
    loop {
        // It sticks until the force reaches the friction.
        let breaks = (2.0_f64 / 3.0).asin() / 3.0;
        let half = std::f64::consts::PI / 3.0;
        let turn = ((start - breaks) / half).ceil().max(0.0);
        let pushed = (3.0 * start).sin().abs() > 2.0 / 3.0;
        let t1 = if pushed { start } else { breaks + turn * half };
        if time <= t1 {
            return (place, 0.0);
        }
        let side = (3.0 * (t1 + 1e-9)).sin().signum();
        let velocity = |t: f64| 2.5 * ((3.0 * t1).cos() - (3.0 * t).cos()) - 5.0 * side * (t - t1);
        let travel = |t: f64| {
            2.5 * (3.0 * t1).cos() * (t - t1)
                - 5.0 / 6.0 * ((3.0 * t).sin() - (3.0 * t1).sin())
                - 2.5 * side * (t - t1).powi(2)
        };
        // It stops where the velocity has come back to zero.
        let mut before = t1 + 1e-3;
        while side * velocity(before + 1e-3) > 0.0 {
            before += 1e-3;
        }
        let mut after = before + 1e-3;
        while after - before > 1e-15 * after {
            let middle = 0.5 * (before + after);
            if middle <= before || middle >= after {
                break;
            }
            if side * velocity(middle) > 0.0 {
                before = middle;
            } else {
                after = middle;
            }
        }
        if time <= after {
            return (place + travel(time), velocity(time));
        }
        place += travel(after);
        start = after;
    }
}

#[test]
fn dry_friction_written_by_hand_holds_and_lets_go() {
    for friction in ["IF(VZ(20, 1): 10, 0, -10)", "-SIGN(10, VZ(20, 1))"] {
        // It holds a force below the friction,
        let held = force(&format!("{friction} + 5*SIN(3*TIME)"));
        sweep(&held, 2.0, 97, |ran, error| {
            assert!(
                ran.error("F2", |_| 0.0) < 2.0 * error && ran.error("F3", |_| 0.0) < 2.0 * error
            );
            // At time zero SIGN is what it is at zero; from then on the block rests.
            let worst = ran.column("F4")[2..]
                .iter()
                .fold(0.0_f64, |m, a| m.max(a.abs()));
            assert!(worst < 5e-3, "{worst}");
            assert!(ran.steps() < 150);
            assert!(ran.log.contains("note[chatter]"));
        });
        // and lets go of one above it, again and again.
        let pushed = force(&format!("{friction} + 15*SIN(3*TIME)"));
        sweep(&pushed, 10.0, 97, |ran, error| {
            let worst = [
                ran.error("F2", |t| stick_slip(t).0),
                ran.error("F3", |t| stick_slip(t).1),
            ];
            println!("stick-slip: {:.1e} {:.1e}", worst[0], worst[1]);
            // Nine slips in some hundred steps; the creep while it sticks, of up to a width a
            // second, adds up. Below 1e-7 the velocities of I3, rounding divided by the step, let go
            // late.
            let error = error.max(1e-7);
            assert!(worst[0] < 50.0 * error && worst[1] < 50.0 * error);
            assert!(ran.steps() < 2000);
        });
    }
}

/// A function need not be defined where an IF leaves it.
#[test]
fn branches_are_not_asked_beyond_their_jump() {
    // sqrt(1 - t) until t = 1, from then on 0.5: v = (1 - (1 - t)^1.5) 2/3 / m, then linear.
    let text = block(
        &force("IF(TIME-1: SQRT(1-TIME), 0, 0.5)"),
        "SI2, ERROR=1E-7",
    );
    let ran = run(&text, 2.0, 20);
    let speed = |t: f64| (1.0 - (1.0 - t).max(0.0).powf(1.5)) / 3.0 + 0.25 * (t - 1.0).max(0.0);
    // An error of 1e-7 a step over some hundred steps.
    let error = ran.error("F3", speed);
    assert!(error < 1e-5, "{error:e}");
    // An argument that is not a number is an error, not a branch.
    let text = block(&force("IF(SQRT(1-TIME): 1, 0, 2)"), "SI2, ERROR=1E-5");
    let (report, _, log) = carry_out(&text, 2.0, 20);
    assert!(matches!(report.outcome, Outcome::IntegrationFailed(_)));
    assert!(log.contains("not a finite number"), "{log}");
}

#[test]
fn functions_within_functions_switch_one_another() {
    // 1 m/s² until 0.3 s, then 2 m/s² until z = 0.1, then 3 m/s² until 0.8 m/s, which is kept.
    let function = "IF(TIME - 0.3: 2, 2,
, IF(DZ(20, 1) - 0.1: 4, 4, IF(VZ(20, 1) - 0.8: 6, 0, -6)))";
    let t2 = 0.3 + (0.31_f64.sqrt() - 0.3) / 2.0;
    let velocity = |t: f64| {
        if t < 0.3 {
            t
        } else if t < t2 {
            0.3 + 2.0 * (t - 0.3)
        } else {
            (0.31_f64.sqrt() + 3.0 * (t - t2)).min(0.8)
        }
    };
    sweep(&force(function), 1.0, 97, |ran, error| {
        assert!(ran.error("F3", velocity) < 5.0 * error);
        assert!(ran.steps() < 300);
    });
}

#[test]
fn states_and_variables_switch_too() {
    // A heater keeps DIF(1) at 1 from ln 1.5 on; the block's velocity follows 0.3 DIF(1) by a relay
    // that reads it through variables.
    let statements = "DIFF/1, IC=0, FUNCTION=IF(DIF(1) - 1: 3, 0, 0) - DIF(1)
VARIABLE/1, FUNCTION=IF(VARVAL(2): 10, 0, -10)
VARIABLE/2, FUNCTION=VZ(20, 1) - 0.3*DIF(1)
SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=VARVAL(1)
REQUEST/2, F2=DIF(1)";
    let heat = |t: f64| (3.0 - 3.0 * (-t).exp()).min(1.0);
    sweep(statements, 3.0, 97, |ran, error| {
        assert!(ran.error("F3", |t| 0.3 * heat(t)) < 3.0 * error);
        let kept = ran.results.get("REQUEST_2.F2").unwrap();
        let times = ran.results.get("time.TIME").unwrap();
        for (t, y) in times.iter().zip(kept) {
            assert!((y - heat(*t)).abs() < 10.0 * error, "{t} {y}");
        }
        assert!(ran.steps() < 400);
        assert!(ran.log.contains("DIFF/1: IF") && ran.log.contains("SFORCE/1: IF"));
    });
}

#[test]
fn a_relay_with_hysteresis_oscillates() {
    // h follows the sign of 0.2 h + 1 - y within a millisecond, and y' = 2 h - y: y goes to and fro
    // between 0.8 and 1.2, beyond which it gets in the delay.
    let statements = "DIFF/1, IC=0, FUNCTION=2*DIF(2) - DIF(1)
DIFF/2, IC=1, FUNCTION=1000*(SIGN(1, 0.2*DIF(2) + 1 - DIF(1)) - DIF(2))
REQUEST/2, F2=DIF(1)";
    sweep(statements, 5.0, 500, |ran, _| {
        let y = ran.results.get("REQUEST_2.F2").unwrap();
        let settled = &y[y.len() / 2..];
        let most = settled.iter().fold(f64::NEG_INFINITY, |m, y| m.max(*y));
        let least = settled.iter().fold(f64::INFINITY, |m, y| m.min(*y));
        assert!(
            (1.19..1.21).contains(&most) && (0.79..0.81).contains(&least),
            "{least} {most}"
        );
        // Nine periods of ln(1.2/0.8) + ln(3.2/2.8) = 0.54 s, two jumps each; behind each, steps
        // that resolve the millisecond.
        let counts = ran.report.statistics.steps;
        assert!((15..24).contains(&counts.starts), "{counts:?}");
        assert!(counts.steps < 6000, "{counts:?}");
    });
}

#[test]
fn jumps_that_come_ever_faster_come_to_an_end() {
    // A damped swing about a relay: the smaller it gets, the faster it is. Jumps that are met late by
    // a part of the width w = error feed it, at amplitudes A that go with A^1.5 = w.
    let function = "-SIGN(4, DZ(20, 1) - 0.09) - 2*VZ(20, 1)";
    sweep(&force(function), 15.0, 97, |ran, error| {
        let z = ran.column("F2");
        let left = (z[z.len() - 1] - 0.09).abs();
        println!("{left:.1e} left");
        assert!(left < 1e-4 + error.powf(2.0 / 3.0));
        assert!(ran.steps() < 20_000, "{}", ran.steps());
    });
}

#[test]
fn runs_with_jumps_are_the_same_every_time() {
    let text = block(
        &force("IF(VZ(20, 1): 10, 0, -10) + 15*SIN(3*TIME)"),
        "SI2, ERROR=1E-6",
    );
    let [first, second] = [0, 1].map(|_| run(&text, 5.0, 50));
    for column in ["F2", "F3", "F4"] {
        assert_eq!(first.column(column), second.column(column));
    }
    assert_eq!(first.report.statistics, second.report.statistics);
}

#[test]
fn states_of_any_magnitude_are_integrated_to_the_tolerance() {
    // y' = -3 y + a sin 50 t from y = b: y = (b + c 50) e^{-3t} + c (3 sin 50t - 50 cos 50t), c = a/2509.
    let exact = |a: f64, b: f64, t: f64| {
        let c = a / 2509.0;
        (b + 50.0 * c) * (-3.0 * t).exp() + c * (3.0 * (50.0 * t).sin() - 50.0 * (50.0 * t).cos())
    };
    let magnitudes = [
        (1e-12, 1e-12),
        (1e-12, 0.0),
        (1.0, 1.0),
        (1e9, 1e9),
        (0.0, 1e-15),
    ];
    for (a, b) in magnitudes {
        let statements = format!(
            "DIFF/1, IC={b:E}, FUNCTION=-3*DIF(1) + {a:E}*SIN(50*TIME)\nREQUEST/2, F2=DIF(1)"
        );
        for error in ERRORS {
            let ran = run(
                &block(&statements, &format!("SI2, ERROR={error:E}")),
                1.0,
                50,
            );
            let times = ran.results.get("time.TIME").unwrap();
            let states = ran.results.get("REQUEST_2.F2").unwrap();
            let pairs = times.iter().zip(&states).skip(1);
            let worst = pairs.fold(0.0_f64, |m, (t, y)| m.max((y - exact(a, b, *t)).abs()));
            let relative = worst / b.max(a / 50.0);
            println!(
                "{a:e} {b:e}: error {error:e}: {relative:.1e}, {} steps",
                ran.steps()
            );
            // Some hundred steps, each of which may be off by the tolerance.
            assert!(relative < 100.0 * error, "{a:e} {b:e}");
        }
    }
}
