//! The command line.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use stiction::Method;

use crate::diagnostics::LevelArguments;

/// An open solver for friction in machine joints: reads Adams Solver datasets.
#[derive(Debug, Parser)]
#[command(name = "stiction", version, about, after_help = EXIT_CODES)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXIT_CODES: &str = "Exit codes:
  0    success
  1    fmt --check: the layout of a file would change
  2    wrong usage, or a file that cannot be written
  3    error in the input, with file, line and column, or a warning that --deny makes one
  4    the model cannot be assembled
  5    the integration failed; the results so far are kept
  130  interrupted (Ctrl-C); the results so far are kept";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Simulate a model and write its results
    Run(RunArguments),
    /// Look through a model without simulating it
    ///
    /// Reads and validates the files, assembles the model, and lists its degrees of freedom,
    /// redundant equations and the defaults in use. docs/diagnostics.md explains every message by
    /// its code.
    Check(CheckArguments),
    /// Tell where the friction in a run came from
    ///
    /// Without --friction one line for each FRICTION, the one that dissipated most first. With it
    /// what that friction did: regimes, stick intervals, largest friction, what made it, energy.
    /// With --at why it was what it was at that time: load, coefficient, and the share of preload,
    /// reaction force, bending and torsion.
    Explain(ExplainArguments),
    /// Draw what friction did in a run, as SVG or PNG
    ///
    /// Reads the .res that a run has written. Kinds: friction, each friction over time with its regimes
    /// below; regime, when frictions are stuck, in transition or sliding; loop, friction against the
    /// velocity of its surfaces or how far they have moved (--x); share, friction by its causes as
    /// stacked areas; energy, the energy balance of the model over time. docs/plots.md shows them. A
    /// file that is there is replaced only with --force.
    Plot(PlotArguments),
    /// Run a model with many values of its arguments
    ///
    /// A study file names the model, parameters with their values or ranges, how they are put
    /// together, and outputs such as the largest force or the longest stick of a friction;
    /// docs/studies.md describes it. The table, cases.parquet, has a row for each case. Cases that
    /// fail are rows with their message, and the study ends with 0 all the same.
    Sweep(SweepArguments),
    /// Lay datasets and command files out anew, without changing what they say
    ///
    /// In a dataset the head of a statement and each argument get a line of their own; a command
    /// stands on one line where 80 columns hold it. Lines within a value (the rows of a matrix)
    /// stay as they are broken; longer ones are broken so that they read the same. Words, numbers,
    /// texts, comments, what follows END, line ends and the encoding stay. A file that cannot be
    /// read is left alone; a file is replaced only when its new text says the same.
    Fmt(FmtArguments),
    /// Turn a dataset into JSON and back
    ///
    /// The JSON form has every statement with full names and typed values, in the order of the
    /// file. Numbers come back with the same bits: an angle given in degrees is {"degrees": 90}.
    /// docs/json.md describes the form, docs/model.schema.json is its JSON Schema. A file that is
    /// there is replaced only with --force.
    Convert(ConvertArguments),
}

