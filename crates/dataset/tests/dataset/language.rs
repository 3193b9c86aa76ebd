//! The rules of the language, one table each.

use dataset::{
    BinaryOperator, Dataset, Diagnostic, Effect, Expr, ForceUnit, FrictionInputs, FrictionQuantity,
    JointKind, Language, LengthUnit, MassUnit, MotionTarget, Orientation, RequestKind, Source,
    SyntaxTree, TimeUnit, TokenKind, Units, read_dataset,
};
use std::f64::consts::{FRAC_PI_2, PI};

/// A dataset of these statements behind a title and a ground with MARKER/1 to 3, where PART/2
/// carries MARKER/21 and 22.
fn dataset(statements: &str) -> (Dataset, Vec<Diagnostic>, Source) {
    let text = format!(
        "title\nUNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND\n\
         PART/1, GROUND\nMARKER/1, PART=1\nMARKER/2, PART=1\nMARKER/3, PART=1\n\
         PART/2\nMARKER/21, PART=2\nMARKER/22, PART=2\n{statements}"
    );
    let source = Source::from_text("test.adm", text);
    let (dataset, diagnostics) = read_dataset(&source);
    (dataset, diagnostics, source)
}

/// The same, where nothing may be wrong.
fn correct(statements: &str) -> Dataset {
    let (dataset, diagnostics, source) = dataset(statements);
    let rendered: String = diagnostics
        .iter()
        .map(|found| found.render(&source))
        .collect();
    assert!(rendered.is_empty(), "{statements}\n{rendered}");
    dataset
}

/// An expression with all its brackets.
fn print(expression: &Expr) -> String {
    match expression {
        Expr::Number(value) => value.to_string(),
        Expr::Time => "t".to_string(),
        Expr::Mode => "mode".to_string(),
        Expr::Negate(operand) => format!("(-{})", print(operand)),
        Expr::Binary {
            operator,
            left,
            right,
        } => {
            let sign = match operator {
                BinaryOperator::Add => "+",
                BinaryOperator::Subtract => "-",
                BinaryOperator::Multiply => "*",
                BinaryOperator::Divide => "/",
                BinaryOperator::Power => "**",
                BinaryOperator::Cross => "%",
            };
            format!("({}{sign}{})", print(left), print(right))
        }
        Expr::Vector(components) => {
            let components: Vec<String> = components.iter().map(print).collect();
            format!("[{}]", components.join(","))
        }
        Expr::Call {
            function,
            arguments,
            ..
        } => {
            let arguments: Vec<String> = arguments.iter().map(print).collect();
            format!("{}({})", function.name(), arguments.join(","))
        }
    }
}

#[test]
fn expressions_have_the_precedence_of_fortran() {
    let table = [
        ("1 + 2*3 - 4", "((1+(2*3))-4)"),
        ("8/4/2", "((8/4)/2)"),
        ("2**3**2", "(2**(3**2))"),
        ("-2**2", "(-(2**2))"),
        ("-2*3", "((-2)*3)"),
        ("2**-1", "(2**(-1))"),
        ("2*-3", "(2*(-3))"),
        ("- - 1", "(-(-1))"),
        ("+1", "1"),
        ("(1+2)*3", "((1+2)*3)"),
        (".5 + 1. + 1E3 + 1.5e-3", "(((0.5+1)+1000)+0.0015)"),
        ("time*2", "(t*2)"),
        (
            "DXYZ(1)%[1,2*time, 3]*-UVX(2) + 2",
            "(((DXYZ(1)%[1,(2*t),3])*(-UVX(2)))+2)",
        ),
        ("IF(MODE-5: 1, 0, 2)", "IF((mode-5),1,0,2)"),
        (
            "if(time-1: 0, if(time-2: 1,2,3), 4)",
            "IF((t-1),0,IF((t-2),1,2,3),4)",
        ),
        ("dx(21,1,0)", "DX(21,1,0)"),
        ("DX(021)", "DX(21)"),
        ("STEP(TIME,0,0,1,1)", "STEP(t,0,0,1,1)"),
        ("IF(TIME-1:\n, 0, 1,\n, 2)", "IF((t-1),0,1,2)"),
        ("1 +\n, 2", "(1+2)"),
        ("1\n, + 2", "(1+2)"),
        ("1 + & ! carries on\n 2", "(1+2)"),
        ("1 + &\n, 2", "(1+2)"),
        ("1 ! one\n! more\n, + 2", "(1+2)"),
        ("MAX(1,\n, 2)", "MAX(1,2)"),
    ];
    for (text, expected) in table {
        let model = correct(&format!("VARIABLE/1, FUNCTION = {text}\n"));
        assert_eq!(print(&model.variables[0].function.root), expected, "{text}");
    }
}

