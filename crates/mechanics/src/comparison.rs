//! Two runs of one model beside each other: how far apart they are, and what that tells of their error.
//!
//! ERROR bounds the error of each step. Over a run errors of steps add up, and the motion magnifies them
//! or not, which no test of a step can see. A second run with a tenth of ERROR can: a method whose error
//! is a power `ERROR^q` (L. F. Shampine, *Tolerance proportionality in ODE codes*, Lecture Notes in
//! Mathematics 1386, 1989) has `1 − 10⁻q` of it as the difference of both runs: nine tenths for `q = 1`,
//! two thirds for a method of first order, whose error falls with `√ERROR`. Where the longest step and
//! not ERROR limits the steps (or FIXIT gives their length), those of the second run are a third, and the
//! difference is two thirds of the error at first order, more at higher ones. Twice the difference is taken,
//! which covers all of these; and more where a tenth of ERROR is not a tenth of what steps may make of it, as
//! towards rounding, so that the difference is a smaller part of the error.

use nalgebra::Vector3;

use crate::rotation::Quaternion;
use crate::simulation::Settings;
use crate::snapshot::Snapshot;

/// Part of ERROR that the second run has.
const TIGHTER: f64 = 0.1;
/// Part that it has of the longest step and of a first one that is given.
const SHORTER: f64 = 1.0 / 3.0;
/// Error of a run for a difference of one from the second run, whose steps make a tenth of the error.
const SAFETY: f64 = 2.0;
/// Errors of a step that a run may be off before it counts as inaccurate.
const ACCURATE: f64 = 100.0;

impl Settings {
    /// Those of a second run that tells the error of a run with these: a tenth of the error tolerance.
    ///
    /// Its longest step and a first one that is given are a third as long, so that it
    /// differs from the run where these limit the steps; its shortest step is a tenth, so that it fails no
    /// sooner.
    #[must_use]
    pub fn tighter(&self) -> Self {
        Self {
            error: TIGHTER * self.error,
            longest_step: SHORTER * self.longest_step,
            first_step: self.first_step.map(|first| SHORTER * first),
            shortest_step: TIGHTER * self.shortest_step,
            ..*self
        }
    }

    /// Error of a run with these for a difference of one from the second run: so much that a method of
    /// first order has it to spare as with a tenth of the error of a step.
    fn safety(&self) -> f64 {
        let part = self.tighter().motion_error() / self.motion_error();
        SAFETY * (1.0 - TIGHTER.sqrt()) / (1.0 - part.sqrt())
    }
}

impl crate::EquilibriumSettings {
    /// Those of a second run: a tenth of the error.
    #[must_use]
    pub fn tighter(&self) -> Self {
        Self {
            error: TIGHTER * self.error,
            ..*self
        }
    }
}

/// What of an instant is compared with that of another run of the same model.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    time: f64,
    places: Vec<(Vector3<f64>, Quaternion)>,
    /// Force and torque of each friction on I, along the axes of J.
    frictions: Vec<[Vector3<f64>; 2]>,
    states: Vec<f64>,
}

impl Moment {
    /// Of a solved instant.
    #[must_use]
    pub fn of(snapshot: &Snapshot<'_>) -> Self {
        let (model, state) = (snapshot.model(), snapshot.state());
        let place = |body| (state.centre(body), state.orientation(body));
        let friction = |place| {
            let values = snapshot.friction(place);
            [values.force, values.torque]
        };
        Self {
            time: snapshot.time(),
            places: (0..model.bodies.len()).map(place).collect(),
            frictions: (0..model.frictions.len()).map(friction).collect(),
            states: state.states().to_vec(),
        }
    }

    /// Its time.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }
}

/// One error of a step, as the error test counts it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepError {
    /// Of positions, length: for an integrator ERROR times [`crate::System::length_scale`].
    pub distance: f64,
    /// Of orientations, radians.
    pub rotation: f64,
    /// Error of the run for a difference of one from the second run.
    pub safety: f64,
}

impl StepError {
    /// With the tolerance `error`, for a model with this typical length.
    #[must_use]
    pub fn new(error: f64, length: f64) -> Self {
        Self {
            distance: error * length,
            rotation: error,
            safety: SAFETY,
        }
    }

