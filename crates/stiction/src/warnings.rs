//! What is noteworthy about a model that assembles.

use dataset::{Code, Severity};
use mechanics::Assembly;
use mechanics::model::Model;

use crate::about::about;
use crate::message::Message;
use crate::project::Project;

/// The warnings about an assembled model.
pub(crate) fn of_assembly(project: &Project, assembly: &Assembly, model: &Model) -> Vec<Message> {
    let (dataset, source) = (project.dataset(), project.model_source());
    let not_unique = assembly.not_unique.iter().map(|&friction| {
        let friction = &model.frictions[friction];
        let text = format!(
            "the reaction of {}, which loads {}, is not unique",
            model.joints[friction.joint].label, friction.label
        );
        let code = Code::ReactionNotUnique;
        let element = Some(&friction.label);
        let mut warning = about(dataset, source, Severity::Warning, code, element, text);
        warning
            .note("its friction depends on which of the redundant equations are left out")
            .help(
                "constrain the mechanism once, with joints that leave more freedoms, or let joints \
                 share reactions: --reactions least-squares",
            );
        warning
    });
    let massless = assembly.massless.iter().map(|massless| {
        let body = &massless.body;
        let text = match massless.turns {
            true => format!("{body} has no inertia and can turn while all with mass stands still"),
            false => format!("{body} has no mass and can move while all with mass stands still"),
        };
        let code = Code::MasslessPart;
        let mut warning = about(dataset, source, Severity::Warning, code, Some(body), text);
        warning
            .note("its accelerations have no equation: a simulation that needs them fails")
            .help("give it mass and inertia, or fix it on another part");
        warning
    });
    let messages = not_unique
        .chain(massless)
        .map(|diagnostic| Message::new(diagnostic, source));
    project.levels.judge_all(messages.collect())
}
