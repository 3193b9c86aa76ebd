//! The run-time functions: names, numbers and kinds of arguments, in one table.

/// The type of statement that an argument names by id.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementKind {
    /// JOINT.
    Joint,
    /// JPRIM.
    Primitive,
    /// MOTION.
    Motion,
    /// SFORCE.
    SingleForce,
    /// SPRINGDAMPER.
    SpringDamper,
    /// VFORCE.
    VectorForce,
    /// VTORQUE.
    VectorTorque,
    /// GFORCE.
    GeneralForce,
    /// BUSHING.
    Bushing,
    /// FIELD.
    Field,
    /// BEAM.
    Beam,
    /// SPLINE.
    Spline,
    /// VARIABLE.
    Variable,
    /// DIFF.
    Differential,
    /// FRICTION.
    Friction,
    /// PINPUT.
    PlantInput,
    /// POUTPUT.
    PlantOutput,
    /// An element that datasets read by stiction cannot have; its functions are not simulated.
    Other,
}

/// What an argument of a function is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArgumentKind {
    /// An expression.
    Real,
    /// A whole number.
    Integer,
    /// The order of a derivative: 0, 1 or 2.
    Order,
    /// The id of a marker.
    Marker,
    /// The id of a marker, or 0 for the ground.
    MarkerOrGround,
    /// The id of an element.
    Element(ElementKind),
}

use ArgumentKind::{Element, Integer, Marker, MarkerOrGround, Order, Real};
use ElementKind as E;

macro_rules! functions {
    ($($variant:ident $name:literal $minimum:literal [$($kind:expr),*] $maximum:literal;)*) => {
        /// A run-time function.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Function { $(#[doc = concat!("`", $name, "`.")] $variant,)* }

        impl Function {
            /// Every function.
            pub const ALL: &[Self] = &[$(Self::$variant,)*];

            /// The name in the dataset language.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }

            /// The least and the greatest number of arguments.
            #[must_use]
            pub const fn argument_count(self) -> (usize, usize) {
                match self { $(Self::$variant => ($minimum, $maximum),)* }
            }

            /// The kinds of the arguments; the last one stands for all that follow.
            const fn kinds(self) -> &'static [ArgumentKind] {
                match self { $(Self::$variant => &[$($kind),*],)* }
            }
        }
    };
}

impl Function {
    /// The kind of the argument at `position`, counted from 0.
    ///
    /// ```
    /// use dataset::{ArgumentKind, Function};
    /// assert_eq!(Function::Dx.argument_kind(0), ArgumentKind::Marker);
    /// assert_eq!(Function::Step.argument_kind(4), ArgumentKind::Real);
    /// ```
    #[must_use]
    pub const fn argument_kind(self, position: usize) -> ArgumentKind {
        let kinds = self.kinds();
        match kinds.len() {
            0 => Real,
            count if position < count => kinds[position],
            count => kinds[count - 1],
        }
    }

    /// The function of this name, in any case.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL
            .iter()
            .copied()
            .find(|function| function.name().eq_ignore_ascii_case(name))
    }
}

