//! Lints speak up where something is suspicious, and only there.

use dataset::{Code, Source, lint_dataset};

const BLOCK: &str = "A block on a table
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND
ACCGRAV/JGRAV=-9806.65
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1E3, 1E3, 1E3
MARKER/20, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=1
FRICTION/1, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2
";

/// The codes that a model gets.
fn codes(text: &str) -> Vec<Code> {
    let source = Source::from_text("m.adm", text.to_string());
    let (_, diagnostics) = lint_dataset(&source);
    diagnostics
        .iter()
        .map(|diagnostic| diagnostic.code)
        .collect()
}

/// The codes that the block gets with one text in place of another.
fn changed(from: &str, to: &str) -> Vec<Code> {
    assert!(BLOCK.contains(from), "{from}");
    codes(&BLOCK.replace(from, to))
}

/// The codes that the block gets with more statements.
fn with(statements: &str) -> Vec<Code> {
    codes(&format!("{BLOCK}{statements}\n"))
}

#[test]
fn a_model_without_fault_gets_nothing() {
    assert_eq!(codes(BLOCK), []);
}

#[test]
fn gravity_is_suspicious_where_it_is_that_of_the_earth_in_another_unit() {
    let gravity = |units: &str, value: &str| {
        let text = BLOCK.replace("LENGTH=MILLIMETER, TIME=SECOND", units);
        let text = text.replace("JGRAV=-9806.65", value);
        codes(&text).contains(&Code::GravityUnit)
    };
    let (millimetre, metre) = (
        "LENGTH=MILLIMETER, TIME=SECOND",
        "LENGTH=METER, TIME=SECOND",
    );
    assert!(gravity(millimetre, "JGRAV=-9.81"));
    assert!(gravity(millimetre, "JGRAV=-386.09"));
    assert!(gravity(metre, "JGRAV=-9806.65"));
    assert!(gravity(millimetre, "IGRAV=-6.9, JGRAV=-6.97"));
    assert!(gravity("LENGTH=METER, TIME=MILLISECOND", "JGRAV=-9.81"));
    // Of the moon, of a lift, none at all, and of the earth in milliseconds.
    assert!(!gravity(metre, "JGRAV=-1.62"));
    assert!(!gravity(millimetre, "JGRAV=-11000"));
    assert!(!gravity(millimetre, "JGRAV=0"));
    assert!(!gravity(
        "LENGTH=MILLIMETER, TIME=MILLISECOND",
        "JGRAV=-9.80665E-3"
    ));
    // The factor of consistency alone tells millimetres; a factor of 1 does not tell anything.
    let factor = |ucf: &str, value: &str| {
        let text = format!("t\nUNITS/UCF={ucf}\nACCGRAV/JGRAV={value}\nPART/1, GROUND\n");
        codes(&text).contains(&Code::GravityUnit)
    };
    assert!(factor("1000", "-9.81"));
    assert!(!factor("1000", "-9806.65"));
    assert!(!factor("1", "-9806.65"));
    assert!(!factor("1", "-9.81"));
}

#[test]
fn gravity_is_missed_where_friction_needs_weight() {
    let without = |friction: &str| {
        let text = BLOCK.replace("ACCGRAV/JGRAV=-9806.65\n", "");
        codes(&text.replace("MU_DYNAMIC=0.2", friction)).contains(&Code::NoGravity)
    };
    assert!(without("MU_DYNAMIC=0.2"));
    assert!(!without(
        "MU_DYNAMIC=0.2, FRICTION_FORCE_PRELOAD=5, INPUTS=PRELOAD"
    ));
    assert!(!codes("t\nPART/1, GROUND\n").contains(&Code::NoGravity));
}

