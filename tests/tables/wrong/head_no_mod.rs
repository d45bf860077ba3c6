//! `mod` is forgotten.

stiffarm::robot! {
    pub arm;
    convention: modified_dh;
    joint | theta
    a1    | q
}

fn main() {}
