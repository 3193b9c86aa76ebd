//! Commands and the changes that they make.

use dataset::{
    ChangeKind, CommandKind, Dataset, Effect, FrictionQuantity, Severity, SimulationKind, Source,
    Switchable, parse_change, read_commands, read_dataset,
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
        ("SFORCE/1, FUNCTION=1", "there is no SFORCE/1"),
        ("MOTION/1, FUNCTION=1", "there is no MOTION/1"),
        (
            "FRICTION/1, MU_STATIC=0",
            "MU_STATIC must be greater than 0",
        ),
        ("FRICTION/1", "FRICTION/1 gives nothing to change"),
        (
            "VARIABLE/1, FUNCTION=FRICTION(1, 7)",
            "FRICTION of an index from 7 on can be read by a REQUEST or SENSOR only",
        ),
        ("EQUILIBRIUM", "EQUILIBRIUM gives nothing to change"),
        ("EQUILIBRIUM/STABILITY=-1", "STABILITY must be 0 or greater"),
        ("DEACTIVATE/JOINT, ID=1, 2", "there is no JOINT/2"),
        ("ACTIVATE/MOTION, ID=1", "there is no MOTION/1"),
        (
            "DEACTIVATE/FRICTION, RANGE=2, 9",
            "there is no FRICTION from 2 to 9",
        ),
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
fn an_equilibrium_command_changes_what_it_gives() {
    let mut model = model();
    assert_eq!(apply(&mut model, "EQUIL/STAB=1E-3, MAXIT=50"), None);
    assert_eq!(
        apply(
            &mut model,
            "EQUILIBRIUM/ERROR=1E-6, IMBAL=1E-5, MAXIT=60, TLIM=5, ALIM=5D"
        ),
        None
    );
    let settings = model.equilibrium.unwrap();
    assert_eq!(
        (settings.stability, settings.maxit, settings.error),
        (Some(1e-3), Some(60), Some(1e-6))
    );
    assert_eq!(
        (settings.imbalance, settings.tlimit, settings.alimit),
        (Some(1e-5), Some(5.0), Some(5.0_f64.to_radians()))
    );
}

#[test]
fn elements_are_deactivated_and_activated() {
    let mut model = model();
    let active = |model: &Dataset| {
        [(Switchable::Joint, 1), (Switchable::Friction, 1)].map(|(k, id)| model.is_active(k, id))
    };
    assert_eq!(active(&model), [true, true]);
    assert_eq!(apply(&mut model, "DEACTIVATE/FRICTION, ID=1"), None);
    assert_eq!(active(&model), [true, false]);
    assert_eq!(apply(&mut model, "ACTIVATE/FRI, RANGE=1, 5"), None);
    assert_eq!(active(&model), [true, true]);
    // The friction rests with its joint, and comes back with it.
    let rests = Some("FRICTION/1 rests with its JOINT/1".to_string());
    assert_eq!(apply(&mut model, "DEACTIVATE/JOINT, RANGE=1, 1"), rests);
    assert_eq!(active(&model), [false, false]);
    let before = model.clone();
    assert_eq!(
        apply(&mut model, "ACTIVATE/FRICTION, ID=1").as_deref(),
        Some("FRICTION/1 cannot be activated: its JOINT/1 is deactivated")
    );
    assert_eq!(model, before);
    assert_eq!(apply(&mut model, "ACTIVATE/JOINT, ID=1"), None);
    assert_eq!(active(&model), [true, true]);
    // One that rests by itself is not named again, and does not come back.
    assert_eq!(apply(&mut model, "DEACTIVATE/FRICTION, ID=1"), None);
    assert_eq!(apply(&mut model, "DEACTIVATE/JOINT, ID=1, 1"), None);
    assert_eq!(apply(&mut model, "ACTIVATE/JOINT, ID=1"), None);
    assert_eq!(active(&model), [true, false]);
}

#[test]
fn a_motion_rests_with_its_joint() {
    let text = MODEL.to_string() + "MOTION/4, JOINT=1, ROTATIONAL, FUNCTION=TIME\n";
    let source = Source::from_text("model.adm", text);
    let mut model = read_dataset(&source).0;
    assert_eq!(
        apply(&mut model, "DEACTIVATE/FRICTION, ID=1").as_deref(),
        None
    );
    assert_eq!(
        apply(&mut model, "DEACTIVATE/JOINT, ID=1").as_deref(),
        Some("MOTION/4 rests with its JOINT/1")
    );
    assert!(!model.is_active(Switchable::Motion, 4));
}

#[test]
fn list_is_read_alone_and_with_other_arguments() {
    for (text, mu_static) in [
        ("friction/1, list", None),
        ("FRICTION/1, MU_STATIC=0.4, LIST", Some(0.4)),
    ] {
        let source = Source::from_text("run.acf", format!("\n{text}\n"));
        let (file, diagnostics) = read_commands(&source);
        assert!(diagnostics.is_empty(), "{diagnostics:?}");
        let CommandKind::Change(change) = &file.commands[0].kind else {
            panic!("{text}")
        };
        let ChangeKind::Friction {
            id: 1,
            arguments,
            list: true,
        } = &change.kind
        else {
            panic!("{text}: {change:?}")
        };
        assert_eq!(arguments.mu_static.map(|(value, _)| value), mu_static);
        assert!(model().apply(change).is_empty());
        assert_eq!(change.kind.is_of_model(), mu_static.is_some());
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
        CommandKind::Change(change) if change.target() == ("VARIABLE", 1)
    ));
    assert_eq!(file.commands[7].kind, CommandKind::Stop);
    assert_eq!(file.commands.len(), 8);
}

