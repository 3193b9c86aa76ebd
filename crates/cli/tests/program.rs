//! The program, driven from outside: exit codes, folders, changes, kept results, JSON, Ctrl-C.

#[cfg(unix)]
mod running;
mod shared;

use std::path::Path;
use std::process::Command;

#[cfg(unix)]
use running::Running;
use shared::{code, errors, folder, stiction};

const PENDULUM: &str = "A pendulum
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND
ACCGRAV/KGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1, REULER=0, 90D, 0
PART/2, MASS=1, CM=20, IP=0.1, 0.1, 0.1, QG=1, 0, 0
MARKER/20, PART=2
MARKER/21, PART=2, QP=-1, 0, 0, REULER=0, 90D, 0
JOINT/1, REVOLUTE, I=21, J=1
FRICTION/103, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, PIN_RADIUS=0.05
END
";

fn json(bytes: &[u8]) -> serde_json::Value {
    serde_json::from_slice(bytes).unwrap()
}

#[test]
fn tables_are_written_instead_of_or_beside_the_res() {
    let folder = folder("tables", &[("p.adm", PENDULUM)]);
    let run = ["run", "p.adm", "--end", "0.1", "--dtout", "0.01"];
    let asked = ["--format", "parquet,csv", "-o", "tables"];
    let output = stiction(&folder, &[&run[..], &asked].concat());
    assert_eq!(code(&output), 0, "{}", errors(&output));
    let here = folder.join("tables");
    let text = |file: &str| std::fs::read_to_string(here.join(file)).unwrap();
    assert!(!here.join("p.res").exists() && here.join("friction.parquet").is_file());
    let states = text("states.csv");
    assert_eq!(states.lines().count(), 12);
    assert!(states.starts_with("time,analysis,PART_2_XFORM.X,"));
    let friction = text("friction.csv");
    assert!(
        friction.starts_with("time,friction,name,channel,value,unit\n0.0,103,FRICTION_103,FX,")
    );
    let facts = json(text("tables.json").as_bytes());
    assert_eq!(facts["outcome"], "completed");
    assert_eq!(facts["title"], "A pendulum");

    let both = ["--format", "res,csv", "-o", "both"];
    let output = stiction(&folder, &[&run[..], &both].concat());
    assert_eq!(code(&output), 0, "{}", errors(&output));
    assert!(folder.join("both/p.res").is_file() && folder.join("both/states.csv").is_file());
    let resumed = ["--format", "csv", "--checkpoint", "1", "-o", "resumed"];
    let output = stiction(&folder, &[&run[..], &resumed].concat());
    assert_eq!(code(&output), 2);
    assert!(errors(&output).contains("cannot be resumed"));
}

#[test]
fn a_run_writes_a_folder_and_does_not_overwrite_it() {
    let folder = folder("run", &[("p.adm", PENDULUM)]);
    let arguments = ["run", "p.adm", "--end", "0.1", "--dtout", "0.01"];
    let output = stiction(&folder, &arguments);
    assert_eq!(code(&output), 0, "{}", errors(&output));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        said.contains("p-run") && said.contains("FRICTION/103"),
        "{said}"
    );
    for file in ["p.res", "p.req", "p.msg", "run.json"] {
        assert!(folder.join("p-run").join(file).is_file(), "{file}");
    }
    let record = json(&std::fs::read(folder.join("p-run/run.json")).unwrap());
    assert_eq!(record["outcome"], "completed");
    assert_eq!(record["outputs"], 10);
    assert_eq!(record["options"]["end"], 0.1);
    assert_eq!(record["inputs"][0]["sha256"].as_str().unwrap().len(), 64);
    let message = std::fs::read_to_string(folder.join("p-run/p.msg")).unwrap();
    assert!(
        message.contains("The model has 1 degrees of freedom"),
        "{message}"
    );
    assert!(
        message.contains("SI2") && message.contains("Finished -----"),
        "{message}"
    );

    let again = stiction(&folder, &arguments);
    assert_eq!(code(&again), 2);
    assert!(errors(&again).contains("--force"), "{}", errors(&again));
    let forced = stiction(&folder, &[&arguments[..], &["--force"]].concat());
    assert_eq!(code(&forced), 0);
    let elsewhere = stiction(&folder, &[&arguments[..], &["-o", "there/deep"]].concat());
    assert_eq!(code(&elsewhere), 0);
    assert!(folder.join("there/deep/p.res").is_file());
}

#[test]
fn equal_runs_write_equal_results() {
    let folder = folder("equal", &[("p.adm", PENDULUM)]);
    for name in ["one", "two"] {
        let output = stiction(&folder, &["run", "p.adm", "--end", "0.5", "-o", name]);
        assert_eq!(code(&output), 0);
    }
    let read = |name: &str| std::fs::read(folder.join(name).join("p.res")).unwrap();
    assert_eq!(read("one"), read("two"));
}

