//! Kinematic functions to measures; equal measures are kept once.

use std::collections::HashMap;

use dataset::{Expr, Function};
use mechanics::measure::{Measure, Quantity};

/// The measures of a model, each once, in the order in which functions first name them.
///
/// A session keeps one list through all changes of its model, because the numbering of measures
/// must not change while a simulation runs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Measures {
    list: Vec<Measure>,
    places: HashMap<(Function, u32, [usize; 4]), usize>,
}

impl Measures {
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
        let mut component = 0;
        let (quantity, roles) = match function {
            F::Dx => (Q::Displacement(0), ijk),
            F::Dy => (Q::Displacement(1), ijk),
            F::Dz => (Q::Displacement(2), ijk),
            F::Dm => (Q::Distance, ij),
            F::Ax => (Q::Rotation(0), ij),
            F::Ay => (Q::Rotation(1), ij),
            F::Az => (Q::Rotation(2), ij),
            F::Psi => (Q::Euler(0), ij),
            F::Theta => (Q::Euler(1), ij),
            F::Phi => (Q::Euler(2), ij),
            F::Yaw => (Q::YawPitchRoll(0), ij),
            F::Pitch => (Q::YawPitchRoll(1), ij),
            F::Roll => (Q::YawPitchRoll(2), ij),
            F::Incang => (Q::IncludedAngle, ijk),
            F::Orient => {
                // Type 27: Euler parameters; component 1 to 4.
                let parameter = arguments.get(1)?.as_id()?.checked_sub(1)?;
                if arguments[0].as_id() != Some(27) || parameter > 3 {
                    return None;
                }
                component = parameter;
                (Q::EulerParameter(parameter as usize), [2, 3, NONE, NONE])
            }
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
        Some(self.place((function, component, markers), quantity))
    }

    /// Place of the body-fixed 1-2-3 angle `n` of marker `i` in marker `j`.
    pub(crate) fn body_123(&mut self, n: usize, i: usize, j: usize, ground: usize) -> usize {
        // No function of the language has this quantity: ROLL stands for it in the key with a
        // component that ROLL itself never has.
        let key = (Function::Roll, 1 + n as u32, [i, j, ground, ground]);
        self.place(key, Quantity::Body123(n))
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
            let key = (Function::Az, 0, [i, j, ground, ground]);
            self.place(key, Quantity::Rotation(2))
        } else {
            let key = (Function::Dz, 0, [i, j, j, ground]);
            self.place(key, Quantity::Displacement(2))
        }
    }

    fn place(&mut self, key: (Function, u32, [usize; 4]), quantity: Quantity) -> usize {
        let [i, j, k, l] = key.2;
        *self.places.entry(key).or_insert_with(|| {
            self.list.push(Measure {
                quantity,
                i,
                j,
                k,
                l,
            });
            self.list.len() - 1
        })
    }
}
