//! BUSHING, FIELD and BEAM.

use super::{Builder, Target, add};
use crate::diagnostic::Code;
use crate::keywords::{INTERFACE, Keyword, Kind, ROUTINE, SUBROUTINE, abbreviated, keyword};
use crate::model::{Beam, BeamDamping, Bushing, Field};
use crate::reading::Reading;

const VECTOR: Kind = Kind::Reals(3, 3);
const SIX: Kind = Kind::Reals(6, 6);
const MATRIX: Kind = Kind::Reals(36, 36);

pub(super) const BUSHING_KEYWORDS: &[Keyword] = &[
    keyword("I", Kind::Id),
    keyword("J", Kind::Id),
    keyword("K", VECTOR),
    keyword("KT", VECTOR),
    keyword("C", VECTOR),
    keyword("CT", VECTOR),
    abbreviated("FORCE", "F", VECTOR),
    abbreviated("TORQUE", "T", VECTOR),
];

/// BUSHING. What is left out is zero.
pub(super) fn bushing(reading: &mut Reading, builder: &mut Builder) {
    let [stiffness, torsional_stiffness, damping, torsional_damping] = ["K", "KT", "C", "CT"]
        .map(|keyword| reading.not_negative_vector(keyword).unwrap_or_default());
    let bushing = Bushing {
        header: reading.header(),
        i: builder.require(reading, "I", Target::Marker),
        j: builder.require(reading, "J", Target::Marker),
        stiffness,
        torsional_stiffness,
        damping,
        torsional_damping,
        force: reading.vector("FORCE").unwrap_or_default(),
        torque: reading.vector("TORQUE").unwrap_or_default(),
    };
    let list = &mut builder.dataset.bushings;
    add(list, bushing, reading.name, reading.diagnostics);
}

pub(super) const FIELD_KEYWORDS: &[Keyword] = &[
    keyword("I", Kind::Id),
    keyword("J", Kind::Id),
    abbreviated("KMATRIX", "KM", MATRIX),
    abbreviated("CMATRIX", "CM", MATRIX),
    abbreviated("CRATIO", "CR", Kind::Real),
    abbreviated("LENGTH", "L", SIX),
    abbreviated("FORCE", "FO", SIX),
    keyword("FORMULATION", Kind::Word),
    abbreviated("FUNCTION", "FU", Kind::Unsupported(SUBROUTINE)),
    ROUTINE,
    INTERFACE,
];

/// FIELD. What is left out is zero.
pub(super) fn field(reading: &mut Reading, builder: &mut Builder) {
    reading.exclude("CMATRIX", &["CRATIO"]);
    if reading.has("CRATIO") {
        reading.require("KMATRIX");
    }
    let formulations = [("LINEAR", true), ("NONLINEAR", false)];
    if reading.choice("FORMULATION", &formulations) == Some(false) {
        let span = reading.place("FORMULATION");
        let message = "fields are simulated with FORMULATION = LINEAR only";
        reading
            .diagnostics
            .error(Code::UnsupportedArgument, span, message)
            .help("write LINEAR where the rotations are small, else a GFORCE with its components");
    }
    let stiffness = by_columns(reading, "KMATRIX");
    let damping = match reading.not_negative("CRATIO") {
        Some(ratio) => stiffness.map(|row| row.map(|entry| ratio * entry)),
        None => by_columns(reading, "CMATRIX"),
    };
    let field = Field {
        header: reading.header(),
        i: builder.require(reading, "I", Target::Marker),
        j: builder.require(reading, "J", Target::Marker),
        stiffness,
        damping,
        free: six(reading, "LENGTH"),
        preload: six(reading, "FORCE"),
    };
    let list = &mut builder.dataset.fields;
    add(list, field, reading.name, reading.diagnostics);
}

/// Six numbers, zero where there are none.
fn six(reading: &Reading, keyword: &str) -> [f64; 6] {
    let mut values = [0.0; 6];
    for (value, (given, _)) in values.iter_mut().zip(reading.reals(keyword)) {
        *value = *given;
    }
    values
}

