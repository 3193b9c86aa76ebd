//! Forces, states and variables that read accelerations, reactions and one another, against closed
//! forms.

use crate::shared::{GROUND, last, run, run_text, scratch_folder, slider};

#[test]
fn a_force_against_the_acceleration_is_an_added_mass() {
    // m x'' = 12 sin 3t - 4 x'': the motion of a mass of six, although the added mass is twice the
    // mass itself, so that an iteration of force and acceleration would diverge.
    let text = slider(
        "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=2, FUNCTION=12*SIN(3*TIME)-4*ACCX(21,1)",
    );
    let results = run_text(&text, 2.0, 20, Some(1e-8));
    let t = 2.0_f64;
    let x = 2.0 * (t / 3.0 - (3.0 * t).sin() / 9.0);
    let found = last(&results, "PART_2_XFORM.X");
    // An error of 1e-8 a step over some hundred steps.
    assert!((found - x).abs() < 1e-6, "{found} {x}");
    let acceleration = 2.0 * (3.0 * t).sin();
    assert!((last(&results, "PART_2_XFORM.ACCX") - acceleration).abs() < 1e-12);
    let force = last(&results, "SFORCE_1.FX");
    assert!((force - 2.0 * acceleration).abs() < 1e-11, "{force}");
}

#[test]
fn a_torque_against_the_angular_acceleration_is_an_added_inertia() {
    let text = format!(
        "rotor
{GROUND}PART/2, MASS=1, CM=20, IP=1, 1, 3, WZ=2
MARKER/20, PART=2
JOINT/1, REVOLUTE, I=20, J=1
SFORCE/1, ROTATIONAL, I=20, J=1, FUNCTION=VARVAL(1)
VARIABLE/1, FUNCTION=-WZ(20,1)-2*WDTZ(20,1,1)
END
"
    );
    let results = run_text(&text, 3.0, 20, Some(1e-8));
    let spin = 2.0 * (-3.0_f64 / 5.0).exp();
    let found = last(&results, "PART_2_XFORM.WZ");
    assert!((found - spin).abs() < 1e-6, "{found} {spin}");
    // The variable is an output, too.
    assert!((last(&results, "VARIABLE_1.Q") + 0.6 * found).abs() < 1e-9);
}

#[test]
fn friction_by_hand_from_the_reaction_of_the_joint() {
    // A block with its weight on the guide slides with 0.25 of the reaction, whose normal part grows
    // with a force across: x'' = -0.25 (g + 0.5 t).
    let text = slider(
        "ACCGRAV/JGRAV=-10
VFORCE/1, I=21, JFLOAT=3, RM=1, FX=0\\FY=-TIME\\FZ=0
MARKER/3, PART=1, FLOATING
SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=2
, FUNCTION=-0.25*SQRT(JOINT(1,0,3,1)**2+JOINT(1,0,4,1)**2)*SIGN(1,VX(21,1))
REQUEST/1, F2=JOINT(1,0,3,1)\\
",
    )
    .replace("IP=1, 1, 1", "IP=1, 1, 1, VX=10");
    let results = run_text(&text, 2.0, 20, Some(1e-8));
    let t = 2.0_f64;
    let x = 10.0 * t - 0.25 * (5.0 * t * t + t * t * t / 12.0);
    let found = last(&results, "PART_2_XFORM.X");
    assert!((found - x).abs() < 1e-5, "{found} {x}");
    let normal = last(&results, "REQUEST_1.F2");
    assert!((normal - 22.0).abs() < 1e-9, "{normal}");
    // FM of the joint is the same magnitude here, as nothing acts along the guide.
    let text = text.replace("SQRT(JOINT(1,0,3,1)**2+JOINT(1,0,4,1)**2)", "JOINT(1,0,1)");
    let results = run_text(&text, 2.0, 20, Some(1e-8));
    let found = last(&results, "PART_2_XFORM.X");
    assert!((found - x).abs() < 1e-5, "{found} {x}");
}

