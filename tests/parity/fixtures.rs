//! Fixtures: everything a row may hold, in combinations that no catalogue arm has.

use stiffarm::kernels::Kernels;
use stiffarm::robot;
use stiffarm_codegen::robot::Robot;

use crate::compare::agrees;

robot! {
    /// Standard rows with oblique twists, masses, beams and a turned tool.
    pub mod oblique;
    convention: standard_dh;
    gravity: [1, -2, -9.5];
    tool: translation [10 mm, -20 mm, 0.3] rotation [0.2, -0.4, pi/3];
    joint | theta        | d      | a      | alpha    | stiffness     | mass | com               | beam
    j1    | q + 30 deg   | 300 mm | 0      | 37.3 deg | 3e5 N*m/rad   | 12   | [0.1, -0.2, 0.05] | { youngs_modulus: 70 GPa, shear_modulus: 26 GPa, section: tube(120 mm, 100 mm), density: 2700 }
    j2    | q - pi/2     | 100 mm | 0.7    | -20 deg  | 2e5 N*m/rad   | 9    | [-0.3, 0, 0.1]    | { youngs_modulus: 70 GPa, shear_modulus: 26 GPa, section: box([120 mm, 80 mm], [110 mm, 70 mm]), density: 2700 }
    j3    | q + 0.7      | 0      | -0.4   | pi       | -             | -    | -                 | -
    j4    | q            | 50 mm  | 0.3    | 0        | 1e5 N*m/rad   | 3    | [0, 0.05, 0]      | -
    j5    | q + pi       | -0.2   | 0      | pi/4     | 8e4 N*m/rad   | 2    | [0.1, 0, 0]       | { youngs_modulus: 210 GPa, shear_modulus: 81 GPa, section: { area: 2e-3, iy: 3e-6, iz: 5e-6, j: 4e-6 } }
}

robot! {
    /// Modified rows: prismatic joints between revolute ones, beams whose chords are oblique.
    pub mod sliding;
    convention: modified_dh;
    tool: rotation [0, 0, pi/2];
    joint | theta      | d          | a      | alpha   | stiffness | mass | com            | beam
    j1    | q          | 0.4        | 0      | 0       | 4e5       | 20   | [0, 0, -0.1]   | { youngs_modulus: 70 GPa, shear_modulus: 26 GPa, section: tube(200 mm, 180 mm), density: 2700 }
    j2    | pi/6       | q + 200 mm | 0.1    | 90 deg  | 2e6 N/m   | 8    | [0, 0.1, 0.2]  | { youngs_modulus: 70 GPa, shear_modulus: 26 GPa, section: tube(80 mm, 60 mm) }
    j3    | q + 45 deg | 0.15       | 0.5    | -50 deg | 2e5       | 6    | [0.2, 0, 0]    | { youngs_modulus: 70 GPa, shear_modulus: 26 GPa, section: box([60 mm, 90 mm]), density: 2700 }
    j4    | 0          | q          | -0.2   | pi      | -         | -    | -              | -
    j5    | q          | 0          | 0.3    | 0       | 6e4       | 4    | [0.1, 0.1, 0]  | { youngs_modulus: 70 GPa, shear_modulus: 26 GPa, section: tube(60 mm, 40 mm), density: 2700 }
    j6    | q - 0.3    | -0.1       | 0      | 120 deg | 5e4       | 1    | [0, 0, 0.05]   | -
}

robot! {
    /// Nine parallel and antiparallel joints.
    pub mod parallel;
    convention: standard_dh;
    joint | theta    | d      | a     | alpha | stiffness | mass | com
    j1    | q        | 0.1    | 0.2   | 0     | 2e5       | 2    | [-0.1, 0, 0.02]
    j2    | q        | 0.05   | 0.2   | pi    | 2e5       | 2    | [-0.1, 0, 0.02]
    j3    | q + pi/2 | 0      | 0.2   | 0     | 2e5       | 2    | [-0.1, 0, 0.02]
    j4    | q        | -0.03  | 0.2   | -pi   | 2e5       | 2    | [-0.1, 0, 0.02]
    j5    | q        | 0.02   | 0.2   | pi    | 2e5       | 2    | [-0.1, 0, 0.02]
    j6    | q        | 0.01   | 0.2   | 0     | 2e5       | 2    | [-0.1, 0, 0.02]
    j7    | q        | 0      | 0.2   | 0     | 2e5       | 2    | [-0.1, 0, 0.02]
    j8    | q        | 0      | 0.1   | pi/2  | 2e5       | 1    | [0, 0, 0.02]
    j9    | q        | 0.1    | 0     | 0     | 2e5       | 1    | [0, 0, 0.02]
}

