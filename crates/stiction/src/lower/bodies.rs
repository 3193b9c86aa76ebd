//! PART, `POINT_MASS` and MARKER to bodies and frames.

use dataset::{Code, Dataset, Marker, MarkerOwner, Part, PointMass};
use mechanics::model;
use mechanics::rotation::Quaternion;
use nalgebra::{Matrix3, Vector3};

use super::{Lowering, frame, label};

/// Pose of the ground part: its markers are given in its frame.
struct Pose {
    origin: Vector3<f64>,
    axes: Matrix3<f64>,
}

impl Lowering<'_> {
    /// Bodies (parts, then point masses), and all markers with the ground marker last.
    pub(super) fn bodies(&mut self, model: &mut model::Model) {
        let dataset = self.dataset;
        for part in dataset.parts.iter().filter(|part| !part.ground) {
            let body = self.part(part);
            model.bodies.push(body);
        }
        for point in &dataset.point_masses {
            model.bodies.push(self.point_mass(point));
        }
        let ground = dataset.ground().map_or_else(
            || Pose {
                origin: Vector3::zeros(),
                axes: Matrix3::identity(),
            },
            |part| Pose {
                origin: Vector3::from(part.qg),
                axes: frame::axes(&part.orientation, &part.qg),
            },
        );
        let body_of = body_places(dataset);
        for marker in &dataset.markers {
            let body = body_of(marker.owner);
            let axes = frame::axes(&marker.orientation, &marker.qp);
            let qp = Vector3::from(marker.qp);
            let (offset, axes) = match body {
                Some(body) => (qp - model.bodies[body].centre, axes),
                None => (ground.origin + ground.axes * qp, ground.axes * axes),
            };
            model.markers.push(model::Marker {
                id: marker.header.id,
                body,
                offset,
                axes,
            });
        }
        model.markers.push(model::Marker {
            id: 0,
            body: None,
            offset: Vector3::zeros(),
            axes: Matrix3::identity(),
        });
    }

    fn marker(&self, id: Option<u32>) -> Option<&Marker> {
        self.dataset.markers.by_id(id?)
    }

    fn part(&mut self, part: &Part) -> model::Body {
        let mass = part.mass.unwrap_or(0.0);
        let cm = self.marker(part.cm);
        let centre = cm.map_or_else(Vector3::zeros, |cm| Vector3::from(cm.qp));
        let cm_axes = cm.map_or_else(Matrix3::identity, |cm| frame::axes(&cm.orientation, &cm.qp));
        let inertia = match part.inertia {
            Some(inertia) => self.inertia(part, &inertia, mass, &centre),
            None => Matrix3::zeros(),
        };
        let axes = frame::axes(&part.orientation, &part.qg);
        let linear = self.marker_axes(part.vm).unwrap_or_else(Matrix3::identity);
        let angular = self.marker_axes(part.wm).unwrap_or(axes * cm_axes);
        let ucf = self.ucf;
        let (velocity, given_linear) = given(&part.velocity, &linear);
        let (angular_velocity, given_angular) = given(&part.angular_velocity, &angular);
        let turns = [part.exact.psi, part.exact.theta, part.exact.phi];
        let turns_exact = turns.iter().all(|exact| *exact);
        if turns.contains(&true) && !turns_exact {
            self.warn(
                Code::Ignored,
                part.header.span,
                format!(
                    "EXACT of PART/{}: single angles are not held, only PSI, THETA and PHI \
                     together; assembly may change them",
                    part.header.id
                ),
            );
        }
        model::Body {
            label: label("PART", &part.header),
            mass: mass / ucf,
            inertia: inertia / ucf,
            centre,
            origin: Vector3::from(part.qg),
            orientation: Quaternion::from_matrix(&axes),
            velocity,
            angular_velocity,
            exact: [
                part.exact.x,
                part.exact.y,
                part.exact.z,
                turns_exact,
                turns_exact,
                turns_exact,
            ],
            given_velocity: [
                given_linear[0],
                given_linear[1],
                given_linear[2],
                given_angular[0],
                given_angular[1],
                given_angular[2],
            ],
            rotates: true,
        }
    }

    /// Inertia about the centre of mass along part axes, from that about the origin of IM along
    /// its axes.
    fn inertia(
        &self,
        part: &Part,
        [xx, yy, zz, xy, xz, yz]: &[f64; 6],
        mass: f64,
        centre: &Vector3<f64>,
    ) -> Matrix3<f64> {
        let tensor = Matrix3::new(*xx, -xy, -xz, -xy, *yy, -yz, -xz, -yz, *zz);
        let Some(im) = self.marker(part.im.or(part.cm)) else {
            return tensor;
        };
        let axes = frame::axes(&im.orientation, &im.qp);
        let shift = Vector3::from(im.qp) - centre;
        let steiner = Matrix3::identity() * shift.norm_squared() - shift * shift.transpose();
        axes * tensor * axes.transpose() - mass * steiner
    }

    /// Axes of a marker in ground, as the dataset gives them.
    fn marker_axes(&self, id: Option<u32>) -> Option<Matrix3<f64>> {
        let marker = self.marker(id)?;
        let axes = frame::axes(&marker.orientation, &marker.qp);
        let owner = match marker.owner {
            MarkerOwner::Part(id) => {
                let part = self.dataset.parts.by_id(id)?;
                frame::axes(&part.orientation, &part.qg)
            }
            MarkerOwner::PointMass(id) => {
                let point = self.dataset.point_masses.by_id(id)?;
                frame::axes(&point.orientation, &point.qg)
            }
            MarkerOwner::Refused => return None,
        };
        Some(owner * axes)
    }

    fn point_mass(&self, point: &PointMass) -> model::Body {
        let centre = self
            .marker(point.cm)
            .map_or_else(Vector3::zeros, |cm| Vector3::from(cm.qp));
        let axes = frame::axes(&point.orientation, &point.qg);
        let (velocity, given) = given(&point.velocity, &Matrix3::identity());
        let exact = &point.exact;
        model::Body {
            label: label("POINT_MASS", &point.header),
            mass: point.mass / self.ucf,
            // A point mass does not rotate, so its inertia is never used.
            inertia: Matrix3::identity(),
            centre,
            origin: Vector3::from(point.qg),
            orientation: Quaternion::from_matrix(&axes),
            velocity,
            angular_velocity: Vector3::zeros(),
            exact: [exact.x, exact.y, exact.z, false, false, false],
            given_velocity: [given[0], given[1], given[2], false, false, false],
            rotates: false,
        }
    }
}

/// The body that carries markers of an owner; `None` is ground.
fn body_places(dataset: &Dataset) -> impl Fn(MarkerOwner) -> Option<usize> {
    let moving: Vec<bool> = dataset.parts.iter().map(|part| !part.ground).collect();
    let mut next = 0;
    let places: Vec<Option<usize>> = moving
        .iter()
        .map(|moves| {
            moves.then(|| {
                next += 1;
                next - 1
            })
        })
        .collect();
    move |owner| match owner {
        MarkerOwner::Part(id) => dataset.parts.position(id).and_then(|place| places[place]),
        MarkerOwner::PointMass(id) => dataset.point_masses.position(id).map(|place| next + place),
        MarkerOwner::Refused => None,
    }
}

/// A vector given by components along `axes`, in ground, and which ground components count as
/// given: all of them where any component along turned axes is.
fn given(components: &[Option<f64>; 3], axes: &Matrix3<f64>) -> (Vector3<f64>, [bool; 3]) {
    let local = Vector3::from(components.map(|component| component.unwrap_or(0.0)));
    let given = if *axes == Matrix3::identity() {
        components.map(|component| component.is_some())
    } else {
        [components.iter().any(Option::is_some); 3]
    };
    (axes * local, given)
}
