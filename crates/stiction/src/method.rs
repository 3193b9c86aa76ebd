//! Methods of integration by the names that people give them.

use std::str::FromStr;

use dataset::{IndexReduction, IntegratorMethod};

use crate::argument::ArgumentError;

/// A method of integration that a run takes in the place of that of the model.
///
/// ```
/// use stiction::Method;
/// assert_eq!("gstiff-si2".parse(), Ok(Method::GstiffSi2));
/// let unknown = "adam".parse::<Method>().unwrap_err();
/// assert_eq!(unknown.to_string(), "there is no integrator \"adam\"; is adams meant?");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Backward differentiation, orders 1 to 5, position and velocity constraints: `GSTIFF, SI2`.
    GstiffSi2,
    /// Backward differentiation with position constraints: `GSTIFF, I3`.
    GstiffI3,
    /// Hilber, Hughes and Taylor: `HHT`.
    Hht,
    /// Newmark: `NEWMARK`.
    Newmark,
    /// Adams and Moulton, orders 1 to 12, for smooth motion that is not stiff: `ABAM`.
    Adams,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::GstiffSi2,
        Self::GstiffI3,
        Self::Hht,
        Self::Newmark,
        Self::Adams,
    ];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::GstiffSi2 => "gstiff-si2",
            Self::GstiffI3 => "gstiff-i3",
            Self::Hht => "hht",
            Self::Newmark => "newmark",
            Self::Adams => "adams",
        }
    }

    /// What INTEGRATOR says for it.
    pub(crate) const fn arguments(self) -> (IntegratorMethod, Option<IndexReduction>) {
        match self {
            Self::GstiffSi2 => (IntegratorMethod::Gstiff, Some(IndexReduction::Si2)),
            Self::GstiffI3 => (IntegratorMethod::Gstiff, Some(IndexReduction::I3)),
            Self::Hht => (IntegratorMethod::Hht, None),
            Self::Newmark => (IntegratorMethod::Newmark, None),
            Self::Adams => (IntegratorMethod::Abam, None),
        }
    }
}

impl FromStr for Method {
    type Err = ArgumentError;

    /// By its name, in capital or small letters.
    fn from_str(name: &str) -> Result<Self, ArgumentError> {
        let mut all = Self::ALL.into_iter();
        let found = all.find(|method| method.name().eq_ignore_ascii_case(name));
        found.ok_or_else(|| ArgumentError::Unknown {
            what: "integrator",
            name: name.to_owned(),
            known: Self::ALL.map(|method| method.name().to_owned()).to_vec(),
        })
    }
}
