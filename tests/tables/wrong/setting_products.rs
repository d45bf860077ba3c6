//! Products are fused into sums or stay separate.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    products: fuse;
    joint | theta | d | a
    a1    | q     | 0 | 1
}

fn main() {
    let (q, w) = ([0.1; arm::N], [0.0; 6]);
    let lift = arm::jacobian(&q)[0][2];
    println!("{lift} {:?} {:?}", arm::pose(&q).position, arm::deflection(&q, &w));
    println!("{:?} {:?}", arm::all(&q, &w).map(|all| all.jacobian), arm::jacobian::OPS);
    let _: &dyn stiffarm::kernels::Kernels<f64> = &arm::Robot;
}
