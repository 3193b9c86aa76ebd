//! How a single-component force of one unit acts on its two bodies.

use nalgebra::{Matrix3, SMatrix, Vector3};

use crate::equation::{Local, LocalMatrix};
use crate::model::ForceKind;
use crate::rotation::skew;
use crate::state::MarkerFrame;

/// Frames of marker I, of marker J, and of the marker whose axes give the direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frames<'a> {
    pub(super) i: &'a MarkerFrame,
    pub(super) j: &'a MarkerFrame,
    pub(super) frame: &'a MarkerFrame,
}

impl Frames<'_> {
    /// The bodies of I and J.
    pub(super) fn sides(&self) -> [Option<usize>; 2] {
        [self.i.body, self.j.body]
    }

    /// From the centre of mass of J's body to the origin of I.
    fn reach(&self) -> Vector3<f64> {
        self.j.arm + self.i.origin - self.j.origin
    }
}

/// Change of a generalised force by the rotation (ground axes) of one body.
pub(super) type ByRotation = SMatrix<f64, 12, 3>;

/// Generalised force of one unit of a single-component force.
pub(super) fn direction(kind: ForceKind, frames: &Frames<'_>) -> Local {
    let mut local = Local::zeros();
    let Frames { i, j, frame } = frames;
    match kind {
        ForceKind::LineOfSight => {
            let d = i.origin - j.origin;
            // Coincident markers have no line: the force is then zero, as its direction is unknown.
            let n = d.try_normalize(0.0).unwrap_or_else(Vector3::zeros);
            local.fixed_rows_mut::<3>(0).copy_from(&n);
            local.fixed_rows_mut::<3>(3).copy_from(&i.arm.cross(&n));
            local.fixed_rows_mut::<3>(6).copy_from(&-n);
            local.fixed_rows_mut::<3>(9).copy_from(&-j.arm.cross(&n));
        }
        ForceKind::AlongZ => {
            let z = j.axis(2);
            local.fixed_rows_mut::<3>(0).copy_from(&z);
            local.fixed_rows_mut::<3>(3).copy_from(&i.arm.cross(&z));
        }
        ForceKind::AboutZ => {
            let z = j.axis(2);
            local.fixed_rows_mut::<3>(3).copy_from(&z);
            local.fixed_rows_mut::<3>(9).copy_from(&-z);
        }
        ForceKind::AboutZActionOnly => {
            local.fixed_rows_mut::<3>(3).copy_from(&j.axis(2));
        }
        ForceKind::AlongAxis { axis, .. } => {
            let a = frame.axis(axis);
            local.fixed_rows_mut::<3>(0).copy_from(&a);
            local.fixed_rows_mut::<3>(3).copy_from(&i.arm.cross(&a));
            local.fixed_rows_mut::<3>(6).copy_from(&-a);
            let moment = frames.reach().cross(&a);
            local.fixed_rows_mut::<3>(9).copy_from(&-moment);
        }
        ForceKind::AboutAxis { axis, .. } => {
            let a = frame.axis(axis);
            local.fixed_rows_mut::<3>(3).copy_from(&a);
            local.fixed_rows_mut::<3>(9).copy_from(&-a);
        }
    }
    local
}

/// Change of [`direction`] with the local motions of the bodies of I and J; that of an axis of
/// another marker is [`direction_by_frame`].
pub(super) fn direction_stiffness(kind: ForceKind, frames: &Frames<'_>) -> LocalMatrix {
    let mut matrix = LocalMatrix::zeros();
    let Frames { i, j, .. } = frames;
    let mut put = |row: usize, column: usize, block: Matrix3<f64>| {
        let mut view = matrix.fixed_view_mut::<3, 3>(row, column);
        view += block;
    };
    let z = skew(&j.axis(2));
    match kind {
        ForceKind::LineOfSight => {
            let d = i.origin - j.origin;
            let length = d.norm();
            if length == 0.0 {
                return matrix;
            }
            let n = d / length;
            let across = (Matrix3::identity() - n * n.transpose()) / length;
            let (rho_i, rho_j, n) = (skew(&i.arm), skew(&j.arm), skew(&n));
            // δd = δr_I − ρ_I× δθ_I − δr_J + ρ_J× δθ_J;  δn = across δd
            let changes = [across, -across * rho_i, -across, across * rho_j];
            for (column, change) in changes.into_iter().enumerate() {
                put(0, 3 * column, change);
                put(3, 3 * column, rho_i * change);
                put(6, 3 * column, -change);
                put(9, 3 * column, -rho_j * change);
            }
            // δρ × n = n× ρ× δθ
            put(3, 3, n * rho_i);
            put(9, 9, -n * rho_j);
        }
        ForceKind::AlongZ => {
            let rho = skew(&i.arm);
            put(0, 9, -z);
            put(3, 3, z * rho);
            put(3, 9, -rho * z);
        }
        ForceKind::AboutZ => {
            put(3, 9, -z);
            put(9, 9, z);
        }
        ForceKind::AboutZActionOnly => put(3, 9, -z),
        ForceKind::AlongAxis { axis, .. } => {
            // δ(ρ × a) = a× ρ× δθ_I, and with c = o_I − r_J: −δ(c × a) = a× (δr_I − ρ× δθ_I − δr_J)
            let (rho, a) = (skew(&i.arm), skew(&frames.frame.axis(axis)));
            put(3, 3, a * rho);
            put(9, 0, a);
            put(9, 3, -a * rho);
            put(9, 6, -a);
        }
        // Only its axis changes.
        ForceKind::AboutAxis { .. } => {}
    }
    matrix
}

/// Change of [`direction`] with the rotation of the body that carries the axis of a component;
/// `None` for the kinds whose direction [`direction_stiffness`] knows completely.
pub(super) fn direction_by_frame(kind: ForceKind, frames: &Frames<'_>) -> Option<ByRotation> {
    let mut change = ByRotation::zeros();
    let mut put = |row: usize, block: Matrix3<f64>| {
        change.fixed_view_mut::<3, 3>(row, 0).copy_from(&block);
    };
    // δa = −a× δθ
    match kind {
        ForceKind::AlongAxis { axis, .. } => {
            let a = skew(&frames.frame.axis(axis));
            put(0, -a);
            put(3, -skew(&frames.i.arm) * a);
            put(6, a);
            put(9, skew(&frames.reach()) * a);
        }
        ForceKind::AboutAxis { axis, .. } => {
            let a = skew(&frames.frame.axis(axis));
            put(3, -a);
            put(9, a);
        }
        ForceKind::LineOfSight
        | ForceKind::AlongZ
        | ForceKind::AboutZ
        | ForceKind::AboutZActionOnly => return None,
    }
    Some(change)
}
