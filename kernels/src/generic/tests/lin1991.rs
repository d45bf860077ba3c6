//! The planar two-link robot of Lin et al. (standard convention) against the printed tables and
//! equations, in their inches and pounds.

use std::string::ToString;
use std::vec;

use nalgebra::{Vector3, Vector6};

use crate::generic::{Arm, Beam, Joint};

const LENGTH: f64 = 24.0;
const YOUNG: f64 = 10e6;
const I1: f64 = 1.920;
const I2: f64 = 0.289;

/// Distributed weights, lb/in. The paper does not print them; with these Table I comes back to the
/// printed digits and Table II to one unit of the last.
const W1: f64 = 0.2245;
const W2: f64 = 0.0987;

/// Links that only bend (the paper neglects axial and shear deformation), rigid joints, gravity
/// along −y.
fn robot(links: &[(f64, f64)]) -> Arm {
    // So large that a link does not stretch; the weight per inch is density × area × |gravity|.
    let area = 1e12;
    let joint = |&(inertia, weight): &(f64, f64)| Joint {
        a: LENGTH,
        beam: Some(Beam {
            youngs_modulus: YOUNG,
            shear_modulus: YOUNG,
            area,
            iy: inertia,
            iz: inertia,
            j: inertia,
            density: weight / area,
            shear_coefficient: None,
        }),
        ..Joint::default()
    };
    Arm {
        name: "Lin, Chiang, Cui".to_string(),
        joints: links.iter().map(joint).collect(),
        gravity: Vector3::new(0.0, -1.0, 0.0),
        ..Arm::default()
    }
}

/// Deflection under a load of `p` pounds at the end-effector and the links' weights.
fn deflection(robot: &Arm, degrees: &[f64], p: f64) -> Vector6<f64> {
    let q: vec::Vec<f64> = degrees.iter().map(|angle| angle.to_radians()).collect();
    let load = Vector6::new(0.0, -p, 0.0, 0.0, 0.0, 0.0);
    robot.deflection_with_gravity(&q, &load).unwrap()
}

/// Table I: theta1, YC.
const TABLE_1: [(f64, f64); 5] =
    [(0.0, 0.00122), (20.0, 0.00107), (40.0, 0.00071), (60.0, 0.00030), (80.0, 0.00004)];

/// Table II: theta1, theta2, YC.
const TABLE_2: [(f64, f64, f64); 13] = [
    (0.0, 0.0, 0.01523),
    (0.0, 22.5, 0.01356),
    (0.0, 90.0, 0.00179),
    (22.5, -22.5, 0.01466),
    (22.5, -45.0, 0.01300),
    (22.5, 67.5, 0.00152),
    (45.0, 0.0, 0.00762),
    (45.0, -45.0, 0.01313),
    (45.0, -67.5, 0.01154),
    (67.5, -22.5, 0.00604),
    (67.5, -45.0, 0.00969),
    (90.0, -22.5, 0.00137),
    (90.0, -45.0, 0.00466),
];

/// Table III: theta1, theta2, YC.
const TABLE_3: [(f64, f64, f64); 12] = [
    (0.0, 0.0, 0.0033),
    (0.0, 22.5, 0.0029),
    (22.5, -22.5, 0.0032),
    (22.5, -45.0, 0.0029),
    (45.0, 0.0, 0.0017),
    (45.0, -22.5, 0.0026),
    (45.0, -45.0, 0.0030),
    (45.0, -67.5, 0.0026),
    (67.5, -22.5, 0.0014),
    (67.5, -45.0, 0.0023),
    (90.0, -22.5, 0.0003),
    (90.0, -45.0, 0.0012),
];

/// All cells to the printed five decimals.
#[test]
fn table_1() {
    let robot = robot(&[(I1, W1)]);
    for (theta1, printed) in TABLE_1 {
        let calculated = -deflection(&robot, &[theta1], 3.05).y;
        assert_eq!((calculated * 1e5).round(), (printed * 1e5).round(), "{theta1}");
    }
}

