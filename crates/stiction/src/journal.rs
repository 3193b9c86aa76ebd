//! The message file: what a person wants to read about a run.

use std::collections::HashSet;
use std::io::{self, Write};

use dataset::{Code, Dataset, Severity};
use mechanics::model::{Label, Model, Reactions};
use mechanics::{Assembly, Formulation, Settings, Sliding, Snapshot, Statistics, System};
use results::{DataKind, MessageWriter, StepRow};
use serde::{Deserialize, Serialize};

use crate::about::about;
use crate::accuracy::AccuracyReport;
use crate::balance::EnergyBalance;
use crate::defaults::defaults_in_use;
use crate::lower::APPLIED;
use crate::message::Message;
use crate::project::Project;
use crate::report::{FrictionReport, friction_table};
use crate::session::{Outcome, OutputError};
use crate::warnings;
use crate::wrenches::Wrenches;

/// Writer of the message file of a run.
pub(crate) struct Journal<'p, W: Write> {
    writer: MessageWriter<W>,
    path: String,
    project: &'p Project,
    told: Told,
    /// Processor time before the run, seconds; negative where it was resumed.
    processor: Option<f64>,
}

/// What a message file holds so far, as far as the rest of it depends on that.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Told {
    warnings: usize,
    /// Messages that the run itself gave reason for.
    messages: Vec<Message>,
    /// Processor time of the run, seconds.
    processor: Option<f64>,
    /// Frictions whose overlap has been warned about.
    exhausted: HashSet<usize>,
    /// Elements whose redundant equations have been warned about.
    broken: HashSet<Label>,
    /// Outputs told of that have the reactions of their step.
    rough: usize,
    /// Jumps told of that motions have stayed at.
    slidings: usize,
    /// Time told of from which the equations are stiff.
    stiff_from: Option<f64>,
}

/// Redundant equations that are off by this part of the model's length, or as many radians, no
/// longer hold.
const BROKEN: f64 = 1e-3;

impl<'p, W: Write> Journal<'p, W> {
    pub(crate) fn new(writer: MessageWriter<W>, path: String, project: &'p Project) -> Self {
        Self {
            writer,
            path,
            project,
            told: Told::default(),
            processor: processor_time(),
        }
    }

    /// Goes on with a message file.
    pub(crate) fn resume(
        writer: MessageWriter<W>,
        path: String,
        project: &'p Project,
        told: Told,
    ) -> Self {
        let now = processor_time();
        let processor = now.zip(told.processor).map(|(now, used)| now - used);
        Self {
            writer,
            path,
            project,
            told,
            processor,
        }
    }

    /// What it holds so far.
    pub(crate) fn told(&self) -> Told {
        Told {
            processor: self.processor_used(),
            ..self.told.clone()
        }
    }

    pub(crate) fn error(&self, error: &io::Error) -> OutputError {
        OutputError::new(self.path.clone(), error)
    }

    /// What it writes to.
    pub(crate) fn get_ref(&self) -> &W {
        self.writer.get_ref()
    }

    fn processor_used(&self) -> Option<f64> {
        let both = processor_time().zip(self.processor);
        both.map(|(now, start)| now - start)
    }

    fn check(&self, written: io::Result<()>) -> Result<(), OutputError> {
        written.map_err(|error| self.error(&error))
    }

    /// Number of warnings so far.
    pub(crate) fn warnings(&self) -> usize {
        self.told.warnings
    }

    pub(crate) fn command(&mut self, echo: &str) -> Result<(), OutputError> {
        let written = self.writer.command(echo);
        self.check(written)
    }

    pub(crate) fn note(&mut self, text: &str) -> Result<(), OutputError> {
        let written = self.writer.note(text);
        self.check(written)
    }

    /// A warning that the run gives reason for, about an element of the model or all of it.
    pub(crate) fn warning(
        &mut self,
        code: Code,
        element: Option<&Label>,
        text: String,
    ) -> Result<(), OutputError> {
        self.report(Severity::Warning, code, element, text)
    }

