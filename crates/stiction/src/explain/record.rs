//! The values of a friction at one output after another, by name.

use results::{FRICTION_DETAIL, ResFile};

use super::Units;
use super::series::outputs;

/// Components of ours that every friction has, in the order of [`Records`]' columns.
const DETAIL: [&str; 21] = [
    "REGIME",
    "LOAD",
    "LOAD_REACTION",
    "LOAD_BENDING",
    "LOAD_TORSION",
    "BY_PRELOAD",
    "BY_REACTION",
    "BY_BENDING",
    "BY_TORSION",
    "LIMITED",
    "POWER",
    "WORK",
    "STORED",
    "DISSIPATED",
    "STICKS",
    "STICK_START",
    "STICK_END",
    "STUCK_TIME",
    "LARGEST_CREEP",
    "FRICTION",
    "VELOCITY",
];

/// The outputs of one friction.
pub(super) struct Records<'a> {
    file: &'a ResFile,
    pub(super) id: u32,
    pub(super) name: String,
    pub(super) units: Units,
    /// Columns of the 26 components of Adams.
    adams: [usize; 26],
    /// Columns of ours.
    detail: [usize; DETAIL.len()],
    /// Names and columns of the bristle deflections of LUGRE, and of its drift.
    bristles: Vec<(String, usize)>,
    drifts: Vec<(String, usize)>,
}

impl<'a> Records<'a> {
    /// Those of a friction; `None` where a component is missing.
    pub(super) fn new(file: &'a ResFile, id: u32) -> Option<Self> {
        let place = |kind: &str| {
            let mut entities = file.entities.iter();
            entities.position(|entity| entity.kind == kind && entity.object_id == Some(id))
        };
        let (friction, own) = (place("Friction")?, place(FRICTION_DETAIL)?);
        let components = &file.entities[own].components;
        let find = |name: &str| {
            components
                .iter()
                .position(|component| component.name == name)
        };
        let mut detail = [0; DETAIL.len()];
        for (column, name) in detail.iter_mut().zip(DETAIL) {
            *column = file.column_of(own, find(name)?);
        }
        let starting = |prefix: &str| -> Vec<(String, usize)> {
            let all = components.iter().enumerate();
            all.filter(|(_, component)| component.name.starts_with(prefix))
                .map(|(k, component)| (component.name.clone(), file.column_of(own, k)))
                .collect()
        };
        let adams = &file.entities[friction].components;
        if adams.len() != 26 {
            return None;
        }
        let unit = |name: &str| find(name).map(|k| components[k].unit.clone());
        let entity = &file.entities[own];
        Some(Self {
            file,
            id,
            name: entity
                .element
                .clone()
                .unwrap_or_else(|| entity.name.clone()),
            units: Units {
                time: unit("STICK_START")?,
                force: adams[0].unit.clone(),
                torque: adams[3].unit.clone(),
                load: unit("LOAD")?,
                length: unit("LARGEST_CREEP")?,
                velocity: adams[13].unit.clone(),
                energy: unit("WORK")?,
                power: unit("POWER")?,
            },
            adams: std::array::from_fn(|k| file.column_of(friction, k)),
            detail,
            bristles: starting("BRISTLE_"),
            drifts: starting("DRIFT_"),
        })
    }

    /// Whether the load is a force: the joint slides.
    pub(super) fn slides(&self) -> bool {
        self.units.load == self.units.force
    }

    /// Whether it is LUGRE.
    pub(super) fn is_lugre(&self) -> bool {
        !self.bristles.is_empty()
    }

    /// All outputs in the order of time; the block of the model as given has none.
    pub(super) fn all(&self) -> Vec<Record<'_>> {
        outputs(self.file)
            .flat_map(|block| {
                block.times.iter().enumerate().map(|(step, &time)| Record {
                    records: self,
                    time,
                    row: block.row(step),
                })
            })
            .collect()
    }
}

/// One output of one friction.
#[derive(Clone, Copy)]
pub(super) struct Record<'a> {
    records: &'a Records<'a>,
    time: f64,
    row: &'a [f64],
}