// name, least number of arguments, kinds (the last one repeats), greatest number of arguments
functions! {
    // Displacements of marker i relative to j, along or about the axes of k.
    Dx "DX" 1 [Marker, MarkerOrGround] 3;
    Dy "DY" 1 [Marker, MarkerOrGround] 3;
    Dz "DZ" 1 [Marker, MarkerOrGround] 3;
    Dm "DM" 1 [Marker, MarkerOrGround] 2;
    Ax "AX" 1 [Marker, MarkerOrGround] 2;
    Ay "AY" 1 [Marker, MarkerOrGround] 2;
    Az "AZ" 1 [Marker, MarkerOrGround] 2;
    Psi "PSI" 1 [Marker, MarkerOrGround] 2;
    Theta "THETA" 1 [Marker, MarkerOrGround] 2;
    Phi "PHI" 1 [Marker, MarkerOrGround] 2;
    Yaw "YAW" 1 [Marker, MarkerOrGround] 2;
    Pitch "PITCH" 1 [Marker, MarkerOrGround] 2;
    Roll "ROLL" 1 [Marker, MarkerOrGround] 2;
    Incang "INCANG" 3 [Marker] 3;
    Orient "ORIENT" 3 [Integer, Integer, Marker, MarkerOrGround] 4;
    // Velocities.
    Vx "VX" 1 [Marker, MarkerOrGround] 4;
    Vy "VY" 1 [Marker, MarkerOrGround] 4;
    Vz "VZ" 1 [Marker, MarkerOrGround] 4;
    Vm "VM" 1 [Marker, MarkerOrGround] 3;
    Vr "VR" 1 [Marker, MarkerOrGround] 3;
    Wx "WX" 1 [Marker, MarkerOrGround] 3;
    Wy "WY" 1 [Marker, MarkerOrGround] 3;
    Wz "WZ" 1 [Marker, MarkerOrGround] 3;
    Wm "WM" 1 [Marker, MarkerOrGround] 2;
    // Accelerations.
    Accx "ACCX" 1 [Marker, MarkerOrGround] 4;
    Accy "ACCY" 1 [Marker, MarkerOrGround] 4;
    Accz "ACCZ" 1 [Marker, MarkerOrGround] 4;
    Accm "ACCM" 1 [Marker, MarkerOrGround] 3;
    Wdtx "WDTX" 1 [Marker, MarkerOrGround] 4;
    Wdty "WDTY" 1 [Marker, MarkerOrGround] 4;
    Wdtz "WDTZ" 1 [Marker, MarkerOrGround] 4;
    Wdtm "WDTM" 1 [Marker, MarkerOrGround] 3;
    // Total forces at i of the elements between i and j, along the axes of k.
    Fx "FX" 1 [Marker, MarkerOrGround] 3;
    Fy "FY" 1 [Marker, MarkerOrGround] 3;
    Fz "FZ" 1 [Marker, MarkerOrGround] 3;
    Fm "FM" 1 [Marker, MarkerOrGround] 2;
    Tx "TX" 1 [Marker, MarkerOrGround] 3;
    Ty "TY" 1 [Marker, MarkerOrGround] 3;
    Tz "TZ" 1 [Marker, MarkerOrGround] 3;
    Tm "TM" 1 [Marker, MarkerOrGround] 2;
    // Vectors.
    Uvx "UVX" 1 [Marker] 1;
    Uvy "UVY" 1 [Marker] 1;
    Uvz "UVZ" 1 [Marker] 1;
    Uv "UV" 1 [Real] 1;
    Mag "MAG" 1 [Real] 1;
    Trans "TRANS" 2 [Real, MarkerOrGround] 3;
    Dxyz "DXYZ" 1 [Marker, MarkerOrGround] 3;
    Vxyz "VXYZ" 1 [Marker, MarkerOrGround] 4;
    Wxyz "WXYZ" 1 [Marker, MarkerOrGround] 3;
    Accxyz "ACCXYZ" 1 [Marker, MarkerOrGround] 4;
    Fxyz "FXYZ" 1 [Marker, MarkerOrGround] 3;
    Txyz "TXYZ" 1 [Marker, MarkerOrGround] 3;
    // One component of the force of one element: id, 0 on I or 1 on J, component, axes.
    Joint "JOINT" 3 [Element(E::Joint), Integer, Integer, MarkerOrGround] 4;
    Jprim "JPRIM" 3 [Element(E::Primitive), Integer, Integer, MarkerOrGround] 4;
    Motion "MOTION" 3 [Element(E::Motion), Integer, Integer, MarkerOrGround] 4;
    Sforce "SFORCE" 3 [Element(E::SingleForce), Integer, Integer, MarkerOrGround] 4;
    Spdp "SPDP" 3 [Element(E::SpringDamper), Integer, Integer, MarkerOrGround] 4;
    Ptcv "PTCV" 3 [Element(E::Other), Integer, Integer, MarkerOrGround] 4;
    Cvcv "CVCV" 3 [Element(E::Other), Integer, Integer, MarkerOrGround] 4;
    Vforce "VFORCE" 3 [Element(E::VectorForce), Integer, Integer, MarkerOrGround] 4;
    Vtorq "VTORQ" 3 [Element(E::VectorTorque), Integer, Integer, MarkerOrGround] 4;
    Gforce "GFORCE" 3 [Element(E::GeneralForce), Integer, Integer, MarkerOrGround] 4;
    Nforce "NFORCE" 3 [Element(E::Other), Integer, Integer, MarkerOrGround] 4;
    Bush "BUSH" 3 [Element(E::Bushing), Integer, Integer, MarkerOrGround] 4;
    Field "FIELD" 3 [Element(E::Field), Integer, Integer, MarkerOrGround] 4;
    Beam "BEAM" 3 [Element(E::Beam), Integer, Integer, MarkerOrGround] 4;
    Contact "CONTACT" 3 [Element(E::Other), Integer, Integer, MarkerOrGround] 4;
    Friction "FRICTION" 2 [Element(E::Friction), Integer] 2;
    // Elements.
    Varval "VARVAL" 1 [Element(E::Variable)] 1;
    Aryval "ARYVAL" 2 [Element(E::Other), Integer] 2;
    Dif "DIF" 1 [Element(E::Differential)] 1;
    Dif1 "DIF1" 1 [Element(E::Differential)] 1;
    Pinval "PINVAL" 2 [Element(E::PlantInput), Integer] 2;
    Pouval "POUVAL" 2 [Element(E::PlantOutput), Integer] 2;
    Senval "SENVAL" 1 [Element(E::Other)] 1;
    // Mathematics; angles in radians.
    Abs "ABS" 1 [Real] 1;
    Acos "ACOS" 1 [Real] 1;
    Aint "AINT" 1 [Real] 1;
    Anint "ANINT" 1 [Real] 1;
    Asin "ASIN" 1 [Real] 1;
    Atan "ATAN" 1 [Real] 1;
    Atan2 "ATAN2" 2 [Real] 2;
    Cos "COS" 1 [Real] 1;
    Cosh "COSH" 1 [Real] 1;
    Dim "DIM" 2 [Real] 2;
    Exp "EXP" 1 [Real] 1;
    Log "LOG" 1 [Real] 1;
    Log10 "LOG10" 1 [Real] 1;
    Max "MAX" 2 [Real] 2;
    Min "MIN" 2 [Real] 2;
    Mod "MOD" 2 [Real] 2;
    Sign "SIGN" 2 [Real] 2;
    Sin "SIN" 1 [Real] 1;
    Sinh "SINH" 1 [Real] 1;
    Sqrt "SQRT" 1 [Real] 1;
    Tan "TAN" 1 [Real] 1;
    Tanh "TANH" 1 [Real] 1;
    If "IF" 4 [Real] 4;
    // Transitions, contacts and series.
    Step "STEP" 5 [Real] 5;
    Step5 "STEP5" 5 [Real] 5;
    Havsin "HAVSIN" 5 [Real] 5;
    Impact "IMPACT" 7 [Real] 7;
    Bistop "BISTOP" 8 [Real] 8;
    Poly "POLY" 3 [Real] 33;
    Cheby "CHEBY" 3 [Real] 33;
    Forcos "FORCOS" 4 [Real] 34;
    Forsin "FORSIN" 4 [Real] 34;
    Shf "SHF" 5 [Real] 6;
    Sweep "SWEEP" 7 [Real] 7;
    Invpsd "INVPSD" 7 [Real, Element(E::Spline), Real] 7;
    Cubspl "CUBSPL" 3 [Real, Real, Element(E::Spline), Order] 4;
    Akispl "AKISPL" 3 [Real, Real, Element(E::Spline), Order] 4;
    Interp "INTERP" 3 [Real, Integer, Element(E::Spline), Order] 4;
    Curve "CURVE" 4 [Real, Order, Integer, Element(E::Other)] 4;
    Delay "DELAY" 3 [Real] 3;
    // A subroutine of the user.
    User "USER" 0 [Real] 30;
}
