//! Datasets of Adams View.

use super::{Snippet, calls, components, read, refused};
use dataset::{
    Corrector, Expr, Function, IntegratorMethod, MarkerOwner, MotionLevel, MotionTarget,
    Orientation,
};
use std::f64::consts::FRAC_PI_2;

#[rustfmt::skip]
pub(super) const SNIPPETS: &[Snippet] = &[
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
        assert_eq!(integrator.method, Some(IntegratorMethod::Abam));
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
];
