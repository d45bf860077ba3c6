//! No table.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
}

include!("../uses.rs");
