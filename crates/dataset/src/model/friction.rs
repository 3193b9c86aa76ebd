//! FRICTION: friction in a joint; keywords, defaults, ranges and where they apply.

use super::{Header, JointKind};

/// Which law a friction follows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Formulation {
    /// Stick and slip by creep.
    #[default]
    Original,
    /// `LuGre`: one bristle state a direction.
    LuGre,
}

impl Formulation {
    /// The name in the dataset language.
    #[must_use]
    pub const fn keyword(self) -> &'static str {
        match self {
            Self::Original => "ORIGINAL",
            Self::LuGre => "LUGRE",
        }
    }
}

/// EFFECT: which regimes act.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Effect {
    /// Stiction and sliding.
    #[default]
    All,
    /// The static law only.
    Stiction,
    /// The dynamic law only.
    Sliding,
}

impl Effect {
    /// The name in the dataset language.
    #[must_use]
    pub const fn keyword(self) -> &'static str {
        match self {
            Self::All => "ALL",
            Self::Stiction => "STICTION",
            Self::Sliding => "SLIDING",
        }
    }
}

/// Which axis of a Hooke or universal joint a friction acts on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Yoke {
    /// `I_YOKE`.
    I,
    /// `J_YOKE`.
    J,
}

impl Yoke {
    /// The name in the dataset language.
    #[must_use]
    pub const fn keyword(self) -> &'static str {
        match self {
            Self::I => "I_YOKE",
            Self::J => "J_YOKE",
        }
    }
}

/// `OVERLAP_DELTA`: how the overlap of a sliding joint changes with its displacement.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OverlapDelta {
    /// It stays.
    #[default]
    Constant,
    /// It grows as I moves along `+z_J`.
    Increase,
    /// It shrinks as I moves along `+z_J`.
    Decrease,
}

impl OverlapDelta {
    /// The name in the dataset language.
    #[must_use]
    pub const fn keyword(self) -> &'static str {
        match self {
            Self::Constant => "CONSTANT",
            Self::Increase => "INCREASE",
            Self::Decrease => "DECREASE",
        }
    }
}

/// INPUTS: the loads that make friction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrictionInputs {
    /// PRELOAD.
    pub preload: bool,
    /// `REACTION_FORCE`.
    pub reaction_force: bool,
    /// `BENDING_MOMENT`.
    pub bending_moment: bool,
    /// `TORSIONAL_MOMENT`.
    pub torsional_moment: bool,
}

impl FrictionInputs {
    /// INPUTS=ALL, the default.
    pub const ALL: Self = Self {
        preload: true,
        reaction_force: true,
        bending_moment: true,
        torsional_moment: true,
    };
    /// INPUTS=NONE.
    pub const NONE: Self = Self {
        preload: false,
        reaction_force: false,
        bending_moment: false,
        torsional_moment: false,
    };
}

/// The dimension of a [`FrictionQuantity`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// A plain number.
    Number,
    /// Length.
    Length,
    /// Length per time.
    Velocity,
    /// Force.
    Force,
    /// Force times length.
    Torque,
    /// Force per length, of unit normal force.
    Stiffness,
    /// Force times time per length, of unit normal force.
    Damping,
}

impl Dimension {
    /// In words, for messages.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Number => "number",
            Self::Length => "length",
            Self::Velocity => "length/time",
            Self::Force => "force",
            Self::Torque => "force*length",
            Self::Stiffness => "force/length",
            Self::Damping => "force*time/length",
        }
    }
}

/// The least value of a [`FrictionQuantity`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Least {
    /// The value is greater than this.
    Above(f64),
    /// The value is at least this.
    From(f64),
}

impl Least {
    pub(crate) fn allows(self, value: f64) -> bool {
        match self {
            Self::Above(least) => value > least,
            Self::From(least) => value >= least,
        }
    }
}

