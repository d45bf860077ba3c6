//! Displacements up the chain: the forward product of nominal transforms and errors (Jweeg &
//! Al-Khafaji, eq. 20).

use nalgebra::{Isometry3, Matrix4, Matrix6, Vector6};
use stiffarm_kernels::generic::Arm;

use super::transport::{along, stack, twist_matrix};
use super::{ChainError, Displacement};

/// How many errors a chain has: one at the base, one behind each row of the table, one at the tool.
pub fn places(arm: &Arm) -> usize {
    arm.dof() + 2
}

/// One row of an arm's table as an arm of one rigid, weightless joint, its link kept.
pub(super) fn single_row(arm: &Arm, index: usize) -> Arm {
    let mut joint = arm.joints[index].clone();
    (joint.compliance, joint.mass) = (0.0, 0.0);
    Arm {
        name: String::new(),
        convention: arm.convention,
        joints: vec![joint],
        base: Isometry3::identity(),
        tool: Isometry3::identity(),
        tool_rotation_vector: nalgebra::Vector3::zeros(),
        gravity: nalgebra::Vector3::zeros(),
    }
}

/// The nominal transform before each place, m: the identity before the base's, `A_i(q_i)` before
/// place i, the tool's transform before the last.
///
/// # Errors
/// [`ChainError::JointValues`], [`ChainError::NotFinite`].
pub fn steps(arm: &Arm, q: &[f64]) -> Result<Vec<Isometry3<f64>>, ChainError> {
    if q.len() != arm.dof() {
        return Err(ChainError::JointValues { expected: arm.dof(), found: q.len() });
    }
    if !q.iter().all(|value| value.is_finite()) {
        return Err(ChainError::NotFinite { what: "a joint value" });
    }
    let mut steps = vec![Isometry3::identity()];
    for (index, &value) in q.iter().enumerate() {
        steps.push(single_row(arm, index).pose(&[value]));
    }
    steps.push(arm.tool);
    Ok(steps)
}

/// For each place the matrix (6×6) that takes a small displacement there to the twist of the tool
/// in base axes at the tool origin, on the undisplaced arm.
///
/// # Errors
/// As [`steps`].
pub fn carry(arm: &Arm, q: &[f64]) -> Result<Vec<Matrix6<f64>>, ChainError> {
    let steps = steps(arm, q)?;
    let tool = along(steps.iter().copied());
    let mut frame = Isometry3::identity();
    let at_tool = |step: &Isometry3<f64>| {
        frame *= step;
        let mut seen = frame;
        seen.translation.vector -= tool.translation.vector;
        twist_matrix(&seen)
    };
    Ok(steps.iter().map(at_tool).collect())
}

/// An arm with a displacement at every place.
#[derive(Clone, Copy, Debug)]
pub struct Chain<'a> {
    arm: &'a Arm,
    errors: &'a [Displacement],
}

impl<'a> Chain<'a> {
    /// The arm with `errors` at its [`places`], from the base to the tool.
    ///
    /// # Errors
    /// [`ChainError::Places`] if there are more or fewer errors than places.
    pub fn new(arm: &'a Arm, errors: &'a [Displacement]) -> Result<Self, ChainError> {
        if errors.len() == places(arm) {
            Ok(Self { arm, errors })
        } else {
            Err(ChainError::Places { expected: places(arm), found: errors.len() })
        }
    }

    /// The displaced frames, one behind each place, in the base frame, m. The last is the tool's.
    ///
    /// # Errors
    /// As [`steps`].
    pub fn frames(&self, q: &[f64]) -> Result<Vec<Isometry3<f64>>, ChainError> {
        let mut frame = Isometry3::identity();
        let behind = |(step, error): (&Isometry3<f64>, &Displacement)| {
            frame = frame * step * error.transform();
            frame
        };
        Ok(steps(self.arm, q)?.iter().zip(self.errors).map(behind).collect())
    }

    /// The displaced tool frame in the base frame, m: eq. 20, exact.
    ///
    /// # Errors
    /// As [`steps`].
    pub fn pose(&self, q: &[f64]) -> Result<Isometry3<f64>, ChainError> {
        let steps = steps(self.arm, q)?;
        Ok(along(steps.iter().zip(self.errors).map(|(step, error)| step * error.transform())))
    }

