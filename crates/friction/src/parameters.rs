//! The arguments of the `FRICTION` statement: keyword, default, range, unit and the joints that use
//! them, as one table.
//!
//! Defaults are plain numbers in the units of the model, as in Adams: `STICTION_TRANSITION_VELOCITY`
//! is 0.1 m/s in a model in metres and 0.1 mm/s in one in millimetres.
//!
//! # Source
//! Help page of the `FRICTION` statement and of the run-time command of the same name. Preloads may
//! be zero although the help says "> 0": zero is their default.

use JointType::{Cylindrical, Hooke, Revolute, Spherical, Translational, Universal};

/// Joint types that friction is defined for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointType {
    /// `TRANSLATIONAL`.
    Translational,
    /// `REVOLUTE`.
    Revolute,
    /// `CYLINDRICAL`.
    Cylindrical,
    /// `SPHERICAL`.
    Spherical,
    /// `HOOKE`.
    Hooke,
    /// `UNIVERSAL`.
    Universal,
}

/// What an argument is when it is not given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DefaultValue {
    /// It must be given.
    Required,
    /// It stays absent.
    Absent,
    /// A number in model units.
    Number(f64),
    /// A word.
    Word(&'static str),
}

/// The values an argument may take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// A number greater than the bound.
    Above(f64),
    /// A number greater than or equal to the bound.
    AtLeast(f64),
    /// One of these words.
    OneOf(&'static [&'static str]),
    /// A list of these words, or `ALL` or `NONE`.
    ListOf(&'static [&'static str]),
    /// The id of a joint.
    JointId,
    /// No value: the keyword alone.
    Flag,
}

impl Range {
    /// Whether a number is finite and lies in the range; false for ranges that are not of numbers.
    pub fn contains(&self, value: f64) -> bool {
        match *self {
            Self::Above(bound) => value.is_finite() && value > bound,
            Self::AtLeast(bound) => value.is_finite() && value >= bound,
            Self::OneOf(_) | Self::ListOf(_) | Self::JointId | Self::Flag => false,
        }
    }
}

/// Physical dimension of an argument's number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// A plain number, or no number at all.
    One,
    /// Length.
    Length,
    /// Length/time.
    Velocity,
    /// Force.
    Force,
    /// Force * length.
    Torque,
    /// Force/length.
    Stiffness,
    /// Force * time/length.
    Damping,
}

/// One argument of the `FRICTION` statement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Full keyword in capitals.
    pub keyword: &'static str,
    /// Value when not given.
    pub default: DefaultValue,
    /// Legal values.
    pub range: Range,
    /// Physical dimension.
    pub dimension: Dimension,
    /// Joint types that use it; others ignore it.
    pub joints: &'static [JointType],
    /// The one formulation that uses it (`"ORIGINAL"` or `"LUGRE"`), or both (`None`).
    pub formulation: Option<&'static str>,
}

const EVERY: &[JointType] = &[
    Translational,
    Revolute,
    Cylindrical,
    Spherical,
    Hooke,
    Universal,
];
const SLIDING: &[JointType] = &[Translational, Cylindrical];
const TURNING: &[JointType] = &[Revolute, Cylindrical, Spherical, Hooke, Universal];
const WITH_PIN: &[JointType] = &[Revolute, Cylindrical, Hooke, Universal];
const WITH_PIN_ARMS: &[JointType] = &[Revolute, Hooke, Universal];
const WITH_YOKES: &[JointType] = &[Hooke, Universal];

/// The words of `INPUTS`, which joint types limit further (see [`inputs_of`]).
const INPUT_WORDS: &[&str] = &[
    "PRELOAD",
    "REACTION_FORCE",
    "BENDING_MOMENT",
    "TORSIONAL_MOMENT",
];

const fn number(
    keyword: &'static str,
    default: f64,
    range: Range,
    dimension: Dimension,
    joints: &'static [JointType],
    formulation: Option<&'static str>,
) -> Parameter {
    let default = DefaultValue::Number(default);
    Parameter {
        keyword,
        default,
        range,
        dimension,
        joints,
        formulation,
    }
}

const fn required(keyword: &'static str, range: Range) -> Parameter {
    let (default, dimension) = (DefaultValue::Required, Dimension::One);
    Parameter {
        keyword,
        default,
        range,
        dimension,
        joints: EVERY,
        formulation: None,
    }
}

const fn choice(
    keyword: &'static str,
    default: DefaultValue,
    range: Range,
    joints: &'static [JointType],
    formulation: Option<&'static str>,
) -> Parameter {
    Parameter {
        keyword,
        default,
        range,
        dimension: Dimension::One,
        joints,
        formulation,
    }
}

