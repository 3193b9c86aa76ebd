//! What a model holds, as JSON.

use dataset::{Dimension, Friction, FrictionInputs, FrictionQuantity, Header};
use serde_json::{Value, json};
use stiction::sink::UnitNames;
use stiction::{Project, unit_of};

/// Title, units, elements by statement, and what is known of joints, parts and frictions.
pub(crate) fn of(project: &Project) -> Value {
    let dataset = project.dataset();
    let elements = dataset.headers().map(|(statement, header)| {
        json!({ "statement": statement, "id": header.id, "name": name(statement, header),
            "path": header.name })
    });
    let joints = dataset.joints.iter().map(|joint| {
        json!({ "id": joint.header.id, "kind": joint.kind.keyword(), "i": joint.i, "j": joint.j })
    });
    let parts = dataset
        .parts
        .iter()
        .map(|part| json!({ "id": part.header.id, "ground": part.ground, "mass": part.mass }));
    let units = project.unit_names();
    let frictions = dataset.frictions.iter().map(|one| friction(one, &units));
    json!({
        "title": dataset.title,
        "prefix": project.prefix(),
        "commands": project.commands().iter().map(|command| &command.echo).collect::<Vec<_>>(),
        "is_dataset_alone": project.is_dataset_alone(),
        "gravity": dataset.gravity,
        "units": {
            "length": units.length, "mass": units.mass, "force": units.force,
            "time": units.time, "angle": units.angle,
        },
        "elements": elements.collect::<Vec<_>>(),
        "joints": joints.collect::<Vec<_>>(),
        "parts": parts.collect::<Vec<_>>(),
        "frictions": frictions.collect::<Vec<_>>(),
    })
}

/// The name as in results: the last part of that of Adams View, else statement and id.
fn name(statement: &str, header: &Header) -> String {
    let written = header.name.as_deref().unwrap_or_default();
    match written.rsplit('.').next().unwrap_or_default() {
        "" => format!("{statement}_{}", header.id),
        last => last.to_owned(),
    }
}

fn friction(friction: &Friction, units: &UnitNames) -> Value {
    // In the order of the statement's page, which an object would not keep.
    let mut arguments = Vec::new();
    let mut put = |keyword: &str, value: Value, dimension: Dimension, given: bool| {
        let keyword = keyword.to_ascii_lowercase();
        arguments.push(json!([keyword, value, unit_of(dimension, units), given]));
    };
    let plain = Dimension::Number;
    put(
        "FORMULATION",
        friction.formulation.keyword().into(),
        plain,
        true,
    );
    put("MU_STATIC", friction.mu_static.into(), plain, true);
    put("MU_DYNAMIC", friction.mu_dynamic.into(), plain, true);
    put("EFFECT", friction.effect.keyword().into(), plain, true);
    put("INPUTS", inputs(&friction.inputs).into(), plain, true);
    put(
        "OVERLAP_DELTA",
        friction.overlap_delta.keyword().into(),
        plain,
        true,
    );
    for quantity in FrictionQuantity::ALL {
        let given = friction.given(quantity).is_some();
        let value = friction.value(quantity);
        put(
            quantity.keyword(),
            value.into(),
            quantity.dimension(),
            given,
        );
    }
    json!({
        "id": friction.header.id,
        "joint": friction.joint,
        "yoke": friction.yoke.map(|yoke| yoke.keyword()),
        "inactive_static": friction.inactive_static,
        "arguments": arguments,
    })
}

fn inputs(inputs: &FrictionInputs) -> Vec<&'static str> {
    let all = [
        ("PRELOAD", inputs.preload),
        ("REACTION_FORCE", inputs.reaction_force),
        ("BENDING_MOMENT", inputs.bending_moment),
        ("TORSIONAL_MOMENT", inputs.torsional_moment),
    ];
    all.into_iter()
        .filter_map(|(word, on)| on.then_some(word))
        .collect()
}
