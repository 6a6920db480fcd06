//! UR.
pub mod driver;
pub mod emulator;
pub mod program;
pub mod registers;
pub mod session;
pub mod status;
pub mod wire;