/// Simulate a model and write its results.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:
  stiction run delta.acf
  stiction run pendulum.adm --end 2 --dtout 0.01 -o results
  stiction run delta.acf --set FRICTION/103.MU_STATIC=0.2 --force
  stiction run delta.acf --unchecked
  stiction run delta.acf --checkpoint 60
  stiction run delta.acf --checkpoint 60 --resume",
    after_long_help = EXIT_CODES
)]
pub(crate) struct RunArguments {
    /// Command file (.acf), or dataset (.adm) together with --end
    #[arg(value_name = "MODEL")]
    pub(crate) model: PathBuf,
    /// Folder for the results [default: PREFIX-run in the working directory]
    ///
    /// It will hold PREFIX.res, PREFIX.req, PREFIX.msg and run.json, PREFIX being the output
    /// prefix of the command file, else the base name of the dataset.
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// End of the one dynamic simulation of a dataset (.adm), in its unit of time
    #[arg(long, value_name = "T")]
    pub(crate) end: Option<f64>,
    /// Number of output steps of that simulation
    #[arg(long, value_name = "N", conflicts_with = "dtout", requires = "end")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) steps: Option<u32>,
    /// Time between two outputs of that simulation
    #[arg(long, value_name = "DT", requires = "end")]
    pub(crate) dtout: Option<f64>,
    /// Error tolerance instead of that of the INTEGRATOR statement
    #[arg(long, value_name = "E")]
    pub(crate) error: Option<f64>,
    /// Method of integration instead of that of the INTEGRATOR statement
    ///
    /// gstiff-si2: backward differentiation with position and velocity constraints, the one for friction
    /// and what a run takes where the model says nothing; gstiff-i3: with position constraints alone,
    /// which passes singular positions; hht, newmark: second order, with numerical damping; adams:
    /// Adams-Moulton up to order 12, about half the steps for smooth motion at tight errors, not for
    /// bristles (LUGRE) at tight errors nor for singular positions. ERROR stays as it is.
    /// docs/integrators.md tells more.
    #[arg(long, value_name = "METHOD", value_parser = method_parser())]
    pub(crate) integrator: Option<Method>,
    /// Reactions of redundant constraints, which friction follows
    ///
    /// kept: those of the equations that are kept; the ones left out have none, which is arbitrary.
    /// least-squares: the least of all that give the same motion, as of equally stiff joints.
    /// docs/reactions.md tells more.
    #[arg(long, value_enum, default_value_t = ReactionsKind::Kept)]
    pub(crate) reactions: ReactionsKind,
    /// What least squares divide torques by, in the model's unit of length [default: its own length]
    #[arg(long, value_name = "L")]
    pub(crate) reaction_length: Option<f64>,
    /// Leave out the second run that tells how accurate the run is
    ///
    /// ERROR bounds the error of each step; over a run errors add up, and some motions magnify them. So a
    /// run is carried out twice, the second time with a tenth of ERROR in a thread beside it, and the
    /// difference told; the results are the same without. A resumed run is not checked. docs/accuracy.md
    /// explains what is told, and what it costs.
    #[arg(long)]
    pub(crate) unchecked: bool,
    /// Change an argument before the run; may be repeated
    #[arg(long = "set", value_name = "FRICTION/103.MU_STATIC=0.2")]
    pub(crate) changes: Vec<String>,
    /// How progress is shown, on standard error
    ///
    /// auto: a bar on a terminal, else nothing; plain: lines of text; json: one JSON object a
    /// line; none: nothing.
    #[arg(long, value_enum, default_value_t = ProgressKind::Auto)]
    pub(crate) progress: ProgressKind,
    /// Formats of the results
    ///
    /// res: PREFIX.res and PREFIX.req; parquet, csv: tables of frictions and of states, with
    /// tables.json beside csv. Tables get their names when the run has ended.
    #[arg(
        long = "format",
        value_enum,
        value_delimiter = ',',
        default_value = "res"
    )]
    pub(crate) formats: Vec<ResultFormat>,
    /// Write into a folder that exists already; its files of the same names are replaced
    #[arg(long)]
    pub(crate) force: bool,
    /// Keep a checkpoint, from which the run can be resumed: a new one after so many seconds of wall
    /// time, and one where it is interrupted
    ///
    /// PREFIX.checkpoint in the folder of the results is always a whole one; it goes when the run
    /// has ended. 0 writes one after every step.
    #[arg(long, value_name = "SECONDS")]
    pub(crate) checkpoint: Option<f64>,
    /// Go on from the checkpoint in the folder of the results, with the same files and options
    ///
    /// The results are then, byte for byte, those of a run that was never interrupted.
    #[arg(long, conflicts_with = "force")]
    pub(crate) resume: bool,
    #[command(flatten)]
    pub(crate) levels: LevelArguments,
}

impl RunArguments {
    /// Whether a second run tells how accurate the run is; there is none of a run that is resumed.
    pub(crate) fn check_accuracy(&self) -> bool {
        !self.unchecked && !self.resume
    }
}

/// Reads a method by its name.
fn method_parser() -> impl TypedValueParser<Value = Method> {
    PossibleValuesParser::new(Method::ALL.map(Method::name)).try_map(|name| name.parse::<Method>())
}

/// Reactions of redundant constraints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ReactionsKind {
    Kept,
    LeastSquares,
}

impl ReactionsKind {
    /// As the library calls it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Kept => "kept",
            Self::LeastSquares => "least-squares",
        }
    }
}

/// A format of results.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ResultFormat {
    Res,
    Parquet,
    Csv,
}

impl ResultFormat {
    /// As a format of tables, if it is one.
    pub(crate) fn of_tables(self) -> Option<columnar::Format> {
        match self {
            Self::Res => None,
            Self::Parquet => Some(columnar::Format::Parquet),
            Self::Csv => Some(columnar::Format::Csv),
        }
    }
}

/// Look through a model without simulating it.
#[derive(Debug, Args)]
#[command(after_long_help = EXIT_CODES)]
pub(crate) struct CheckArguments {
    /// Command file (.acf) or dataset (.adm)
    #[arg(value_name = "MODEL")]
    pub(crate) model: PathBuf,
    /// Form of the answer
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,
    #[command(flatten)]
    pub(crate) levels: LevelArguments,
}

/// Tell where the friction in a run came from.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:
  stiction explain pendulum-run
  stiction explain delta-run --friction 111
  stiction explain delta-run --friction 111 --at 0.35",
    after_long_help = EXIT_CODES
)]
pub(crate) struct ExplainArguments {
    /// Folder of a run, or the .res in it
    #[arg(value_name = "RUN_DIR")]
    pub(crate) run: PathBuf,
    /// Id or name of the FRICTION, or of its joint: 103, SLIDE, JOINT/28
    #[arg(long, value_name = "ID")]
    pub(crate) friction: Option<String>,
    /// The output nearest to this time, in the unit of time of the model
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    pub(crate) at: Option<f64>,
    /// Form of the answer
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,
}