    fn report(
        &mut self,
        severity: Severity,
        code: Code,
        element: Option<&Label>,
        text: String,
    ) -> Result<(), OutputError> {
        let project = self.project;
        let (dataset, source) = (project.dataset(), project.model_source());
        let about = about(dataset, source, severity, code, element, text);
        self.judged(Message::new(about, source))
    }

    /// A message that the run gives reason for, where it is to be told.
    pub(crate) fn judged(&mut self, message: Message) -> Result<(), OutputError> {
        match self.project.levels.judge(message) {
            Some(message) => self.tell(message),
            None => Ok(()),
        }
    }

    fn tell(&mut self, message: Message) -> Result<(), OutputError> {
        self.message(&message)?;
        self.told.messages.push(message);
        Ok(())
    }

    /// A command that has failed: how, and the message about it where there is one.
    pub(crate) fn failed(
        &mut self,
        outcome: &Outcome,
        message: Option<Message>,
    ) -> Result<(), OutputError> {
        self.told.messages.extend(message);
        let written = match outcome {
            Outcome::Refused(text)
            | Outcome::AssemblyFailed(text)
            | Outcome::IntegrationFailed(text) => self.writer.error(text),
            Outcome::Completed | Outcome::Interrupted => Ok(()),
        };
        self.check(written)
    }

    /// The messages that the run itself gave reason for.
    pub(crate) fn into_messages(self) -> Vec<Message> {
        self.told.messages
    }

    pub(crate) fn step_row(&mut self, row: &StepRow) -> Result<(), OutputError> {
        let written = self.writer.step_row(row);
        self.check(written)
    }

    /// Writes a message.
    pub(crate) fn message(&mut self, message: &Message) -> Result<(), OutputError> {
        let text = message.to_string();
        let text = text.trim_end();
        let written = match message.diagnostic.severity {
            Severity::Error => self.writer.error(text),
            Severity::Warning => {
                self.told.warnings += 1;
                self.writer.warning(text)
            }
            Severity::Note => self.writer.note(text),
        };
        self.check(written)
    }

    /// Title, size of the model and defaults in use.
    pub(crate) fn model(&mut self, dataset: &Dataset, model: &Model) -> Result<(), OutputError> {
        let written = self.writer.title(&dataset.title);
        self.check(written)?;
        let forces = APPLIED
            .iter()
            .map(|applied| applied.elements(dataset).count());
        let forces: usize = forces.sum();
        self.note(&format!(
            "{} moving parts, {} joints, {} motions, {} general constraints, {} forces, {} \
             frictions, {} variables, {} requests",
            model.bodies.len(),
            model.joints.len(),
            model.motions.len(),
            model.constraints.len(),
            forces,
            model.frictions.len(),
            dataset.variables.len(),
            dataset.all_requests().len(),
        ))?;
        for line in defaults_in_use(dataset) {
            self.note(&line.to_string())?;
        }
        Ok(())
    }

    /// What assembly did, degrees of freedom and redundant equations.
    pub(crate) fn assembly(
        &mut self,
        assembly: &Assembly,
        system: &System,
    ) -> Result<(), OutputError> {
        let (model, freedoms) = (system.model(), system.degrees_of_freedom());
        let own_length = system.length_scale();
        let redundant: Vec<(String, String)> = assembly
            .redundant
            .iter()
            .map(|dropped| (dropped.equation.clone(), dropped.owner.to_string()))
            .collect();
        let count = i64::try_from(freedoms).unwrap_or(i64::MAX);
        let written = self.writer.degrees_of_freedom(count, &redundant);
        self.check(written)?;
        if let (Reactions::LeastSquares { length }, false) =
            (model.reactions, assembly.redundant.is_empty())
        {
            let length = length.unwrap_or(own_length);
            self.note(&format!(
                "reactions of redundant constraints: the least squares of forces and of torques \
                 divided by {length:.6e}"
            ))?;
        }
        for moved in &assembly.moved {
            self.note(&format!(
                "assembly moved {} by {:.3e} and turned it by {:.3e} rad",
                moved.body, moved.distance, moved.angle
            ))?;
        }
        for change in &assembly.velocity_changes {
            self.note(&format!(
                "assembly changed the velocity of {} by {:.3e}, its angular velocity by {:.3e}",
                change.body, change.linear, change.angular
            ))?;
        }
        for message in warnings::of_assembly(self.project, assembly, model) {
            self.tell(message)?;
        }
        Ok(())
    }

