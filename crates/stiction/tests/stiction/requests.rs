//! MREQUEST: each of its elements is reported as a REQUEST would.

use crate::shared::{refusal, run_text};

const MODEL: &str = "A swinging bar and a block
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
MARKER/3, PART=1, QP=0, 0, 2, REULER=0.3, 0.2, 0.1
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2, QP=0.5, 0, 0
MARKER/21, PART=2
PART/3, MASS=1, CM=30, IP=1, 1, 1, VX=0.5, WZ=2
MARKER/30, PART=3, QP=0, 0, 2
MARKER/9, PART=1, FLOATING
PART/4
JOINT/5, REVOLUTE, I=21, J=1
JPRIM/6, INPLANE, I=30, J=1
SFORCE/7, TRANSLATIONAL, I=30, J=3, ACTIONONLY, FUNCTION=3*SIN(5*TIME)
SPRINGDAMPER/8, TRANSLATIONAL, I=30, J=1, K=40, C=1, LENGTH=1
VFORCE/7, I=30, JFLOAT=9, RM=3, FX=1\\FY=2*TIME\\FZ=0
";

#[test]
fn multiple_requests_report_each_element_as_a_request_does() {
    let model = MODEL.replace("PART/4\n", "")
        + "
REQUEST/1, VELOCITY, I=20, RM=3
REQUEST/2, DISPLACEMENT, I=30
REQUEST/3, FORCE, I=21, J=1
REQUEST/4, ACCELERATION, I=30, J=1, RM=3
REQUEST/5, FORCE, I=30
REQUEST/6, FORCE, I=30, J=1
REQUEST/7, FORCE, I=30, J=9
MREQUEST/1, PARTS=ALL, VELOCITY, RM=3
MREQUEST/2, PARTS=2, 3, DISPLACEMENT
MREQUEST/3, JOINTS=ALL, FORCE
MREQUEST/4, JPRIMS=6, ACCELERATION, RM=3, COMMENT=the plane
MREQUEST/5, APPFORS=8, 7, FORCE
!  adams_view_name='.model.forces'
MREQUEST/6, APPFORS=ALL, FORCE
END
";
    let results = run_text(&model, 0.5, 5, Some(1e-7));
    for (multiple, single) in [
        ("MREQUEST_1_PART_2", "REQUEST_1"),
        ("MREQUEST_2_PART_3", "REQUEST_2"),
        ("MREQUEST_3_JOINT_5", "REQUEST_3"),
        ("MREQUEST_4_JPRIM_6", "REQUEST_4"),
        // The first with this identifier: it stands before the VFORCE.
        ("MREQUEST_5_SFORCE_7", "REQUEST_5"),
        ("MREQUEST_5_SPRINGDAMPER_8", "REQUEST_6"),
        ("forces_SFORCE_7", "REQUEST_5"),
        ("forces_VFORCE_7", "REQUEST_7"),
    ] {
        let components = |name: &str| {
            let entity = results.entities.iter().find(|entity| entity.name == name);
            let entity = entity.unwrap_or_else(|| panic!("there is no {name}"));
            assert_eq!(entity.kind, "Request");
            let names = entity.components.iter();
            let names: Vec<String> = names.map(|c| c.name.clone()).collect();
            let values = names
                .iter()
                .map(|component| results.get(&format!("{name}.{component}")).unwrap());
            let values: Vec<Vec<f64>> = values.collect();
            assert!(values.iter().flatten().any(|value| value.abs() > 0.1));
            (names, values)
        };
        assert_eq!(components(multiple), components(single), "{multiple}");
    }
}

#[test]
fn a_multiple_request_of_what_is_not_there_says_what_to_write() {
    for (statement, words) in [
        ("MREQUEST/1, JOINTS=5, 6, FORCE", "there is no JOINT/6"),
        ("MREQUEST/1, PARTS=1, VELOCITY", "there is no moving PART/1"),
        ("MREQUEST/1, PARTS=4, VELOCITY", "no centre of mass"),
        ("MREQUEST/1, PARTS=2, FORCE", "no force of its own"),
        ("MREQUEST/1, APPFORS=ALL, VELOCITY", "floats with I"),
        (
            "MREQUEST/1, VELOCITY",
            "add PARTS, JOINTS, JPRIMS or APPFORS",
        ),
        ("MREQUEST/1, JOINTS=5", "what is reported"),
        (
            "MREQUEST/1, JOINTS=NONE, FORCE",
            "ALL or numbers of elements",
        ),
        ("MREQUEST/1, JOINTS=5, PARTS=2, FORCE", "PARTS"),
    ] {
        let text = refusal(&format!("{MODEL}{statement}\nEND\n"));
        assert!(text.contains(words), "{statement}: {text}");
        assert!(text.contains("model.adm:19:"), "{statement}: {text}");
    }
}
