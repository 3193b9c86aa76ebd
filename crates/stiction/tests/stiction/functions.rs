//! Functions that read the force of an element, against the motion that the force causes.

use std::fmt::Write;

use mechanics::rotation::from_euler_313;
use nalgebra::{Matrix3, Vector3};
use results::ResFile;

use crate::shared::run_text;

const GRAVITY: f64 = -9.8;
const INERTIA: [f64; 3] = [1.0, 2.0, 2.5];

/// The functions and their elements, each between marker I of a part of its own and marker J (or
/// JFLOAT) of ground; `{i}`, `{j}` and `{f}` stand for these markers.
const ELEMENTS: [(&str, &str); 12] = [
    ("JOINT", "JOINT/1, HOOKE, I={i}, J={j}"),
    ("JPRIM", "JPRIM/1, INPLANE, I={i}, J={j}"),
    (
        "MOTION",
        "MOTION/1, I={i}, J={j}, Z, FUNCTION=1+SIN(3*TIME)",
    ),
    (
        "SFORCE",
        "SFORCE/1, TRANSLATIONAL, I={i}, J={j}, FUNCTION=3+TIME",
    ),
    (
        "SPDP",
        "SPRINGDAMPER/1, TRANSLATIONAL, I={i}, J={j}, K=5, C=2, LENGTH=0.3",
    ),
    (
        "VFORCE",
        "VFORCE/1, I={i}, JFLOAT={f}, RM={j}, FX=1+TIME\\FY=2\\FZ=DX({i})\\",
    ),
    (
        "VTORQ",
        "VTORQUE/1, I={i}, JFLOAT={f}, RM={i}, TX=1+TIME\\TY=2\\TZ=DX({i})\\",
    ),
    (
        "GFORCE",
        "GFORCE/1, I={i}, JFLOAT={f}, RM={i}, FX=1+TIME\\FZ=2\\TY=DX({i})\\",
    ),
    (
        "BUSH",
        "BUSHING/1, I={i}, J={j}, K=1, 2, 3, KT=2, 1, 3, C=1, 1, 1",
    ),
    (
        "FIELD",
        "FIELD/1, I={i}, J={j}, LENGTH=1, 0, 0, 0, 0, 0, KMATRIX={k}",
    ),
    (
        "BEAM",
        "BEAM/1, I={i}, J={j}, LENGTH=1.3, AREA=2, IXX=1, IYY=1, IZZ=2, EMODULUS=3, GMODULUS=2, CRATIO=0.1",
    ),
    ("GCON", "GCON/1, I={i}, FUNCTION=DM({i},{j})-1.5"),
];

/// The model: one part an element, in general position and motion.
fn model() -> String {
    let stiffness: Vec<String> = (0..36).map(|k| format!("{}", 1 + k % 5)).collect();
    let mut text = String::from(
        "forces of elements
PART/1, GROUND
MARKER/11, PART=1, QP=0.3, -0.2, 0.5, REULER=20D, 40D, -30D
",
    );
    writeln!(text, "ACCGRAV/KGRAV={GRAVITY}").unwrap();
    for (place, (name, statement)) in ELEMENTS.iter().enumerate() {
        let part = place + 2;
        let [i, j, f] = [1, 2, 3].map(|k| 10 * part + k + 100);
        let [a, b, c] = [0.3, 1.1, 2.3].map(|s| ((part as f64) * s).sin());
        write!(
            text,
            "PART/{part}, MASS={part}, CM={centre}, IP=1, 2, 2.5, QG={a}, {b}, {c}, REULER={b}, {c}, {a}
, VX={c}, VY={a}, VZ={b}, WX={a}, WY={c}, WZ={b}
MARKER/{centre}, PART={part}
MARKER/{i}, PART={part}, QP=0.2, 0.5, -0.3, REULER=-40D, 25D, 15D
MARKER/{j}, PART=1, QP=0.4, {b}, -1.1, REULER=70D, {a}, 10D
MARKER/{f}, PART=1, FLOATING
",
            centre = 10 * part + 100,
        )
        .unwrap();
        let statement = statement
            .replace("{i}", &i.to_string())
            .replace("{j}", &j.to_string());
        let statement = statement.replace("{f}", &f.to_string());
        writeln!(text, "{}", statement.replace("{k}", &stiffness.join(", "))).unwrap();
        let j = if statement.contains("JFLOAT") { f } else { j };
        for (request, side) in [(part, 0), (part + 100, 1)] {
            let columns = (1..=8).map(|c| format!("F{c}={name}(1,{side},{c},11)\\"));
            let columns: String = columns.collect();
            if *name != "GCON" {
                writeln!(text, "REQUEST/{request}, {columns}").unwrap();
            }
        }
        if *name != "GCON" {
            writeln!(
                text,
                "REQUEST/{}, F1=FM({i},{j})\\F2=FX({i},{j},11)\\F3=FY({i},{j},11)\\F4=FZ({i},{j},11)\\
, F5=TM({i},{j})\\F6=TX({i},{j},11)\\F7=TY({i},{j},11)\\F8=TZ({i},{j},11)\\",
                part + 200
            )
            .unwrap();
        }
    }
    text + "END\n"
}