const AMENDED: &str = "Elements that commands give other arguments
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, REVOLUTE, I=20, J=1
MOTION/1, JOINT=1, ROTATIONAL, VELOCITY, ICDISP=0.5
, FUNCTION=2*TIME +
, 1
BUSHING/3, I=20, J=1, K=1, 2, 3, KT=4, 5, 6, C=0.1, 0.1, 0.1, CT=0, 0, 0
COUPLER/4, JOINTS=1, 2, TYPE=R:R, SCALES=1, -2
DIFF/5, IC=1, FUNCTION=-DIF(5)
SPLINE/6, X=0, 1, 2, 3, Y=0, 1, 4, 9
SPRINGDAMPER/7, I=20, J=1, ROTATIONAL, KT=3, CT=0, ANGLE=10D
SENSOR/8, GE, VALUE=1, ERROR=0.1, FUNCTION=TIME\\, RETURN
GCON/9, FUNCTION=DX(20, 1)
VARIABLE/10, IC=3, FUNCTION=TIME
SFORCE/11, TRANSLATIONAL, I=20, J=1, FUNCTION=TIME
MARKER/12, PART=1, FLOATING
VFORCE/13, I=20, JFLOAT=12, RM=1, FX=1, FY=2
, FZ=TIME
";

#[test]
fn statements_are_read_again_with_the_arguments_of_commands() {
    let source = Source::from_text("model.adm", AMENDED.to_string());
    let (before, diagnostics) = read_dataset(&source);
    let errors = diagnostics
        .iter()
        .filter(|d| d.severity == dataset::Severity::Error);
    assert_eq!(errors.count(), 0, "{diagnostics:?}");
    let mut model = before.clone();
    for change in [
        "BUSHING/3, KT=7, 8, 9",
        "BUSHING/3, C=1, 1, 1",
        "MOTION/1, DISPLACEMENT, FUNCTION=3*TIME",
        "COUPLER/4, SCALES=1, 5",
        "DIFF/5, FUNCTION=-2*DIF(5)",
        "SPLINE/6, Y=1, 1, 1, 1",
        "SPRINGDAMPER/7, KT=5, ANGLE=20D",
        "SENSOR/8, LE, VALUE=3",
        "GCON/9, FUNCTION=DY(20, 1)",
        "PART/2, MASS=5",
        "VARIABLE/10, FUNCTION=2*TIME",
        "SFORCE/11, FUNC=3",
        "VFORCE/13, FY=7",
        "POINT_MASS/1, MASS=5",
    ] {
        let expected = change
            .starts_with("POINT")
            .then_some("there is no POINT_MASS/1");
        assert_eq!(apply(&mut model, change).as_deref(), expected, "{change}");
    }
    let bushing = &model.bushings[0];
    assert_eq!(bushing.header, before.bushings[0].header);
    let text = model.text_of("BUSHING", 3).unwrap();
    assert!(
        text.contains("K=1, 2, 3") && text.contains("KT=7, 8, 9"),
        "{text}"
    );
    assert!(
        text.contains("C=1, 1, 1") && !text.contains("0.1"),
        "{text}"
    );
    let motion = model.text_of("MOTION", 1).unwrap();
    assert!(
        !motion.contains("ICDISP") && !motion.contains("VELOCITY"),
        "{motion}"
    );
    assert_eq!(model.motions[0].function.text, "3*TIME");
    assert_eq!(model.parts[1].mass, Some(5.0));
    assert_ne!(model.sensors, before.sensors);
    assert_ne!(model.splines, before.splines);
    let variable = &model.variables[0];
    assert_eq!(
        (variable.ic, &*variable.function.text),
        (Some(3.0), "2*TIME")
    );
    assert_eq!(model.single_forces[0].function.text, "3");
    let components = model.vector_forces[0].components.iter().flatten();
    let components: Vec<&str> = components.map(|function| &*function.text).collect();
    assert_eq!(components, ["1", "7", "TIME"]);
    assert_eq!(
        model.text_of("MARKER", 20).as_deref(),
        Some("MARKER/20, PART=2")
    );
    // What is wrong leaves everything as it is.
    for (change, expected) in [
        ("BUSHING/4, K=1, 1, 1", "there is no BUSHING/4"),
        ("MOTION/1, FUNCTION=DX(99)", "there is no MARKER/99"),
        ("PART/2, MASS=-1", "MASS must be 0 or greater"),
        ("SFORCE/11, FUNCTION=DX(20, 99)", "there is no MARKER/99"),
        ("VFORCE/13, I=1", "a command cannot change I of VFORCE/13"),
        ("BUSHING/3, J=20", "a command cannot change J of BUSHING/3"),
        (
            "MARKER/20, QP=1, 0, 0",
            "a command cannot change QP of MARKER/20",
        ),
    ] {
        let kept = model.clone();
        assert_eq!(
            apply(&mut model, change).as_deref(),
            Some(expected),
            "{change}"
        );
        assert_eq!(model, kept, "{change}");
    }
}