impl Record<'_> {
    pub(super) fn time(&self) -> f64 {
        self.time
    }

    fn detail(&self, k: usize) -> f64 {
        self.row[self.records.detail[k]]
    }

    fn vector(&self, start: usize) -> [f64; 3] {
        std::array::from_fn(|k| self.row[self.records.adams[start + k]])
    }

    /// Friction force, along the axes of J.
    pub(super) fn force(&self) -> [f64; 3] {
        self.vector(0)
    }

    /// Friction torque, along the axes of J.
    pub(super) fn torque(&self) -> [f64; 3] {
        self.vector(3)
    }

    /// Coefficient of sliding and of turning.
    pub(super) fn mu(&self) -> [[f64; 3]; 2] {
        [6, 9].map(|start| self.vector(start))
    }

    pub(super) fn mu1(&self) -> f64 {
        self.row[self.records.adams[12]]
    }

    /// Velocity of the surfaces by sliding and by turning.
    pub(super) fn velocity(&self) -> [[f64; 3]; 2] {
        [13, 16].map(|start| self.vector(start))
    }

    /// Creep by sliding and by turning.
    pub(super) fn creep(&self) -> [[f64; 3]; 2] {
        [19, 22].map(|start| self.vector(start))
    }

    pub(super) fn beta(&self) -> f64 {
        self.row[self.records.adams[25]]
    }

    /// 0 stuck, 1 transition, 2 sliding.
    pub(super) fn regime(&self) -> usize {
        (self.detail(0) as usize).min(2)
    }

    pub(super) fn load(&self) -> f64 {
        self.detail(1)
    }

    /// What the load is made of: preload (which is none), reaction force, bending, torsion.
    pub(super) fn load_parts(&self) -> [f64; 4] {
        [0.0, self.detail(2), self.detail(3), self.detail(4)]
    }

    /// Friction at the surfaces by cause.
    pub(super) fn causes(&self) -> [f64; 4] {
        std::array::from_fn(|k| self.detail(5 + k))
    }

    pub(super) fn limited(&self) -> bool {
        self.detail(9) != 0.0
    }

    pub(super) fn power(&self) -> f64 {
        self.detail(10)
    }

    pub(super) fn work(&self) -> f64 {
        self.detail(11)
    }

    pub(super) fn stored(&self) -> f64 {
        self.detail(12)
    }

    pub(super) fn dissipated(&self) -> f64 {
        self.detail(13)
    }

    pub(super) fn sticks(&self) -> usize {
        self.detail(14) as usize
    }

    pub(super) fn stick_start(&self) -> f64 {
        self.detail(15)
    }

    pub(super) fn stick_end(&self) -> f64 {
        self.detail(16)
    }

    pub(super) fn stuck_time(&self) -> f64 {
        self.detail(17)
    }

    pub(super) fn largest_creep(&self) -> f64 {
        self.detail(18)
    }

    /// Friction force where the joint slides, else torque: about one axis with its sign.
    pub(super) fn along(&self) -> f64 {
        self.detail(19)
    }

    /// Velocity of the surfaces of that.
    pub(super) fn surface_velocity(&self) -> f64 {
        self.detail(20)
    }

    /// Whether a stick goes on.
    pub(super) fn sticking(&self) -> bool {
        self.sticks() > 0 && self.stick_end() <= self.stick_start()
    }

    pub(super) fn bristles(&self) -> Vec<(String, f64)> {
        self.named(&self.records.bristles)
    }

    pub(super) fn drifts(&self) -> Vec<(String, f64)> {
        self.named(&self.records.drifts)
    }

    fn named(&self, columns: &[(String, usize)]) -> Vec<(String, f64)> {
        let named = columns.iter();
        named
            .map(|(name, column)| (name.clone(), self.row[*column]))
            .collect()
    }

    /// Magnitude of the friction force where the joint slides, else of the torque.
    pub(super) fn magnitude(&self) -> f64 {
        length(if self.records.slides() {
            self.force()
        } else {
            self.torque()
        })
    }
}

/// Length of a vector.
pub(super) fn length(vector: [f64; 3]) -> f64 {
    vector.iter().fold(0.0, |sum: f64, x| sum.hypot(*x))
}

/// Length of a vector over both motions.
pub(super) fn length_of_both([sliding, turning]: [[f64; 3]; 2]) -> f64 {
    length(sliding).hypot(length(turning))
}
