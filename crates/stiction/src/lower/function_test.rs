//! Every function against an independent formula, its slopes against differences, and the places
//! where it may be used: the table `docs/functions.md`.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::path::Path;

use dataset::{Function, Severity, Source, read_dataset};
use mechanics::Simulation;
use mechanics::expression::{Input, Program};
use mechanics::measure;
use mechanics::model::Model;
use mechanics::state::MarkerFrame;
use nalgebra::{Matrix3, Vector3};

use super::{Measures, Mode, lower};

/// Three free bodies in general position, with markers 21, 31 and 41 beside their centres and 11
/// on ground; behind them a part for every element that a function can read.
const WORLD: &str = "functions
PART/1, GROUND
MARKER/1, PART=1
MARKER/11, PART=1, QP=0.3, -0.2, 0.5, REULER=20D, 40D, -30D
PART/2, MASS=1, CM=20, IP=1, 2, 2.5, QG=1.2, 0.7, -0.4, REULER=35D, 50D, 70D
, VX=0.3, VY=-0.5, VZ=0.8, WX=0.4, WY=0.9, WZ=-0.6
MARKER/20, PART=2
MARKER/21, PART=2, QP=0.2, 0.5, -0.3, REULER=-40D, 25D, 15D
PART/3, MASS=2, CM=30, IP=2, 2, 2.5, QG=-0.8, 0.1, 0.9, REULER=-75D, 30D, 10D
, VX=-0.7, VY=0.2, VZ=0.1, WX=-0.3, WY=0.2, WZ=0.5
MARKER/30, PART=3
MARKER/31, PART=3, QP=-0.1, 0.3, 0.4, REULER=60D, -35D, 20D
PART/4, MASS=2, CM=40, IP=2, 3, 2.5, QG=0.4, -1.1, 0.2, REULER=110D, 65D, -20D
, VX=0.1, VY=0.6, VZ=-0.4, WX=0.7, WY=-0.1, WZ=0.2
MARKER/40, PART=4
MARKER/41, PART=4, QP=0.3, 0.1, 0.2, REULER=10D, 55D, -65D
SPLINE/1, X=-3, -2, -1, 0, 1, 2, 3, Y=-21, -4, 1, 0, -1, 4, 21
SPLINE/2, X=1, 2, 4, 8, Y=0.5, 3, 1, 0.2
SPLINE/3, X=-3, -2, -1, 0, 1, 2, Y=-2, -24, -12, -4, 0, 0, -4, Y=1, 12, 6, 2, 0, 0, 2
PART/5, MASS=1, CM=50, IP=1, 1, 1, QG=9, 0, 0
MARKER/50, PART=5
MARKER/5, PART=1, QP=9, 0, 0
MARKER/9, PART=1, FLOATING
JOINT/1, REVOLUTE, I=50, J=5
MOTION/1, JOINT=1, ROTATIONAL, FUNCTION=TIME
FRICTION/1, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, INACTIVE=STATIC
MATRIX/1, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=0,0,0, 1,0,0, 2,1,0, 3,1,1
CURVE/1, OPEN, MATRIX=1, CURVE_POINTS
PART/7, MASS=1, CM=70, IP=1, 1, 1
MARKER/70, PART=7
PTCV/1, I=70, JFLOAT=9, RM=1, CURVE=1
PART/6, MASS=1, CM=60, IP=1, 1, 1, QG=9, 9, 0
MARKER/60, PART=6
JPRIM/1, INPLANE, I=60, J=1
SFORCE/1, TRANSLATIONAL, I=60, J=1, FUNCTION=1
SPRINGDAMPER/1, TRANSLATIONAL, I=60, J=1, K=1, C=1, LENGTH=1
VFORCE/1, I=60, JFLOAT=9, RM=1, FX=1\\
VTORQUE/1, I=60, JFLOAT=9, RM=1, TX=1\\
GFORCE/1, I=60, JFLOAT=9, RM=1, TX=1\\
BUSHING/1, I=60, J=1, K=1, 1, 1
FIELD/1, I=60, J=1
BEAM/1, I=60, J=1, LENGTH=1, AREA=1, IXX=1, IYY=1, IZZ=1, EMODULUS=1, GMODULUS=1
VARIABLE/1, FUNCTION=3+DX(21)
ARRAY/1, U, VARIABLES=1
DIFF/1, IC=1, FUNCTION=-DIF(1)
SENSOR/1, GE, VALUE=1, FUNCTION=TIME\\, EVALUATE=TIME
PINPUT/1, VARIABLES=1
POUTPUT/1, VARIABLES=1
";

