//! PART, `POINT_MASS` and MARKER.

use super::{Builder, Reference, Target, add};
use crate::checks::{angles, inertia};
use crate::diagnostic::Code;
use crate::keywords::{Keyword, Kind, abbreviated, keyword};
use crate::model::{Exact, Marker, MarkerOwner, Orientation, Part, PointMass};
use crate::reading::Reading;
use crate::source::Span;

const VECTOR: Kind = Kind::Reals(3, 3);
const FLEXIBLE: &str = "parts are rigid";
const SLIDING: &str = "markers are fixed on their parts; put a point on a curve with PTCV";
const RELATIVE: &str = "give its place and axes in the frame of the part";

pub(super) const PART_KEYWORDS: &[Keyword] = &[
    abbreviated("GROUND", "G", Kind::Flag),
    abbreviated("MASS", "M", Kind::Real),
    keyword("CM", Kind::Id),
    keyword("IM", Kind::Id),
    keyword("IP", Kind::Reals(3, 6)),
    abbreviated("QG", "Q", VECTOR),
    abbreviated("REULER", "R", VECTOR),
    keyword("ZG", VECTOR),
    keyword("XG", VECTOR),
    abbreviated("EXACT", "EX", Kind::Words),
    keyword("VX", Kind::Real),
    keyword("VY", Kind::Real),
    keyword("VZ", Kind::Real),
    keyword("WX", Kind::Real),
    keyword("WY", Kind::Real),
    keyword("WZ", Kind::Real),
    keyword("VM", Kind::Id),
    keyword("WM", Kind::Id),
    abbreviated("MATERIAL", "MAT", Kind::Text),
];

/// PART.
pub(super) fn part(reading: &mut Reading, builder: &mut Builder) {
    let ground = reading.has("GROUND");
    if ground {
        for keyword in ["MASS", "CM", "IM", "IP", "VX", "VY", "VZ", "WX", "WY", "WZ"] {
            if reading.has(keyword) {
                let message = format!("{keyword} of the ground has no effect");
                let span = reading.place(keyword);
                reading.diagnostics.note(Code::Ignored, span, message);
            }
        }
    }
    let mass = reading.not_negative("MASS");
    if !ground && mass.is_some_and(|mass| mass > 0.0) && !reading.has("CM") {
        let span = reading.place("MASS");
        let message = format!("{} has a mass but no CM", reading.label());
        reading
            .diagnostics
            .error(Code::MissingArgument, span, message)
            .help("add CM, the marker at the centre of mass");
    }
    let moments = reading.reals("IP");
    let inertia = match moments.len() {
        3 | 6 => {
            let mut values = [0.0; 6];
            for (value, (given, _)) in values.iter_mut().zip(moments) {
                *value = *given;
            }
            Some(values)
        }
        0 => None,
        _ => {
            let span = reading.place("IP");
            reading
                .diagnostics
                .error(Code::InvalidValue, span, "IP takes 3 or 6 numbers")
                .help("write IP = xx, yy, zz or IP = xx, yy, zz, xy, xz, yz");
            None
        }
    };
    if let Some(values) = inertia {
        inertia::check(reading, &values);
    }
    let orientation = orientation(reading, "ZG", "XG", reading.vector("QG"));
    let part = Part {
        header: reading.header(),
        ground,
        mass,
        cm: builder.refer(reading, "CM", Target::Marker),
        im: builder.refer(reading, "IM", Target::Marker),
        inertia,
        qg: reading.vector("QG").unwrap_or_default(),
        orientation,
        velocity: ["VX", "VY", "VZ"].map(|keyword| reading.real(keyword)),
        angular_velocity: ["WX", "WY", "WZ"].map(|keyword| reading.real(keyword)),
        vm: builder.refer(reading, "VM", Target::Marker),
        wm: builder.refer(reading, "WM", Target::Marker),
        exact: exact(reading),
        material: reading.text("MATERIAL"),
    };
    builder.last_body = Some((Target::Part, part.header.id));
    add(
        &mut builder.dataset.parts,
        part,
        reading.name,
        reading.diagnostics,
    );
}

