//! Pictures of what friction did in a run, as SVG or PNG, from the results that the run has written.
//!
//! | what | file |
//! |---|---|
//! | a friction over time, against velocity or displacement, by cause; regimes | `frictions.rs` |
//! | the energy balance | `energies.rs` |
//! | axes, ticks, legends | `axes.rs`, colours and letters `style.rs` |
//! | long series | `thinning.rs` |
//! | drawing to the bytes of a file | `canvas.rs`, `dots.rs` |
//!
//! ```no_run
//! use plots::{Format, Kind, draw};
//! use stiction::explain::RunResults;
//!
//! let run = RunResults::open("pendulum-run".as_ref())?;
//! let friction = run.find("FRICTION/103")?;
//! let picture = draw(&run, Kind::Friction, &[friction], Format::Svg)?;
//! std::fs::write("friction.svg", picture)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axes;
mod canvas;
mod dots;
mod energies;
mod frictions;
mod style;
mod thinning;

use plotters::coord::Shift;
use plotters::prelude::{DrawingArea, DrawingBackend};
use stiction::explain::{EnergySeries, ExplainError, FrictionSeries, RunResults};

use crate::canvas::{Drawing, Drawn, render};
pub use crate::style::{COLOURS, FAMILY, prepare_letters};

/// What a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Each friction over time, its regimes below.
    Friction,
    /// When the frictions are stuck, in transition or sliding.
    Regime,
    /// Each friction against what its surfaces do.
    Loop(Along),
    /// Each friction by its causes, as stacked areas.
    Share,
    /// The energy balance of the model.
    Energy,
}

/// What a hysteresis loop is drawn against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Along {
    /// The velocity of the surfaces.
    Velocity,
    /// How far the surfaces have moved, by the trapezoidal rule over the outputs.
    Displacement,
}

/// A format of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Scalable vectors.
    Svg,
    /// Dots, two for a pixel in each direction.
    Png,
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum PlotError {
    /// The results do not have what is asked for.
    #[error(transparent)]
    Results(#[from] ExplainError),
    /// Too many frictions for one picture.
    #[error(
        "{asked} frictions do not fit into one picture, which holds {most}; choose with --friction"
    )]
    TooMany {
        /// Number of frictions.
        asked: usize,
        /// The most that fit.
        most: usize,
    },
    /// Values too large for an axis.
    #[error("the values are too large to be drawn: up to {0:e}")]
    TooLarge(f64),
    /// The drawing failed.
    #[error("cannot draw: {0}")]
    Drawing(String),
}

/// Width of every picture, pixels.
const WIDTH: u32 = 900;
/// Height of a panel with axes.
const PANEL: u32 = 320;
/// Height of the row of a friction among regimes, and of what is around the rows.
const ROW: u32 = 44;
const AROUND_ROWS: u32 = 90;
/// No picture is higher: it would be no picture to look at, and large in memory.
const HIGHEST: u32 = 3200;
/// No axis goes beyond, so that the width of a range is a number.
const LARGEST: f64 = 1e300;

/// A picture with its data.
enum Picture {
    Panels(Kind, Vec<(String, FrictionSeries)>),
    Energy(Box<EnergySeries>),
}

impl Drawing for Picture {
    fn size(&self) -> (u32, u32) {
        let height = match self {
            Self::Panels(Kind::Regime, all) => AROUND_ROWS + ROW * all.len() as u32,
            Self::Panels(_, all) => PANEL * all.len() as u32,
            Self::Energy(_) => PANEL + PANEL / 4,
        };
        (WIDTH, height)
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        let (kind, all) = match self {
            Self::Energy(energies) => return energies::balance(area, energies),
            Self::Panels(Kind::Regime, all) => return frictions::when(area, all),
            Self::Panels(kind, all) => (*kind, all),
        };
        for (panel, (title, series)) in area.split_evenly((all.len(), 1)).iter().zip(all) {
            match kind {
                Kind::Loop(along) => frictions::against(panel, title, series, along)?,
                Kind::Share => frictions::shares(panel, title, series)?,
                _ => frictions::over_time(panel, title, series)?,
            }
        }
        Ok(())
    }
}

/// Draws what a run's results say of these frictions, by their ids; the energy balance is of the whole
/// model and needs none.
///
/// # Errors
/// Results without what is asked for; more frictions than a picture holds; values too large for an axis.
pub fn draw(
    run: &RunResults,
    kind: Kind,
    frictions: &[u32],
    format: Format,
) -> Result<Vec<u8>, PlotError> {
    let picture = match kind {
        Kind::Energy => Picture::Energy(run.energies()?.into()),
        _ => {
            let most = match kind {
                Kind::Regime => (HIGHEST - AROUND_ROWS) / ROW,
                _ => HIGHEST / PANEL,
            } as usize;
            let asked = frictions.len();
            if asked > most {
                return Err(PlotError::TooMany { asked, most });
            }
            let panel = |id: &u32| Ok((run.title(*id)?, run.series(*id)?));
            let panels: Result<Vec<_>, ExplainError> = frictions.iter().map(panel).collect();
            Picture::Panels(kind, panels?)
        }
    };
    picture.check()?;
    render(&picture, format)
}

impl Picture {
    /// Whether the axes can hold it.
    fn check(&self) -> Result<(), PlotError> {
        let largest = match self {
            Self::Panels(_, all) => {
                let of = |s: &FrictionSeries| {
                    let displacement = s.displacement();
                    largest([&s.time, &s.friction, &s.velocity, &displacement])
                };
                all.iter().map(|(_, series)| of(series)).fold(0.0, f64::max)
            }
            Self::Energy(e) => largest([
                &e.time,
                &e.kinetic,
                &e.weight,
                &e.stored,
                &e.forces,
                &e.motions,
                &e.dissipated,
            ]),
        };
        if largest < LARGEST {
            Ok(())
        } else {
            Err(PlotError::TooLarge(largest))
        }
    }
}

fn largest<const N: usize>(columns: [&Vec<f64>; N]) -> f64 {
    let values = columns.into_iter().flatten();
    values.fold(0.0, |largest, value| {
        if value.is_nan() {
            f64::INFINITY
        } else {
            value.abs().max(largest)
        }
    })
}
