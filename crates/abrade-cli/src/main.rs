//! The `abrade` command.
fn main() {}