/// What the formulas of the table are written in.
struct World {
    i: MarkerFrame,
    j: MarkerFrame,
    k: MarkerFrame,
    l: MarkerFrame,
    /// DX(21,31) and VY(21,31,41), the arguments of the functions of numbers.
    x: f64,
    y: f64,
}

type Formula = fn(&World) -> f64;

impl World {
    fn d(&self) -> Vector3<f64> {
        self.i.origin - self.j.origin
    }

    /// Rate of d as seen from l.
    fn v(&self) -> Vector3<f64> {
        self.i.velocity - self.j.velocity - self.l.omega.cross(&self.d())
    }

    fn w(&self) -> Vector3<f64> {
        self.i.omega - self.j.omega
    }

    /// Rotation matrix of i in j.
    fn r(&self) -> Matrix3<f64> {
        self.j.axes.transpose() * self.i.axes
    }
}

/// A sample call and its formula, `{x}` and `{y}` standing for the arguments of [`World`]. Without a
/// formula the named test verifies the function, or it is refused.
enum Check {
    Formula(&'static str, Formula),
    Test(&'static str, &'static str),
    Refused(&'static str),
}
use Check::{Formula as F, Refused, Test};

const COMPONENTS: &str = "tests/stiction/functions.rs: vectors_are_their_components";
const FORCES: &str = "tests/stiction/functions.rs: element_forces_balance_the_motion";

/// One row for each function, in the order of the table of functions.
fn checks() -> Vec<(Function, Check)> {
    use Function as N;
    vec![
        (N::Dx, F("DX(21,31,41)", |w| w.d().dot(&w.k.axis(0)))),
        (N::Dy, F("DY(21,31,41)", |w| w.d().dot(&w.k.axis(1)))),
        (N::Dz, F("DZ(21,31,41)", |w| w.d().dot(&w.k.axis(2)))),
        (N::Dm, F("DM(21,31)", |w| w.d().norm())),
        (
            N::Ax,
            F("AX(21,31)", |w| (-w.r()[(1, 2)]).atan2(w.r()[(2, 2)])),
        ),
        (
            N::Ay,
            F("AY(21,31)", |w| w.r()[(0, 2)].atan2(w.r()[(2, 2)])),
        ),
        (
            N::Az,
            F("AZ(21,31)", |w| w.r()[(1, 0)].atan2(w.r()[(0, 0)])),
        ),
        (
            N::Psi,
            F("PSI(21,31)", |w| w.r()[(0, 2)].atan2(-w.r()[(1, 2)])),
        ),
        (N::Theta, F("THETA(21,31)", |w| w.r()[(2, 2)].acos())),
        (
            N::Phi,
            F("PHI(21,31)", |w| w.r()[(2, 0)].atan2(w.r()[(2, 1)])),
        ),
        (
            N::Yaw,
            F("YAW(21,31)", |w| w.r()[(1, 0)].atan2(w.r()[(0, 0)])),
        ),
        (N::Pitch, F("PITCH(21,31)", |w| w.r()[(2, 0)].asin())),
        (
            N::Roll,
            F("ROLL(21,31)", |w| w.r()[(2, 1)].atan2(w.r()[(2, 2)])),
        ),
        (
            N::Incang,
            F("INCANG(21,31,41)", |w| {
                let e = w.k.origin - w.j.origin;
                (w.d().dot(&e) / w.d().norm() / e.norm()).acos()
            }),
        ),
        // Body-fixed 2-3-1: R[1][0] is the sine of the second angle.
        (N::Orient, F("ORIENT(2,2,21,31)", |w| w.r()[(1, 0)].asin())),
        (N::Vx, F("VX(21,31,41,11)", |w| w.v().dot(&w.k.axis(0)))),
        (N::Vy, F("VY(21,31,41,11)", |w| w.v().dot(&w.k.axis(1)))),
        (N::Vz, F("VZ(21,31,41,11)", |w| w.v().dot(&w.k.axis(2)))),
        (N::Vm, F("VM(21,31,11)", |w| w.v().norm())),
        (N::Vr, F("VR(21,31)", |w| w.v().dot(&w.d()) / w.d().norm())),
        (N::Wx, F("WX(21,31,41)", |w| w.w().dot(&w.k.axis(0)))),
        (N::Wy, F("WY(21,31,41)", |w| w.w().dot(&w.k.axis(1)))),
        (N::Wz, F("WZ(21,31,41)", |w| w.w().dot(&w.k.axis(2)))),
        (N::Wm, F("WM(21,31)", |w| w.w().norm())),
        (N::Accx, Test("ACCX(21,31,41,31)", ACCELERATIONS)),
        (N::Accy, Test("ACCY(21,31,41,31)", ACCELERATIONS)),
        (N::Accz, Test("ACCZ(21,31,41,31)", ACCELERATIONS)),
        (N::Accm, Test("ACCM(21,31,31)", ACCELERATIONS)),
        (N::Wdtx, Test("WDTX(21,31,41,31)", ACCELERATIONS)),
        (N::Wdty, Test("WDTY(21,31,41,31)", ACCELERATIONS)),
        (N::Wdtz, Test("WDTZ(21,31,41,31)", ACCELERATIONS)),
        (N::Wdtm, Test("WDTM(21,31,31)", ACCELERATIONS)),
        (N::Fx, Test("FX(60,1,11)", FORCES)),
        (N::Fy, Test("FY(60,1,11)", FORCES)),
        (N::Fz, Test("FZ(60,1,11)", FORCES)),
        (N::Fm, Test("FM(60,1)", FORCES)),
        (N::Tx, Test("TX(60,1,11)", FORCES)),
        (N::Ty, Test("TY(60,1,11)", FORCES)),
        (N::Tz, Test("TZ(60,1,11)", FORCES)),
        (N::Tm, Test("TM(60,1)", FORCES)),
        (
            N::Uvx,
            F("UVX(21,31)*[1,2,3]", |w| {
                w.r().column(0).dot(&Vector3::new(1.0, 2.0, 3.0))
            }),
        ),
        (
            N::Uvy,
            F("UVY(21,31)%[1,2,3]*UVX(41)", |w| {
                let own = w.r().column(1).cross(&Vector3::new(1.0, 2.0, 3.0));
                own.dot(&w.k.axis(0))
            }),
        ),
        (
            N::Uvz,
            F("UVZ(21)/2*(UVX(31)+[0,1,0])", |w| {
                w.i.axis(2).dot(&(w.j.axis(0) + Vector3::y())) / 2.0
            }),
        ),
        (
            N::Uv,
            F("UV(DXYZ(21,31))*VXYZ(21,31)", |w| {
                let v = w.i.velocity - w.j.velocity;
                v.dot(&w.d()) / w.d().norm()
            }),
        ),
        (
            N::Mag,
            F("MAG(DXYZ(21,31)-2*[{x},1,{y}])", |w| {
                (w.d() - 2.0 * Vector3::new(w.x, 1.0, w.y)).norm()
            }),
        ),
        (
            N::Trans,
            F("TRANS([1,{x},2],41,31)*[1,2,-1]", |w| {
                let v = w.j.axes * Vector3::new(1.0, w.x, 2.0);
                let v = w.k.axes.transpose() * v;
                v.x + 2.0 * v.y - v.z
            }),
        ),
        (
            N::Dxyz,
            F("DXYZ(21,31,41)*[1,-1,2]", |w| {
                let d = w.k.axes.transpose() * w.d();
                d.x - d.y + 2.0 * d.z
            }),
        ),
        (
            N::Vxyz,
            F("VXYZ(21,31,41,11)*(-[1,-1,2])", |w| {
                let v = w.k.axes.transpose() * w.v();
                -v.x + v.y - 2.0 * v.z
            }),
        ),
        (
            N::Wxyz,
            F("WXYZ(21,31,41)%[1,2,3]*[2,0,1]", |w| {
                let omega = w.k.axes.transpose() * w.w();
                let cross = omega.cross(&Vector3::new(1.0, 2.0, 3.0));
                2.0 * cross.x + cross.z
            }),
        ),
        (N::Accxyz, Test("ACCXYZ(21,31,41,31)*[1,0,0]", COMPONENTS)),
        (N::Fxyz, Test("FXYZ(60,1,11)*[1,0,0]", COMPONENTS)),
        (N::Txyz, Test("TXYZ(60,1,11)*[1,0,0]", COMPONENTS)),
        (N::Joint, Test("JOINT(1,0,2,11)", FORCES)),
        (N::Jprim, Test("JPRIM(1,0,2,11)", FORCES)),
        (N::Motion, Test("MOTION(1,0,8,11)", FORCES)),
        (N::Sforce, Test("SFORCE(1,0,2,11)", FORCES)),
        (N::Spdp, Test("SPDP(1,0,2,11)", FORCES)),
        (N::Ptcv, Test("PTCV(1,0,2,11)", TUBE)),
        (N::Cvcv, Refused("CVCV(1,0,2,11)")),
        (N::Vforce, Test("VFORCE(1,0,2,11)", FORCES)),
        (N::Vtorq, Test("VTORQ(1,0,6,11)", FORCES)),
        (N::Gforce, Test("GFORCE(1,0,6,11)", FORCES)),
        (N::Nforce, Refused("NFORCE(1,0,2,11)")),
        (N::Bush, Test("BUSH(1,0,2,11)", FORCES)),
        (N::Field, Test("FIELD(1,0,2,11)", FORCES)),
        (N::Beam, Test("BEAM(1,0,2,11)", FORCES)),
        (N::Contact, Refused("CONTACT(1,0,2,11)")),
        (
            N::Friction,
            Test(
                "FRICTION(1,6)",
                "tests/stiction/run_time.rs: requests_read_every_component_of_a_friction",
            ),
        ),
        (N::Varval, F("VARVAL(1)", |w| 3.0 + w.i.origin.x)),
        (N::Aryval, F("ARYVAL(1,1)", |w| 3.0 + w.i.origin.x)),
        (N::Dif, Test("DIF(1)", STATES)),
        (N::Dif1, Test("DIF1(1)", IMPLICIT)),
        (N::Pinval, F("PINVAL(1,1)", |w| 3.0 + w.i.origin.x)),
        (N::Pouval, F("POUVAL(1,1)", |w| 3.0 + w.i.origin.x)),
        (
            N::Senval,
            Test(
                "SENVAL(1)",
                "tests/stiction/run_time.rs: functions_read_what_a_sensor_has_kept",
            ),
        ),
        (N::Abs, F("ABS({y})", |w| w.y.abs())),
        (N::Acos, F("ACOS({x}/5)", |w| (w.x / 5.0).acos())),
        (N::Aint, F("AINT(3*{x})", |w| (3.0 * w.x).trunc())),
        (N::Anint, F("ANINT(3*{x})", |w| (3.0 * w.x).round())),
        (N::Asin, F("ASIN({x}/5)", |w| (w.x / 5.0).asin())),
        (N::Atan, F("ATAN({x})", |w| w.x.atan())),
        (N::Atan2, F("ATAN2({y},{x})", |w| w.y.atan2(w.x))),
        (N::Cos, F("COS({x})", |w| w.x.cos())),
        (N::Cosh, F("COSH({x})", |w| w.x.cosh())),
        (N::Dim, F("DIM({x},{y})", |w| (w.x - w.y).max(0.0))),
        (N::Exp, F("EXP({y})", |w| w.y.exp())),
        (N::Log, F("LOG({x}**2)", |w| (w.x * w.x).ln())),
        (N::Log10, F("LOG10({x}**2)", |w| (w.x * w.x).log10())),
        (N::Max, F("MAX({x},{y})", |w| w.x.max(w.y))),
        (N::Min, F("MIN({x},{y})", |w| w.x.min(w.y))),
        (N::Mod, F("MOD({x},0.3)", |w| w.x % 0.3)),
        (N::Sign, F("SIGN({x},{y})", |w| w.x.abs() * w.y.signum())),
        (N::Sin, F("SIN({x})", |w| w.x.sin())),
        (N::Sinh, F("SINH({x})", |w| w.x.sinh())),
        (N::Sqrt, F("SQRT(5+{x})", |w| (5.0 + w.x).sqrt())),
        (N::Tan, F("TAN({y})", |w| w.y.tan())),
        (N::Tanh, F("TANH({y})", |w| w.y.tanh())),
        (
            N::If,
            F("IF({x}-{y}: {x}**2, 7, 2*{y})", |w| {
                if w.x < w.y { w.x * w.x } else { 2.0 * w.y }
            }),
        ),
        (
            N::Step,
            F("STEP({x},-1,2,4,5)", |w| {
                let s = (w.x + 1.0) / 5.0;
                2.0 + 3.0 * s * s * (3.0 - 2.0 * s)
            }),
        ),
        (
            N::Step5,
            F("STEP5({x},4,2,-1,5)", |w| {
                let s: f64 = (4.0 - w.x) / 5.0;
                2.0 + 3.0 * s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s)
            }),
        ),
        (
            N::Havsin,
            F("HAVSIN({x},-1,2,4,5)", |w| {
                3.5 + 1.5 * (PI * (w.x + 1.0) / 5.0 - PI / 2.0).sin()
            }),
        ),
        (
            N::Impact,
            F("IMPACT({x},{y},4,10,1.5,2,5)", |w| {
                let s = (4.0 - w.x) / 5.0;
                10.0 * (4.0 - w.x).powf(1.5) - 2.0 * w.y * s * s * (3.0 - 2.0 * s)
            }),
        ),
        (
            N::Bistop,
            F("BISTOP({x},{y},-5,-3,10,1.5,2,8)", |w| {
                let s = (w.x + 3.0) / 8.0;
                -10.0 * (w.x + 3.0).powf(1.5) - 2.0 * w.y * s * s * (3.0 - 2.0 * s)
            }),
        ),
        (
            N::Poly,
            F("POLY({x},0.5,1,-2,3,-4)", |w| {
                let u: f64 = w.x - 0.5;
                1.0 - 2.0 * u + 3.0 * u * u - 4.0 * u.powi(3)
            }),
        ),
        (
            N::Cheby,
            F("CHEBY({x},0.5,1,-2,3,-4)", |w| {
                // T_k(u) = cos(k arccos u), continued beyond one by its own polynomials.
                let u: f64 = w.x - 0.5;
                1.0 - 2.0 * u + 3.0 * (2.0 * u * u - 1.0) - 4.0 * (4.0 * u.powi(3) - 3.0 * u)
            }),
        ),
        (
            N::Forcos,
            F("FORCOS({x},0.5,2,1,-2,3)", |w| {
                let u = 2.0 * (w.x - 0.5);
                1.0 - 2.0 * u.cos() + 3.0 * (2.0 * u).cos()
            }),
        ),
        (
            N::Forsin,
            F("FORSIN({x},0.5,2,1,-2,3)", |w| {
                let u = 2.0 * (w.x - 0.5);
                1.0 - 2.0 * u.sin() + 3.0 * (2.0 * u).sin()
            }),
        ),
        (
            N::Shf,
            F("SHF({x},0.5,3,2,0.1,7)", |w| {
                3.0 * (2.0 * (w.x - 0.5) - 0.1).sin() + 7.0
            }),
        ),
        (
            N::Sweep,
            F("SWEEP({x},3,-1,0.2,6,0.9,5)", |w| {
                let (u, s): (f64, f64) = (w.x + 1.0, (w.x + 1.0) / 5.0);
                let fade = s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s);
                let cycles = 0.2 * w.x + 0.7 / 7.0 * u * u / 2.0;
                3.0 * fade * (TAU * cycles).sin()
            }),
        ),
        (
            N::Invpsd,
            Test(
                "INVPSD({x},2,1,8,5,0,3)",
                "src/lower/function_test.rs: random_signals_have_their_power",
            ),
        ),
        // SPLINE/1 is x³ − 2x, which the cubic spline meets.
        (N::Cubspl, F("CUBSPL({x},0,1)", |w| w.x.powi(3) - 2.0 * w.x)),
        // SPLINE/3 is z (x² − x), which Akima's method meets where x is evenly spaced.
        (
            N::Akispl,
            F("AKISPL({x}/2,{y},3)", |w| {
                let u = w.x / 2.0;
                w.y * (u * u - u)
            }),
        ),
        (N::Interp, Refused("INTERP({x},1,1)")),
        (N::Curve, Test("CURVE({x},0,1,1)", COORDINATES)),
        (N::Delay, Refused("DELAY({x},1,0)")),
        (N::User, Refused("USER(1,2)")),
    ]
}