macro_rules! quantities {
    ($($variant:ident $keyword:literal $default:literal $least:expr, $dimension:ident, ($joints:pat), ($formulation:pat);)*) => {
        /// A number of a FRICTION that has a default.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum FrictionQuantity { $(#[doc = concat!("`", $keyword, "`, default ", $default, ".")] $variant,)* }

        impl FrictionQuantity {
            /// Every quantity.
            pub const ALL: [Self; QUANTITIES] = [$(Self::$variant,)*];

            /// The name in the dataset language.
            #[must_use]
            pub const fn keyword(self) -> &'static str {
                match self { $(Self::$variant => $keyword,)* }
            }

            /// The value without the argument, a plain number in model units.
            #[must_use]
            pub const fn default_value(self) -> f64 {
                match self { $(Self::$variant => $default,)* }
            }

            /// Its dimension.
            #[must_use]
            pub const fn dimension(self) -> Dimension {
                match self { $(Self::$variant => Dimension::$dimension,)* }
            }

            pub(crate) const fn least(self) -> Least {
                match self { $(Self::$variant => $least,)* }
            }

            /// Whether friction in a joint of this kind uses it.
            #[must_use]
            pub const fn used_by(self, joint: JointKind) -> bool {
                use JointKind as J;
                match self { $(Self::$variant => matches!(joint, $joints),)* }
            }

            /// Whether this formulation uses it.
            #[must_use]
            pub const fn used_in(self, formulation: Formulation) -> bool {
                use Formulation as F;
                match self { $(Self::$variant => matches!(formulation, $formulation),)* }
            }
        }
    };
}

/// How many quantities there are.
const QUANTITIES: usize = 19;

quantities! {
    StictionTransitionVelocity "STICTION_TRANSITION_VELOCITY" 0.1 Least::Above(0.0), Velocity, (_), (F::Original);
    TransitionVelocityCoefficient "TRANSITION_VELOCITY_COEFFICIENT" 1.5 Least::Above(1.0), Number, (_), (F::Original);
    MaxStictionDeformation "MAX_STICTION_DEFORMATION" 0.01 Least::Above(0.0), Length, (_), (F::Original);
    FrictionForcePreload "FRICTION_FORCE_PRELOAD" 0.0 Least::From(0.0), Force, (J::Translational | J::Cylindrical), (_);
    FrictionTorquePreload "FRICTION_TORQUE_PRELOAD" 0.0 Least::From(0.0), Torque, (J::Revolute | J::Cylindrical | J::Spherical | J::Hooke | J::Universal), (_);
    MaxFrictionForce "MAX_FRICTION_FORCE" 1e40 Least::Above(0.0), Force, (J::Translational | J::Cylindrical), (_);
    MaxFrictionTorque "MAX_FRICTION_TORQUE" 1e40 Least::Above(0.0), Torque, (J::Revolute | J::Cylindrical | J::Spherical | J::Hooke | J::Universal), (_);
    ReactionArm "REACTION_ARM" 1.0 Least::Above(0.0), Length, (J::Translational), (_);
    InitialOverlap "INITIAL_OVERLAP" 1000.0 Least::Above(0.0), Length, (J::Translational | J::Cylindrical), (_);
    BendingFactor "BENDING_FACTOR" 1.0 Least::Above(0.0), Number, (J::Translational | J::Cylindrical), (_);
    PinRadius "PIN_RADIUS" 1.0 Least::Above(0.0), Length, (J::Revolute | J::Cylindrical | J::Hooke | J::Universal), (_);
    FrictionArm "FRICTION_ARM" 1.0 Least::Above(0.0), Length, (J::Revolute | J::Hooke | J::Universal), (_);
    BendingReactionArm "BENDING_REACTION_ARM" 1.0 Least::Above(0.0), Length, (J::Revolute | J::Hooke | J::Universal), (_);
    BallRadius "BALL_RADIUS" 1.0 Least::Above(0.0), Length, (J::Spherical), (_);
    BristleStiffnessCoefficient "BRISTLE_STIFFNESS_COEFFICIENT" 1e4 Least::Above(0.0), Stiffness, (_), (F::LuGre);
    DampingCoefficient "DAMPING_COEFFICIENT" 1e2 Least::From(0.0), Damping, (_), (F::LuGre);
    ViscousFrictionCoefficient "VISCOUS_FRICTION_COEFFICIENT" 0.0 Least::From(0.0), Damping, (_), (F::LuGre);
    VelocityThresholdStribeck "VELOCITY_THRESHOLD_STRIBECK" 1e-3 Least::Above(0.0), Velocity, (_), (F::LuGre);
    DecayExponentStribeck "DECAY_EXPONENT_STRIBECK" 2.0 Least::Above(0.0), Number, (_), (F::LuGre);
}

/// A default that a FRICTION uses because the argument is absent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DefaultInUse {
    /// The argument.
    pub quantity: FrictionQuantity,
    /// The default, a plain number in model units.
    pub value: f64,
}

impl DefaultInUse {
    /// Whether the default means another thing in another length unit: a length, velocity or
    /// stiffness that is neither zero nor the unlimited 1e40.
    #[must_use]
    pub fn depends_on_length_unit(self) -> bool {
        let dimensional = !matches!(
            self.quantity.dimension(),
            Dimension::Number | Dimension::Force
        );
        dimensional && self.value > 0.0 && self.value < 1e39
    }

