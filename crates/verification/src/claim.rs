//! A case, the claims made of it, and when a claim holds.

use crate::coverage::{Cell, Coverage};

/// Part of the manual that a case belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Section {
    /// The friction laws as functions, and in motions that need no mechanism.
    Law,
    /// One joint with its reaction.
    Joint,
    /// Mechanisms with friction.
    Mechanism,
    /// Mechanisms without friction: the solver.
    Frictionless,
    /// Equilibrium.
    Statics,
    /// The formulas of integration, invariance and conservation.
    Integration,
    /// Every argument of the statement in every joint.
    Argument,
}

impl Section {
    /// All, in the order of the manual.
    pub const ALL: [Self; 7] = [
        Self::Law,
        Self::Joint,
        Self::Mechanism,
        Self::Frictionless,
        Self::Statics,
        Self::Integration,
        Self::Argument,
    ];

    /// Heading in the manual.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Law => "The law",
            Self::Joint => "One joint",
            Self::Mechanism => "Mechanisms with friction",
            Self::Frictionless => "Mechanisms without friction",
            Self::Statics => "Statics",
            Self::Integration => "Integration, invariance, energy",
            Self::Argument => "Every argument in every joint",
        }
    }
}

/// A model and where its reference comes from; claims are made of it.
#[derive(Clone, Copy, Debug)]
pub struct Case<'a> {
    /// Part of the manual.
    pub section: Section,
    /// Id, such as `B04a` of the validation suite or `9.11` of the specification's list.
    pub id: &'a str,
    /// The model in words, with its numbers.
    pub model: &'a str,
    /// Where the reference values come from.
    pub source: &'a str,
    /// Arguments of the statement that a wrong treatment of would show here.
    pub covers: &'a [Coverage<'a>],
}

/// When a claim holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rule {
    /// Every error is at most this.
    Below(f64),
    /// Every observed order lies within [`MARGIN`] of this; each level halves the parameters.
    Order(f64),
    /// Every observed order is at least this less [`MARGIN`].
    AtLeastOrder(f64),
    /// Every error is at most a fifth of the one before, whose tolerance was a hundred times as
    /// wide, and the last at most this.
    Falling(f64),
}

/// Margin of observed orders, as the validation suite asks.
pub const MARGIN: f64 = 0.15;

/// One quantity compared with its reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Part of the manual.
    pub section: Section,
    /// Id of the case.
    pub id: String,
    /// The model in words.
    pub model: String,
    /// The quantity with its unit.
    pub quantity: String,
    /// Where the reference comes from.
    pub source: String,
    /// Reference values; empty where they are too many to show.
    pub reference: Vec<f64>,
    /// Our values, one for each reference, or one for each level; empty where they are too many.
    pub ours: Vec<f64>,
    /// Error, or one error for each level.
    pub errors: Vec<f64>,
    /// When it holds.
    pub rule: Rule,
    /// Why the rule is what it is.
    pub why: String,
    /// Arguments that the claim verifies.
    pub covers: Vec<Cell>,
}

impl Case<'_> {
    fn claim(&self, quantity: &str, rule: Rule, why: &str) -> Claim {
        Claim {
            section: self.section,
            id: self.id.into(),
            model: self.model.into(),
            quantity: quantity.into(),
            source: self.source.into(),
            reference: Vec::new(),
            ours: Vec::new(),
            errors: Vec::new(),
            rule,
            why: why.into(),
            covers: self.covers.iter().flat_map(Coverage::cells).collect(),
        }
    }

    /// Our values are the reference values to within `tolerance`, absolutely.
    ///
    /// # Panics
    /// When there are not as many values as references.
    #[must_use]
    pub fn values(
        &self,
        quantity: &str,
        ours: &[f64],
        reference: &[f64],
        tolerance: f64,
        why: &str,
    ) -> Claim {
        assert_eq!(ours.len(), reference.len(), "{}: {quantity}", self.id);
        let differences = ours.iter().zip(reference).map(|(a, b)| (a - b).abs());
        Claim {
            ours: ours.to_vec(),
            reference: reference.to_vec(),
            errors: vec![largest(differences)],
            ..self.claim(quantity, Rule::Below(tolerance), why)
        }
    }

    /// The largest of many errors is at most `tolerance`.
    #[must_use]
    pub fn worst(&self, quantity: &str, error: f64, tolerance: f64, why: &str) -> Claim {
        Claim {
            errors: vec![error.abs()],
            ..self.claim(quantity, Rule::Below(tolerance), why)
        }
    }

    /// Our values at levels of refinement approach the reference as `rule` says.
    #[must_use]
    pub fn limit(
        &self,
        quantity: &str,
        ours: &[f64],
        reference: f64,
        rule: Rule,
        why: &str,
    ) -> Claim {
        Claim {
            reference: vec![reference],
            ours: ours.to_vec(),
            errors: ours.iter().map(|value| (value - reference).abs()).collect(),
            ..self.claim(quantity, rule, why)
        }
    }

    /// Errors at levels of refinement vanish as `rule` says.
    #[must_use]
    pub fn vanishing(&self, quantity: &str, errors: &[f64], rule: Rule, why: &str) -> Claim {
        Claim {
            errors: errors.iter().map(|error| error.abs()).collect(),
            ..self.claim(quantity, rule, why)
        }
    }
}

/// Largest of some numbers; one that is not a number wins, so that it cannot hide.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |m, v| if v > m || v.is_nan() { v } else { m })
}

impl Claim {
    /// Observed orders between the levels.
    #[must_use]
    pub fn orders(&self) -> Vec<f64> {
        let pairs = self.errors.windows(2);
        pairs.map(|pair| (pair[0] / pair[1]).log2()).collect()
    }

    /// Whether it holds; errors that are not numbers never do.
    ///
    /// ```
    /// # use verification::{Case, Rule, Section};
    /// # let case = Case { section: Section::Law, id: "x", model: "", source: "", covers: &[] };
    /// let halved = case.limit("x", &[1.4, 1.2, 1.1, 1.05], 1.0, Rule::Order(1.0), "");
    /// assert!(halved.holds());
    /// assert!(!case.limit("x", &[1.4, 1.2, 1.15], 1.0, Rule::Order(1.0), "").holds());
    /// assert!(!case.values("x", &[f64::NAN], &[1.0], 1.0, "").holds());
    /// ```
    #[must_use]
    pub fn holds(&self) -> bool {
        let orders = self.orders();
        match self.rule {
            Rule::Below(bound) => {
                !self.errors.is_empty() && self.errors.iter().all(|e| *e <= bound)
            }
            Rule::Order(order) => {
                !orders.is_empty() && orders.iter().all(|p| (p - order).abs() <= MARGIN)
            }
            Rule::AtLeastOrder(order) => {
                !orders.is_empty() && orders.iter().all(|p| *p >= order - MARGIN)
            }
            Rule::Falling(bound) => {
                self.errors.windows(2).all(|pair| pair[1] <= 0.2 * pair[0])
                    && self.errors.last().is_some_and(|e| *e <= bound)
            }
        }
    }
}