const IMPLICIT: &str =
    "tests/stiction/differential.rs: an_implicit_equation_is_solved_for_its_rate";
const TUBE: &str = "tests/stiction/curves.rs: a_bead_in_a_turning_tube_flies_out";
const COORDINATES: &str = "tests/stiction/curves.rs: a_function_reads_the_coordinates_of_a_curve";
const STATES: &str = "tests/stiction/differential.rs: a_force_and_a_state_drive_each_other";
const ACCELERATIONS: &str = "src/lower/function_test.rs: accelerations_are_rates_of_velocities";

fn sample(check: &Check, x: &str, y: &str) -> String {
    let (Check::Formula(text, _) | Check::Test(text, _) | Check::Refused(text)) = check;
    text.replace("{x}", x).replace("{y}", y)
}

/// The same with the arguments of [`World`].
fn of_world(check: &Check) -> String {
    sample(check, "DX(21,31)", "VY(21,31,41)")
}

/// The model of the world with one more statement.
fn model(statement: &str) -> Result<Model, String> {
    let source = Source::from_text("world.adm", format!("{WORLD}{statement}\nEND\n"));
    let (dataset, diagnostics) = read_dataset(&source);
    let mut text = String::new();
    for found in diagnostics.iter().filter(|d| d.severity == Severity::Error) {
        text += &found.message;
    }
    if !text.is_empty() {
        return Err(text);
    }
    let lowered = lower(
        &dataset,
        "world.adm",
        &mut Measures::default(),
        &Mode::Dynamic.into(),
    );
    lowered.map(|lowered| lowered.model).map_err(|diagnostics| {
        let messages = diagnostics.into_iter().map(|d| d.message);
        messages.collect::<String>()
    })
}

