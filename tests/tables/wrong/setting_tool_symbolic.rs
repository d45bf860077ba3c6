//! The rotation of the tool is known.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    tool: translation [0, 0, 100 mm] rotation [0, 0, yaw];
    joint | theta | d | a
    a1    | q     | 0 | 1
}

fn main() {
    println!("{:?}", arm::pose(&[0.1]));
}
