//! The option of a run that says which reactions redundant constraints have.

use mechanics::model::Reactions;

use crate::argument::ArgumentError;

/// Names of the choices, as users write them.
const KEPT: &str = "kept";
const LEAST_SQUARES: &str = "least-squares";

/// The choice of that name, `kept` or `least-squares`; `length` is what least squares divide torques by,
/// in the unit of the model, where it is not the length of the model.
///
/// ```
/// use mechanics::model::Reactions;
/// let chosen = stiction::reactions("least-squares", Some(20.0)).expect("there is such a choice");
/// assert_eq!(chosen, Reactions::LeastSquares { length: Some(20.0) });
/// ```
///
/// # Errors
/// Another name; a length that is not positive, or that nothing is divided by.
pub fn reactions(name: &str, length: Option<f64>) -> Result<Reactions, ArgumentError> {
    if length.is_some_and(|length| !(length > 0.0 && length.is_finite())) {
        let text = "the length of reactions must be a positive number";
        return Err(ArgumentError::Value(text.to_owned()));
    }
    match name {
        KEPT if length.is_some() => {
            let text = "a length of reactions is for least-squares alone";
            Err(ArgumentError::Value(text.to_owned()))
        }
        KEPT => Ok(Reactions::OfKept),
        LEAST_SQUARES => Ok(Reactions::LeastSquares { length }),
        _ => Err(ArgumentError::Value(format!(
            "reactions are {KEPT} or {LEAST_SQUARES}, not {name}"
        ))),
    }
}

/// A choice as a user writes it.
pub(crate) fn in_words(reactions: Reactions) -> String {
    match reactions {
        Reactions::OfKept => KEPT.to_owned(),
        Reactions::LeastSquares { length: None } => LEAST_SQUARES.to_owned(),
        Reactions::LeastSquares {
            length: Some(length),
        } => format!("{LEAST_SQUARES} with the length {length}"),
    }
}