#[test]
fn constants_and_degrees_are_numbers() {
    let table = [
        ("PI", PI),
        ("90D", FRAC_PI_2),
        ("180d", PI),
        ("DTOR", PI / 180.0),
        ("RTOD", 180.0 / PI),
    ];
    for (text, expected) in table {
        let model = correct(&format!("VARIABLE/1, FUNCTION = {text}\n"));
        let Expr::Number(value) = model.variables[0].function.root else {
            panic!("{text} is not a number");
        };
        // The same operation in doubles, so a difference of one unit in the last place at most.
        assert!(
            (value - expected).abs() <= expected * f64::EPSILON,
            "{text}"
        );
    }
    let model = correct("VARIABLE/1, FUNCTION = 90D-3\n");
    assert_eq!(
        print(&model.variables[0].function.root),
        format!("({FRAC_PI_2}-3)")
    );
}

#[test]
fn an_expression_ends_where_the_next_argument_starts() {
    let force = "SFORCE/1, I=21, J=1, TRANSLATIONAL, FUNCTION = ";
    for rest in [
        "TIME\\, ACTIONONLY",
        "TIME\\ ACTIONONLY",
        "TIME\n, ACTIONONLY",
        "TIME, ACTIONONLY",
        "TIME\\\n, ACTIONONLY",
    ] {
        let model = correct(&format!("{force}{rest}\n"));
        assert!(model.single_forces[0].action_only, "{rest}");
        assert_eq!(model.single_forces[0].function.root, Expr::Time, "{rest}");
    }
    let model = correct("VARIABLE/1, FUNCTION = TIME*2\n, IC = 3\n");
    assert_eq!(model.variables[0].ic, Some(3.0));
    assert_eq!(model.variables[0].function.text, "TIME*2");
    let model = correct("REQUEST/1, F2=TIME\\F3=2*TIME\\F8=3\\, COMMENT=some text, with commas\n");
    let RequestKind::Functions(functions) = &model.requests[0].kind else {
        panic!("not a request of functions");
    };
    let given: Vec<bool> = functions.iter().map(Option::is_some).collect();
    assert_eq!(given, [false, true, true, false, false, false, false, true]);
    assert_eq!(
        model.requests[0].comment.as_deref(),
        Some("some text, with commas")
    );
}

#[test]
fn deep_and_long_expressions_are_refused_without_overflow() {
    let deep = "(".repeat(100_000) + "1" + &")".repeat(100_000);
    let signs = "-".repeat(100_000) + "1";
    let powers = "2".to_string() + &"**2".repeat(100_000);
    let long = "1".to_string() + &"+1".repeat(100_000);
    let calls = "SIN(".repeat(100_000) + "1" + &")".repeat(100_000);
    for text in [deep, signs, powers, long, calls] {
        let (_, diagnostics, _) = dataset(&format!("VARIABLE/1, FUNCTION = {text}\n"));
        assert_eq!(diagnostics.len(), 1);
        assert_eq!(diagnostics[0].code.as_str(), "expression");
    }
    // 150 levels and 900 terms are fine.
    let nested = "(".repeat(150) + "1" + &")".repeat(150) + &"+1".repeat(900);
    correct(&format!("VARIABLE/1, FUNCTION = {nested}\n"));
}

#[test]
fn statements_continue_and_end_as_the_language_says() {
    let texts = [
        "JOINT/1, REVOLUTE, I = 21, J = 1",
        "JOINT/1\n, REVOLUTE\n, I = 21\n, J = 1",
        "joint/1\r\n, revolute\r\n\r\n, i=21\r\n! a comment\r\n, j=1\r\n",
        "JOINT/1, REVOLUTE, &\n I = 21 &\n, J = 1",
        "JOINT/01,REVOLUTE,\nI=021,\n,J=01;",
        "J/1,RE,I=21,J=1 ! trailing; comment",
        "  JOINT/1 , REVOLUTE , I=21 , J=1 ; REQUEST/1, D, I=21, J=1",
        "JOINT/1, REVOLUTE, I=21, J=1\nEND\nthis is not read",
        "JOINT/1, REVOLUTE, I=21, J=1\r\n\u{1a}",
    ];
    for text in texts {
        let model = correct(text);
        let joint = &model.joints[0];
        assert_eq!(joint.kind, JointKind::Revolute, "{text}");
        assert_eq!((joint.header.id, joint.i, joint.j), (1, 21, 1), "{text}");
    }
}

