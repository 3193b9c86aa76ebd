//! The layout of datasets and command files: what it is, that it is stable, that nothing is lost.

use crate::shared::without_places;
use dataset::{Code, Language, Source, format, read_commands, read_dataset};
use std::path::Path;

fn laid_out(text: &str, language: Language) -> String {
    let source = Source::from_text("text", text.to_string());
    let once = format(&source, language).unwrap_or_else(|errors| {
        panic!("{}", errors[0].render(&source));
    });
    let again = Source::from_text("text", once.clone());
    assert_eq!(format(&again, language).as_ref(), Ok(&once), "not stable");
    once
}

fn dataset(text: &str) -> String {
    let out = laid_out(&format!("title\n{text}"), Language::Dataset);
    out.strip_prefix("title\n").expect("the title").to_string()
}

#[test]
fn each_argument_has_a_line_and_comments_keep_their_places() {
    assert_eq!(
        dataset(
            "! first\nPART/1 , GROUND;MARKER/1,PART=1, QP=1,2,3  ! here\n\n\n\n\
             !    adams_view_name='A'\nMARKER/2\n!, PART=3\n,PART=1 ! owner\n\n,REULER=90D,- 1,\t2\nEND"
        ),
        "! first\nPART/1\n, GROUND\nMARKER/1\n, PART = 1\n, QP = 1, 2, 3 ! here\n\n\
         !    adams_view_name='A'\nMARKER/2\n!, PART=3\n, PART = 1 ! owner\n, REULER = 90D, -1, 2\nEND\n"
    );
}

#[test]
fn a_value_keeps_the_lines_of_its_author() {
    let text = "FIELD/1\n, I = 1\n, J = 2\n, KMATRIX =  1.0,  0.0, 0, 0, 0, 0\n\
                ,           0.0, -1.0, 0, 0, 0, 0 ! second row\n, 0, 0, 0, 0, 0, 0\n\
                , 0, 0, 0, 0, 0, 0\n, 0, 0, 0, 0, 0, 0\n, 0, 0, 0, 0, 0, 0\n\
                VARIABLE/1\n, FUNCTION = IF(TIME - 1:\n,   0,\n,   1,\n,   2)\nEND\n";
    assert_eq!(dataset(text), text.replace("KMATRIX =  1", "KMATRIX = 1"));
}

#[test]
fn long_lines_are_broken_where_they_read_the_same() {
    let sum = (1..=12)
        .map(|k| format!("{k}.5E-003*SIN({k}*TIME)"))
        .collect::<Vec<_>>()
        .join(" + ");
    let numbers = (1..=30)
        .map(|k| format!("{k}.125"))
        .collect::<Vec<_>>()
        .join(", ");
    let out = dataset(&format!(
        "VARIABLE/1, FUNCTION = STEP(TIME, 0, {sum}, 1, 2)\\, IC = 1\n\
         FIELD/1, I=1, J=2, KMATRIX={numbers},1,2,3,4,5,6\nEND"
    ));
    println!("{out}");
    assert!(out.lines().all(|line| line.len() <= 80), "{out}");
    assert!(out.lines().all(|line| !line.ends_with(' ')), "{out}");
}

#[test]
fn a_command_that_fits_stands_on_one_line() {
    let text = "\nfile/model = a , output_prefix= b\n\n\nsim/dyn,\n, end =2.0, &\nsteps=200\n\
                variable/1, function = 1+ &\n 2 ! two\ndeact/joint , id =1 ,2\nstop\n anything ; at / all\n";
    assert_eq!(
        laid_out(text, Language::Commands),
        "\nfile/model=a, output_prefix=b\n\nsim/dyn, end=2.0, steps=200\n\
         variable/1\n, function=1+ &\n2 ! two\ndeact/joint, id=1, 2\nstop\n anything ; at / all\n"
    );
}

#[test]
fn damage_that_still_reads_is_laid_out() {
    let part = "PART/3\n, ZG =  1.43E+00, -9.9E-01,  2.68&\n\n, XG = 1, 2, 3\nEND\n";
    assert_eq!(
        dataset(part),
        "PART/3\n, ZG = 1.43E+00, -9.9E-01, 2.68\n, XG = 1, 2, 3\nEND\n"
    );
}

#[test]
fn what_is_not_known_keeps_its_lines() {
    let text = "MFORCE/1\n, TYPE=SOLID_TO_SOLID , IGEOM=1\n,JGEOM=2\nMADE_UP/7, A =  1\n\
                , B=2 ! why\nEND\nand so on\n";
    assert_eq!(dataset(text), text);
}

#[test]
fn line_ends_and_texts_stay() {
    let text = "title\r\nSTRING/1, STRING=a  b,  c\r\nREQUEST/1, D, I=1, COMMENT=a  b,  c\r\n";
    assert_eq!(
        laid_out(text, Language::Dataset),
        "title\r\nSTRING/1\r\n, STRING = a  b,  c\r\nREQUEST/1\r\n, D\r\n, I = 1\r\n\
         , COMMENT = a  b,  c\r\n"
    );
}

#[test]
fn what_cannot_be_read_is_left_alone() {
    let text = "title\nPART/1, GROUND\nMARKER/1, PART=1, QP=1,2\n";
    let source = Source::from_text("text", text.to_string());
    let errors = format(&source, Language::Dataset).unwrap_err();
    assert_eq!(errors[0].code, Code::InvalidValue);
}

fn language(path: &Path) -> Language {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("acf") => Language::Commands,
        _ => Language::Dataset,
    }
}

/// The model or the commands without places, and the messages.
fn meaning(source: &Source, language: Language) -> (String, Vec<(Code, String)>) {
    let (meaning, diagnostics) = match language {
        Language::Dataset => {
            let (dataset, diagnostics) = read_dataset(source);
            (without_places(&format!("{dataset:?}")), diagnostics)
        }
        _ => {
            let (file, diagnostics) = read_commands(source);
            (without_places(&format!("{file:?}")), diagnostics)
        }
    };
    let mut messages: Vec<(Code, String)> = diagnostics
        .into_iter()
        .map(|diagnostic| (diagnostic.code, diagnostic.message))
        .collect();
    messages.sort_by(|a, b| a.1.cmp(&b.1));
    (meaning, messages)
}

#[test]
fn real_files_mean_the_same_and_are_stable() {
    let mut files = 0;
    let mut refused = Vec::new();
    let folders = ["corpus", "adams-results"].map(reference_data::path);
    for path in folders
        .iter()
        .flatten()
        .flat_map(|folder| reference_data::models(folder))
    {
        let bytes = std::fs::read(&path).expect("the file can be read");
        let source = Source::from_bytes("file", &bytes).expect("the file is text");
        let language = language(&path);
        let text = match format(&source, language) {
            Ok(text) => text,
            Err(errors) => {
                refused.push(format!("{}: {}", path.display(), errors[0].render(&source)));
                continue;
            }
        };
        let written = Source::from_text("file", text);
        let again = format(&written, language);
        assert!(again.as_deref() == Ok(written.text()), "{}", path.display());
        let (before, after) = (meaning(&source, language), meaning(&written, language));
        let same = before
            .0
            .bytes()
            .zip(after.0.bytes())
            .take_while(|(a, b)| a == b)
            .count();
        assert!(
            before == after,
            "{} means something else: {:?} {:?}",
            path.display(),
            before.0.get(same.saturating_sub(60)..same + 60),
            after.0.get(same.saturating_sub(60)..same + 60)
        );
        files += 1;
    }
    println!("{files} files laid out; left alone:\n{}", refused.concat());
}