const POSITIVE: Range = Range::Above(0.0);
const NOT_NEGATIVE: Range = Range::AtLeast(0.0);
const ORIGINAL: Option<&str> = Some("ORIGINAL");
const LUGRE: Option<&str> = Some("LUGRE");

/// Every argument of the `FRICTION` statement.
///
/// ```
/// use friction::parameters::{PARAMETERS, DefaultValue};
/// let overlap = PARAMETERS.iter().find(|p| p.keyword == "INITIAL_OVERLAP").unwrap();
/// assert_eq!(overlap.default, DefaultValue::Number(1000.0));
/// assert!(!overlap.range.contains(0.0));
/// ```
#[rustfmt::skip]
pub const PARAMETERS: [Parameter; 29] = [
    required("JOINT", Range::JointId),
    choice("I_YOKE", DefaultValue::Absent, Range::Flag, WITH_YOKES, None),
    choice("J_YOKE", DefaultValue::Absent, Range::Flag, WITH_YOKES, None),
    choice("FORMULATION", DefaultValue::Word("ORIGINAL"), Range::OneOf(&["ORIGINAL", "LUGRE"]), EVERY, None),
    required("MU_STATIC", POSITIVE),
    required("MU_DYNAMIC", POSITIVE),
    number("STICTION_TRANSITION_VELOCITY", 0.1, POSITIVE, Dimension::Velocity, EVERY, ORIGINAL),
    number("TRANSITION_VELOCITY_COEFFICIENT", 1.5, Range::Above(1.0), Dimension::One, EVERY, ORIGINAL),
    number("MAX_STICTION_DEFORMATION", 0.01, POSITIVE, Dimension::Length, EVERY, ORIGINAL),
    choice("EFFECT", DefaultValue::Word("ALL"), Range::OneOf(&["ALL", "STICTION", "SLIDING"]), EVERY, ORIGINAL),
    choice("INPUTS", DefaultValue::Word("ALL"), Range::ListOf(INPUT_WORDS), EVERY, None),
    choice("INACTIVE", DefaultValue::Absent, Range::OneOf(&["STATIC"]), EVERY, None),
    number("FRICTION_FORCE_PRELOAD", 0.0, NOT_NEGATIVE, Dimension::Force, SLIDING, None),
    number("FRICTION_TORQUE_PRELOAD", 0.0, NOT_NEGATIVE, Dimension::Torque, TURNING, None),
    number("MAX_FRICTION_FORCE", 1e40, POSITIVE, Dimension::Force, SLIDING, None),
    number("MAX_FRICTION_TORQUE", 1e40, POSITIVE, Dimension::Torque, TURNING, None),
    number("REACTION_ARM", 1.0, POSITIVE, Dimension::Length, &[Translational], None),
    number("INITIAL_OVERLAP", 1000.0, POSITIVE, Dimension::Length, SLIDING, None),
    choice("OVERLAP_DELTA", DefaultValue::Word("CONSTANT"), Range::OneOf(&["INCREASE", "DECREASE", "CONSTANT"]), SLIDING, None),
    number("BENDING_FACTOR", 1.0, POSITIVE, Dimension::One, SLIDING, None),
    number("PIN_RADIUS", 1.0, POSITIVE, Dimension::Length, WITH_PIN, None),
    number("FRICTION_ARM", 1.0, POSITIVE, Dimension::Length, WITH_PIN_ARMS, None),
    number("BENDING_REACTION_ARM", 1.0, POSITIVE, Dimension::Length, WITH_PIN_ARMS, None),
    number("BALL_RADIUS", 1.0, POSITIVE, Dimension::Length, &[Spherical], None),
    number("BRISTLE_STIFFNESS_COEFFICIENT", 1e4, POSITIVE, Dimension::Stiffness, EVERY, LUGRE),
    number("DAMPING_COEFFICIENT", 1e2, NOT_NEGATIVE, Dimension::Damping, EVERY, LUGRE),
    number("VISCOUS_FRICTION_COEFFICIENT", 0.0, NOT_NEGATIVE, Dimension::Damping, EVERY, LUGRE),
    number("VELOCITY_THRESHOLD_STRIBECK", 1e-3, POSITIVE, Dimension::Velocity, EVERY, LUGRE),
    number("DECAY_EXPONENT_STRIBECK", 2.0, POSITIVE, Dimension::One, EVERY, LUGRE),
];

/// The words of `INPUTS` that a joint type accepts.
///
/// ```
/// use friction::parameters::{JointType, inputs_of};
/// assert_eq!(inputs_of(JointType::Spherical), ["PRELOAD", "REACTION_FORCE"]);
/// ```
pub fn inputs_of(joint: JointType) -> &'static [&'static str] {
    match joint {
        Translational => INPUT_WORDS,
        Revolute | Cylindrical | Hooke | Universal => &INPUT_WORDS[..3],
        Spherical => &INPUT_WORDS[..2],
    }
}