    /// Of an integrator with these settings.
    #[must_use]
    pub fn of(settings: &Settings, length: f64) -> Self {
        Self {
            safety: settings.safety(),
            ..Self::new(settings.error, length)
        }
    }
}

/// Whether bodies have other places or other orientations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Distance of the centres of mass, length.
    Distance,
    /// Rotation from one orientation to the other, radians.
    Rotation,
}

/// How far a body is from where the second run has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Distance or rotation.
    pub motion: Motion,
    /// The body.
    pub body: usize,
    /// Difference of both runs, length or radians.
    pub difference: f64,
    /// One error of a step, length or radians.
    pub step_error: f64,
    /// Error of the run for a difference of one.
    pub safety: f64,
    /// When.
    pub time: f64,
}

impl Deviation {
    /// The difference in errors of a step.
    #[must_use]
    pub fn errors(&self) -> f64 {
        self.difference / self.step_error
    }

    /// The error of the run that follows from it, length or radians.
    #[must_use]
    pub fn estimate(&self) -> f64 {
        self.safety * self.difference
    }

    /// The same in errors of a step.
    #[must_use]
    pub fn estimated_errors(&self) -> f64 {
        self.safety * self.errors()
    }

    /// Whether it is more than a hundred errors of a step.
    #[must_use]
    pub fn is_inaccurate(&self) -> bool {
        !(self.estimated_errors() <= ACCURATE)
    }

    /// ERROR as a part of that of the run with which the estimate would come down to a hundred errors of
    /// a step of this run, for a method whose error is ERROR to the power `exponent`.
    #[must_use]
    pub fn remedy(&self, exponent: f64) -> f64 {
        (ACCURATE / self.estimated_errors()).powf(1.0 / exponent)
    }
}

/// The largest difference of a friction or of a differential state, and how large that becomes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// Difference of both runs.
    pub difference: f64,
    /// When.
    pub time: f64,
    /// Largest magnitude in the run.
    pub magnitude: f64,
}

impl Spread {
    fn add(&mut self, difference: f64, magnitude: f64, time: f64) {
        if !(difference <= self.difference) {
            (self.difference, self.time) = (difference, time);
        }
        self.magnitude = self.magnitude.max(magnitude);
    }
}

/// Two runs compared, instant by instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison {
    /// Number of instants.
    pub instants: usize,
    /// Largest distance, in errors of a step; none where nothing was compared.
    pub distance: Option<Deviation>,
    /// Largest rotation.
    pub rotation: Option<Deviation>,
    /// The first deviation that was inaccurate, the larger of both there.
    pub inaccurate: Option<Deviation>,
    /// Of each friction, its force and its torque on I.
    pub frictions: Vec<[Spread; 2]>,
    /// Of each differential state.
    pub states: Vec<Spread>,
}

impl Comparison {
    /// Adds an instant of a run and that of the second one, of the same time; `error` is one error of a
    /// step of the run.
    pub fn add(&mut self, run: &Moment, second: &Moment, error: StepError) {
        let time = run.time;
        self.instants += 1;
        let mut now = [None; 2];
        for (body, ((r, q), (s, p))) in run.places.iter().zip(&second.places).enumerate() {
            let of = |motion, difference, step_error| Deviation {
                motion,
                body,
                difference,
                step_error,
                safety: error.safety,
                time,
            };
            let distance = of(Motion::Distance, (r - s).norm(), error.distance);
            let rotation = of(Motion::Rotation, q.angle_to(p), error.rotation);
            raise(&mut now[0], distance);
            raise(&mut now[1], rotation);
        }
        for (largest, now) in [&mut self.distance, &mut self.rotation]
            .into_iter()
            .zip(now)
        {
            now.into_iter().for_each(|now| raise(largest, now));
        }
        if self.inaccurate.is_none() {
            for now in now.into_iter().flatten().filter(Deviation::is_inaccurate) {
                raise(&mut self.inaccurate, now);
            }
        }
        self.frictions
            .resize_with(run.frictions.len(), Default::default);
        let pairs = run.frictions.iter().zip(&second.frictions);
        for (spreads, (a, b)) in self.frictions.iter_mut().zip(pairs) {
            for k in 0..2 {
                spreads[k].add((a[k] - b[k]).norm(), a[k].norm(), time);
            }
        }
        self.states.resize_with(run.states.len(), Default::default);
        let pairs = run.states.iter().zip(&second.states);
        for (spread, (a, b)) in self.states.iter_mut().zip(pairs) {
            spread.add((a - b).abs(), a.abs(), time);
        }
    }