/// A force with this function, the last of the model's forces before elastic ones.
fn force(function: &str) -> Result<(Model, Program), String> {
    let text = format!("SFORCE/77, ROTATIONAL, I=20, J=1, FUNCTION={function}");
    let model = model(&text)?;
    let own = model.forces.iter().find(|force| force.label.id == 77);
    let function = own.unwrap().function.clone();
    Ok((model, function))
}

/// The program's value where `change` moves body `body`, and its exact slopes there.
fn evaluate(simulation: &mut Simulation, program: &Program) -> f64 {
    simulation.snapshot().evaluate(program, &|_| f64::NAN)
}

fn moved(model: &Model, change: impl Fn(&mut mechanics::state::State)) -> Simulation {
    let mut simulation = Simulation::new(model.clone(), 1.0);
    let mut state = simulation.state().clone();
    change(&mut state);
    simulation.set_state(state, &vec![[0.0; 3]; model.frictions.len()]);
    simulation
}

#[test]
fn values_and_slopes() {
    for (function, check) in checks() {
        let Check::Formula(_, formula) = check else {
            continue;
        };
        let (model, program) = force(&of_world(&check)).unwrap();
        let mut simulation = moved(&model, |_| {});
        let place = |id: u32| model.markers.iter().position(|m| m.id == id).unwrap();
        let frame = |id| simulation.snapshot().marker(place(id));
        let mut world = World {
            i: frame(21),
            j: frame(31),
            k: frame(41),
            l: frame(11),
            x: 0.0,
            y: 0.0,
        };
        world.x = world.d().x;
        world.y = (world.i.velocity - world.j.velocity).dot(&world.k.axis(1));
        let (found, wanted) = (evaluate(&mut simulation, &program), formula(&world));
        let name = function.name();
        // A dozen roundings.
        let error = (found - wanted).abs();
        assert!(
            error < 1e-13 * (1.0 + wanted.abs()),
            "{name}: {found} {wanted}"
        );

        let mut registers = vec![0.0; program.len()];
        let read = |input| match input {
            Input::Measure(place) => simulation.snapshot().measure(place),
            _ => 0.0,
        };
        program.evaluate(&mut registers, read);
        for body in 0..3 {
            let mut slopes = [0.0; 12];
            program.gradient(&registers, &mut vec![0.0; program.len()], |input, slope| {
                let Input::Measure(place) = input else { return };
                let measure = model.measures[place];
                let frames = measure.markers().map(|m| simulation.snapshot().marker(m));
                let [i, j, k, l] = &frames;
                let own = measure::slopes(measure.quantity, [i, j, k, l], body);
                for (sum, own) in slopes.iter_mut().zip(own) {
                    *sum += slope * own;
                }
            });
            for (motion, slope) in slopes.iter().enumerate() {
                let at = |h: f64| {
                    let mut moved = moved(&model, |state| {
                        let mut change = vec![0.0; 6 * model.bodies.len()];
                        if motion < 6 {
                            change[6 * body + motion] = h;
                            state.displace(&change);
                        } else {
                            state.velocities_mut()[6 * body + motion - 6] += h;
                        }
                    });
                    evaluate(&mut moved, &program)
                };
                let h = 1e-5;
                let difference = (at(h) - at(-h)) / (2.0 * h);
                // Truncation h² times third derivatives of up to a thousand (TAN).
                let error = (slope - difference).abs();
                assert!(
                    error < 1e-6 * (1.0 + slope.abs()),
                    "{name} {body} {motion}: {slope} {difference}"
                );
            }
        }
    }
}

