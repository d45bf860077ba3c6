//! `q` stands in two cells of one row, and twice in one cell.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    joint | theta | d | a
    a1    | q     | q | 1
    a2    | q + q | 0 | 1
}

include!("../uses.rs");
