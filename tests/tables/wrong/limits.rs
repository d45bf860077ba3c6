//! Joint limits.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    joint | theta | d | a | limits
    a1    | q     | 0 | 1 | [90 deg, -90 deg]
    a2    | q     | 0 | 1 | [-pi, pi, 0]
    a3    | q     | 0 | 1 | -pi..pi
    a4    | q     | 0 | 1 | [low, 1]
    a5    | 0     | q | 1 | [0, 90 deg]
    a6    | q     | 0 | 1 | [-170, 170]
}

fn main() {
    let (q, w) = ([0.1; arm::N], [0.0; 6]);
    let lift = arm::jacobian(&q)[0][2];
    println!("{lift} {:?} {:?}", arm::pose(&q).position, arm::deflection(&q, &w));
    println!("{:?} {:?}", arm::all(&q, &w).map(|all| all.jacobian), arm::jacobian::OPS);
    let _: &dyn stiffarm::kernels::Kernels<f64> = &arm::Robot;
}