fn last(results: &ResFile, entity: &str, names: [&str; 3]) -> Vector3<f64> {
    Vector3::from(names.map(|name| {
        *results
            .get(&format!("{entity}.{name}"))
            .unwrap()
            .last()
            .unwrap()
    }))
}

/// Eight columns of a request: magnitude and components of the force and of the torque.
fn columns(results: &ResFile, request: usize) -> [f64; 8] {
    std::array::from_fn(|k| {
        let name = format!("REQUEST_{request}.F{}", k + 1);
        *results.get(&name).unwrap().last().unwrap()
    })
}

#[test]
fn element_forces_balance_the_motion() {
    let results = run_text(&model(), 0.2, 4, Some(1e-8));
    let rm = from_euler_313(&[20.0, 40.0, -30.0].map(f64::to_radians));
    for (place, (name, statement)) in ELEMENTS.iter().enumerate() {
        let part = place + 2;
        let entity = format!("PART_{part}_XFORM");
        let vector = |names| last(&results, &entity, names);
        let origin = vector(["X", "Y", "Z"]);
        let axes = from_euler_313(&vector(["PSI", "THETA", "PHI"]).into());
        let acceleration = vector(["ACCX", "ACCY", "ACCZ"]);
        let (omega, alpha) = (vector(["WX", "WY", "WZ"]), vector(["WDX", "WDY", "WDZ"]));
        // Newton and Euler: what acts on the part besides its weight, about marker I.
        let mass = part as f64;
        let force = mass * (acceleration - Vector3::new(0.0, 0.0, GRAVITY));
        let inertia = axes * Matrix3::from_diagonal(&Vector3::from(INERTIA)) * axes.transpose();
        let about_centre = inertia * alpha + omega.cross(&(inertia * omega));
        let i = origin + axes * Vector3::new(0.2, 0.5, -0.3);
        let torque = about_centre - (i - origin).cross(&force);
        // On J the opposite, about its own origin; a floating marker stands at I.
        let [_, b, _] = [0.3, 1.1, 2.3].map(|s| ((part as f64) * s).sin());
        let j = if statement.contains("JFLOAT") {
            i
        } else {
            Vector3::new(0.4, b, -1.1)
        };
        let back = -torque - (i - j).cross(&force);
        let expected = |force: Vector3<f64>, torque: Vector3<f64>| {
            let (f, t) = (rm.transpose() * force, rm.transpose() * torque);
            [force.norm(), f.x, f.y, f.z, torque.norm(), t.x, t.y, t.z]
        };
        if *name == "GCON" {
            // It has no function of its own: its result is along ground axes at I.
            let own = |names| last(&results, "GCON_1", names);
            // Rounding of accelerations and reactions of one instant.
            assert!((own(["FX", "FY", "FZ"]) - force).norm() < 1e-9);
            assert!((own(["TX", "TY", "TZ"]) - torque).norm() < 1e-9);
            continue;
        }
        for (request, wanted) in [
            (part, expected(force, torque)),
            (part + 100, expected(-force, back)),
            (part + 200, expected(force, torque)),
        ] {
            let found = columns(&results, request);
            for (component, (found, wanted)) in found.iter().zip(wanted).enumerate() {
                let error = (found - wanted).abs();
                assert!(
                    error < 1e-9 * (1.0 + wanted.abs()),
                    "{name} REQUEST/{request} {component}: {found} {wanted}"
                );
            }
        }
    }
}