#[test]
fn names_are_abbreviated() {
    let joints = [
        ("T", JointKind::Translational),
        ("TRANS", JointKind::Translational),
        ("TRANSLATION", JointKind::Translational),
        ("C", JointKind::Cylindrical),
        ("RE", JointKind::Revolute),
        ("SP", JointKind::Spherical),
        ("PL", JointKind::Planar),
        ("FIX", JointKind::Fixed),
        ("HO", JointKind::Hooke),
        ("U", JointKind::Universal),
    ];
    for (name, kind) in joints {
        let model = correct(&format!("JOI/1, {name}, I=21, J=1\n"));
        assert_eq!(model.joints[0].kind, kind, "{name}");
    }
    let model = correct(
        "JOINT/1, REVOLUTE, I=21, J=1\nMOT/1, JOINT=1, ROTATION, FUNC=TIME\n\
         FRI/1, JOINT=1, MU_STAT=0.3, MU_DYN=0.2, STICTION_TRANSITION_VEL=0.2\n\
         , EFFECT=SLID, INPUTS=(PRELOAD, REACTION_FORCE)\n\
         REQ/1, V, I=21, J=1, C=VELOCITY X Y Z\nSPRING/1, I=21, J=1, ROTATION, CT=1, KT=2\n",
    );
    assert_eq!(model.motions[0].target, MotionTarget::JointRotation(1));
    assert_eq!(model.requests[0].comment.as_deref(), Some("VELOCITY X Y Z"));
    assert_eq!(model.spring_dampers[0].stiffness, 2.0);
    let friction = &model.frictions[0];
    assert_eq!(friction.effect, Effect::Sliding);
    assert_eq!(
        friction.value(FrictionQuantity::StictionTransitionVelocity),
        0.2
    );
    assert_eq!(
        friction.inputs,
        FrictionInputs {
            preload: true,
            reaction_force: true,
            ..FrictionInputs::NONE
        }
    );
}

/// The least abbreviations that other readers of the language accept.
#[test]
fn statements_have_least_abbreviations() {
    let model = correct(
        "ACC/I=1, J=2, K=3\nM/4, P=2, Q=1,2,3, R=0,0,0\nM/5, P=2, Z=1,0,0, X=0,1,0\n\
         P/3, M=1, CM=31, IP=1,1,1, Q=1,2,3, R=0,0,0, EX=X\nM/31, P=3\n\
         POI/4, M=1, CM=41\nM/41, POI=4\nJ/1, C, I=4, J=1, ICT=1,2, ICR=3\n\
         JP/1, PAR, I=4, J=1\nJP/2, PERP, I=4, J=1\nJP/3, INP, I=4, J=1\nJP/4, AT, I=31, J=1\n\
         SF/1, TR, I=4, J=1, FU=1\\A\nSPR/1, TR, I=4, J=1, K=1, C=2, L=3, F=4\n\
         SPR/2, RO, I=4, J=1, KT=1, CT=2, A=3, TO=4\nVAR/1, FU=1\nGC/1, FU=DX(4)\n\
         R/1, DI, I=4, J=1, T=title\nR/2, ACCE, I=4, C=text\nOUT/REQ\nRES/FORM, COM=text\n\
         EQU/AL=1, ERR=1, IM=1, MAX=1, PAT=T:F, ST=1, TL=1\nIC/VER=1, AMAX=2, APAT=T\n\
         INT/GSTIFF, ERR=1E-3, KMAX=5\nKIN/MAX=10\n",
    );
    assert_eq!(model.gravity, Some([1.0, 2.0, 3.0]));
    assert_eq!(model.joints[0].ic_translation.unwrap().velocity, Some(2.0));
    assert_eq!(model.spring_dampers[1].free_length, 3.0);
    assert!(model.single_forces[0].action_only && model.output.requests);
    assert_eq!(model.equilibrium.unwrap().maxit, Some(1));
    assert_eq!(model.initial_conditions.unwrap().amaxit, Some(2));
    assert_eq!(model.integrator.unwrap().error, Some(1e-3));
}

