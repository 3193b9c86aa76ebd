//! Benchmarks as a product.

mod case;
mod cases;
mod clock;
mod document;
mod friction_cost;
pub(crate) mod growth;
pub(crate) mod integrators;
mod matched;
mod peers;
mod picture;
mod programs;
mod tables;
mod work_precision;

use std::path::{Path, PathBuf};

use peers::Environment;
use work_precision::Measured;

/// What to measure.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Cases by name; without any, all are measured and docs/performance.md is written.
    cases: Vec<String>,
    /// Leave the peers out.
    #[arg(long)]
    no_peers: bool,
    /// Loose tolerances and one run each: shows that the command works.
    #[arg(long)]
    quick: bool,
    /// Folder for the page and its pictures; docs where all cases are measured in full.
    #[arg(short, long)]
    output: Option<PathBuf>,
}

/// Measures and prints the tables.
pub(crate) fn run(arguments: &Arguments) -> Result<(), String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let known: Vec<&str> = cases::ALL.iter().map(|entry| entry.name).collect();
    if let Some(name) = arguments
        .cases
        .iter()
        .find(|name| !known.contains(&name.as_str()))
    {
        return Err(format!("no case {name}; there are {}", known.join(", ")));
    }
    let environment = if arguments.no_peers {
        None
    } else {
        let environment = Environment::prepare(&root, &target_folder()?.join("peers"));
        environment
            .map_err(|error| println!("without peers: {error}"))
            .ok()
    };
    if let Some(environment) = &environment {
        println!("{}\n", environment.versions);
    }
    let mut all = Vec::new();
    for entry in &cases::ALL {
        if !arguments.cases.is_empty() && !arguments.cases.iter().any(|name| name == entry.name) {
            continue;
        }
        let measured = measure(entry, &root, environment.as_ref(), arguments.quick)?;
        println!("{}", tables::section(&measured, ""));
        all.push(measured);
    }
    let mut others = String::new();
    if arguments.cases.is_empty() {
        others += &programs::section(&root, arguments.quick)?;
        others += &friction_cost::section(&root, arguments.quick)?;
        others += &growth::section(arguments.quick)?;
        println!("{others}");
    }
    let complete = arguments.cases.is_empty() && !arguments.quick;
    let output = arguments.output.clone();
    if let Some(folder) = output.or(complete.then(|| root.join("docs"))) {
        let versions = environment.as_ref().map(|e| e.versions.as_str());
        write(&folder, &document::page(&all, &others, versions), &all)?;
    }
    Ok(())
}

/// Writes the page and its pictures.
fn write(folder: &Path, page: &str, all: &[Measured]) -> Result<(), String> {
    let pictures = folder.join("pictures");
    std::fs::create_dir_all(&pictures)
        .map_err(|error| format!("{}: {error}", pictures.display()))?;
    for measured in all {
        picture::draw(measured, &folder.join(picture::file(measured.case.name)))?;
    }
    let path = folder.join("performance.md");
    std::fs::write(&path, page).map_err(|error| format!("{}: {error}", path.display()))
}

fn measure(
    entry: &cases::Entry,
    root: &Path,
    environment: Option<&Environment>,
    quick: bool,
) -> Result<Measured, String> {
    let case = (entry.make)(root);
    case.and_then(|case| work_precision::measure(case, environment, quick))
        .map_err(|message| format!("{}: {message}", entry.name))
}

/// The folder that cargo builds in.
fn target_folder() -> Result<PathBuf, String> {
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    let folder = program.ancestors().nth(2);
    Ok(folder
        .ok_or("the program is in no target folder")?
        .to_path_buf())
}
