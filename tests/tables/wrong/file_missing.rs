//! The robot file is not there.

stiffarm::robot! {
    pub mod arm from "files/nowhere.toml";

}

include!("../uses.rs");