#[test]
fn what_functions_read_of_forces_is_what_requests_report() {
    // Every kind of force between moving parts, on both sides, read by variables that depend on
    // themselves (so that they are solved) and by a request at the solved instant.
    let sources = [
        "JOINT(1,0,2,20)",
        "JOINT(1,1,7,30)",
        "JOINT(1,1,3,0)",
        "MOTION(1,0,8,20)",
        "MOTION(1,1,8,0)",
        "SFORCE(1,1,2,30)",
        "SFORCE(1,1,6,30)",
        "GFORCE(2,0,3,30)",
        "GFORCE(2,1,7,0)",
        "BUSH(1,0,6,0)",
        "FRICTION(1,3)",
        "FRICTION(1,6)",
        "FX(20,30,30)",
        "TM(31,21)",
        "JOINT(1,0,1)",
        "ACCY(20,30,31,30)",
        "WDTM(20,30)",
    ];
    let mut elements = String::new();
    let mut columns = String::new();
    for (k, source) in sources.iter().enumerate() {
        let id = 100 + k;
        elements += &format!("VARIABLE/{id}, FUNCTION=2*{source}-VARVAL({id})\n");
        let (request, column) = (k / 8 + 1, k % 8 + 1);
        if column == 1 {
            columns += &format!("REQUEST/{request}");
        }
        columns += &format!(", F{column}={source}\\\n");
    }
    let text = format!(
        "forces
{GROUND}ACCGRAV/JGRAV=-9.8
PART/2, MASS=2, CM=22, IP=1, 2, 2.5, QG=0, 0, 0, WZ=0.3
MARKER/20, PART=2, QP=0.2, 0.1, 0, REULER=20D, 0, 0
MARKER/21, PART=2, QP=-0.3, 0.4, 0.1
MARKER/22, PART=2, QP=0.1, 0, 0
PART/3, MASS=1, CM=32, IP=0.5, 0.7, 0.8, QG=0, 0, 0, WZ=0.3
MARKER/30, PART=3, QP=0.2, 0.1, 0, REULER=20D, 0, 0
MARKER/31, PART=3, QP=0.5, -0.2, 0.3, REULER=10D, 20D, 30D
MARKER/32, PART=3, QP=0.6, 0, 0
MARKER/33, PART=3, FLOATING
JOINT/1, CYLINDRICAL, I=20, J=30
JOINT/2, SPHERICAL, I=21, J=9
MARKER/9, PART=1, QP=-0.3, 0.4, 0.1
MOTION/1, JOINT=1, ROTATIONAL, FUNCTION=0.2*TIME**2
FRICTION/1, JOINT=1, MU_STATIC=0.1, MU_DYNAMIC=0.05
SFORCE/1, TRANSLATIONAL, I=21, J=31, FUNCTION=-5*(DM(21,31)-0.4)
GFORCE/2, I=21, JFLOAT=33, RM=31, FX=1\\FY=-DX(21,31)\\FZ=2\\TX=0.3\\TY=0\\TZ=-0.1
BUSHING/1, I=21, J=31, K=3, 4, 5, KT=0.1, 0.2, 0.3, C=0.1, 0.1, 0.1, CT=0, 0.1, 0
{elements}{columns}END
"
    );
    let results = run_text(&text, 1.0, 5, Some(1e-7));
    for (k, source) in sources.iter().enumerate() {
        let variable = results.get(&format!("VARIABLE_{}.Q", 100 + k)).unwrap();
        let name = format!("REQUEST_{}.F{}", k / 8 + 1, k % 8 + 1);
        let request = results.get(&name).unwrap();
        assert!(last(&results, &name) != 0.0, "{source}");
        // The first row is the model as given, which is not solved.
        for (w, r) in variable.iter().zip(&request).skip(1) {
            assert!((w - r).abs() < 1e-9 * (1.0 + r.abs()), "{source}: {w} {r}");
        }
    }
}

#[test]
fn variables_that_depend_on_themselves_are_solved() {
    // Kepler's equation E = M + e sin E by itself, and a circle of three that is linear.
    let text = format!(
        "circles
{GROUND}VARIABLE/1, IC=1, FUNCTION=TIME+0.8*SIN(VARVAL(1))
VARIABLE/2, FUNCTION=VARVAL(3)+1
VARIABLE/3, FUNCTION=2*VARVAL(4)
VARIABLE/4, FUNCTION=VARVAL(2)-TIME
DIFF/1, FUNCTION=1-0.8*COS(VARVAL(1))
END
"
    );
    let results = run_text(&text, 3.0, 12, Some(1e-8));
    let eccentric = results.get("VARIABLE_1.Q").unwrap();
    let times = results.get("time.TIME").unwrap();
    for (e, t) in eccentric.iter().zip(&times).skip(1) {
        assert!((e - 0.8 * e.sin() - t).abs() < 1e-12, "{t}");
    }
    // a = b + 1, b = 2 c, c = a - t: a = 2 t - 1.
    assert!((last(&results, "VARIABLE_2.Q") - 5.0).abs() < 1e-12);
    assert!((last(&results, "VARIABLE_3.Q") - 4.0).abs() < 1e-12);
    // dE (1 - e cos E) = dM, so the integral over the time is that of (dM/dE)² dE.
    let antiderivative = |e: f64| e * (1.0 + 0.32) - 1.6 * e.sin() + 0.16 * (2.0 * e).sin();
    let wanted = antiderivative(*eccentric.last().unwrap()) - antiderivative(0.0);
    let found = last(&results, "DIFF_1.Q");
    assert!((found - wanted).abs() < 1e-6, "{found} {wanted}");
}

#[test]
fn circles_without_a_solution_are_named() {
    for (functions, name) in [
        (
            "VARIABLE/1, FUNCTION=VARVAL(2)+1\nVARIABLE/2, FUNCTION=VARVAL(1)",
            "VARIABLE/1",
        ),
        ("VARIABLE/3, FUNCTION=VARVAL(3)+TIME-2", "VARIABLE/3"),
    ] {
        let text = format!("circle\n{GROUND}{functions}\nEND\n");
        let folder = scratch_folder();
        let file = folder.join("model.adm");
        std::fs::write(&file, text).unwrap();
        let mut project = stiction::Project::load(&file).unwrap();
        project.push_dynamic(1.0, Some(4), None);
        let (report, _) = run(&project, stiction::RunOptions::default());
        std::fs::remove_dir_all(folder).unwrap();
        let stiction::Outcome::AssemblyFailed(text) = report.outcome else {
            panic!("{:?}", report.outcome)
        };
        assert!(text.contains(name), "{text}");
        assert!(text.contains("own value"), "{text}");
    }
    let text = format!(
        "circle\n{GROUND}VARIABLE/1, FUNCTION=VARVAL(2)\nVARIABLE/2, FUNCTION=VARVAL(1)\nEND\n"
    );
    let folder = scratch_folder();
    let file = folder.join("model.adm");
    std::fs::write(&file, text).unwrap();
    let project = stiction::Project::load(&file).unwrap();
    let error = stiction::Session::new(&project).unwrap_err().to_string();
    std::fs::remove_dir_all(folder).unwrap();
    assert!(error.contains("error[circular-variables]"), "{error}");
    assert!(
        error.contains("VARIABLE/1 is defined by nothing but its own value"),
        "{error}"
    );
}
