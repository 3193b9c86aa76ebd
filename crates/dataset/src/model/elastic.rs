//! BUSHING, FIELD and BEAM: six-component forces, linear in displacements and velocities of I
//! relative to J along the axes of J.

use super::Header;

/// BUSHING: `F = -K*x - C*v + FORCE` and `T = -KT*a - CT*w + TORQUE` along the axes of J, where `a`
/// are the projected angles AX, AY and AZ of I in J.
#[derive(Clone, Debug, PartialEq)]
pub struct Bushing {
    /// Identifier, name and place.
    pub header: Header,
    /// The I marker.
    pub i: u32,
    /// The J marker.
    pub j: u32,
    /// K: force per length, not negative.
    pub stiffness: [f64; 3],
    /// KT: torque per radian, not negative.
    pub torsional_stiffness: [f64; 3],
    /// C: force per velocity, not negative.
    pub damping: [f64; 3],
    /// CT: torque per angular velocity, not negative.
    pub torsional_damping: [f64; 3],
    /// FORCE: preload on I.
    pub force: [f64; 3],
    /// TORQUE: preload on I.
    pub torque: [f64; 3],
}

/// FIELD: `(F, T) = -KMATRIX*(q - LENGTH) - CMATRIX*q' + FORCE` along the axes of J, where `q` are
/// the three displacements and the three projected angles of I in J.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Identifier, name and place.
    pub header: Header,
    /// The I marker.
    pub i: u32,
    /// The J marker.
    pub j: u32,
    /// KMATRIX, by rows.
    pub stiffness: [[f64; 6]; 6],
    /// CMATRIX, or CRATIO times KMATRIX, by rows.
    pub damping: [[f64; 6]; 6],
    /// LENGTH: displacements and angles at which the elastic force is zero.
    pub free: [f64; 6],
    /// FORCE: preloads on I, three forces and three torques.
    pub preload: [f64; 6],
}

/// The damping of a [`Beam`].
#[derive(Clone, Debug, PartialEq)]
pub enum BeamDamping {
    /// CRATIO: damping is so many times the stiffness.
    Ratio(f64),
    /// CMATRIX: symmetric, by rows.
    Matrix(Box<[[f64; 6]; 6]>),
}

/// BEAM with `FORMULATION = LINEAR`: a massless Timoshenko beam from J to I, straight along the x
/// axis of J.
#[derive(Clone, Debug, PartialEq)]
pub struct Beam {
    /// Identifier, name and place.
    pub header: Header,
    /// The I marker.
    pub i: u32,
    /// The J marker.
    pub j: u32,
    /// LENGTH: free length along x of J, positive.
    pub length: f64,
    /// AREA of the cross-section, positive.
    pub area: f64,
    /// IXX: torsional constant, positive.
    pub torsional_constant: f64,
    /// IYY: second moment of area about y, positive.
    pub moment_y: f64,
    /// IZZ: second moment of area about z, positive.
    pub moment_z: f64,
    /// ASY: shear area ratio for deflection along y; zero neglects shear.
    pub shear_y: f64,
    /// ASZ: shear area ratio for deflection along z; zero neglects shear.
    pub shear_z: f64,
    /// EMODULUS: Young's modulus, positive.
    pub young: f64,
    /// GMODULUS: shear modulus, positive.
    pub shear_modulus: f64,
    /// CRATIO or CMATRIX.
    pub damping: BeamDamping,
}
