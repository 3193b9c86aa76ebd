//! Channels by name, and how their values follow from a row of results.

use stiction::sink::{Entity, Layout};
use stiction::{ArgumentError, Project};

/// Causes of friction, by their components.
const CAUSES: [&str; 4] = ["PRELOAD", "REACTION", "BENDING", "TORSION"];

/// A channel: its unit and how it comes about.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Channel {
    pub(crate) unit: String,
    recipe: Recipe,
}

/// How a value follows from the values of a row, by their places.
#[derive(Clone, Debug, PartialEq)]
enum Recipe {
    Value(usize),
    /// Of a motion about one axis, of which the two other components are zero.
    Sum([usize; 3]),
    Length([usize; 3]),
    /// The first part of all four by their magnitudes.
    Share(usize, [usize; 4]),
}

impl Channel {
    /// Its value in a row.
    pub(crate) fn value(&self, row: &[f64]) -> f64 {
        let sum = |places: [usize; 3]| row[places[0]] + row[places[1]] + row[places[2]];
        let length = |places: [usize; 3]| {
            let squares = places.map(|place| row[place] * row[place]);
            (squares[0] + squares[1] + squares[2]).sqrt()
        };
        match self.recipe {
            Recipe::Value(place) => row[place],
            Recipe::Sum(places) => sum(places),
            Recipe::Length(places) => length(places),
            Recipe::Share(place, all) => {
                let total: f64 = all.iter().map(|place| row[*place].abs()).sum();
                if total > 0.0 {
                    row[place].abs() / total
                } else {
                    0.0
                }
            }
        }
    }
}

/// A friction by its names.
struct Friction<'a> {
    name: &'a str,
    joint: String,
    id: u32,
    /// Type of the joint as in the dataset.
    kind: &'static str,
    /// Components by name, with place and unit.
    components: Vec<(&'a str, usize, &'a str)>,
}

impl Friction<'_> {
    fn place(&self, component: &str) -> Option<(usize, &str)> {
        let same = |c: &&(&str, usize, &str)| c.0.eq_ignore_ascii_case(component);
        let found = self.components.iter().find(same);
        found.map(|(_, place, unit)| (*place, *unit))
    }

    fn three(&self, names: [&str; 3]) -> Option<([usize; 3], &str)> {
        let [x, y, z] = names.map(|name| self.place(name));
        let ((x, _), (y, _), (z, unit)) = (x?, y?, z?);
        Some(([x, y, z], unit))
    }

    /// A channel by one of the names that it has in Python.
    fn named(&self, name: &str) -> Option<Channel> {
        let slides = matches!(self.kind, "TRANSLATIONAL" | "CYLINDRICAL");
        let turns = self.kind != "TRANSLATIONAL";
        let spherical = self.kind == "SPHERICAL";
        let channel = |unit: &str, recipe| {
            let unit = unit.to_owned();
            Some(Channel { unit, recipe })
        };
        let about_axis = |sliding: [&str; 3], turning: [&str; 3]| {
            let (places, unit) = self.three(if slides { sliding } else { turning })?;
            let recipe = if spherical {
                Recipe::Length(places)
            } else {
                Recipe::Sum(places)
            };
            channel(unit, recipe)
        };
        match name {
            "force" if slides => self.component("FRICTION"),
            // What slides has its force there.
            "torque" if turns => self.component(if slides { "TZ" } else { "FRICTION" }),
            "mu" => about_axis(["MUX", "MUY", "MUZ"], ["MURX", "MURY", "MURZ"]),
            "velocity" => self.component("VELOCITY"),
            "creep" => about_axis(
                ["CREEP_X", "CREEP_Y", "CREEP_Z"],
                ["CREEP_AX", "CREEP_AY", "CREEP_AZ"],
            ),
            "normal" => self.component("LOAD"),
            _ => {
                let cause = name.strip_prefix("share_")?;
                let own = CAUSES
                    .iter()
                    .position(|known| known.eq_ignore_ascii_case(cause))?;
                let [a, b, c, d] = CAUSES.map(|cause| self.place(&format!("BY_{cause}")));
                let all = [a?.0, b?.0, c?.0, d?.0];
                channel("", Recipe::Share(all[own], all))
            }
        }
    }

    fn component(&self, name: &str) -> Option<Channel> {
        let (place, unit) = self.place(name)?;
        let (unit, recipe) = (unit.to_owned(), Recipe::Value(place));
        Some(Channel { unit, recipe })
    }
}

/// Names of our own channels of frictions, for messages.
const NAMED: [&str; 10] = [
    "force",
    "torque",
    "mu",
    "velocity",
    "creep",
    "normal",
    "share_preload",
    "share_reaction",
    "share_bending",
    "share_torsion",
];