/// Vectors of accelerations and forces against the functions of their components, and vector forces
/// given at once against the same by components.
#[test]
fn vectors_are_their_components() {
    let model = |first: &str, second: &str| {
        format!(
            "A body on a spring, pushed and turned
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
MARKER/3, PART=1, QP=0.2, 0.1, 2, REULER=0.3, 0.2, 0.1
MARKER/9, PART=1, FLOATING
MARKER/8, PART=1, FLOATING
PART/2, MASS=2, CM=20, IP=1, 2, 2.5, VX=0.4, WY=1.5
MARKER/20, PART=2
MARKER/21, PART=2, QP=0.5, 0.1, 0, REULER=0.2, 0.4, 0
BUSHING/1, I=21, J=1, K=30, 40, 50, KT=2, 3, 4, C=1, 1, 1, CT=0.1, 0.2, 0.3
VFORCE/1, I=21, JFLOAT=9, RM=3{first}
GFORCE/1, I=20, JFLOAT=8, RM=21{second}
REQUEST/1, F1=MAG(ACCXYZ(21,3,20))\\F2=ACCX(21,3,20)\\F3=ACCY(21,3,20)\\F4=ACCZ(21,3,20)
REQUEST/2, F1=MAG(FXYZ(21,1,3))\\F2=FX(21,1,3)\\F3=FY(21,1,3)\\F4=FZ(21,1,3)
, F5=MAG(TXYZ(21,1,3))\\F6=TX(21,1,3)\\F7=TY(21,1,3)\\F8=TZ(21,1,3)
REQUEST/3, F2=ACCXYZ(21,3,20)*[1,0,0]\\F3=ACCXYZ(21,3,20)*[0,1,0]\\F4=FXYZ(21,1,3)*[0,0,1]
, F6=TXYZ(21,1,3)*[1,0,0]\\F7=TXYZ(21,1,3)*[0,1,0]
INTEGRATOR/GSTIFF, SI2, ERROR=1E-7
END
"
        )
    };
    let vectors = model(
        ", FXYZ=-2*TRANS(VXYZ(21,1),3)+[3*TIME,0,\n, DX(21,1)]",
        ", FXYZ=0.1*WXYZ(20,1,21)%[1,2,3]\\ TXYZ=[0,0,1]*DM(21,1)",
    );
    let components = model(
        ", FX=-2*VX(21,1,3)+3*TIME\\FY=-2*VY(21,1,3)\\FZ=-2*VZ(21,1,3)+DX(21,1)",
        ", FX=0.1*(WY(20,1,21)*3-WZ(20,1,21)*2)\\FY=0.1*(WZ(20,1,21)-WX(20,1,21)*3)\
         \\FZ=0.1*(WX(20,1,21)*2-WY(20,1,21))\\TZ=DM(21,1)",
    );
    let (vectors, components) = (
        run_text(&vectors, 0.5, 5, None),
        run_text(&components, 0.5, 5, None),
    );
    let get = |name: &str| vectors.get(name).unwrap();
    for name in ["PART_2_XFORM.X", "PART_2_XFORM.Z", "PART_2_XFORM.WX"] {
        let pairs = get(name).into_iter().zip(components.get(name).unwrap());
        for (a, b) in pairs {
            // Rounding in other orders, along the motion.
            assert!((a - b).abs() < 1e-9, "{name}: {a} {b}");
        }
    }
    let close = |a: Vec<f64>, b: Vec<f64>, name: &str| {
        assert!(a.iter().any(|value| value.abs() > 1e-3), "{name}");
        for (a, b) in a.into_iter().zip(b) {
            assert!((a - b).abs() < 1e-12 * (1.0 + b.abs()), "{name}: {a} {b}");
        }
    };
    for (magnitude, parts) in [
        (
            "REQUEST_1.F1",
            ["REQUEST_1.F2", "REQUEST_1.F3", "REQUEST_1.F4"],
        ),
        (
            "REQUEST_2.F1",
            ["REQUEST_2.F2", "REQUEST_2.F3", "REQUEST_2.F4"],
        ),
        (
            "REQUEST_2.F5",
            ["REQUEST_2.F6", "REQUEST_2.F7", "REQUEST_2.F8"],
        ),
    ] {
        let [x, y, z] = parts.map(get);
        let norm = (0..x.len()).map(|k| x[k].hypot(y[k]).hypot(z[k]));
        close(get(magnitude), norm.collect(), magnitude);
    }
    for (inner, component) in [
        ("REQUEST_3.F2", "REQUEST_1.F2"),
        ("REQUEST_3.F3", "REQUEST_1.F3"),
        ("REQUEST_3.F4", "REQUEST_2.F4"),
        ("REQUEST_3.F6", "REQUEST_2.F6"),
        ("REQUEST_3.F7", "REQUEST_2.F7"),
    ] {
        close(get(inner), get(component), inner);
    }
}