robot! {
    /// Two joints about z and, at rest, about y, with springs.
    pub mod perpendicular;
    convention: standard_dh;
    joint | theta | d | a   | alpha | stiffness
    j1    | q     | 0 | 0   | -pi/2 | 1.5e5
    j2    | q     | 0 | 0.3 | 0     | 6e4
}

robot! {
    /// One joint, rigid, weightless.
    pub mod lone;
    convention: modified_dh;
    joint | theta | d | a | alpha
    j1    | q     | 0 | 0 | 0
}

robot! {
    /// Every kind of symbol.
    pub mod symbolic;
    convention: standard_dh;
    tool: translation [0, 0, t_z];
    joint | theta  | d       | a     | alpha   | stiffness | mass | com           | beam
    j1    | q + o1 | d1      | a1    | alpha1  | k1        | m1   | [cx, 0, cz]   | { youngs_modulus: E1, shear_modulus: G1, section: { area: A1, iy: Iy1, iz: Iz1, j: J1 }, density: rho1 }
    j2    | q      | 0       | a2    | 0       | k2        | m2   | [0, cy, 0]    | { youngs_modulus: E1, shear_modulus: G1, section: { area: A1, iy: Iy1, iz: Iz1, j: J1 }, density: rho1 }
    j3    | q + o3 | d3      | 0     | -pi/2   | k3        | -    | -             | -
    j4    | 0      | q + d4  | a4    | 90 deg  | k4        | -    | -             | { youngs_modulus: E1, shear_modulus: G1, section: { area: A1, iy: Iy1, iz: Iz1, j: J1 } }
}

parameters! {
    pub const PARAMETERS: symbolic::Parameters<f64> = {
        o1: 0.3,
        d1: 0.25,
        a1: -0.4,
        alpha1: 0.6,
        k1: 2e5,
        m1: 7.0,
        cx: 0.1,
        cz: -0.05,
        E1: 70e9,
        G1: 26e9,
        A1: 1.5e-3,
        Iy1: 2e-6,
        Iz1: 3e-6,
        J1: 4e-6,
        rho1: 2700.0,
        a2: 0.55,
        k2: 1.5e5,
        m2: 4.0,
        cy: 0.07,
        o3: -0.8,
        d3: 0.12,
        k3: 9e4,
        d4: 0.3,
        a4: 0.15,
        k4: 1e6,
        t_z: 0.2,
    };
    pub fn parameter;
}

/// The table of a module of this file, read through the macro's own reader.
pub fn table(module: &str) -> Robot {
    let source = include_str!("fixtures.rs");
    let start = source.find(&format!("pub mod {module};")).expect("the module is above");
    let end = start + source[start..].find("\n}").expect("the invocation ends");
    let tokens = source[start..end].parse().expect("tokens");
    let Ok(invocation) = stiffarm_codegen::robot::parse_tokens(tokens) else {
        panic!("the table of {module} is valid")
    };
    match invocation.source {
        stiffarm_codegen::robot::Source::Table(robot) => *robot,
        stiffarm_codegen::robot::Source::File(_) => panic!("{module} is inline"),
    }
}

fn check(module: &str, robot: &Robot, kernels: &dyn Kernels<f64>) {
    let arm = stiffarm_gap::robot::arm(robot).expect("every parameter has a number");
    agrees(module, &arm, kernels, (1000, 3));
}

#[test]
fn fixtures_agree_with_the_textbook() {
    check("oblique", &table("oblique"), &oblique::Robot);
    check("sliding", &table("sliding"), &sliding::Robot);
    check("parallel", &table("parallel"), &parallel::Robot);
    check("lone", &table("lone"), &lone::Robot);
}

#[test]
fn symbolic_parameters_agree_with_the_textbook() {
    let robot = table("symbolic").with_parameters(parameter).expect("every symbol has a value");
    check("symbolic", &robot, &symbolic::Robot::new(&PARAMETERS));
}

#[test]
fn constants_describe_the_module() {
    assert_eq!((parallel::N, parallel::NAME), (9, "parallel"));
    assert_eq!(oblique::DH[1].theta, "-pi/2");
    assert_eq!(oblique::DH[2].alpha, "pi");
    assert!(!lone::jacobian::SPARSITY[0][0] && lone::jacobian::SPARSITY[0][5]);
    assert_eq!(lone::jacobian::OPS.flops(), 0);
    assert_eq!(parallel::pose::OPS.sin_cos, 9);
}
