//! What there is to plot: frictions and energies at one output after another.

use results::{DataBlock, ENERGY, ENERGY_COMPONENTS, ResFile};

use super::Units;
use super::record::Records;

/// What a friction was at every output.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionSeries {
    /// Id of the FRICTION.
    pub id: u32,
    /// Its name.
    pub name: String,
    /// Units of everything here.
    pub units: Units,
    /// Times of the outputs.
    pub time: Vec<f64>,
    /// Friction force on the part of marker I where the joint slides, else torque, in the unit of the
    /// load: about one axis with its sign, in a spherical joint its magnitude.
    pub friction: Vec<f64>,
    /// Velocity of the surfaces of that, I relative to J, likewise.
    pub velocity: Vec<f64>,
    /// Regime by number ([`REGIMES`](super::REGIMES)).
    pub regime: Vec<usize>,
    /// Friction at the surfaces by its cause ([`CAUSES`](super::CAUSES)), before any limit.
    pub causes: [Vec<f64>; 4],
}

impl FrictionSeries {
    /// From all outputs; `None` without any.
    pub(super) fn new(records: &Records<'_>) -> Option<Self> {
        let all = records.all();
        all.first()?;
        let causes: Vec<[f64; 4]> = all.iter().map(|record| record.causes()).collect();
        Some(Self {
            id: records.id,
            name: records.name.clone(),
            units: records.units.clone(),
            time: all.iter().map(|record| record.time()).collect(),
            friction: all.iter().map(|record| record.along()).collect(),
            velocity: all.iter().map(|record| record.surface_velocity()).collect(),
            regime: all.iter().map(|record| record.regime()).collect(),
            causes: std::array::from_fn(|k| causes.iter().map(|four| four[k]).collect()),
        })
    }

    /// Whether the joint slides, so that its friction is a force.
    #[must_use]
    pub fn slides(&self) -> bool {
        self.units.load == self.units.force
    }

    /// How far the surfaces have moved, by the trapezoidal rule over the outputs.
    #[must_use]
    pub fn displacement(&self) -> Vec<f64> {
        let mut way = 0.0;
        let pairs = self.time.windows(2).zip(self.velocity.windows(2));
        let steps = pairs.map(|(time, velocity)| {
            way += 0.5 * (velocity[0] + velocity[1]) * (time[1] - time[0]);
            way
        });
        std::iter::once(0.0).chain(steps).collect()
    }
}

/// The energies of the model at every output; [`results::energy`] says what they are.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergySeries {
    /// Unit of time.
    pub time_unit: String,
    /// Unit of the energies, force · length.
    pub unit: String,
    /// Times of the outputs.
    pub time: Vec<f64>,
    /// Kinetic energy.
    pub kinetic: Vec<f64>,
    /// Potential energy of the weight.
    pub weight: Vec<f64>,
    /// Energy stored in creep and bristles.
    pub stored: Vec<f64>,
    /// Work that forces put in, springs among them.
    pub forces: Vec<f64>,
    /// Work that motions put in.
    pub motions: Vec<f64>,
    /// What friction dissipated.
    pub dissipated: Vec<f64>,
    /// What the integration lost or made up.
    pub residual: Vec<f64>,
}

impl EnergySeries {
    /// From all outputs; `None` where the file has no such channels.
    pub(super) fn new(file: &ResFile) -> Option<Self> {
        let mut entities = file.entities.iter();
        let place = entities.position(|entity| entity.kind == ENERGY)?;
        let components = &file.entities[place].components;
        let series = |name: &str| -> Option<Vec<f64>> {
            let component = components.iter().position(|c| c.name == name)?;
            let column = file.column_of(place, component);
            Some(
                outputs(file)
                    .flat_map(|block| block.column(column))
                    .collect(),
            )
        };
        let [
            kinetic,
            weight,
            stored,
            forces,
            motions,
            dissipated,
            residual,
        ] = ENERGY_COMPONENTS.map(series);
        Some(Self {
            time_unit: file.time_unit.clone(),
            unit: components.first()?.unit.clone(),
            time: outputs(file)
                .flat_map(|block| block.times.iter().copied())
                .collect(),
            kinetic: kinetic?,
            weight: weight?,
            stored: stored?,
            forces: forces?,
            motions: motions?,
            dissipated: dissipated?,
            residual: residual?,
        })
    }
}

/// The blocks of outputs: all but the model as given.
pub(super) fn outputs(file: &ResFile) -> impl Iterator<Item = &DataBlock> {
    let blocks = file.data.iter();
    blocks.filter(|block| !block.name.starts_with("modelInput"))
}
