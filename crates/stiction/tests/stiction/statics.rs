//! Static and quasi-static simulations by command files.

use results::ResFile;
use stiction::{Outcome, Project};

use crate::runs::{Run, run_commands};

/// A block of a kilogram on an incline, with friction in its guide: `MU_STATIC` 0.3, creep 10 mm.
fn incline(degrees: f64, extra: &str) -> String {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    format!(
        "A block on an incline
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=20, IP=1, 1, 1
MARKER/20, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=1
FRICTION/1, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2
, STICTION_TRANSITION_VELOCITY=0.1, MAX_STICTION_DEFORMATION=0.01
, INITIAL_OVERLAP=1000, REACTION_ARM=1{extra}
ACCGRAV/JGRAV={:e}, KGRAV={:e}
END
",
        -9.81 * cosine,
        9.81 * sine
    )
}

fn run(dataset: &str, commands: &str) -> Run {
    run_commands(dataset, commands)
}

/// The only value of a component in a block of one row.
fn value(results: &ResFile, block: &str, name: &str) -> f64 {
    let column = results.column(name).unwrap();
    let block = results.block(block).unwrap();
    let values: Vec<f64> = block.column(column).collect();
    assert_eq!(values.len(), 1, "{name}");
    values[0]
}

#[test]
fn the_real_pendulum_finds_its_equilibrium_and_stays_in_it() {
    let Some(folder) = reference_data::path("adams-results/pendulum-static-dynamic") else {
        return;
    };
    let project = Project::load(&folder.join("rescale_analysis.acf")).unwrap();
    let run = Run::of(&project);
    assert_eq!(run.report.outcome, Outcome::Completed);
    let real = ResFile::read(folder.join("rescale_analysis.res")).unwrap();
    let names = |results: &ResFile| -> Vec<String> {
        let blocks = results.data.iter();
        blocks.map(|block| block.name.clone()).collect()
    };
    assert_eq!(names(&run.results), names(&real));
    let mut worst = 0.0_f64;
    for component in ["X", "Y", "PSI"] {
        for part in ["PART_2", "PART_3"] {
            let name = format!("{part}_XFORM.{component}");
            let expected = value(&real, "static_001", &name);
            let found = value(&run.results, "static_001", &name);
            worst = worst.max((found - expected).abs());
            let column = run.results.column(&name).unwrap();
            let dynamic = run.results.block("dynamic_001").unwrap();
            for later in dynamic.column(column) {
                worst = worst.max((later - expected).abs());
            }
        }
    }
    println!("largest difference to Adams: {worst:.2e} (inch, radians)");
    // Both hang straight down, which rounding alone can blur: 1e-16 of 12 inches, some operations.
    assert!(worst < 1e-12);
    let force = value(&run.results, "static_001", "JOINT_1.FY");
    // Masses have ten digits in the dataset.
    assert!((force - 67.317_818_223_981_42).abs() < 1e-9, "{force}");
    // The requests have the same times, the start once.
    let times = |text: &str| -> Vec<f64> {
        let rows = text.lines().skip(3);
        rows.map(|row| row.trim().parse().unwrap()).collect()
    };
    let expected = std::fs::read_to_string(folder.join("rescale_analysis.req")).unwrap();
    assert_eq!(times(&run.requests), times(&expected));
    assert!(run.messages.contains("converged in"), "{}", run.messages);
}

/// Spec 9.4 and 9.17: the creep d solves `mu_s psi(d/Dm) = tan(alpha)`.
#[test]
fn a_block_on_an_incline_is_held_by_its_creep() {
    for (degrees, creep) in [
        (5.0, 1.581_527_9e-3),
        (10.0, 3.384_218_7e-3),
        (15.0, 6.119_933_7e-3),
        (16.5, 8.203_029_8e-3),
    ] {
        let run = run(
            &incline(degrees, ""),
            "SIMULATE/STATIC\nSIMULATE/DYNAMIC, END=1, STEPS=10",
        );
        assert_eq!(run.report.outcome, Outcome::Completed, "{}", run.messages);
        let found = value(&run.results, "static_001", "PART_2_XFORM.Z");
        // Newton's method ends at rounding; the reference has eight figures, 5e-11 m.
        println!("{degrees} degrees: creep {found:.9e}, expected {creep:.7e}");
        assert!((found - creep).abs() < 1e-10);
        let reported = value(&run.results, "static_001", "FRICTION_1.CREEP_Z");
        assert!((reported - found).abs() < 1e-12);
        // It stays there in the motion that follows, with its creep.
        let column = run.results.column("PART_2_XFORM.Z").unwrap();
        let dynamic = run.results.block("dynamic_001").unwrap();
        for later in dynamic.column(column) {
            assert!((later - creep).abs() < 1e-9, "{degrees}: {later}");
        }
    }
}

