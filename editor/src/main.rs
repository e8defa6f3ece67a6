//! The `lightbench` program.
fn main() {}