/// Draw what friction did in a run.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:
  stiction plot pendulum-run --friction 103 -o pin.svg
  stiction plot slider-run --friction GUIDE --kind loop --x displacement -o loop.png
  stiction plot delta-run --kind regime -o regimes.svg
  stiction plot delta-run --kind energy -o energy.svg",
    after_long_help = EXIT_CODES
)]
pub(crate) struct PlotArguments {
    /// Folder of a run, or the .res in it
    #[arg(value_name = "RUN_DIR")]
    pub(crate) run: PathBuf,
    /// File to write: .svg or .png
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// What to draw
    #[arg(long, value_enum, default_value_t = PlotKind::Friction)]
    pub(crate) kind: PlotKind,
    /// Id or name of the FRICTION, or of its joint: 103, SLIDE, JOINT/28; may be repeated [default: all]
    #[arg(long = "friction", value_name = "ID")]
    pub(crate) frictions: Vec<String>,
    /// What a loop is drawn against [default: velocity]
    #[arg(long, value_enum)]
    pub(crate) x: Option<LoopAxis>,
    /// Replace the file if it is there
    #[arg(long)]
    pub(crate) force: bool,
}

/// What to draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PlotKind {
    /// Each friction over time, its regimes below.
    Friction,
    /// When frictions are stuck, in transition or sliding.
    Regime,
    /// Each friction against what its surfaces do.
    Loop,
    /// Each friction by its causes, as stacked areas.
    Share,
    /// The energy balance of the model over time.
    Energy,
}

/// What a loop is drawn against.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LoopAxis {
    /// The velocity of the surfaces.
    Velocity,
    /// How far they have moved.
    Displacement,
}

/// Run a model with many values of its arguments.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:
  stiction sweep study.toml
  stiction sweep study.toml --workers 8 -o results
  stiction sweep study.toml -o results --resume
  stiction sweep study.toml --cluster tcp://10.0.0.1:8786",
    after_long_help = EXIT_CODES
)]
pub(crate) struct SweepArguments {
    /// Study file (.toml)
    #[arg(value_name = "STUDY")]
    pub(crate) study: PathBuf,
    /// Folder for the table [default: STUDY-study in the working directory]
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// Cases that run at a time [default: one for each core]
    #[arg(long, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) workers: Option<u32>,
    /// Run the cases on the Dask cluster whose scheduler has this address
    ///
    /// Needs python3 with the package stiction and its extra: pip install 'stiction[dask]'.
    #[arg(long, value_name = "ADDRESS", conflicts_with = "workers")]
    pub(crate) cluster: Option<String>,
    /// Go on with the study in the folder: what is done there is not run again
    #[arg(long)]
    pub(crate) resume: bool,
    /// How progress is shown, on standard error
    ///
    /// auto: a bar on a terminal, else nothing; plain: lines of text; json: one JSON object a
    /// line; none: nothing. A cluster has lines at a time for the bar.
    #[arg(long, value_enum, default_value_t = ProgressKind::Auto)]
    pub(crate) progress: ProgressKind,
}

/// Lay datasets and command files out anew, without changing what they say.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:
  stiction fmt delta.adm delta.acf
  stiction fmt --check *.adm
  stiction fmt --stdout delta.adm | diff delta.adm -",
    after_long_help = EXIT_CODES
)]
pub(crate) struct FmtArguments {
    /// Datasets (.adm) and command files (.acf)
    #[arg(value_name = "FILE", required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Change nothing; name the files whose layout would change
    #[arg(long)]
    pub(crate) check: bool,
    /// Write the text to standard output instead of into the file
    #[arg(long, conflicts_with = "check")]
    pub(crate) stdout: bool,
}

/// Turn a dataset into JSON and back.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:
  stiction convert delta.adm -o delta.json
  stiction convert delta.json -o delta.adm
  stiction convert delta.adm | jq '.statements[] | select(.statement == \"FRICTION\")'",
    after_long_help = EXIT_CODES
)]
pub(crate) struct ConvertArguments {
    /// Dataset (.adm) or model in JSON (.json)
    #[arg(value_name = "MODEL")]
    pub(crate) model: PathBuf,
    /// File to write (.json or .adm) [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Replace the file if it is there
    #[arg(long, requires = "output")]
    pub(crate) force: bool,
}

/// How progress is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ProgressKind {
    /// A bar on a terminal, else nothing.
    Auto,
    /// Lines of text.
    Plain,
    /// One JSON object a line.
    Json,
    /// Nothing.
    None,
}

/// Form of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// For people.
    Text,
    /// For programs.
    Json,
}