#[test]
fn inputs_are_listed_with_colons_commas_and_brackets() {
    for list in [
        "PRELOAD:BENDING_MOMENT",
        "PRELOAD : BENDING_MOMENT",
        "PRELOAD, BENDING_MOMENT",
        "(PRELOAD:BENDING_MOMENT)",
        "(PRELOAD, BENDING_MOMENT), EFFECT=ALL",
    ] {
        let model = correct(&format!(
            "JOINT/1, REVOLUTE, I=21, J=1\n\
             FRICTION/1, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, INPUTS={list}\n"
        ));
        let inputs = model.frictions[0].inputs;
        assert!(
            inputs.preload && inputs.bending_moment && !inputs.reaction_force,
            "{list}"
        );
    }
}

#[test]
fn friction_has_its_defaults() {
    let model = correct(
        "JOINT/1, SPHERICAL, I=21, J=1\nFRICTION/1, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2\n\
         , BALL_RADIUS=4, INACTIVE_DURING=STATIC\n",
    );
    let friction = &model.frictions[0];
    assert!(friction.inactive_static);
    assert_eq!(friction.value(FrictionQuantity::BallRadius), 4.0);
    assert_eq!(
        friction.value(FrictionQuantity::MaxStictionDeformation),
        0.01
    );
    let names: Vec<&str> = friction
        .defaults_in_use(JointKind::Spherical)
        .iter()
        .filter(|default| default.depends_on_length_unit())
        .map(|default| default.quantity.keyword())
        .collect();
    assert_eq!(
        names,
        ["STICTION_TRANSITION_VELOCITY", "MAX_STICTION_DEFORMATION"]
    );
}

#[test]
fn angles_with_d_are_degrees_and_axes_are_given_three_ways() {
    let model = correct(
        "MARKER/4, PART=2, QP=1, 2, 3, REULER=90D, -45D, 0.5\n\
         MARKER/5, PART=2, ZP=1, 0, 0, XP=0, 1, 0\nMARKER/6, PART=2, XP=0, 0, 2, USEXP\n",
    );
    let angles = [FRAC_PI_2, -PI / 4.0, 0.5];
    assert_eq!(
        model.markers.by_id(4).unwrap().orientation,
        Orientation::Euler(angles)
    );
    let z = Some([1.0, 0.0, 0.0]);
    let x = Some([0.0, 1.0, 0.0]);
    let points = Orientation::Points { z, x, use_x: false };
    assert_eq!(model.markers.by_id(5).unwrap().orientation, points);
    let x = Some([0.0, 0.0, 2.0]);
    let points = Orientation::Points {
        z: None,
        x,
        use_x: true,
    };
    assert_eq!(model.markers.by_id(6).unwrap().orientation, points);
}

#[test]
fn the_consistency_factor_follows_from_the_units() {
    use ForceUnit as F;
    use LengthUnit as L;
    use MassUnit as M;
    let table = [
        // Adams gives 386.0886 and 32.174 for pounds, which is g in inches and feet per s^2.
        (F::Newton, M::Kilogram, L::Meter, 1.0),
        (F::Newton, M::Kilogram, L::Millimeter, 1000.0),
        (F::Newton, M::Tonne, L::Millimeter, 1.0),
        (F::Dyne, M::Gram, L::Centimeter, 1.0),
        (F::PoundForce, M::PoundMass, L::Inch, 9.80665 / 0.0254),
        (F::PoundForce, M::PoundMass, L::Foot, 9.80665 / 0.3048),
        (F::PoundForce, M::Slug, L::Foot, 1.0),
        (F::PoundForce, M::Slinch, L::Inch, 1.0),
        (F::KilogramForce, M::Kilogram, L::Meter, 9.80665),
    ];
    for (force, mass, length, expected) in table {
        let ucf = Units::new(force, mass, length, TimeUnit::Second).ucf;
        // Three products and a quotient of doubles.
        assert!(
            (ucf / expected - 1.0).abs() < 4.0 * f64::EPSILON,
            "{force:?} {mass:?}: {ucf}"
        );
    }
    for (system, expected) in [("MKS", 1.0), ("CGS", 1.0), ("IPS", 9.80665 / 0.0254)] {
        let source = Source::from_text("t.adm", format!("t\nUNITS/SYSTEM={system}\nPART/1,G\n"));
        let (model, diagnostics) = read_dataset(&source);
        assert!(diagnostics.is_empty());
        let ucf = model.units.unwrap().ucf;
        assert!(
            (ucf / expected - 1.0).abs() < 4.0 * f64::EPSILON,
            "{system}: {ucf}"
        );
    }
}

