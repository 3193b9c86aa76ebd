//! Why the friction of a joint was what it was at an instant.

use std::fmt;

use super::history::shares;
use super::record::{Record, Records, length, length_of_both};
use super::{CAUSES, REGIMES, Units, label, percent, quantity};
use crate::text_table::text_table;

/// The friction of a joint at one output, and what made it.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionMoment {
    /// Id of the FRICTION.
    pub id: u32,
    /// Its name.
    pub name: String,
    /// Units of everything here.
    pub units: Units,
    /// Time of the output.
    pub time: f64,
    /// Friction force on the part of I, along the axes of J.
    pub force: [f64; 3],
    /// Friction torque on the part of I, along the axes of J.
    pub torque: [f64; 3],
    /// 0 stuck, 1 transition, 2 sliding.
    pub regime: usize,
    /// Whether a stick goes on, and when the present or last one began.
    pub stick: Option<(bool, f64)>,
    /// Load on the sliding surfaces.
    pub load: f64,
    /// What the load is made of, in the order of [`CAUSES`]; a preload is no load.
    pub load_parts: [f64; 4],
    /// What the friction at the surfaces is made of, before any limit, in the order of [`CAUSES`].
    pub causes: [f64; 4],
    /// The same as parts of their sum.
    pub shares: [f64; 4],
    /// Vector coefficient of friction of sliding and of turning.
    pub mu: [[f64; 3]; 2],
    /// Coefficient of the creep; zero unless stuck.
    pub mu1: f64,
    /// Share of the velocity in a stuck joint; 1 otherwise.
    pub beta: f64,
    /// Velocity of the surfaces by sliding and by turning.
    pub velocity: [[f64; 3]; 2],
    /// Creep by sliding and by turning.
    pub creep: [[f64; 3]; 2],
    /// LUGRE alone: bristle deflection by component.
    pub bristles: Option<Vec<(String, f64)>>,
    /// Whether the limit of the friction is reached.
    pub limited: bool,
    /// Rate at which the friction takes energy out of the motion.
    pub power: f64,
    /// Work that it took out so far.
    pub work: f64,
    /// Energy stored in its creep or bristles.
    pub stored: f64,
    /// Energy dissipated so far.
    pub dissipated: f64,
}

impl FrictionMoment {
    pub(super) fn new(records: &Records<'_>, record: &Record<'_>) -> Self {
        Self {
            id: records.id,
            name: records.name.clone(),
            units: records.units.clone(),
            time: record.time(),
            force: record.force(),
            torque: record.torque(),
            regime: record.regime(),
            stick: (record.sticks() > 0).then(|| (record.sticking(), record.stick_start())),
            load: record.load(),
            load_parts: record.load_parts(),
            causes: record.causes(),
            shares: shares(record.causes()),
            mu: record.mu(),
            mu1: record.mu1(),
            beta: record.beta(),
            velocity: record.velocity(),
            creep: record.creep(),
            bristles: records.is_lugre().then(|| record.bristles()),
            limited: record.limited(),
            power: record.power(),
            work: record.work(),
            stored: record.stored(),
            dissipated: record.dissipated(),
        }
    }

    /// `FRICTION/3 (HINGE)`.
    #[must_use]
    pub fn label(&self) -> String {
        label(self.id, &self.name)
    }

    /// How the coefficient came about, in words.
    fn coefficient(&self) -> String {
        let mu = length_of_both(self.mu);
        let how = match (self.bristles.is_some(), self.regime) {
            (true, _) => "force of the bristles over the load".to_owned(),
            (false, 0) => format!(
                "{:.4} of the static coefficient against the velocity and {:.4} of mu1 = {:.4} \
                 against the creep",
                self.beta,
                1.0 - self.beta,
                self.mu1
            ),
            (false, 1) => "between static and dynamic, by the speed".to_owned(),
            (false, _) => "the dynamic one, against the velocity".to_owned(),
        };
        format!("{mu:.4}: {how}")
    }
}

impl fmt::Display for FrictionMoment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let units = &self.units;
        writeln!(
            f,
            "{} at time {:.6} {}\n",
            self.label(),
            self.time,
            units.time
        )?;
        let both =
            |[sliding, turning]: [[f64; 3]; 2]| [sliding, turning].map(|part| (length(part), part));
        let mut vectors = vec![
            ("friction force", self.force, &units.force),
            ("friction torque", self.torque, &units.torque),
        ];
        for (name, vector, unit) in [
            ("velocity of the surfaces", self.velocity, &units.velocity),
            ("creep", self.creep, &units.length),
        ] {
            let [sliding, turning] = both(vector);
            vectors.push((
                name,
                if sliding.0 >= turning.0 {
                    sliding.1
                } else {
                    turning.1
                },
                unit,
            ));
        }
        let number = |value: f64| {
            if value == 0.0 {
                "0".to_owned()
            } else {
                format!("{value:.4e}")
            }
        };
        let rows = vectors
            .into_iter()
            .filter(|(_, vector, _)| length(*vector) > 0.0);
        let rows = rows.map(|(name, v, unit)| {
            let [x, y, z] = v.map(number);
            [format!("{name} ({unit})"), x, y, z, number(length(v))]
        });
        let table = text_table(["", "x", "y", "z", "magnitude"], 1, rows);
        writeln!(f, "{table}")?;
        let state = match self.stick {
            Some((true, start)) => {
                format!("{}, since {start:.6} {}", REGIMES[self.regime], units.time)
            }
            _ => REGIMES[self.regime].to_owned(),
        };
        let mut facts = vec![
            ["regime".to_owned(), state],
            ["coefficient".to_owned(), self.coefficient()],
            [
                "limit of the friction".to_owned(),
                if self.limited {
                    "reached"
                } else {
                    "not reached"
                }
                .to_owned(),
            ],
            [
                "power taken out".to_owned(),
                quantity(self.power, &units.power),
            ],
            [
                "dissipated so far".to_owned(),
                quantity(self.dissipated, &units.energy),
            ],
            ["stored".to_owned(), quantity(self.stored, &units.energy)],
        ];
        for (component, deflection) in self.bristles.iter().flatten() {
            if *deflection != 0.0 {
                let axis = component.trim_start_matches("BRISTLE_");
                facts.push([
                    format!("bristle deflection, {axis}"),
                    quantity(*deflection, &units.length),
                ]);
            }
        }
        writeln!(f, "{}", text_table(["", ""], 2, facts))?;
        let unit = &units.load;
        let heads = [
            "made by".to_owned(),
            format!("load ({unit})"),
            format!("friction ({unit})"),
            "share".to_owned(),
        ];
        let heads = [&heads[0], &heads[1], &heads[2], &heads[3]].map(String::as_str);
        let mut rows: Vec<[String; 4]> = (0..4)
            .map(|k| {
                [
                    CAUSES[k].to_owned(),
                    if k == 0 {
                        String::new()
                    } else {
                        number(self.load_parts[k])
                    },
                    number(self.causes[k]),
                    percent(self.shares[k]),
                ]
            })
            .collect();
        let sum = self.causes.iter().sum();
        rows.push([
            "all".to_owned(),
            number(self.load),
            number(sum),
            String::new(),
        ]);
        write!(f, "{}", text_table(heads, 1, rows))
    }
}
