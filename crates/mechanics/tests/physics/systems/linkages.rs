//! Frictionless linkages of the IFToMM library of benchmarks, with far more equations than needed.

use mechanics::model::{JointKind, Model};
use nalgebra::Vector3;

use crate::builder::{Builder, v};

/// A02: `loops` four-bar loops of rods of 1 m and 1 kg side by side, all joints revolute. The
/// top moves at 1 m/s along x at first. Body `2 k` is the upright at x = k.
pub(crate) fn four_bar_chain(loops: usize) -> Model {
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
pub(crate) fn bricard() -> Model {
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