pub(super) const POINT_MASS_KEYWORDS: &[Keyword] = &[
    abbreviated("MASS", "M", Kind::Real),
    keyword("CM", Kind::Id),
    abbreviated("QG", "Q", VECTOR),
    abbreviated("REULER", "R", VECTOR),
    keyword("ZG", VECTOR),
    keyword("XG", VECTOR),
    abbreviated("EXACT", "EX", Kind::Words),
    keyword("VX", Kind::Real),
    keyword("VY", Kind::Real),
    keyword("VZ", Kind::Real),
];

/// `POINT_MASS`.
pub(super) fn point_mass(reading: &mut Reading, builder: &mut Builder) {
    reading.require("MASS");
    reading.require("CM");
    let mass = reading.not_negative("MASS").unwrap_or(0.0);
    let orientation = orientation(reading, "ZG", "XG", reading.vector("QG"));
    let point_mass = PointMass {
        header: reading.header(),
        mass,
        cm: builder.refer(reading, "CM", Target::Marker),
        qg: reading.vector("QG").unwrap_or_default(),
        orientation,
        velocity: ["VX", "VY", "VZ"].map(|keyword| reading.real(keyword)),
        exact: exact(reading),
    };
    builder.last_body = Some((Target::PointMass, point_mass.header.id));
    let list = &mut builder.dataset.point_masses;
    add(list, point_mass, reading.name, reading.diagnostics);
}

pub(super) const MARKER_KEYWORDS: &[Keyword] = &[
    abbreviated("PART", "P", Kind::Id),
    abbreviated("POINT_MASS", "POI", Kind::Id),
    abbreviated("FLEX_BODY", "FLE", Kind::Unsupported(FLEXIBLE)),
    keyword("FE_PART", Kind::Unsupported(FLEXIBLE)),
    keyword("EXTERNAL_SYSTEM", Kind::Unsupported(FLEXIBLE)),
    // NODE is the name of NODE_ID in the old Fortran solver.
    keyword("NODE", Kind::Unsupported(FLEXIBLE)),
    abbreviated("NODE_ID", "NOD", Kind::Unsupported(FLEXIBLE)),
    keyword("NODE_LABEL", Kind::Unsupported(FLEXIBLE)),
    keyword("CURVE", Kind::Unsupported(SLIDING)),
    keyword("SURFACE", Kind::Unsupported(SLIDING)),
    keyword("VX", Kind::Unsupported(SLIDING)),
    keyword("VY", Kind::Unsupported(SLIDING)),
    keyword("VZ", Kind::Unsupported(SLIDING)),
    keyword("RM", Kind::Unsupported(RELATIVE)),
    abbreviated("FLOATING", "FLO", Kind::Flag),
    abbreviated("QP", "Q", VECTOR),
    abbreviated("REULER", "R", VECTOR),
    abbreviated("ZP", "Z", VECTOR),
    abbreviated("XP", "X", VECTOR),
    keyword("USEXP", Kind::Flag),
];

/// MARKER.
pub(super) fn marker(reading: &mut Reading, builder: &mut Builder) {
    let owners = [
        "PART",
        "POINT_MASS",
        "FLEX_BODY",
        "FE_PART",
        "EXTERNAL_SYSTEM",
        "CURVE",
        "SURFACE",
    ]
    .map(|name| (name, name));
    let owner = match reading.one_flag(&owners) {
        Some("PART") => {
            MarkerOwner::Part(builder.refer(reading, "PART", Target::Part).unwrap_or(0))
        }
        Some("POINT_MASS") => {
            let point_mass = builder.refer(reading, "POINT_MASS", Target::PointMass);
            MarkerOwner::PointMass(point_mass.unwrap_or(0))
        }
        Some(_) => MarkerOwner::Refused,
        None => body_before(reading, builder),
    };
    let orientation = orientation(reading, "ZP", "XP", reading.vector("QP"));
    let marker = Marker {
        header: reading.header(),
        owner,
        floating: reading.has("FLOATING"),
        qp: reading.vector("QP").unwrap_or_default(),
        orientation,
    };
    add(
        &mut builder.dataset.markers,
        marker,
        reading.name,
        reading.diagnostics,
    );
}

