//! SIMULATE to its end and its output times.

use dataset::{Code, Simulate};

/// Output steps of a SIMULATE with neither STEPS nor DTOUT.
const DEFAULT_STEPS: u32 = 50;
/// More outputs than this in one simulation are refused.
const MOST_OUTPUTS: f64 = 1e7;

/// End of a simulation and the time between its outputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TimeSpan {
    pub(crate) end: f64,
    /// Time between two outputs (the last interval may be shorter).
    pub(crate) step: f64,
    /// Number of outputs after the start.
    count: usize,
    /// Whether the SIMULATE says how many outputs it wants.
    pub(crate) is_given: bool,
}

/// Why a SIMULATE cannot be carried out at a time.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub(crate) enum SpanError {
    /// Its end is over.
    #[error("END = {end} is not after the time reached so far, {start}")]
    Past { end: f64, start: f64 },
    /// So many outputs.
    #[error("{0:.3e} outputs are too many: at most {MOST_OUTPUTS:e} are written")]
    Outputs(f64),
}

impl SpanError {
    /// The code of its message.
    pub(crate) const fn code(self) -> Code {
        match self {
            Self::Past { .. } => Code::OutOfRange,
            Self::Outputs(_) => Code::InvalidValue,
        }
    }

    /// What to write instead.
    pub(crate) const fn help(self) -> &'static str {
        match self {
            Self::Past { .. } => "END is a time; DURATION is the length of a simulation",
            Self::Outputs(_) => "write a longer DTOUT",
        }
    }
}

/// The time span of a SIMULATE that starts at `start`; `None` for one that takes no time.
///
/// # Errors
/// What is wrong with it.
pub(crate) fn span(simulate: &Simulate, start: f64) -> Result<Option<TimeSpan>, SpanError> {
    let end = match (simulate.end, simulate.duration) {
        (Some(end), _) => end,
        (None, Some(duration)) => start + duration,
        (None, None) => return Ok(None),
    };
    if !(end > start) {
        return Err(SpanError::Past { end, start });
    }
    let (step, is_given) = match (simulate.steps, simulate.dtout) {
        (_, Some(dtout)) => (dtout.min(end - start), true),
        (Some(steps), None) => ((end - start) / f64::from(steps), true),
        (None, None) => ((end - start) / f64::from(DEFAULT_STEPS), false),
    };
    // An interval that is whole but for rounding is not split.
    let count = ((end - start) / step - 1e-9).ceil().max(1.0);
    if !(count <= MOST_OUTPUTS) {
        return Err(SpanError::Outputs(count));
    }
    Ok(Some(TimeSpan {
        end,
        step,
        count: count as usize,
        is_given,
    }))
}

impl TimeSpan {
    /// Output times `start + k·step`, rising, the last exactly the end; those after the first
    /// `taken`.
    pub(crate) fn outputs(&self, start: f64, taken: usize) -> impl Iterator<Item = f64> + use<> {
        let (step, end, count) = (self.step, self.end, self.count);
        let time = move |k| {
            if k < count {
                start + k as f64 * step
            } else {
                end
            }
        };
        (taken + 1..=count).map(time)
    }

    /// What to tell about it.
    pub(crate) fn note(&self) -> Option<String> {
        let note = || format!("neither STEPS nor DTOUT is given: STEPS={DEFAULT_STEPS} is used");
        (!self.is_given).then(note)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dataset::SimulationKind;

    fn simulate(end: f64, steps: Option<u32>, dtout: Option<f64>) -> Simulate {
        Simulate {
            kind: SimulationKind::Dynamic,
            end: Some(end),
            duration: None,
            steps,
            dtout,
        }
    }

    #[test]
    fn the_last_output_is_the_end() {
        let times = |simulate: &Simulate, start| {
            span(simulate, start)
                .map(|span| span.map_or(Vec::new(), |span| span.outputs(start, 0).collect()))
        };
        assert_eq!(
            times(&simulate(0.25, None, Some(0.1)), 0.0).unwrap(),
            [0.1, 0.2, 0.25]
        );
        assert_eq!(
            times(&simulate(0.3, None, Some(0.1)), 0.0).unwrap(),
            [0.1, 0.2, 0.3]
        );
        assert_eq!(
            times(&simulate(2.0, Some(4), None), 1.0).unwrap(),
            [1.25, 1.5, 1.75, 2.0]
        );
        assert!(times(&simulate(1.0, Some(4), None), 1.0).is_err());
        assert!(times(&simulate(1.0, None, Some(1e-12)), 0.0).is_err());
        let lasting = Simulate {
            end: None,
            duration: Some(1.0),
            ..simulate(0.0, Some(2), None)
        };
        assert_eq!(times(&lasting, 5.0).unwrap(), [5.5, 6.0]);
    }
}