#[test]
fn set_changes_the_friction() {
    let folder = folder("set", &[("p.adm", PENDULUM)]);
    let peak = |name: &str, set: &[&str]| {
        let arguments = ["run", "p.adm", "--end", "0.2", "--steps", "20", "-o", name];
        let output = stiction(&folder, &[&arguments[..], set].concat());
        assert_eq!(code(&output), 0, "{}", errors(&output));
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        let row = said
            .lines()
            .find(|line| line.starts_with("FRICTION/103"))
            .unwrap()
            .to_owned();
        let place = row
            .split_whitespace()
            .position(|word| word == "newton-meter")
            .unwrap();
        row.split_whitespace()
            .nth(place - 1)
            .unwrap()
            .parse::<f64>()
            .unwrap()
    };
    let plain = peak("plain", &[]);
    let more = peak(
        "more",
        &[
            "--set",
            "FRICTION/103.MU_STATIC=0.6",
            "--set",
            "FRICTION/103.MU_DYNAMIC=0.6",
        ],
    );
    assert!(more > 1.5 * plain, "{plain} and {more}");

    for (change, word) in [
        ("FRICTION/103.MU_STATC=0.6", "MU_STATIC"),
        ("FRICTION/7.MU_STATIC=0.6", "FRICTION/7"),
        ("FRICTION/103.MU_STATIC=-1", "MU_STATIC"),
    ] {
        let output = stiction(
            &folder,
            &["run", "p.adm", "--end", "1", "-o", "never", "--set", change],
        );
        assert_eq!(code(&output), 3, "{change}");
        assert!(
            errors(&output).contains(word),
            "{change}: {}",
            errors(&output)
        );
        assert!(!folder.join("never").exists(), "{change}");
    }
    let output = stiction(
        &folder,
        &["run", "p.adm", "--end", "1", "--set", "FRICTION/103"],
    );
    assert_eq!(code(&output), 2);
}

#[test]
fn wrong_usage_is_2() {
    let folder = folder(
        "usage",
        &[("p.adm", PENDULUM), ("p.acf", "\nFILE/MODEL=p\nSTOP\n")],
    );
    for arguments in [
        &["run", "p.adm"][..],
        &["run", "p.adm", "--end", "-1"],
        &[
            "run", "p.adm", "--end", "1", "--steps", "10", "--dtout", "0.1",
        ],
        &["run", "p.acf", "--end", "1"],
        &["run", "p.adm", "--end", "1", "--error", "0"],
        &["run", "p.adm", "--end", "1", "--integrator", "adam"],
        &["run"],
        &["walk", "p.adm"],
    ] {
        let output = stiction(&folder, arguments);
        assert_eq!(code(&output), 2, "{arguments:?}: {}", errors(&output));
    }
    assert!(!folder.join("p-run").exists());
}

#[test]
fn wrong_input_is_3_with_its_place() {
    let broken = PENDULUM.replace("REVOLUTE", "REVOLUT, BEND=3");
    let reading = PENDULUM.replace(
        "END",
        "SFORCE/1, ROTATIONAL, I=21, J=1, FUNCTION=USER(1)\nMOTION/1, JOINT=1, ROTATIONAL, \
         FUNCTION=DX(20)\nEND",
    );
    let files = [
        ("broken.adm", broken.as_str()),
        ("reading.adm", reading.as_str()),
        (
            "lost.acf",
            "\nFILE/MODEL=nowhere\nSIMULATE/DYNAMIC, END=1, STEPS=10\n",
        ),
        ("empty.adm", ""),
    ];
    let folder = folder("input", &files);
    for (file, words) in [
        ("broken.adm", &["broken.adm:9:", "BEND"][..]),
        (
            "reading.adm",
            &[
                "reading.adm:11:",
                "USER calls a subroutine",
                "reading.adm:12:",
                "TIME only",
            ],
        ),
        ("lost.acf", &["lost.acf:2:1: error[", "nowhere.adm"]),
        ("empty.adm", &["no statement"]),
        ("missing.adm", &["cannot read missing.adm"]),
    ] {
        let run = stiction(&folder, &["run", file, "-o", "never"]);
        let run = if file.ends_with(".adm") {
            stiction(&folder, &["run", file, "--end", "1", "-o", "never"])
        } else {
            run
        };
        let check = stiction(&folder, &["check", file]);
        for output in [run, check] {
            assert_eq!(code(&output), 3, "{file}: {}", errors(&output));
            for word in words {
                assert!(
                    errors(&output).contains(word),
                    "{file}: {}",
                    errors(&output)
                );
            }
        }
        assert!(!folder.join("never").exists(), "{file}");
    }
}

#[test]
fn a_model_that_cannot_be_assembled_is_4() {
    // The rod of 1 m cannot reach 3 m.
    let apart = PENDULUM.replace(
        "END",
        "MARKER/5, PART=1, QP=3, 0, 0\nMARKER/25, PART=2\nJOINT/2, SPHERICAL, I=25, J=5\nEND",
    );
    let folder = folder("apart", &[("apart.adm", apart.as_str())]);
    let output = stiction(&folder, &["run", "apart.adm", "--end", "1"]);
    assert_eq!(code(&output), 4, "{}", errors(&output));
    assert!(errors(&output).contains("JOINT/2"), "{}", errors(&output));
    let message = std::fs::read_to_string(folder.join("apart-run/apart.msg")).unwrap();
    assert!(message.contains("---- START: ERROR ----"), "{message}");
    assert_eq!(code(&stiction(&folder, &["check", "apart.adm"])), 4);
}

