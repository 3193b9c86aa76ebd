//! (crate results)
