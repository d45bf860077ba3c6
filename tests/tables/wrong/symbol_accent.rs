//! A name that is no plain word.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    joint | theta | d | a     | alpha
    a1    | q     | 0 | länge | 0
    a2    | q     | 0 | _a2   | 0
}

fn main() {
    let p = arm::Parameters { länge: 0.3, _a2: 0.4 };
    let (q, w) = ([0.1; arm::N], [0.0; 6]);
    let constants = arm::Constants::new(&p);
    println!("{:?} {:?}", arm::pose(&constants, &q), arm::deflection(&constants, &q, &w));
    let _: &dyn stiffarm::kernels::Kernels<f64> = &arm::Robot::new(&p);
}
