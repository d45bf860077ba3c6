//! What stands behind one row of the table: the joint's spring and the link.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3, Vector6};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention};

use super::Elasticity;
use super::link::Link;
use crate::chain::displacement;
use crate::chain::transport::{lower, stack, turning, twist_matrix, upper, wrench_matrix};
use crate::chain::{ChainError, Response};

/// One row at one joint value. All in the axes of the nominal frame behind the row, at its origin.
#[derive(Clone, Debug)]
pub(super) struct Row {
    convention: Convention,
    motion: Motion,
    elasticity: Elasticity,
    /// k_c, rad/(N·m) or m/N.
    compliance: f64,
    /// Twist of the row's frame per unit of the joint's motion: its axis as the frame sees it.
    axis: Vector6<f64>,
    /// The row's rotation and translation, `A(q)`.
    step: Isometry3<f64>,
    link: Option<Link>,
    /// The link at joint values a little lower and higher, and their distance: of a prismatic
    /// joint, whose link follows it.
    beside: Option<(Link, Link, f64)>,
}

/// A motion of `value` about or along z.
fn along_z(motion: Motion, value: f64) -> Isometry3<f64> {
    match motion {
        Motion::Revolute => Isometry3::from_parts(
            Translation3::identity(),
            UnitQuaternion::from_axis_angle(&Vector3::z_axis(), value),
        ),
        Motion::Prismatic => Isometry3::translation(0.0, 0.0, value),
    }
}

/// The twist of a unit motion about or along z.
fn unit_z(motion: Motion) -> Vector6<f64> {
    match motion {
        Motion::Revolute => stack(&Vector3::zeros(), &Vector3::z()),
        Motion::Prismatic => stack(&Vector3::z(), &Vector3::zeros()),
    }
}

impl Row {
    /// `index` counts from 0; `step` is `A(q)`.
    pub(super) fn new(
        arm: &Arm,
        index: usize,
        q: f64,
        step: &Isometry3<f64>,
        elasticity: Elasticity,
    ) -> Self {
        let joint = &arm.joints[index];
        let axis = match arm.convention {
            Convention::Standard => twist_matrix(&step.inverse()) * unit_z(joint.motion),
            Convention::Modified => unit_z(joint.motion),
        };
        let link = Link::new(arm, index, q);
        let beside = match (&link, joint.motion) {
            (Some(link), Motion::Prismatic) => {
                let h = 1e-5 * link.length;
                Link::new(arm, index, q - h)
                    .zip(Link::new(arm, index, q + h))
                    .map(|(a, b)| (a, b, 2.0 * h))
            }
            _ => None,
        };
        Row {
            convention: arm.convention,
            motion: joint.motion,
            elasticity,
            compliance: joint.compliance,
            axis,
            step: *step,
            link,
            beside,
        }
    }

    /// Its joint's motion per unit of motion: twist of the nominal frame.
    pub(super) fn axis(&self) -> Vector6<f64> {
        self.axis
    }

    /// The spring's displacement at the joint load `tau` (N·m, or N), `A(q)⁻¹ A(q + k_c τ)`.
    fn spring(&self, tau: f64) -> Isometry3<f64> {
        let moved = along_z(self.motion, self.compliance * tau);
        match self.convention {
            Convention::Standard => self.step.inverse() * moved * self.step,
            Convention::Modified => moved,
        }
    }

    /// The link's displacement under a wrench at its displaced tip, and its twist per unit of it.
    fn bend(&self, w: &Vector6<f64>) -> Result<Response, ChainError> {
        let Some(link) = &self.link else { return Ok(Response::fixed(Isometry3::identity())) };
        let (displacement, rate) = link.displaced(w, self.elasticity)?;
        Ok(Response {
            error: displacement.transform(),
            rate: displacement::rate(&displacement) * rate,
        })
    }

    /// What loads the joint, N·m or N, under the wrench `w` in the displaced frame, positive like
    /// its motion.
    pub(super) fn joint_load(&self, w: &Vector6<f64>) -> Result<f64, ChainError> {
        Ok(match self.convention {
            Convention::Standard => self.axis.dot(&(wrench_matrix(&self.bend(w)?.error) * w)),
            Convention::Modified => self.axis.dot(w),
        })
    }

