//! (crate friction)
