//! Names of units as result files spell them, from the keywords of a `UNITS` statement.

/// A keyword that is no unit.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{keyword}` is not a unit of {quantity}")]
pub struct UnitError {
    /// Quantity: length, mass, force or time.
    pub quantity: &'static str,
    /// The keyword as given.
    pub keyword: String,
}

/// Names of the units of a model, as in the `.res` of Adams (`meter`, `kg`, `newton`, `sec`).
///
/// Angles are radians always, in models and in results.
#[derive(Debug, Clone, PartialEq)]
pub struct UnitNames {
    /// Length, for example `meter`.
    pub length: String,
    /// Mass, for example `kg`.
    pub mass: String,
    /// Force, for example `newton`.
    pub force: String,
    /// Time, for example `sec`.
    pub time: String,
    /// Angle, `rad`.
    pub angle: String,
    /// Units tag of `.req` files, for example `M_KGS_N_RACA`.
    pub tag: String,
    /// Number of length units in a metre.
    pub lengths_per_meter: f64,
}

impl Default for UnitNames {
    /// Metre, kilogram, newton, second.
    fn default() -> Self {
        Self::of(&LENGTHS[0], &MASSES[0], &FORCES[0], &TIMES[0])
    }
}

/// Keyword, name in results, two letters in the tag, number in one SI unit (lengths only).
type Unit = (&'static str, &'static str, &'static str, f64);

const LENGTHS: [Unit; 12] = [
    ("METER", "meter", "M_", 1.0),
    ("MILLIMETER", "mm", "MM", 1e3),
    ("CENTIMETER", "cm", "CM", 1e2),
    ("KILOMETER", "km", "KM", 1e-3),
    ("MICROMETER", "micrometer", "UM", 1e6),
    ("NANOMETER", "nanometer", "NM", 1e9),
    ("ANGSTROM", "angstrom", "AN", 1e10),
    ("INCH", "inch", "IN", 1.0 / 0.0254),
    ("MICROINCH", "microinch", "UI", 1e6 / 0.0254),
    ("FOOT", "foot", "FT", 1.0 / 0.3048),
    ("YARD", "yard", "YD", 1.0 / 0.9144),
    ("MILE", "mile", "MI", 1.0 / 1609.344),
];

const MASSES: [Unit; 11] = [
    ("KILOGRAM", "kg", "KG", 1.0),
    ("GRAM", "gram", "G_", 1.0),
    ("MEGAGRAM", "megagram", "MG", 1.0),
    ("TONNE", "tonne", "TN", 1.0),
    ("MICROGRAM", "microgram", "UG", 1.0),
    ("NANOGRAM", "nanogram", "NG", 1.0),
    ("POUND_MASS", "pound_mass", "LB", 1.0),
    ("OUNCE_MASS", "ounce_mass", "OZ", 1.0),
    ("SLUG", "slug", "SL", 1.0),
    ("SLINCH", "slinch", "SI", 1.0),
    ("KPOUND_MASS", "kpound_mass", "KP", 1.0),
];

const FORCES: [Unit; 14] = [
    ("NEWTON", "newton", "N_", 1.0),
    ("KNEWTON", "knewton", "KN", 1.0),
    ("MEGANEWTON", "meganewton", "MN", 1.0),
    ("MILLINEWTON", "millinewton", "ML", 1.0),
    ("CENTINEWTON", "centinewton", "CN", 1.0),
    ("MICRONEWTON", "micronewton", "UN", 1.0),
    ("NANONEWTON", "nanonewton", "NN", 1.0),
    ("KILOGRAM_FORCE", "kilogram_force", "KF", 1.0),
    ("DYNE", "dyne", "DY", 1.0),
    ("POUND_FORCE", "pound_force", "PF", 1.0),
    ("KPOUND_FORCE", "kpound_force", "KP", 1.0),
    ("OUNCE_FORCE", "ounce_force", "OF", 1.0),
    ("POUNDAL", "poundal", "PD", 1.0),
    ("GRAM_FORCE", "gram_force", "GF", 1.0),
];

const TIMES: [Unit; 7] = [
    ("SECOND", "sec", "S_", 1.0),
    ("MILLISECOND", "millisec", "MS", 1.0),
    ("MICROSECOND", "microsec", "US", 1.0),
    ("NANOSECOND", "nanosec", "NS", 1.0),
    ("MINUTE", "min", "MI", 1.0),
    ("HOUR", "hour", "HR", 1.0),
    ("DAY", "day", "DA", 1.0),
];

impl UnitNames {
    /// Names from the keywords of a `UNITS` statement, in any case.
    ///
    /// The names and tags of metre, millimetre, centimetre, inch, kilogram, pound mass, newton,
    /// pound force and second are those of real files; the others follow their pattern.
    ///
    /// # Errors
    /// A keyword that names no unit.
    ///
    /// ```
    /// let units = results::UnitNames::from_keywords("MILLIMETER", "KILOGRAM", "NEWTON", "SECOND")?;
    /// assert_eq!(units.torque(), "newton-mm");
    /// assert_eq!(units.acceleration(), "mm/sec**2");
    /// assert_eq!(units.tag, "MMKGS_N_RACA");
    /// # Ok::<(), results::UnitError>(())
    /// ```
    pub fn from_keywords(
        length: &str,
        mass: &str,
        force: &str,
        time: &str,
    ) -> Result<Self, UnitError> {
        Ok(Self::of(
            find(&LENGTHS, "length", length)?,
            find(&MASSES, "mass", mass)?,
            find(&FORCES, "force", force)?,
            find(&TIMES, "time", time)?,
        ))
    }

    fn of(length: &Unit, mass: &Unit, force: &Unit, time: &Unit) -> Self {
        Self {
            length: length.1.into(),
            mass: mass.1.into(),
            force: force.1.into(),
            time: time.1.into(),
            angle: "rad".into(),
            tag: [length.2, mass.2, time.2, force.2, "RA", "CA"].concat(),
            lengths_per_meter: length.3,
        }
    }

    /// Torque: `newton-meter`.
    pub fn torque(&self) -> String {
        format!("{}-{}", self.force, self.length)
    }

    /// Work and energy, spelled as a torque: `newton-meter`.
    pub fn energy(&self) -> String {
        self.torque()
    }

    /// Power: `newton-meter/sec`.
    pub fn power(&self) -> String {
        format!("{}/{}", self.energy(), self.time)
    }

    /// Velocity: `meter/sec`.
    pub fn velocity(&self) -> String {
        format!("{}/{}", self.length, self.time)
    }

    /// Acceleration: `meter/sec**2`.
    pub fn acceleration(&self) -> String {
        format!("{}/{}**2", self.length, self.time)
    }

    /// Angular velocity: `rad/sec`.
    pub fn angular_velocity(&self) -> String {
        format!("{}/{}", self.angle, self.time)
    }

    /// Angular acceleration: `rad/sec**2`.
    pub fn angular_acceleration(&self) -> String {
        format!("{}/{}**2", self.angle, self.time)
    }
}

fn find<'a>(
    units: &'a [Unit],
    quantity: &'static str,
    keyword: &str,
) -> Result<&'a Unit, UnitError> {
    units
        .iter()
        .find(|unit| unit.0.eq_ignore_ascii_case(keyword))
        .ok_or_else(|| UnitError {
            quantity,
            keyword: keyword.into(),
        })
}