/// A marker that names no body belongs to the last one before it (Adams Solver, MARKER: PART).
fn body_before(reading: &mut Reading, builder: &mut Builder) -> MarkerOwner {
    let span = reading.head;
    let label = reading.label();
    let Some((target, id)) = builder.last_body else {
        let message = format!("{label} names no part, and there is none before it");
        reading
            .diagnostics
            .error(Code::MissingArgument, span, message)
            .help("add PART");
        return MarkerOwner::Part(0);
    };
    let body = target.statement();
    let message =
        format!("{label} names no part; it is put on {body}/{id}, the last one before it");
    reading
        .diagnostics
        .warning(Code::MissingArgument, span, message)
        .help(format!("write {body} = {id}"))
        .replace(Span::new(span.end, span.end), format!(", {body} = {id}"));
    builder.references.push(Reference { target, id, span });
    match target {
        Target::PointMass => MarkerOwner::PointMass(id),
        _ => MarkerOwner::Part(id),
    }
}

/// REULER, or the points on the axes, checked for points that define no axes.
fn orientation(
    reading: &mut Reading,
    z_name: &'static str,
    x_name: &'static str,
    origin: Option<[f64; 3]>,
) -> Orientation {
    reading.exclude("REULER", &[z_name, x_name, "USEXP"]);
    if let Some(angles) = reading.vector("REULER") {
        angles::check(reading, "REULER", 3);
        return Orientation::Euler(angles);
    }
    let (z, x) = (reading.vector(z_name), reading.vector(x_name));
    let use_x = reading.has("USEXP");
    if use_x && !reading.has(x_name) {
        reading.require(x_name);
    }
    if z.is_none() && x.is_none() {
        return Orientation::Identity;
    }
    let origin = origin.unwrap_or_default();
    let direction = |point: [f64; 3]| [0, 1, 2].map(|axis| point[axis] - origin[axis]);
    for (name, point) in [(z_name, z), (x_name, x)] {
        if point.is_some_and(|point| norm(direction(point)) == 0.0) {
            let span = reading.place(name);
            let message = format!("{name} is at the origin of the frame and gives no direction");
            reading
                .diagnostics
                .error(Code::DegenerateOrientation, span, message);
            return Orientation::Identity;
        }
    }
    if let (Some(z), Some(x)) = (z, x) {
        let (z, x) = (direction(z), direction(x));
        // An angle of 1e-9 leaves half of the digits of a double to the direction.
        if norm(cross(z, x)) <= 1e-9 * norm(z) * norm(x) {
            let span = reading.place(x_name);
            let message = format!("{z_name} and {x_name} lie on one line through the origin");
            reading
                .diagnostics
                .error(Code::DegenerateOrientation, span, message)
                .help(format!("move {x_name} off the z axis, into the xz plane"));
        }
    }
    Orientation::Points { z, x, use_x }
}

fn norm(a: [f64; 3]) -> f64 {
    a[0].hypot(a[1]).hypot(a[2])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// EXACT.
fn exact(reading: &mut Reading) -> Exact {
    let names = ["X", "Y", "Z", "PSI", "THETA", "PHI"];
    let choices = [0, 1, 2, 3, 4, 5].map(|index| (names[index], index));
    let given = reading.choices("EXACT", &choices).unwrap_or_default();
    let has = |index: usize| given.contains(&index);
    Exact {
        x: has(0),
        y: has(1),
        z: has(2),
        psi: has(3),
        theta: has(4),
        phi: has(5),
    }
}
