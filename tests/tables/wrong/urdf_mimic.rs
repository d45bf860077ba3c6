//! A joint that follows another.

stiffarm::robot! { pub mod arm from "files/mimic.urdf", base "base_link", tip "tool0"; }

fn main() {
    let _ = arm::pose(&[0.0; 6]);
}
