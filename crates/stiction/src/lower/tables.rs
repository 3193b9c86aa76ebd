//! SPLINE as the functions AKISPL and CUBSPL interpolate it.

use std::collections::HashMap;
use std::sync::Arc;

use dataset::{Function, Spline};
use numerics::interpolation::{Extrapolation, PiecewiseCubic, Surface};

use super::Lowering;

/// The tables of a model, each once.
#[derive(Debug, Default)]
pub(super) struct Tables(HashMap<(Function, u32), Arc<Surface>>);

impl Lowering<'_> {
    /// The spline of this id as AKISPL or CUBSPL interpolates it; `None` where there is none that
    /// was read without errors.
    pub(super) fn table(&mut self, function: Function, id: u32) -> Option<Arc<Surface>> {
        let spline = self.dataset.splines.by_id(id);
        let spline = spline.filter(|spline| spline.is_interpolable())?;
        let table = self.tables.0.entry((function, id));
        Some(Arc::clone(
            table.or_insert_with(|| Arc::new(surface(function, spline))),
        ))
    }
}

fn surface(function: Function, spline: &Spline) -> Surface {
    let extrapolation = if spline.linear_extrapolate {
        Extrapolation::Line
    } else {
        Extrapolation::Parabola
    };
    let through = match function {
        Function::Akispl => PiecewiseCubic::akima,
        _ => PiecewiseCubic::cubic_spline,
    };
    let curves = spline.curves.iter();
    Surface::new(
        curves
            .map(|curve| (curve.z, through(&spline.x, &curve.y, extrapolation)))
            .collect(),
    )
}
