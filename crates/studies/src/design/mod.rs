//! Designs: which cases a study has.

mod latin_hypercube;
mod sobol;

use stiction::ArgumentError;

use crate::parameter::{Levels, Parameter, Value};

/// How the values of several parameters are put together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Design {
    /// Every combination of the values of all parameters; the last parameter varies fastest.
    Factorial,
    /// The first values of all parameters, then the second ones, and so on.
    List,
    /// Latin hypercube over ranges: each of as many equal layers of a range as there are cases is met
    /// once, in an order and at places that the seed decides.
    LatinHypercube,
    /// Sobol' points over ranges; best for cases that are a power of two.
    Sobol,
}

/// More cases would not be kept in memory.
const MOST_CASES: usize = 10_000_000;

impl Design {
    /// Every design.
    pub const ALL: [Self; 4] = [
        Self::Factorial,
        Self::List,
        Self::LatinHypercube,
        Self::Sobol,
    ];

    /// Its name in a study file and in Python.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Factorial => "factorial",
            Self::List => "list",
            Self::LatinHypercube => "latin_hypercube",
            Self::Sobol => "sobol",
        }
    }

    /// The design of that name.
    ///
    /// # Errors
    /// Names that are those of no design.
    pub fn named(name: &str) -> Result<Self, ArgumentError> {
        let found = Self::ALL.into_iter().find(|design| design.name() == name);
        found.ok_or_else(|| ArgumentError::Unknown {
            what: "design",
            name: name.to_owned(),
            known: Self::ALL.map(|design| design.name().to_owned()).into(),
        })
    }

    /// Whether it takes ranges and a number of cases.
    #[must_use]
    pub const fn samples(self) -> bool {
        matches!(self, Self::LatinHypercube | Self::Sobol)
    }

    /// Points between 0 and 1 for the ranges of so many parameters, case by case.
    ///
    /// # Errors
    /// No cases or too many, more parameters than direction numbers are known for, and designs that
    /// take no ranges.
    ///
    /// ```
    /// let points = studies::Design::Sobol.points(4, 2, 0)?;
    /// assert_eq!(points[2], [0.75, 0.25]);
    /// # Ok::<(), stiction::ArgumentError>(())
    /// ```
    pub fn points(
        self,
        cases: usize,
        parameters: usize,
        seed: u64,
    ) -> Result<Vec<Vec<f64>>, ArgumentError> {
        check_count(cases)?;
        match self {
            Self::LatinHypercube => Ok(latin_hypercube::points(cases, parameters, seed)),
            Self::Sobol if parameters > sobol::MOST_PARAMETERS => refused(format!(
                "sobol has direction numbers for {} parameters, not for {parameters}; use \
                 latin_hypercube",
                sobol::MOST_PARAMETERS
            )),
            Self::Sobol => Ok(sobol::points(cases, parameters)),
            Self::Factorial | Self::List => refused(format!("{} has no ranges", self.name())),
        }
    }

    /// The values of all cases; `cases` is their number, for designs that take one.
    ///
    /// # Errors
    /// No cases or too many, and parameters that do not go with the design.
    pub(crate) fn values(
        self,
        parameters: &[Parameter],
        cases: Option<usize>,
        seed: u64,
    ) -> Result<Vec<Vec<Value>>, ArgumentError> {
        if self.samples() {
            let Some(cases) = cases else {
                return refused(format!("{} needs the number of cases", self.name()));
            };
            let points = self.points(cases, parameters.len(), seed)?;
            let value = |(parameter, u): (&Parameter, &f64)| match &parameter.levels {
                Levels::Range(range) => Ok(Value::Number(range.at(*u))),
                Levels::Values(_) => refused(format!(
                    "{} takes a range of {}, not single values",
                    self.name(),
                    parameter.name
                )),
            };
            let case = |point: Vec<f64>| parameters.iter().zip(&point).map(value).collect();
            return points.into_iter().map(case).collect();
        }
        if cases.is_some() {
            return refused(format!(
                "{} has as many cases as its values give; leave their number out",
                self.name()
            ));
        }
        let lists: Result<Vec<&Vec<Value>>, _> = parameters
            .iter()
            .map(|parameter| match &parameter.levels {
                Levels::Values(values) => Ok(values),
                Levels::Range(_) => refused(format!(
                    "{} is a range, which latin_hypercube and sobol take; {} takes single values",
                    parameter.name,
                    self.name()
                )),
            })
            .collect();
        let lists = lists?;
        if self == Self::List {
            return list(parameters, &lists);
        }
        let sizes = lists.iter().map(|values| values.len());
        let cases = sizes.fold(1_usize, usize::saturating_mul);
        check_count(cases)?;
        let case = |case: usize| {
            let mut rest = case;
            let from_last = lists.iter().rev().map(|values| {
                let value = values[rest % values.len()].clone();
                rest /= values.len();
                value
            });
            let mut values: Vec<_> = from_last.collect();
            values.reverse();
            values
        };
        Ok((0..cases).map(case).collect())
    }
}

fn list(parameters: &[Parameter], lists: &[&Vec<Value>]) -> Result<Vec<Vec<Value>>, ArgumentError> {
    let cases = lists.first().map_or(0, |values| values.len());
    if let Some(other) = lists.iter().position(|values| values.len() != cases) {
        return refused(format!(
            "list takes as many values of each parameter; {} has {cases} and {} has {}",
            parameters[0].name,
            parameters[other].name,
            lists[other].len()
        ));
    }
    check_count(cases)?;
    let case = |case: usize| lists.iter().map(|values| values[case].clone()).collect();
    Ok((0..cases).map(case).collect())
}

fn check_count(cases: usize) -> Result<(), ArgumentError> {
    match cases {
        0 => refused("the study has no cases; give each parameter a value".to_owned()),
        cases if cases > MOST_CASES => refused(format!(
            "the study has more than {MOST_CASES} cases; take fewer values, or latin_hypercube"
        )),
        _ => Ok(()),
    }
}

fn refused<T>(text: String) -> Result<T, ArgumentError> {
    Err(ArgumentError::Value(text))
}
