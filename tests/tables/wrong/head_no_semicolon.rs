//! No `;` behind the name.

stiffarm::robot! {
    pub mod arm
    convention: modified_dh;
    joint | theta
    a1    | q
}

include!("../uses.rs");
