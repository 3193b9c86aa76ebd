//! What a command file (`.acf`) asks for.

use super::{
    Activity, Effect, Equilibrium, FrictionInputs, FrictionQuantity, Integrator, OverlapDelta,
    Preferences, Request,
};
use crate::source::Span;

/// A command file, or the commands of one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CommandFile {
    /// In the order of the file.
    pub commands: Vec<Command>,
}

/// One command.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// What it does.
    pub kind: CommandKind,
    /// The command on one line, without comments, as the message file echoes it.
    pub echo: String,
    /// Its place.
    pub span: Span,
}

/// What a command does.
#[derive(Clone, Debug, PartialEq)]
pub enum CommandKind {
    /// FILE/MODEL, or the first line of an old command file.
    Model {
        /// As written; without extension `.adm` is meant.
        path: String,
        /// Prefix of the output files; default the base name of the model.
        output_prefix: Option<String>,
    },
    /// FILE/COMMAND: run another command file.
    CommandFile {
        /// As written; without extension `.acf` is meant.
        path: String,
    },
    /// SIMULATE.
    Simulate(Simulate),
    /// LINEAR/EIGENSOL.
    Eigensolution(Eigensolution),
    /// INFO: a request that is answered at once.
    Info(Box<Request>),
    /// TIME.
    Time,
    /// SAVE.
    Save(SavedIn),
    /// RELOAD.
    Reload(Reload),
    /// A statement that changes the model.
    Change(Box<Change>),
    /// STOP.
    Stop,
}

/// Where SAVE keeps a state and RELOAD finds it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum SavedIn {
    /// SYSTEM, FILE: model and state, in a file of that name.
    File(String),
    /// STATES, BUFFER: the state alone, by that name until the run ends.
    Buffer(String),
}

/// RELOAD: back to what SAVE has kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reload {
    /// Where it is.
    pub from: SavedIn,
    /// `OUTPUT_PREFIX`: what the output files that follow are called; without it the open ones are
    /// written on.
    pub output_prefix: Option<String>,
    /// TITLE of the output files that follow.
    pub title: Option<String>,
}

/// The analysis of a SIMULATE command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SimulationKind {
    /// DYNAMIC.
    Dynamic,
    /// STATIC: one equilibrium, or with an end a quasi-static sweep.
    Static,
    /// QUASISTATIC.
    QuasiStatic,
    /// KINEMATIC.
    Kinematic,
    /// TRANSIENT: kinematic without freedoms, else dynamic.
    Transient,
    /// `INITIAL_CONDITIONS`: assembly only.
    InitialConditions,
}

impl SimulationKind {
    /// The name in the command language.
    #[must_use]
    pub const fn keyword(self) -> &'static str {
        match self {
            Self::Dynamic => "DYNAMIC",
            Self::Static => "STATIC",
            Self::QuasiStatic => "QUASISTATIC",
            Self::Kinematic => "KINEMATIC",
            Self::Transient => "TRANSIENT",
            Self::InitialConditions => "INITIAL_CONDITIONS",
        }
    }
}

/// SIMULATE.
#[derive(Clone, Debug, PartialEq)]
pub struct Simulate {
    /// The analysis.
    pub kind: SimulationKind,
    /// END: absolute time of the end. Dynamic runs have either this or `duration`.
    pub end: Option<f64>,
    /// DURATION: time from the start to the end, positive.
    pub duration: Option<f64>,
    /// STEPS: number of output steps, at least one.
    pub steps: Option<u32>,
    /// DTOUT: time between outputs, positive. Never together with `steps`.
    pub dtout: Option<f64>,
}

/// LINEAR/EIGENSOL: the modes of the model linearised at the present instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Eigensolution {
    /// Whether damping counts: without NODAMPIN.
    pub damping: bool,
    /// Whether mode shapes are wanted: without NOVECTOR.
    pub vectors: bool,
    /// COORDS: numbers of the first and the last mode whose shape is to be printed in full.
    pub shapes: Option<(u32, u32)>,
    /// RM: the marker that small motions are seen from, and its place; ground without it.
    pub reference: Option<(u32, Span)>,
}

/// A change of one statement of the model; see [`Dataset::apply`](crate::Dataset::apply).
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// What changes.
    pub kind: ChangeKind,
    /// The name of the file that asks for it.
    pub source: String,
    /// The place of the request.
    pub span: Span,
}

/// What a [`Change`] changes. `None` leaves a value as it is.
#[derive(Clone, Debug, PartialEq)]
pub enum ChangeKind {
    /// A statement that is read again with other arguments.
    Amendment(Amendment),
    /// FRICTION.
    Friction {
        /// Identifier.
        id: u32,
        /// The arguments given.
        arguments: Box<FrictionArguments>,
        /// LIST: the values of all arguments, after the change, are to be printed.
        list: bool,
    },
    /// INTEGRATOR.
    Integrator(Box<Integrator>),
    /// EQUILIBRIUM.
    Equilibrium(Box<Equilibrium>),
    /// PREFERENCES.
    Preferences(Preferences),
    /// ACTIVATE or DEACTIVATE.
    Activity(Activity),
    /// ACCGRAV: components in the ground frame.
    Gravity([Option<f64>; 3]),
}

/// Other arguments for an element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Amendment {
    /// The statement.
    pub statement: &'static str,
    /// Identifier.
    pub id: u32,
    /// The arguments given.
    pub arguments: Vec<AmendedArgument>,
    /// LIST: the statement, after the change, is to be printed.
    pub list: bool,
}

/// An argument of an [`Amendment`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AmendedArgument {
    /// Its name.
    pub keyword: &'static str,
    /// The argument as it is written, name and value.
    pub text: String,
    /// Its place.
    pub span: Span,
}

/// The arguments given to a FRICTION, as a statement or as a command, with their places.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrictionArguments {
    /// `MU_STATIC`.
    pub mu_static: Option<(f64, Span)>,
    /// `MU_DYNAMIC`.
    pub mu_dynamic: Option<(f64, Span)>,
    /// EFFECT.
    pub effect: Option<(Effect, Span)>,
    /// INPUTS.
    pub inputs: Option<(FrictionInputs, Span)>,
    /// `OVERLAP_DELTA`.
    pub overlap_delta: Option<(OverlapDelta, Span)>,
    /// INACTIVE=STATIC.
    pub inactive_static: bool,
    /// The numbers that have defaults.
    pub quantities: Vec<(FrictionQuantity, f64, Span)>,
}
