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
    /// PTCV.
    PointCurve,
    /// CURVE.
    Curve,
    /// SPLINE.
    Spline,
    /// VARIABLE.
    Variable,
    /// DIFF.
    Differential,
    /// ARRAY.
    Array,
    /// FRICTION.
    Friction,
    /// PINPUT.
    PlantInput,
    /// POUTPUT.
    PlantOutput,
    /// SENSOR.
    Sensor,
    /// An element that datasets read by stiction cannot have; its functions are not simulated.
    Other,
}

/// What an argument of a function is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArgumentKind {
    /// An expression that gives a number.
    Real,
    /// An expression that gives a vector.
    Vector,
    /// A whole number.
    Integer,
    /// The order of a derivative: 0, 1 or 2.
    Order,
    /// A coordinate: 1, 2 or 3 for x, y or z.
    Coordinate,
    /// The id of a marker.
    Marker,
    /// The id of a marker, or 0 for the ground.
    MarkerOrGround,
    /// The id of an element.
    Element(ElementKind),
}

use ArgumentKind::{Coordinate, Element, Integer, Marker, MarkerOrGround, Order, Real, Vector};
use ElementKind as E;

macro_rules! functions {
    ($($variant:ident $name:literal $minimum:literal [$($kind:expr),*] $maximum:literal $arguments:literal $meaning:literal;)*) => {
        /// A run-time function.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Function { $(#[doc = concat!("`", $name, "(", $arguments, ")`: ", $meaning, ".")] $variant,)* }

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

            /// The names of the arguments.
            #[must_use]
            pub const fn arguments(self) -> &'static str {
                match self { $(Self::$variant => $arguments,)* }
            }

            /// What it gives, in a phrase.
            #[must_use]
            pub const fn meaning(self) -> &'static str {
                match self { $(Self::$variant => $meaning,)* }
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

    /// Whether it gives a vector.
    #[must_use]
    pub const fn gives_vector(self) -> bool {
        self.components().is_some()
            || matches!(
                self,
                Self::Uvx | Self::Uvy | Self::Uvz | Self::Uv | Self::Trans
            )
    }

    /// The functions of the components of a vector, with the same arguments.
    ///
    /// ```
    /// use dataset::Function;
    /// let components = Function::Dxyz.components();
    /// assert_eq!(components, Some([Function::Dx, Function::Dy, Function::Dz]));
    /// assert_eq!(Function::Dm.components(), None);
    /// ```
    #[must_use]
    pub const fn components(self) -> Option<[Self; 3]> {
        Some(match self {
            Self::Dxyz => [Self::Dx, Self::Dy, Self::Dz],
            Self::Vxyz => [Self::Vx, Self::Vy, Self::Vz],
            Self::Wxyz => [Self::Wx, Self::Wy, Self::Wz],
            Self::Accxyz => [Self::Accx, Self::Accy, Self::Accz],
            Self::Fxyz => [Self::Fx, Self::Fy, Self::Fz],
            Self::Txyz => [Self::Tx, Self::Ty, Self::Tz],
            _ => return None,
        })
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

// name, least number of arguments, kinds (the last one repeats), greatest number of arguments;
// names of the arguments, meaning. Markers i, j, k and l that are left out are the ground.
functions! {
    // Displacements of marker i relative to j, along or about the axes of k.
    Dx "DX" 1 [Marker, MarkerOrGround] 3
        "i, j, k" "displacement of i from j along x of k";
    Dy "DY" 1 [Marker, MarkerOrGround] 3
        "i, j, k" "displacement of i from j along y of k";
    Dz "DZ" 1 [Marker, MarkerOrGround] 3
        "i, j, k" "displacement of i from j along z of k";
    Dm "DM" 1 [Marker, MarkerOrGround] 2
        "i, j" "distance of i from j";
    Ax "AX" 1 [Marker, MarkerOrGround] 2
        "i, j" "rotation of i against j about x of j, continuous over many turns";
    Ay "AY" 1 [Marker, MarkerOrGround] 2
        "i, j" "rotation of i against j about y of j, continuous over many turns";
    Az "AZ" 1 [Marker, MarkerOrGround] 2
        "i, j" "rotation of i against j about z of j, continuous over many turns";
    Psi "PSI" 1 [Marker, MarkerOrGround] 2
        "i, j" "first of the body-fixed 3-1-3 angles of i in j";
    Theta "THETA" 1 [Marker, MarkerOrGround] 2
        "i, j" "second of the body-fixed 3-1-3 angles of i in j";
    Phi "PHI" 1 [Marker, MarkerOrGround] 2
        "i, j" "third of the body-fixed 3-1-3 angles of i in j";
    Yaw "YAW" 1 [Marker, MarkerOrGround] 2
        "i, j" "first of the body-fixed 3-2-1 angles of i in j";
    Pitch "PITCH" 1 [Marker, MarkerOrGround] 2
        "i, j" "second of the body-fixed 3-2-1 angles of i in j, with the opposite sign";
    Roll "ROLL" 1 [Marker, MarkerOrGround] 2
        "i, j" "third of the body-fixed 3-2-1 angles of i in j";
    Incang "INCANG" 3 [Marker] 3
        "i, j, k" "angle at j between the lines to i and to k";
    Orient "ORIENT" 3 [Integer, Integer, Marker, MarkerOrGround] 4
        "type, component, i, j" "orientation of i in j: types 1 to 12 body-fixed angles, 27 Euler parameters";
    // Velocities.
    Vx "VX" 1 [Marker, MarkerOrGround] 4
        "i, j, k, l" "velocity of i against j along x of k, seen from l";
    Vy "VY" 1 [Marker, MarkerOrGround] 4
        "i, j, k, l" "velocity of i against j along y of k, seen from l";
    Vz "VZ" 1 [Marker, MarkerOrGround] 4
        "i, j, k, l" "velocity of i against j along z of k, seen from l";
    Vm "VM" 1 [Marker, MarkerOrGround] 3
        "i, j, l" "speed of i against j, seen from l";
    Vr "VR" 1 [Marker, MarkerOrGround] 3
        "i, j" "rate of the distance of i from j, positive apart";
    Wx "WX" 1 [Marker, MarkerOrGround] 3
        "i, j, k" "angular velocity of i against j along x of k";
    Wy "WY" 1 [Marker, MarkerOrGround] 3
        "i, j, k" "angular velocity of i against j along y of k";
    Wz "WZ" 1 [Marker, MarkerOrGround] 3
        "i, j, k" "angular velocity of i against j along z of k";
    Wm "WM" 1 [Marker, MarkerOrGround] 2
        "i, j" "magnitude of the angular velocity of i against j";
    // Accelerations.
    Accx "ACCX" 1 [Marker, MarkerOrGround] 4
        "i, j, k, l" "acceleration of i against j along x of k, seen from l";
    Accy "ACCY" 1 [Marker, MarkerOrGround] 4
        "i, j, k, l" "acceleration of i against j along y of k, seen from l";
    Accz "ACCZ" 1 [Marker, MarkerOrGround] 4
        "i, j, k, l" "acceleration of i against j along z of k, seen from l";
    Accm "ACCM" 1 [Marker, MarkerOrGround] 3
        "i, j, l" "magnitude of the acceleration of i against j, seen from l";
    Wdtx "WDTX" 1 [Marker, MarkerOrGround] 4
        "i, j, k, l" "angular acceleration of i against j along x of k, seen from l";
    Wdty "WDTY" 1 [Marker, MarkerOrGround] 4
        "i, j, k, l" "angular acceleration of i against j along y of k, seen from l";
    Wdtz "WDTZ" 1 [Marker, MarkerOrGround] 4
        "i, j, k, l" "angular acceleration of i against j along z of k, seen from l";
    Wdtm "WDTM" 1 [Marker, MarkerOrGround] 3
        "i, j, l" "magnitude of the angular acceleration of i against j, seen from l";
    // Total forces at i of the elements between i and j, along the axes of k.
    Fx "FX" 1 [Marker, MarkerOrGround] 3
        "i, j, k" "force on i of everything between i and j, along x of k";
    Fy "FY" 1 [Marker, MarkerOrGround] 3
        "i, j, k" "force on i of everything between i and j, along y of k";
    Fz "FZ" 1 [Marker, MarkerOrGround] 3
        "i, j, k" "force on i of everything between i and j, along z of k";
    Fm "FM" 1 [Marker, MarkerOrGround] 2
        "i, j" "magnitude of the force on i of everything between i and j";
    Tx "TX" 1 [Marker, MarkerOrGround] 3
        "i, j, k" "torque on i of everything between i and j, along x of k";
    Ty "TY" 1 [Marker, MarkerOrGround] 3
        "i, j, k" "torque on i of everything between i and j, along y of k";
    Tz "TZ" 1 [Marker, MarkerOrGround] 3
        "i, j, k" "torque on i of everything between i and j, along z of k";
    Tm "TM" 1 [Marker, MarkerOrGround] 2
        "i, j" "magnitude of the torque on i of everything between i and j";
    // Vectors.
    Uvx "UVX" 1 [Marker, MarkerOrGround] 2
        "i, k" "unit vector along x of i, components along k";
    Uvy "UVY" 1 [Marker, MarkerOrGround] 2
        "i, k" "unit vector along y of i, components along k";
    Uvz "UVZ" 1 [Marker, MarkerOrGround] 2
        "i, k" "unit vector along z of i, components along k";
    Uv "UV" 1 [Vector] 1
        "vector" "unit vector along a vector";
    Mag "MAG" 1 [Vector] 1
        "vector" "magnitude of a vector";
    Trans "TRANS" 2 [Vector, MarkerOrGround] 3
        "vector, i, j" "components along i of a vector given along j";
    Dxyz "DXYZ" 1 [Marker, MarkerOrGround] 3
        "i, j, k" "displacement vector of i from j along k";
    Vxyz "VXYZ" 1 [Marker, MarkerOrGround] 4
        "i, j, k, l" "velocity vector of i against j along k, seen from l";
    Wxyz "WXYZ" 1 [Marker, MarkerOrGround] 3
        "i, j, k" "angular velocity vector of i against j along k";
    Accxyz "ACCXYZ" 1 [Marker, MarkerOrGround] 4
        "i, j, k, l" "acceleration vector of i against j along k, seen from l";
    Fxyz "FXYZ" 1 [Marker, MarkerOrGround] 3
        "i, j, k" "force vector on i of everything between i and j, along k";
    Txyz "TXYZ" 1 [Marker, MarkerOrGround] 3
        "i, j, k" "torque vector on i of everything between i and j, along k";
    // One component of the force of one element: id, 0 on I or 1 on J, component, axes.
    Joint "JOINT" 3 [Element(E::Joint), Integer, Integer, MarkerOrGround] 4
        "id, side, component, rm" "component 1 to 8 (FM FX FY FZ TM TX TY TZ) of a JOINT on I (side 0) or J (1), along rm";
    Jprim "JPRIM" 3 [Element(E::Primitive), Integer, Integer, MarkerOrGround] 4
        "id, side, component, rm" "component 1 to 8 (FM FX FY FZ TM TX TY TZ) of a JPRIM on I (side 0) or J (1), along rm";
    Motion "MOTION" 3 [Element(E::Motion), Integer, Integer, MarkerOrGround] 4
        "id, side, component, rm" "component 1 to 8 (FM FX FY FZ TM TX TY TZ) of a MOTION on I (side 0) or J (1), along rm";
    Sforce "SFORCE" 3 [Element(E::SingleForce), Integer, Integer, MarkerOrGround] 4
        "id, side, component, rm" "component 1 to 8 (FM FX FY FZ TM TX TY TZ) of an SFORCE on I (side 0) or J (1), along rm";
    Spdp "SPDP" 3 [Element(E::SpringDamper), Integer, Integer, MarkerOrGround] 4
        "id, side, component, rm" "component 1 to 8 (FM FX FY FZ TM TX TY TZ) of a SPRINGDAMPER on I (side 0) or J (1), along rm";
    Ptcv "PTCV" 3 [Element(E::PointCurve), Integer, Integer, MarkerOrGround] 4
        "id, side, component, rm" "component 1 to 8 (FM FX FY FZ TM TX TY TZ) of a PTCV on I (side 0) or J (1), along rm";
    Cvcv "CVCV" 3 [Element(E::Other), Integer, Integer, MarkerOrGround] 4
        "id, side, component, rm" "component 1 to 8 (FM FX FY FZ TM TX TY TZ) of a CVCV on I (side 0) or J (1), along rm";
    Vforce "VFORCE" 3 [Element(E::VectorForce), Integer, Integer, MarkerOrGround] 4
        "id, side, component, rm" "component 1 to 8 (FM FX FY FZ TM TX TY TZ) of a VFORCE on I (side 0) or J (1), along rm";
    Vtorq "VTORQ" 3 [Element(E::VectorTorque), Integer, Integer, MarkerOrGround] 4
        "id, side, component, rm" "component 1 to 8 (FM FX FY FZ TM TX TY TZ) of a VTORQUE on I (side 0) or J (1), along rm";
    Gforce "GFORCE" 3 [Element(E::GeneralForce), Integer, Integer, MarkerOrGround] 4
        "id, side, component, rm" "component 1 to 8 (FM FX FY FZ TM TX TY TZ) of a GFORCE on I (side 0) or J (1), along rm";
    Nforce "NFORCE" 3 [Element(E::Other), Integer, Integer, MarkerOrGround] 4
        "id, side, component, rm" "component 1 to 8 (FM FX FY FZ TM TX TY TZ) of an NFORCE on I (side 0) or J (1), along rm";
    Bush "BUSH" 3 [Element(E::Bushing), Integer, Integer, MarkerOrGround] 4
        "id, side, component, rm" "component 1 to 8 (FM FX FY FZ TM TX TY TZ) of a BUSHING on I (side 0) or J (1), along rm";
    Field "FIELD" 3 [Element(E::Field), Integer, Integer, MarkerOrGround] 4
        "id, side, component, rm" "component 1 to 8 (FM FX FY FZ TM TX TY TZ) of a FIELD on I (side 0) or J (1), along rm";
    Beam "BEAM" 3 [Element(E::Beam), Integer, Integer, MarkerOrGround] 4
        "id, side, component, rm" "component 1 to 8 (FM FX FY FZ TM TX TY TZ) of a BEAM on I (side 0) or J (1), along rm";
    Contact "CONTACT" 3 [Element(E::Other), Integer, Integer, MarkerOrGround] 4
        "id, side, component, rm" "component 1 to 8 (FM FX FY FZ TM TX TY TZ) of a CONTACT on I (side 0) or J (1), along rm";
    Friction "FRICTION" 2 [Element(E::Friction), Integer] 2
        "id, index" "component 1 to 26 of a FRICTION";
    // Elements.
    Varval "VARVAL" 1 [Element(E::Variable)] 1
        "id" "value of a VARIABLE";
    Aryval "ARYVAL" 2 [Element(E::Array), Integer] 2
        "id, component" "component of an ARRAY";
    Dif "DIF" 1 [Element(E::Differential)] 1
        "id" "state of a DIFF";
    Dif1 "DIF1" 1 [Element(E::Differential)] 1
        "id" "rate of the state of a DIFF";
    Pinval "PINVAL" 2 [Element(E::PlantInput), Integer] 2
        "id, component" "value of a variable of a PINPUT";
    Pouval "POUVAL" 2 [Element(E::PlantOutput), Integer] 2
        "id, component" "value of a variable of a POUTPUT";
    Senval "SENVAL" 1 [Element(E::Sensor)] 1
        "id" "value of EVALUATE when a SENSOR was triggered last, 0 before";
    // Mathematics; angles in radians.
    Abs "ABS" 1 [Real] 1
        "x" "magnitude";
    Acos "ACOS" 1 [Real] 1
        "x" "inverse cosine, 0 to pi";
    Aint "AINT" 1 [Real] 1
        "x" "whole part, towards zero";
    Anint "ANINT" 1 [Real] 1
        "x" "nearest whole number, halves away from zero";
    Asin "ASIN" 1 [Real] 1
        "x" "inverse sine, -pi/2 to pi/2";
    Atan "ATAN" 1 [Real] 1
        "x" "inverse tangent, -pi/2 to pi/2";
    Atan2 "ATAN2" 2 [Real] 2
        "y, x" "angle of the point (x, y), -pi to pi";
    Cos "COS" 1 [Real] 1
        "x" "cosine";
    Cosh "COSH" 1 [Real] 1
        "x" "hyperbolic cosine";
    Dim "DIM" 2 [Real] 2
        "x, y" "excess of x over y, 0 where there is none";
    Exp "EXP" 1 [Real] 1
        "x" "exponential";
    Log "LOG" 1 [Real] 1
        "x" "natural logarithm";
    Log10 "LOG10" 1 [Real] 1
        "x" "decimal logarithm";
    Max "MAX" 2 [Real] 2
        "x, y" "the greater";
    Min "MIN" 2 [Real] 2
        "x, y" "the less";
    Mod "MOD" 2 [Real] 2
        "x, y" "remainder of x/y, with the sign of x";
    Sign "SIGN" 2 [Real] 2
        "x, y" "magnitude of x with the sign of y";
    Sin "SIN" 1 [Real] 1
        "x" "sine";
    Sinh "SINH" 1 [Real] 1
        "x" "hyperbolic sine";
    Sqrt "SQRT" 1 [Real] 1
        "x" "square root";
    Tan "TAN" 1 [Real] 1
        "x" "tangent";
    Tanh "TANH" 1 [Real] 1
        "x" "hyperbolic tangent";
    If "IF" 4 [Real] 4
        "x: a, b, c" "a where x is below 0, b at 0, c above";
    // Transitions, contacts and series.
    Step "STEP" 5 [Real] 5
        "x, x0, h0, x1, h1" "from h0 at x0 to h1 at x1 by a cubic, constant outside";
    Step5 "STEP5" 5 [Real] 5
        "x, x0, h0, x1, h1" "from h0 at x0 to h1 at x1 by a quintic, constant outside";
    Havsin "HAVSIN" 5 [Real] 5
        "x, x0, h0, x1, h1" "from h0 at x0 to h1 at x1 by a sine, constant outside";
    Impact "IMPACT" 7 [Real] 7
        "x, rate, x1, k, e, cmax, d" "one-sided contact at x1: k (x1 - x)**e less damping that is complete at the depth d";
    Bistop "BISTOP" 8 [Real] 8
        "x, rate, x1, x2, k, e, cmax, d" "contact at x1 from above and at x2 from below";
    Poly "POLY" 3 [Real] 33
        "x, x0, a0, ..." "sum of ak (x - x0)**k";
    Cheby "CHEBY" 3 [Real] 33
        "x, x0, a0, ..." "sum of ak Tk(x - x0) with Chebyshev's polynomials";
    Forcos "FORCOS" 4 [Real] 34
        "x, x0, w, a0, ..." "a0 + sum of ak cos(k w (x - x0))";
    Forsin "FORSIN" 4 [Real] 34
        "x, x0, w, a0, ..." "a0 + sum of ak sin(k w (x - x0))";
    Shf "SHF" 5 [Real] 6
        "x, x0, a, w, phi, b" "a sin(w (x - x0) - phi) + b";
    Sweep "SWEEP" 7 [Real] 7
        "x, a, x0, f0, x1, f1, dx" "sine of amplitude a whose frequency (cycles) rises from f0 at x0 to f1 at x1, faded in over dx";
    Invpsd "INVPSD" 7 [Real, Element(E::Spline), Real] 7
        "x, id, f0, f1, n, scale, seed" "sum of n sines with the power density of a SPLINE over frequency (cycles), random phases from a seed";
    Cubspl "CUBSPL" 3 [Real, Real, Element(E::Spline), Order] 4
        "x, z, id, order" "SPLINE by a cubic spline in x and linear in z, or a derivative by x";
    Akispl "AKISPL" 3 [Real, Real, Element(E::Spline), Order] 4
        "x, z, id, order" "SPLINE by Akima's method in x and linear in z, or a derivative by x";
    Interp "INTERP" 3 [Real, Integer, Element(E::Spline), Order] 4
        "x, method, id, order" "SPLINE of a time history";
    Curve "CURVE" 4 [Real, Order, Coordinate, Element(E::Curve)] 4
        "x, order, component, id" "coordinate of a CURVE at its parameter x (-1 to 1), or a derivative";
    Delay "DELAY" 3 [Real] 3
        "x, tau, history" "value of x a time tau before";
    // A subroutine of the user.
    User "USER" 0 [Real] 30
        "r1, ..." "value of a subroutine";
}