    /// Head of a simulation.
    pub(crate) fn begin(
        &mut self,
        kind: DataKind,
        settings: &Settings,
        notes: &[String],
        start: f64,
    ) -> Result<(), OutputError> {
        let analysis = match kind {
            DataKind::Kinematic => "Kinematic",
            _ => "Dynamic",
        };
        let name = match settings.formulation {
            Formulation::I3 => "BDF I3",
            Formulation::Si2 => "BDF SI2",
            Formulation::Adams => "Adams-Moulton",
            Formulation::Hht { .. } => "HHT I3",
            Formulation::Newmark { .. } => "Newmark I3",
        };
        let written = self.writer.begin_simulation(analysis, name, settings.error);
        self.check(written)?;
        for note in notes {
            self.note(note)?;
        }
        self.note(&format!(
            "steps of {:e} to {:e}, order at most {}, at most {} iterations\n",
            settings.shortest_step,
            settings.longest_step,
            settings.highest_order,
            settings.corrector.most_iterations(false)
        ))?;
        let written = self.writer.step_table();
        self.check(written)?;
        self.step_row(&StepRow {
            time: start,
            step: settings.first_step.unwrap_or(0.0),
            evaluations: 0,
            steps: 0,
            order: 1,
            elapsed: 0.0,
        })
    }

    /// End of a simulation that went through.
    pub(crate) fn end(&mut self, statistics: &Statistics) -> Result<(), OutputError> {
        self.statistics(statistics)?;
        let written = self.writer.end_simulation();
        self.check(written)
    }

    fn statistics(&mut self, statistics: &Statistics) -> Result<(), OutputError> {
        let (steps, work) = (&statistics.steps, &statistics.work);
        self.note(&format!(
            "so far: {} steps, {} rejected by the error test, {} not solved, {} starts, {} \
             residuals, {} factorisations",
            steps.steps,
            steps.rejections,
            steps.failures,
            steps.starts,
            work.residuals,
            work.factorisations
        ))?;
        let before = std::mem::replace(&mut self.told.stiff_from, statistics.stiff_from);
        if let Some(time) = statistics
            .stiff_from
            .filter(|_| before != statistics.stiff_from)
        {
            let text = format!(
                "from time {time:.6} on by GSTIFF, SI2: the equations are stiff, and steps by the \
                 integrator that was asked for are short, or have no solution again and again"
            );
            self.report(Severity::Note, Code::Stiff, None, text)?;
        }
        let rough = statistics.rough_outputs
            - std::mem::replace(&mut self.told.rough, statistics.rough_outputs);
        if rough == 0 {
            return Ok(());
        }
        let text = format!(
            "at {rough} outputs the reactions are those of the step around them: the damping of \
             bristles that are not passive left the instant without a solution"
        );
        self.warning(Code::StepReactions, None, text)
    }

    /// Tells of the jumps of functions that the motion has stayed at, those told before left out.
    pub(crate) fn slidings(&mut self, slidings: &[Sliding]) -> Result<(), OutputError> {
        for sliding in slidings.iter().skip(self.told.slidings) {
            let text = format!(
                "{}: {} jumps to and fro from time {:.6} on; the motion is held there, with a value \
                 between those of its sides, and its argument to {:.1e}",
                sliding.element, sliding.function, sliding.time, sliding.width
            );
            self.report(Severity::Note, Code::Chatter, Some(&sliding.element), text)?;
        }
        self.told.slidings = slidings.len();
        Ok(())
    }

