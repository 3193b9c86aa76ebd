//! (crate stiction)
