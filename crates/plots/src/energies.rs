//! The energy balance of a run.

use plotters::coord::Shift;
use plotters::prelude::*;
use stiction::explain::EnergySeries;

use crate::axes::{Entry, Frame, Mark, curve, framed, range, with_unit, zero};
use crate::canvas::Drawn;
use crate::style::{BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION, px};
use crate::thinning::needed;

/// Columns that a curve is thinned to.
const COLUMNS: usize = 1200;

/// What is to be zero, and is shown however small it is.
const RESIDUAL: &str = "residual";
/// What stays below this part of the greatest would lie on the line at zero.
const SEEN: f64 = 1e-3;

/// Energies, works and what is left over, over time; what would not be seen is left out.
pub(crate) fn balance<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    energies: &EnergySeries,
) -> Drawn<B> {
    let start = energies.weight.first().copied().unwrap_or_default();
    let weight = energies.weight.iter().map(|weight| weight - start);
    let curves = [
        ("work of forces", energies.forces.clone(), GREEN),
        ("work of motions", energies.motions.clone(), ORANGE),
        ("kinetic", energies.kinetic.clone(), BLUE),
        ("potential (weight)", weight.collect(), SKY),
        ("stored in creep", energies.stored.clone(), PURPLE),
        ("dissipated", energies.dissipated.clone(), VERMILION),
        (RESIDUAL, energies.residual.clone(), BLACK),
    ];
    let size = |values: &[f64]| values.iter().fold(0.0, |most: f64, e| most.max(e.abs()));
    let greatest = curves.iter().map(|(_, e, _)| size(e)).fold(0.0, f64::max);
    let present: Vec<_> = curves
        .into_iter()
        .filter(|(name, values, _)| *name == RESIDUAL || size(values) > SEEN * greatest)
        .collect();
    let legend = present
        .iter()
        .map(|(name, _, colour)| Entry::new(*name, Mark::Line, *colour));
    let values = present
        .iter()
        .flat_map(|(_, values, _)| values.iter().copied());
    let frame = Frame {
        title: "energy balance: works put in = energies gained + dissipated",
        axes: [
            with_unit("time", &energies.time_unit),
            with_unit("energy", &energies.unit),
        ],
        legend: legend.collect(),
        x: range(energies.time.iter().copied(), 0.0),
        y: range(values.chain([0.0]), 0.05),
        numbers: true,
    };
    framed(area, &frame, |chart| {
        zero(chart)?;
        // The residual below the others.
        for (_, values, colour) in present.iter().rev() {
            let places = needed(&energies.time, values, COLUMNS);
            let points = places.iter().map(|&k| (energies.time[k], values[k]));
            curve(chart, points, *colour, px(2))?;
        }
        Ok(())
    })
}
