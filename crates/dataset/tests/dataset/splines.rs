//! SPLINE: curves, families of curves in both ways to write them, and their extrapolation.

use crate::shared::model;

#[test]
fn a_curve_and_families_of_curves() {
    let dataset = model(
        "title
PART/1, GROUND
SPLINE/1, X = -2, 0, 1.5
, 4, Y = 1, 2
, 3, 90D
, LINEAR_EXTRAPOLATE
spl/2, x = 1, 2, 3, 4
, y = 10, 1, 2, 3, 4
, y = 20, 5, 6, 7, 8
, y = 40, 9, 8, 7, 6
SPLINE/3, X = 1, 2, 3, 4, Z = 10, 20, Y = 1, 2, 3, 4, Y = 5, 6, 7, 8
",
    );
    let [curve, family, listed] = &*dataset.splines else {
        panic!("three splines");
    };
    assert_eq!(curve.x, [-2.0, 0.0, 1.5, 4.0]);
    assert_eq!(
        curve.curves[0].y,
        [1.0, 2.0, 3.0, std::f64::consts::FRAC_PI_2]
    );
    assert!(curve.linear_extrapolate && !family.linear_extrapolate);
    let z: Vec<f64> = family.curves.iter().map(|curve| curve.z).collect();
    assert_eq!(z, [10.0, 20.0, 40.0]);
    assert_eq!(family.curves[1].y, [5.0, 6.0, 7.0, 8.0]);
    assert_eq!(listed.curves[..], family.curves[..2]);
}
