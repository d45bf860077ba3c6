//! A mistake where the kernels are found elsewhere.

mod here {
    pub use stiffarm::kernels as machinery;
}

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    crate: crate::here::machinery;
    joint | theta | d      | a
    a1    | q     | 350 kg | 1
}

include!("../uses.rs");
