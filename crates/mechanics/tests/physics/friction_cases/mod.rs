//! Friction against closed forms and exact stick-slip solutions: all errors in one table.
//!
//! A regularised law approaches the set-valued one (exact stick and slip) with the first power of
//! its transition velocity Vs and largest creep Dm: both are halved three times, and the order is
//! observed. Two kinds of values converge faster. A stop without load comes back to where the creep
//! is zero, which leaves the work missing below Vs, `O(Vs²)`; and so do angles (not times) of
//! turning points. Cases whose solution with the law itself is known are compared at one Vs and Dm.

mod law;
mod linkages;
mod sliding;
mod turning;

/// How a row passes.
#[derive(Clone, Copy)]
pub(crate) enum Rule {
    /// Observed orders over the three halvings within 0.15 of this.
    Order(f64),
    /// Observed orders over the three halvings of at least 0.85: first order and faster.
    AtLeastFirst,
    /// Every error below this.
    Below(f64),
}

/// One line of the table.
pub(crate) struct Row {
    case: String,
    quantity: &'static str,
    /// At the levels of refinement, or one error.
    errors: Vec<f64>,
    rule: Rule,
}

impl Row {
    fn new(case: impl Into<String>, quantity: &'static str, errors: Vec<f64>, rule: Rule) -> Self {
        Self {
            case: case.into(),
            quantity,
            errors,
            rule,
        }
    }

    fn orders(&self) -> Vec<f64> {
        self.errors
            .windows(2)
            .map(|pair| (pair[0] / pair[1]).abs().log2())
            .collect()
    }

    fn passes(&self) -> bool {
        match self.rule {
            // The margin of 0.15 is that of the reference.
            Rule::Order(order) => self.orders().iter().all(|p| (p - order).abs() <= 0.15),
            Rule::AtLeastFirst => self.orders().iter().all(|p| *p >= 0.85),
            Rule::Below(bound) => self.errors.iter().all(|error| *error <= bound),
        }
    }

    fn print(&self) {
        let list = |values: &[f64], digits: fn(f64) -> String| {
            values
                .iter()
                .map(|v| digits(*v))
                .collect::<Vec<_>>()
                .join(" ")
        };
        let errors = list(&self.errors, |v| format!("{:>9.2e}", v.abs()));
        let rule = match self.rule {
            Rule::Order(_) | Rule::AtLeastFirst => list(&self.orders(), |p| format!("{p:.2}")),
            Rule::Below(bound) => format!("below {bound:.0e}"),
        };
        let mark = if self.passes() { "" } else { "  <-- fails" };
        println!(
            "{:<38} {:<20} {errors:<40} {rule}{mark}",
            self.case, self.quantity
        );
    }
}

/// Factors of Vs and Dm.
const HALVINGS: [f64; 4] = [1.0, 0.5, 0.25, 0.125];

#[test]
fn friction_meets_the_references() {
    let mut rows = sliding::rows();
    rows.extend(law::rows());
    rows.extend(turning::rows());
    rows.extend(linkages::rows());
    println!(
        "\nfriction: errors at Vs and Dm halved three times, with observed orders; or one error\n\
         {:<38} {:<20} {:<40} orders or bound",
        "case", "quantity", "errors"
    );
    for row in &rows {
        row.print();
    }
    let failed: Vec<&str> = rows
        .iter()
        .filter(|row| !row.passes())
        .map(|row| row.case.as_str())
        .collect();
    assert!(failed.is_empty(), "{failed:?}");
}
