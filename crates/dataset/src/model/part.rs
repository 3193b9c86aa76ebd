//! PART, `POINT_MASS` and MARKER: bodies and the frames fixed on them.

use super::Header;

/// How the axes of a part or marker lie in their reference frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orientation {
    /// The axes of the reference frame.
    Identity,
    /// REULER: body-fixed 3-1-3 angles in radians, `R = Rz(a) Rx(b) Rz(c)`, where `R` turns
    /// components in the new axes into components in the reference frame.
    Euler([f64; 3]),
    /// ZP and XP (ZG and XG of a part): points, in the reference frame, that define the axes.
    Points {
        /// A point on the positive z axis; with `use_x` a point in the positive half of the xz
        /// plane. Absent: z is as near to the reference z as x allows.
        z: Option<[f64; 3]>,
        /// A point in the positive half of the xz plane; with `use_x` a point on the positive x
        /// axis. Absent: x is as near to the reference x as z allows.
        x: Option<[f64; 3]>,
        /// USEXP: the x axis is exact instead of the z axis.
        use_x: bool,
    },
}

/// EXACT: coordinates that assembly must not change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exact {
    /// Position along x.
    pub x: bool,
    /// Position along y.
    pub y: bool,
    /// Position along z.
    pub z: bool,
    /// First 3-1-3 angle.
    pub psi: bool,
    /// Second 3-1-3 angle.
    pub theta: bool,
    /// Third 3-1-3 angle.
    pub phi: bool,
}

/// PART: a rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Identifier, name and place.
    pub header: Header,
    /// GROUND: the fixed reference; exactly one part of a model.
    pub ground: bool,
    /// MASS, in mass units.
    pub mass: Option<f64>,
    /// CM: the marker at the centre of mass.
    pub cm: Option<u32>,
    /// IM: the marker at whose origin and in whose axes `inertia` is given; default `cm`.
    pub im: Option<u32>,
    /// IP: xx, yy, zz, xy, xz, yz. Products are the positive integrals of `x*y*dm`, so the tensor
    /// is `[[xx, -xy, -xz], [-xy, yy, -yz], [-xz, -yz, zz]]`.
    pub inertia: Option<[f64; 6]>,
    /// QG: origin of the part frame in the ground frame.
    pub qg: [f64; 3],
    /// REULER, or ZG and XG (points in the ground frame): axes of the part frame.
    pub orientation: Orientation,
    /// VX, VY, VZ: initial velocity of the centre of mass, along the axes of the ground or `vm`.
    pub velocity: [Option<f64>; 3],
    /// WX, WY, WZ: initial angular velocity, rad per time, along the axes of `cm` or `wm`.
    pub angular_velocity: [Option<f64>; 3],
    /// VM: the marker in whose axes `velocity` is given.
    pub vm: Option<u32>,
    /// WM: the marker in whose axes `angular_velocity` is given.
    pub wm: Option<u32>,
    /// EXACT.
    pub exact: Exact,
    /// MATERIAL: a name, without effect on a rigid part.
    pub material: Option<String>,
}

/// `POINT_MASS`: a mass without rotation.
#[derive(Clone, Debug, PartialEq)]
pub struct PointMass {
    /// Identifier, name and place.
    pub header: Header,
    /// MASS, in mass units.
    pub mass: f64,
    /// CM: the marker at the mass.
    pub cm: Option<u32>,
    /// QG: origin of its frame in the ground frame.
    pub qg: [f64; 3],
    /// REULER, or ZG and XG: axes of its frame, which never turn.
    pub orientation: Orientation,
    /// VX, VY, VZ: initial velocity along the axes of the ground.
    pub velocity: [Option<f64>; 3],
    /// EXACT (x, y, z only).
    pub exact: Exact,
}

/// What a marker is fixed on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarkerOwner {
    /// PART, by id.
    Part(u32),
    /// `POINT_MASS`, by id.
    PointMass(u32),
    /// `FLEX_BODY`, `FE_PART`, `EXTERNAL_SYSTEM`, CURVE or SURFACE: never in a dataset without
    /// errors.
    Refused,
}

/// MARKER: a frame fixed on a part.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// Identifier, name and place.
    pub header: Header,
    /// The body that carries it.
    pub owner: MarkerOwner,
    /// FLOATING: its place is set by the force that uses it.
    pub floating: bool,
    /// QP: origin in the part frame.
    pub qp: [f64; 3],
    /// REULER, or ZP and XP (points in the part frame): axes.
    pub orientation: Orientation,
}
