//! LIST of a FRICTION command: the values of all arguments for the message file.

use dataset::{Dataset, Formulation, FrictionInputs, FrictionQuantity, Switchable};

use crate::channels::{name, unit_names};
use crate::defaults::with_unit;

/// The values of all arguments of a FRICTION with their units, one a line; defaults and what the
/// friction does not use are marked. `None` where there is no such FRICTION.
pub(crate) fn friction(dataset: &Dataset, id: u32) -> Option<String> {
    let friction = dataset.frictions.by_id(id)?;
    let joint = dataset.joints.by_id(friction.joint)?;
    let units = unit_names(dataset);
    let rests = if dataset.is_active(Switchable::Friction, id) {
        ""
    } else {
        ", deactivated"
    };
    let mut text = format!(
        "FRICTION/{id} ({}) in the {} JOINT/{} ({}){rests}\n",
        name(&friction.header, "FRICTION"),
        joint.kind.keyword(),
        friction.joint,
        name(&joint.header, "JOINT"),
    );
    let no_overlap = if joint.kind.translates() {
        String::new()
    } else {
        format!("not used by a {} joint", joint.kind.keyword())
    };
    let no_effect = match friction.formulation {
        Formulation::Original => "",
        Formulation::LuGre => "not used by FORMULATION = LUGRE",
    };
    let mut line = |keyword: &str, value: &str, remark: &str| {
        let row = format!("  {keyword:<32}{value:<24}{remark}");
        text += row.trim_end();
        text.push('\n');
    };
    if let Some(yoke) = friction.yoke {
        line("YOKE", yoke.keyword(), "");
    }
    line("FORMULATION", friction.formulation.keyword(), "");
    line("MU_STATIC", &friction.mu_static.to_string(), "");
    line("MU_DYNAMIC", &friction.mu_dynamic.to_string(), "");
    line("EFFECT", friction.effect.keyword(), no_effect);
    line("INPUTS", &inputs(friction.inputs), "");
    line(
        "OVERLAP_DELTA",
        friction.overlap_delta.keyword(),
        &no_overlap,
    );
    let during = if friction.inactive_static {
        "STATIC"
    } else {
        "none"
    };
    line("INACTIVE", during, "");
    for quantity in FrictionQuantity::ALL {
        let value = with_unit(quantity, friction.value(quantity), &units);
        let remark = match friction.unused(quantity, joint.kind) {
            Some(by) => format!("not used by {by}"),
            None if friction.given(quantity).is_none() => "default".to_owned(),
            None => String::new(),
        };
        line(quantity.keyword(), &value, &remark);
    }
    Some(text)
}

fn inputs(inputs: FrictionInputs) -> String {
    let names = [
        ("PRELOAD", inputs.preload),
        ("REACTION_FORCE", inputs.reaction_force),
        ("BENDING_MOMENT", inputs.bending_moment),
        ("TORSIONAL_MOMENT", inputs.torsional_moment),
    ];
    let on: Vec<&str> = names
        .into_iter()
        .filter_map(|(name, on)| on.then_some(name))
        .collect();
    match on.len() {
        0 => "NONE".to_owned(),
        4 => "ALL".to_owned(),
        _ => on.join(":"),
    }
}
