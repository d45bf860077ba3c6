//! A module without a name.

stiffarm::robot! {
    pub mod;
    convention: modified_dh;
    joint | theta
    a1    | q
}

fn main() {}