#[test]
fn vectors_and_numbers_are_told_apart() {
    let model = "vectors
PART/1, GROUND
MARKER/1, PART=1
MARKER/9, PART=1, FLOATING
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2
";
    for (statement, words) in [
        (
            "VARIABLE/1, FUNCTION=DXYZ(20,1)",
            "FUNCTION takes a number, not a vector",
        ),
        (
            "VFORCE/1, I=20, JFLOAT=9, RM=1, FXYZ=DX(20,1)",
            "FXYZ takes a vector",
        ),
        ("VFORCE/1, I=20, JFLOAT=9, RM=1, FXYZ=[1,2,3], FX=1", "FX"),
        (
            "VARIABLE/1, FUNCTION=DXYZ(20,1)+1",
            "`+` does not join a vector and a number",
        ),
        (
            "VARIABLE/1, FUNCTION=1/DXYZ(20,1)",
            "`/` does not join a number and a vector",
        ),
        (
            "VARIABLE/1, FUNCTION=MAG(DXYZ(20,1)**2)",
            "`**` does not join",
        ),
        (
            "VARIABLE/1, FUNCTION=2%3",
            "`%` does not join a number and a number",
        ),
        (
            "VARIABLE/1, FUNCTION=MAG(DX(20,1))",
            "argument 1 of MAG is a vector",
        ),
        (
            "VARIABLE/1, FUNCTION=SIN([1,2,3])",
            "argument 1 of SIN is a number, not a vector",
        ),
        (
            "VARIABLE/1, FUNCTION=MAG([1,2])",
            "expected an operator or `,`, found `]`",
        ),
        (
            "VARIABLE/1, FUNCTION=MAG([1,2,3,4])",
            "expected an operator or `]`",
        ),
        (
            "VARIABLE/1, FUNCTION=MAG([1,2,[1,2,3]])",
            "numbers for components",
        ),
        ("VARIABLE/1, FUNCTION=[1,2", "`,` is missing"),
        (
            "MOTION/1, JOINT=1, FUNCTION=MAG(UVX(20))",
            "it may read TIME only",
        ),
    ] {
        let text = crate::shared::refusal(&format!(
            "{model}JOINT/1, REVOLUTE, I=20, J=1\n{statement}\nEND\n"
        ));
        assert!(text.contains(words), "{statement}: {text}");
        assert!(text.contains("model.adm:8:"), "{statement}: {text}");
    }
}
