//! The fixed set of cases.

mod chains;
mod linkages;
mod robots;
mod stick_slip;

use std::path::Path;

use mechanics::Simulation;
use mechanics::model::Model;
use serde_json::Value;

use super::case::{Case, Reference};

/// A case by name, made when it is asked for.
pub(crate) struct Entry {
    /// Name on the command line.
    pub(crate) name: &'static str,
    /// Makes it; `root` is the folder of the project.
    pub(crate) make: fn(root: &Path) -> Result<Case, String>,
}

/// All cases in the order of the page.
pub(crate) const ALL: [Entry; 12] = [
    entry("andrews", linkages::andrews),
    entry("four-bar-2", linkages::four_bar_2),
    entry("four-bar-40", linkages::four_bar_40),
    entry("chain-10", chains::chain_10),
    entry("chain-100", chains::chain_100),
    entry("chain-1000", chains::chain_1000),
    entry("lugre-pendulum", stick_slip::lugre_pendulum),
    entry("stick-slip", stick_slip::stick_slip),
    entry("delta", robots::delta),
    entry("slider-crank", linkages::slider_crank),
    entry("bricard", linkages::bricard),
    entry("governor", linkages::governor),
];

const fn entry(name: &'static str, make: fn(&Path) -> Result<Case, String>) -> Entry {
    Entry { name, make }
}

/// A model, assembled.
fn assembled(model: Model) -> Result<Simulation, String> {
    let mut simulation = Simulation::new(model, 1.0);
    simulation.assemble().map_err(|error| error.to_string())?;
    Ok(simulation)
}

/// Numbers of a JSON file of the reference data, where there is one; else our own run.
fn reference(file: &str, pointers: &[&str], source: &'static str, own: f64) -> Reference {
    match known(file, pointers) {
        Some(values) => Reference::Known { values, source },
        None => Reference::Own(own),
    }
}

/// The numbers at these places of a JSON file, each a number or a list of them.
fn known(file: &str, pointers: &[&str]) -> Option<Vec<f64>> {
    let text = std::fs::read_to_string(reference_data::path(file)?).ok()?;
    let value: Value = serde_json::from_str(&text).ok()?;
    let mut numbers = Vec::new();
    for pointer in pointers {
        match value.pointer(pointer)? {
            Value::Array(list) => {
                for number in list {
                    numbers.push(number.as_f64()?);
                }
            }
            number => numbers.push(number.as_f64()?),
        }
    }
    Some(numbers)
}