#[test]
fn a_block_that_friction_cannot_hold_has_no_equilibrium() {
    let steep = run(&incline(17.0, ""), "SIMULATE/STATIC");
    let Outcome::IntegrationFailed(text) = &steep.report.outcome else {
        panic!("{:?}", steep.report.outcome)
    };
    println!("{text}");
    assert!(text.contains("error[equilibrium]") && text.contains("FRICTION/1"));
    assert!(steep.messages.contains("FRICTION/1"));
    assert!(steep.results.block("initialConditions_001").is_none());
    // Without friction in statics nothing holds the block; in dynamics it sticks.
    let inactive = incline(10.0, ", INACTIVE=STATIC");
    let run_static = run(&inactive, "SIMULATE/STATIC");
    assert!(
        matches!(run_static.report.outcome, Outcome::IntegrationFailed(_)),
        "{:?}",
        run_static.report.outcome
    );
    let dynamic = run(&inactive, "SIMULATE/DYNAMIC, END=3, STEPS=3");
    assert_eq!(dynamic.report.outcome, Outcome::Completed);
    let end = *dynamic
        .results
        .get("PART_2_XFORM.Z")
        .unwrap()
        .last()
        .unwrap();
    // Spec 9.4: 3.3842188e-3 m after 3 s.
    assert!((end - 3.384_218_8e-3).abs() < 1e-6, "{end}");
}

const SPRING: &str = "A block on a spring
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2, QP=0, 0, 0
JOINT/1, TRANSLATIONAL, I=20, J=1
SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=10*TIME-40*DZ(20)-VZ(20)
REQUEST/1, F2=MODE\\ F3=DZ(20)
END
";

#[test]
fn a_sweep_is_one_equilibrium_after_another() {
    let run = run(
        SPRING,
        "SIMULATE/STATIC, END=1, STEPS=4\nSIMULATE/QUASISTATIC, DURATION=1, DTOUT=0.5",
    );
    assert_eq!(run.report.outcome, Outcome::Completed, "{}", run.messages);
    let column = run.results.column("PART_2_XFORM.Z").unwrap();
    let mut found = Vec::new();
    for name in ["quasiStatic_001", "quasiStatic_002"] {
        let block = run.results.block(name).unwrap();
        found.extend(block.times.iter().copied().zip(block.column(column)));
    }
    // The second sweep goes on from the end of the first.
    let times: Vec<f64> = found.iter().map(|(time, _)| *time).collect();
    assert_eq!(times, [0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0]);
    for (time, displacement) in found {
        // An imbalance of 1e-4 on 40 per length.
        assert!((displacement - 0.25 * time).abs() < 2.5e-6, "{time}");
    }
    assert_eq!(run.report.outputs, 7);
}

/// The creep that holds a part of the limit: psi(s) = (15 s - 10 s^3 + 3 s^5)/8, spec 1.1.
fn creep(part: f64, largest: f64) -> f64 {
    let psi = |s: f64| s * (15.0 - 10.0 * s * s + 3.0 * s.powi(4)) / 8.0;
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if psi(middle) < part {
            low = middle;
        } else {
            high = middle;
        }
    }
    low * largest
}

