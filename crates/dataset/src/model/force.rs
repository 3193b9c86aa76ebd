//! SFORCE and SPRINGDAMPER: forces between two markers.

use super::Header;
use crate::expression::Expression;

/// Whether an element acts along a line or about an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceDirection {
    /// A force on the line from J to I, positive pushing them apart; with action only, along
    /// `z_J`.
    Translational,
    /// A torque about `z_J`.
    Rotational,
}

/// SFORCE.
#[derive(Clone, Debug, PartialEq)]
pub struct SingleForce {
    /// Identifier, name and place.
    pub header: Header,
    /// Force or torque.
    pub direction: ForceDirection,
    /// The I marker, on which the force acts.
    pub i: u32,
    /// The J marker, on which the opposite force acts.
    pub j: u32,
    /// ACTIONONLY: nothing acts on J.
    pub action_only: bool,
    /// Force, or torque.
    pub function: Expression,
}

/// SPRINGDAMPER: `F = -C*VR - K*(DM - LENGTH) + FORCE`, positive pushing I and J apart, or
/// `T = -CT*WZ - KT*(AZ - ANGLE) + TORQUE` on I about `z_J`.
#[derive(Clone, Debug, PartialEq)]
pub struct SpringDamper {
    /// Identifier, name and place.
    pub header: Header,
    /// Along a line or about an axis.
    pub direction: ForceDirection,
    /// The I marker.
    pub i: u32,
    /// The J marker.
    pub j: u32,
    /// K, force per length, or KT, torque per radian.
    pub stiffness: f64,
    /// C, force per velocity, or CT, torque per angular velocity.
    pub damping: f64,
    /// LENGTH, or ANGLE in radians, at which the spring is at `preload`.
    pub free_length: f64,
    /// FORCE or TORQUE at `free_length`.
    pub preload: f64,
}
