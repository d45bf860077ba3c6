//! Its dependencies are those of procedural macros.

fn main() {}