#[test]
fn a_failed_integration_is_5_and_keeps_the_results() {
    // The torque is no number after 0.5.
    let infinite = PENDULUM.replace(
        "END",
        "SFORCE/1, ROTATIONAL, I=21, J=1, FUNCTION=SQRT(0.5-TIME)\nEND",
    );
    let folder = folder("infinite", &[("infinite.adm", infinite.as_str())]);
    let output = stiction(
        &folder,
        &["run", "infinite.adm", "--end", "1", "--steps", "100"],
    );
    assert_eq!(code(&output), 5, "{}", errors(&output));
    assert!(errors(&output).contains("SFORCE/1"), "{}", errors(&output));
    let results = std::fs::read_to_string(folder.join("infinite-run/infinite.res")).unwrap();
    assert!(results.matches("<Step type=\"dynamic\">").count() > 30);
    assert!(results.contains("runStatus=\"Integration failed\""));
    let record = json(&std::fs::read(folder.join("infinite-run/run.json")).unwrap());
    assert_eq!(record["exit_code"], 5);
}

#[test]
fn a_run_that_goes_on_tells_what_failed_when_and_how_far_it_got() {
    let model = PENDULUM.replace(
        "END",
        "VARIABLE/1, FUNCTION=SQRT(0.5-TIME)\n\
         SFORCE/1, ROTATIONAL, I=21, J=1, FUNCTION=VARVAL(1)\nEND",
    );
    let commands = "\nFILE/MODEL=p\nSIM/DYN, END=1, STEPS=10\nVARIABLE/1, FUNCTION=0\n\
                    SIM/DYN, END=0.9, STEPS=2\n";
    let folder = folder(
        "survived",
        &[("p.adm", model.as_str()), ("p.acf", commands)],
    );
    let output = stiction(&folder, &["run", "p.acf"]);
    assert_eq!(code(&output), 5, "{}", errors(&output));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let record = json(&std::fs::read(folder.join("p-run/run.json")).unwrap());
    let failure = &record["failures"][0];
    let time = failure["time"].as_f64().unwrap();
    assert!(time > 0.4 && time <= 0.5, "{record}");
    assert_eq!(failure["command"], "SIM/DYN, END=1, STEPS=10");
    assert_eq!(failure["outcome"], "integration failed");
    assert_eq!(record["time"], 0.9);
    let expected = format!(
        "integration failed at time {time} (SIM/DYN, END=1, STEPS=10); the run went on to time 0.9"
    );
    assert!(said.starts_with(&expected), "{said}");
}

#[test]
fn commands_go_on_from_each_other_and_what_cannot_be_done_is_told_before() {
    let commands = "
FILE/MODEL=C:\\Users\\someone\\models\\p, OUTPUT_PREFIX=swing
SIMULATE/DYNAMIC, END=0.1, STEPS=10
FRICTION/103, MU_STATIC=0.5, MU_DYNAMIC=0.5
SIMULATE/DYNAMIC, DURATION=0.1, DTOUT=0.02
";
    let settle = format!("{commands}SIMULATE/SETTLE\n");
    let files = [
        ("p.adm", PENDULUM),
        ("p.acf", commands),
        ("settle.acf", settle.as_str()),
    ];
    let folder = folder("commands", &files);
    let output = stiction(&folder, &["run", "p.acf"]);
    assert_eq!(code(&output), 0, "{}", errors(&output));
    let results = std::fs::read_to_string(folder.join("swing-run/swing.res")).unwrap();
    assert_eq!(results.matches("<Step type=\"dynamic\">").count(), 15);
    assert!(results.contains("dynamic_002"));
    for command in ["run", "check"] {
        let output = stiction(&folder, &[command, "settle.acf"]);
        assert_eq!(code(&output), 3);
        let said = errors(&output) + &String::from_utf8_lossy(&output.stdout);
        assert!(said.contains("settle.acf:6:10: error"), "{said}");
        assert!(said.contains("SETTLE of SIMULATE"), "{said}");
    }
}

