//! The path of the kernels is no path.

stiffarm::robot! {
    pub mod arm;
    crate: "stiffarm";
    convention: modified_dh;
    joint | theta | d | a
    a1    | q     | 0 | 1
}

include!("../uses.rs");