/// All cells to one unit of the last printed digit: no pair of weights gives every cell exactly.
#[test]
fn table_2() {
    let robot = robot(&[(I1, W1), (I2, W2)]);
    for (theta1, theta2, printed) in TABLE_2 {
        let calculated = -deflection(&robot, &[theta1, theta2], 3.05).y;
        assert!((calculated - printed).abs() < 1e-5, "{theta1}, {theta2}: {calculated}");
    }
}

/// All cells to the printed four decimals (without the weights: the gauge was zeroed under them).
#[test]
fn table_3() {
    let robot = robot(&[(I1, 0.0), (I2, 0.0)]);
    for (theta1, theta2, printed) in TABLE_3 {
        let calculated = -deflection(&robot, &[theta1, theta2], 1.02).y;
        assert_eq!((calculated * 1e4).round(), (printed * 1e4).round(), "{theta1}, {theta2}");
    }
}

/// Eq. 32, and eq. 35, which is the rotation of the clamped chain's end.
#[test]
fn equations_32_and_35() {
    let (l, p) = (LENGTH, 3.05);
    let robot = robot(&[(I1, W1), (I2, W2)]);
    for (theta1, theta2, _) in TABLE_2 {
        let (c1, c12) = (theta1.to_radians().cos(), (theta1 + theta2).to_radians().cos());
        let y = -l.powi(3) * c12.powi(2) * (8.0 * p + 3.0 * W2 * l) / (24.0 * YOUNG * I2)
            - (p * l * l.powi(2) * (8.0 * c1 * c1 + 24.0 * c1 * c12 + 24.0 * c12 * c12)
                + W2 * l.powi(4) * (8.0 * c1 * c1 + 18.0 * c1 * c12 + 12.0 * c12 * c12)
                + W1 * l.powi(4) * (3.0 * c1 * c1 + 4.0 * c1 * c12))
                / (24.0 * YOUNG * I1);
        let a = p * l * l * (c12 + c1 / 2.0)
            + W1 * l.powi(3) * c1 / 6.0
            + W2 * l.powi(3) * (c1 + c12) / 2.0;
        let b = p * c12 * l * l / 2.0 + W2 * l.powi(3) * c12 / 6.0;
        let rotation = -a / (YOUNG * I1) - b / (YOUNG * I2);

        let calculated = deflection(&robot, &[theta1, theta2], p);
        // Roundings of the terms, none of which exceeds 0.02 in (and 1e-3 rad).
        assert!((calculated[1] - y).abs() < 1e-16, "{theta1}, {theta2}");
        assert!((calculated[5] - rotation).abs() < 1e-17, "{theta1}, {theta2}");
    }
}

/// Eq. 14 (pose) and eq. 43 (the differential Jacobian, in tool axes).
#[test]
fn equations_14_and_43() {
    let robot = robot(&[(I1, 0.0), (I2, 0.0)]);
    let q: [f64; 2] = [0.4, -1.3];
    let ((s1, c1), (s12, c12), (s2, c2)) =
        (q[0].sin_cos(), (q[0] + q[1]).sin_cos(), q[1].sin_cos());

    let pose = robot.pose(&q).to_homogeneous();
    assert!((pose[(0, 0)] - c12).abs() < 1e-15 && (pose[(1, 0)] - s12).abs() < 1e-15);
    assert!((pose[(0, 3)] - LENGTH * (c1 + c12)).abs() < 1e-14);
    assert!((pose[(1, 3)] - LENGTH * (s1 + s12)).abs() < 1e-14);

    let jacobian = robot.jacobian_tool(&q);
    let first = Vector6::new(LENGTH * s2, LENGTH + LENGTH * c2, 0.0, 0.0, 0.0, 1.0);
    let second = Vector6::new(0.0, LENGTH, 0.0, 0.0, 0.0, 1.0);
    assert!((jacobian.column(0) - first).amax() < 1e-13);
    assert!((jacobian.column(1) - second).amax() < 1e-13);
}
