//! The layout of `evaluate`.

use super::support::cases;
use crate::Output;

#[test]
fn every_output_has_its_shape() {
    for (arm, q, w) in cases() {
        for output in Output::EACH {
            let (rows, columns) = output.shape(arm.dof());
            let block = arm.evaluate(output, &q, &w.into()).unwrap();
            assert_eq!(block.len(), rows * columns, "{output:?}");
        }
    }
}

#[test]
fn blocks_stand_column_by_column() {
    let (arm, q, w) = cases().find(|(arm, ..)| arm.dof() == 4).unwrap();
    let of = |output| arm.evaluate(output, &q, &w.into()).unwrap();

    let pose = arm.pose(&q).to_homogeneous();
    for (k, entry) in of(Output::Pose).into_iter().enumerate() {
        assert_eq!(entry, pose[(k % 3, k / 3)]);
    }
    let second = arm.frames(&q)[2].to_homogeneous();
    for (k, entry) in of(Output::Frames)[12..24].iter().enumerate() {
        assert_eq!(*entry, second[(k % 3, k / 3)]);
    }
    let stiffness = arm.complementary_stiffness(&q, &w);
    for (k, entry) in of(Output::ComplementaryStiffness).into_iter().enumerate() {
        assert_eq!(entry, stiffness[(k % 4, k / 4)]);
    }
    let parameters = arm.parameter_jacobian(&q);
    for (k, entry) in of(Output::ParameterJacobian).into_iter().enumerate() {
        assert_eq!(entry, parameters[(k % 6, k / 6)]);
    }
}

#[test]
#[should_panic(expected = "as many joint values as the arm has joints")]
fn a_posture_of_the_wrong_length_is_refused() {
    let (arm, q, _) = cases().next().unwrap();
    arm.pose(&q[1..]);
}
