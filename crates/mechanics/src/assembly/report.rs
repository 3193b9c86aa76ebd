//! What assembly did, or why it could not.

use crate::instant::not_a_number;
use crate::model::Label;

/// An equation found redundant and dropped.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Redundancy {
    /// The element that it belongs to.
    pub owner: Label,
    /// The equation, in terms of the axes of I and J.
    pub equation: String,
}

/// How far assembly moved a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// The body.
    pub body: Label,
    /// Displacement of its centre of mass.
    pub distance: f64,
    /// Rotation, radians.
    pub angle: f64,
}

/// How far assembly changed a body's velocity.
#[derive(Clone, Debug, PartialEq)]
pub struct VelocityChange {
    /// The body.
    pub body: Label,
    /// Change of the velocity of its centre of mass.
    pub linear: f64,
    /// Change of its angular velocity, radians per time.
    pub angular: f64,
}

/// A body that can move without any inertia against it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Massless {
    /// The body.
    pub body: Label,
    /// Whether it turns without inertia, rather than moves without mass.
    pub turns: bool,
}

/// What assembly did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Assembly {
    /// Bodies that were moved, beyond rounding.
    pub moved: Vec<Moved>,
    /// Bodies whose given velocities were changed, beyond rounding.
    pub velocity_changes: Vec<VelocityChange>,
    /// Equations that were dropped because they depend on others.
    pub redundant: Vec<Redundancy>,
    /// Bodies that can move although nothing with mass moves: only forces on them can say how.
    pub massless: Vec<Massless>,
    /// Frictions whose joint's reaction is not unique for that reason, by place in the model.
    pub not_unique: Vec<usize>,
    /// Iterations on the positions.
    pub iterations: usize,
}

/// A constraint equation that could not be met.
#[derive(Clone, Debug, PartialEq)]
pub struct Unmet {
    /// The element that it belongs to.
    pub owner: Label,
    /// The equation, in terms of the axes of I and J.
    pub equation: String,
    /// How far it is from being met: a length, an angle in radians, or their rate.
    pub error: f64,
    /// What the error is, for messages.
    pub quantity: &'static str,
}

impl std::fmt::Display for Unmet {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            owner,
            equation,
            error,
            quantity,
        } = self;
        write!(f, "{owner}, {equation}: off by {error:.3e} {quantity}")
    }
}

/// Assembly failed.
#[derive(Clone, Debug, PartialEq)]
pub enum AssemblyError {
    /// The constraints cannot be met together.
    Inconsistent {
        /// Equations that are not met in the positions given, the largest error first.
        given: Vec<Unmet>,
        /// Equations that are not met in the best positions found, the largest error first.
        unmet: Vec<Unmet>,
    },
    /// A joint's axes are opposite instead of co-directed.
    Opposite {
        /// The joint.
        joint: Label,
        /// Axis 0, 1 or 2 (x, y or z).
        axis: usize,
    },
    /// Velocities that the constraints prescribe contradict one another.
    Velocities {
        /// Elements whose equations are not met, with the error left, the largest first.
        unmet: Vec<Unmet>,
    },
    /// Numbers differ so much in size that nothing is left of some beside others.
    OutOfScale {
        /// The element where it shows.
        element: Option<Label>,
    },
    /// A function of time or displacement gives no number.
    NotANumber {
        /// The element.
        element: Option<Label>,
    },
}

impl std::fmt::Display for AssemblyError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let list = |unmet: &[Unmet]| {
            let lines: Vec<String> = unmet.iter().take(10).map(ToString::to_string).collect();
            lines.join("; ")
        };
        match self {
            Self::Inconsistent { given, unmet } => {
                write!(
                    f,
                    "the joints cannot be assembled; not met in the positions given: {}; not met in \
                     the best positions found: {}",
                    list(given),
                    list(unmet)
                )
            }
            Self::Opposite { joint, axis } => write!(
                f,
                "{joint} has opposite {0} axes of its I and J markers; they must point the same way",
                ["x", "y", "z"][*axis]
            ),
            Self::Velocities { unmet } => {
                write!(
                    f,
                    "the initial velocities contradict one another; not met: {}",
                    list(unmet)
                )
            }
            Self::OutOfScale { element } => {
                write!(f, "the numbers of the model differ too much in size")?;
                match element {
                    Some(element) => write!(f, "; it shows at {element}"),
                    None => Ok(()),
                }
            }
            Self::NotANumber { element } => {
                write!(f, "{} at the start", not_a_number(element.as_ref()))
            }
        }
    }
}

impl std::error::Error for AssemblyError {}

impl AssemblyError {
    /// The element that it is about, the likeliest where there are several.
    #[must_use]
    pub fn element(&self) -> Option<&Label> {
        match self {
            Self::Inconsistent { given, unmet } => {
                given.first().or(unmet.first()).map(|unmet| &unmet.owner)
            }
            Self::Opposite { joint, .. } => Some(joint),
            Self::Velocities { unmet } => unmet.first().map(|unmet| &unmet.owner),
            Self::OutOfScale { element } | Self::NotANumber { element } => element.as_ref(),
        }
    }
}