#[test]
fn a_friction_that_is_switched_off_is_told_apart_from_one_that_is_zero() {
    let inputs = |inputs: &str| changed("MU_DYNAMIC=0.2", &format!("MU_DYNAMIC=0.2, {inputs}"));
    assert_eq!(inputs("INPUTS=ALL"), []);
    assert_eq!(
        inputs("INPUTS=REACTION_FORCE:BENDING_MOMENT:TORSIONAL_MOMENT"),
        []
    );
    assert_eq!(inputs("INPUTS=REACTION_FORCE"), [Code::SwitchedOff]);
    assert_eq!(inputs("INPUTS=NONE"), [Code::NoFriction]);
    assert_eq!(inputs("INPUTS=PRELOAD"), [Code::NoFriction]);
    let preload = "FRICTION_FORCE_PRELOAD=5, INPUTS=PRELOAD";
    assert_eq!(inputs(preload), [Code::SwitchedOff]);
    assert_eq!(inputs("EFFECT=SLIDING"), [Code::SwitchedOff]);
    assert_eq!(inputs("EFFECT=ALL"), []);
}

#[test]
fn a_motion_prescribes_friction_where_it_drives_every_freedom() {
    let prescribed = |text: Vec<Code>| text.contains(&Code::PrescribedFriction);
    assert!(prescribed(with(
        "MOTION/1, JOINT=1, TRANSLATION, FUNCTION=TIME"
    )));
    assert!(prescribed(with("MOTION/1, I=1, J=20, Z, FUNCTION=TIME")));
    assert!(!prescribed(with("MOTION/1, I=20, J=1, X, FUNCTION=0")));
    let cylindrical = BLOCK.replace("TRANSLATIONAL", "CYLINDRICAL");
    let turned = format!("{cylindrical}MOTION/1, JOINT=1, ROTATION, FUNCTION=TIME\n");
    assert!(!prescribed(codes(&turned)));
    let both = format!("{turned}MOTION/2, JOINT=1, TRANSLATION, FUNCTION=TIME\n");
    assert!(prescribed(codes(&both)));
}

#[test]
fn angles_above_a_turn_and_round_are_taken_for_degrees() {
    let marker = |angles: &str| {
        let text = format!(
            "t\nPART/1, GROUND\nMARKER/1, PART=1, REULER={angles}\nREQUEST/1, D, I=1, J=1\n"
        );
        let source = Source::from_text("m.adm", text.clone());
        let (_, diagnostics) = lint_dataset(&source);
        let found = diagnostics
            .into_iter()
            .find(|d| d.code == Code::DegreesWithoutD);
        found.map(|found| found.replacement.unwrap().text)
    };
    assert_eq!(marker("0, 90, 0").as_deref(), Some("0, 90D, 0"));
    assert_eq!(marker("-45, 0, 90D").as_deref(), Some("-45D, 0, 90D"));
    assert_eq!(marker("180., 0, 1").as_deref(), Some("180.D, 0, 1"));
    assert_eq!(marker("1.5707963, 0, 5"), None);
    assert_eq!(marker("90D, 180D, 360D"), None);
    // Seven radians are a little more than a turn, and no round number of degrees.
    assert_eq!(marker("7, 0, 0"), None);
}

#[test]
fn markers_are_unused_where_nothing_at_all_names_them() {
    let unused =
        |more: &str| with(&format!("MARKER/7, PART=2\n{more}")).contains(&Code::UnusedMarker);
    assert!(unused(""));
    for used in [
        "REQUEST/1, FORCE, I=7, J=1",
        "SFORCE/1, TRANSLATIONAL, I=20, J=1, FUNCTION=-DZ(7, 1)",
        "GRAPHICS/1, CYLINDER, CM=7, LENGTH=10, RADIUS=5",
        "REQUEST/1, FUNCTION=USER(1, 7)\\",
        "MARKER/8, PART=2, FLOATING\nVFORCE/1, I=20, JFLOAT=8, RM=7, FX=0\\FY=0\\FZ=0",
    ] {
        assert!(!unused(used), "{used}");
    }
    // A model with errors gets no such remark: what is refused may use the marker.
    assert!(!unused("JOINT/2, FIXED, I=20, J=99"));
}