#[test]
fn a_sweep_follows_the_creep_until_friction_holds_no_more() {
    // The limit is 0.3 * 9.81 N; 4.4 N more a unit of time reach it at 0.669.
    let dataset = incline(0.0, "").replace(
        "END\n",
        "SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=4.4*TIME\nEND\n",
    );
    let run = run(&dataset, "SIMULATE/QUASISTATIC, END=1, STEPS=10");
    let Outcome::IntegrationFailed(text) = &run.report.outcome else {
        panic!("{:?}", run.report.outcome)
    };
    assert!(
        text.contains("at time 0.7") && text.contains("FRICTION/1 is saturated"),
        "{text}"
    );
    // What was found before is kept.
    let column = run.results.column("PART_2_XFORM.Z").unwrap();
    let block = run.results.block("quasiStatic_001").unwrap();
    assert_eq!(block.times.len(), 7);
    for (time, found) in block.times.iter().zip(block.column(column)) {
        let expected = creep(4.4 * time / (0.3 * 9.81), 0.01);
        // Newton's method ends at rounding; the slope of the law falls to a third.
        assert!(
            (found - expected).abs() < 1e-9,
            "{time}: {found} {expected}"
        );
    }
}

#[test]
fn creep_goes_back_with_the_load() {
    let dataset = incline(0.0, "").replace(
        "END\n",
        "SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=2.8*SIN(TIME)\nEND\n",
    );
    let commands = "SIMULATE/STATIC, END=6.283185307179586, STEPS=24";
    let run = run(&dataset, commands);
    assert_eq!(run.report.outcome, Outcome::Completed, "{}", run.messages);
    let column = run.results.column("PART_2_XFORM.Z").unwrap();
    let block = run.results.block("quasiStatic_001").unwrap();
    for (time, found) in block.times.iter().zip(block.column(column)) {
        let part = 2.8 * time.sin() / (0.3 * 9.81);
        let expected = creep(part.abs(), 0.01) * part.signum();
        // Newton's method ends at rounding; the slope of the law falls to a fifth.
        assert!(
            (found - expected).abs() < 1e-9,
            "{time}: {found} {expected}"
        );
    }
}

#[test]
fn an_equilibrium_between_motions_takes_their_speed() {
    let dataset = SPRING.replace("10*TIME", "10").replace("-VZ(20)", "");
    let commands = "SIMULATE/DYNAMIC, END=0.3, STEPS=3\nSIMULATE/STATIC\n\
                    SIMULATE/DYNAMIC, DURATION=1, STEPS=5";
    let run = run(&dataset, commands);
    assert_eq!(run.report.outcome, Outcome::Completed, "{}", run.messages);
    let names: Vec<&str> = run.results.data.iter().map(|b| b.name.as_str()).collect();
    let expected = [
        "modelInput_001",
        "initialConditions_001",
        "dynamic_001",
        "static_001",
        "initialConditions_002",
        "dynamic_002",
    ];
    assert_eq!(names, expected);
    let values = |block: &str, name: &str| -> Vec<f64> {
        let column = run.results.column(name).unwrap();
        run.results.block(block).unwrap().column(column).collect()
    };
    assert!(values("dynamic_001", "PART_2_XFORM.VZ")[2] > 0.5);
    assert_eq!(value(&run.results, "static_001", "PART_2_XFORM.VZ"), 0.0);
    // Without damping only an exact equilibrium keeps the block where it is.
    for position in values("dynamic_002", "PART_2_XFORM.Z") {
        assert!((position - 0.25).abs() < 1e-12, "{position}");
    }
    // Four times of the first motion, one of the equilibrium, five of the second motion, each with
    // the line of REQUEST/1.
    assert_eq!(run.requests.lines().skip(4).count(), 2 * 10);
}

#[test]
fn sensors_end_sweeps() {
    let dataset = SPRING.replace(
        "END\n",
        "SENSOR/1, GE, VALUE=0.1, ERROR=1E-6, RETURN, FUNCTION=DZ(20)\nEND\n",
    );
    let run = run(&dataset, "SIMULATE/STATIC, END=1, STEPS=10");
    assert_eq!(run.report.outcome, Outcome::Completed);
    // 0.25 a unit of time.
    assert_eq!((run.report.time, run.report.outputs), (0.4, 5));
}