#[test]
fn accelerations_are_rates_of_velocities() {
    let model = model("").unwrap();
    let place = |id: u32| model.markers.iter().position(|m| m.id == id).unwrap();
    let mut start = Simulation::new(model.clone(), 1.0);
    start.assemble().unwrap();
    start.solve_instant().unwrap();
    // Along the motion: positions to second order, velocities to first.
    let bodies = model.bodies.len();
    let rates: Vec<f64> = (0..bodies)
        .flat_map(|body| {
            let a = start.snapshot().marker_acceleration(centre(&model, body));
            [
                a.linear.x,
                a.linear.y,
                a.linear.z,
                a.angular.x,
                a.angular.y,
                a.angular.z,
            ]
        })
        .collect();
    let at = |h: f64| {
        let mut state = start.state().clone();
        let step: Vec<f64> = (state.velocities().iter().zip(&rates))
            .map(|(u, a)| h * u + 0.5 * h * h * a)
            .collect();
        state.displace(&step);
        for (u, a) in state.velocities_mut().iter_mut().zip(&rates) {
            *u += h * a;
        }
        let mut simulation = Simulation::new(model.clone(), 1.0);
        simulation.set_state(state, &vec![[0.0; 3]; model.frictions.len()]);
        let [i, j] = [21, 31].map(|id| simulation.snapshot().marker(place(id)));
        // As seen from l, which is j.
        let v = i.velocity - j.velocity - j.omega.cross(&(i.origin - j.origin));
        (v, i.omega - j.omega)
    };
    let h = 1e-4;
    let [ahead, here, behind] = [h, 0.0, -h].map(at);
    let l = start.snapshot().marker(place(31)).omega;
    let linear = (ahead.0 - behind.0) / (2.0 * h) - l.cross(&here.0);
    let angular = (ahead.1 - behind.1) / (2.0 * h) - l.cross(&here.1);
    let k = start.snapshot().marker(place(41)).axes.transpose();
    let wanted = [k * linear, k * angular].map(|v| [v.x, v.y, v.z, v.norm()]);
    let mut at_least = 0.0_f64;
    for (names, wanted) in [
        ["ACCX", "ACCY", "ACCZ", "ACCM"],
        ["WDTX", "WDTY", "WDTZ", "WDTM"],
    ]
    .iter()
    .zip(wanted)
    {
        for (name, wanted) in names.iter().zip(wanted) {
            let function = Function::from_name(name).unwrap();
            let (_, check) = checks().into_iter().find(|(f, _)| *f == function).unwrap();
            let found = output(&start, &of_world(&check));
            // Truncation h² times third derivatives of order one.
            assert!((found - wanted).abs() < 1e-7, "{name}: {found} {wanted}");
            at_least = at_least.max(found.abs());
        }
    }
    assert!(at_least > 0.1);
}

