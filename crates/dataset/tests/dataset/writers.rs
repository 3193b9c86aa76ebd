//! Datasets in the manner of different writers: no word of them is unknown, and what is not
//! simulated is refused by its name.

use dataset::{
    Code, Corrector, Dataset, Diagnostic, Expr, Function, IntegratorMethod, MarkerOwner,
    MotionLevel, MotionTarget, Orientation, RequestKind, Severity, Source, read_commands,
    read_dataset,
};
use std::f64::consts::FRAC_PI_2;

/// A piece of a dataset.
struct Snippet {
    /// The writer.
    writer: &'static str,
    /// Statements on the ground with MARKER/1 to 4 and PART/2 with MARKER/20 to 23.
    text: &'static str,
    /// The only words whose refusal is allowed.
    refused: &'static [&'static str],
    check: fn(&Dataset),
}

const BASE: &str = "
PART/1, GROUND
MARKER/1, PART = 1
MARKER/2, PART = 1, QP = 1, 0, 0
MARKER/3, PART = 1, FLOATING
MARKER/4, PART = 1
PART/2, MASS = 1, CM = 20, IP = 1, 1, 1
MARKER/20, PART = 2
MARKER/21, PART = 2, QP = 0, 1, 0
MARKER/22, PART = 2
MARKER/23, PART = 2
";

const fn read(writer: &'static str, text: &'static str, check: fn(&Dataset)) -> Snippet {
    Snippet {
        writer,
        text,
        refused: &[],
        check,
    }
}

const fn refused(
    writer: &'static str,
    refused: &'static [&'static str],
    text: &'static str,
) -> Snippet {
    Snippet {
        writer,
        text,
        refused,
        check: |_| {},
    }
}

fn calls(expression: &Expr, expected: Function) -> bool {
    matches!(expression, Expr::Call { function, .. } if *function == expected)
}

fn components(model: &Dataset, request: u32) -> Vec<Option<String>> {
    let request = model.requests.by_id(request).expect("the request");
    let RequestKind::Functions(functions) = &request.kind else {
        panic!("not a request of functions");
    };
    let texts = functions.iter().map(|function| function.as_ref());
    texts
        .map(|function| function.map(|function| function.text.clone()))
        .collect()
}