    /// The row's error under the wrench `w` in the displaced frame.
    ///
    /// Standard: `E = S(k_c τ) D(w)`, τ the load that the bent link hands to the joint; it does not
    /// depend on how far the joint itself turns. Modified: `E = D(K(S) w) S(k_c τ)`.
    pub(super) fn respond(&self, w: &Vector6<f64>) -> Result<Response, ChainError> {
        let give = self.axis * self.compliance;
        match self.convention {
            Convention::Standard => {
                let link = self.bend(w)?;
                let k = wrench_matrix(&link.error);
                let behind = k * w;
                let load_rate = self.axis.transpose() * (k + turning(&behind) * link.rate);
                let spring = self.spring(self.axis.dot(&behind));
                Ok(Response {
                    error: spring * link.error,
                    rate: give * load_rate + twist_matrix(&spring) * link.rate,
                })
            }
            Convention::Modified => {
                let spring = self.spring(self.axis.dot(w));
                let k = wrench_matrix(&spring);
                let behind = k * w;
                let turned = give * self.axis.transpose();
                let link = self.bend(&behind)?;
                Ok(Response {
                    error: link.error * spring,
                    rate: link.rate * (k + turning(&behind) * turned)
                        + twist_matrix(&link.error) * turned,
                })
            }
        }
    }

    /// Twist of the displaced frame, in the nominal frame, per unit of the joint's motion while the
    /// wrench `w` in the displaced frame stays the same: the joint's axis, and what the link's
    /// displacement changes where the link does not simply move along.
    pub(super) fn joint_rate(&self, w: &Vector6<f64>) -> Result<Vector6<f64>, ChainError> {
        match self.convention {
            Convention::Standard => {
                let link = self.link_rate(w)?;
                let error = self.bend(w)?.error;
                let behind = wrench_matrix(&error) * w;
                let load = self.axis.dot(&(turning(&behind) * link));
                let spring = self.spring(self.axis.dot(&behind));
                let give = self.axis * (self.compliance * load);
                Ok(self.axis + give + twist_matrix(&spring) * link)
            }
            Convention::Modified => {
                let spring = self.spring(self.axis.dot(w));
                Ok(self.axis + self.link_rate(&(wrench_matrix(&spring) * w))?)
            }
        }
    }

    /// Twist of the link's displacement, seen from the nominal frame, per unit of the joint's
    /// motion under one wrench in that frame's axes.
    fn link_rate(&self, w: &Vector6<f64>) -> Result<Vector6<f64>, ChainError> {
        let Some(link) = &self.link else { return Ok(Vector6::zeros()) };
        let (displacement, rate) = link.displaced(w, self.elasticity)?;
        let x = displacement.vector();
        let change = match (&self.beside, self.convention) {
            (Some((low, high, distance)), _) => {
                let at = |link: &Link| link.displaced(w, self.elasticity).map(|(x, _)| x.vector());
                (at(high)? - at(low)?) / *distance
            }
            (None, Convention::Standard) => Vector6::zeros(),
            // The frame turns beyond the link, whose displacement stays where it is.
            (None, Convention::Modified) => {
                let spin = |v: &Vector6<f64>| {
                    stack(&Vector3::z().cross(&upper(v)), &Vector3::z().cross(&lower(v)))
                };
                rate * spin(w) - spin(&x)
            }
        };
        Ok(displacement::rate(&displacement) * change)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chain::steps;
    use crate::fixture::springy;

    fn row(arm: &Arm, q: [f64; 3]) -> Row {
        let steps = steps(arm, &q).unwrap();
        Row::new(arm, 0, q[0], &steps[1], Elasticity::default())
    }

    /// K_joint of a standard row: the turn D is about `(0, sin α, cos α)`, and the origin moves by
    /// `(−a (1 − cos D), a sin D cos α, −a sin D sin α)`. The printed vector is this for α = 0.
    #[test]
    fn the_spring_of_a_standard_row() {
        let mut arm = springy();
        (arm.joints[0].a, arm.joints[0].alpha) = (0.8, 0.6);
        let row = row(&arm, [0.3, 0.0, 0.0]);
        let load = 1e5;
        let turn = arm.joints[0].compliance * load;
        let found = row.spring(load);
        let axis = Vector3::new(0.0, 0.6f64.sin(), 0.6f64.cos());
        assert!((found.rotation.scaled_axis() - axis * turn).amax() < 1e-14);
        let (s, c) = turn.sin_cos();
        let expected = Vector3::new(-0.8 * (1.0 - c), 0.8 * s * axis.z, -0.8 * s * axis.y);
        assert!((found.translation.vector - expected).amax() < 1e-14);
        assert!((lower(&row.axis()) - axis).amax() < 1e-15);
    }

    /// τ does not depend on how far the joint has turned already.
    #[test]
    fn the_joint_load_is_the_same_at_all_joint_values() {
        let arm = springy();
        let w = Vector6::new(100.0, -50.0, 30.0, 7.0, 8.0, -9.0);
        let at = |q| row(&arm, [q, 0.0, 0.0]).joint_load(&w).unwrap();
        assert!((at(0.2) - at(-2.7)).abs() < 1e-12);
    }
}
