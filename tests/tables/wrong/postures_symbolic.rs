//! The same of a table with parameters, one of them in an angle.

use stiffarm::kernels::has;

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    joint | theta  | d | a    | alpha | stiffness
    a1    | q + t1 | 0 | 0    | 0     | k1
    a2    | q      | 0 | 1 kg | 0     | 1e5 N*m/rad
}

fn sag<const N: usize, A: has::Deflection<N>>(arm: &A, q: &[f64; N]) -> Option<[f64; 6]> {
    arm.deflection(&arm.posture(q), &[0.0; 6]).ok()
}

fn main() {
    let p = arm::Parameters { t1: 0.1, k1: 1e5 };
    let constants = arm::Constants::new(&p);
    let (q, w) = ([0.1; arm::N], [0.0; 6]);
    let posture = arm::Posture::new(&constants, &q);
    let columns = arm::parameter_jacobian::given(&constants, &posture);
    println!("{:?} {}", arm::deflection::given(&constants, &posture, &w), columns.len());
    println!("{:?}", arm::all::given(&constants, &posture, &w).map(|all| all.compliance));
    println!("{:?}", sag(&arm::Robot::new(&p), &q));
}
