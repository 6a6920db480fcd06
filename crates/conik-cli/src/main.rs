//! The command `conik`.
fn main() {}
