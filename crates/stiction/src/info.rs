//! INFO and TIME: what they write to the message file.

use dataset::Request;

use crate::channels::{evaluate, unit, unit_names};
use crate::lower::lower;
use crate::project::SourcedCommand;
use crate::runner::{Halt, Runner};
use crate::text_table::text_table;
use crate::wrenches::Wrenches;

impl Runner<'_> {
    /// INFO: what a REQUEST of these markers would report at this instant.
    pub(crate) fn info(&mut self, request: &Request, step: &SourcedCommand) -> Result<(), Halt> {
        self.prepare(self.lowered.mode)?;
        self.record_start()?;
        let mut dataset = self.dataset.clone();
        let place = dataset.requests.len();
        dataset.requests.push(request.clone());
        let source = self.session.project.model_source().name();
        let setting = self.setting(self.lowered.mode);
        // The numbering of the run stays as it is: the list is a copy.
        let lowered = lower(&dataset, source, &mut self.measures.clone(), &setting);
        let lowered = lowered.map_err(|diagnostics| {
            let text: Vec<String> = diagnostics.into_iter().map(|d| d.message).collect();
            self.refuse(step, text.join("; "), "ask for markers that are there")
        })?;
        let mut probe = self.simulation.clone();
        let restored = probe.restore(lowered.model, &self.simulation.save());
        restored.map_err(|error| self.refuse(step, error.to_string(), "leave the INFO out"))?;
        let snapshot = probe.snapshot();
        let values = evaluate(&lowered.outputs, &Wrenches::new(&snapshot));
        let units = unit_names(&dataset);
        let columns = lowered.outputs.requests[place].columns.iter().flatten();
        let rows = columns.map(|column| {
            [
                column.name.clone(),
                format!("{:.6e}", values[column.value as usize] + 0.0),
                unit(&column.unit, &units),
            ]
        });
        let table = text_table(["component", "value", "unit"], 1, rows);
        let time = snapshot.time();
        self.log.note(&format!("at time {time}:\n{table}"))?;
        Ok(())
    }

    /// TIME: of the model and of the run.
    pub(crate) fn time(&mut self) -> Result<(), Halt> {
        let time = self.simulation.state().time;
        let elapsed = self.started.elapsed().as_secs_f64();
        self.log
            .note(&format!("time {time}, {elapsed:.2} s elapsed"))?;
        Ok(())
    }
}
