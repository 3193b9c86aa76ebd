//! (crate dataset)
