//! From the typed dataset to the mechanical model.
//!
//! Elements keep their order: bodies are the moving parts and then the point masses, joints the
//! joints, then the primitives and then the points on curves, forces as `forces::APPLIED` says, by
//! components. Markers keep their places; a marker at the origin of ground, whose id is 0, follows them, and then
//! those from which coupled coordinates are measured. General constraints are those of the dataset,
//! then couplers, then gears.

mod bodies;
mod composite;
mod couplers;
mod curves;
mod elastic;
mod elements;
mod expression;
mod forces;
mod frame;
mod friction;
#[cfg(test)]
mod function_test;
mod joints;
mod linear_systems;
mod measures;
mod motions;
mod outputs;
mod pose;
mod power_density;
mod results;
mod tables;
mod unknowns;
mod vectors;

use std::collections::{BTreeMap, BTreeSet, HashSet};

use ::dataset::{Code, Dataset, Diagnostic, Function, Header, Severity, Span, Switchable};
use mechanics::Owner;
use mechanics::model::{Element, Label, Model, Reactions};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

pub(crate) use forces::APPLIED;
pub(crate) use measures::{Measures, Numbering};
pub(crate) use outputs::{Column, Outputs, Unit};

/// The analysis that functions are lowered for: what MODE gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Mode {
    /// Kinematics: motion without degrees of freedom.
    Kinematic,
    /// Initial conditions.
    InitialConditions,
    /// Dynamics.
    Dynamic,
    /// An equilibrium.
    Static,
    /// A sequence of equilibria.
    QuasiStatic,
    /// Small motions about an instant.
    Linear,
}

impl Mode {
    /// The value of MODE.
    const fn value(self) -> f64 {
        match self {
            Self::Kinematic => 1.0,
            Self::InitialConditions => 3.0,
            Self::Dynamic => 4.0,
            Self::Static => 5.0,
            Self::QuasiStatic => 6.0,
            Self::Linear => 7.0,
        }
    }
}

/// What functions read beside the motion, and options that are no part of the dataset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Setting {
    /// The analysis, which MODE gives.
    pub(crate) mode: Mode,
    /// What sensors have kept, which SENVAL gives; zero for the others.
    pub(crate) kept: BTreeMap<u32, f64>,
    /// Which reactions redundant constraints have: an option of the run.
    #[serde(default)]
    pub(crate) reactions: Reactions,
}

impl From<Mode> for Setting {
    /// An analysis in which no sensor has kept anything, without options.
    fn from(mode: Mode) -> Self {
        Self {
            mode,
            kept: BTreeMap::new(),
            reactions: Reactions::OfKept,
        }
    }
}

/// A dataset lowered to mechanics.
#[derive(Clone, Debug)]
pub(crate) struct Lowered {
    /// The mechanical model.
    pub(crate) model: Model,
    /// What outputs need beside it.
    pub(crate) outputs: Outputs,
    /// What each motion of the dataset has become: a motion, or a general constraint.
    pub(crate) motions: Vec<Option<Owner>>,
    /// The analysis that it is lowered for.
    pub(crate) mode: Mode,
    /// Whether a function reads MODE, so that another analysis needs another lowering.
    pub(crate) reads_mode: bool,
    /// The sensors that SENVAL is asked of, which need another lowering when they are triggered.
    pub(crate) reads_sensors: BTreeSet<u32>,
    /// Warnings.
    pub(crate) warnings: Vec<Diagnostic>,
}

/// Lowers a dataset that was read without errors from the source of that name.
///
/// `measures` keeps its measures and takes on the new ones, so that models that are lowered with
/// the same list number them alike. `setting` is that of the analysis to come.
///
/// # Errors
/// Everything that is not simulated, each with its place.
pub(crate) fn lower(
    dataset: &Dataset,
    source: &str,
    measures: &mut Measures,
    setting: &Setting,
) -> Result<Lowered, Vec<Diagnostic>> {
    let mut lowering = Lowering {
        dataset,
        source,
        ucf: dataset.units.as_ref().map_or(1.0, |units| units.ucf),
        ground: dataset.markers.len(),
        measures,
        setting,
        reads_mode: false,
        reads_sensors: BTreeSet::new(),
        motions: Vec::new(),
        results: Vec::new(),
        tables: tables::Tables::default(),
        linear_systems: linear_systems::LinearSystems::new(dataset),
        curves: curves::Curves::default(),
        diagnostics: Vec::new(),
        told: HashSet::new(),
        refused: Vec::new(),
    };
    let gravity = Vector3::from(dataset.gravity.unwrap_or_default());
    let mut model = Model {
        gravity,
        reactions: setting.reactions,
        ..Model::default()
    };
    lowering.break_circles();
    lowering.bodies(&mut model);
    lowering.joints(&mut model);
    lowering.point_curves(&mut model);
    lowering.frictions(&mut model);
    lowering.constraints(&mut model);
    lowering.couplers(&mut model);
    lowering.motions(&mut model);
    lowering.forces(&mut model);
    lowering.differentials(&mut model);
    lowering.linear_states(&mut model);
    lowering.algebraics(&mut model);
    let outputs = lowering.outputs();
    model.inactive = lowering.inactive();
    let Lowering {
        motions,
        mut diagnostics,
        reads_mode,
        reads_sensors,
        refused,
        ..
    } = lowering;
    for (_, place, others) in refused {
        diagnostics[place].holds_for(&others);
    }
    model.measures = measures.list().to_vec();
    if diagnostics.iter().any(|d| d.severity == Severity::Error) {
        return Err(diagnostics);
    }
    Ok(Lowered {
        model,
        outputs,
        motions,
        mode: setting.mode,
        reads_mode,
        reads_sensors,
        warnings: diagnostics,
    })
}