#[test]
fn a_sweep_starts_anew_from_a_changed_model() {
    let run = run(
        SPRING,
        "SIMULATE/STATIC\nEQUILIBRIUM/MAXIT=30\nSIMULATE/STATIC, END=1, STEPS=1\n\
         SFORCE/1, FUNCTION=20*TIME-40*DZ(20)\nSIMULATE/STATIC, END=2, STEPS=1",
    );
    assert_eq!(run.report.outcome, Outcome::Completed, "{}", run.messages);
    let column = run.results.column("PART_2_XFORM.Z").unwrap();
    let rows = |name: &str| -> Vec<(f64, f64)> {
        let block = run.results.block(name).unwrap();
        let times = block.times.iter().copied();
        times.zip(block.column(column)).collect()
    };
    for (name, expected) in [
        ("static_001", vec![(0.0, 0.0)]),
        ("quasiStatic_001", vec![(1.0, 0.25)]),
        ("quasiStatic_002", vec![(1.0, 0.5), (2.0, 1.0)]),
    ] {
        let found = rows(name);
        assert_eq!(found.len(), expected.len(), "{name}");
        for (found, expected) in found.iter().zip(&expected) {
            assert_eq!(found.0, expected.0, "{name}");
            // An imbalance of 1e-4 on 40 per length.
            assert!((found.1 - expected.1).abs() < 2.5e-6, "{name}");
        }
    }
}

#[test]
fn mode_tells_the_analysis() {
    let run = run(
        SPRING,
        "SIMULATE/STATIC\nSIMULATE/STATIC, END=1, STEPS=1\nSIMULATE/DYNAMIC, END=2, STEPS=1",
    );
    assert_eq!(run.report.outcome, Outcome::Completed, "{}", run.messages);
    for (block, mode) in [
        ("static_001", 5.0),
        ("quasiStatic_001", 6.0),
        ("initialConditions_001", 4.0),
        ("dynamic_001", 4.0),
    ] {
        assert_eq!(value(&run.results, block, "REQUEST_1.F2"), mode, "{block}");
    }
}

#[test]
fn equilibrium_settings_are_those_of_the_statement_and_the_commands() {
    // Two iterations of at most a millimetre do not reach a displacement of 0.25.
    let short = SPRING.replace(
        "END\n",
        "EQUILIBRIUM/MAXIT=2, TLIMIT=0.001, METHOD=ALL\nEND\n",
    );
    let pull = "SFORCE/1, FUNCTION=10-40*DZ(20)-VZ(20)\n";
    let failed = run(&short, &format!("{pull}SIMULATE/STATIC"));
    assert!(
        matches!(failed.report.outcome, Outcome::IntegrationFailed(_)),
        "{:?}",
        failed.report.outcome
    );
    assert!(failed.messages.contains("METHOD"), "{}", failed.messages);
    let enough = format!("{pull}EQUILIBRIUM/MAXIT=1000\nSIMULATE/STATIC");
    let found = run(&short, &enough);
    assert_eq!(found.report.outcome, Outcome::Completed);
    let position = value(&found.results, "static_001", "PART_2_XFORM.Z");
    assert!((position - 0.25).abs() < 2.5e-6, "{position}");
}

/// Friction that rests in statics has no creep from how far the model moved there.
#[test]
fn a_model_at_rest_stays_where_statics_left_it() {
    let spring = SPRING.replace(
        "REQUEST/1",
        "ACCGRAV/JGRAV=-10\nFRICTION/1, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, INACTIVE=STATIC\nREQUEST/1",
    );
    let spring = spring.replace("10*TIME-40*DZ(20)", "20-40*DZ(20)");
    let run = run(&spring, "SIMULATE/STATIC\nSIMULATE/DYNAMIC, END=1, STEPS=5");
    assert_eq!(run.report.outcome, Outcome::Completed, "{}", run.messages);
    let column = run.results.column("PART_2_XFORM.Z").unwrap();
    let block = run.results.block("dynamic_001").unwrap();
    for z in block.column(column) {
        // An imbalance of 1e-4 on 40 per length.
        assert!((z - 0.5).abs() < 2.5e-6, "{z}");
    }
}
