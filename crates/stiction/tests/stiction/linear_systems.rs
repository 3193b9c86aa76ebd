//! LSE and TFSISO against closed forms: controllers, step responses, feedthrough, static solutions.

use crate::runs::complete_commands;
use crate::shared::{GROUND, last, run_text, scratch_folder};

#[test]
fn a_state_matrix_rings_as_its_eigenvalues_say() {
    // x'' + 2 d x' + w² x = u: from x = 0.5 with u = 3, in CORDER and RORDER, with outputs.
    let text = format!(
        "oscillator
{GROUND}LSE/1, X=1, U=2, Y=3, IC=4, A=1, B=2, C=3, D=4
ARRAY/1, X, SIZE=2
ARRAY/2, U, SIZE=1, VARIABLES=1
ARRAY/3, Y, SIZE=2
ARRAY/4, IC, SIZE=2, NUMBERS=0.5, 0
MATRIX/1, FULL=CORDER, ROWS=2, COLUMNS=2, VALUES=0, -25, 1, -0.8
MATRIX/2, FULL=RORDER, ROWS=2, COLUMNS=1, VALUES=0, 1
MATRIX/3, SPARSE, ROWS=1, 2, COLUMNS=2, 1, VALUES=1, 2
MATRIX/4, FULL=RORDER, ROWS=2, COLUMNS=1, VALUES=0, 10
VARIABLE/1, FUNCTION=3
REQUEST/1, F2=ARYVAL(1,1)\\F3=ARYVAL(3,1)\\F4=ARYVAL(3,2)\\F6=ARYVAL(2,1)+ARYVAL(4,1)\\
END
"
    );
    let results = run_text(&text, 2.0, 20, Some(1e-8));
    let (t, d, end) = (2.0_f64, 0.4_f64, 3.0 / 25.0);
    let w = (25.0 - d * d).sqrt();
    let (sine, cosine) = (w * t).sin_cos();
    let swing = (0.5 - end) * (-d * t).exp();
    let x = end + swing * (cosine + d / w * sine);
    let rate = -swing * (w + d * d / w) * sine;
    // An error of 1e-8 a step over some hundred steps.
    for (name, wanted) in [
        ("LSE_1.X1", x),
        ("LSE_1.X2", rate),
        ("REQUEST_1.F2", x),
        ("REQUEST_1.F3", rate),
        ("REQUEST_1.F4", 2.0 * x + 30.0),
        ("REQUEST_1.F6", 3.5),
    ] {
        let found = last(&results, name);
        assert!((found - wanted).abs() < 1e-5, "{name}: {found} {wanted}");
    }
}

#[test]
fn a_transfer_function_answers_a_step() {
    // (3 + 2 s + s²)/(2 + 3 s + s²) = 1 + (1 - s)/((s + 1)(s + 2)), times a half by a common factor:
    // the answer to a step is 3/2 - 2 e^-t + 3/2 e^-2t, of one at once.
    let text = format!(
        "step
{GROUND}TFSISO/1, X=1, U=2, Y=3, NUMERATOR=6, 4, 2, DENOMINATOR=4, 6, 2
ARRAY/1, X
ARRAY/2, U, VARIABLES=1
ARRAY/3, Y, SIZE=1
VARIABLE/1, FUNCTION=1
VARIABLE/2, FUNCTION=ARYVAL(3,1)
END
"
    );
    let results = run_text(&text, 1.5, 10, Some(1e-8));
    let answer = results.get("VARIABLE_2.Q").unwrap();
    let times = results.get("time.TIME").unwrap();
    for (y, t) in answer.iter().zip(&times).skip(1) {
        let wanted = 1.5 - 2.0 * (-t).exp() + 1.5 * (-2.0 * t).exp();
        assert!((y - wanted).abs() < 1e-6, "{t}: {y} {wanted}");
    }
}

#[test]
fn a_feedthrough_that_is_fed_back_is_solved() {
    // u = r - y and y = (s + 3)/(s + 1) u: closed, y = (s + 3)/(2 s + 4) r, which starts at 1/2 and
    // ends at 3/4 with the rate 2.
    let text = format!(
        "loop
{GROUND}TFSISO/1, X=1, U=2, Y=3, NUMERATOR=3, 1, DENOMINATOR=1, 1
ARRAY/1, X, SIZE=1
ARRAY/2, U, SIZE=1, VARIABLES=1
ARRAY/3, Y, SIZE=1
VARIABLE/1, FUNCTION=1-VARVAL(2)
VARIABLE/2, FUNCTION=ARYVAL(3,1)
END
"
    );
    let results = run_text(&text, 1.0, 10, Some(1e-8));
    let wanted = 0.75 - 0.25 * (-2.0_f64).exp();
    let found = last(&results, "VARIABLE_2.Q");
    assert!((found - wanted).abs() < 1e-6, "{found} {wanted}");
}

