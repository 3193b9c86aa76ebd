//! Datasets in the manner of different writers: no word of them is unknown, and what is not
//! simulated is refused by its name.

mod others;
mod view;

use dataset::{
    Code, Dataset, Diagnostic, Expr, Function, RequestKind, Severity, Source, read_commands,
    read_dataset,
};

/// A piece of a dataset.
struct Snippet {
    /// The writer.
    writer: &'static str,
    /// Statements on the ground with MARKER/1 to 4 and PART/2 with MARKER/20 to 23.
    text: &'static str,
    /// The only words whose refusal is allowed.
    refused: &'static [&'static str],
    check: fn(&Dataset),
}

const BASE: &str = "
PART/1, GROUND
MARKER/1, PART = 1
MARKER/2, PART = 1, QP = 1, 0, 0
MARKER/3, PART = 1, FLOATING
MARKER/4, PART = 1
PART/2, MASS = 1, CM = 20, IP = 1, 1, 1
MARKER/20, PART = 2
MARKER/21, PART = 2, QP = 0, 1, 0
MARKER/22, PART = 2
MARKER/23, PART = 2
";

const fn read(writer: &'static str, text: &'static str, check: fn(&Dataset)) -> Snippet {
    Snippet {
        writer,
        text,
        refused: &[],
        check,
    }
}

const fn refused(
    writer: &'static str,
    refused: &'static [&'static str],
    text: &'static str,
) -> Snippet {
    Snippet {
        writer,
        text,
        refused,
        check: |_| {},
    }
}

fn calls(expression: &Expr, expected: Function) -> bool {
    matches!(expression, Expr::Call { function, .. } if *function == expected)
}

fn components(model: &Dataset, request: u32) -> Vec<Option<String>> {
    let request = model.requests.by_id(request).expect("the request");
    let RequestKind::Functions(functions) = &request.kind else {
        panic!("not a request of functions");
    };
    let texts = functions.iter().map(|function| function.as_ref());
    texts
        .map(|function| function.map(|function| function.text.clone()))
        .collect()
}

/// The errors among `diagnostics` but the refusals of these words.
fn wrong(writer: &str, source: &Source, diagnostics: &[Diagnostic], refused: &[&str]) -> String {
    let is_wrong = |found: &&Diagnostic| {
        let unsupported = matches!(
            found.code,
            Code::UnsupportedArgument | Code::UnsupportedFunction | Code::UnsupportedStatement
        );
        let named = refused.iter().any(|word| found.message.contains(word));
        found.severity == Severity::Error && !(unsupported && named)
    };
    let errors = diagnostics.iter().filter(is_wrong);
    errors
        .map(|found| format!("{writer}:\n{}", found.render(source)))
        .collect()
}

#[test]
fn no_word_of_a_writer_is_unknown() {
    let mut all = String::new();
    for snippet in view::SNIPPETS.iter().chain(others::SNIPPETS) {
        let text = format!("{}{BASE}{}", snippet.writer, snippet.text);
        let source = Source::from_text("writer.adm", text);
        let (model, diagnostics) = read_dataset(&source);
        let wrong = wrong(snippet.writer, &source, &diagnostics, snippet.refused);
        if wrong.is_empty() {
            (snippet.check)(&model);
        }
        all += &wrong;
    }
    assert!(all.is_empty(), "{all}");
}

/// Command files: the writer, the words whose refusal is allowed, and the text.
const COMMANDS: &[(&str, &[&str], &str)] = &[
    (
        "View",
        &["SAVE", "RELOAD"],
        "
file/model=model_1
preferences/simfail=nostopcf
preferences/contact_geometry_library=parasolids, contact_faceting_tolerance=300.0
output/noseparator
integrator/hht, error=1.0E-05, alpha=-0.3
equilibrium/maxit=100, stability=0.5
ic/error=1e-8
debug/eprint
lsolver/umf
simulate/initial_conditions
simulate/static
simulate/dynamic, end=5.0, steps=500
linear/eigensol, novector
save/system, file=state_1
reload/system, file=state_1
time
environment/name=X, value=\"1\"
stop
",
    ),
    (
        "View, linear models",
        &[
            "STATEMAT", "FILE", "PINPUT", "POUTPUT", "PSTATE", "FORMAT", "MKB", "EXPORT", "TYPE",
        ],
        "
file/model=model_1
simulate/static
linear/statemat, file=lin, pinput=1, poutput=1, format=matlab, pstate=1
linear/mkb, file=a
linear/export, type=nastran, file=b
",
    ),
    (
        "Car",
        &["CONTROL", "CLEARANCE", "ADAMS_BUSHING"],
        "
! front suspension
file/model=susp_par
output/nosep
control/ routine=abgSDI::EventInit, function=user(3,14,1,0)
deactivate/sensor, id=5
activate/sensor, range=5,9
activate/clearance, id=1
deactivate/adams_bushing, id=1
simulate/statics, end=10, dtout=0.1
sim/quasi, dur=1, st=10
sim/trans, dur=1, &
 dtout=0.01
stop
",
    ),
    (
        "by hand",
        &[],
        "pendulum
pendulum_out
OUTPUT/REQSAVE
SIM/KIN, END=1., ST=100
SIM/DYN,END=2,DTOUT=.01
ACCG/KG=0
WSTIFF/ERROR=1E-4
HELP
MENU
HOTLINE
DISPLAY/VIEW=1
RETURN
",
    ),
];

#[test]
fn no_command_of_a_writer_is_unknown() {
    let mut all = String::new();
    for (writer, refused, text) in COMMANDS {
        let source = Source::from_text("writer.acf", (*text).to_string());
        let (commands, diagnostics) = read_commands(&source);
        all += &wrong(writer, &source, &diagnostics, refused);
        assert!(commands.commands.len() > 1, "{writer}");
    }
    assert!(all.is_empty(), "{all}");
}
