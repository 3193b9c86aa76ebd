//! (crate numerics)
