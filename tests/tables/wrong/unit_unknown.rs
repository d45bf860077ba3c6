//! Unknown units: with a near one, and without.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    joint | theta | d       | a         | alpha   | stiffness
    a1    | q     | 350 mn  | 0         | 90 degs | 3e6 N*m/grad
    a2    | q     | 3 cubit | 2 m^x     | 0       | 3e6 N*
}

fn main() {
    let (q, w) = ([0.1; arm::N], [0.0; 6]);
    let lift = arm::jacobian(&q)[0][2];
    println!("{lift} {:?} {:?}", arm::pose(&q).position, arm::deflection(&q, &w));
    println!("{:?} {:?}", arm::all(&q, &w).map(|all| all.jacobian), arm::jacobian::OPS);
    let _: &dyn stiffarm::kernels::Kernels<f64> = &arm::Robot;
}
