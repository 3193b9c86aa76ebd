//! `stiction explain`.

use serde_json::{Map, Value, json};
use stiction::explain::{
    CAUSES, ExplainError, FrictionHistory, FrictionMoment, REGIMES, RunResults, Units, overview,
};

use crate::arguments::{ExplainArguments, Format};
use crate::exit::{Exit, complain, say};

/// Reads the results and tells where friction came from.
pub(crate) fn explain(arguments: &ExplainArguments) -> Exit {
    match answer(arguments) {
        Ok(text) => {
            say(&text);
            Exit::Success
        }
        Err(error) => {
            complain(&format!("error: {error}\n"));
            Exit::Input
        }
    }
}

fn answer(arguments: &ExplainArguments) -> Result<String, ExplainError> {
    let run = RunResults::open(&arguments.run)?;
    let text = arguments.format == Format::Text;
    let written = |value: &Value| format!("{value:#}\n");
    let ids = match &arguments.friction {
        Some(name) => vec![run.find(name)?],
        None => run.frictions()?,
    };
    if let Some(time) = arguments.at {
        let moments = ids.iter().map(|id| run.at(*id, time));
        let moments = moments.collect::<Result<Vec<_>, _>>()?;
        if text {
            let texts: Vec<String> = moments.iter().map(ToString::to_string).collect();
            return Ok(texts.join("\n"));
        }
        let values = moments.iter().map(moment_json).collect();
        return Ok(written(&one_or_all(arguments, values)));
    }
    let histories = ids.iter().map(|id| run.history(*id));
    let histories = histories.collect::<Result<Vec<_>, _>>()?;
    Ok(match (text, &arguments.friction) {
        (true, Some(_)) => histories.iter().map(ToString::to_string).collect(),
        (true, None) => overview(&histories),
        (false, _) => {
            let values = histories.iter().map(history_json).collect();
            written(&one_or_all(arguments, values))
        }
    })
}

/// The value of the one friction asked for, or the list of all.
fn one_or_all(arguments: &ExplainArguments, mut values: Vec<Value>) -> Value {
    match &arguments.friction {
        Some(_) => values.remove(0),
        None => Value::Array(values),
    }
}

fn by_name(names: &[&str], values: &[f64]) -> Value {
    let pairs = names.iter().zip(values);
    pairs
        .map(|(name, value)| ((*name).to_owned(), json!(value)))
        .collect::<Map<_, _>>()
        .into()
}

fn components(values: &[(String, f64)]) -> Value {
    let pairs = values.iter();
    pairs
        .map(|(name, value)| (name.clone(), json!(value)))
        .collect::<Map<_, _>>()
        .into()
}

fn units(units: &Units) -> Value {
    json!({
        "time": units.time,
        "force": units.force,
        "torque": units.torque,
        "load": units.load,
        "length": units.length,
        "velocity": units.velocity,
        "energy": units.energy,
        "power": units.power,
    })
}

fn history_json(history: &FrictionHistory) -> Value {
    let sticks = history.sticks.iter().map(|stick| {
        json!({
            "start": stick.start,
            "end": stick.end,
            "stuck": stick.stuck,
            "sticks": stick.sticks,
        })
    });
    json!({
        "id": history.id,
        "name": history.name,
        "units": units(&history.units),
        "start": history.span[0],
        "end": history.span[1],
        "outputs": history.outputs,
        "regimes": by_name(&REGIMES, &history.regimes),
        "stick_count": history.stick_count,
        "stuck_time": history.stuck_time,
        "sticks": sticks.collect::<Vec<_>>(),
        "peak": {
            "value": history.peak.value,
            "time": history.peak.time,
            "shares": by_name(&CAUSES, &history.peak.shares),
        },
        "mean_shares": by_name(&CAUSES, &history.mean_shares),
        "largest_creep": history.largest_creep,
        "limited": history.limited.map(|limited| json!({
            "first": limited.first,
            "last": limited.last,
            "outputs": limited.outputs,
        })),
        "work": history.work,
        "stored": history.stored,
        "dissipated": history.dissipated,
        "drift": history.drift.as_deref().map(components),
    })
}

fn moment_json(moment: &FrictionMoment) -> Value {
    json!({
        "id": moment.id,
        "name": moment.name,
        "units": units(&moment.units),
        "time": moment.time,
        "force": moment.force,
        "torque": moment.torque,
        "regime": REGIMES[moment.regime],
        "stick": moment.stick.map(|(goes_on, start)| json!({ "goes_on": goes_on, "start": start })),
        "load": moment.load,
        "load_parts": by_name(&CAUSES, &moment.load_parts),
        "causes": by_name(&CAUSES, &moment.causes),
        "shares": by_name(&CAUSES, &moment.shares),
        "mu": { "sliding": moment.mu[0], "turning": moment.mu[1] },
        "mu1": moment.mu1,
        "beta": moment.beta,
        "velocity": { "sliding": moment.velocity[0], "turning": moment.velocity[1] },
        "creep": { "sliding": moment.creep[0], "turning": moment.creep[1] },
        "bristles": moment.bristles.as_deref().map(components),
        "limited": moment.limited,
        "power": moment.power,
        "work": moment.work,
        "stored": moment.stored,
        "dissipated": moment.dissipated,
    })
}
