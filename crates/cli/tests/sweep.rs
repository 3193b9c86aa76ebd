//! `stiction sweep`, driven from outside: tables, resuming, exit codes, located errors of study files.

#[cfg(unix)]
mod running;
mod shared;

use std::path::Path;
use std::process::Command;

#[cfg(unix)]
use running::Running;
use shared::{code, errors, folder, stiction};

/// A block that is pulled by 10 N/s and sticks until 0.3 * 2 * 9.81 N.
const BLOCK: &str = "A block that is pulled until it slides
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=0.005, 0.005, 0.005
MARKER/20, PART=2
!                            adams_view_name='GUIDE'
JOINT/5, TRANSLATIONAL, I=20, J=1
FRICTION/7, JOINT=5, MU_STATIC=0.3, MU_DYNAMIC=0.2, INPUTS=REACTION_FORCE
, STICTION_TRANSITION_VELOCITY=0.001, MAX_STICTION_DEFORMATION=1E-5
SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=10*TIME
END
";

const STUDY: &str = "model = \"block.adm\"
end = 0.05
dtout = 0.01

[parameters]
guide.mu_static = [0.25, 0.3, -1, 0.35]
\"FRICTION/7.max_stiction_deformation\" = { from = 10, to = 20, points = 3, unit = \"um\" }

[outputs]
peak = \"max_abs(guide.force)\"
longest = \"longest_stick(guide)\"
";

