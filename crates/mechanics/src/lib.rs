//! (crate mechanics)
