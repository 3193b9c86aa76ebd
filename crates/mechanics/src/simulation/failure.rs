//! What stopped a run, in mechanical words.

use numerics::bdf::{self, Bdf};

use super::{Cause, RunError, Simulation};
use crate::dynamics::Dynamics;
use crate::gain::{GainWatch, Jam};
use crate::instant::{Failure, Instant};

impl Simulation {
    /// A failure in mechanical words, with bristles that may be behind it.
    pub(super) fn explain(&self, failure: &Failure) -> String {
        let mut text = self.system.explain(failure);
        let unsound = matches!(failure, Failure::NotConverged { .. } | Failure::Singular(_));
        let memories = self.system.history.frictions.iter();
        let active = memories.zip(&self.system.model().frictions);
        for (memory, friction) in active {
            if let (true, Some(time)) = (unsound, memory.tally.not_passive) {
                text.push_str(&format!(
                    "; {} has been faster than its bristles are passive for since time {time}: a \
                     smaller DAMPING_COEFFICIENT may help",
                    friction.label
                ));
            }
        }
        text
    }

    pub(super) fn error(&self, failure: &Failure) -> RunError {
        RunError {
            time: self.state.time,
            message: self.explain(failure),
            element: self.system.element_of(failure).cloned(),
            cause: cause_of(failure),
        }
    }

    /// A loop of friction and reaction without a sound solution at the present instant.
    pub(super) fn refuse_jam(&self, looked: Result<Option<Jam>, Failure>) -> Result<(), RunError> {
        match looked {
            Ok(Some(jam)) => Err(jammed(self.state.time, &jam)),
            // What is singular is found and named when the step is solved.
            Ok(None) | Err(_) => Ok(()),
        }
    }

    /// An instant that could not be solved: a jam where that explains it, with the reactions as the
    /// iteration left them or as it found them.
    pub(super) fn unsolved(&mut self, failure: &Failure, instant: &Instant) -> RunError {
        self.jam_behind(failure, instant)
            .map_or_else(|| self.error(failure), |jam| jammed(self.state.time, &jam))
    }

    pub(super) fn jam_behind(&mut self, failure: &Failure, instant: &Instant) -> Option<Jam> {
        let mut watch = GainWatch::new(&self.system);
        match failure {
            Failure::NotConverged { .. } | Failure::Singular(_) => watch
                .explain(&mut self.system, &self.multipliers)
                .or_else(|| watch.explain(&mut self.system, instant.guess())),
            _ => None,
        }
    }

    pub(super) fn run_error(
        &self,
        error: &bdf::Error<Failure>,
        dynamics: &mut Dynamics,
        bdf: &Bdf,
    ) -> RunError {
        match error {
            bdf::Error::Failed { time, cause } => RunError {
                time: *time,
                message: format!(
                    "the step could not be solved with the shortest step allowed: {}",
                    self.explain(cause)
                ),
                element: self.system.element_of(cause).cloned(),
                cause: cause_of(cause),
            },
            bdf::Error::Inaccurate { time, size } => {
                let (_, worst) = dynamics.largest_error(bdf.error());
                let (place, element) = dynamics.describe_value(worst);
                RunError {
                    time: *time,
                    message: format!(
                        "the error tolerance cannot be met with the shortest step allowed (the \
                         last try was {size:.3e}); the error is largest in {place}; likely \
                         causes: a discontinuous function, a position where the mechanism \
                         locks, or forces that change faster than HMIN resolves"
                    ),
                    element,
                    cause: Cause::Inaccurate,
                }
            }
        }
    }
}

fn cause_of(failure: &Failure) -> Cause {
    match failure {
        Failure::Singular(_) => Cause::Singular,
        Failure::NotConverged { .. } | Failure::TurnsTooFar { .. } => Cause::NotConverged,
        Failure::NotANumber { .. } => Cause::NotANumber,
        Failure::NoEquilibrium { .. } => Cause::NoEquilibrium,
    }
}

pub(super) fn jammed(time: f64, jam: &Jam) -> RunError {
    RunError {
        time,
        message: format!(
            "{} jams: the friction that a load causes adds {:.3} times as much to that load, and at \
             a gain of one the loads grow without bound; no motion obeys Coulomb's law beyond",
            jam.friction, jam.gain
        ),
        element: Some(jam.friction.clone()),
        cause: Cause::Jam,
    }
}
