//! A tip that the URDF does not have, and one that is not said where there are two.

stiffarm::robot! { pub mod arm from "files/elbow.urdf", base "base_link", tip "tool"; }
stiffarm::robot! { pub mod any from "files/elbow.urdf"; }

fn main() {
    let _ = arm::pose(&[0.0; 6]);
}
