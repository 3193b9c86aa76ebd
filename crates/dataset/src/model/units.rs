//! UNITS: what the numbers of a dataset mean.

use crate::source::Span;

macro_rules! units {
    ($(#[$documentation:meta])* $name:ident { $($variant:ident $keyword:literal $result:literal $si:expr,)* }) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name { $(#[doc = concat!("`", $keyword, "`.")] $variant,)* }

        impl $name {
            /// Every unit of this kind.
            pub const ALL: &[Self] = &[$(Self::$variant,)*];

            /// The name in the dataset language.
            #[must_use]
            pub const fn keyword(self) -> &'static str {
                match self { $(Self::$variant => $keyword,)* }
            }

            /// The name in result files.
            #[must_use]
            pub const fn result_name(self) -> &'static str {
                match self { $(Self::$variant => $result,)* }
            }

            /// The size of this unit in the unit of the SI (N, kg, m or s).
            #[must_use]
            pub const fn si(self) -> f64 {
                match self { $(Self::$variant => $si,)* }
            }
        }
    };
}

/// Standard acceleration of gravity, m/s^2 (exact by definition).
const STANDARD_GRAVITY: f64 = 9.80665;
/// The international pound in kg (exact by definition).
const POUND: f64 = 0.453_592_37;
/// The inch in m (exact by definition).
const INCH: f64 = 0.0254;
/// The foot in m.
const FOOT: f64 = 12.0 * INCH;
/// The pound force in N.
const POUND_FORCE: f64 = POUND * STANDARD_GRAVITY;

units! {
    /// A unit of force.
    ForceUnit {
        Newton "NEWTON" "newton" 1.0,
        Kilonewton "KNEWTON" "knewton" 1e3,
        Meganewton "MEGANEWTON" "meganewton" 1e6,
        Centinewton "CENTINEWTON" "centinewton" 1e-2,
        Millinewton "MILLINEWTON" "millinewton" 1e-3,
        Micronewton "MICRONEWTON" "micronewton" 1e-6,
        Nanonewton "NANONEWTON" "nanonewton" 1e-9,
        Dyne "DYNE" "dyne" 1e-5,
        KilogramForce "KILOGRAM_FORCE" "kg_force" STANDARD_GRAVITY,
        PoundForce "POUND_FORCE" "pound_force" POUND_FORCE,
        KilopoundForce "KPOUND_FORCE" "kpound_force" 1e3 * POUND_FORCE,
        OunceForce "OUNCE_FORCE" "ounce_force" POUND_FORCE / 16.0,
        Poundal "POUNDAL" "poundal" POUND * FOOT,
    }
}

units! {
    /// A unit of mass.
    MassUnit {
        Kilogram "KILOGRAM" "kg" 1.0,
        Gram "GRAM" "gram" 1e-3,
        Milligram "MILLIGRAM" "milligram" 1e-6,
        Microgram "MICROGRAM" "microgram" 1e-9,
        Nanogram "NANOGRAM" "nanogram" 1e-12,
        Tonne "TONNE" "tonne" 1e3,
        PoundMass "POUND_MASS" "pound_mass" POUND,
        KilopoundMass "KPOUND_MASS" "kpound_mass" 1e3 * POUND,
        OunceMass "OUNCE_MASS" "ounce_mass" POUND / 16.0,
        Slug "SLUG" "slug" POUND_FORCE / FOOT,
        Slinch "SLINCH" "slinch" POUND_FORCE / INCH,
        UsTon "US_TON" "us_ton" 2000.0 * POUND,
    }
}

units! {
    /// A unit of length.
    LengthUnit {
        Meter "METER" "meter" 1.0,
        Kilometer "KILOMETER" "km" 1e3,
        Centimeter "CENTIMETER" "cm" 1e-2,
        Millimeter "MILLIMETER" "mm" 1e-3,
        Micrometer "MICROMETER" "micrometer" 1e-6,
        Nanometer "NANOMETER" "nanometer" 1e-9,
        Angstrom "ANGSTROM" "angstrom" 1e-10,
        Inch "INCH" "inch" INCH,
        Foot "FOOT" "foot" FOOT,
        Yard "YARD" "yard" 3.0 * FOOT,
        Mile "MILE" "mile" 5280.0 * FOOT,
        Mils "MILS" "mils" 1e-3 * INCH,
        Microinch "MICROINCH" "microinch" 1e-6 * INCH,
    }
}

units! {
    /// A unit of time.
    TimeUnit {
        Second "SECOND" "sec" 1.0,
        Millisecond "MILLISECOND" "millisecond" 1e-3,
        Microsecond "MICROSECOND" "microsecond" 1e-6,
        Nanosecond "NANOSECOND" "nanosecond" 1e-9,
        Minute "MINUTE" "minute" 60.0,
        Hour "HOUR" "hour" 3600.0,
        Day "DAY" "day" 86400.0,
    }
}

/// UNITS: the units of the numbers of a dataset. They change no number of the input.
#[derive(Clone, Debug, PartialEq)]
pub struct Units {
    /// Unit of force; `None` where the system is `NONE` or only UCF is given.
    pub force: Option<ForceUnit>,
    /// Unit of mass.
    pub mass: Option<MassUnit>,
    /// Unit of length.
    pub length: Option<LengthUnit>,
    /// Unit of time.
    pub time: Option<TimeUnit>,
    /// Units consistency factor: `force * ucf = mass * acceleration`, 1 for N kg m s.
    pub ucf: f64,
    /// The place of the statement.
    pub span: Span,
}

impl Default for Units {
    /// Numbers taken as consistent: no unit names, UCF = 1.
    fn default() -> Self {
        Self {
            force: None,
            mass: None,
            length: None,
            time: None,
            ucf: 1.0,
            span: Span::default(),
        }
    }
}

impl Units {
    /// The units given by their names, with the UCF that follows from them.
    ///
    /// ```
    /// use dataset::{ForceUnit, LengthUnit, MassUnit, TimeUnit, Units};
    /// let units = Units::new(
    ///     ForceUnit::Newton, MassUnit::Kilogram, LengthUnit::Millimeter, TimeUnit::Second,
    /// );
    /// assert_eq!(units.ucf, 1000.0); // 1 N = 1000 kg mm/s^2
    /// ```
    #[must_use]
    pub fn new(force: ForceUnit, mass: MassUnit, length: LengthUnit, time: TimeUnit) -> Self {
        // Numerator and denominator are kept apart so that metric factors come out exact.
        let ucf = (force.si() * time.si() * time.si()) / (mass.si() * length.si());
        Self {
            force: Some(force),
            mass: Some(mass),
            length: Some(length),
            time: Some(time),
            ucf,
            span: Span::default(),
        }
    }
}
