//! Kinematic functions to measures; equal measures are kept once.

use std::collections::HashMap;

use super::unknowns::{Unknown, Unknowns};
use dataset::{Expr, Function};
use mechanics::measure::{Measure, Quantity, Sequence};
use serde::{Deserialize, Serialize};

/// The measures of a model, each once, in the order in which functions first name them.
///
/// A session keeps one list through all changes of its model, because the numbering of measures
/// must not change while a simulation runs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Measures {
    list: Vec<Measure>,
    places: HashMap<Measure, usize>,
    /// The algebraic variables, which keep their numbers likewise.
    pub(super) unknowns: Unknowns,
}

/// What is numbered in a list of measures, in the order of the numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Numbering {
    measures: Vec<Measure>,
    unknowns: Vec<Unknown>,
}

impl Measures {
    /// The numbering so far.
    pub(crate) fn numbering(&self) -> Numbering {
        Numbering {
            measures: self.list.clone(),
            unknowns: self.unknowns.list().to_vec(),
        }
    }

    /// A list that goes on from a numbering.
    pub(crate) fn of_numbering(numbering: &Numbering) -> Self {
        let list = numbering.measures.clone();
        let places = list.iter().enumerate();
        Self {
            places: places.map(|(place, measure)| (*measure, place)).collect(),
            list,
            unknowns: Unknowns::of_list(&numbering.unknowns),
        }
    }

    /// All of them.
    pub(crate) fn list(&self) -> &[Measure] {
        &self.list
    }

    /// A measure by its place.
    pub(crate) fn get(&self, place: usize) -> Measure {
        self.list[place]
    }

    /// Place of the measure that a call stands for; `None` where the call is no kinematic function
    /// that is simulated. `marker` gives the place of a marker, of ground for `None`.
    pub(crate) fn of_call(
        &mut self,
        function: Function,
        arguments: &[Expr],
        marker: impl Fn(Option<u32>) -> usize,
    ) -> Option<usize> {
        use Function as F;
        use Quantity as Q;
        /// Which arguments are the markers i, j, k and l; further ones than there are mean ground.
        const NONE: usize = usize::MAX;
        let ij = [0, 1, NONE, NONE];
        let ijk = [0, 1, 2, NONE];
        let ijl = [0, 1, NONE, 2];
        let ijkl = [0, 1, 2, 3];
        let (quantity, roles) = match function {
            F::Dx => (Q::Displacement(0), ijk),
            F::Dy => (Q::Displacement(1), ijk),
            F::Dz => (Q::Displacement(2), ijk),
            F::Dm => (Q::Distance, ij),
            F::Ax => (Q::Rotation(0), ij),
            F::Ay => (Q::Rotation(1), ij),
            F::Az => (Q::Rotation(2), ij),
            F::Psi => (Q::BodyFixed([2, 0, 2], 0), ij),
            F::Theta => (Q::BodyFixed([2, 0, 2], 1), ij),
            F::Phi => (Q::BodyFixed([2, 0, 2], 2), ij),
            F::Yaw => (Q::YawPitchRoll(0), ij),
            F::Pitch => (Q::YawPitchRoll(1), ij),
            F::Roll => (Q::YawPitchRoll(2), ij),
            F::Incang => (Q::IncludedAngle, ijk),
            F::Orient => (orientation(arguments)?, [2, 3, NONE, NONE]),
            F::Vx => (Q::Velocity(0), ijkl),
            F::Vy => (Q::Velocity(1), ijkl),
            F::Vz => (Q::Velocity(2), ijkl),
            F::Vm => (Q::Speed, ijl),
            F::Vr => (Q::SeparationRate, ij),
            F::Wx => (Q::AngularVelocity(0), ijk),
            F::Wy => (Q::AngularVelocity(1), ijk),
            F::Wz => (Q::AngularVelocity(2), ijk),
            F::Wm => (Q::AngularSpeed, ij),
            F::Accx => (Q::Acceleration(0), ijkl),
            F::Accy => (Q::Acceleration(1), ijkl),
            F::Accz => (Q::Acceleration(2), ijkl),
            F::Accm => (Q::AccelerationMagnitude, ijl),
            F::Wdtx => (Q::AngularAcceleration(0), ijkl),
            F::Wdty => (Q::AngularAcceleration(1), ijkl),
            F::Wdtz => (Q::AngularAcceleration(2), ijkl),
            F::Wdtm => (Q::AngularAccelerationMagnitude, ijl),
            _ => return None,
        };
        let markers = roles.map(|role| {
            let id = arguments
                .get(role)
                .and_then(Expr::as_id)
                .filter(|id| *id > 0);
            marker(id)
        });
        Some(self.place(quantity, markers))
    }

    /// Place of the body-fixed 1-2-3 angle `n` of marker `i` in marker `j`.
    pub(crate) fn body_123(&mut self, n: usize, i: usize, j: usize, ground: usize) -> usize {
        let quantity = Quantity::BodyFixed([0, 1, 2], n);
        self.place(quantity, [i, j, ground, ground])
    }

    /// Place of the rotation of marker `i` about z of marker `j`, or of its displacement along it.
    pub(super) fn about_or_along_z(
        &mut self,
        rotation: bool,
        i: usize,
        j: usize,
        ground: usize,
    ) -> usize {
        if rotation {
            self.place(Quantity::Rotation(2), [i, j, ground, ground])
        } else {
            self.place(Quantity::Displacement(2), [i, j, j, ground])
        }
    }

    /// Place of the cosine between axis `a` of marker `i` and axis `b` of marker `j`.
    pub(super) fn direction_cosine(
        &mut self,
        [a, b]: [usize; 2],
        i: usize,
        j: usize,
        ground: usize,
    ) -> usize {
        self.place(Quantity::DirectionCosine(a, b), [i, j, ground, ground])
    }

    fn place(&mut self, quantity: Quantity, [i, j, k, l]: [usize; 4]) -> usize {
        let measure = Measure {
            quantity,
            i,
            j,
            k,
            l,
        };
        *self.places.entry(measure).or_insert_with(|| {
            self.list.push(measure);
            self.list.len() - 1
        })
    }
}

/// The quantity of `ORIENT(type, component, ...)`: types 1 to 12 are body-fixed sequences, 27 is
/// the Euler parameters; the numbers of the other types are not known here.
fn orientation(arguments: &[Expr]) -> Option<Quantity> {
    /// The sequences by type, from 1 on: three different axes, then the first axis again (the
    /// order of Kane, Likins and Levinson, *Spacecraft Dynamics*, appendix I).
    const SEQUENCES: [Sequence; 12] = [
        [0, 1, 2],
        [1, 2, 0],
        [2, 0, 1],
        [0, 2, 1],
        [1, 0, 2],
        [2, 1, 0],
        [0, 1, 0],
        [0, 2, 0],
        [1, 0, 1],
        [1, 2, 1],
        [2, 0, 2],
        [2, 1, 2],
    ];
    let kind = arguments.first()?.as_id()?;
    let component = arguments.get(1)?.as_id()?.checked_sub(1)? as usize;
    match kind {
        27 if component < 4 => Some(Quantity::EulerParameter(component)),
        1..=12 if component < 3 => {
            let sequence = SEQUENCES[kind as usize - 1];
            Some(Quantity::BodyFixed(sequence, component))
        }
        _ => None,
    }
}
