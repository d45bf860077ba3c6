//! The robot file has parameters, and a mistake.

stiffarm::robot! {
    pub mod arm from "files/symbolic.toml";

}

fn main() {
    let p = arm::Parameters { a1: 0.3, k2: 1e5 };
    let (q, w) = ([0.1; arm::N], [0.0; 6]);
    let constants = arm::Constants::new(&p);
    println!("{:?} {:?}", arm::pose(&constants, &q), arm::deflection(&constants, &q, &w));
    let _: &dyn stiffarm::kernels::Kernels<f64> = &arm::Robot::new(&p);
}