/// The frictions of a project with their places in a layout.
fn frictions<'a>(project: &Project, layout: &'a Layout) -> Vec<Friction<'a>> {
    let dataset = project.dataset();
    let entities = || layout.entities().iter().enumerate();
    let components = |(place, entity): (usize, &'a Entity)| {
        let named = entity.components.iter().enumerate();
        let named = named.map(move |(k, c)| (&*c.name, layout.column(place, k), &*c.unit));
        named.collect::<Vec<_>>()
    };
    let all = dataset.frictions.iter().filter_map(|friction| {
        let id = friction.header.id;
        let of = |kind: &str| entities().find(|(_, e)| e.kind == kind && e.object_id == Some(id));
        let (own, detail) = (of("Friction")?, of("Stiction_Friction")?);
        let joint = dataset
            .joints
            .iter()
            .find(|j| j.header.id == friction.joint)?;
        let mut entities = entities();
        let reaction =
            entities.find(|(_, e)| e.kind == "Joint" && e.object_id == Some(friction.joint));
        Some(Friction {
            name: own.1.element.as_deref().unwrap_or(&own.1.name),
            joint: reaction
                .map(|(_, entity)| entity.name.clone())
                .unwrap_or_default(),
            id,
            kind: joint.kind.keyword(),
            components: [components(own), components(detail)].concat(),
        })
    });
    all.collect()
}

/// The channel of that name: `GUIDE.FX` as in result files, or a channel of a friction behind its
/// name, the name of its joint or its id, `guide.force`. Capital and small letters are the same.
pub(crate) fn find(
    project: &Project,
    layout: &Layout,
    name: &str,
) -> Result<Channel, ArgumentError> {
    let (owner, wanted) = name.rsplit_once('.').unwrap_or(("", name));
    for (place, entity) in layout.entities().iter().enumerate() {
        if !entity.name.eq_ignore_ascii_case(owner) {
            continue;
        }
        let mut components = entity.components.iter().enumerate();
        if let Some((k, component)) = components.find(|(_, c)| c.name.eq_ignore_ascii_case(wanted))
        {
            let (unit, recipe) = (
                component.unit.clone(),
                Recipe::Value(layout.column(place, k)),
            );
            return Ok(Channel { unit, recipe });
        }
    }
    let frictions = frictions(project, layout);
    if let Some(friction) = by_name(&frictions, owner) {
        let named = friction.named(&wanted.to_ascii_lowercase());
        if let Some(channel) = named.or_else(|| friction.component(wanted)) {
            return Ok(channel);
        }
        let own = friction.components.iter().map(|(name, _, _)| *name);
        let known = NAMED
            .into_iter()
            .filter(|name| friction.named(name).is_some());
        return Err(ArgumentError::Unknown {
            what: "channel of friction",
            name: wanted.to_owned(),
            known: known.chain(own).map(str::to_owned).collect(),
        });
    }
    let mut known = Vec::new();
    for friction in &frictions {
        let named = NAMED.iter().filter(|name| friction.named(name).is_some());
        known.extend(named.map(|channel| format!("{}.{channel}", friction.joint)));
    }
    for entity in layout.entities() {
        let components = entity.components.iter();
        known.extend(components.map(|component| format!("{}.{}", entity.name, component.name)));
    }
    Err(ArgumentError::Unknown {
        what: "channel",
        name: name.to_owned(),
        known,
    })
}

/// The place among the frictions of the one of that name.
pub(crate) fn friction(
    project: &Project,
    layout: &Layout,
    name: &str,
) -> Result<usize, ArgumentError> {
    let frictions = frictions(project, layout);
    let found = by_name(&frictions, name).map(|friction| friction.id);
    let place = found.and_then(|id| {
        let mut all = project.dataset().frictions.iter();
        all.position(|friction| friction.header.id == id)
    });
    place.ok_or_else(|| {
        let names = frictions.iter();
        let names = names.flat_map(|friction| [friction.name.to_owned(), friction.joint.clone()]);
        ArgumentError::Unknown {
            what: "friction",
            name: name.to_owned(),
            known: names.collect(),
        }
    })
}

fn by_name<'a, 'b>(frictions: &'b [Friction<'a>], name: &str) -> Option<&'b Friction<'a>> {
    let named = |f: &&Friction<'_>| f.name.eq_ignore_ascii_case(name) || name.parse() == Ok(f.id);
    let of_joint = |f: &&Friction<'_>| f.joint.eq_ignore_ascii_case(name);
    let mut all = frictions.iter();
    let own = all.find(named);
    own.or_else(|| frictions.iter().find(of_joint))
}
