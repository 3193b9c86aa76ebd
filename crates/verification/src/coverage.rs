//! Which arguments of the `FRICTION` statement a claim verifies, and the table of all of them.

use friction::parameters::{JointType, PARAMETERS};

/// The two formulations of the statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Formulation {
    /// `FORMULATION=ORIGINAL`.
    Original,
    /// `FORMULATION=LUGRE`.
    LuGre,
}

impl Formulation {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Original, Self::LuGre];

    /// Word of the statement.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Original => "ORIGINAL",
            Self::LuGre => "LUGRE",
        }
    }
}

/// The joints that friction is defined for, with their words.
pub const JOINTS: [(JointType, &str); 6] = [
    (JointType::Translational, "TRANSLATIONAL"),
    (JointType::Revolute, "REVOLUTE"),
    (JointType::Cylindrical, "CYLINDRICAL"),
    (JointType::Spherical, "SPHERICAL"),
    (JointType::Hooke, "HOOKE"),
    (JointType::Universal, "UNIVERSAL"),
];

/// Arguments that a case verifies in a joint with a formulation.
#[derive(Clone, Copy, Debug)]
pub struct Coverage<'a> {
    /// The joint.
    pub joint: JointType,
    /// The formulation.
    pub formulation: Formulation,
    /// Keywords of the arguments.
    pub arguments: &'a [&'a str],
}

/// One cell of the table: joint, formulation and argument, each by its word.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cell {
    /// Word of the formulation.
    pub formulation: String,
    /// Keyword of the argument.
    pub argument: String,
    /// Word of the joint.
    pub joint: String,
}

impl Coverage<'_> {
    /// The cells.
    ///
    /// # Panics
    /// When an argument is none of the joint's with this formulation: the case would verify what
    /// does not exist.
    pub fn cells(&self) -> Vec<Cell> {
        let cells = self.arguments.iter().map(|argument| {
            let cell = cell(self.joint, self.formulation, argument);
            assert!(allowed(&cell), "{cell:?} is no argument of the statement");
            cell
        });
        cells.collect()
    }
}

fn cell(joint: JointType, formulation: Formulation, argument: &str) -> Cell {
    let word = JOINTS.iter().find(|(kind, _)| *kind == joint);
    Cell {
        formulation: formulation.word().into(),
        argument: argument.into(),
        joint: word.map_or("", |(_, word)| word).into(),
    }
}

/// Whether the statement has the argument in this joint with this formulation.
#[must_use]
pub fn allowed(cell: &Cell) -> bool {
    all().contains(cell)
}

/// Every cell that the statement allows: by formulation, argument in the order of the table of
/// arguments, and joint.
#[must_use]
pub fn all() -> Vec<Cell> {
    let mut cells = Vec::new();
    for formulation in Formulation::ALL {
        for parameter in &PARAMETERS {
            let used = parameter
                .formulation
                .is_none_or(|word| word == formulation.word());
            for (joint, _) in JOINTS.iter().filter(|_| used) {
                if parameter.joints.contains(joint) {
                    cells.push(cell(*joint, formulation, parameter.keyword));
                }
            }
        }
    }
    cells
}

/// Allowed cells that `covered` does not have.
///
/// ```
/// use verification::coverage::{all, missing};
/// let mut covered = all();
/// let removed = covered.remove(7);
/// assert_eq!(missing(&covered), [removed]);
/// ```
#[must_use]
pub fn missing(covered: &[Cell]) -> Vec<Cell> {
    let mut cells = all();
    cells.retain(|cell| !covered.contains(cell));
    cells
}
