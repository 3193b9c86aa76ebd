//! From text to a [`CommandFile`].

mod info;
mod linear;
mod states;

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::grammar::{Form, Grammar};
use crate::keywords::{Keyword, Kind, abbreviated, keyword};
use crate::model::{Command, CommandFile, CommandKind, Simulate, SimulationKind};
use crate::names::{self, Match, Name};
use crate::reader::{RawHead, find};
use crate::reading::{Head, Reading};
use crate::source::{Source, Span};
use crate::statements::{self, STATEMENTS};
use crate::syntax::{Item, Language, StatementTokens, SyntaxTree, TokenKind, items, join};
use crate::{activity, amendment, change};

/// Reads a command file (`.acf`).
///
/// All that is wrong is reported in one go, in the order of the file. The commands can be used
/// only if none of the diagnostics is an error. Reading ends at STOP.
///
/// ```
/// use dataset::{read_commands, CommandKind, Source};
/// let text = "\nfile/model=pendulum\nsim/dyn, end=2.0, steps=200\nstop\n";
/// let source = Source::from_text("pendulum.acf", text.to_string());
/// let (file, diagnostics) = read_commands(&source);
/// assert!(diagnostics.is_empty());
/// let CommandKind::Simulate(simulate) = &file.commands[1].kind else { panic!() };
/// assert_eq!((simulate.end, simulate.steps), (Some(2.0), Some(200)));
/// assert_eq!(file.commands[1].echo, "sim/dyn, end=2.0, steps=200");
/// ```
#[must_use]
pub fn read_commands(source: &Source) -> (CommandFile, Vec<Diagnostic>) {
    let mut diagnostics = Diagnostics::new(source);
    let tree = SyntaxTree::new(source, Language::Commands);
    let mut file = CommandFile::default();
    file.commands.extend(first_lines(source, &tree));
    if refuse_dataset(&tree, &mut diagnostics) {
        return (CommandFile::default(), diagnostics.finish());
    }
    let mut buffer = Vec::new();
    for statement in &tree.statements {
        let Some(command) = read_command(&tree, statement, &mut buffer, &mut diagnostics) else {
            continue;
        };
        let stops = command.kind == CommandKind::Stop;
        file.commands.push(command);
        if stops {
            break;
        }
    }
    (file, diagnostics.finish())
}

/// Reports a file that begins as datasets do, with UNITS or the ground part before any command;
/// returns whether it does.
fn refuse_dataset(tree: &SyntaxTree, diagnostics: &mut Diagnostics) -> bool {
    let source = diagnostics.source;
    let word = |token: usize| source.slice(tree.tokens[token].span());
    let begins = |statement: &&StatementTokens| grammar(word(statement.tokens.start)).is_none();
    let of_dataset = |statement: &&StatementTokens| {
        let is = |token: usize, name: &str| word(token).eq_ignore_ascii_case(name);
        let mut tokens = statement.tokens.clone();
        is(tokens.start, "UNITS") || tokens.any(|token| is(token, "GROUND"))
    };
    let mut beginning = tree.statements.iter().take_while(begins);
    let Some(found) = beginning.find(of_dataset) else {
        return false;
    };
    let span = tree.tokens[found.tokens.start].span();
    let message = format!(
        "{} is a statement of a dataset, and this is a command file",
        source.excerpt(span)
    );
    diagnostics
        .error(Code::WrongFileType, span, message)
        .help("a dataset has the extension .adm");
    true
}

