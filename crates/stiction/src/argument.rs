//! Arguments of a model by the names that people give them, such as `slide.mu_static`.

use dataset::{FrictionQuantity, Header};

use crate::channels::name;
use crate::project::Project;
use crate::quantity::unit_of;

/// Statements that a model has at most one of, so that they have no id.
const SINGLE: [&str; 4] = ["ACCGRAV", "EQUILIBRIUM", "INTEGRATOR", "PREFERENCES"];

/// An argument of an element of a model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Argument {
    /// What a change of it begins with, `FRICTION/103, MU_STATIC`; `=` and the value follow.
    pub change: String,
    /// Its unit in the model, empty for a plain number; `None` where it is not known.
    pub unit: Option<String>,
}

/// A name or a value that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ArgumentError {
    /// There is nothing of that name.
    Unknown {
        /// What it should name.
        what: &'static str,
        /// The name.
        name: String,
        /// The names that there are.
        known: Vec<String>,
    },
    /// What is wrong, and what to write instead.
    Value(String),
}

impl std::fmt::Display for ArgumentError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        const MOST: usize = 12;
        match self {
            Self::Value(text) => f.write_str(text),
            Self::Unknown { what, name, known } => {
                write!(f, "there is no {what} {name:?}; ")?;
                if let Some(near) = dataset::nearest_name(name, known.iter().map(String::as_str)) {
                    return write!(f, "is {near} meant?");
                }
                let shown: Vec<&str> = known.iter().take(MOST).map(String::as_str).collect();
                match known.len() {
                    0 => write!(f, "there is no {what} at all"),
                    count if count > MOST => write!(f, "there are {}, ...", shown.join(", ")),
                    _ => write!(f, "there are {}", shown.join(", ")),
                }
            }
        }
    }
}

impl std::error::Error for ArgumentError {}

impl Project {
    /// The argument of that name: before the dot stands the name of an element, of a joint for its
    /// friction, or statement and id as in `FRICTION/103.mu_static`; behind it the keyword. Capital
    /// and small letters are the same.
    ///
    /// # Errors
    /// Names that are those of no element, or of several.
    ///
    /// ```no_run
    /// # let project = stiction::Project::load("slider.adm".as_ref())?;
    /// assert_eq!(project.argument("guide.mu_static")?.change, "FRICTION/1, MU_STATIC");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn argument(&self, name: &str) -> Result<Argument, ArgumentError> {
        let parts = name.rsplit_once('.');
        let parts = parts.filter(|(element, keyword)| !element.is_empty() && !keyword.is_empty());
        let Some((element, keyword)) = parts.filter(|_| !name.contains(['\n', '\r', '!', '=']))
        else {
            return Err(ArgumentError::Value(format!(
                "{name:?} names no argument; write it as \"slide.mu_static\""
            )));
        };
        let keyword = keyword.to_ascii_uppercase();
        if SINGLE
            .iter()
            .any(|single| single.eq_ignore_ascii_case(element))
        {
            let change = format!("{}/{keyword}", element.to_ascii_uppercase());
            return Ok(Argument { change, unit: None });
        }
        let (statement, id) = self.element(element)?;
        let unit = (statement == "FRICTION").then(|| self.friction_unit(&keyword));
        Ok(Argument {
            change: format!("{statement}/{id}, {keyword}"),
            unit: unit.flatten(),
        })
    }

    fn friction_unit(&self, keyword: &str) -> Option<String> {
        let mut quantities = FrictionQuantity::ALL.into_iter();
        match quantities.find(|quantity| quantity.keyword() == keyword) {
            Some(quantity) => Some(unit_of(quantity.dimension(), &self.unit_names())),
            None => ["MU_STATIC", "MU_DYNAMIC"]
                .contains(&keyword)
                .then(String::new),
        }
    }

    /// Statement and id of the element of that name; the friction of a joint of that name.
    fn element(&self, wanted: &str) -> Result<(&'static str, u32), ArgumentError> {
        let dataset = self.dataset();
        let mut found = Vec::new();
        for (statement, header) in dataset.headers() {
            let number = format!("{statement}/{}", header.id);
            let path = header.name.as_deref().unwrap_or_default();
            let mut names = [name(header, statement), path.to_owned(), number].into_iter();
            if !names.any(|known| known.eq_ignore_ascii_case(wanted)) {
                continue;
            }
            let of_joint = |id| dataset.frictions.iter().filter(move |f| f.joint == id);
            let frictions: Vec<_> = match statement {
                "JOINT" => of_joint(header.id)
                    .map(|f| ("FRICTION", f.header.id))
                    .collect(),
                _ => Vec::new(),
            };
            match frictions.is_empty() {
                true => found.push((statement, header.id)),
                false => found.extend(frictions),
            }
        }
        found.sort_unstable();
        found.dedup();
        match found[..] {
            [one] => Ok(one),
            [] => {
                let known = |(statement, header): (&str, &Header)| {
                    [
                        name(header, statement),
                        format!("{statement}/{}", header.id),
                    ]
                };
                Err(ArgumentError::Unknown {
                    what: "element",
                    name: wanted.to_owned(),
                    known: dataset.headers().flat_map(known).collect(),
                })
            }
            _ => {
                let several = found
                    .iter()
                    .map(|(statement, id)| format!("{statement}/{id}"));
                let several: Vec<_> = several.collect();
                Err(ArgumentError::Value(format!(
                    "{wanted:?} is the name of {}; write one of these instead",
                    several.join(", ")
                )))
            }
        }
    }
}
