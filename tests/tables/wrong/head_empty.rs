//! Nothing at all.

stiffarm::robot! {}

fn main() {}
