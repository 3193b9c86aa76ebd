//! A project looked at without running it.

use mechanics::{Moved, Redundancy};

use crate::defaults::{FrictionDefaults, defaults_in_use};
use crate::failure;
use crate::message::{InputError, Message};
use crate::project::Project;
use crate::warnings;

/// What can be said about a project without running it.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckReport {
    /// First line of the dataset.
    pub title: String,
    /// Number of elements by statement, those that occur.
    pub elements: Vec<(&'static str, usize)>,
    /// Degrees of freedom; `None` where the model cannot be assembled.
    pub degrees_of_freedom: Option<usize>,
    /// Equations that depend on others and are left out.
    pub redundancies: Vec<Redundancy>,
    /// Parts that assembly moves.
    pub moved: Vec<Moved>,
    /// Arguments of FRICTION that are left at their defaults.
    pub defaults: Vec<FrictionDefaults>,
    /// Warnings, errors of commands that are not simulated, and why the model cannot be assembled.
    pub messages: Vec<Message>,
}

/// Lowers and assembles a project.
///
/// # Errors
/// Everything in its dataset that is not simulated.
pub fn check(project: &Project) -> Result<CheckReport, InputError> {
    let (_, surveyed) = project.survey()?;
    let mut messages = project.warnings().to_vec();
    messages.extend(surveyed);
    let dataset = project.dataset();
    let mut simulation = project.as_given()?;
    let counts = [
        ("PART", dataset.parts.len()),
        ("POINT_MASS", dataset.point_masses.len()),
        ("MARKER", dataset.markers.len()),
        ("JOINT", dataset.joints.len()),
        ("JPRIM", dataset.primitives.len()),
        ("PTCV", dataset.point_curves.len()),
        ("GCON", dataset.constraints.len()),
        ("COUPLER", dataset.couplers.len()),
        ("GEAR", dataset.gears.len()),
        ("MOTION", dataset.motions.len()),
        ("SFORCE", dataset.single_forces.len()),
        ("SPRINGDAMPER", dataset.spring_dampers.len()),
        ("VFORCE", dataset.vector_forces.len()),
        ("VTORQUE", dataset.vector_torques.len()),
        ("GFORCE", dataset.general_forces.len()),
        ("BUSHING", dataset.bushings.len()),
        ("FIELD", dataset.fields.len()),
        ("BEAM", dataset.beams.len()),
        ("CONTACT", dataset.contacts.len()),
        ("FRICTION", dataset.frictions.len()),
        ("VARIABLE", dataset.variables.len()),
        ("DIFF", dataset.differentials.len()),
        ("ARRAY", dataset.arrays.len()),
        ("MATRIX", dataset.matrices.len()),
        ("STRING", dataset.strings.len()),
        ("LSE", dataset.linear_equations.len()),
        ("TFSISO", dataset.transfer_functions.len()),
        ("REQUEST", dataset.requests.len()),
        ("MREQUEST", dataset.multiple_requests.len()),
        ("SENSOR", dataset.sensors.len()),
    ];
    let mut report = CheckReport {
        title: dataset.title.clone(),
        elements: counts.into_iter().filter(|(_, count)| *count > 0).collect(),
        degrees_of_freedom: None,
        redundancies: Vec::new(),
        moved: Vec::new(),
        defaults: defaults_in_use(dataset),
        messages,
    };
    match simulation.assemble() {
        Ok(assembly) => {
            report.degrees_of_freedom = Some(simulation.system().degrees_of_freedom());
            let noteworthy = warnings::of_assembly(project, &assembly, simulation.model());
            report.messages.extend(noteworthy);
            report.redundancies = assembly.redundant;
            report.moved = assembly.moved;
        }
        Err(error) => {
            let source = project.model_source();
            let message = failure::of_assembly(dataset, source, &error);
            report.messages.push(message);
        }
    }
    Ok(report)
}

impl std::fmt::Display for CheckReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for message in &self.messages {
            write!(f, "{message}")?;
        }
        writeln!(f, "{}", self.title)?;
        let counts: Vec<String> = self
            .elements
            .iter()
            .map(|(name, count)| format!("{count} {name}"))
            .collect();
        writeln!(f, "elements: {}", counts.join(", "))?;
        if let Some(freedoms) = self.degrees_of_freedom {
            writeln!(f, "degrees of freedom: {freedoms}")?;
        }
        if !self.redundancies.is_empty() {
            writeln!(f, "redundant equations, left out:")?;
            for dropped in &self.redundancies {
                writeln!(f, "  {} in {}", dropped.equation, dropped.owner)?;
            }
        }
        for moved in &self.moved {
            writeln!(
                f,
                "assembly moves {} by {:.3e} and turns it by {:.3e} rad",
                moved.body, moved.distance, moved.angle
            )?;
        }
        for defaults in &self.defaults {
            writeln!(f, "{defaults}")?;
        }
        Ok(())
    }
}