/// A weight on a rail along x held by a PI controller with a filtered rate.
fn controlled(hold: &str) -> String {
    format!(
        "controller
{GROUND}ACCGRAV/IGRAV=-10
MARKER/2, PART=1, REULER=90D, 90D, 0
PART/2, MASS=2, CM=20, IP=1, 1, 1, QG=0.8, 0, 0
MARKER/20, PART=2, REULER=90D, 90D, 0
MARKER/21, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=2
SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=2, FUNCTION=ARYVAL(3,1)
VARIABLE/1, FUNCTION=1-DX(21,1)
VARIABLE/2, FUNCTION=-VX(21,1)
LSE/1, X=1, U=2, Y=3, IC=4, A=1, B=2, C=3, D=4{hold}
ARRAY/1, X, SIZE=2
ARRAY/2, U, SIZE=2, VARIABLES=1, 2
ARRAY/3, Y, SIZE=1
ARRAY/4, IC, SIZE=2, NUMBERS=0.1, 0
MATRIX/1, FULL=RORDER, ROWS=2, COLUMNS=2, VALUES=0, 0, 0, -50
MATRIX/2, FULL=RORDER, ROWS=2, COLUMNS=2, VALUES=1, 0, 0, 50
MATRIX/3, FULL=RORDER, ROWS=1, COLUMNS=2, VALUES=80, 25
MATRIX/4, FULL=RORDER, ROWS=1, COLUMNS=2, VALUES=150, 0
END
"
    )
}

#[test]
fn an_integral_controller_leaves_no_error() {
    // In motion and at the equilibrium alike: the integral carries the weight of 20, 80 x₁ = 20.
    for commands in ["SIMULATE/DYNAMIC, END=60, STEPS=20", "SIMULATE/STATIC"] {
        let results = complete_commands(&controlled(""), commands);
        let place = last(&results, "PART_2_XFORM.X");
        assert!((place - 1.0).abs() < 1e-4, "{commands}: {place}");
        let integral = last(&results, "LSE_1.X1");
        assert!((integral - 0.25).abs() < 1e-4, "{commands}: {integral}");
        assert!(last(&results, "LSE_1.X2").abs() < 1e-4);
    }
}

#[test]
fn held_states_leave_the_rest_to_the_other_forces() {
    // 150 (1 - x) + 80·0.1 = 20.
    let results = complete_commands(&controlled(", STATIC_HOLD"), "SIMULATE/STATIC");
    let place = last(&results, "PART_2_XFORM.X");
    assert!((place - 0.92).abs() < 1e-9, "{place}");
    assert_eq!(last(&results, "LSE_1.X1"), 0.1);
}

#[test]
fn what_does_not_fit_is_located() {
    let good = controlled("");
    for (old, new, expected) in [
        (
            "COLUMNS=2, VALUES=0, 0, 0, -50",
            "COLUMNS=1, VALUES=0, 0",
            "LSE/1: A has 2 rows and 1 columns",
        ),
        (
            "VALUES=80, 25",
            "VALUES=80",
            "a matrix of 1 rows and 2 columns has 2 values, found 1",
        ),
        (
            "ARRAY/1, X, SIZE=2",
            "ARRAY/1, X, SIZE=3",
            "has 3 elements, not 2",
        ),
        (
            "X=1, U=2",
            "X=2, U=2",
            "X names ARRAY/2, which is of kind U",
        ),
        ("IC=4, A=1", "IC=4, A=9", "there is no MATRIX/9"),
        (
            "NUMBERS=0.1, 0",
            "NUMBERS=0.1",
            "SIZE is 2, but NUMBERS has 1",
        ),
        (
            "ARYVAL(3,1)",
            "ARYVAL(3,2)",
            "an element that the array does not have",
        ),
        ("LSE/1, X=1", "GSE/1, NS=1", "write a DIFF for each state"),
        (
            "LSE/1, X=1, U=2, Y=3, IC=4, A=1, B=2, C=3, D=4",
            "TFSISO/1, X=1, U=2, Y=3, NUMERATOR=1, 2, 3, DENOMINATOR=1, 2",
            "NUMERATOR has a higher power of s than DENOMINATOR",
        ),
        (
            "FULL=RORDER, ROWS=1, COLUMNS=2, VALUES=80, 25",
            "SPARSE, ROWS=4000000000, COLUMNS=1, VALUES=1",
            "more than 10000",
        ),
    ] {
        let text = good.replace(old, new);
        assert_ne!(text, good, "{old}");
        let folder = scratch_folder();
        let file = folder.join("model.adm");
        std::fs::write(&file, text).unwrap();
        let refused = match stiction::Project::load(&file) {
            Ok(project) => stiction::Session::new(&project).unwrap_err().to_string(),
            Err(error) => error.to_string(),
        };
        std::fs::remove_dir_all(folder).unwrap();
        assert!(refused.contains(expected), "{expected}: {refused}");
    }
}
