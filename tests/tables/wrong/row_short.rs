//! A cell is missing.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    joint | theta | d | a      | alpha  | stiffness
    a1    | q     | 0 | 0      | 0      | 3.8e6
    a2    | q     | 0 | 350 mm | 6.6e6
    a3    | q     | 0 | 1.25   | 0      | 3.9e6
}

fn main() {
    // Three rows are three joints, whatever is wrong with one of them.
    let q = [0.1, 0.2, 0.3];
    println!("{} {:?} {:?}", arm::N, arm::pose(&q).position, arm::jacobian(&q)[2][0]);
}