/// Reads one command; `None` after a report, or where it has no effect.
pub(crate) fn read_command(
    tree: &SyntaxTree,
    statement: &StatementTokens,
    buffer: &mut Vec<Item>,
    diagnostics: &mut Diagnostics,
) -> Option<Command> {
    items(&tree.tokens, statement, buffer);
    let raw = RawHead::read(buffer, diagnostics)?;
    let only_statements = || {
        let names = STATEMENTS.iter().map(|rule| rule.name);
        names.filter(|name| COMMANDS.iter().all(|rule| rule.name.full != name.full))
    };
    let names = COMMANDS.iter().map(|rule| rule.name);
    let names = names.chain(only_statements());
    let index = find(raw.name, names, unknown, diagnostics)?;
    let (source, span) = (diagnostics.source, tree.span(statement));
    let head = |name, identified, diagnostics: &mut Diagnostics| Head {
        name,
        span,
        head: raw.head,
        id: raw.id(name, identified, diagnostics),
        view_name: None,
    };
    let command = |kind| Command {
        kind,
        echo: join(source, buffer.iter()),
        span,
    };
    let Some(rule) = COMMANDS.get(index) else {
        let name = only_statements().nth(index - COMMANDS.len())?.full;
        let rule = STATEMENTS.iter().find(|rule| rule.name.full == name)?;
        let keywords = match rule.action {
            statements::Action::Read(Some(keywords), _) if rule.identified => keywords,
            _ => {
                let message = format!("stiction cannot change {name} by a command");
                diagnostics
                    .error(Code::UnsupportedStatement, raw.head, message)
                    .help("change it in the dataset");
                return None;
            }
        };
        let head = head(name, true, diagnostics);
        let keywords = &amendment::with_list(keywords);
        let mut reading = Reading::new(head, &buffer[raw.rest..], Some(keywords), diagnostics);
        return amendment::amend(&mut reading, keywords).map(command);
    };
    let name = rule.name.full;
    let (identified, keywords, read) = match rule.action {
        Action::Read(identified, keywords, read) => (identified, keywords, read),
        Action::Ignored(reason) => {
            let message = format!("{name} has no effect: {reason}");
            diagnostics.note(Code::Ignored, raw.head, message);
            return None;
        }
        Action::Unsupported => {
            let message = format!("stiction does not carry out {name}");
            diagnostics.error(Code::UnsupportedStatement, raw.head, message);
            return None;
        }
    };
    let head = head(name, identified, diagnostics);
    let mut reading = Reading::new(head, &buffer[raw.rest..], Some(keywords), diagnostics);
    read(&mut reading).map(command)
}

/// Reports a name that no command has.
fn unknown(name: Span, near: Option<&'static str>, diagnostics: &mut Diagnostics) {
    let message = format!("no command is called {}", diagnostics.source.excerpt(name));
    diagnostics
        .error(Code::UnknownStatement, name, message)
        .meant(near);
}

/// The command that `word` names, with the form of its arguments.
pub(crate) fn grammar(word: &str) -> Option<Grammar> {
    let Match::One(index) = names::find(word, COMMANDS.iter().map(|rule| rule.name)) else {
        return None;
    };
    let rule = &COMMANDS[index];
    let (identified, form) = match rule.action {
        Action::Read(identified, keywords, _) => (Some(identified), Form::Table(keywords)),
        Action::Ignored(_) | Action::Unsupported => (None, Form::Unknown),
    };
    Some(Grammar {
        name: rule.name.full,
        identified,
        form,
    })
}

/// The model and the output prefix on the first lines of an old command file.
fn first_lines(source: &Source, tree: &SyntaxTree) -> Option<Command> {
    let mut lines = tree
        .tokens
        .iter()
        .take(3)
        .filter(|token| token.kind == TokenKind::Line)
        .map(|token| token.span());
    let span = lines.next()?;
    let prefix = lines.next();
    let text = |span| source.slice(span).trim_ascii().to_string();
    Some(Command {
        kind: CommandKind::Model {
            path: text(span),
            output_prefix: prefix.map(text),
        },
        echo: text(span),
        span: prefix.map_or(span, |prefix| span.to(prefix)),
    })
}