    /// Eq. 20 with any other form of the errors: [`rpy::matrix`](crate::jweeg::rpy::matrix) for eq. 18,
    /// [`rpy::first_order`](crate::jweeg::rpy::first_order) for eq. 19.
    ///
    /// # Errors
    /// As [`steps`].
    pub fn product(
        &self,
        q: &[f64],
        form: impl Fn(&Displacement) -> Matrix4<f64>,
    ) -> Result<Matrix4<f64>, ChainError> {
        let steps = steps(self.arm, q)?;
        let factors = steps.iter().zip(self.errors);
        Ok(factors.map(|(step, error)| step.to_homogeneous() * form(error)).product())
    }

    /// Where the errors take the tool from its nominal pose, exactly: translation and rotation
    /// vector in base axes, at the tool origin, m and rad.
    ///
    /// # Errors
    /// As [`steps`].
    pub fn displacement(&self, q: &[f64]) -> Result<Vector6<f64>, ChainError> {
        let nominal = along(steps(self.arm, q)?);
        Ok(between(&nominal, &self.pose(q)?))
    }

    /// The same to the strict first order in the errors: the sum over the places of [`carry`].
    ///
    /// # Errors
    /// As [`steps`].
    pub fn displacement_first_order(&self, q: &[f64]) -> Result<Vector6<f64>, ChainError> {
        let carried = carry(self.arm, q)?;
        Ok(carried.iter().zip(self.errors).map(|(carry, error)| carry * error.vector()).sum())
    }
}

/// From one pose to another: translation and rotation vector in base axes.
pub(super) fn between(from: &Isometry3<f64>, to: &Isometry3<f64>) -> Vector6<f64> {
    let shift = to.translation.vector - from.translation.vector;
    stack(&shift, &(to.rotation * from.rotation.inverse()).scaled_axis())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::bent;
    use crate::jweeg::rpy;

    fn errors(scale: f64) -> Vec<Displacement> {
        let entry = |k: usize| scale * ((7 * k % 11) as f64 - 5.0) / 5.0;
        (0..5).map(|i| Displacement::new(&Vector6::from_fn(|k, _| entry(6 * i + k)))).collect()
    }

    const Q: [f64; 3] = [0.4, -0.9, 1.3];

    #[test]
    fn without_errors_it_is_the_forward_kinematics() {
        let arm = bent();
        let none = [Displacement::ZERO; 5];
        let chain = Chain::new(&arm, &none).unwrap();
        let pose = arm.pose(&Q).to_homogeneous();
        assert!((chain.pose(&Q).unwrap().to_homogeneous() - pose).amax() < 1e-15);
        assert!((chain.product(&Q, rpy::matrix).unwrap() - pose).amax() < 1e-15);
        let frames = chain.frames(&Q).unwrap();
        for (ours, theirs) in frames[..4].iter().zip(arm.frames(&Q)) {
            assert!((ours.to_homogeneous() - theirs.to_homogeneous()).amax() < 1e-15);
        }
    }

    #[test]
    fn the_first_order_is_the_limit_of_small_errors() {
        let arm = bent();
        let gap = |scale: f64| {
            let errors = errors(scale);
            let chain = Chain::new(&arm, &errors).unwrap();
            let exact = chain.displacement(&Q).unwrap();
            (exact - chain.displacement_first_order(&Q).unwrap()).norm()
        };
        // Quadratic: a tenth of the errors, a hundredth of the gap.
        assert!((gap(1e-3) / gap(1e-4) - 100.0).abs() < 1.0);
    }

    #[test]
    fn the_product_of_eq_19_is_first_order_too() {
        let arm = bent();
        let gap = |scale: f64| {
            let errors = errors(scale);
            let chain = Chain::new(&arm, &errors).unwrap();
            let exact = chain.product(&Q, rpy::matrix).unwrap();
            (exact - chain.product(&Q, rpy::first_order).unwrap()).norm()
        };
        assert!((gap(1e-3) / gap(1e-4) - 100.0).abs() < 1.0);
    }

    #[test]
    fn wrong_lengths_are_told() {
        let arm = bent();
        let four = [Displacement::ZERO; 4];
        let error = Chain::new(&arm, &four).unwrap_err();
        assert_eq!(error, ChainError::Places { expected: 5, found: 4 });
        let found = steps(&arm, &[0.0]).unwrap_err().to_string();
        assert!(found.starts_with("found 1 joint values, expected 3"), "{found}");
        assert!(matches!(steps(&arm, &[0.0, f64::NAN, 0.0]), Err(ChainError::NotFinite { .. })));
    }
}
