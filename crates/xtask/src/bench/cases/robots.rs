//! The delta robot of the examples.

use std::path::Path;

use stiction::Project;

use crate::bench::case::{Case, Reference};

pub(super) fn delta(root: &Path) -> Result<Case, String> {
    let project = Project::load(&root.join("examples/delta-robot/delta.adm"));
    let project = project.map_err(|error| error.to_string())?;
    let mut simulation = project.simulation().map_err(|error| error.to_string())?;
    simulation.assemble().map_err(|error| error.to_string())?;
    Ok(Case {
        name: "delta",
        title: "Delta robot",
        description: "The robot of the examples: three arms, twelve ball joints with ORIGINAL friction, \
                      0.8 s there and half way back.",
        simulation,
        end: 0.8,
        read: |simulation| {
            let bodies = &simulation.model().bodies;
            let platform = bodies.iter().position(|body| body.label.id == 4);
            platform.map_or(Vec::new(), |body| {
                simulation.state().centre(body).iter().copied().collect()
            })
        },
        quantity: "largest coordinate of the platform at the end, m",
        reference: Reference::Own(1e-10),
        tightest: -9,
        peers: Vec::new(),
    })
}