#[rustfmt::skip]
const SNIPPETS: &[Snippet] = &[
    // Adams View: one argument a line.
    read("View, part", "
!-------------------------------- PARTS --------------------------------!
!
!                             adams_view_name='model_1.crank.2'
PART/7
, QG = 350, -1.0E-003, 0
, REULER = 90D, 0D, -90D
, VX = 12.5, WZ = 1.0D
, MASS = 2.3148
, CM = 70
, IP = 1.1E+003, 2.2E+003, 3.1E+003, -0.5, 0, 1.5E-012
, EXACT = X:Y:PSI
, MATERIAL = steel
!                             adams_view_name='cm'
MARKER/70, PART = 7
", |model| {
        let part = model.parts.by_id(7).unwrap();
        assert_eq!(part.header.name.as_deref(), Some("model_1.crank.2"));
        assert_eq!(part.qg, [350.0, -1e-3, 0.0]);
        assert_eq!(part.orientation, Orientation::Euler([FRAC_PI_2, 0.0, -FRAC_PI_2]));
        assert_eq!(part.angular_velocity[2], Some(1.0_f64.to_radians()));
        assert_eq!(part.inertia.unwrap()[5], 1.5e-12);
        assert!(part.exact.psi && !part.exact.z);
        assert_eq!(part.material.as_deref(), Some("steel"));
    }),
    read("View, point mass", "
POINT_MASS/5, MASS = 0.25, CM = 50, QG = 1, 2, 3, EXACT = X:Y:Z
MARKER/50, POINT_MASS = 5
", |model| assert_eq!(model.point_masses.by_id(5).unwrap().mass, 0.25)),
    read("by hand, markers behind their body", "
PART/60, MASS = 1, CM = 61, IP = 1, 1, 1
MARKER/61
POINT_MASS/6, MASS = 0.25, CM = 62
MARKER/62
MARKER/63, QP = 1, 2, 3
", |model| {
        let owner = |id| model.markers.by_id(id).unwrap().owner;
        assert_eq!(owner(61), MarkerOwner::Part(60));
        assert_eq!([62, 63].map(owner), [MarkerOwner::PointMass(6); 2]);
    }),
    read("View, joint and motion", "
!                           adams_view_name='JOINT_1'
JOINT/1
, CYLINDRICAL
, I = 20
, J = 1
, ICTRAN = 1.5, -2
, ICROT = 30D, 10D
!                           adams_view_name='MOTION_1'
MOTION/1
, JOINT = 1
, ROTATIONAL
, VELOCITY
, ICDISP = 45D
, FUNCTION = 30.0d
", |model| {
        assert_eq!(model.joints[0].ic_rotation.unwrap().velocity, Some(10.0_f64.to_radians()));
        assert_eq!(model.motions[0].level, MotionLevel::Velocity);
        assert_eq!(model.motions[0].target, MotionTarget::JointRotation(1));
        assert_eq!(model.motions[0].ic_displacement, Some(45.0_f64.to_radians()));
    }),
    read("by hand, motions that only name their joint", "
MOTION/1, JOINT = 2, FUNCTION = TIME
MOTION/2, JOINT = 1, FUNCTION = 10D*TIME
JOINT/1, REVOLUTE, I = 20, J = 1
JOINT/2, TRANSLATIONAL, I = 21, J = 2
", |model| {
        assert_eq!(model.motions[0].target, MotionTarget::JointTranslation(2));
        assert_eq!(model.motions[1].target, MotionTarget::JointRotation(1));
    }),
    read("View, spring of a line of sight", "
SFORCE/1
, TRANSLATIONAL
, I = 21
, J = 2
, FUNCTION = - 10.0*(dm(21,2)-100.0)
, - 1.0E-002*vr(21,2)
, + 0.0
", |model| assert!(matches!(model.single_forces[0].function.root, Expr::Binary { .. }))),
    read("View, long function", "
VARIABLE/11
, FUNCTION = IF(VARVAL(12)-0.5:0,
, 0,STEP5(TIME,
, 0,0,
, 1,1))
VARIABLE/12
, IC = 0.5
, FUNCTION = TIME
", |model| {
        assert!(calls(&model.variables[0].function.root, Function::If));
        assert_eq!(model.variables[1].ic, Some(0.5));
    }),
    read("View, requests", "
!                               adams_view_name='REQ'
REQUEST/10
, DISPLACEMENT
, I = 20
, J = 1
, COMMENT = model.REQ
, CNAMES = \"\", \"X, of crank\", \"Y!\", \"Z\", \"\", \"psi\", \"theta\", \"phi\"
, CUNITS = \"no_units\", \"length\", \"length\", \"length\", \"no_units\"
, \"angle\", \"angle\", \"angle\"
, RESULTS_NAME = crank_motion
REQUEST/11
, RESULTS_NAME = forces
, CLABELS = \"total; force\", \"a\"
, F1 = FM(20,1)\\F2 = FX(20,1,1)\\F6 = TX(20,1,1)\\
, C = X:Y:Z
", |model| {
        let request = model.requests.by_id(10).unwrap();
        assert_eq!(request.component_names[1], "X, of crank");
        assert_eq!(request.component_names[2], "Y!");
        assert_eq!(request.component_units.len(), 8);
        assert_eq!(request.results_name.as_deref(), Some("crank_motion"));
        assert_eq!(components(model, 11).iter().flatten().count(), 3);
        let request = model.requests.by_id(11).unwrap();
        assert_eq!(request.component_labels[0], "total; force");
        assert_eq!(request.comment.as_deref(), Some("X:Y:Z"));
    }),
    read("View, request of variables", "
VARIABLE/1, FUNCTION = TIME
VARIABLE/2, FUNCTION = 2*TIME
REQUEST/12
, VARIABLES = 2, 1
, CNAMES = \"twice\", \"once\"
", |model| {
        let components = components(model, 12);
        assert_eq!(components[0].as_deref(), Some("VARVAL(2)"));
        assert_eq!(components[1].as_deref(), Some("VARVAL(1)"));
        assert_eq!(components[2], None);
    }),
    read("View, request in the ground", "
REQUEST/13, FORCE, I = 20, J = 0, RM = 0
REQUEST/14, VELOCITY, I = 20, J = 1, RM = 22, TITLE = A:B:C:D:E:F:G:H
", |model| {
        let [first, second] = [13, 14].map(|id| model.requests.by_id(id).unwrap());
        assert_eq!((first.j, first.rm), (None, None));
        assert_eq!((second.j, second.rm), (Some(1), Some(22)));
    }),
    read("View, request of a subroutine", "
REQUEST/15
, CUNITS = \"force\"
, FUNCTION = USER(1, 2.5, -3)\\
, ROUTINE = my_lib::req1
, INTERFACE = FORTRAN
", |model| assert!(model.requests.is_empty())),
    read("View, sensor", "
SENSOR/1
, LE
, VALUE = 0
, ERROR = 1.0E-003
, BISECTION, TERROR = 1.0E-006
, HALT, CODGEN, RESTART, PRINT
, FUNCTION = DX(20,1)
SENSOR/2, VALUE = 90D, STEPSIZE = 1E-6, DT = 1E-3, YYDUMP, RETURN
, EVALUATE = MAX(VX(20,1), 3)\\
, FUNCTION = AZ(20,1)
", |model| {
        let [first, second] = [1, 2].map(|id| model.sensors.by_id(id).unwrap());
        assert!(first.halts && !first.returns && second.returns);
        assert_eq!(second.comparison, dataset::Comparison::Equal);
        assert_eq!(second.value, FRAC_PI_2);
    }),
    read("View, settings", "
INTEGRATOR/
, ERROR = 1.0E-004
, PATTERN = T:T:T:T:T:T:T:T:T:T
, MAXIT = 25
, HINIT = 1.0E-004
, SCALE = 1.0:1.0:1.0E-003
, CORRECTOR = modified
, GSTIFF, SI2
EQUILIBRIUM/
, DYNAMIC, GLOBAL_DAMPING = 0.5, SETTLING_TIME = 10
, ACCELERATION_ERROR = 1E-2, KINETIC_ENERGY_ERROR = 1E-2
, ALIMIT = 10D, TLIMIT = 20, METHOD = ADVANCED
KINEMATICS/
, HMAX = 1.0E-002
IC/ERROR = 1.0E-008, APATTERN = TRUE:FALSE
PREFERENCES/
, CONTACT_FACETING_TOLERANCE = 900.0
, CONTACT_GEOMETRY_LIBRARY = Parasolids
, NTHREADS = 14
, LIBPATH = C:\\libs\\x64:D:\\more libs
, FLEX_LIMIT_CHECK = SKIN, FLEX_LIMIT_CHECK_ACTION = MESSAGE_ONLY
, FLEX_BODY_FORMULATION = OPTIMIZED
, STATUS_MESSAGE = ON
LSOLVER/AUTO, STABILITY = 0.01
DEBUG/EPRINT, VERBOSE, JMDUMP
ENVIRONMENT/NAME = MSC_ADAMS_SOLVER_X, VALUE = \"a, b!\"
ENVIRONMENT/NAME = OTHER, UNSET
", |model| {
        let integrator = model.integrator.as_ref().unwrap();
        assert_eq!(integrator.method, Some(IntegratorMethod::Gstiff));
        assert_eq!(integrator.corrector, Some(Corrector::Modified));
        assert_eq!(integrator.maxit, Some(25));
        let equilibrium = model.equilibrium.as_ref().unwrap();
        assert_eq!(equilibrium.alimit, Some(10.0_f64.to_radians()));
        assert_eq!(model.kinematics.as_ref().unwrap().hmax, Some(0.01));
    }),
    read("View, integrators of other kinds", "
INTEGRATOR/ABAM, CORRECTOR = ORIG_CONSTANT, MAXERR = 1E-3, INTERPOLATE = ON
", |model| {
        let integrator = model.integrator.as_ref().unwrap();
        assert_eq!(integrator.method, None);
        assert_eq!(integrator.corrector, Some(Corrector::Original));
        assert_eq!(integrator.interpolate, Some(true));
    }),
    read("View, output", "
OUTPUT/
, REQSAVE
, GRSAVE
, RPCSAVE, DACSAVE, MATSAVE
, YPR, CHART, OSFORMAT, TELETYPE, ICSAVE
, DSCALE = 1, 57.3, VZERO = 1E-7
, LOADS = NASTRAN, STRESS = GENERIC, STRAIN = NONE
, MODAL_DEFORMATION = PUNCH, NODAL_DEFORMATION = ABAQUS
RESULTS/
, FORMATTED, XRF
, DECIMALPLACES = 10, ROUNDOFF = ON, SIGNIFICANTFIGURES = 10, ZEROTHRESHOLD = 1E-15
, SCIENTIFIC = -4:5, TRAILINGZEROS = OFF
, NOREQUESTS, NOTIRES, NODISPLACEMENTS
, COMMENT = run 5: stiff (rear)
", |model| {
        assert!(model.output.requests);
        assert_eq!(model.results.decimal_places, Some(10));
        assert_eq!(model.results.comment.as_deref(), Some("run 5: stiff (rear)"));
    }),
    read("View, graphics", "
GRAPHICS/1, CYLINDER, CM = 20, LENGTH = 25.4, RADIUS = 3.0, SIDES = 20, RANGLE = 359.9D
GRAPHICS/2
, EXTERNAL
, RM = 20
, FILE = C:\\models\\new, final\\crank 2.x_t
, ELEMENT = crank
GRAPHICS/3, FORCE, ETYPE = CONTACT TRACK, EID = 1, EMARKER = 20
GRAPHICS/4, OUTLINE = 1, 2, 20, CURVE, CID = 3, CRM = 1, SEG 10 X
GRAPHICS/5, TEXT, RM = 1, STRING = what: ever, SIZE = 3
", |model| assert_eq!(model.graphics.len(), 5)),
    read("View, plants", "
VARIABLE/1, FUNCTION = 0
VARIABLE/2, FUNCTION = AZ(20,1)
PINPUT/1, VARIABLES = 1
POUTPUT/1
, VARIABLES = 2
, 1
PSTATE/1, VARIABLES = 2
", |model| assert_eq!(model.plant_outputs[0].variables, [2, 1])),
    read("View, clearance and finite elements", "
CLEARANCE/1, IGEOM = 1, 2
, JGEOM = 3
, THRESHOLD = 20
FEMDATA/1, LOADS, I = 20, FILE = crank.inp, NODE_FILE = n.txt
MATERIAL/3
, NAME = steel
, YOUNGS_MODULUS = 2.07E+011
, POISSONS_RATIO = 0.29
, DENSITY = 7801
", |_| {}),
    read("View, bushing", "
BUSHING/1
, I = 21
, J = 2
, C = 0.3, 0.3, 0.3
, K = 1.2, 1.2, 1.2
, CT = 5200, 5200, 5200
, KT = 21000, 21000, 21000
, FORCE = 0, 0, -132412
, TORQUE = 0, 0, 0
", |model| assert_eq!(model.bushings[0].force[2], -132_412.0)),
    read("View, field", "
FIELD/1, I = 21, J = 2
, KMATRIX = 1, 0, 0, 0, 0, 0
, 0, 2, 0, 0, 0, 0
, 0, 0, 3, 0, 0, 0
, 0, 0, 0, 4, 0, 0
, 0, 0, 0, 0, 5, 0
, 7, 0, 0, 0, 0, 6
, CRATIO = 0.01, LENGTH = 1, 2, 3, 10D, 0, 0
", |model| {
        assert_eq!(model.fields[0].stiffness[0][5], 7.0);
        assert_eq!(model.fields[0].free[3], 10.0_f64.to_radians());
    }),
    // Forces whose subroutine is somewhere else.
    refused("View, general force of a subroutine", &["FUNCTION", "ROUTINE"], "
GFORCE/1
, I = 21
, JFLOAT = 3
, RM = 1
, FUNCTION = USER(903, 21, 3, 1.5E-03,
, 1000, -7)\\
, ROUTINE = C:\\my lib\\x64::gfo903
, INTERFACE = CPP
"),
    refused("View, variable of a subroutine", &["USER", "ROUTINE"], "
VARIABLE/5
, FUNCTION = USER(906, 1, 1017)\\
, ROUTINE = abgTire::var906
"),
    refused("View, motion of a subroutine", &["USER", "ROUTINE"], "
JOINT/1, REVOLUTE, I = 20, J = 1
MOTION/5, JOINT = 1, ROTATIONAL, FUNCTION = USER(1)\\, ROUTINE = /home/me/lib.so::
"),
    // Adams Car and its relatives.
    read("Car, request", "
!               adams_view_name='testrig.steering_motion_demands'
!               adams_view_units='no_units'
REQUEST/2
, TITLE = Steering Demands
, COMMENT = Steering Demands steering_angle/steering_rack_disp
, CUNITS = \"no_units\", \"angle\", \"length\", \"no_units\", \"no_units\", \"no_units\"
, \"no_units\", \"no_units\"
, CNAMES = \"\", \"steering_angle\", \"steering_rack_disp\", \"\", \"\", \"\", \"\", \"\"
, RESULTS_NAME = driver_demands
, F2 = AZ(21,2)\\
, F3 = DZ(21,2,2)
", |model| {
        let request = model.requests.by_id(2).unwrap();
        assert_eq!(request.header.name.as_deref(), Some("testrig.steering_motion_demands"));
        assert_eq!(request.component_names[2], "steering_rack_disp");
        assert_eq!(components(model, 2)[2].as_deref(), Some("DZ(21,2,2)"));
    }),
    read("Car, spring and damper", "
SPLINE/329
, X = -100, -50
, 0, 50, 100
, Y = -1000, -500
, 0, 500, 1000
SFORCE/1, TRANSLATIONAL, I = 21, J = 2
, FUNCTION = 1.0*akispl(299.7342371-dm(21,2),0,329)
SFORCE/2, TRANSLATIONAL, I = 21, J = 2
, FUNCTION = step(vr(21,2), -1e-4, 1.0, 1e-4, 1.0)*akispl(vr(21,2),0,329)
", |model| assert_eq!(model.single_forces.len(), 2)),
    refused("Car, tyre", &["FUNCTION", "ROUTINE", "USER", "ARRAY", "STRING", "DIFF", "GSE"], "
STRING/103
, STRING = mdids://acar_shared/tires.tbl/pac2002_235_60R16.tir
ARRAY/7
, IC
, SIZE = 3
, NUMBERS = 1, 2.5E-003
, -1
GFORCE/2
, I = 21, JFLOAT = 3, RM = 21
, FUNCTION = USER(900, 103, 7)\\
, ROUTINE = abgTire::gfo900
"),
    refused("Car, flexible part", &["FLEX_BODY", "MATRIX", "NODE", "MFORCE"], "
FLEX_BODY/1
, MATRICES = 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12
, CRATIO = 0.2\\
, MNF_FILE = mdids://shared/flex_bodys.tbl/antiroll.mnf
MATRIX/10
, FILE = antiroll.mtx
, NAME = R_MODE
MARKER/90, FLEX_BODY = 1, NODE_ID = 1247
MARKER/91, FLEX_BODY = 1, NODE = 12
MFORCE/1, FLEX_BODY = 1, CASE_INDEX = 1, SCALE = TIME
"),
    refused("View, markers on curves", &["CURVE", "SURFACE", "RM", "VX", "VY", "VZ"], "
CURVE/1, OPEN, MATRIX = 1, CURVE_POINTS, ORDER = 4
MATRIX/1, FULL = RORDER, ROWS = 4, COLUMNS = 3, VALUES = 0,0,0, 1,0,0, 2,1,0, 3,1,0
MARKER/80, CURVE = 1, VX = 1, VY = 0, VZ = 0, RM = 1
MARKER/81, SURFACE = 1, RM = 1, QP = 1, 2, 3
MARKER/82, PART = 2, RM = 20, QP = 1, 2, 3
"),
    refused("View, elements that are not simulated",
        &["NFORCE", "TIRE", "UCON", "ADAMS_BUSHING", "EXTERNAL_SYSTEM", "FE_LOAD", "CVCV"], "
NFORCE/1, I = 20, 21, J = 1, CMATRIX = 1, KMATRIX = 2, LENGTH = 3
TIRE/1, I = 20, JFLOAT = 3
UCON/1, FUNCTION = USER(1)
ADAMS_BUSHING/1, I = 20, J = 1
EXTERNAL_SYSTEM/1, TYPE = NLFE, INPUT_FILE = \"C:\\x\\y.inp\"
FE_LOAD/1, FE_PART = 1, FX = 1\\
CVCV/1, ICURVE = 1, JCURVE = 2, IRM = 1, JRM = 2
"),
    // SolidWorks Motion and others that export from drawings.
    read("SolidWorks, motor and gravity", "
PART/03
, MASS = 8.9512E-01 , CM = 0301
, QG = 0.0E+00, 0.0E+00, 0.0E+00
, IP = 1.0E-04, 1.0E-04, 1.0E-04, 0.0E+00, -0.0E+00, 0.0E+00
MARKER/0301, PART = 03, REULER = 1.570796327, .5, -1.
JOINT/03, REVOLUTE, I = 0301, J = 01
MOTION/3, I = 20, J = 1, B3, VELOCITY, FUNCTION = 600D
ACCGRAV/ IGRAV = 0, JGRAV = -9.80665, KGRAV = 0
!Mechanism simTime 5
", |model| {
        assert_eq!(model.joints[0].i, 301);
        assert_eq!(model.gravity, Some([0.0, -9.80665, 0.0]));
    }),
    read("SolidWorks, quoted and long names", "
!  adams_view_name='L\u{e4}ufer-1.Teil (neu)'
PART/8, CM = 80
MARKER/80, PART = 8 ! \u{b7}\u{b7} trailing remark, with comma
", |model| {
        let name = model.parts.by_id(8).unwrap().header.name.as_deref();
        assert_eq!(name, Some("L\u{e4}ufer-1.Teil (neu)"));
    }),
    read("Creo, several arguments a line", "
PART/9, MASS=7.8500000E-06, CM=901, IM=902,
 IP=1.0E+00,1.0E+00,1.0E+00
MARKER/901, PART=9, QP=1.0, 2.0, 3.0,
, ZP=1.0, 2.0, 4.0, XP=2.0, 2.0, 3.0
MARKER/902, PART=9, XP=1.0, 0.0, 0.0, ZP=0.0, 0.0, 1.0, USEXP
", |model| {
        assert_eq!(model.parts.by_id(9).unwrap().im, Some(902));
        assert_eq!(model.markers.by_id(901).unwrap().qp, [1.0, 2.0, 3.0]);
    }),
    // Written by hand for the old solver.
    read("by hand, abbreviations", "
P/3,MA=1.,CM=31,IP=1,1,1;M/31,Q=0,0,1,R=90D,0D,0D
J/3,REV,I=31,J=1,IC=30D,0;JP/4,INP,I=21,J=2
MOT/3,JO=3,ROT,FU=2*PI*TIME
SPR/1,TR,I=21,J=2,K=1E3,C=1.,L=2
VAR/1,FU=DX(21,2)**2;R/1,D,I=31,J=1,C=CRANK ANGLE
", |model| {
        assert_eq!(model.spring_dampers[0].stiffness, 1000.0);
        assert_eq!(model.joints.by_id(3).unwrap().ic_rotation.unwrap().displacement,
            Some(30.0_f64.to_radians()));
        assert_eq!(model.primitives.len(), 1);
    }),
    read("by hand, ampersands", "
SFORCE/0104, I=21, J=2, &
    TRANSLATION, &
    FUNCTION=1422.0 * DM(021, 02) ** (-1.4) &
   - 3.5*VR(21,2) &
   , ACTIONONLY
JOINT/1, &     ! the crank
  REVOLUTE,  &

  I=20, J=1
", |model| {
        assert_eq!(model.single_forces[0].header.id, 104);
        assert!(model.single_forces[0].action_only);
        assert_eq!(model.joints[0].i, 20);
    }),
    read("by hand, tabs and remarks between lines", "
JOINT/1,\tREVOLUTE
! the pin
\t, I=20

,\tJ=1
LIST
NOLIST
", |model| assert_eq!(model.joints[0].j, 1)),
    read("by hand, user words in any case", "
joint/1, revolute, i=20, j=1
Friction/1, Joint=1, mu_Static=.3, mu_dynamic=.25, Inputs=Preload:Reaction_Force, effect=all
", |model| assert_eq!(model.frictions[0].mu_dynamic, 0.25)),
    refused("by hand, friction of the old solver",
        &["FRICTION of JOINT", "DELTA_V", "MAXIMUM_DEFORMATION", "MU_DYN_ROT", "MU_STAT_ROT",
          "INNER_RADIUS", "OUTER_RADIUS", "MAX_FRIC_ROT", "PRELOAD_RADIAL", "PRELOAD_AXIAL"], "
JOINT/2, REVOLUTE, I=20, J=1, FRICTION=ON, DELTA_V=0.1, MAXIMUM_DEFORMATION=0.01
, MU_DYN_ROT=0.2, MU_STAT_ROT=0.3, INNER_RADIUS=1, OUTER_RADIUS=2
, PRELOAD_RADIAL=1, PRELOAD_AXIAL=2, MAX_FRIC_ROT=100
"),
    refused("View, functions of other programs",
        &["HSIZE", "CPU", "FXFREQ", "DCLEAR", "IDCLEARX", "WDTXYZ"], "
REQUEST/1, F2 = HSIZE\\F3 = CPU
VARIABLE/1, FUNCTION = DCLEAR(1) + IDCLEARX(1, 20)
VARIABLE/2, FUNCTION = WDTXYZ(20)
VARIABLE/3, FUNCTION = IF(FXFREQ-100: 0.01, 0.01, 0.1)
"),
    refused("View, external part", &["EXTERNAL_SYSTEM", "NONLINEAR", "FORMULATION"], "
MARKER/95, EXTERNAL_SYSTEM = 1, QP = 1, 2, 3
FIELD/9, I = 21, J = 2, FORMULATION = NONLINEAR
"),
    // Old exports of View.
    read("View of 1995", "
OUTPUT/REQSAVE, GRSAVE, NOPRINT, NOSEPARATOR
RESULTS/FORMATTED
MREQUEST/1, PARTS = ALL, DISPLACEMENT, COMMENT = all parts
MADATA/STATISTICS
GSTIFF/ERROR = 1E-4, KMAX = 6
INTEGRATOR/GSTIFF, RECONCILE = ALL, REPARTITION_THRESHOLD = 1E-3
FIELD/3, I=21, J=2, FORMULATION=LINEAR
REQUEST/1, ACCELERATION, I=20, J=1, COMMENTS = crank, and rod
SPRINGDAMPER/2, ROTATION, I=21, J=2, KT=1.0E+03, CT=2.0, ANGLE=90.0D, TORQUE=1
JPRIM/1, PARALLEL_AXES, I=21, J=2
", |model| {
        assert_eq!(model.spring_dampers[0].free_length, FRAC_PI_2);
        assert_eq!(model.requests[0].comment.as_deref(), Some("crank, and rod"));
    }),
    read("View of 2023, end with a remark behind", "
COUPLER/1, JOINTS = 1, 2, TYPE = ROTATIONAL:TRANSLATIONAL, SCALES = 1, -0.5
JOINT/1, REVOLUTE, I = 20, J = 1
PART/4, MASS = 1, CM = 40, IP = 1, 1, 1
MARKER/40, PART = 4
JOINT/2, TRANSLATIONAL, I = 40, J = 1
!------------------------------- END -------------------------------!
END
this is not read, = / ,
", |model| assert_eq!(model.couplers[0].freedoms[1].scale, -0.5)),
    read("large numbers of elements", "
PART/2147483647, MASS = 1, CM = 2147483646, IP = 1, 1, 1
MARKER/2147483646, PART = 2147483647
", |model| assert!(model.parts.by_id(2_147_483_647).is_some())),
];

/// The errors among `diagnostics` but the refusals of these words.
fn wrong(writer: &str, source: &Source, diagnostics: &[Diagnostic], refused: &[&str]) -> String {
    let is_wrong = |found: &&Diagnostic| {
        let unsupported = matches!(
            found.code,
            Code::UnsupportedArgument | Code::UnsupportedFunction | Code::UnsupportedStatement
        );
        let named = refused.iter().any(|word| found.message.contains(word));
        found.severity == Severity::Error && !(unsupported && named)
    };
    let errors = diagnostics.iter().filter(is_wrong);
    errors
        .map(|found| format!("{writer}:\n{}", found.render(source)))
        .collect()
}

#[test]
fn no_word_of_a_writer_is_unknown() {
    let mut all = String::new();
    for snippet in SNIPPETS {
        let text = format!("{}{BASE}{}", snippet.writer, snippet.text);
        let source = Source::from_text("writer.adm", text);
        let (model, diagnostics) = read_dataset(&source);
        let wrong = wrong(snippet.writer, &source, &diagnostics, snippet.refused);
        if wrong.is_empty() {
            (snippet.check)(&model);
        }
        all += &wrong;
    }
    assert!(all.is_empty(), "{all}");
}

/// Command files: the writer, the words whose refusal is allowed, and the text.
const COMMANDS: &[(&str, &[&str], &str)] = &[
    (
        "View",
        &["SAVE", "RELOAD"],
        "
file/model=model_1
preferences/simfail=nostopcf
preferences/contact_geometry_library=parasolids, contact_faceting_tolerance=300.0
output/noseparator
integrator/hht, error=1.0E-05, alpha=-0.3
equilibrium/maxit=100, stability=0.5
ic/error=1e-8
debug/eprint
lsolver/umf
simulate/initial_conditions
simulate/static
simulate/dynamic, end=5.0, steps=500
linear/eigensol, novector
save/system, file=state_1
reload/system, file=state_1
time
environment/name=X, value=\"1\"
stop
",
    ),
    (
        "View, linear models",
        &[
            "STATEMAT", "FILE", "PINPUT", "POUTPUT", "PSTATE", "FORMAT", "MKB", "EXPORT", "TYPE",
        ],
        "
file/model=model_1
simulate/static
linear/statemat, file=lin, pinput=1, poutput=1, format=matlab, pstate=1
linear/mkb, file=a
linear/export, type=nastran, file=b
",
    ),
    (
        "Car",
        &["CONTROL", "CLEARANCE", "ADAMS_BUSHING"],
        "
! front suspension
file/model=susp_par
output/nosep
control/ routine=abgSDI::EventInit, function=user(3,14,1,0)
deactivate/sensor, id=5
activate/sensor, range=5,9
activate/clearance, id=1
deactivate/adams_bushing, id=1
simulate/statics, end=10, dtout=0.1
sim/quasi, dur=1, st=10
sim/trans, dur=1, &
 dtout=0.01
stop
",
    ),
    (
        "by hand",
        &[],
        "pendulum
pendulum_out
OUTPUT/REQSAVE
SIM/KIN, END=1., ST=100
SIM/DYN,END=2,DTOUT=.01
ACCG/KG=0
WSTIFF/ERROR=1E-4
HELP
MENU
HOTLINE
DISPLAY/VIEW=1
RETURN
",
    ),
];

#[test]
fn no_command_of_a_writer_is_unknown() {
    let mut all = String::new();
    for (writer, refused, text) in COMMANDS {
        let source = Source::from_text("writer.acf", (*text).to_string());
        let (commands, diagnostics) = read_commands(&source);
        all += &wrong(writer, &source, &diagnostics, refused);
        assert!(commands.commands.len() > 1, "{writer}");
    }
    assert!(all.is_empty(), "{all}");
}
