//! ARRAY, MATRIX and STRING.

use super::{Builder, Reference, Target, add};
use crate::diagnostic::Code;
use crate::keywords::{Keyword, Kind, abbreviated, keyword};
use crate::model::{Array, ArrayKind, Matrix, Text};
use crate::reading::Reading;

const NUMBERS: Kind = Kind::Reals(1, usize::MAX);

pub(super) const ARRAY_KEYWORDS: &[Keyword] = &[
    keyword("X", Kind::Flag),
    keyword("Y", Kind::Flag),
    keyword("U", Kind::Flag),
    keyword("IC", Kind::Flag),
    abbreviated("SIZE", "S", Kind::Integer),
    abbreviated("NUMBERS", "N", NUMBERS),
    abbreviated("VARIABLES", "V", Kind::Ids),
];

/// What an ARRAY says it is.
#[derive(Clone, Copy)]
enum Sort {
    States,
    Outputs,
    Inputs,
    Numbers,
}

/// ARRAY. One that does not say what it is holds numbers.
pub(super) fn array(reading: &mut Reading, builder: &mut Builder) {
    let sorts = [
        ("X", Sort::States),
        ("Y", Sort::Outputs),
        ("U", Sort::Inputs),
        ("IC", Sort::Numbers),
    ];
    let sort = reading.one_flag(&sorts).unwrap_or(Sort::Numbers);
    let variables = reading.ids("VARIABLES").to_vec();
    builder
        .references
        .extend(variables.iter().map(|(id, span)| Reference {
            target: Target::Variable,
            id: *id,
            span: *span,
        }));
    let size = reading.count("SIZE");
    let (kind, given) = match sort {
        Sort::States => (ArrayKind::States, None),
        Sort::Outputs => (ArrayKind::Outputs, None),
        Sort::Inputs => {
            reading.require("VARIABLES");
            let ids: Vec<u32> = variables.iter().map(|(id, _)| *id).collect();
            let count = ids.len();
            (ArrayKind::Inputs(ids), Some(("VARIABLES", count)))
        }
        Sort::Numbers => {
            reading.require("NUMBERS");
            let numbers: Vec<f64> = reading.reals("NUMBERS").iter().map(|(n, _)| *n).collect();
            let count = numbers.len();
            (ArrayKind::Numbers(numbers), Some(("NUMBERS", count)))
        }
    };
    if let (Some(size), Some((keyword, count))) = (size, given)
        && reading.has(keyword)
        && size as usize != count
    {
        let message = format!("SIZE is {size}, but {keyword} has {count}");
        let span = reading.place("SIZE");
        reading.diagnostics.error(Code::InvalidValue, span, message);
    }
    let array = Array {
        header: reading.header(),
        kind,
        size,
    };
    let list = &mut builder.dataset.arrays;
    add(list, array, reading.name, reading.diagnostics);
}

pub(super) const MATRIX_KEYWORDS: &[Keyword] = &[
    abbreviated("FULL", "FU", Kind::Word),
    abbreviated("SPARSE", "S", Kind::Flag),
    abbreviated("ROWS", "R", Kind::Ids),
    abbreviated("COLUMNS", "C", Kind::Ids),
    abbreviated("VALUES", "V", NUMBERS),
    keyword("NAME", Kind::Ignored("it names a matrix in a file")),
    abbreviated(
        "FILE",
        "FI",
        Kind::Unsupported("matrices of other programs are not read; give VALUES"),
    ),
];

/// MATRIX. FULL gives all values by rows (RORDER) or columns (CORDER); SPARSE some, with the row and
/// the column of each.
pub(super) fn matrix(reading: &mut Reading, builder: &mut Builder) {
    reading.exclude("FULL", &["SPARSE"]);
    if !reading.has("FILE") {
        for keyword in ["ROWS", "COLUMNS", "VALUES"] {
            reading.require(keyword);
        }
    }
    let by_rows = reading.choice("FULL", &[("RORDER", true), ("CORDER", false)]);
    let values: Vec<f64> = reading.reals("VALUES").iter().map(|(v, _)| *v).collect();
    let [rows, columns] = ["ROWS", "COLUMNS"].map(|keyword| {
        let ids = reading.ids(keyword).iter();
        ids.map(|(id, _)| *id as usize).collect::<Vec<_>>()
    });
    let (expected, size) = if reading.has("SPARSE") {
        let largest = |places: &[usize]| places.iter().copied().max().unwrap_or(0);
        (
            [values.len(), values.len()],
            [largest(&rows), largest(&columns)],
        )
    } else {
        let first = |counts: &[usize]| counts.first().copied().unwrap_or(0);
        ([1, 1], [first(&rows), first(&columns)])
    };
    for ((keyword, found), expected) in [("ROWS", &rows), ("COLUMNS", &columns)]
        .into_iter()
        .zip(expected)
    {
        if reading.has(keyword) && found.len() != expected {
            let message = format!("{keyword} takes {expected} here, found {}", found.len());
            let span = reading.place(keyword);
            reading.diagnostics.error(Code::InvalidValue, span, message);
        }
    }
    let [row_count, column_count] = size;
    let entries = if reading.has("SPARSE") {
        let places = rows.iter().zip(&columns).zip(&values);
        places.map(|((r, c), v)| (r - 1, c - 1, *v)).collect()
    } else {
        if reading.has("VALUES") && row_count.checked_mul(column_count) != Some(values.len()) {
            let message = format!(
                "a matrix of {row_count} rows and {column_count} columns has {} values, found {}",
                row_count.saturating_mul(column_count),
                values.len()
            );
            let span = reading.place("VALUES");
            reading.diagnostics.error(Code::InvalidValue, span, message);
        }
        let place = |k: usize| {
            if by_rows == Some(false) {
                (k % row_count.max(1), k / row_count.max(1))
            } else {
                (k / column_count.max(1), k % column_count.max(1))
            }
        };
        let numbered = values.iter().enumerate();
        numbered
            .map(|(k, v)| (place(k).0, place(k).1, *v))
            .collect()
    };
    let matrix = Matrix {
        header: reading.header(),
        rows: row_count,
        columns: column_count,
        entries,
    };
    let list = &mut builder.dataset.matrices;
    add(list, matrix, reading.name, reading.diagnostics);
}

pub(super) const STRING_KEYWORDS: &[Keyword] = &[abbreviated("STRING", "S", Kind::Text)];

/// STRING.
pub(super) fn string(reading: &mut Reading, builder: &mut Builder) {
    reading.require("STRING");
    let text = Text {
        header: reading.header(),
        text: reading.text("STRING").unwrap_or_default(),
    };
    add(
        &mut builder.dataset.strings,
        text,
        reading.name,
        reading.diagnostics,
    );
}
