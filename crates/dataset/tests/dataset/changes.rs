//! Commands and the changes that they make.

use dataset::{
    ChangeKind, CommandKind, Dataset, Effect, FrictionQuantity, Severity, SimulationKind, Source,
    parse_change, read_commands, read_dataset,
};

const MODEL: &str = "title
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND
PART/1, GROUND
MARKER/1, PART=1
PART/2
MARKER/2, PART=2
JOINT/1, REVOLUTE, I=2, J=1
FRICTION/1, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2
VARIABLE/1, FUNCTION=TIME
VARIABLE/2, FUNCTION=VARVAL(1)
INTEGRATOR/GSTIFF, ERROR=1E-4
";

fn model() -> Dataset {
    let source = Source::from_text("model.adm", MODEL.to_string());
    let (dataset, diagnostics) = read_dataset(&source);
    assert!(diagnostics.is_empty());
    dataset
}

/// Applies a change and returns the first message.
fn apply(dataset: &mut Dataset, text: &str) -> Option<String> {
    let source = Source::from_text("--set", text.to_string());
    let (change, diagnostics) = parse_change(&source);
    if let Some(diagnostic) = diagnostics.first() {
        return Some(diagnostic.message.clone());
    }
    let diagnostics = dataset.apply(&change.expect("a change without errors"));
    for diagnostic in &diagnostics {
        assert!(diagnostic.span.end <= text.len());
        assert_eq!(diagnostic.source, "--set");
    }
    diagnostics
        .first()
        .map(|diagnostic| diagnostic.message.clone())
}

#[test]
fn changes_reach_the_model() {
    let mut model = model();
    let changes = [
        "FRICTION/1, MU_STATIC=0.5, PIN_RADIUS=7, EFFECT=STICTION",
        "variable/2, func = 2*time",
        "INTEGRATOR/SI2, HMAX=0.01",
        "ACCGRAV/JGRAV=-9.81",
        "ACCGRAV/KGRAV=-1",
    ];
    for change in changes {
        assert_eq!(apply(&mut model, change), None, "{change}");
    }
    let friction = &model.frictions[0];
    assert_eq!((friction.mu_static, friction.mu_dynamic), (0.5, 0.2));
    assert_eq!(friction.value(FrictionQuantity::PinRadius), 7.0);
    assert_eq!(friction.effect, Effect::Stiction);
    assert_eq!(model.variables.by_id(2).unwrap().function.text, "2*time");
    assert_eq!(model.gravity, Some([0.0, -9.81, -1.0]));
    let integrator = model.integrator.as_ref().unwrap();
    assert_eq!(
        (integrator.error, integrator.hmax),
        (Some(1e-4), Some(0.01))
    );
    assert!(integrator.method.is_some() && integrator.formulation.is_some());
}

#[test]
fn changes_that_cannot_be_made_leave_the_model_alone() {
    let before = model();
    for (change, expected) in [
        ("FRICTION/2, MU_STATIC=0.2", "there is no FRICTION/2"),
        ("VARIABLE/3, FUNCTION=1", "there is no VARIABLE/3"),
        ("VARIABLE/1, FUNCTION=DX(9)", "there is no MARKER/9"),
        (
            "VARIABLE/1, FUNCTION=VARVAL(2)",
            "variables define each other in a circle: VARIABLE/1 -> VARIABLE/2 -> VARIABLE/1",
        ),
        ("SFORCE/1, FUNCTION=1", "there is no SFORCE/1"),
        ("MOTION/1, FUNCTION=1", "there is no MOTION/1"),
        (
            "FRICTION/1, MU_STATIC=0",
            "MU_STATIC must be greater than 0",
        ),
        ("FRICTION/1", "FRICTION/1 gives nothing to change"),
    ] {
        let mut model = before.clone();
        assert_eq!(
            apply(&mut model, change).as_deref(),
            Some(expected),
            "{change}"
        );
        assert_eq!(model, before, "{change}");
    }
}

#[test]
fn a_change_warns_of_what_the_joint_does_not_use() {
    let mut model = model();
    let message = apply(&mut model, "FRICTION/1, BALL_RADIUS=2");
    assert_eq!(
        message.as_deref(),
        Some("BALL_RADIUS of FRICTION/1 is not used by a REVOLUTE joint")
    );
}

#[test]
fn both_layouts_of_command_files_name_the_model() {
    let model = |text: &str| {
        let source = Source::from_text("run.acf", text.to_string());
        let (file, diagnostics) = read_commands(&source);
        assert!(diagnostics.is_empty(), "{text}: {diagnostics:?}");
        match file.commands.first().map(|command| command.kind.clone()) {
            Some(CommandKind::Model {
                path,
                output_prefix,
            }) => Some((path, output_prefix)),
            _ => None,
        }
    };
    let name =
        |path: &str, prefix: Option<&str>| Some((path.to_string(), prefix.map(str::to_string)));
    assert_eq!(model("\nfile/model=robot\nstop\n"), name("robot", None));
    assert_eq!(
        model("\nFILE/MODEL=C:\\models\\robot 2.adm, OUTPUT_PREFIX=out_1\n"),
        name("C:\\models\\robot 2.adm", Some("out_1"))
    );
    assert_eq!(
        model("robot\nresults\nstop\n"),
        name("robot", Some("results"))
    );
    assert_eq!(
        model("robot.adm\nsim/dyn, end=1, steps=1\n"),
        name("robot.adm", None)
    );
    assert_eq!(model("robot\n! a comment\nsim/stat\n"), name("robot", None));
    assert_eq!(model("\nstop\n"), None);
    assert_eq!(model("stop\n"), None);
    assert_eq!(model(""), None);
}

#[test]
fn simulations_are_read() {
    let text = "\nfile/model=m\nsim/init\nsim/dyn, end=1.0, dtout=.005\nSIMULATE/DYNAMICS &\n\
                , DURATION = 2 &\n, STEPS = 10 ! ten\nsim/trans, end=4, steps=5\nsim/stat\n\
                VARIABLE/1, FUNC= -step5(time,0,0,2,20*PI) &\n -STEP5(TIME,2.0,0,4,1)\nstop\n\
                this is not read\n";
    let source = Source::from_text("run.acf", text.to_string());
    let (file, diagnostics) = read_commands(&source);
    assert!(
        diagnostics
            .iter()
            .all(|found| found.severity != Severity::Error),
        "{diagnostics:?}"
    );
    let simulations: Vec<_> = file
        .commands
        .iter()
        .filter_map(|command| match &command.kind {
            CommandKind::Simulate(simulate) => Some((
                simulate.kind,
                simulate.end,
                simulate.duration,
                simulate.steps,
                simulate.dtout,
            )),
            _ => None,
        })
        .collect();
    let expected = [
        (SimulationKind::InitialConditions, None, None, None, None),
        (SimulationKind::Dynamic, Some(1.0), None, None, Some(0.005)),
        (SimulationKind::Dynamic, None, Some(2.0), Some(10), None),
        (SimulationKind::Transient, Some(4.0), None, Some(5), None),
        (SimulationKind::Static, None, None, None, None),
    ];
    assert_eq!(simulations, expected);
    let change = &file.commands[6];
    assert_eq!(
        change.echo,
        "VARIABLE/1, FUNC= -step5(time,0,0,2,20*PI) -STEP5(TIME,2.0,0,4,1)"
    );
    assert!(matches!(
        &change.kind,
        CommandKind::Change(change) if matches!(change.kind, ChangeKind::Variable { id: 1, .. })
    ));
    assert_eq!(file.commands[7].kind, CommandKind::Stop);
    assert_eq!(file.commands.len(), 8);
}