#[test]
fn reactions_of_redundant_constraints_are_shared_where_asked() {
    // Two more hinges on the same axis, as far on either side: they carry the same.
    let twice = PENDULUM.replace(
        "END",
        "MARKER/5, PART=1, QP=0, 0.5, 0, REULER=0, 90D, 0\nMARKER/25, PART=2, QP=-1, 0.5, 0, \
         REULER=0, 90D, 0\nMARKER/6, PART=1, QP=0, -0.5, 0, REULER=0, 90D, 0\nMARKER/26, PART=2, \
         QP=-1, -0.5, 0, REULER=0, 90D, 0\nJOINT/2, REVOLUTE, I=25, J=5\nJOINT/3, REVOLUTE, I=26, \
         J=6\nREQUEST/1, F2=JOINT(2,0,2,0)\\F3=JOINT(3,0,2,0)\\\nEND",
    );
    let folder = folder("shared", &[("twice.adm", twice.as_str())]);
    let run = [
        "run",
        "twice.adm",
        "--end",
        "0.2",
        "--steps",
        "4",
        "--reactions",
    ];
    let shared = stiction(&folder, &[&run[..], &["least-squares"]].concat());
    assert_eq!(code(&shared), 0, "{}", errors(&shared));
    let text = |file: &str| std::fs::read_to_string(folder.join("twice-run").join(file)).unwrap();
    let record = json(text("run.json").as_bytes());
    assert_eq!(record["options"]["reactions"], "least-squares");
    let log = text("twice.msg");
    assert!(
        log.contains("reactions of redundant constraints: the least squares"),
        "{log}"
    );
    assert!(!log.contains("is not unique"), "{log}");
    let requests = text("twice.req");
    let last: Vec<f64> = requests
        .lines()
        .last()
        .unwrap()
        .split_whitespace()
        .map(|number| number.parse().unwrap())
        .collect();
    assert!(
        last[0].abs() > 0.1 && (last[0] - last[1]).abs() < 1e-5,
        "{requests}"
    );
    let kept = stiction(&folder, &[&run[..], &["kept", "--force"]].concat());
    assert_eq!(code(&kept), 0, "{}", errors(&kept));
    assert!(text("twice.msg").contains("is not unique"));
    // A length is for least squares alone.
    let more = ["kept", "--force", "--reaction-length", "2"];
    let refused = stiction(&folder, &[&run[..], &more].concat());
    assert_eq!(code(&refused), 2);
    assert!(errors(&refused).contains("least-squares alone"));
}

#[test]
fn check_tells_freedoms_and_redundancies_as_json() {
    // A second hinge on the same axis holds nothing new but five equations.
    let twice = PENDULUM.replace(
        "END",
        "MARKER/5, PART=1, QP=0, 1, 0, REULER=0, 90D, 0\nMARKER/25, PART=2, QP=-1, 1, 0, \
         REULER=0, 90D, 0\nJOINT/2, REVOLUTE, I=25, J=5\nEND",
    );
    let folder = folder("check", &[("twice.adm", twice.as_str())]);
    let output = stiction(&folder, &["check", "twice.adm", "--format", "json"]);
    assert_eq!(code(&output), 0, "{}", errors(&output));
    let report = json(&output.stdout);
    assert_eq!(report["version"], 1);
    let model = &report["model"];
    assert_eq!(model["degrees_of_freedom"], 1);
    assert_eq!(model["redundant_equations"].as_array().unwrap().len(), 5);
    let codes: Vec<_> = report["diagnostics"]
        .as_array()
        .unwrap()
        .iter()
        .map(|d| d["code"].as_str().unwrap())
        .collect();
    assert_eq!(
        codes
            .iter()
            .filter(|code| **code == "reaction-not-unique")
            .count(),
        1,
        "{codes:?}"
    );
    assert_eq!(model["elements"]["JOINT"], 2);
    assert_eq!(
        model["friction_defaults"][0]["defaults"]["FRICTION_ARM"],
        1.0
    );
    assert!(!folder.join("twice-run").exists());
    let broken = stiction(&folder, &["check", "nothing.adm", "--format", "json"]);
    assert_eq!(code(&broken), 3);
    let missing = &json(&broken.stdout)["diagnostics"][0];
    assert_eq!(
        (&missing["severity"], &missing["code"]),
        (&"error".into(), &"missing-file".into())
    );
}

#[test]
fn a_misspelt_name_comes_with_its_replacement_as_json() {
    let text = PENDULUM.replace("MU_DYNAMIC", "MU_DYNAMC");
    let folder = folder("replacement", &[("p.adm", text.as_str())]);
    let output = stiction(&folder, &["check", "p.adm", "--format", "json"]);
    let report = json(&output.stdout);
    assert_eq!(report["model"], serde_json::Value::Null);
    let mut diagnostics = report["diagnostics"].as_array().unwrap().iter();
    let error = diagnostics.find(|d| d["severity"] == "error").unwrap();
    assert_eq!(error["code"], "unknown-argument");
    assert_eq!(error["span"]["start"]["line"], 10);
    assert_eq!(error["replacement"]["text"], "MU_DYNAMIC");
    // The offsets are those of the text that a program edits.
    let offset = |end: &str| {
        let offset = &error["replacement"]["span"][end]["offset"];
        usize::try_from(offset.as_u64().unwrap()).unwrap()
    };
    assert_eq!(&text[offset("start")..offset("end")], "MU_DYNAMC");
}

