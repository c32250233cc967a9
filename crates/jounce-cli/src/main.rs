//! The command line of jounce.
fn main() {}
