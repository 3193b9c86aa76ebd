//! Mathematics without mechanics: linear solves, rank decisions, interpolation and variable-order
//! integration.
//!
//! Nothing in this crate knows what a joint is. The mechanics crate states its equations through
//! [`bdf::System`] and assembles its Newton matrix in a [`linear::Matrix`].

pub mod bdf;
pub mod interpolation;
pub mod linear;
pub mod rank;
