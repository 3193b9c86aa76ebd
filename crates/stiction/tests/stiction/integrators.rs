//! The methods of integration as users choose them: in the dataset, by a command, by an option.

use mechanics::Statistics;
use results::ResFile;
use stiction::{Method, Outcome, Project, RunOptions};

use crate::shared::{run_with_log, scratch_folder};

/// A pendulum with friction of both laws in its pins would be stiff; this one swings freely on a soft
/// spring, in two joints.
const SWING: &str = "Two rods
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=0.1, 0.1, 0.1, QG=0.5, 0, 0
MARKER/20, PART=2
MARKER/21, PART=2, QP=-0.5, 0, 0
MARKER/22, PART=2, QP=0.5, 0, 0
PART/3, MASS=1, CM=30, IP=0.1, 0.1, 0.1, QG=1.5, 0, 0
MARKER/30, PART=3
MARKER/31, PART=3, QP=-0.5, 0, 0
JOINT/1, REVOLUTE, I=21, J=1
JOINT/2, REVOLUTE, I=31, J=22
SFORCE/1, ROTATIONAL, I=31, J=22, FUNCTION=-3*AZ(31,22)
INTEGRATOR/GSTIFF, SI2, ERROR=1E-6
END
";

/// The pose of the second rod at the end of a run, its work and its message file.
struct Ran {
    place: Vec<f64>,
    statistics: Statistics,
    log: String,
}

fn ran(text: &str, commands: &str, options: RunOptions) -> Ran {
    let folder = scratch_folder();
    std::fs::write(folder.join("swing.adm"), text).unwrap();
    let file = folder.join("swing.acf");
    let commands = format!("\nFILE/MODEL=swing\n{commands}SIM/DYN, END=1, STEPS=20\n");
    std::fs::write(&file, commands).unwrap();
    let project = Project::load(&file).unwrap_or_else(|error| panic!("{error}"));
    let (report, results, log) = run_with_log(&project, options);
    assert_eq!(report.outcome, Outcome::Completed, "{log}");
    std::fs::remove_dir_all(folder).unwrap();
    Ran {
        place: last(&results),
        statistics: report.statistics,
        log,
    }
}

fn last(results: &ResFile) -> Vec<f64> {
    let block = results.block("dynamic_001").unwrap();
    block.row(block.times.len() - 1)[6..9].to_vec()
}

fn by(method: Option<Method>) -> RunOptions {
    RunOptions {
        method,
        ..RunOptions::default()
    }
}

fn distance(a: &Ran, b: &Ran) -> f64 {
    let pairs = a.place.iter().zip(&b.place);
    pairs.fold(0.0, |most, (a, b)| (a - b).abs().max(most))
}

#[test]
fn every_method_can_be_chosen_and_agrees_with_the_others() {
    let tight = SWING.replace("1E-6", "1E-10");
    let exact = ran(&tight, "", by(None));
    let names = ["BDF SI2", "BDF I3", "HHT I3", "Newmark I3", "Adams-Moulton"];
    for (method, name) in Method::ALL.into_iter().zip(names) {
        let run = ran(SWING, "", by(Some(method)));
        let used = format!("Dynamic Simulation using {name} Integrator");
        assert!(run.log.contains(&used), "{}", run.log);
        let chosen = format!("the integrator is {}", method.name());
        assert!(run.log.contains(&chosen), "{}", run.log);
        assert!(run.log.contains("Integration error =    1.000000E-06"));
        // Of first order with its default GAMMA, which loses energy: the others follow ERROR.
        let most = if method == Method::Newmark { 0.1 } else { 1e-3 };
        let error = distance(&run, &exact);
        assert!(error < most, "{method:?} {error:e}");
    }
}

#[test]
fn abam_is_the_formulas_of_adams_in_the_dataset_by_a_command_and_by_the_option() {
    let option = ran(SWING, "", by(Some(Method::Adams)));
    let statement = ran(&SWING.replace("GSTIFF, SI2", "ABAM"), "", by(None));
    let command = ran(SWING, "INTEGRATOR/ABAM\n", by(None));
    for run in [&statement, &command] {
        assert_eq!(run.place, option.place);
        assert!(run.log.contains("using Adams-Moulton Integrator"));
    }
    // The option stands above commands.
    let both = ran(SWING, "INTEGRATOR/HHT\n", by(Some(Method::Adams)));
    assert_eq!(both.place, option.place);
    let stiff = ran(SWING, "", by(None));
    assert!(option.statistics.steps.steps < stiff.statistics.steps.steps);
}

#[test]
fn names_are_read_in_any_case_and_wrong_ones_are_told() {
    assert_eq!("ADAMS".parse(), Ok(Method::Adams));
    let wrong = |name: &str| name.parse::<Method>().unwrap_err().to_string();
    assert!(wrong("gstif-si2").ends_with("is gstiff-si2 meant?"));
    let all = "there are gstiff-si2, gstiff-i3, hht, newmark, adams";
    assert!(wrong("rk45").ends_with(all), "{}", wrong("rk45"));
}

#[test]
fn arguments_of_the_statement_reach_the_integrator() {
    let with = |arguments: &str| {
        let error = if arguments.contains("ERROR") {
            ""
        } else {
            "ERROR=1E-6, "
        };
        let text = SWING.replace("ERROR=1E-6", &format!("{error}{arguments}"));
        ran(&text, "", by(None)).statistics
    };
    let plain = with("MAXIT=10");
    let renewed = with("PATTERN=T");
    assert_eq!(renewed.work.factorisations, renewed.work.residuals);
    assert!(plain.work.factorisations < renewed.work.factorisations);
    assert!(with("CORRECTOR=ORIGINAL").work.residuals > plain.work.residuals);
    assert_eq!(with("CORRECTOR=MODIFIED"), plain);
    assert_eq!(with("INTERPOLATE=ON"), plain);
    assert!(with("HMAX=0.5, INTERPOLATE=OFF").steps.steps >= 20);
    assert!(with("ERROR=1E-8").steps.steps > with("ERROR=1E-4").steps.steps);
    assert!(with("HMAX=1E-3").steps.steps >= 1000);
    let fixed = with("FIXIT=2, HRATIO=3");
    assert_eq!((fixed.steps.steps, fixed.work.residuals), (60, 120));
    let order = [1, 5].map(|kmax| with(&format!("ERROR=1E-4, KMAX={kmax}")).steps.steps);
    assert!(order[0] > 2 * order[1], "{order:?}");
}
