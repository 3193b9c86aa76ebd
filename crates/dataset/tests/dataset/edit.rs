//! Changes written into the text of a dataset.

use dataset::{Source, edit, parse_change, read_dataset, to_json};
use serde_json::Value;

fn edited(text: &str, changes: &[&str]) -> String {
    let source = Source::from_text("m.adm", text.to_owned());
    let changes: Vec<String> = changes.iter().map(|&change| change.to_owned()).collect();
    edit(&source, &changes).unwrap_or_else(|errors| panic!("{changes:?}: {errors:?}"))
}

#[test]
fn arguments_are_replaced_where_they_stand() {
    for (text, changes, expected) in [
        // In place: spacing, comments and neighbours stay; abbreviations are understood.
        (
            "t\n! a note\nfric/103 , JOINT = 1 ! here\n,  mu_stat =0.3!dry\n, MU_DYNAMIC= 0.2 \n\nEND\nafter",
            &["FRICTION/103, MU_STATIC=0.25"][..],
            "t\n! a note\nfric/103 , JOINT = 1 ! here\n,  mu_stat =0.25!dry\n, MU_DYNAMIC= 0.2 \n\nEND\nafter",
        ),
        // The last of several changes counts, and other elements of the same kind stay.
        (
            "t\nPART/2,MASS=1,IP=1,1,1\nPART/3,MASS=1,IP=1,1,1\nEND\n",
            &["PART/3, MASS=2", "PART/3, IP=4,5,6", "PART/3, MASS=3"],
            "t\nPART/2,MASS=1,IP=1,1,1\nPART/3,MASS=3,IP=4,5,6\nEND\n",
        ),
        // New ones follow the last, laid out as it is, before a comment that ends its line.
        (
            "t\nFRICTION/1,\nJOINT=1,\nMU_STATIC=0.3 ! dry\nEND\n",
            &["FRICTION/1, MU_DYNAMIC=0.2, INPUTS=PRELOAD, REACTION_FORCE"],
            "t\nFRICTION/1,\nJOINT=1,\nMU_STATIC=0.3,\nMU_DYNAMIC=0.2,\nINPUTS=PRELOAD, REACTION_FORCE ! dry\nEND\n",
        ),
        // Expressions: the mark of their end stays, and is put where others follow.
        (
            "t\nSFORCE/1, I=1, J=2, FUNCTION=DX(1,2)\\, ROTATIONAL\nEND\n",
            &["SFORCE/1, FUNCTION=-3*DZ(1, 2)"],
            "t\nSFORCE/1, I=1, J=2, FUNCTION=-3*DZ(1, 2)\\, ROTATIONAL\nEND\n",
        ),
        (
            "t\nVFORCE/1, I=1, JFLOAT=2, RM=1\n, FX=VX(1)\n, FY=0\\\n, FZ=1\nEND\n",
            &["VFORCE/1, FZ=2+TIME", "VFORCE/1, FX=5"],
            "t\nVFORCE/1, I=1, JFLOAT=2, RM=1\n, FX=5\\\n, FY=0\\\n, FZ=2+TIME\nEND\n",
        ),
        (
            "t\nMOTION/1, JOINT=1, ROTATION\n, FUNCTION=TIME\nEND\n",
            &["MOTION/1, VELOCITY"],
            "t\nMOTION/1, JOINT=1, ROTATION\n, FUNCTION=TIME\\\n, VELOCITY\nEND\n",
        ),
        // What another argument takes the place of goes, with its comma.
        (
            "t\nMOTION/1, JOINT=1, ROTATION, DISPLACEMENT ! kept\n, ICVEL=3\n, FUNCTION=TIME\nEND\n",
            &["MOTION/1, VELOCITY"],
            "t\nMOTION/1, JOINT=1, ROTATION ! kept\n, FUNCTION=TIME\\\n, VELOCITY\nEND\n",
        ),
        // Statements without a number; those that are not there come before END.
        (
            "t\r\nACCGRAV/JGRAV=-1\r\nEND\r\n",
            &[
                "ACCGRAV/IGRAV=2",
                "ACCGRAV/JGRAV=0",
                "INTEGRATOR/ERROR=1e-6",
            ],
            "t\r\nACCGRAV/JGRAV=0, IGRAV=2\r\nINTEGRATOR/ERROR=1e-6\r\nEND\r\n",
        ),
        (
            "t\nPART/1, GROUND",
            &["ACCGRAV/KGRAV=-9.81"],
            "t\nPART/1, GROUND\nACCGRAV/KGRAV=-9.81\n",
        ),
        ("t\nEND\n", &[], "t\nEND\n"),
    ] {
        assert_eq!(edited(text, changes), expected, "{changes:?}");
        // Once more changes nothing.
        assert_eq!(edited(expected, changes), expected, "{changes:?} again");
    }
}

