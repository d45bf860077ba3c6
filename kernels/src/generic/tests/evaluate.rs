//! The layout of `evaluate`.

use nalgebra::{UnitQuaternion, Vector3};

use super::support::{cases, state};
use crate::generic::Arm;
use crate::{Input, Output, Part};

#[test]
fn every_output_has_its_shape() {
    for (arm, q, w) in cases() {
        for output in Output::EACH {
            let (rows, columns) = output.shape(arm.dof());
            let block = arm.evaluate(output, &state(output, &q), &w.into()).unwrap();
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

/// The same arm with another value of one part of its file.
fn changed(arm: &Arm, part: Part) -> Arm {
    let mut arm = arm.clone();
    match part {
        Part::Tool => {
            arm.tool.translation.vector += Vector3::new(0.1, -0.2, 0.3);
            arm.tool_rotation_vector *= 0.5;
            arm.tool.rotation = UnitQuaternion::from_scaled_axis(arm.tool_rotation_vector);
        }
        Part::Stiffness => arm.joints.iter_mut().for_each(|joint| joint.compliance *= 2.0),
        Part::Beams => arm.joints.iter_mut().filter_map(|j| j.beam.as_mut()).for_each(|beam| {
            beam.youngs_modulus *= 2.0;
            beam.shear_modulus *= 2.0;
        }),
        Part::Weights => arm.gravity *= 2.0,
        Part::Inertias => arm.joints.iter_mut().for_each(|joint| joint.inertia *= 2.0),
    }
    arm
}

/// What the table says of inputs and parts is what the definitions read.
#[test]
fn an_output_depends_on_what_its_description_says() {
    let parts = [Part::Tool, Part::Stiffness, Part::Beams, Part::Weights, Part::Inertias];
    for output in Output::EACH {
        let (mut by_part, mut by_wrench) = ([false; 5], false);
        for (arm, q, w) in cases() {
            let q = state(output, &q);
            let found = arm.evaluate(output, &q, &w.into());
            for (part, moved) in parts.into_iter().zip(&mut by_part) {
                *moved |= changed(&arm, part).evaluate(output, &q, &w.into()) != found;
            }
            by_wrench |= arm.evaluate(output, &q, &(w * 2.0).into()) != found;
        }
        assert_eq!(by_part, parts.map(|part| output.depends_on(part)), "{output:?}");
        assert_eq!(by_wrench, output.takes(Input::Wrench), "{output:?}");
    }
}

#[test]
fn every_part_of_a_row_has_a_unit() {
    for output in Output::EACH {
        assert_eq!(output.units().len(), output.rows().parts().len(), "{output:?}");
    }
}

#[test]
#[should_panic(expected = "as many joint values as the arm has joints")]
fn a_posture_of_the_wrong_length_is_refused() {
    let (arm, q, _) = cases().next().unwrap();
    arm.pose(&q[1..]);
}
