//! Linkages: two benchmarks with far more equations than needed, and two
//! with friction.

use friction::{Inputs, Original, TranslationalLoad};
use mechanics::model::{FrictionJoint, JointKind, Level, Model, MotionFreedom};
use nalgebra::Vector3;

use crate::builder::{Builder, v};
use crate::turning::pin_load;

/// A02: `loops` four-bar loops of rods of 1 m and 1 kg side by side, all joints revolute. The
/// top moves at 1 m/s along x at first. Body `2 k` is the upright at x = k.
#[must_use]
pub fn four_bar_chain(loops: usize) -> Model {
    let mut b = Builder::new(v(0.0, -9.81, 0.0));
    let foot = |k: usize| v(k as f64, 0.0, 0.0);
    let head = |k: usize| v(k as f64, 1.0, 0.0);
    let mut last = None;
    for k in 0..=loops {
        let upright = b.rod(1.0, foot(k), head(k));
        let pin = b.pin(Some(upright), None, foot(k));
        if k == 0 {
            b.start_turning(pin, -1.0);
        }
        if let Some(bar) = last {
            b.pin(Some(upright), Some(bar), head(k));
        }
        if k < loops {
            let bar = b.rod(1.0, head(k), head(k + 1));
            b.pin(Some(bar), Some(upright), head(k));
            last = Some(bar);
        }
    }
    b.model
}

/// A04: Bricard's mechanism, five thin rods of 1 m and 1 kg along edges of a cube, six revolute
/// joints, each perpendicular to the rods that it joins. Body 2 ends at the point P3.
#[must_use]
pub fn bricard() -> Model {
    let points = [
        v(0.0, 0.0, 0.0),
        v(1.0, 0.0, 0.0),
        v(1.0, -1.0, 0.0),
        v(1.0, -1.0, 1.0),
        v(0.0, -1.0, 1.0),
        v(0.0, 0.0, 1.0),
    ];
    let mut b = Builder::new(v(0.0, -9.81, 0.0));
    let rods: Vec<usize> = points.windows(2).map(|p| b.rod(1.0, p[0], p[1])).collect();
    let axes = [
        Vector3::y(),
        Vector3::z(),
        Vector3::x(),
        Vector3::y(),
        Vector3::z(),
        Vector3::x(),
    ];
    for (k, (point, axis)) in points.into_iter().zip(axes).enumerate() {
        let before = (k > 0).then(|| rods[k - 1]);
        let after = rods.get(k).copied();
        b.joint(JointKind::Revolute, after, before, point, axis);
    }
    b.model
}

/// C01: crank 0.1 m, rod 0.3 m, slider along x; 1, 1.5 and 2 kg, weight along −y. The crank starts
/// at 0.5 rad with 20 rad/s. Friction in the slider.
#[must_use]
pub fn slider_crank(law: Option<Original>) -> Model {
    let mut b = Builder::new(v(0.0, -9.80665, 0.0));
    let (crank, rod, angle) = (0.1, 0.3, 0.5_f64);
    let knee = crank * v(angle.cos(), angle.sin(), 0.0);
    let tip = v(knee.x + (rod * rod - knee.y * knee.y).sqrt(), 0.0, 0.0);
    let first = b.rod(1.0, Vector3::zeros(), knee);
    let second = b.rod(1.5, knee, tip);
    let slider = b.body(2.0, [0.001; 3], tip);
    let drive = b.pin(Some(first), None, Vector3::zeros());
    b.start_turning(drive, 20.0);
    b.pin(Some(second), Some(first), knee);
    b.pin(Some(slider), Some(second), tip);
    let guide = b.joint(
        JointKind::Translational,
        Some(slider),
        None,
        tip,
        Vector3::x(),
    );
    let load = TranslationalLoad {
        inputs: Inputs {
            reaction_force: true,
            ..Inputs::NONE
        },
        reaction_arm: 1.0,
        bending_factor: 1.0,
        initial_overlap: 1.0,
        overlap_sign: 0.0,
    };
    if let Some(law) = law {
        b.friction(guide, law, FrictionJoint::Translational(load));
    }
    b.model
}

/// The slider-crank of C01 with friction in its pins of 15 mm radius too.
#[must_use]
pub fn slider_crank_with_pins(law: Option<Original>) -> Model {
    let mut b = Builder {
        model: slider_crank(law),
    };
    for joint in 0..3 {
        if let Some(law) = law {
            b.friction(joint, law, pin_load(0.015, 1.0));
        }
    }
    b.model
}

/// C01d: the slider-crank with friction in all joints driven at 30 rad/s (motion 0).
#[must_use]
pub fn driven_slider_crank(law: Option<Original>) -> Model {
    let mut b = Builder {
        model: slider_crank_with_pins(law),
    };
    b.drive(0, MotionFreedom::AboutZ, Level::Position, 30.0);
    b.start_turning(0, 30.0);
    b.model
}

/// C02: four-bar of 0.1, 0.35, 0.3 on a base of 0.4 m; 1, 3.5 and 3 kg, weight along −y. The crank
/// starts at 0.3 rad with 20 rad/s. Friction in all four pins of 15 mm radius.
#[must_use]
pub fn four_bar(law: Option<Original>) -> Model {
    let mut b = Builder::new(v(0.0, -9.80665, 0.0));
    let angle = 0.3_f64;
    let (base, knee) = (v(0.4, 0.0, 0.0), 0.1 * v(angle.cos(), angle.sin(), 0.0));
    let tip = corner(knee, 0.35, base, 0.3);
    let crank = b.rod(1.0, Vector3::zeros(), knee);
    let coupler = b.rod(3.5, knee, tip);
    let rocker = b.rod(3.0, tip, base);
    let drive = b.pin(Some(crank), None, Vector3::zeros());
    b.start_turning(drive, 20.0);
    b.pin(Some(coupler), Some(crank), knee);
    b.pin(Some(rocker), Some(coupler), tip);
    b.pin(Some(rocker), None, base);
    for joint in 0..4 {
        if let Some(law) = law {
            b.friction(joint, law, pin_load(0.015, 1.0));
        }
    }
    b.model
}

/// The point at distances `from_a` and `from_b`, left of the line from `a` to `b`.
fn corner(a: Vector3<f64>, from_a: f64, b: Vector3<f64>, from_b: f64) -> Vector3<f64> {
    let d = (b - a).norm();
    let along = (d * d + from_a * from_a - from_b * from_b) / (2.0 * d);
    let aside = (from_a * from_a - along * along).sqrt();
    let e = (b - a) / d;
    a + along * e + aside * Vector3::z().cross(&e)
}
