//! The collection's symbolic arms, with numbers put in: against the textbook, and against the same arm
//! with the paper's numbers in its table.

use stiffarm::kernels::Kernels;
use stiffarm_codegen::robot::Robot;
use stiffarm_robots::{SYMBOLIC, lin_planar_symbolic};

use crate::compare::{Draws, agrees};

/// Compares an arm whose parameters have got numbers with the textbook of the same.
fn check(id: &str, value: impl Fn(&str) -> Option<f64>, kernels: &dyn Kernels<f64>) {
    let entry = SYMBOLIC.iter().find(|arm| arm.id == id).expect("the arm is listed");
    let (robot, _) = Robot::from_toml(entry.toml, id).expect("the file is valid");
    let robot = robot.with_parameters(value).expect("every symbol has a value");
    let arm = stiffarm_gap::robot::arm(&robot).expect("every parameter has a number");
    agrees(id, &arm, kernels, (1000, 6));
}

mod planar {
    use stiffarm_robots::lin_planar_symbolic;

    const INCH: f64 = 0.0254;
    const PSI: f64 = 4.448_221_615_260_5 / (INCH * INCH);

    parameters! {
        pub const PARAMETERS: lin_planar_symbolic::Parameters<f64> = {
            L1: 24.0 * INCH,
            L2: 24.0 * INCH,
            E1: 10e6 * PSI,
            E2: 10e6 * PSI,
            G1: 3.8e6 * PSI,
            G2: 3.8e6 * PSI,
            A1: 2.25 * INCH * INCH,
            A2: 0.984375 * INCH * INCH,
            Iy1: 1.920 * INCH * INCH * INCH * INCH,
            Iy2: 0.289 * INCH * INCH * INCH * INCH,
            I1: 1.920 * INCH * INCH * INCH * INCH,
            I2: 0.289 * INCH * INCH * INCH * INCH,
            J1: 2.84765625 * INCH * INCH * INCH * INCH,
            J2: 0.4239349365234375 * INCH * INCH * INCH * INCH,
            rho1: 2768.0,
            rho2: 2768.0,
        };
        pub fn parameter;
    }
}

mod elbow {
    use stiffarm_robots::lin_elbow_symbolic;

    parameters! {
        pub const PARAMETERS: lin_elbow_symbolic::Parameters<f64> = {
            a2: 0.6096,
            a3: 0.55,
            a4: 0.254,
            d6: 0.0889,
            E2: 69e9,
            E3: 70e9,
            E4: 71e9,
            E6: 72e9,
            G2: 26e9,
            G3: 25e9,
            G4: 24e9,
            G6: 23e9,
            A2: 3.9e-4,
            A3: 3.8e-4,
            A4: 3.7e-4,
            A6: 3.6e-4,
            I2: 1.1e-7,
            I3: 1.2e-7,
            I4: 1.3e-7,
            I6: 1.4e-7,
            J2: 2.1e-7,
            J3: 2.2e-7,
            J4: 2.3e-7,
            J6: 2.4e-7,
            rho2: 2700.0,
            rho3: 2600.0,
            rho4: 2500.0,
            rho6: 2400.0,
        };
        pub fn parameter;
    }
}

mod two_link {
    use stiffarm_robots::jweeg_two_link;

    parameters! {
        pub const PARAMETERS: jweeg_two_link::Parameters<f64> = { a1: 0.4, a2: 0.35 };
        pub fn parameter;
    }
}

#[test]
fn symbolic_arms_agree_with_the_textbook() {
    use stiffarm_robots::{jweeg_two_link, lin_elbow_symbolic};
    let planar = lin_planar_symbolic::Robot::new(&planar::PARAMETERS);
    check("lin_planar_symbolic", planar::parameter, &planar);
    let elbow = lin_elbow_symbolic::Robot::new(&elbow::PARAMETERS);
    check("lin_elbow_symbolic", elbow::parameter, &elbow);
    let two_link = jweeg_two_link::Robot::new(&two_link::PARAMETERS);
    check("jweeg_two_link", two_link::parameter, &two_link);
}

#[test]
fn symbols_with_the_papers_numbers_are_the_papers_arm() {
    use lin_planar_symbolic::{Constants, deflection};
    let constants = Constants::new(&planar::PARAMETERS);
    let mut draws = Draws::new(7);
    for _ in 0..1000 {
        let q = [3.0 * draws.unit(), 3.0 * draws.unit()];
        let wrench = core::array::from_fn(|_| 10.0 * draws.unit());
        let symbolic = deflection(&constants, &q, &wrench).expect("links do not buckle here");
        let numeric = stiffarm_robots::lin_planar::deflection(&q, &wrench).expect("nor here");
        for (a, b) in symbolic.iter().zip(numeric) {
            assert!((a - b).abs() <= 1e-15, "{a} {b}");
        }
    }
}
