//! Static and quasi-static simulations: one equilibrium, or one after another.

use mechanics::Observer;
use results::DataKind;

use crate::checkpoint::{Keeper, UnderWay};
use crate::failure;
use crate::recorder::Observe;
use crate::runner::{Halt, Recorded, Runner};
use crate::sensors::{Effect, Keeping, Sensing, Sensors};
use crate::session::{Outcome, Progress, Watch};
use crate::settings;
use crate::time_span::TimeSpan;

impl Runner<'_> {
    /// Finds the equilibrium of the present time, or with a time span those at its start and at
    /// its outputs; creep goes on from each to the next.
    pub(crate) fn equilibria(
        &mut self,
        span: Option<TimeSpan>,
        under_way: Option<UnderWay>,
        watch: &mut dyn Watch,
    ) -> Result<(), Halt> {
        let (settings, note) = settings::equilibrium(self.dataset.equilibrium.as_ref());
        let settings = self.recorder.role.equilibria(settings);
        let kind = match span {
            None => DataKind::Static,
            Some(_) => DataKind::QuasiStatic,
        };
        let mut sensors = Sensors::new(&self.dataset, &self.lowered.outputs);
        let (start, with_start, taken) = if let Some(under_way) = under_way {
            sensors.hold(&under_way.sensors);
            (under_way.start, under_way.with_start, under_way.taken)
        } else {
            self.log.note("\nBegin Static Solution")?;
            self.log.note(&format!(
                "error {:e}, imbalance {:e}, stability {:e}, at most {} iterations",
                settings.error, settings.imbalance, settings.stability, settings.iterations
            ))?;
            for note in note.into_iter().chain(span.and_then(|span| span.note())) {
                self.log.note(&note)?;
            }
            // An equilibrium that is recorded is where a sequence starts.
            let with_start = span.is_none() || self.instant != Recorded::Equilibrium;
            (self.simulation.state().time, with_start, 0)
        };
        let first = with_start.then_some(start).into_iter();
        let others = span.into_iter().flat_map(|span| span.outputs(start, 0));
        let mut effect = Effect::None;
        for (place, time) in first.chain(others).enumerate().skip(taken) {
            let found = self.simulation.find_equilibrium(time, &settings);
            let found = found.map_err(|error| {
                let source = self.session.project.model_source();
                let message = failure::of_equilibrium(&self.dataset, source, &error);
                Halt::located(Outcome::IntegrationFailed, &message)
            })?;
            if place == 0 {
                self.recorder.begin(kind)?;
            }
            self.log.note(&format!(
                "Static Solution at time {time} converged in {} iterations, residual imbalance \
                 {:.5e}",
                found.iterations, found.imbalance
            ))?;
            let goes_on;
            (effect, goes_on) = self.record_equilibrium(&mut sensors, watch)?;
            // Functions that read what a sensor has just kept are other ones from here on.
            self.take_changes(self.lowered.mode)?;
            sensors.renew(&self.lowered.outputs);
            if effect != Effect::None {
                break;
            }
            if !goes_on || self.keeper.as_ref().is_some_and(Keeper::is_due) {
                self.checkpoint(Some(UnderWay {
                    start,
                    with_start,
                    taken: place + 1,
                    next_row: f64::INFINITY,
                    sensors: sensors.held(),
                }))?;
            }
            if !goes_on {
                return Err(Halt::Ended(Outcome::Interrupted));
            }
        }
        self.simulations += 1;
        self.log.note("End Static Solution\n")?;
        Halt::of_event(effect)
    }

    /// Writes an equilibrium; returns what events do to the run, and whether the watch lets it go on.
    fn record_equilibrium(
        &mut self,
        sensors: &mut Sensors,
        watch: &mut dyn Watch,
    ) -> Result<(Effect, bool), Halt> {
        let snapshot = self.simulation.snapshot();
        let rows = Observe {
            recorder: &mut self.recorder,
            log: &mut self.log,
            watch,
            started: self.started,
            end: self.last_end,
            next_row: f64::INFINITY,
            row_interval: f64::INFINITY,
            length: self.length,
            stop: None,
            interrupted: false,
            taken: 0,
            keeper: None,
            statistics: self.simulation.statistics(),
        };
        let mut observer = Sensing {
            rows,
            sensors,
            effect: Effect::None,
            keeping: Keeping::new(&self.lowered, &mut self.kept),
        };
        observer.output(&snapshot);
        let Sensing {
            rows,
            effect,
            keeping,
            ..
        } = observer;
        self.changed |= keeping.changes_functions;
        let interrupted = rows.interrupted;
        if let Some(stop) = rows.stop {
            return Err(Halt::of_row(Outcome::IntegrationFailed, stop));
        }
        self.instant = Recorded::Equilibrium;
        let progress = Progress {
            time: snapshot.time(),
            end: self.last_end,
            statistics: self.simulation.statistics(),
        };
        Ok((effect, !interrupted && watch.progress(&progress)))
    }
}
