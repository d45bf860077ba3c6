//! A mistake elsewhere in a table with parameters.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    joint | theta | d | a  | alpha | stiffness | mass | com
    a1    | q     | 0 | a1 | 0     | k1        | m1   | [c1, 0, 0]
    a2    | q     | 0 | a2 | 1.571 | k2        | m2   | [c2, 0, 0]
}

fn main() {
    let p = arm::Parameters { a1: 0.3, k1: 1e5, m1: 4.0, c1: 0.1, a2: 0.3, k2: 1e5, m2: 4.0, c2: 0.1 };
    let (q, w) = ([0.1; arm::N], [0.0; 6]);
    let constants = arm::Constants::new(&p);
    println!("{:?} {:?}", arm::pose(&constants, &q), arm::deflection(&constants, &q, &w));
    let _: &dyn stiffarm::kernels::Kernels<f64> = &arm::Robot::new(&p);
}