#[test]
fn warnings_are_allowed_and_denied_by_their_code() {
    let folder = folder("levels", &[("p.adm", PENDULUM)]);
    let check = |arguments: &[&str]| {
        let output = stiction(&folder, &[&["check", "p.adm"], arguments].concat());
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        (code(&output), said + &errors(&output))
    };
    let (status, said) = check(&[]);
    assert_eq!(status, 0);
    assert!(said.contains("warning[dimensional-default]"), "{said}");
    let (status, said) = check(&["--allow", "dimensional-default"]);
    assert_eq!(status, 0);
    assert!(!said.contains("dimensional-default"), "{said}");
    assert!(said.contains("no errors, no warnings"), "{said}");
    for denied in ["dimensional-default", "warnings"] {
        let (status, said) = check(&["--deny", denied]);
        assert_eq!(status, 3);
        assert!(said.contains("error[dimensional-default]"), "{said}");
    }
    let both = ["--deny", "warnings", "--allow", "dimensional-default"];
    assert_eq!(check(&both).0, 0);
    let (status, said) = check(&["--deny", "dimensional-defualt"]);
    assert_eq!(status, 2);
    assert!(said.contains("is dimensional-default meant?"), "{said}");
    let contradiction = ["--deny", "ignored", "--allow", "ignored"];
    assert_eq!(check(&contradiction).0, 2);
    let run = ["run", "p.adm", "--end", "0.1", "--deny", "warnings"];
    let output = stiction(&folder, &run);
    assert_eq!(code(&output), 3);
    assert!(!folder.join("p-run").exists());
}

#[test]
fn how_accurate_a_run_is_comes_with_it() {
    let folder = folder("accuracy", &[("p.adm", PENDULUM)]);
    let run = ["run", "p.adm", "--dtout", "0.01", "--end"];
    let checked = |more: &[&str]| stiction(&folder, &[&run[..], more].concat());
    let record = |name: &str| json(&std::fs::read(folder.join(name).join("run.json")).unwrap());
    let output = checked(&["1", "--error", "1e-7", "-o", "near"]);
    assert_eq!(code(&output), 0, "{}", errors(&output));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        said.contains("\naccurate to about ") && said.contains(" meter ("),
        "{said}"
    );
    let accuracy = record("near")["accuracy"].clone();
    assert_eq!(
        (&accuracy["accurate"], &accuracy["outputs"]),
        (&json(b"true"), &json(b"100"))
    );
    assert_eq!(accuracy["distance"]["body"], "PART/2");
    assert_eq!(accuracy["elements"][0]["element"], "FRICTION/103");
    // A method of first order is far off, which does not change how the program ends.
    let newmark = PENDULUM.replace("END\n", "INTEGRATOR/NEWMARK, ERROR=1E-5\nEND\n");
    std::fs::write(folder.join("p.adm"), newmark).unwrap();
    let output = checked(&["4", "-o", "far"]);
    assert_eq!(code(&output), 0, "{}", errors(&output));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        said.contains("warning[inaccurate]: from time") && said.contains("PART/2"),
        "{said}"
    );
    let accuracy = record("far")["accuracy"].clone();
    assert_eq!(accuracy["accurate"], false);
    assert!(accuracy["inaccurate_from"]["time"].as_f64().unwrap() > 0.0);
    let output = checked(&["4", "--unchecked", "-o", "unchecked"]);
    assert_eq!(code(&output), 0, "{}", errors(&output));
    assert!(record("unchecked")["accuracy"].is_null());
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(!said.contains("accurate"), "{said}");
    // The results are the same.
    let results = |name: &str| std::fs::read(folder.join(name).join("p.req")).unwrap();
    assert_eq!(results("far"), results("unchecked"));
}

