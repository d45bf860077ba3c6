//! Values of beams.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    joint | theta | d | a | beam
    a1    | q     | 0 | 1 | { youngs_modulus: 69 MPA, shear_modulus: 26 mm, section: tube(0.2) }
    a2    | q     | 0 | 1 | { youngs_modulus: -69 GPa, shear_modulus: 26 GPa, section: tube(0.2) }
    a3    | q     | 0 | 1 | { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section: tube(0.2), density: -2700 }
    a4    | q     | 0 | 1 | { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section: tube(0.2), shear_coefficient: 0 }
}

fn main() {
    let (q, w) = ([0.1; arm::N], [0.0; 6]);
    let lift = arm::jacobian(&q)[0][2];
    println!("{lift} {:?} {:?}", arm::pose(&q).position, arm::deflection(&q, &w));
    println!("{:?} {:?}", arm::all(&q, &w).map(|all| all.jacobian), arm::jacobian::OPS);
    let _: &dyn stiffarm::kernels::Kernels<f64> = &arm::Robot;
}
