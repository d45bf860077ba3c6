//! Ways of writing a table.

use stiffarm::kernels::{Arm, Convention, Error, Kernels, Motion, Numeric, Output, Scalar, has};
use stiffarm::robot;

robot! {
    /// Everything that a table can say.
    pub mod full;
    name: "Full";
    convention: modified_dh;
    gravity: [0, 0, -9.80665 m/s^2];
    tool: translation [0, 0, 100 mm] rotation [0, 0, pi/2];
    marker: smr1 [0, 100 mm, 20 mm];
    marker: smr2;
    joint | source       | theta       | d          | a      | alpha  | stiffness     | mass | com           | limits           | beam
    a1    | "data sheet" | q           | 0          | 0      | 0      | 3.8e6 N*m/rad | -    | -             | [-pi, 180 deg]   | -
    a2    | -            | q - 90 deg  | 0          | 350 mm | -pi/2  | 3.8e6 Nm      | 12   | [0.1, 0, 2 cm] | -               | { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section: tube(0.2, 0.18), density: 2700 }
    3     | -            | 0.3 rad     | 0.2 + q    | 0      | 3*pi/4 | 2e7 N/m       | -    | -             | [0, 400 mm]      | -
    wrist | -            | 30 deg + q  | -          | 24 in  | 0      | rigid         | 2 lb | [0, 0, 0]     | -                | -
}

robot! {
    /// A row over several lines, and columns in another order.
    mod broken_lines;
    convention: standard_dh;
    joint | a | theta
    a1    | 1
          | q
    a2    | 2 |
            q
    a3    | 3 | q
}

robot! {
    /// Lengths that stay symbolic.
    mod symbolic;
    convention: standard_dh;
    joint | theta | a
    a1    | q     | L1
    a2    | q     | L2
}

robot! { pub mod one_line; convention: standard_dh; joint | theta | a a1 | q | 1 a2 | q | 0.5 }

robot! {
    /// Only what is asked for.
    mod lean;
    convention: standard_dh;
    outputs: jacobian;
    joint | theta | d | a
    a1    | q     | 0 | 1
    a2    | 0     | q | 0
}

robot! {
    /// From a file beside Cargo.toml.
    pub(super) mod filed from "files/good.toml";
}

#[test]
fn a_full_table_is_read() {
    assert_eq!((full::NAME, full::N), ("Full", 4));
    assert_eq!(full::DH.map(|row| row.joint), ["a1", "a2", "3", "wrist"]);
    assert_eq!(full::DH[2].motion, Motion::Prismatic);
    assert_eq!((full::DH[2].d, full::DH[3].stiffness), ("0.2", "rigid"));
    assert_eq!((full::DH[1].theta, full::DH[3].a), ("-pi/2", "0.6096"));
}

#[test]
fn lines_may_be_broken_and_joined() {
    assert_eq!(broken_lines::DH.map(|row| row.a), ["1", "2", "3"]);
    assert_eq!(one_line::DH.map(|row| row.a), ["1", "0.5"]);
}

#[test]
fn parameters_are_given_when_the_program_runs() {
    let constants = symbolic::Constants::new(&symbolic::Parameters { L1: 0.3, L2: 0.2 });
    assert_eq!(symbolic::pose(&constants, &[0.0, 0.0]).position, [0.5, 0.0, 0.0]);
    let robot = symbolic::Robot { constants };
    assert_eq!(Kernels::<f64>::dof(&robot), 2);
}

#[test]
fn a_file_gives_what_its_table_would() {
    assert_eq!((filed::NAME, filed::N), ("good", 2));
    let [x, y, z] = filed::pose(&[0.0_f64, 0.0]).position;
    assert!((x - 0.55).abs() < 1e-12 && y == 0.0 && z == 0.0);
}

/// What an arm as a value says of its table, and that it computes what its functions do.
#[test]
fn an_arm_is_a_value() {
    fn reach<S: Scalar, const N: usize, A: has::Pose<N, S>>(arm: &A, q: &[S; N]) -> S {
        arm.pose(&arm.posture(q)).position[0]
    }
    assert_eq!(reach(&filed::Robot, &[0.1, 0.2]), filed::pose(&[0.1, 0.2]).position[0]);
    assert_eq!(reach(&filed::Robot, &[0.1_f32, 0.2]), filed::pose(&[0.1_f32, 0.2]).position[0]);
    let constants = symbolic::Constants::new(&symbolic::Parameters { L1: 0.3, L2: 0.2 });
    let robot = symbolic::Robot { constants };
    assert_eq!(reach(&robot, &[0.1, 0.2]), symbolic::pose(&constants, &[0.1, 0.2]).position[0]);

    assert_eq!(<full::Robot as Numeric<4>>::CONVENTION, Convention::Modified);
    let [_, second, third, wrist] = <full::Robot as Numeric<4>>::ROWS;
    assert_eq!((second.theta, second.a), (-core::f64::consts::FRAC_PI_2, 0.35));
    assert_eq!((second.stiffness, second.mass, second.com), (Some(3.8e6), 12.0, [0.1, 0.0, 0.02]));
    assert_eq!((third.d, wrist.stiffness), (0.2, None));
    let limits = <full::Robot as Arm<4>>::LIMITS;
    assert_eq!((limits[1], limits[2]), (None, Some([0.0, 0.4])));
}

#[test]
fn what_is_not_asked_for_is_absent() {
    let (q, mut out) = ([0.3, 0.5], [0.0; 12]);
    let evaluate = |output, out: &mut [f64]| lean::Robot.evaluate(output, &q, &[0.0; 6], out);
    assert_eq!(evaluate(Output::Jacobian, &mut out), Ok(()));
    assert_eq!(out.as_slice(), lean::jacobian(&q).as_flattened());
    assert_eq!(evaluate(Output::Pose, &mut out), Err(Error::Absent));
}
