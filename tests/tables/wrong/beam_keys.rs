//! Keys of beams: misspelt, unheard of, missing, twice, without a value.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    joint | theta | d | a | beam
    a1    | q     | 0 | 1 | { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, secton: tube(0.2, 0.18) }
    a2    | q     | 0 | 1 | { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section: tube(0.2, 0.18), colour: red }
    a3    | q     | 0 | 1 | { youngs_modulus: 69 GPa }
    a4    | q     | 0 | 1 | { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section: tube(0.2), shear_modulus: 26 GPa }
    a5    | q     | 0 | 1 | { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section tube(0.2) }
    a6    | q     | 0 | 1 | tube(0.2, 0.18)
}

fn main() {
    let (q, w) = ([0.1; arm::N], [0.0; 6]);
    let lift = arm::jacobian(&q)[0][2];
    println!("{lift} {:?} {:?}", arm::pose(&q).position, arm::deflection(&q, &w));
    println!("{:?} {:?}", arm::all(&q, &w).map(|all| all.jacobian), arm::jacobian::OPS);
    let _: &dyn stiffarm::kernels::Kernels<f64> = &arm::Robot;
}