/// The state of a lowering.
struct Lowering<'a> {
    dataset: &'a Dataset,
    /// Name of the file that the dataset came from.
    source: &'a str,
    /// Unit consistency factor: masses are divided by it.
    ucf: f64,
    /// Place of the implicit marker at the origin of ground.
    ground: usize,
    measures: &'a mut Measures,
    setting: &'a Setting,
    reads_mode: bool,
    reads_sensors: BTreeSet<u32>,
    motions: Vec<Option<Owner>>,
    /// Results that output functions read, by number.
    results: Vec<results::ResultSource>,
    /// Splines as functions interpolate them.
    tables: tables::Tables,
    /// LSE and TFSISO.
    linear_systems: linear_systems::LinearSystems,
    curves: curves::Curves,
    diagnostics: Vec<Diagnostic>,
    /// Places and texts of the diagnostics.
    told: HashSet<(usize, usize, String)>,
    /// Functions that are refused, with the place of the message and the other elements with them.
    refused: Vec<(Function, usize, Vec<String>)>,
}

impl Lowering<'_> {
    /// Place of a marker; 0 is the ground.
    fn marker_place(&self, id: u32) -> usize {
        self.dataset.markers.position(id).unwrap_or(self.ground)
    }

    /// The elements that DEACTIVATE has switched off, by their places in the model.
    fn inactive(&self) -> BTreeSet<Element> {
        let dataset = self.dataset;
        let place = |&(kind, id): &(Switchable, u32)| {
            Some(match kind {
                Switchable::Joint => Element::Joint(dataset.joints.position(id)?),
                Switchable::Primitive => {
                    Element::Joint(dataset.joints.len() + dataset.primitives.position(id)?)
                }
                Switchable::PointCurve => {
                    let before = dataset.joints.len() + dataset.primitives.len();
                    Element::Joint(before + dataset.point_curves.position(id)?)
                }
                Switchable::Constraint => Element::Constraint(dataset.constraints.position(id)?),
                Switchable::Coupler => {
                    Element::Constraint(dataset.constraints.len() + dataset.couplers.position(id)?)
                }
                Switchable::Gear => Element::Constraint(
                    dataset.constraints.len()
                        + dataset.couplers.len()
                        + dataset.gears.position(id)?,
                ),
                Switchable::Friction => Element::Friction(dataset.frictions.position(id)?),
                // Motions rest with their joints, too; sensors are no part of the model, and forces
                // follow below.
                _ => return None,
            })
        };
        let forces = dataset.inactive.iter().filter_map(|&(kind, id)| {
            let places = forces::applied_places(dataset, kind, id)?;
            Some(places.map(Element::Force))
        });
        let motions = dataset.motions.iter().zip(&self.motions);
        let resting = motions
            .filter(|(motion, _)| !dataset.is_active(Switchable::Motion, motion.header.id))
            .filter_map(|(_, owner)| match (*owner)? {
                Owner::Motion(place) => Some(Element::Motion(place)),
                Owner::General(place) => Some(Element::Constraint(place)),
                Owner::Joint(_) => None,
            });
        let switched = dataset.inactive.iter().filter_map(place);
        switched.chain(resting).chain(forces.flatten()).collect()
    }

    fn error(&mut self, code: Code, span: Span, message: String, help: Option<&str>) {
        self.add(Severity::Error, code, span, message, help);
    }

    fn warn(&mut self, code: Code, span: Span, message: String) {
        self.add(Severity::Warning, code, span, message, None);
    }

    fn add(
        &mut self,
        severity: Severity,
        code: Code,
        span: Span,
        message: String,
        help: Option<&str>,
    ) {
        // A variable that several functions read is gone through for each of them.
        if self.told.insert((span.start, span.end, message.clone())) {
            let mut diagnostic = Diagnostic::new(severity, code, self.source, span, message);
            diagnostic.help = help.map(str::to_owned);
            self.diagnostics.push(diagnostic);
        }
    }
}

/// How an element is called in messages.
fn label(statement: &'static str, header: &Header) -> Label {
    Label {
        statement,
        id: header.id,
        name: view_name(header).unwrap_or_default().to_owned(),
    }
}

/// The last component of the name of an element in Adams View.
pub(crate) fn view_name(header: &Header) -> Option<&str> {
    let name = header.name.as_deref()?;
    Some(name.rsplit('.').next().unwrap_or(name)).filter(|name| !name.is_empty())
}
