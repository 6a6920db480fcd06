//! UR.
pub mod wire;
