//! SPLINE as the functions AKISPL and CUBSPL interpolate it.

use std::collections::HashMap;
use std::sync::Arc;

use dataset::{Function, Spline};
use numerics::interpolation::{Extrapolation, PiecewiseCubic, Surface};

use super::Lowering;

/// The tables of a model, each once; `None` for a spline that was read with errors.
#[derive(Debug, Default)]
pub(super) struct Tables(HashMap<(Function, u32), Option<Arc<Surface>>>);

impl Lowering<'_> {
    /// The spline of this id as AKISPL or CUBSPL interpolates it; `None` where there is none that
    /// was read without errors.
    pub(super) fn table(&mut self, function: Function, id: u32) -> Option<Arc<Surface>> {
        let spline = self.dataset.splines.by_id(id)?;
        let table = self.tables.0.entry((function, id));
        let table = table.or_insert_with(|| surface(function, spline).map(Arc::new));
        table.clone()
    }
}

fn surface(function: Function, spline: &Spline) -> Option<Surface> {
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
    let drawn = curves.map(|curve| Some((curve.z, through(&spline.x, &curve.y, extrapolation)?)));
    Surface::new(drawn.collect::<Option<_>>()?)
}
