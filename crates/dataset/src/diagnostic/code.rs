//! What messages are about: one table of stable names, what they mean and the cure.

use serde::{Deserialize, Serialize};

use crate::names;

macro_rules! codes {
    ($($(#[doc = $meaning:literal])* $variant:ident = $text:literal, $cure:literal;)*) => {
        /// What a [`Diagnostic`](super::Diagnostic) is about; its text is stable and fit for filters.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
        pub enum Code { $($(#[doc = $meaning])* $variant,)* }

        impl Code {
            /// Every code.
            pub const ALL: &[Self] = &[$(Self::$variant,)*];

            /// The stable text of this code, for example `unknown-statement`.
            #[must_use]
            pub const fn as_str(self) -> &'static str {
                match self { $(Self::$variant => $text,)* }
            }

            /// What it means, in sentences.
            #[must_use]
            pub const fn meaning(self) -> &'static str {
                match self { $(Self::$variant => concat!($($meaning),*),)* }
            }

            /// What to do about it, in sentences.
            #[must_use]
            pub const fn cure(self) -> &'static str {
                match self { $(Self::$variant => $cure,)* }
            }
        }
    };
}

impl Code {
    /// The code of this text.
    ///
    /// ```
    /// use dataset::Code;
    /// assert_eq!(Code::named("unknown-statement"), Some(Code::UnknownStatement));
    /// assert_eq!(Code::named("unknown"), None);
    /// ```
    #[must_use]
    pub fn named(text: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|code| code.as_str() == text)
    }

    /// The code whose text is a few letters from this one.
    ///
    /// ```
    /// use dataset::Code;
    /// assert_eq!(Code::nearest("unkown-statement"), Some(Code::UnknownStatement));
    /// assert_eq!(Code::nearest("weather"), None);
    /// ```
    #[must_use]
    pub fn nearest(text: &str) -> Option<Self> {
        names::nearest(text, Self::ALL.iter().map(|code| code.as_str())).and_then(Self::named)
    }
}

// Meaning, name of the variant, stable text, cure. The order is that of the documentation.
codes! {
    // The file.
    /// The file holds so many control characters that it is not text.
    NotText = "not-text", "Name the dataset (`.adm`) or command file (`.acf`), which are plain text.";
    /// The file is larger than 4 GB.
    TooLarge = "too-large", "Split the file, or take texts of graphics out of it.";
    /// The file cannot be read: it is not there, or it may not be opened.
    MissingFile = "missing-file", "Name a file that is there; a file named by a command is looked for beside the command file.";
    /// The dataset holds no statement.
    Empty = "empty", "The first line of a dataset is its title; statements follow it.";
    /// A command file is read as a dataset, or the other way round.
    WrongFileType = "wrong-file-type", "Give a dataset the extension `.adm` and a command file the extension `.acf`.";
    /// A command file comes to a command, or to its end, without any model.
    NoModel = "no-model", "Write `FILE/MODEL=name` before the first command that needs the model.";
    /// A command file calls itself, or a file that calls it, which would never end.
    RepeatedFile = "repeated-file", "Take out the FILE/COMMAND that leads back to a file that is still being read.";
    /// More messages than are shown.
    TooMany = "too-many", "Correct the first ones; often the others follow from them.";

    // The text.
    /// The text breaks the rules of the language.
    Syntax = "syntax", "Write `NAME/id, ARGUMENT=value, ...`; lines that start with a comma continue the statement.";
    /// The first line, which is the title, looks like a statement; it is not read as one.
    TitleIsStatement = "title-is-statement", "Put a title line, which may be empty, before it.";
    /// No statement or command has this name.
    UnknownStatement = "unknown-statement", "Correct the name; for an argument of the statement above, start the line with a comma.";
    /// An abbreviation that fits several names.
    AmbiguousName = "ambiguous-name", "Write more letters of the name.";
    /// The statement has no argument of this name.
    UnknownArgument = "unknown-argument", "Correct the name of the argument.";
    /// An argument is given twice; only the first one is read.
    DuplicateArgument = "duplicate-argument", "Remove one of them.";
    /// A required argument is missing.
    MissingArgument = "missing-argument", "Add the argument.";
    /// Arguments that exclude each other.
    ConflictingArguments = "conflicting-arguments", "Keep one of them.";
    /// A value of the wrong type or number.
    InvalidValue = "invalid-value", "Write the value as the message says.";
    /// A value outside its range.
    OutOfRange = "out-of-range", "Give a value in the range that the message names.";
    /// An identifier is missing or malformed.
    InvalidId = "invalid-id", "Write a whole number from 1 on behind the slash.";
    /// An identifier is used twice by statements of one type.
    DuplicateId = "duplicate-id", "Give one of the two elements another number, and correct the references to it.";
    /// A statement that may occur once occurs again.
    DuplicateStatement = "duplicate-statement", "Merge the two statements.";

    // What is not simulated.
    /// A statement or command of the language that is not simulated.
    UnsupportedStatement = "unsupported-statement", "Remove the statement, or put elements in its place that are simulated.";
    /// An argument of the language that is not simulated.
    UnsupportedArgument = "unsupported-argument", "Remove the argument, or say the same in another way.";
    /// A function of the language that is not simulated, or not in this place.
    UnsupportedFunction = "unsupported-function", "Write the function with others.";
    /// A statement or argument without effect here, which cannot change the motion.
    Ignored = "ignored", "Nothing has to be done; remove it, or allow this code.";

    // Expressions.
    /// An expression that cannot be understood.
    Expression = "expression", "Correct the expression at the place that is marked.";
    /// No run-time function has this name.
    UnknownFunction = "unknown-function", "Correct the name of the function.";
    /// A function with too few or too many arguments.
    ArgumentCount = "argument-count", "Give the function the arguments that it takes.";
    /// A variable whose definition is its own value and nothing else, so that it can be anything.
    CircularVariables = "circular-variables", "Give the variable an equation: a function of other things, or one that its value solves.";
    /// INVPSD makes a signal of random phases, which every program draws in its own way.
    RandomPhases = "random-phases", "Nothing, unless runs of different programs are to be compared: then give the signal as a SPLINE.";

    // The model.
    /// A reference to an element that does not exist.
    MissingElement = "missing-element", "Correct the number, or add the element.";
    /// No part, or more than one, is the ground.
    Ground = "ground", "Give exactly one PART the argument GROUND.";
    /// Mass or inertia that no body can have: a principal moment above the sum of the other two, or a negative one. As a warning the value is used as it is given.
    ImpossibleInertia = "impossible-inertia", "Check the order xx, yy, zz, xy, xz, yz, the signs of the products and the units.";
    /// An orientation given by points that define no axes.
    DegenerateOrientation = "degenerate-orientation", "Move the points apart, off one line through the origin of the frame.";
    /// A joint or force whose ends cannot be joined this way.
    InvalidConnection = "invalid-connection", "Name markers on two different parts, as the element needs them.";
    /// The acceleration of gravity is that of the earth in another unit of length, such as 9.81 in a model in millimetres.
    GravityUnit = "gravity-unit", "Give ACCGRAV in the length and time of UNITS: 9806.65 mm/s^2, 9.80665 m/s^2 or 386.09 in/s^2.";
    /// A model with friction has no ACCGRAV: nothing has weight, and no weight loads the friction.
    NoGravity = "no-gravity", "Add ACCGRAV; where there is no gravity, ACCGRAV/KGRAV=0 says so.";
    /// An angle above a full turn in radians that is a round number of degrees, without the `D` that means degrees.
    DegreesWithoutD = "degrees-without-d", "Write `90D` for ninety degrees.";
    /// Markers that nothing uses: not a joint, force, function, request or graphic. A reference that names another marker by mistake leaves such a marker behind.
    UnusedMarker = "unused-marker", "Check whether a reference should name one of them; else remove them, or allow this code.";
    /// A part without mass or inertia that can move although nothing with mass moves: no law of motion says how.
    MasslessPart = "massless-part", "Give the part mass and inertia, or join it with a FIXED joint.";
    /// A motion or coupler on a freedom that the joint does not have.
    NoSuchFreedom = "no-such-freedom", "Name a freedom that the joint has.";
    /// An element that rests because its joint is deactivated.
    Deactivated = "deactivated", "Activate the joint as well, or leave the element out.";
    /// A change of an element that a command cannot make.
    InvalidChange = "invalid-change", "Change the dataset instead.";

    // Friction.
    /// FRICTION on a joint without friction, with the wrong yoke, or on an axis that has one already.
    FrictionJoint = "friction-joint", "Put friction on a REVOLUTE, TRANSLATIONAL, CYLINDRICAL, SPHERICAL, HOOKE or UNIVERSAL joint; with I_YOKE or J_YOKE on the last two.";
    /// A friction argument that this joint or formulation does not use.
    UnusedArgument = "unused-argument", "Remove the argument, or choose the joint or formulation that uses it.";
    /// The coefficient of static friction is below that of dynamic friction: friction would be weaker at rest than in motion.
    StaticBelowDynamic = "static-below-dynamic", "Exchange the two coefficients, or make them equal.";
    /// A default that is a plain number, meant for millimetres and seconds, in a model with other units. A transition velocity of 0.1 is slow in mm/s and fast in m/s.
    DimensionalDefault = "dimensional-default", "Give the arguments in the units of the model.";
    /// INPUTS or EFFECT of a FRICTION leaves out a part of the friction that its joint has: a load that makes none, or the regime of stiction or of sliding.
    SwitchedOff = "switched-off", "Leave INPUTS and EFFECT out where the whole friction is meant; else allow this code.";
    /// A FRICTION that is zero whatever happens, because no load of its joint makes friction.
    NoFriction = "no-friction", "Add the loads to INPUTS, give the preload, or remove the FRICTION.";
    /// A FRICTION in a joint whose motion is prescribed: it cannot change that motion and shows in the force of the MOTION only.
    PrescribedFriction = "prescribed-friction", "Read the friction in the torque of the MOTION; or drive the joint by a force, which friction resists.";
    /// A FRICTION whose surfaces have moved far and never faster than `STICTION_TRANSITION_VELOCITY`: all that time the joint was in stiction, `MU_DYNAMIC` had no part in it, and the creep of the law takes the place of motion.
    NeverSlides = "never-slides", "Give STICTION_TRANSITION_VELOCITY (in the units of the model) a value well below the speeds of the surfaces.";
    /// The reaction that loads a friction is not unique, because constraints of the model are redundant: another choice of the equations that are left out gives another friction.
    ReactionNotUnique = "reaction-not-unique", "Replace joints by such that constrain the mechanism once, as a HOOKE, SPHERICAL or INLINE for a REVOLUTE.";

    // Runs.
    /// The initial conditions cannot be met.
    Assembly = "assembly", "Give positions, velocities and functions that fit the joints and one another.";
    /// No equilibrium is found.
    Equilibrium = "equilibrium", "Start nearer to the equilibrium, hold free freedoms with springs, or simulate the motion with damping.";
    /// The integration cannot go on.
    Integration = "integration", "Look at the element that is named; smooth functions that jump, and give every moving part a mass.";
    /// The friction that a load causes adds more to that load than there was: the joint jams, and no motion obeys Coulomb's law.
    Jam = "jam", "Lower the coefficient, lengthen the guide or move the force nearer to it; a real mechanism jams there, too.";
    /// SIMULATE/KINEMATIC of a model with degrees of freedom, or SIMULATE/DYNAMIC of one without.
    NotKinematic = "not-kinematic", "Drive every freedom with a MOTION, or write SIMULATE/DYNAMIC; without freedoms write SIMULATE/KINEMATIC.";
    /// A state that cannot be saved or reloaded: the file is missing, damaged, or of another model or version.
    SavedSystem = "saved-system", "Name a file that SAVE/SYSTEM has written, with the dataset that it was saved of.";
    /// Equations that were left out as redundant do not hold any more: joints or motions contradict one another.
    RedundantBroken = "redundant-broken", "Remove the redundant constraints that the message names.";
    /// A sliding joint has left its guide: its overlap is used up, and a thousandth of it is kept.
    OverlapUsedUp = "overlap-used-up", "Give INITIAL_OVERLAP the length of the guide, or stop the motion before its end.";
    /// Reactions at outputs are those of the step around them, because the instant had no solution.
    StepReactions = "step-reactions", "Lower DAMPING_COEFFICIENT, so that the bristles are passive.";
    /// A function jumps to and fro, because on both sides of the jump it pushes the motion back. The motion is held there, with a value between those of the two sides.
    Chatter = "chatter", "Nothing, where dry friction or a relay is meant; a FRICTION statement, or a STEP of the argument, says the same with a width of your own.";
    /// Stiff equations (bristles, stick, stiff springs, contacts) keep the steps of ABAM short, not the motion; or steps of ABAM, HHT, NEWMARK or GSTIFF, I3 have no solution again and again, because bristles are not passive. The run goes on with GSTIFF, SI2.
    Stiff = "stiff", "Use INTEGRATOR/GSTIFF, SI2, which need not find out first; lower DAMPING_COEFFICIENT of bristles that are not passive.";
    /// LUGRE lets a joint creep under a load that it should hold.
    BristleDrift = "bristle-drift", "Use FORMULATION=ORIGINAL where a joint has to hold.";
    /// The damping of the bristles of LUGRE may give energy back to the motion.
    BristlesNotPassive = "bristles-not-passive", "Lower DAMPING_COEFFICIENT.";
    /// More energy is unaccounted for than the error of the integrator explains.
    EnergyBalance = "energy-balance", "Give INTEGRATOR a smaller ERROR.";
    /// Compared with a second run with a tenth of ERROR (none with `--unchecked`), a body is off by more than a hundred times ERROR, which is that of a step.
    Inaccurate = "inaccurate", "Give INTEGRATOR a smaller ERROR; read peaks, energies and periods only where that does not help.";
    /// The second run, with a tenth of ERROR, which tells how accurate a run is, has failed or taken too many steps, or has other outputs, so that not all of the run is compared with it.
    AccuracyUnknown = "accuracy-unknown", "Give INTEGRATOR a smaller ERROR, with which events of both runs come at the same outputs; cure what the second run failed of.";

    // Studies.
    /// A study file that cannot be used: it is no TOML, a name in it is unknown, or a number is out of its range.
    StudyFile = "study-file", "Write it as docs/studies.md shows; the message names what is wrong and what may be meant.";
}
