//! What is asked for of a file's frames that it does not have.

stiffarm::robot! {
    pub mod arm from "files/good.toml";
    outputs: pose at elbow;
}

fn main() {
    let _ = arm::pose(&[0.0, 0.0]);
}