/// Marker at the centre of a body.
fn centre(model: &Model, body: usize) -> usize {
    let mut own = model.markers.iter().enumerate();
    own.find(|(_, marker)| marker.body == Some(body) && marker.offset.norm() == 0.0)
        .unwrap()
        .0
}

/// The value of a function as a request gives it, at the instant of `start`.
fn output(start: &Simulation, function: &str) -> f64 {
    let text = format!("{WORLD}REQUEST/77, F2={function}\nEND\n");
    let (dataset, _) = read_dataset(&Source::from_text("world.adm", text));
    let mut measures = Measures::default();
    let lowered = lower(&dataset, "world.adm", &mut measures, &Mode::Dynamic.into()).unwrap();
    let mut simulation = Simulation::new(lowered.model, 1.0);
    let frictions = simulation.model().frictions.len();
    simulation.assemble().unwrap();
    simulation.set_state(start.state().clone(), &vec![[0.0; 3]; frictions]);
    simulation.solve_instant().unwrap();
    let program = &lowered.outputs.program;
    let mut registers = vec![0.0; program.len()];
    program.evaluate(&mut registers, |input| match input {
        Input::Measure(place) => simulation.snapshot().measure(place),
        _ => f64::NAN,
    });
    let column = lowered.outputs.requests[0].columns[1].as_ref().unwrap();
    registers[column.value as usize]
}

