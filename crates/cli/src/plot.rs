//! `stiction plot`.

use plots::{Along, Format, Kind, PlotError};
use stiction::explain::RunResults;

use crate::arguments::{LoopAxis, PlotArguments, PlotKind};
use crate::exit::{Exit, complain};
use crate::file::{Refusal, extension};
use crate::replace::replace;

/// Draws a picture of a run.
pub(crate) fn plot(arguments: &PlotArguments) -> Exit {
    match drawn(arguments) {
        Ok(()) => Exit::Success,
        Err(refusal) => {
            complain(&refusal.text);
            refusal.exit
        }
    }
}

fn drawn(arguments: &PlotArguments) -> Result<(), Refusal> {
    let output = &arguments.output;
    let name = output.display();
    let format = match extension(output).as_str() {
        "svg" => Format::Svg,
        "png" => Format::Png,
        _ => {
            let text = format!("{name} ends neither in .svg nor in .png, which is what is drawn");
            return Err(Refusal::usage(&text));
        }
    };
    let kind = kind(arguments)?;
    if kind == Kind::Energy && !arguments.frictions.is_empty() {
        let text = "the energy balance is of the whole model; leave out --friction";
        return Err(Refusal::usage(text));
    }
    if output.exists() && !arguments.force {
        let text = format!("{name} is there already; --force replaces it");
        return Err(Refusal::usage(&text));
    }
    let picture = picture(arguments, kind, format).map_err(|error| Refusal {
        text: format!("error: {error}\n"),
        exit: match error {
            PlotError::TooMany { .. } => Exit::Usage,
            _ => Exit::Input,
        },
    })?;
    replace(output, &picture)
        .map_err(|error| Refusal::usage(&format!("{name} cannot be written: {error}")))
}

fn kind(arguments: &PlotArguments) -> Result<Kind, Refusal> {
    let kind = match (arguments.kind, arguments.x) {
        (PlotKind::Loop, Some(LoopAxis::Displacement)) => Kind::Loop(Along::Displacement),
        (PlotKind::Loop, _) => Kind::Loop(Along::Velocity),
        (_, Some(_)) => return Err(Refusal::usage("--x is for --kind loop")),
        (PlotKind::Friction, None) => Kind::Friction,
        (PlotKind::Regime, None) => Kind::Regime,
        (PlotKind::Share, None) => Kind::Share,
        (PlotKind::Energy, None) => Kind::Energy,
    };
    Ok(kind)
}

fn picture(arguments: &PlotArguments, kind: Kind, format: Format) -> Result<Vec<u8>, PlotError> {
    let run = RunResults::open(&arguments.run)?;
    let ids = match (kind, arguments.frictions.is_empty()) {
        (Kind::Energy, _) => Vec::new(),
        (_, true) => run.frictions()?,
        (_, false) => {
            let names = arguments.frictions.iter();
            names.map(|name| run.find(name)).collect::<Result<_, _>>()?
        }
    };
    plots::draw(&run, kind, &ids, format)
}