    /// The larger of distance and rotation, in errors of a step.
    #[must_use]
    pub fn largest(&self) -> Option<Deviation> {
        let mut largest = None;
        for deviation in [self.distance, self.rotation].into_iter().flatten() {
            raise(&mut largest, deviation);
        }
        largest
    }
}

/// Takes the larger one; what is not a number is larger than all that is.
fn raise(largest: &mut Option<Deviation>, deviation: Deviation) {
    if largest.is_none_or(|most| !(deviation.errors() <= most.errors())) {
        *largest = Some(deviation);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moment(x: f64, angle: f64, torque: f64) -> Moment {
        Moment {
            time: 1.0,
            places: vec![(
                Vector3::new(x, 0.0, 0.0),
                Quaternion::exp(&Vector3::new(0.0, 0.0, angle)),
            )],
            frictions: vec![[Vector3::zeros(), Vector3::new(0.0, 0.0, torque)]],
            states: vec![2.0 * x],
        }
    }

    #[test]
    fn differences_are_in_errors_of_a_step() {
        let mut comparison = Comparison::default();
        let error = StepError::new(1e-3, 2.0);
        comparison.add(&moment(1.0, 0.3, -4.0), &moment(1.1, 0.31, -3.0), error);
        let [distance, rotation] = [comparison.distance, comparison.rotation].map(Option::unwrap);
        assert!((distance.difference - 0.1).abs() < 1e-15);
        assert!((distance.errors() - 50.0).abs() < 1e-12);
        assert!((rotation.difference - 0.01).abs() < 1e-15);
        assert!((rotation.errors() - 10.0).abs() < 1e-12);
        assert_eq!(comparison.largest(), Some(distance));
        let spread = comparison.frictions[0][1];
        assert_eq!((spread.difference, spread.magnitude), (1.0, 4.0));
        assert!((comparison.states[0].difference - 0.2).abs() < 1e-15);
    }

    /// Towards rounding steps of index 3 may make more than a tenth of ERROR, and those of the second run
    /// then less than ten times less: of an error that falls with the root of it less is seen.
    #[test]
    fn less_difference_tells_of_as_much_error() {
        for (power, part) in [(-5, 0.1), (-7, 0.1_f64.sqrt())] {
            let settings = Settings {
                formulation: crate::Formulation::Newmark {
                    beta: 0.36,
                    gamma: 0.7,
                },
                error: 10f64.powi(power),
                highest_order: 5,
                longest_step: 0.1,
                shortest_step: 1e-7,
                first_step: None,
                corrector: crate::Corrector::default(),
                interpolates: true,
            };
            let seen = 1.0 - part.sqrt();
            let told = StepError::of(&settings, 1.0).safety * seen;
            assert!(
                (told - SAFETY * (1.0 - TIGHTER.sqrt())).abs() < 1e-12,
                "{told}"
            );
        }
    }

    #[test]
    fn the_first_that_is_inaccurate_stays_and_no_number_is_none() {
        let mut comparison = Comparison::default();
        let error = StepError::new(1e-3, 1.0);
        let zero = moment(0.0, 0.0, 0.0);
        comparison.add(&zero, &moment(0.04, 0.0, 0.0), error);
        assert_eq!(comparison.inaccurate, None);
        // A turn by q and by -q is the same one.
        comparison.add(&zero, &moment(0.0, 0.2 + std::f64::consts::TAU, 0.0), error);
        let first = comparison.inaccurate.unwrap();
        assert_eq!(first.motion, Motion::Rotation);
        assert!((first.difference - 0.2).abs() < 1e-12);
        // An error of first order has to fall by four: ERROR by sixteen.
        assert!((first.remedy(0.5) - 1.0 / 16.0).abs() < 1e-12);
        comparison.add(&zero, &moment(9.0, 0.0, 0.0), error);
        assert_eq!(comparison.inaccurate, Some(first));
        comparison.add(&zero, &moment(f64::NAN, 0.0, 0.0), error);
        assert!(comparison.distance.unwrap().is_inaccurate());
        assert!(comparison.distance.unwrap().difference.is_nan());
    }
}
