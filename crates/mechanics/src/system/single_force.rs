//! How a single-component force of one unit acts on its two bodies.

use nalgebra::{Matrix3, Vector3};

use crate::equation::{Local, LocalMatrix};
use crate::model::ForceKind;
use crate::rotation::skew;
use crate::state::MarkerFrame;

/// Generalised force of one unit of a single-component force.
pub(super) fn direction(kind: ForceKind, i: &MarkerFrame, j: &MarkerFrame) -> Local {
    let mut local = Local::zeros();
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
    }
    local
}

/// Change of [`direction`] with the local motions.
pub(super) fn direction_stiffness(
    kind: ForceKind,
    i: &MarkerFrame,
    j: &MarkerFrame,
) -> LocalMatrix {
    let mut matrix = LocalMatrix::zeros();
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
    }
    matrix
}