#[test]
fn random_signals_have_their_power() {
    let (_, program) = force("INVPSD(TIME,2,1,8,5,0,3)").unwrap();
    let (_, other) = force("INVPSD(TIME,2,1,8,5,0,4)").unwrap();
    let mut registers = vec![0.0; program.len()];
    let mut at = |program: &Program, t: f64| program.evaluate(&mut registers, |_| t);
    // Sines at 1, 2.75, 4.5, 6.25 and 8 cycles: four seconds are whole periods of all. The density
    // at them is that of the lines between the points of SPLINE/2.
    let density = [0.5, 2.25, 0.9, 0.55, 0.2];
    let wanted: f64 = density.iter().map(|s| 1.75 * s).sum();
    let count = 400;
    let squares = (0..count).map(|k| at(&program, 4.0 * f64::from(k) / f64::from(count)).powi(2));
    let found = squares.sum::<f64>() / f64::from(count);
    // Sums of equidistant sines are exact but for rounding.
    assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
    assert_eq!(at(&program, 0.3), at(&program, 0.3));
    assert!((at(&program, 0.3) - at(&other, 0.3)).abs() > 1e-3);
}

/// Where a sample may be read, or why nowhere.
fn readers(sample: &str) -> String {
    let places = [
        (
            "MOTION",
            format!("MOTION/77, I=60, J=1, Z, FUNCTION={sample}"),
        ),
        ("GCON", format!("GCON/77, I=60, FUNCTION={sample}")),
        (
            "forces",
            format!("SFORCE/77, ROTATIONAL, I=20, J=1, FUNCTION={sample}"),
        ),
        ("outputs", format!("REQUEST/77, F2={sample}")),
    ];
    let mut readers = Vec::new();
    let mut refused = String::new();
    for (name, statement) in places {
        match model(&statement) {
            Ok(_) => readers.push(name),
            Err(message) => refused = message,
        }
    }
    if readers.is_empty() {
        let reason = refused.strip_prefix("REQUEST/77: ").unwrap_or(&refused);
        format!("refused: {reason}")
    } else {
        readers.join(", ")
    }
}