#[derive(Clone, Copy)]
enum Action {
    /// Whether it has an identifier, its arguments, and their reader.
    Read(
        bool,
        &'static [Keyword],
        fn(&mut Reading) -> Option<CommandKind>,
    ),
    /// A warning with the reason.
    Ignored(&'static str),
    /// It is refused.
    Unsupported,
}

struct Rule {
    name: Name,
    action: Action,
}

const fn read(
    full: &'static str,
    least: &'static str,
    identified: bool,
    keywords: &'static [Keyword],
    read: fn(&mut Reading) -> Option<CommandKind>,
) -> Rule {
    Rule {
        name: Name { full, least },
        action: Action::Read(identified, keywords, read),
    }
}

const fn ignored(full: &'static str, reason: &'static str) -> Rule {
    Rule {
        name: Name { full, least: full },
        action: Action::Ignored(reason),
    }
}

const fn unsupported(full: &'static str) -> Rule {
    Rule {
        name: Name { full, least: full },
        action: Action::Unsupported,
    }
}

const DRAWS: &str = "stiction draws no pictures while it runs";
const INTEGRATOR: &str = "write its arguments in INTEGRATOR";
const ASKS: &str = "it asks a question of an interactive program";
const REPORTS: &str = "what is reported is set by the dataset";
const SOLVERS: &str = "stiction has one way to solve initial conditions and kinematics";

const COMMANDS: &[Rule] = &[
    read("FILE", "FILE", false, FILE_KEYWORDS, file),
    read("SIMULATE", "SIM", false, SIMULATE_KEYWORDS, simulate),
    read("LINEAR", "LIN", false, linear::KEYWORDS, linear::linear),
    read("SAVE", "SAVE", false, states::SAVE_KEYWORDS, states::save),
    read(
        "RELOAD",
        "REL",
        false,
        states::RELOAD_KEYWORDS,
        states::reload,
    ),
    read("INFO", "INF", false, info::KEYWORDS, info::info),
    read("TIME", "TI", false, &[], |_| Some(CommandKind::Time)),
    read("STOP", "STOP", false, &[], |_| Some(CommandKind::Stop)),
    read(
        "FRICTION",
        "FRI",
        true,
        &change::FRICTION_KEYWORDS,
        change::friction,
    ),
    read(
        "INTEGRATOR",
        "INT",
        false,
        change::INTEGRATOR_KEYWORDS,
        change::integrator,
    ),
    read(
        "PREFERENCES",
        "PREF",
        false,
        change::PREFERENCES_KEYWORDS,
        change::preferences,
    ),
    read(
        "ACCGRAV",
        "ACC",
        false,
        change::GRAVITY_KEYWORDS,
        change::gravity,
    ),
    read(
        "EQUILIBRIUM",
        "EQU",
        false,
        change::EQUILIBRIUM_KEYWORDS,
        change::equilibrium,
    ),
    read(
        "ACTIVATE",
        "ACT",
        false,
        activity::KEYWORDS,
        activity::activate,
    ),
    read(
        "DEACTIVATE",
        "DEA",
        false,
        activity::KEYWORDS,
        activity::deactivate,
    ),
    ignored("DEBUG", "it asks for diagnostics of another program"),
    ignored("ENVIRONMENT", "stiction reads no environment variables"),
    ignored("GSTIFF", INTEGRATOR),
    ignored("HELP", ASKS),
    ignored("HOTLINE", ASKS),
    ignored("IC", SOLVERS),
    ignored("KINEMATICS", SOLVERS),
    ignored("LSOLVER", "stiction has one linear solver"),
    ignored("MENU", ASKS),
    ignored("OUTPUT", REPORTS),
    ignored("REQUEST", REPORTS),
    ignored("RESULTS", REPORTS),
    ignored("SHOW", ASKS),
    ignored("WSTIFF", INTEGRATOR),
    // What the old Fortran solver drew with (Adams Solver C++, frequent questions).
    ignored("ACENTER", DRAWS),
    ignored("AINIT", DRAWS),
    ignored("AUTOSCALE", DRAWS),
    ignored("BACKUP", DRAWS),
    ignored("CENTER", DRAWS),
    ignored("CLEAR", DRAWS),
    ignored("DISPLAY", DRAWS),
    ignored("DRAW", DRAWS),
    ignored("DT", DRAWS),
    ignored("ERASE", DRAWS),
    ignored("EXECUTION", DRAWS),
    ignored("PLOT", DRAWS),
    ignored("RETURN", DRAWS),
    ignored("SET", DRAWS),
    unsupported("CONTROL"),
];

const FILE_KEYWORDS: &[Keyword] = &[
    keyword("MODEL", Kind::Text),
    keyword("COMMAND", Kind::Text),
    keyword("OUTPUT_PREFIX", Kind::Text),
];

fn file(reading: &mut Reading) -> Option<CommandKind> {
    reading.exclude("COMMAND", &["MODEL", "OUTPUT_PREFIX"]);
    let path = |reading: &mut Reading, keyword| {
        let path = reading.text(keyword)?;
        if path.is_empty() {
            let span = reading.place(keyword);
            let message = format!("{keyword} names no file");
            reading.diagnostics.error(Code::InvalidValue, span, message);
            return None;
        }
        Some(path)
    };
    if reading.has("COMMAND") {
        return path(reading, "COMMAND").map(|path| CommandKind::CommandFile { path });
    }
    reading.require("MODEL");
    let output_prefix = path(reading, "OUTPUT_PREFIX");
    path(reading, "MODEL").map(|path| CommandKind::Model {
        path,
        output_prefix,
    })
}

const SETTLE: &str = "what it does is not documented; use STATIC, or DYNAMIC with damping";
/// Levels of an analysis of initial conditions.
const LEVELS: [&str; 3] = ["DISPLACEMENT", "VELOCITY", "ACCELERATION"];

const SIMULATE_KEYWORDS: &[Keyword] = &[
    abbreviated("DYNAMICS", "DY", Kind::Flag),
    abbreviated("INITIAL_CONDITIONS", "I", Kind::Flag),
    abbreviated("KINEMATICS", "K", Kind::Flag),
    abbreviated("QUASISTATICS", "Q", Kind::Flag),
    keyword("SETTLE", Kind::Unsupported(SETTLE)),
    abbreviated("STATICS", "STA", Kind::Flag),
    abbreviated("TRANSIENT", "T", Kind::Flag),
    abbreviated("END", "E", Kind::Real),
    abbreviated("DURATION", "DU", Kind::Real),
    abbreviated("STEPS", "STE", Kind::Integer),
    abbreviated("DTOUT", "DT", Kind::Real),
    abbreviated("DISPLACEMENT", "DI", Kind::Flag),
    abbreviated("VELOCITY", "V", Kind::Flag),
    abbreviated("ACCELERATION", "A", Kind::Flag),
];

fn simulate(reading: &mut Reading) -> Option<CommandKind> {
    let kinds = [
        ("DYNAMICS", SimulationKind::Dynamic),
        ("INITIAL_CONDITIONS", SimulationKind::InitialConditions),
        ("KINEMATICS", SimulationKind::Kinematic),
        ("QUASISTATICS", SimulationKind::QuasiStatic),
        ("STATICS", SimulationKind::Static),
        ("TRANSIENT", SimulationKind::Transient),
    ];
    if reading.has("SETTLE") {
        // This has been reported.
        return None;
    }
    let kind = reading.required_flag("an analysis", &kinds)?;
    for level in LEVELS {
        if !reading.has(level) {
            continue;
        }
        let span = reading.place(level);
        if kind == SimulationKind::InitialConditions {
            let message = "positions, velocities and accelerations are solved together";
            reading.diagnostics.warning(Code::Ignored, span, message);
        } else {
            let message = format!("{level} is for SIMULATE/INITIAL_CONDITIONS");
            reading
                .diagnostics
                .error(Code::ConflictingArguments, span, message);
        }
    }
    reading.exclude("END", &["DURATION"]);
    reading.exclude("STEPS", &["DTOUT"]);
    let needs_end = matches!(
        kind,
        SimulationKind::Dynamic
            | SimulationKind::Kinematic
            | SimulationKind::QuasiStatic
            | SimulationKind::Transient
    );
    if needs_end && !reading.has("END") && !reading.has("DURATION") {
        let message = format!("SIMULATE/{} needs END or DURATION", kind.keyword());
        let span = reading.head;
        reading
            .diagnostics
            .error(Code::MissingArgument, span, message);
    }
    Some(CommandKind::Simulate(Simulate {
        kind,
        end: reading.real("END"),
        duration: reading.positive("DURATION"),
        steps: reading.count("STEPS"),
        dtout: reading.positive("DTOUT"),
    }))
}
