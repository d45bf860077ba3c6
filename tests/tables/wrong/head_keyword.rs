//! The module has the name of a keyword.

stiffarm::robot! {
    pub mod move;
    convention: modified_dh;
    joint | theta
    a1    | q
}

fn main() {}
