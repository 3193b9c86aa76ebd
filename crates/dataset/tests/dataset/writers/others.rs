//! Datasets of Adams Car, of programs for drawings, of old programs, and written by hand.

use super::{Snippet, components, read, refused};
use std::f64::consts::FRAC_PI_2;

#[rustfmt::skip]
pub(super) const SNIPPETS: &[Snippet] = &[
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
