//! One name for two quantities.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    joint | theta | d  | a | alpha | mass
    a1    | q     | x1 | y | x1    | -
    a2    | q     | 0  | y | 0     | y
}

fn main() {
    let p = arm::Parameters { x1: 0.1, y: 0.3 };
    let (q, w) = ([0.1; arm::N], [0.0; 6]);
    let constants = arm::Constants::new(&p);
    println!("{:?} {:?}", arm::pose(&constants, &q), arm::deflection(&constants, &q, &w));
    let _: &dyn stiffarm::kernels::Kernels<f64> = &arm::Robot::new(&p);
}
