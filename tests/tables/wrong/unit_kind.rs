//! Units of the wrong kind.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    joint | theta    | d      | a      | alpha | stiffness     | mass
    a1    | q        | 350 kg | 0      | 90 mm | 3e6 N/m       | 12 mm
    a2    | 0        | q      | 2 rad  | 0     | 3e6 N*m/rad   | 12 N
    a3    | q + 2 mm | 0      | 1      | 0     | 2e5 in*lb/rad | 12 kg
}

fn main() {
    let (q, w) = ([0.1; arm::N], [0.0; 6]);
    let lift = arm::jacobian(&q)[0][2];
    println!("{lift} {:?} {:?}", arm::pose(&q).position, arm::deflection(&q, &w));
    println!("{:?} {:?}", arm::all(&q, &w).map(|all| all.jacobian), arm::jacobian::OPS);
    let _: &dyn stiffarm::kernels::Kernels<f64> = &arm::Robot;
}
