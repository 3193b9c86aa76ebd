//! Runs that are killed, interrupted or run out of disk: what is left is readable and can be gone on with.
#![cfg(unix)]

mod shared;

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use results::{ReadError, ResFile};
use shared::{code, errors, folder, stiction};

/// A pendulum with friction in its hinge and a driven block on bristles, with requests.
const MODEL: &str = "A pendulum and a block
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
MARKER/3, PART=1, QP=0, 0, 1, REULER=90D, 90D, 0
PART/2, MASS=2, CM=21, IP=0.5, 0.5, 0.5
MARKER/20, PART=2
MARKER/21, PART=2, QP=1, 0, 0
PART/3, MASS=1, QG=0, 0, 1, CM=30, IP=1, 1, 1
MARKER/30, PART=3, REULER=90D, 90D, 0
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, TRANSLATIONAL, I=30, J=3
FRICTION/1, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, PIN_RADIUS=0.1
, STICTION_TRANSITION_VELOCITY=0.01, MAX_STICTION_DEFORMATION=0.0001
FRICTION/2, JOINT=2, FORMULATION=LUGRE, MU_STATIC=0.4, MU_DYNAMIC=0.3
, BRISTLE_STIFFNESS_COEFFICIENT=2000, DAMPING_COEFFICIENT=30
, VELOCITY_THRESHOLD_STRIBECK=0.05
SFORCE/1, TRANSLATIONAL, I=30, J=3, ACTIONONLY, FUNCTION=6*SIN(4*TIME)
REQUEST/1, DISPLACEMENT, I=21, J=1
REQUEST/2, FORCE, I=20, J=1
INTEGRATOR/GSTIFF, SI2, ERROR=1E-7
END
";

/// A checkpoint every two milliseconds: several in a run.
const RUN: [&str; 8] = [
    "run",
    "p.adm",
    "--end",
    "2",
    "--steps",
    "400",
    "--checkpoint",
    "0.002",
];
/// The result files that are the same to the byte.
const FILES: [&str; 2] = ["p.res", "p.req"];

