//! Every argument of the forces of several components and of couplings, in full and abbreviated.

use dataset::{BeamDamping, CoupledFreedom, Expr};

use crate::shared::model;

const PARTS: &str = "title
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, FLOATING
PART/2, MASS=1, CM=20, IP=1,1,1
MARKER/20, PART=2
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, CYLINDRICAL, I=20, J=1
";

#[test]
fn components_of_vector_forces_have_their_places() {
    let text = format!(
        "{PARTS}VFORCE/1, I=20, JFLOAT=2, RM=1, FX=1\\FZ=TIME\\
vt/2, I=20, JF=2, RM=20
, TY=2
, TZ=DX(20,1)
, + 1
gf/3, i=20, j=2, rm=1, tx=3\\fy=4
"
    );
    let dataset = model(&text);
    let given =
        |components: &[Option<dataset::Expression>; 6]| components.clone().map(|c| c.is_some());
    let force = &dataset.vector_forces[0];
    assert_eq!((force.i, force.j_float, force.rm), (20, 2, 1));
    assert_eq!(
        given(&force.components),
        [true, false, true, false, false, false]
    );
    assert_eq!(force.components[2].as_ref().unwrap().root, Expr::Time);
    let torque = &dataset.vector_torques[0];
    assert_eq!(
        given(&torque.components),
        [false, false, false, false, true, true]
    );
    assert_eq!(torque.components[5].as_ref().unwrap().text, "DX(20,1) + 1");
    let general = &dataset.general_forces[0];
    assert_eq!(
        given(&general.components),
        [false, true, false, true, false, false]
    );
}

#[test]
fn elastic_forces_take_every_argument() {
    let text = format!(
        "{PARTS}BUSHING/1, I=20, J=1, K=1,2,3, KT=4,5,6, C=7,8,9, CT=10,11,12
, FORCE=13,14,15, TORQUE=16,17,18
FIELD/1, I=20, J=1, LENGTH=1,2,3,4D,5D,6D, FORCE=1,2,3,4,5,6
, CMATRIX=
, 1,2,3,4,5,6, 7,8,9,10,11,12, 13,14,15,16,17,18
, 19,20,21,22,23,24, 25,26,27,28,29,30, 31,32,33,34,35,36
BEAM/1, I=20, J=1, L=2, AREA=3, IX=4, IY=5, IZ=6, ASY=1.2, ASZ=1.1, EMOD=7, GMOD=8, CR=0.1
BEAM/2, I=20, J=1, LENGTH=2, AREA=3, IXX=4, IYY=5, IZZ=6, EMODULUS=7, GMODULUS=8
, FORMULATION=LINEAR
, CMATRIX=1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21
"
    );
    let dataset = model(&text);
    let bushing = &dataset.bushings[0];
    assert_eq!(bushing.stiffness, [1.0, 2.0, 3.0]);
    assert_eq!(bushing.torsional_stiffness, [4.0, 5.0, 6.0]);
    assert_eq!(bushing.damping, [7.0, 8.0, 9.0]);
    assert_eq!(bushing.torsional_damping, [10.0, 11.0, 12.0]);
    assert_eq!(
        (bushing.force, bushing.torque),
        ([13.0, 14.0, 15.0], [16.0, 17.0, 18.0])
    );
    let field = &dataset.fields[0];
    // By columns: the first row has every sixth number.
    assert_eq!(field.damping[0], [1.0, 7.0, 13.0, 19.0, 25.0, 31.0]);
    assert_eq!(field.damping[5][0], 6.0);
    assert_eq!(field.stiffness, [[0.0; 6]; 6]);
    assert_eq!(field.preload, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    assert_eq!(field.free[4], 5.0_f64.to_radians());
    let beam = &dataset.beams[0];
    assert_eq!(
        (beam.length, beam.area, beam.torsional_constant),
        (2.0, 3.0, 4.0)
    );
    assert_eq!((beam.moment_y, beam.moment_z), (5.0, 6.0));
    assert_eq!((beam.shear_y, beam.shear_z), (1.2, 1.1));
    assert_eq!((beam.young, beam.shear_modulus), (7.0, 8.0));
    assert_eq!(beam.damping, BeamDamping::Ratio(0.1));
    let BeamDamping::Matrix(damping) = &dataset.beams[1].damping else {
        panic!("CMATRIX is read");
    };
    // Columns of the lower half: 1 to 6, then 7 to 11 from the diagonal down.
    assert_eq!(damping[0], [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    assert_eq!(damping[1], [2.0, 7.0, 8.0, 9.0, 10.0, 11.0]);
    assert_eq!(damping[5][5], 21.0);
}

#[test]
fn couplings_take_every_argument() {
    let text = format!(
        "{PARTS}COUPLER/1, JOINTS=1, 2, TYPE=R:T, SCALES=-2
GEAR/1, JOINTS=1, 2, CV=1
JOINT/3, SCREW, I=20, J=1, PITCH=-0.5
"
    );
    let dataset = model(&text);
    let freedom = |joint, rotation, scale| CoupledFreedom {
        joint,
        rotation: Some(rotation),
        scale,
    };
    let wanted = [freedom(1, true, 1.0), freedom(2, false, -2.0)];
    assert_eq!(dataset.couplers[0].freedoms, wanted);
    let gear = &dataset.gears[0];
    assert_eq!((gear.joints.as_slice(), gear.cv), ([1, 2].as_slice(), 1));
    assert_eq!(dataset.joints[2].pitch, Some(-0.5));
}