/// A matrix that is given column after column, by rows.
fn by_columns(reading: &Reading, keyword: &str) -> [[f64; 6]; 6] {
    let mut matrix = [[0.0; 6]; 6];
    for (place, (value, _)) in reading.reals(keyword).iter().enumerate().take(36) {
        matrix[place % 6][place / 6] = *value;
    }
    matrix
}

pub(super) const BEAM_KEYWORDS: &[Keyword] = &[
    keyword("I", Kind::Id),
    keyword("J", Kind::Id),
    abbreviated("LENGTH", "L", Kind::Real),
    keyword("AREA", Kind::Real),
    abbreviated("IXX", "IX", Kind::Real),
    abbreviated("IYY", "IY", Kind::Real),
    abbreviated("IZZ", "IZ", Kind::Real),
    keyword("ASY", Kind::Real),
    keyword("ASZ", Kind::Real),
    abbreviated("EMODULUS", "E", Kind::Real),
    abbreviated("GMODULUS", "G", Kind::Real),
    abbreviated("CRATIO", "CR", Kind::Real),
    abbreviated("CMATRIX", "CM", Kind::Reals(21, 21)),
    abbreviated("FORMULATION", "F", Kind::Word),
    keyword(
        "MATERIAL",
        Kind::Unsupported("give EMODULUS and GMODULUS themselves"),
    ),
];

/// The formulations, and whether they are simulated.
const FORMULATIONS: [(&str, bool); 3] = [("LINEAR", true), ("NONLINEAR", false), ("STRING", false)];

/// BEAM.
pub(super) fn beam(reading: &mut Reading, builder: &mut Builder) {
    if reading.choice("FORMULATION", &FORMULATIONS) == Some(false) {
        let span = reading.place("FORMULATION");
        let message = format!(
            "{}: beams are simulated with FORMULATION = LINEAR only",
            reading.label()
        );
        reading
            .diagnostics
            .error(Code::UnsupportedArgument, span, message)
            .help("split the beam into short ones that bend little each, and make them LINEAR");
    }
    reading.exclude("CMATRIX", &["CRATIO"]);
    let mut positive = |keyword| {
        if !reading.has("MATERIAL") {
            reading.require(keyword);
        }
        reading.positive(keyword).unwrap_or(1.0)
    };
    let [young, shear_modulus] = ["EMODULUS", "GMODULUS"].map(&mut positive);
    let [length, area, torsional_constant, moment_y, moment_z] =
        ["LENGTH", "AREA", "IXX", "IYY", "IZZ"].map(positive);
    let [shear_y, shear_z] =
        ["ASY", "ASZ"].map(|keyword| reading.not_negative(keyword).unwrap_or(0.0));
    let damping = if reading.has("CMATRIX") {
        BeamDamping::Matrix(Box::new(symmetric(reading, "CMATRIX")))
    } else {
        BeamDamping::Ratio(reading.not_negative("CRATIO").unwrap_or(0.0))
    };
    let beam = Beam {
        header: reading.header(),
        i: builder.require(reading, "I", Target::Marker),
        j: builder.require(reading, "J", Target::Marker),
        length,
        area,
        torsional_constant,
        moment_y,
        moment_z,
        shear_y,
        shear_z,
        young,
        shear_modulus,
        damping,
    };
    let list = &mut builder.dataset.beams;
    add(list, beam, reading.name, reading.diagnostics);
}

/// A symmetric matrix whose lower half is given column after column.
fn symmetric(reading: &Reading, keyword: &str) -> [[f64; 6]; 6] {
    let mut matrix = [[0.0; 6]; 6];
    let places = (0..6).flat_map(|column| (column..6).map(move |row| (row, column)));
    for ((row, column), (value, _)) in places.zip(reading.reals(keyword)) {
        matrix[row][column] = *value;
        matrix[column][row] = *value;
    }
    matrix
}