fn start(folder: &Path, more: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_stiction"))
        .args(RUN.iter().chain(more))
        .current_dir(folder)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

fn send(signal: &str, child: &Child) {
    // A run that has ended meanwhile is none to be sent anything.
    let _ = Command::new("kill")
        .args([signal, &child.id().to_string()])
        .stderr(Stdio::null())
        .status()
        .unwrap();
}

fn finish(folder: &Path, more: &[&str]) {
    let arguments: Vec<&str> = RUN.iter().chain(more).copied().collect();
    let output = stiction(folder, &arguments);
    assert_eq!(code(&output), 0, "{}", errors(&output));
}

/// Contents of a result file, none where it has not been made.
fn contents(folder: &Path, file: &str) -> Vec<u8> {
    std::fs::read(folder.join("p-run").join(file)).unwrap_or_default()
}

/// The results of a run that nothing disturbs, and how long it takes.
fn undisturbed(name: &str) -> ([Vec<u8>; 2], Duration) {
    let folder = folder(name, &[("p.adm", MODEL)]);
    let started = Instant::now();
    finish(&folder, &[]);
    let elapsed = started.elapsed();
    assert!(!folder.join("p-run/p.checkpoint").exists());
    (FILES.map(|file| contents(&folder, file)), elapsed)
}

/// Numbers between zero and one, by a linear congruence.
fn random(state: &mut u64) -> f64 {
    *state = state
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

/// What is there is the beginning of the whole, and reads as far as it goes.
fn check_beginning(folder: &Path, whole: &[Vec<u8>; 2]) {
    for (file, whole) in FILES.iter().zip(whole) {
        let part = contents(folder, file);
        assert!(whole.starts_with(&part), "{file} of {} bytes", part.len());
    }
    match ResFile::read(folder.join("p-run/p.res")) {
        Ok(_) | Err(ReadError::NoStepMap) => {}
        // Killed before it was made.
        Err(ReadError::Io(_)) if contents(folder, "p.res").is_empty() => {}
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn fifty_runs_killed_at_any_time_are_readable_and_end_with_the_same_bytes() {
    let (whole, mut elapsed) = undisturbed("killed-whole");
    let folder = folder("killed", &[("p.adm", MODEL)]);
    let mut state = 6;
    let (mut resumed, mut kills) = (0, 0);
    while kills < 50 {
        let _ = std::fs::remove_dir_all(folder.join("p-run"));
        let mut more: &[&str] = &[];
        loop {
            let mut child = start(&folder, more);
            std::thread::sleep(elapsed.mul_f64(random(&mut state)));
            send("-KILL", &child);
            // The machine may be faster or slower than it was a moment ago.
            if child.wait().unwrap().code() == Some(0) {
                elapsed = elapsed.mul_f64(0.8);
                break;
            }
            elapsed = elapsed.mul_f64(1.1);
            kills += 1;
            check_beginning(&folder, &whole);
            more = if folder.join("p-run/p.checkpoint").exists() {
                resumed += 1;
                &["--resume"]
            } else {
                &["--force"]
            };
            if random(&mut state) < 0.7 {
                finish(&folder, more);
                break;
            }
        }
        for (file, whole) in FILES.iter().zip(&whole) {
            assert!(contents(&folder, file) == *whole, "{file}");
        }
        assert!(!folder.join("p-run/p.checkpoint").exists());
    }
    assert!(resumed > 10, "{resumed}");
}

#[test]
fn an_interrupted_run_leaves_whole_files_and_a_checkpoint() {
    let (whole, elapsed) = undisturbed("stopped-whole");
    for (signal, part) in [("-INT", 0.4), ("-TERM", 0.5), ("-INT", 0.7)] {
        let folder = folder("stopped", &[("p.adm", MODEL)]);
        let _ = std::fs::remove_dir_all(folder.join("p-run"));
        let mut child = start(&folder, &[]);
        std::thread::sleep(elapsed.mul_f64(part));
        send(signal, &child);
        let code = child.wait().unwrap().code();
        if code == Some(130) {
            let results = ResFile::read(folder.join("p-run/p.res")).unwrap();
            assert_eq!(results.status.as_deref(), Some("Interrupted"));
            finish(&folder, &["--resume"]);
        } else {
            // It was faster, or had not begun to listen.
            assert!(matches!(code, Some(0) | None), "{code:?}");
            finish(&folder, &["--force"]);
        }
        for (file, whole) in FILES.iter().zip(&whole) {
            assert!(contents(&folder, file) == *whole, "{file}");
        }
    }
}

#[test]
fn without_a_checkpoint_there_is_nothing_to_resume() {
    let folder = folder("no-checkpoint", &[("p.adm", MODEL)]);
    let resume: Vec<&str> = RUN.iter().copied().chain(["--resume"]).collect();
    let output = stiction(&folder, &resume);
    assert_eq!(code(&output), 2);
    assert!(errors(&output).contains("p.checkpoint: there is no checkpoint"));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_ends_a_run_with_the_name_of_the_file() {
    use std::os::unix::fs::symlink;
    let folder = folder("full", &[("p.adm", MODEL)]);
    let results = folder.join("p-run");
    for file in [
        "p.res",
        "p.req",
        "p.msg",
        "p.checkpoint.part",
        "run.json.part",
    ] {
        let _ = std::fs::remove_dir_all(&results);
        std::fs::create_dir_all(&results).unwrap();
        symlink("/dev/full", results.join(file)).unwrap();
        let forced: Vec<&str> = RUN.iter().copied().chain(["--force"]).collect();
        let output = stiction(&folder, &forced);
        assert_eq!(code(&output), 2, "{file}");
        let said = errors(&output);
        let name = file.trim_end_matches(".part");
        assert!(said.contains(name) && said.contains("space"), "{said}");
        assert!(
            !results.join("p.checkpoint").exists() || name == "run.json",
            "{file}"
        );
    }
}

#[test]
fn a_folder_that_goes_ends_a_run() {
    let folder = folder("gone", &[("p.adm", MODEL)]);
    let _ = std::fs::remove_dir_all(folder.join("p-run"));
    let mut child = Command::new(env!("CARGO_BIN_EXE_stiction"))
        .args([
            "run",
            "p.adm",
            "--end",
            "1e4",
            "--steps",
            "1000000",
            "--checkpoint",
            "0.01",
        ])
        .current_dir(&folder)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    while !folder.join("p-run/p.checkpoint").exists() {
        std::thread::sleep(Duration::from_millis(5));
    }
    std::fs::remove_dir_all(folder.join("p-run")).unwrap();
    let mut said = String::new();
    std::io::Read::read_to_string(&mut child.stderr.take().unwrap(), &mut said).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(2), "{said}");
    assert!(said.contains("p.checkpoint"), "{said}");
}
