//! A heavy beam whose length changes.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    joint | theta | d | a   | beam
    a1    | 0     | q | 0.1 | { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section: tube(0.2), density: 2700 kg/m^3 }
}

fn main() {
    let (q, w) = ([0.1; arm::N], [0.0; 6]);
    let lift = arm::jacobian(&q)[0][2];
    println!("{lift} {:?} {:?}", arm::pose(&q).position, arm::deflection(&q, &w));
    println!("{:?} {:?}", arm::all(&q, &w).map(|all| all.jacobian), arm::jacobian::OPS);
    let _: &dyn stiffarm::kernels::Kernels<f64> = &arm::Robot;
}
