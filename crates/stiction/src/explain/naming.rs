//! Which friction a name means: its own, its id, or its joint's.

use std::path::Path;

use results::{FRICTION_DETAIL, ResFile};
use serde_json::Value;

use super::{ExplainError, label};

/// What a friction is called.
pub(super) struct Names {
    pub(super) id: u32,
    /// Its own name.
    name: String,
    /// Its joint as messages call it: `JOINT/28 (GUIDE)`.
    joint: Option<String>,
}

impl Names {
    /// What pictures call it.
    pub(super) fn title(&self) -> String {
        let own = label(self.id, &self.name);
        match &self.joint {
            Some(joint) => format!("{own} in {joint}"),
            None => own,
        }
    }

    /// Everything that means it, what is shortest to write first.
    fn all(&self) -> impl Iterator<Item = String> {
        let id = self.id;
        let own = [self.name.clone(), id.to_string(), format!("FRICTION/{id}")];
        let joint = self.joint.iter().flat_map(|joint| {
            let (statement, rest) = joint.split_once(" (").unwrap_or((joint, ""));
            let name = rest.strip_suffix(')').map(str::to_owned);
            name.into_iter().chain([statement.to_owned()])
        });
        own.into_iter().chain(joint.collect::<Vec<_>>())
    }
}

/// The names of the frictions of these ids; their joints as the record of the run beside the `.res` has
/// them.
pub(super) fn names(file: &ResFile, ids: &[u32], path: &Path) -> Vec<Names> {
    let record = std::fs::read(path.with_file_name("run.json")).ok();
    let record: Option<Value> = record.and_then(|bytes| serde_json::from_slice(&bytes).ok());
    let said = record
        .as_ref()
        .and_then(|record| record["frictions"].as_array());
    let named = ids.iter().map(|&id| {
        let mut entities = file.entities.iter();
        let entity = entities.find(|e| e.kind == FRICTION_DETAIL && e.object_id == Some(id));
        let name = entity.map(|e| e.element.as_ref().unwrap_or(&e.name).clone());
        let own = format!("FRICTION/{id}");
        let joint = said.into_iter().flatten().find_map(|friction| {
            let statement = friction["friction"].as_str()?.split(' ').next()?;
            let joint = friction["joint"].as_str()?;
            (statement == own).then(|| joint.to_owned())
        });
        Names {
            id,
            name: name.unwrap_or_default(),
            joint,
        }
    });
    named.collect()
}

/// The friction that a name means, in any case; where several have it the first one.
pub(super) fn find(known: &[Names], name: &str) -> Result<u32, ExplainError> {
    let found = known
        .iter()
        .find(|names| names.all().any(|other| other.eq_ignore_ascii_case(name)));
    if let Some(names) = found {
        return Ok(names.id);
    }
    let all: Vec<String> = known.iter().flat_map(Names::all).collect();
    // A digit more or less is another friction, not a slip of the pen.
    let words = all.iter().map(String::as_str);
    let words = words.filter(|word| !word.bytes().all(|byte| byte.is_ascii_digit()));
    let help = match dataset::nearest_name(name, words) {
        Some(near) => format!("is {near} meant?"),
        None => {
            let titles: Vec<String> = known.iter().map(Names::title).collect();
            format!("there is {}", titles.join(", "))
        }
    };
    Err(ExplainError::UnknownName {
        name: name.to_owned(),
        help,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_friction_is_found_by_its_names_and_its_joints() {
        let names = |id, name: &str, joint: Option<&str>| Names {
            id,
            name: name.to_owned(),
            joint: joint.map(str::to_owned),
        };
        let known = [
            names(3, "SLIDE_FRICTION", Some("JOINT/28 (GUIDE)")),
            names(28, "FRICTION_28", None),
            names(7, "ARM", Some("JOINT/9")),
        ];
        for (name, id) in [
            ("slide_friction", 3),
            ("3", 3),
            ("friction/3", 3),
            ("Guide", 3),
            ("joint/28", 3),
            ("28", 28),
            ("JOINT/9", 7),
        ] {
            assert_eq!(find(&known, name).unwrap(), id, "{name}");
        }
        let wrong = |name| find(&known, name).unwrap_err().to_string();
        assert_eq!(
            wrong("GIUDE"),
            "there is no friction \"GIUDE\"; is GUIDE meant?"
        );
        let listed = wrong("8");
        assert!(
            listed.ends_with(
                "there is FRICTION/3 (SLIDE_FRICTION) in JOINT/28 (GUIDE), FRICTION/28, FRICTION/7 \
                 (ARM) in JOINT/9"
            ),
            "{listed}"
        );
    }
}
