//! Exact text of `.req` and `.msg` files.

use results::{MessageWriter, ReqWriter, Request, StepRow, UnitError, UnitNames};

#[test]
fn requests() {
    let mut file = Vec::new();
    let request = Request {
        id: 12,
        comment: "force\nat the pin".into(),
    };
    let units = UnitNames::from_keywords("millimeter", "kilogram", "newton", "second").unwrap();
    let mut writer = ReqWriter::new(&mut file, "title", None, &units, &[request]).unwrap();
    writer
        .step(0.5, &[[1.0, -2.5, 0.0, 1e-120, 1e300, -0.125]])
        .unwrap();
    assert!(writer.step(0.6, &[]).is_err());
    assert!(writer.step(0.6, &[[f64::NAN; 6]]).is_err());
    let text = String::from_utf8(file).unwrap();
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines.len(), 6);
    assert_eq!(lines[1].len(), 80);
    assert_eq!(lines[2], "    1     MMKGS_N_RACA 1.000000000000000E+03");
    assert_eq!(lines[3], "        12  force at the pin");
    assert_eq!(lines[4], "   5.00000E-01");
    let values: Vec<f64> = lines[5]
        .split_whitespace()
        .map(|x| x.parse().unwrap())
        .collect();
    assert_eq!(values, [1.0, -2.5, 0.0, 1e-120, 1e300, -0.125]);
    assert!(lines[5].starts_with("  1.00000E+00 -2.50000E+00"));
}

#[test]
fn units() {
    let error = UnitNames::from_keywords("METER", "KILO", "NEWTON", "SECOND").unwrap_err();
    assert_eq!(
        error,
        UnitError {
            quantity: "mass",
            keyword: "KILO".into()
        }
    );
    assert_eq!(error.to_string(), "`KILO` is not a unit of mass");
    let inch = UnitNames::from_keywords("INCH", "SLUG", "POUND_FORCE", "MILLISECOND").unwrap();
    assert_eq!(inch.velocity(), "inch/millisec");
    assert_eq!(inch.angular_acceleration(), "rad/millisec**2");
}

#[test]
fn messages() {
    let mut file = Vec::new();
    let mut log =
        MessageWriter::new(&mut file, "stiction", "9.9", Some("2026-01-31 12:00:00")).unwrap();
    log.title("four-bar").unwrap();
    log.note("one\ntwo").unwrap();
    let redundant = [("Zi.Xj".to_string(), "JOINT_2".to_string())];
    log.degrees_of_freedom(1, &redundant).unwrap();
    log.begin_simulation("Dynamic", "BDF SI2", 1e-6).unwrap();
    log.step_table().unwrap();
    let row = StepRow {
        time: 0.0,
        step: 5e-4,
        evaluations: 3,
        steps: 1,
        order: 1,
        elapsed: 0.04,
    };
    log.step_row(&row).unwrap();
    log.end_simulation().unwrap();
    log.error("the joint jams").unwrap();
    log.timing(0.0, 0.0).unwrap();
    let text = String::from_utf8(file).unwrap();
    for expected in [
        "* stiction 9.9  ",
        "  one\n  two\n",
        "   -  deactivating constraint equation  Zi.Xj in JOINT_2\n",
        "  ****** Performing Dynamic Simulation using BDF SI2 Integrator ******\n",
        "   Integration error =    1.000000E-06\n",
        "   0.00000E+00  5.00000E-04             3            1             1       0.04\n",
        "\n---- START: ERROR ----\nthe joint jams\n---- END: ERROR ----\n",
        "Elapsed time = 0.00s,  CPU time = 0.00s,  0.00%\n",
    ] {
        assert!(text.contains(expected), "{expected:?} is not in\n{text}");
    }
    assert!(
        !text.contains("Finished -----"),
        "a run that failed is not finished"
    );
}
