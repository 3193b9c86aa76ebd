//! Parameters: arguments of a model with the values that they take.

use stiction::{Argument, ArgumentError, conversion};

/// A value of a parameter, in the unit that the argument has in the model.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A word, an expression or several numbers, as the dataset language writes them.
    Text(String),
}

impl std::fmt::Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            // The shortest digits that give the same number.
            Self::Number(number) => write!(f, "{number:?}"),
            Self::Text(text) => f.write_str(text),
        }
    }
}

/// An interval that a design takes values from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Its lower end.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
    /// Whether the logarithm of the value is uniform, not the value.
    pub logarithmic: bool,
}

impl Range {
    /// The value at a part of the way from the lower to the upper end.
    #[must_use]
    pub fn at(&self, part: f64) -> f64 {
        if self.logarithmic {
            self.low * (self.high / self.low).powf(part)
        } else {
            self.low + part * (self.high - self.low)
        }
    }
}

/// What values a parameter takes.
#[derive(Clone, Debug, PartialEq)]
pub enum Levels {
    /// These.
    Values(Vec<Value>),
    /// What the design takes out of an interval.
    Range(Range),
}

/// A parameter as it is given: with units of its own, by name.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenParameter {
    /// The name of an argument, as [`stiction::Project::argument`] takes it.
    pub name: String,
    /// Its values.
    pub levels: Levels,
    /// Their unit, where it is another than that of the model; of values one each.
    pub units: Vec<Option<String>>,
}

/// A parameter of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name as given.
    pub name: String,
    /// The argument that it changes.
    pub argument: Argument,
    /// In the units of the model.
    pub levels: Levels,
}

impl Parameter {
    /// The parameter of an argument.
    ///
    /// # Errors
    /// Numbers that are not finite, units of another kind, ranges without a size.
    pub(crate) fn new(given: &GivenParameter, argument: Argument) -> Result<Self, ArgumentError> {
        let name = &given.name;
        let factor = |unit: &Option<String>| match (unit, &argument.unit) {
            (None, _) => Ok(1.0),
            (Some(unit), Some(own)) => conversion(unit, own),
            (Some(_), None) => Err(ArgumentError::Value(format!(
                "{name}: units are known for arguments of FRICTION alone"
            ))),
        };
        let factors: Result<Vec<f64>, _> = given.units.iter().map(factor).collect();
        let factors = factors?;
        let levels = match &given.levels {
            Levels::Values(values) => {
                let factors = factors.iter().copied().chain(std::iter::repeat(1.0));
                let values = values.iter().zip(factors);
                let values: Result<_, _> = values.map(|(v, f)| checked(name, v, f)).collect();
                Levels::Values(values?)
            }
            Levels::Range(range) => {
                let factor = factors.first().copied().unwrap_or(1.0);
                Levels::Range(checked_range(name, *range, factor)?)
            }
        };
        let name = name.clone();
        Ok(Self {
            name,
            argument,
            levels,
        })
    }
}

fn checked(name: &str, value: &Value, factor: f64) -> Result<Value, ArgumentError> {
    match value {
        Value::Number(number) if number.is_finite() => Ok(Value::Number(number * factor)),
        Value::Number(number) => Err(ArgumentError::Value(format!(
            "{name} must be a finite number, it is {number}"
        ))),
        Value::Text(text) if text.contains(['\n', '\r', '!']) => Err(ArgumentError::Value(
            format!("{name}: {text:?} is not on one line"),
        )),
        Value::Text(text) => Ok(Value::Text(text.clone())),
    }
}

fn checked_range(name: &str, range: Range, factor: f64) -> Result<Range, ArgumentError> {
    let Range {
        low,
        high,
        logarithmic,
    } = range;
    let refused = |text: &str| Err(ArgumentError::Value(format!("{name}: {text}")));
    if !(low.is_finite() && high.is_finite()) {
        return refused("the ends of a range must be finite numbers");
    }
    if low >= high {
        return refused("a range begins with its lower end and has a size");
    }
    if logarithmic && low <= 0.0 {
        return refused("a logarithmic range begins above zero");
    }
    Ok(Range {
        low: low * factor,
        high: high * factor,
        logarithmic,
    })
}
