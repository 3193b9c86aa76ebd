//! What `explain` reads back from results, of runs and of results made for it.

use std::path::{Path, PathBuf};

use results::{DataKind, Entity, Header, Layout, ResWriter, SurfaceMotion, UnitNames};
use stiction::explain::{ExplainError, FrictionHistory, RunResults, overview};
use stiction::{Outcome, Project, RunOptions, Session};

use crate::runs::{Run, run_commands};
use crate::shared::{GoOn, scratch_folder};

/// A folder with the results of an example.
fn folder(file: &str) -> PathBuf {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let project = Project::load(&examples.join(file)).unwrap();
    let folder = scratch_folder();
    let session = Session::new(&project).unwrap();
    session
        .run(&folder, RunOptions::default(), &mut GoOn)
        .unwrap();
    folder
}

#[test]
fn the_block_on_the_incline_is_explained() {
    let folder = folder("incline/incline.acf");
    let run = RunResults::open(&folder).unwrap();
    let history = run.history(1).unwrap();
    // It sticks from the start until the push exceeds what friction holds, and never again.
    assert_eq!(history.sticks.len(), 1);
    let stick = history.sticks[0];
    assert_eq!((stick.start, stick.sticks), (0.0, 1));
    assert!((3.0..3.3).contains(&stick.end.unwrap()), "{stick:?}");
    // Both are sums over the same steps, rounded differently.
    assert!((stick.stuck - history.stuck_time).abs() < 1e-12);
    assert_eq!(history.mean_shares, [0.0, 1.0, 0.0, 0.0]);
    assert!(
        (history.regimes[0] - stick.stuck / 5.0).abs() < 0.01 / 5.0,
        "one output"
    );
    assert!(history.limited.is_none() && history.drift.is_none());
    assert!(
        (history.dissipated - history.work).abs() < 1e-15,
        "nothing is stored at the end"
    );
    let text = history.to_string();
    for word in [
        "FRICTION/1 (BLOCK_FRICTION)",
        "newton-meter",
        "largest creep",
        "reaction force  ",
    ] {
        assert!(text.contains(word), "{word}: {text}");
    }

    let (weight, normal) = (
        2.0 * 9.81 * 10.0_f64.to_radians().sin(),
        2.0 * 9.81 * 10.0_f64.to_radians().cos(),
    );
    let stuck = run.at(1, 1.0001).unwrap();
    assert_eq!(
        (stuck.time, stuck.regime, stuck.stick),
        (1.0, 0, Some((true, 0.0)))
    );
    assert!((stuck.force[2] + weight).abs() < 1e-4 * weight);
    assert!((stuck.load - normal).abs() < 1e-9 * normal);
    assert!((stuck.causes[1] - weight).abs() < 1e-4 * weight);
    // The creep energy of the law at rest is under that of a spring of its first stiffness.
    assert!(stuck.stored > 0.0 && stuck.stored < 0.5 * 1.875 * 0.3 * normal / 1e-4 * 1e-8);
    let sliding = run.at(1, 4.0).unwrap();
    assert_eq!((sliding.regime, sliding.stick.unwrap().0), (2, false));
    assert!((sliding.power - 0.2 * normal * sliding.velocity[0][2]).abs() < 1e-6);
    assert!(
        stuck.to_string().contains("stuck, since 0.000000 sec"),
        "{stuck}"
    );
    assert!(
        sliding.to_string().contains("0.2000: the dynamic one"),
        "{sliding}"
    );

    // A push along the plane against friction that holds the weight: what there is to plot.
    let series = run.series(1).unwrap();
    assert_eq!(series.time.len(), history.outputs);
    assert!(series.slides() && series.units.load == "newton");
    assert!((series.friction[100] + weight).abs() < 1e-4 * weight);
    assert_eq!(series.causes[1][100], series.friction[100].abs());
    let way = series.displacement();
    // The work of a constant friction is that over the way slid; the trapezoidal rule is exact for the
    // linear rise of the velocity but for the one interval in which it begins.
    let slid = history.dissipated / (0.2 * normal);
    assert!((way[500] - slid).abs() < 1e-3 * slid, "{} {slid}", way[500]);
    // Without the record of a run the joint is not known.
    assert_eq!(run.title(1).unwrap(), "FRICTION/1 (BLOCK_FRICTION)");
    assert_eq!(run.find("block_friction").unwrap(), 1);
    let misspelt = run.find("BLOK_FRICTION").unwrap_err().to_string();
    assert_eq!(
        misspelt,
        "there is no friction \"BLOK_FRICTION\"; is BLOCK_FRICTION meant?"
    );
    let energies = run.energies().unwrap();
    assert_eq!(
        (energies.unit.as_str(), energies.time_unit.as_str()),
        ("newton-meter", "sec")
    );
    assert_eq!(*energies.dissipated.last().unwrap(), history.dissipated);

    let outside = run.at(1, 5.1).unwrap_err();
    assert!(matches!(outside, ExplainError::OutsideRun { end, .. } if end == 5.0));
    assert!(run.at(1, f64::NAN).is_err());
    let unknown = run.history(7).unwrap_err();
    assert_eq!(
        unknown.to_string(),
        "there is no FRICTION/7; there is FRICTION/1"
    );
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn bristles_and_their_drift_are_explained() {
    let folder = folder("lugre-slider/lugre_slider.acf");
    let run = RunResults::open(&folder).unwrap();
    let history = run.history(103).unwrap();
    assert_eq!((history.stick_count, history.sticks.len()), (7, 7));
    let drift = history.drift.as_ref().unwrap();
    assert_eq!(drift.len(), 1);
    assert!(drift[0].0 == "DRIFT_Z" && drift[0].1 > 1e-3, "{drift:?}");
    let moment = run.at(103, 4.0).unwrap();
    let bristles = moment.bristles.as_ref().unwrap();
    // The spring of 2 N/m is 0.4 m long, the bristles of 1e4 N/m carry that.
    assert!((bristles[2].1 - 0.8e-4).abs() < 0.03e-4, "{bristles:?}");
    let text = moment.to_string();
    assert!(
        text.contains("bristle deflection, Z") && text.contains("force of the bristles"),
        "{text}"
    );
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn the_friction_that_dissipates_most_comes_first() {
    let folder = folder("delta-robot/delta.acf");
    let run = RunResults::open(&folder).unwrap();
    let ids = run.frictions().unwrap();
    let histories: Vec<FrictionHistory> = ids.iter().map(|id| run.history(*id).unwrap()).collect();
    let table = overview(&histories);
    let shown: Vec<f64> = table
        .lines()
        .skip(1)
        .map(|line| {
            let words: Vec<&str> = line.split_whitespace().collect();
            let unit = words
                .iter()
                .position(|word| *word == "newton-meter")
                .unwrap();
            words[unit - 1].parse().unwrap()
        })
        .collect();
    assert_eq!(shown.len(), 12);
    assert!(shown.is_sorted_by(|a, b| a >= b), "{table}");
    std::fs::remove_dir_all(folder).unwrap();
}

/// Results of one friction with these rows: time, number of sticks, start and end of them, time
/// stuck.
fn write(path: &Path, rows: &[[f64; 5]]) {
    let units = UnitNames::default();
    let mut layout = Layout::new();
    layout.push(Entity::friction("PIN", 3, &units));
    layout.push(Entity::friction_detail(
        "PIN",
        3,
        SurfaceMotion::Turning,
        false,
        &units,
    ));
    let mut values = vec![0.0; layout.value_count()];
    let place = |name: &str| {
        let components = &layout.entities()[1].components;
        let component = components.iter().position(|c| c.name == name).unwrap();
        layout.column(1, component)
    };
    let places = ["STICKS", "STICK_START", "STICK_END", "STUCK_TIME"].map(place);
    let file = std::fs::File::create(path).unwrap();
    let mut writer = ResWriter::new(file, &Header::default(), layout).unwrap();
    writer.begin_data(DataKind::Dynamic).unwrap();
    for row in rows {
        for (place, value) in places.into_iter().zip(&row[1..]) {
            values[place] = *value;
        }
        writer.step(row[0], &values).unwrap();
    }
    writer.finish("Successful").unwrap();
}

#[test]
fn stick_intervals_are_told_apart_where_the_outputs_allow_it() {
    let folder = scratch_folder();
    let path = folder.join("made.res");
    let intervals = |rows: &[[f64; 5]]| -> Vec<(f64, Option<f64>, usize)> {
        write(&path, rows);
        let history = RunResults::open(&path).unwrap().history(3).unwrap();
        let stuck: f64 = history.sticks.iter().map(|stick| stick.stuck).sum();
        let expected = rows.last().unwrap()[4];
        assert!((stuck - expected).abs() < 1e-12, "{:?}", history.sticks);
        history
            .sticks
            .iter()
            .map(|s| (s.start, s.end, s.sticks))
            .collect()
    };
    // Sliding; a stick within an interval; one over several outputs that lasts to the end.
    let apart = [
        [0.0, 0.0, 0.0, 0.0, 0.0],
        [1.0, 1.0, 0.25, 0.75, 0.5],
        [2.0, 2.0, 1.5, 0.75, 1.0],
        [3.0, 2.0, 1.5, 0.75, 2.0],
    ];
    assert_eq!(intervals(&apart), [(0.25, Some(0.75), 1), (1.5, None, 1)]);
    // Stuck from the start; let go and stuck again within one interval; let go.
    let again = [
        [0.0, 1.0, 0.0, 0.0, 0.0],
        [1.0, 2.0, 0.5, 0.25, 0.75],
        [2.0, 2.0, 0.5, 1.5, 1.25],
    ];
    assert_eq!(
        intervals(&again),
        [(0.0, Some(0.25), 1), (0.5, Some(1.5), 1)]
    );
    // The end of the first is not known, as another came and went within the interval.
    let lost = [[0.0, 1.0, 0.0, 0.0, 0.0], [1.0, 2.0, 0.5, 0.75, 0.375]];
    assert_eq!(intervals(&lost), [(0.0, Some(0.75), 2)]);
    // Three within an interval, the last of which goes on.
    let many = [
        [0.0, 0.0, 0.0, 0.0, 0.0],
        [1.0, 3.0, 0.75, 0.5, 0.375],
        [2.0, 3.0, 0.75, 1.75, 1.125],
    ];
    assert_eq!(
        intervals(&many),
        [(0.0, Some(0.5), 2), (0.75, Some(1.75), 1)]
    );
    write(&path, &lost);
    let text = RunResults::open(&path)
        .unwrap()
        .history(3)
        .unwrap()
        .to_string();
    assert!(
        text.contains("2 sticks, too short to be told apart"),
        "{text}"
    );
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn what_cannot_be_explained_is_said() {
    let folder = scratch_folder();
    let say = |path: &Path| RunResults::open(path).unwrap_err().to_string();
    assert!(say(&folder).contains("there is no .res in"));
    assert!(say(&folder.join("nowhere")).contains("cannot read"));
    write(&folder.join("one.res"), &[]);
    let run = RunResults::open(&folder).unwrap();
    assert!(matches!(run.history(3), Err(ExplainError::NoOutput(_))));
    assert!(matches!(run.at(3, 0.0), Err(ExplainError::NoOutput(_))));
    write(&folder.join("two.res"), &[]);
    let several = say(&folder);
    assert!(
        several.contains("one.res") && several.contains("two.res"),
        "{several}"
    );
    std::fs::write(folder.join("bad.res"), "no results").unwrap();
    assert!(say(&folder.join("bad.res")).contains("bad.res"));
    // A friction of another program, without what is ours.
    let units = UnitNames::default();
    let mut layout = Layout::new();
    layout.push(Entity::friction("PIN", 3, &units));
    let file = std::fs::File::create(folder.join("plain.res")).unwrap();
    let writer = ResWriter::new(file, &Header::default(), layout).unwrap();
    writer.finish("Successful").unwrap();
    let plain = RunResults::open(&folder.join("plain.res")).unwrap();
    assert!(matches!(
        plain.frictions(),
        Err(ExplainError::NoFriction(_))
    ));
    std::fs::remove_dir_all(folder).unwrap();
}

/// A rotor whose weight hangs 0.3 m from its hinge, pushed along the axis, spinning; `more` are
/// arguments of its FRICTION.
fn rotor(more: &str) -> Run {
    let model = format!(
        "A rotor on a hinge
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-10
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=4, CM=20, IP=1, 1, 1, WZ=20
MARKER/20, PART=2, QP=0, 0, 0.3
MARKER/21, PART=2
JOINT/1, REVOLUTE, I=21, J=1
SFORCE/1, TRANSLATIONAL, I=21, J=1, ACTIONONLY, FUNCTION=50
FRICTION/5, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, PIN_RADIUS=0.05, FRICTION_ARM=0.08
, BENDING_REACTION_ARM=0.1, FRICTION_TORQUE_PRELOAD=0.5{more}
"
    );
    let run = run_commands(&model, "\nSIMULATE/DYNAMIC, END=1, STEPS=10\n");
    assert_eq!(run.report.outcome, Outcome::Completed, "{}", run.messages);
    run
}

#[test]
fn shares_are_those_of_the_load_s_formula() {
    // The load of a revolute joint (spec 9.3): pin radius · radial force 40 N + friction arm · axial
    // force 50 N, and pin radius over bending arm · moment 12 N m; coefficient 0.2, preload 0.5 N m.
    let parts = [0.05 * 40.0 + 0.08 * 50.0, 0.05 / 0.1 * 12.0, 0.0];
    let causes = [0.5, 0.2 * parts[0], 0.2 * parts[1], 0.0];
    let torque = 0.5 + 0.2 * 12.0;
    let run = rotor("");
    let value = |name: &str| {
        let values = run.results.get(&format!("FRICTION_5{name}")).unwrap();
        values[values.len() / 2]
    };
    let close = |name: &str, expected: f64| {
        // The reaction of an instant is exact but for rounding.
        assert!(
            (value(name) - expected).abs() < 1e-12 * torque,
            "{name}: {} {expected}",
            value(name)
        );
    };
    for (name, expected) in ["LOAD_REACTION", "LOAD_BENDING", "LOAD_TORSION"]
        .iter()
        .zip(parts)
    {
        close(&format!("_DETAIL.{name}"), expected);
    }
    for (name, expected) in ["BY_PRELOAD", "BY_REACTION", "BY_BENDING", "BY_TORSION"]
        .iter()
        .zip(causes)
    {
        close(&format!("_DETAIL.{name}"), expected);
    }
    close(".TZ", -torque);
    close("_DETAIL.LIMITED", 0.0);
    // Power is torque times the angular velocity, surface velocity over the pin radius.
    close("_DETAIL.POWER", torque * value(".WZ") / 0.05);
    // Deceleration is 2.9 N m on 1 kg m².
    let energy = 0.5 * (20.0_f64.powi(2) - (20.0 - torque).powi(2));
    let taken = run.report.frictions[0].energy;
    assert!((taken - energy).abs() < 1e-4 * energy, "{taken} {energy}");

    // A limit holds the part that the load causes; what makes it stays what it was.
    let limited = rotor(", MAX_FRICTION_TORQUE=1.5");
    let last = |name: &str| {
        *limited
            .results
            .get(&format!("FRICTION_5{name}"))
            .unwrap()
            .last()
            .unwrap()
    };
    assert_eq!(last("_DETAIL.LIMITED"), 1.0);
    assert!((last(".TZ") + 2.0).abs() < 1e-12, "{}", last(".TZ"));
    assert!((last("_DETAIL.BY_REACTION") - causes[1]).abs() < 1e-12);
    assert_eq!(limited.report.frictions[0].clipped, 11);
}
