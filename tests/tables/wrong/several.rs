//! Mistakes all over: each is reported once, in the order in which they stand.

stiffarm::robot! {
    pub mod arm;
    convention: denavit;
    gravity: [0, 0];
    joint | theta     | d      | a      | alpha  | stifness
    a1    | q         | 350 kg | 0      | 1.5708 | 3.8e6
    a1    | pi        | 0      | 350 mn | 0      | 6.6e6
    a3    | q + 2 pi  | 0      | 1.25   | 0
    a4    | q         | fn     | 1 + 2  | 0      | 5.6e5
}

include!("../uses.rs");