/// The document; with `STICTION_UPDATE_CASES` set it is rewritten.
#[test]
fn the_table_of_functions_is_up_to_date() {
    let mut table = String::from(
        "# Run-time functions\n\n\
         Written by the test `lower::function_test`, which also checks every row: values by \
         independent formulas,\nslopes by differences. Angles are in radians; markers that are left \
         out are the ground. \"Forces\" are\nSFORCE, VFORCE, VTORQUE and GFORCE; \"outputs\" are \
         REQUEST, SENSOR and VARIABLEs that nothing else reads.\n\n\
         | function | meaning | may be read by | verified by |\n|---|---|---|---|\n",
    );
    let checks = checks();
    let functions: Vec<Function> = checks.iter().map(|(function, _)| *function).collect();
    assert_eq!(
        functions,
        Function::ALL,
        "one row for each function, in order"
    );
    for (function, check) in &checks {
        // Functions of numbers may be read wherever their arguments may: here of time.
        let sample = sample(check, "TIME", "TIME");
        assert!(sample.starts_with(function.name()), "{sample}");
        let readers = readers(&sample);
        let verified = match check {
            Check::Formula(..) => "src/lower/function_test.rs: values_and_slopes",
            Check::Test(_, test) => test,
            Check::Refused(_) => "",
        };
        let refused = matches!(check, Check::Refused(_));
        assert_eq!(
            readers.starts_with("refused"),
            refused,
            "{sample}: {readers}"
        );
        if let Some((file, test)) = verified.split_once(": ") {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
            let text = std::fs::read_to_string(path).unwrap();
            assert!(text.contains(&format!("fn {test}(")), "{verified}");
        }
        let (name, arguments) = (function.name(), function.arguments());
        let meaning = function.meaning().replace('|', "\\|");
        writeln!(
            table,
            "| `{name}({arguments})` | {meaning} | {readers} | {verified} |"
        )
        .unwrap();
    }
    table += "\nTIME, MODE (4 dynamics, 5 statics, 6 quasi-statics), PI, DTOR (pi/180) and RTOD \
              (180/pi) are written\nwithout brackets; `30D` is 30 degrees.\n\n\
              Vectors are `[x, y, z]` and what UVX to TXYZ but MAG give. With `v` a vector and `s` a \
              number: `v+v`, `v-v`,\n`-v`, `s*v`, `v*s` and `v/s` are vectors, `v*v` is the inner and \
              `v%v` the cross product. FXYZ and TXYZ of\nVFORCE, VTORQUE and GFORCE take a vector, every \
              other argument a number.\n";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/functions.md");
    if std::env::var_os("STICTION_UPDATE_CASES").is_some() {
        std::fs::write(&path, &table).unwrap();
    }
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    let help = "run this test with STICTION_UPDATE_CASES=1 and read the difference";
    assert!(written == table, "docs/functions.md is out of date: {help}");
}