    /// Whether the default means another thing in another time unit: a velocity or damping that
    /// is neither zero nor unlimited.
    #[must_use]
    pub fn depends_on_time_unit(self) -> bool {
        let timed = matches!(
            self.quantity.dimension(),
            Dimension::Velocity | Dimension::Damping
        );
        timed && self.depends_on_length_unit()
    }
}

/// FRICTION.
#[derive(Clone, Debug, PartialEq)]
pub struct Friction {
    /// Identifier, name and place.
    pub header: Header,
    /// JOINT: the id of the joint.
    pub joint: u32,
    /// `I_YOKE` or `J_YOKE`; given exactly for Hooke and universal joints.
    pub yoke: Option<Yoke>,
    /// FORMULATION.
    pub formulation: Formulation,
    /// `MU_STATIC`.
    pub mu_static: f64,
    /// `MU_DYNAMIC`.
    pub mu_dynamic: f64,
    /// EFFECT.
    pub effect: Effect,
    /// INPUTS.
    pub inputs: FrictionInputs,
    /// `OVERLAP_DELTA`.
    pub overlap_delta: OverlapDelta,
    /// INACTIVE=STATIC: no friction in static and quasi-static solutions.
    pub inactive_static: bool,
    /// The quantities given in the file; see [`Friction::value`].
    pub(crate) given: [Option<f64>; QUANTITIES],
}

impl Friction {
    /// A friction with every argument but these at its default.
    #[must_use]
    pub fn new(header: Header, joint: u32, mu_static: f64, mu_dynamic: f64) -> Self {
        Self {
            header,
            joint,
            yoke: None,
            formulation: Formulation::default(),
            mu_static,
            mu_dynamic,
            effect: Effect::default(),
            inputs: FrictionInputs::ALL,
            overlap_delta: OverlapDelta::default(),
            inactive_static: false,
            given: [None; QUANTITIES],
        }
    }

    /// The value in force: that of the file, else the default, in model units.
    #[must_use]
    pub fn value(&self, quantity: FrictionQuantity) -> f64 {
        self.given(quantity)
            .unwrap_or_else(|| quantity.default_value())
    }

    /// The value of the file.
    #[must_use]
    pub fn given(&self, quantity: FrictionQuantity) -> Option<f64> {
        self.given[quantity as usize]
    }

    /// Gives a quantity a value, as its argument would.
    pub fn set(&mut self, quantity: FrictionQuantity, value: f64) {
        self.given[quantity as usize] = Some(value);
    }

    /// What keeps this friction, in a joint of this kind, from using a quantity, in words such as
    /// `a REVOLUTE joint` or `INPUTS without PRELOAD`; `None` where it uses it.
    #[must_use]
    pub fn unused(&self, quantity: FrictionQuantity, joint: JointKind) -> Option<String> {
        use FrictionQuantity as Q;
        if !quantity.used_in(self.formulation) {
            return Some(format!("FORMULATION = {}", self.formulation.keyword()));
        }
        if !quantity.used_by(joint) {
            return Some(format!("a {} joint", joint.keyword()));
        }
        let by_effect = match self.effect {
            Effect::All => false,
            Effect::Stiction => quantity == Q::TransitionVelocityCoefficient,
            Effect::Sliding => matches!(
                quantity,
                Q::TransitionVelocityCoefficient | Q::MaxStictionDeformation
            ),
        };
        if by_effect {
            return Some(format!("EFFECT = {}", self.effect.keyword()));
        }
        let (input, on) = match quantity {
            Q::FrictionForcePreload | Q::FrictionTorquePreload => ("PRELOAD", self.inputs.preload),
            Q::FrictionArm => ("REACTION_FORCE", self.inputs.reaction_force),
            Q::InitialOverlap | Q::BendingFactor | Q::BendingReactionArm => {
                ("BENDING_MOMENT", self.inputs.bending_moment)
            }
            Q::ReactionArm => ("TORSIONAL_MOMENT", self.inputs.torsional_moment),
            _ => return None,
        };
        (!on).then(|| format!("INPUTS without {input}"))
    }

    /// The quantities that this friction, in a joint of this kind, uses and the file leaves at
    /// their defaults.
    #[must_use]
    pub fn defaults_in_use(&self, joint: JointKind) -> Vec<DefaultInUse> {
        FrictionQuantity::ALL
            .into_iter()
            .filter(|quantity| self.given(*quantity).is_none())
            .filter(|quantity| self.unused(*quantity, joint).is_none())
            .map(|quantity| DefaultInUse {
                quantity,
                value: quantity.default_value(),
            })
            .collect()
    }
}
