//! Cross-sections.

stiffarm::robot! {
    pub mod arm;
    convention: modified_dh;
    joint | theta | d | a | beam
    a1    | q     | 0 | 1 | { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section: tubes(0.2, 0.18) }
    a2    | q     | 0 | 1 | { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section: tube(0.18, 0.2) }
    a3    | q     | 0 | 1 | { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section: tube(outer, 0.18) }
    a4    | q     | 0 | 1 | { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section: box(120 mm, 80 mm) }
    a5    | q     | 0 | 1 | { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section: { area: 2e-3, iy: 3e-6, iz: 5e-6 } }
    a6    | q     | 0 | 1 | { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section: { area: 2e-3, iy: 3e-6, iz: 5e-6, j: 4e-6 m^2 } }
    a7    | q     | 0 | 1 | { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section: ipe200 }
}

fn main() {
    let (q, w) = ([0.1; arm::N], [0.0; 6]);
    let lift = arm::jacobian(&q)[0][2];
    println!("{lift} {:?} {:?}", arm::pose(&q).position, arm::deflection(&q, &w));
    println!("{:?} {:?}", arm::all(&q, &w).map(|all| all.jacobian), arm::jacobian::OPS);
    let _: &dyn stiffarm::kernels::Kernels<f64> = &arm::Robot;
}