    /// Warns once for each sliding joint that has left its guide.
    pub(crate) fn watch_overlap(&mut self, wrenches: &Wrenches<'_>) -> Result<(), OutputError> {
        let snapshot = wrenches.snapshot();
        for (place, friction) in snapshot.model().frictions.iter().enumerate() {
            let exhausted = wrenches.friction(place).load.overlap_exhausted;
            if exhausted && self.told.exhausted.insert(place) {
                let text = format!(
                    "{}: the overlap of its joint is used up at time {}; a thousandth of \
                     INITIAL_OVERLAP is kept",
                    friction.label,
                    snapshot.time()
                );
                self.warning(Code::OverlapUsedUp, Some(&friction.label), text)?;
            }
        }
        Ok(())
    }

    /// Warns once for each element whose redundant equations have ceased to hold: what was left
    /// out then restrains the motion, and the results are those of another model.
    pub(crate) fn watch_redundant(
        &mut self,
        snapshot: &Snapshot<'_>,
        length: f64,
    ) -> Result<(), OutputError> {
        let broken: Vec<_> = snapshot.broken(BROKEN, length).collect();
        for unmet in broken {
            if self.told.broken.insert(unmet.owner.clone()) {
                let text = format!(
                    "{unmet} at time {}: this equation was left out as redundant, but the motion \
                     no longer meets it; joints or motions contradict one another",
                    snapshot.time()
                );
                self.warning(Code::RedundantBroken, Some(&unmet.owner), text)?;
            }
        }
        Ok(())
    }

    /// The table of eigenvalues, cycles/second.
    pub(crate) fn eigenvalues(
        &mut self,
        time: f64,
        values: &[[f64; 2]],
    ) -> Result<(), OutputError> {
        let written = self.writer.eigenvalues(time, values);
        self.check(written)
    }

    /// The table of friction, and what LUGRE did that one should know.
    pub(crate) fn frictions(&mut self, reports: &[FrictionReport]) -> Result<(), OutputError> {
        let table = friction_table(reports);
        if !table.is_empty() {
            self.note(&format!("\nFriction:\n{table}"))?;
        }
        for report in reports {
            for (severity, code, text) in report.remarks() {
                self.report(severity, code, Some(&report.friction), text)?;
            }
        }
        Ok(())
    }

    /// The energy balance of the run, with a warning where it does not close.
    pub(crate) fn balance(&mut self, balance: &EnergyBalance) -> Result<(), OutputError> {
        let unit = &balance.unit;
        self.note(&format!("\nEnergy balance ({unit}):\n{balance}\n"))?;
        if balance.is_suspicious() {
            let text = format!(
                "the energy balance of the run does not close: {:.1e} of the energy exchanged is \
                 unaccounted for; a smaller error of the INTEGRATOR makes the results better",
                balance.residual_share()
            );
            self.warning(Code::EnergyBalance, None, text)?;
        }
        Ok(())
    }

    /// How accurate the run is, and what has to be said about that.
    pub(crate) fn accuracy(&mut self, report: &AccuracyReport) -> Result<(), OutputError> {
        self.note(&format!("\nAccuracy:\n{report}"))?;
        let mut messages = report.messages(self.project).into_iter();
        messages.try_for_each(|message| self.judged(message))
    }

    /// The end: what failed that has not been told, and the timing.
    pub(crate) fn finish(
        &mut self,
        completed: bool,
        failure: Option<&str>,
        elapsed: f64,
    ) -> Result<(), OutputError> {
        let cpu = self.processor_used().unwrap_or(elapsed);
        let told = failure.map_or(Ok(()), |text| self.writer.error(text));
        let written = told.and_then(|()| match completed {
            true => self.writer.finish(elapsed, cpu),
            false => self.writer.timing(elapsed, cpu),
        });
        self.check(written)
    }
}

/// Processor time of this thread in seconds, where the system tells it.
fn processor_time() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
    Some(nanoseconds * 1e-9)
}