fn said(output: &std::process::Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn a_study_writes_the_same_table_with_any_number_of_workers() {
    let folder = folder("sweep", &[("block.adm", BLOCK), ("many.toml", STUDY)]);
    let one = stiction(&folder, &["sweep", "many.toml", "--workers", "1"]);
    assert_eq!(code(&one), 0, "{}", errors(&one));
    let text = said(&one);
    assert!(
        text.starts_with("12 of 12 cases done, 3 failed, "),
        "{text}"
    );
    assert!(
        text.contains("results in many-study: cases.parquet study.json\n"),
        "{text}"
    );
    assert!(text.contains("longest: 0.05"), "{text}");
    assert!(text.contains("case 6 (guide.mu_static = -1.0, "), "{text}");
    let three = [
        "sweep",
        "many.toml",
        "--workers",
        "3",
        "-o",
        "three",
        "--progress",
        "json",
    ];
    let three = stiction(&folder, &three);
    assert_eq!(code(&three), 0, "{}", errors(&three));
    assert!(
        errors(&three).contains("{\"cases\":12,\"done\":12,"),
        "{}",
        errors(&three)
    );
    let table = |name: &str| std::fs::read(folder.join(name).join("cases.parquet")).unwrap();
    assert_eq!(table("many-study"), table("three"));

    let again = stiction(&folder, &["sweep", "many.toml"]);
    assert_eq!(code(&again), 2);
    assert!(
        errors(&again).contains("it holds a study already"),
        "{}",
        errors(&again)
    );
    let resumed = stiction(&folder, &["sweep", "many.toml", "--resume"]);
    assert_eq!(code(&resumed), 0, "{}", errors(&resumed));
    std::fs::write(folder.join("many.toml"), STUDY.replace("0.35", "0.36")).unwrap();
    let other = stiction(&folder, &["sweep", "many.toml", "--resume"]);
    assert_eq!(code(&other), 2);
    assert!(
        errors(&other).contains("another study (values differ)"),
        "{}",
        errors(&other)
    );
}

/// What is said of a study file with one text in place of another.
fn told(folder: &Path, old: &str, new: &str) -> String {
    assert!(STUDY.contains(old), "{old}");
    std::fs::write(folder.join("wrong.toml"), STUDY.replacen(old, new, 1)).unwrap();
    let output = stiction(folder, &["sweep", "wrong.toml"]);
    assert_eq!(code(&output), 3, "{new}: {}", errors(&output));
    assert!(!folder.join("wrong-study").exists());
    errors(&output)
}

#[test]
fn what_is_wrong_with_a_study_file_is_told_with_its_place() {
    let folder = folder("wrong-study-files", &[("block.adm", BLOCK)]);
    let whole = told(&folder, "max_abs(guide.force)", "max_abs(guide.froce)");
    let expected = "wrong.toml:10:8: error[study-file]: there is no channel of friction \"froce\"
 10 | peak = \"max_abs(guide.froce)\"
    |        ^^^^^^^^^^^^^^^^^^^^^^
    = help: is force meant?
";
    assert_eq!(whole, expected);
    for (old, new, place, text) in [
        (
            "model = \"block.adm\"",
            "modell = \"block.adm\"",
            "1:1",
            "is model meant",
        ),
        ("model = \"block.adm\"", "seed = 1", "1:1", "names no model"),
        ("end = 0.05", "end = 0", "2:7", "positive number"),
        ("end = 0.05", "end = nan", "2:7", "positive number"),
        ("end = 0.05", "end = \"soon\"", "2:7", "end is not a number"),
        ("end = 0.05", "end = ", "2:7", ""),
        (
            "dtout = 0.01",
            "dtout = 0.01\nsteps = 5",
            "4:9",
            "say the same",
        ),
        ("dtout = 0.01", "cases = 4", "3:9", "leave their number out"),
        (
            "dtout = 0.01",
            "design = \"sobl\"",
            "3:10",
            "is sobol meant",
        ),
        (
            "dtout = 0.01",
            "cases = 0\ndesign = \"sobol\"",
            "3:9",
            "no cases",
        ),
        ("dtout = 0.01", "seed = -1", "3:8", "whole number"),
        (
            "guide.mu_static = [0.25, 0.3, -1, 0.35]",
            "gide.mu_static = [1]",
            "6:18",
            "is GUIDE meant",
        ),
        ("[0.25, 0.3, -1, 0.35]", "[]", "5:1", "no cases"),
        (
            "[0.25, 0.3, -1, 0.35]",
            "[0.3, inf]",
            "6:19",
            "finite number",
        ),
        (
            "[0.25, 0.3, -1, 0.35]",
            "[true]",
            "6:20",
            "number or a text",
        ),
        (
            "[0.25, 0.3, -1, 0.35]",
            "{ from = 0.2 }",
            "6:19",
            "two ends",
        ),
        (
            "[0.25, 0.3, -1, 0.35]",
            "{ from = 0.2, too = 1 }",
            "6:33",
            "is to meant",
        ),
        (
            "[0.25, 0.3, -1, 0.35]",
            "{ from = 0.2, to = 0.3 }",
            "5:1",
            "is a range",
        ),
        (
            "[0.25, 0.3, -1, 0.35]",
            "[-1, -2]",
            "6:19",
            "MU_STATIC must be greater than 0",
        ),
        (
            "unit = \"um\"",
            "unit = \"N\"",
            "7:41",
            "cannot be given in meter",
        ),
        ("unit = \"um\"", "unit = \"mu\"", "7:41", "no unit"),
        ("points = 3", "points = 1", "7:72", "at least two points"),
        ("[outputs]", "[output]", "9:2", "is outputs meant"),
        (
            "longest_stick(guide)",
            "longest(guide)",
            "11:11",
            "is longest_stick meant",
        ),
        ("longest =", "peak =", "11:1", ""),
        ("longest =", "steps =", "11:9", "take another name"),
    ] {
        let said = told(&folder, old, new);
        let start = format!("wrong.toml:{place}: error[study-file]: ");
        assert!(
            said.starts_with(&start) && said.contains(text),
            "{new}: {said}"
        );
    }
    let missing = told(&folder, "block.adm", "blck.adm");
    assert!(missing.contains("blck.adm"), "{missing}");
    let none = stiction(&folder, &["sweep", "none.toml"]);
    assert_eq!(code(&none), 3);
    assert!(
        errors(&none).contains("none.toml cannot be read"),
        "{}",
        errors(&none)
    );
}

#[test]
fn a_cluster_needs_the_python_package() {
    let folder = folder(
        "sweep-cluster",
        &[("block.adm", BLOCK), ("many.toml", STUDY)],
    );
    let output = Command::new(env!("CARGO_BIN_EXE_stiction"))
        .args(["sweep", "many.toml", "--cluster", "tcp://127.0.0.1:1"])
        .env("PATH", &folder)
        .current_dir(&folder)
        .output()
        .unwrap();
    assert_eq!(code(&output), 2);
    assert!(
        errors(&output).contains("--cluster needs python3"),
        "{}",
        errors(&output)
    );
}

#[cfg(unix)]
#[test]
fn an_interrupted_study_keeps_what_is_done() {
    // Far more cases than can be run before the signal comes.
    let many = STUDY.replace("points = 3", "points = 20000");
    let folder = folder(
        "sweep-interrupt",
        &[("block.adm", BLOCK.to_owned()), ("many.toml", many)],
    );
    let running = Running::start(&folder, &["sweep", "many.toml"]);
    let line = &running.line;
    assert!(line.starts_with("{\"cases\":80000,\"done\":"), "{line}");
    let output = running.interrupt();
    assert_eq!(code(&output), 130);
    assert!(
        said(&output).contains("--resume goes on from here"),
        "{}",
        said(&output)
    );
    let parts = folder.join("many-study/parts");
    let names = std::fs::read_dir(parts)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let names: Vec<_> = names.collect();
    assert!(
        !names.is_empty()
            && names
                .iter()
                .all(|name| name.extension().unwrap() == "parquet")
    );
}