#[test]
fn names_come_from_the_last_comment_before_a_statement() {
    let model = correct(
        "!  adams_view_name='wrong'\n!\n!   adams_view_name='model.PART_3'\nPART/3\n\
         ! inside 1\n, QG = 1, 2, 3\nPART/4\n",
    );
    assert_eq!(
        model.parts.by_id(3).unwrap().header.name.as_deref(),
        Some("model.PART_3")
    );
    assert_eq!(model.parts.by_id(4).unwrap().header.name, None);
}

#[test]
fn latin_1_is_read_and_columns_count_characters() {
    let bytes = b"caf\xe9\nPART/1, GROUND ! \xb7\xb7\nREQUEST/1, C=\xb7\xb7, WRONG=1\n";
    let source = Source::from_bytes("latin.adm", bytes).expect("text");
    let (model, diagnostics) = read_dataset(&source);
    assert_eq!(model.title, "caf\u{e9}");
    let rendered: String = diagnostics
        .iter()
        .map(|found| found.render(&source))
        .collect();
    assert!(rendered.contains("latin.adm:3:1: "), "{rendered}");
    let (line, column) = source.line_column(source.text().find("WRONG").unwrap());
    assert_eq!((line, column), (3, 18));
}

#[test]
fn utf_8_is_read_as_such() {
    let text = "\u{feff}café\nPART/1, GROUND\nREQUEST/1, C=日本, WRONG=1\n";
    let source = Source::from_bytes("utf.adm", text.as_bytes()).expect("text");
    assert_eq!(read_dataset(&source).0.title, "café");
    let place = source.text().find("WRONG").unwrap();
    assert_eq!(source.line_column(place), (3, 18));
}

#[test]
fn tokens_keep_comments_and_blanks() {
    let text = "t\nPART/1 ! c\n , GROUND\t\"a b\" 3DBEAM 1.5E-3D x_1**2";
    let source = Source::from_text("t.adm", text.to_string());
    let tree = SyntaxTree::new(&source, Language::Dataset);
    let significant: Vec<&str> = tree
        .tokens
        .iter()
        .filter(|token| !token.is_trivia())
        .map(|token| source.slice(token.span()))
        .collect();
    let expected = [
        "t", "PART", "/", "1", ",", "GROUND", "\"a b\"", "3DBEAM", "1.5E-3D", "x_1", "**", "2",
    ];
    assert_eq!(significant, expected);
    assert_eq!(tree.tokens[0].kind, TokenKind::Line);
}

/// Peak memory and time stay linear: this is one twentieth of a 100 MB file.
#[test]
fn a_large_file_is_read_in_linear_time() {
    let mut text = String::from("large\nPART/1, GROUND\n");
    for id in 1..=60_000 {
        text += &format!(
            "!                adams_view_name='MARKER_{id}'\nMARKER/{id}\n, PART = 1\n\
             , QP = {id}, 0.5, -1.0E-003\n"
        );
    }
    for line in [
        "MARKER/0, PART=1\n",
        "MRKER/1\n",
        "JOINT/1, FIXED, I=900000, J=900001\n",
    ] {
        text += &line.repeat(20_000);
    }
    let source = Source::from_text("large.adm", text);
    let start = std::time::Instant::now();
    let (model, diagnostics) = read_dataset(&source);
    let rendered: usize = diagnostics
        .iter()
        .map(|found| found.render(&source).len())
        .sum();
    let seconds = start.elapsed().as_secs_f64();
    let megabytes = source.text().len() as f64 / 1e6;
    println!("{megabytes:.1} MB in {seconds:.2} s, {rendered} bytes of messages");
    assert_eq!(model.markers.len(), 80_000);
    // All over the limit is counted in one last message: 20,000 bad numbers, 20,000 unknown
    // statements, and of 20,000 joints 19,999 repeat the first and 40,000 markers are missing.
    assert_eq!(diagnostics.len(), 10_001);
    let last = &diagnostics[10_000].message;
    assert_eq!(
        last,
        "89999 more messages are not shown, 89999 of them errors"
    );
    // Quadratic behaviour would take minutes; this leaves room for a loaded machine.
    assert!(seconds < 20.0, "{seconds} s");
}