#[test]
fn progress_comes_as_lines_of_json() {
    let folder = folder("progress", &[("p.adm", PENDULUM)]);
    let output = stiction(
        &folder,
        &["run", "p.adm", "--end", "1", "--progress", "json"],
    );
    assert_eq!(code(&output), 0);
    let lines: Vec<serde_json::Value> = errors(&output)
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(lines.last().unwrap()["time"], 1.0);
    assert_eq!(lines[0]["end"], 1.0);
    let silent = stiction(
        &folder,
        &[
            "run",
            "p.adm",
            "--end",
            "1",
            "--force",
            "--progress",
            "none",
        ],
    );
    assert_eq!(errors(&silent), "");
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_the_results() {
    let folder = folder("interrupt", &[("p.adm", PENDULUM)]);
    // Far more outputs than can be written before the signal comes.
    let running = Running::start(&folder, &["run", "p.adm", "--end", "1e5", "--dtout", "0.1"]);
    assert_eq!(code(&running.interrupt()), 130);
    let results = std::fs::read_to_string(folder.join("p-run/p.res")).unwrap();
    assert!(results.contains("runStatus=\"Interrupted\""));
    let record = json(&std::fs::read(folder.join("p-run/run.json")).unwrap());
    assert_eq!(record["outcome"], "interrupted");

    let accuracy = &record["accuracy"];
    assert!(accuracy["outputs"].is_u64() && accuracy["second_failure"].is_null());

    let asked = ["--unchecked", "--force"];
    let run = ["run", "p.adm", "--end", "1e5", "--dtout", "0.1"];
    let running = Running::start(&folder, &[&run[..], &asked].concat());
    assert_eq!(code(&running.interrupt()), 130);
    let record = json(&std::fs::read(folder.join("p-run/run.json")).unwrap());
    assert_eq!(record["outcome"], "interrupted");
    assert!(record["accuracy"].is_null());
}

#[test]
fn a_method_of_integration_can_be_chosen() {
    let folder = folder("method", &[("p.adm", PENDULUM)]);
    let run = |name: &str| {
        let arguments = ["run", "p.adm", "--end", "0.1", "--integrator", name];
        stiction(&folder, &arguments)
    };
    let output = run("adams");
    assert_eq!(code(&output), 0, "{}", errors(&output));
    let log = std::fs::read_to_string(folder.join("p-run/p.msg")).unwrap();
    assert!(log.contains("using Adams-Moulton Integrator"), "{log}");
    let record = std::fs::read_to_string(folder.join("p-run/run.json")).unwrap();
    assert!(record.contains("\"integrator\": \"adams\""), "{record}");
    let output = run("adam");
    assert!(errors(&output).contains("'adams'"), "{}", errors(&output));
}

#[test]
fn help_says_what_there_is() {
    let folder = folder::<&str>("help", &[]);
    let output = stiction(&folder, &["run", "--help"]);
    assert_eq!(code(&output), 0);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    for word in [
        "--end",
        "--steps",
        "--dtout",
        "--error",
        "--integrator",
        "--unchecked",
        "--set",
        "--progress",
        "--force",
        "130",
    ] {
        assert!(said.contains(word), "{word}");
    }
}

#[test]
fn errors_and_what_is_not_simulated_show_together() {
    let text = "two kinds of errors
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=-1, CM=20, IP=0.1, 0.1, 0.1
MARKER/20, PART=2
JOINT/1, CYLINDRICAL, I=20, J=1
SFORCE/1, TRANSLATIONAL, I=20, J=1, FUNCTION=USER(1)
END
";
    let folder = folder("together", &[("both.adm", text)]);
    let output = stiction(&folder, &["check", "both.adm"]);
    assert_eq!(code(&output), 3);
    let said = errors(&output);
    assert!(
        said.contains("both.adm:4:14: error[out-of-range]"),
        "{said}"
    );
    assert!(
        said.contains("both.adm:7:46: error[unsupported-function]"),
        "{said}"
    );
}

#[test]
fn explain_tells_where_the_friction_came_from() {
    let folder = folder("explain", &[("p.adm", PENDULUM)]);
    let arguments = ["run", "p.adm", "--end", "2", "--dtout", "0.01"];
    assert_eq!(code(&stiction(&folder, &arguments)), 0);
    let said = |arguments: &[&str]| {
        let output = stiction(&folder, &[&["explain"], arguments].concat());
        assert_eq!(code(&output), 0, "{arguments:?}: {}", errors(&output));
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let overview = said(&["p-run"]);
    assert_eq!(overview.lines().count(), 2, "{overview}");
    assert!(overview.contains("FRICTION/103"), "{overview}");
    let history = said(&["p-run", "--friction", "103"]);
    for word in ["dissipated", "stuck from (sec)", "made by", "newton-meter"] {
        assert!(history.contains(word), "{word}: {history}");
    }
    // The .res itself, and a time between two outputs.
    let moment = said(&["p-run/p.res", "--friction", "103", "--at", "0.504"]);
    for word in [
        "at time 0.500000 sec",
        "sliding",
        "0.2000: the dynamic one",
        "bending",
    ] {
        assert!(moment.contains(word), "{word}: {moment}");
    }

    let explained =
        |arguments: &[&str]| json(said(&[arguments, &["--format", "json"]].concat()).as_bytes());
    let all = explained(&["p-run"]);
    assert_eq!(all.as_array().unwrap().len(), 1);
    let one = explained(&["p-run", "--friction", "103"]);
    assert_eq!(all[0], one);
    assert_eq!(one["units"]["energy"], "newton-meter");
    let shares: f64 = ["stuck", "transition", "sliding"]
        .iter()
        .map(|regime| one["regimes"][regime].as_f64().unwrap())
        .sum();
    assert!((shares - 1.0).abs() < 1e-12, "{shares}");
    let moment = explained(&["p-run", "--friction", "103", "--at", "0.5"]);
    // Sliding, the pin has the dynamic coefficient of its load, and none of it is a limit's.
    let (load, torque) = (&moment["load"], &moment["torque"][2]);
    let (load, torque) = (load.as_f64().unwrap(), torque.as_f64().unwrap());
    assert!((torque.abs() - 0.2 * load).abs() < 1e-12, "{torque} {load}");
    assert_eq!(
        (&moment["regime"], &moment["limited"]),
        (&"sliding".into(), &false.into())
    );

    // The record of the run has the same energies.
    let record = json(&std::fs::read(folder.join("p-run/run.json")).unwrap());
    assert_eq!(
        record["frictions"][0]["dissipated"]["value"],
        one["dissipated"]
    );
    assert_eq!(record["energy_balance"]["dissipated"], one["dissipated"]);
    assert!(record["energy_balance"]["residual_share"].as_f64().unwrap() < 1e-4);
    let message = std::fs::read_to_string(folder.join("p-run/p.msg")).unwrap();
    assert!(
        message.contains("Energy balance (newton-meter):"),
        "{message}"
    );

    for (arguments, words) in [
        (&["nowhere"][..], "cannot read nowhere"),
        (&["."], "there is no .res in"),
        (
            &["p-run", "--friction", "7"],
            "there is no friction \"7\"; there is FRICTION/103 in JOINT/1",
        ),
        (&["p-run", "--at", "3"], "goes from 0 to 2"),
        (&["p.adm"], "p.adm"),
    ] {
        let output = stiction(&folder, &[&["explain"], arguments].concat());
        assert_eq!(code(&output), 3, "{arguments:?}");
        assert!(
            errors(&output).contains(words),
            "{arguments:?}: {}",
            errors(&output)
        );
    }
    // A joint means its friction.
    assert_eq!(said(&["p-run", "--friction", "joint/1"]), history);
    let help = stiction(&folder, &["explain", "--help"]);
    let help = String::from_utf8_lossy(&help.stdout).into_owned();
    assert!(
        help.contains("--friction") && help.contains("--at") && help.contains("130"),
        "{help}"
    );
}

#[test]
fn plot_draws_what_friction_did() {
    let named = PENDULUM
        .replace("JOINT/1,", "!   adams_view_name='PIN'\nJOINT/1,")
        .replace(
            "FRICTION/103,",
            "!   adams_view_name='PIN_FRICTION'\nFRICTION/103,",
        );
    let folder = folder("plot", &[("p.adm", named.as_str())]);
    let run = ["run", "p.adm", "--end", "1", "--dtout", "0.01"];
    assert_eq!(code(&stiction(&folder, &run)), 0);
    let draw = |arguments: &[&str]| stiction(&folder, &[&["plot", "p-run"], arguments].concat());
    let friction = "FRICTION/103 (PIN_FRICTION) in JOINT/1 (PIN)";
    let torque = "friction torque (newton-meter)";
    for (kind, words) in [
        ("friction", &[friction, torque, "time (sec)", "stuck"][..]),
        ("regime", &[friction, "time (sec)", "sliding"]),
        (
            "loop",
            &[friction, torque, "velocity of the surfaces (meter/sec)"],
        ),
        (
            "share",
            &[
                friction,
                "friction by cause (newton-meter)",
                "reaction force",
            ],
        ),
        (
            "energy",
            &["energy (newton-meter)", "potential (weight)", "residual"],
        ),
    ] {
        let (svg, png) = (format!("{kind}.svg"), format!("{kind}.png"));
        for file in [&svg, &png] {
            let output = draw(&["--kind", kind, "-o", file]);
            assert_eq!(code(&output), 0, "{kind}: {}", errors(&output));
        }
        let text = std::fs::read_to_string(folder.join(svg)).unwrap();
        for word in words {
            // A text stands on a line of its own.
            assert!(text.lines().any(|line| line == *word), "{kind}: {word}");
        }
        let png = std::fs::read(folder.join(png)).unwrap();
        assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
        // Something is drawn: white alone takes next to nothing.
        assert!(png.len() > 10_000, "{kind}: {}", png.len());
    }
    // A pendulum in a plane bends its pin by rounding alone.
    let share = std::fs::read_to_string(folder.join("share.svg")).unwrap();
    assert!(!share.lines().any(|line| line == "bending"));
    let way = draw(&["--kind", "loop", "--x", "displacement", "-o", "way.svg"]);
    assert_eq!(code(&way), 0);
    let text = std::fs::read_to_string(folder.join("way.svg")).unwrap();
    assert!(text.contains("displacement of the surfaces (meter)"));
    // By any of its names; twice in one picture has two panels.
    let both = draw(&["--friction", "pin", "--friction", "103", "-o", "both.svg"]);
    assert_eq!(code(&both), 0, "{}", errors(&both));
    let text = std::fs::read_to_string(folder.join("both.svg")).unwrap();
    assert_eq!(text.lines().filter(|line| *line == friction).count(), 2);

    for (arguments, status, words) in [
        (
            &["-o", "both.svg"][..],
            2,
            "both.svg is there already; --force replaces it",
        ),
        (&["-o", "p.pdf"], 2, "neither in .svg nor in .png"),
        (&["-o", "no/p.svg"], 2, "cannot be written"),
        (
            &["-o", "p.svg", "--x", "velocity"],
            2,
            "--x is for --kind loop",
        ),
        (
            &["-o", "p.svg", "--kind", "energy", "--friction", "1"],
            2,
            "whole model",
        ),
        (&["-o", "p.svg", "--kind", "walk"], 2, "possible values"),
        (&["-o", "p.svg", "--friction", "PIM"], 3, "is PIN meant?"),
        (
            &["-o", "p.svg", "--friction", "7"],
            3,
            "there is FRICTION/103 (PIN_FRICTION) in",
        ),
    ] {
        let output = draw(arguments);
        assert_eq!(code(&output), status, "{arguments:?}: {}", errors(&output));
        assert!(
            errors(&output).contains(words),
            "{arguments:?}: {}",
            errors(&output)
        );
    }
    assert!(!folder.join("p.svg").exists() && !folder.join("p.pdf").exists());
    let tables = [&run[..], &["--format", "parquet", "-o", "tables"]].concat();
    assert_eq!(code(&stiction(&folder, &tables)), 0);
    let output = stiction(&folder, &["plot", "tables", "-o", "p.svg"]);
    assert_eq!(code(&output), 3);
    let said = errors(&output);
    assert!(
        said.contains("no .res in tables") && said.contains("--format"),
        "{said}"
    );
    // Without friction there is none to draw; the energies are there.
    let text = PENDULUM.replace(
        "FRICTION/103, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, PIN_RADIUS=0.05\n",
        "",
    );
    std::fs::write(folder.join("free.adm"), text).unwrap();
    assert_eq!(
        code(&stiction(&folder, &["run", "free.adm", "--end", "1"])),
        0
    );
    let output = stiction(&folder, &["plot", "free-run", "-o", "p.svg"]);
    assert_eq!((code(&output), folder.join("p.svg").exists()), (3, false));
    assert!(
        errors(&output).contains("the model has no FRICTION"),
        "{}",
        errors(&output)
    );
    let output = stiction(
        &folder,
        &["plot", "free-run", "--kind", "energy", "-o", "p.svg"],
    );
    assert_eq!(code(&output), 0, "{}", errors(&output));
}

/// Every `$ stiction ...` of the tutorial prints what stands below it, but for the time that it took.
#[test]
fn the_tutorial_shows_what_the_program_says() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let folder = folder::<&str>("tutorial", &[]);
    let incline = folder.join("examples/incline");
    std::fs::create_dir_all(&incline).unwrap();
    for file in ["incline.adm", "incline.acf"] {
        std::fs::copy(root.join("examples/incline").join(file), incline.join(file)).unwrap();
    }
    let page = std::fs::read_to_string(root.join("docs/tutorial.md")).unwrap();
    let timeless = |text: &str| {
        let words = text.trim().split(' ').collect::<Vec<_>>();
        let kept = words
            .windows(2)
            .filter(|pair| pair[1] != "s,")
            .map(|pair| pair[0]);
        kept.chain(words.last().copied())
            .collect::<Vec<_>>()
            .join(" ")
    };
    let mut shown = 0;
    for block in page.split("```text\n$ stiction ").skip(1) {
        let (command, expected) = block.split("```").next().unwrap().split_once('\n').unwrap();
        let output = stiction(&folder, &command.split(' ').collect::<Vec<_>>());
        assert_eq!(code(&output), 0, "{command}: {}", errors(&output));
        let said = String::from_utf8(output.stdout).unwrap();
        assert_eq!(timeless(&said), timeless(expected), "stiction {command}");
        shown += 1;
    }
    assert_eq!(shown, 4);
}

#[cfg(unix)]
#[test]
fn a_folder_in_use_is_refused_and_nothing_of_another_run_stays() {
    let folder = folder("in-use", &[("p.adm", PENDULUM)]);
    let short = ["run", "p.adm", "--end", "0.1", "-o", "here"];
    let tables = [&short[..], &["--format", "parquet,csv"]].concat();
    assert_eq!(code(&stiction(&folder, &tables)), 0);
    let long = [
        "run", "p.adm", "--end", "1e5", "--dtout", "0.1", "-o", "here", "--force",
    ];
    let mut running = Running::start(&folder, &long);
    let output = stiction(&folder, &[&short[..], &["--force"]].concat());
    // Killed, so that it cannot tidy up; the lock goes with it.
    running.child.kill().unwrap();
    running.child.wait().unwrap();
    assert_eq!(code(&output), 2);
    let said = errors(&output);
    assert!(said.contains("here: another run is writing"), "{said}");
    let here = folder.join("here");
    for other in ["run.json", "friction.parquet", "states.csv", "tables.json"] {
        assert!(
            !here.join(other).exists(),
            "{other} is not of the run that was killed"
        );
    }
    let output = stiction(&folder, &[&tables[..], &["--force"]].concat());
    assert_eq!(code(&output), 0, "{}", errors(&output));
    assert!(here.join("friction.csv").is_file() && !here.join("p.res").exists());
}

/// Files cannot grow beyond a limit, as on a disk that fills up while a run writes.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_no_table_that_looks_whole() {
    let folder = folder("full-tables", &[("p.adm", PENDULUM)]);
    for (format, blocks) in [("parquet", 64), ("csv", 1024)] {
        // Blocks of 512 bytes (1024 with some shells); the tables take more than a megabyte.
        let command = format!(
            "ulimit -f {blocks}; trap '' XFSZ; exec '{}' run p.adm --end 20 --dtout 0.01 --format {format} \
             -o {format}",
            env!("CARGO_BIN_EXE_stiction")
        );
        let output = Command::new("sh")
            .args(["-c", &command])
            .current_dir(&folder)
            .output()
            .unwrap();
        assert_eq!(code(&output), 2, "{format}: {}", errors(&output));
        let said = errors(&output);
        assert!(
            said.contains("cannot write") && said.contains(format),
            "{format}: {said}"
        );
        let files = std::fs::read_dir(folder.join(format)).unwrap();
        let names: Vec<String> = files
            .map(|file| file.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        let whole = |name: &String| name == "run.json" || name == &format!("friction.{format}");
        assert!(!names.iter().any(whole), "{names:?}");
        assert!(
            names.contains(&format!("friction.{format}.part")),
            "{names:?}"
        );
    }
}