#[test]
fn what_is_no_argument_of_the_dataset_is_refused() {
    let source = Source::from_text("m.adm", "t\nPART/1, GROUND\nEND\n".to_owned());
    for (change, words) in [
        ("FRICTION/9, MU_STATIC=0.1", "there is no FRICTION/9"),
        ("DEACTIVATE/JOINT, ID=1", "cannot be written into a dataset"),
        ("", "expected one statement"),
    ] {
        let errors = edit(&source, &[change.to_owned()]).unwrap_err();
        assert!(errors[0].message.contains(words), "{change}: {errors:?}");
    }
}

/// A text with the statement alone, as JSON without the order of its arguments.
fn said(statement: &str) -> Value {
    let text = format!("t\n{statement}\nEND\n");
    let json = to_json(&Source::from_text("m.adm", text)).unwrap();
    let value: Value = serde_json::from_str(&json).unwrap();
    value["statements"][0].clone()
}

/// The edited text says what the changed dataset says.
#[test]
fn an_edited_dataset_is_the_changed_one() {
    let text = "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, PART=1\nMARKER/2, PART=1, FLOATING
PART/2, MASS=1, CM=20, IP=1, 1, 1\nMARKER/20, PART=2
BUSHING/3, I=20, J=1\n, K=1,2,3\n, KT=1,\n, 2, 3, C=1,1,1,CT=1,1,1
GFORCE/4, I=20, JFLOAT=2, RM=1\n, FX=DX(20)\\\n, FY=0\\\n, FZ=VZ(20)*2,\n, TX=0\\TY=0\\TZ=0
VARIABLE/5, FUNCTION=TIME*2\nVARIABLE/6, IC=1, FUNCTION=\n, TIME\nEND\n";
    let changes = [
        ("BUSHING", 3, "BUSHING/3, KT=9, 8, 7"),
        ("BUSHING", 3, "BUSHING/3, FORCE=1, 2, 3"),
        ("GFORCE", 4, "GFORCE/4, FZ=VARVAL(5)"),
        ("GFORCE", 4, "GFORCE/4, FX=1\\ TZ=2"),
        ("VARIABLE", 5, "VARIABLE/5, FUNCTION=IF(TIME-1: 0, 1, 2)"),
        ("VARIABLE", 6, "VARIABLE/6, IC=2"),
        ("PART", 2, "PART/2, MASS=5"),
    ];
    let source = Source::from_text("m.adm", text.to_owned());
    let (mut changed, _) = read_dataset(&source);
    for (_, _, change) in changes {
        let change = Source::from_text("change", change.to_owned());
        let (parsed, wrong) = parse_change(&change);
        assert!(wrong.is_empty(), "{wrong:?}");
        let wrong = changed.apply(&parsed.unwrap());
        assert!(wrong.is_empty(), "{wrong:?}");
    }
    let new = edited(text, &changes.map(|(_, _, change)| change));
    let new = Source::from_text("m.adm", new);
    let (read, wrong) = read_dataset(&new);
    assert!(
        wrong.iter().all(|d| d.severity != dataset::Severity::Error),
        "{wrong:?}"
    );
    for (statement, id, _) in changes {
        let of = |dataset: &dataset::Dataset| said(&dataset.text_of(statement, id).unwrap());
        assert_eq!(of(&read), of(&changed), "{}", new.text());
    }
}
