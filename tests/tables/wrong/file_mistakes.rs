//! The robot file has mistakes.

stiffarm::robot! {
    pub mod arm from "files/mistakes.toml";

}

include!("../uses.rs");
