//! adamspy, a reader of Adams results in public use, opens our files.
//!
//! It is installed into a virtual environment of its own under the build folder, once.
#![allow(clippy::print_stdout, reason = "a skipped test says why")]

use results::{
    Component, DataKind, Entity, Header, Layout, MessageWriter, ResWriter, StepRow, SurfaceMotion,
    UnitNames,
};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Output of a command, or what went wrong.
fn run(command: &mut Command) -> Result<String, String> {
    let output = command.output().map_err(|error| error.to_string())?;
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    } else {
        Err(String::from_utf8_lossy(&output.stderr).into_owned())
    }
}

/// The Python of an environment with adamspy.
fn python() -> Result<PathBuf, String> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("adamspy-environment");
    let python = folder.join("bin/python");
    let installed = run(Command::new(&python).args(["-c", "import adamspy.postprocess.xml"]));
    if installed.is_err() {
        run(Command::new("python3")
            .args(["-m", "venv", "--clear"])
            .arg(&folder))?;
        run(Command::new(&python).args(["-m", "pip", "install", "--quiet", "adamspy"]))?;
    }
    Ok(python)
}

fn write_results(path: &Path) {
    let units = UnitNames::default();
    let mut layout = Layout::new();
    let parts = vec![
        Entity::part("ARM", 2, &units),
        Entity::part("PLATE", 3, &units),
    ];
    layout.push_family(parts, &[6, 6, 6]).unwrap();
    layout.push(Entity::reaction("Joint", "PIN", 1, &units));
    layout.push(Entity::friction("PIN_FRICTION", 4, &units));
    let columns = vec![
        Component::new("TORQUE", "newton-meter"),
        Component::new("ANGLE", "rad"),
    ];
    layout.push(Entity::request("DRIVE", 1, columns));
    // Entities of types that no other program knows.
    layout.push(Entity::friction_detail(
        "PIN_FRICTION",
        4,
        SurfaceMotion::Turning,
        true,
        &units,
    ));
    layout.push(Entity::energy(&units));
    let count = layout.value_count();
    let mut writer =
        ResWriter::new(File::create(path).unwrap(), &Header::default(), layout).unwrap();
    let row = |step: usize| {
        (0..count)
            .map(|k| (1000 * step + k) as f64 / 8.0)
            .collect::<Vec<_>>()
    };
    writer.begin_data(DataKind::InitialConditions).unwrap();
    writer.step(0.0, &row(0)).unwrap();
    writer.begin_data(DataKind::Dynamic).unwrap();
    for step in 1..=3 {
        writer.step(step as f64 * 0.25, &row(step)).unwrap();
    }
    writer.finish("Successful").unwrap();
}

fn write_messages(path: &Path) {
    let mut log =
        MessageWriter::new(File::create(path).unwrap(), "stiction", "0.1.0", None).unwrap();
    log.begin_simulation("Dynamic", "BDF SI2", 1e-6).unwrap();
    log.step_table().unwrap();
    for k in 0..3 {
        let time = 0.25 * f64::from(k);
        log.step_row(&StepRow {
            time,
            step: 1e-3,
            evaluations: 7,
            steps: 5,
            order: 2,
            elapsed: 83.5,
        })
        .unwrap();
    }
    log.end_simulation().unwrap();
    log.eigenvalues(0.5, &[[-2.5, 0.0], [-0.5, 1.25], [0.0, 2.0]])
        .unwrap();
    log.note("what follows is no part of the table").unwrap();
    log.error("one").unwrap();
    log.error("two\nlines").unwrap();
    log.finish(0.11, 0.14).unwrap();
}

/// Prints what adamspy reads, one fact a line.
const SCRIPT: &str = r#"
import sys
from adamspy.postprocess import msg, xml
res, log = sys.argv[1:]
names = xml.get_stepmap_dictionary(res)
print(len(names), names["time.TIME"], names["PLATE_XFORM.VX"], names["DRIVE.ANGLE"])
print(xml.get_component(res, "PLATE_XFORM.VX"))
print(xml.get_component(res, "PIN_FRICTION.BETA"))
print(xml.get_component(res, "PIN_FRICTION_DETAIL.DRIFT_A"))
print(xml.get_component(res, "ENERGY_BALANCE.RESIDUAL"))
series, units = xml.get_results(res, return_units=True)
print(series["time"], series["DRIVE"]["ANGLE"], sorted(units["DRIVE"].items()))
print(msg.get_timestamps(log)[2], len(msg.get_timestamps(log)))
print(msg.check_if_finished(log), msg.check_for_errors(log), len(msg.get_errors(log)))
print(msg.uses_fortran_solver(log), msg.get_process_id(log) > 0, msg.get_runtime_summary(log))
modes = msg.get_modes(log)
print(modes["Real"], modes["Imag"])
"#;

#[test]
fn adamspy_reads_our_files() {
    let python = match python() {
        Ok(python) => python,
        Err(reason) => {
            println!("skipped: adamspy cannot be installed: {reason}");
            return;
        }
    };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (res, log) = (folder.join("adamspy.res"), folder.join("adamspy.msg"));
    write_results(&res);
    write_messages(&log);
    let facts = run(Command::new(python)
        .arg("-c")
        .arg(SCRIPT)
        .arg(&res)
        .arg(&log))
    .unwrap();
    // Value k of row r is (1000 r + k)/8 and has id k + 2.
    let expected = "\
        103 1 20 71\n\
        [2.25, 127.25, 252.25, 377.25]\n\
        [8.375, 133.375, 258.375, 383.375]\n\
        [11.75, 136.75, 261.75, 386.75]\n\
        [12.625, 137.625, 262.625, 387.625]\n\
        [0.25, 0.5, 0.75] [133.625, 258.625, 383.625] [('ANGLE', 'ANGLE'), ('TORQUE', 'TORQUE')]\n\
        [0.5, 0.001, 7, 5, 2, 83.5] 3\n\
        True True 2\n\
        False True [0.11, 0.14, 127.27]\n\
        [-0.5, 0.0] [1.25, 2.0]\n";
    assert_eq!(facts, expected);
}
