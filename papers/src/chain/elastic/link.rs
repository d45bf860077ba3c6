//! One link as a cantilever: the displacement of its tip under the wrench there.

use nalgebra::{Matrix6, RowVector6, Vector3, Vector6};
use stiffarm_kernels::generic::Arm;

use super::{Axes, Elasticity};
use crate::chain::displacement::left_jacobian;
use crate::chain::product::single_row;
use crate::chain::transport::{lower, stack, twist_matrix, upper};
use crate::chain::{ChainError, Displacement};

/// Newton's steps to the fixed point of [`Axes::Undeformed`].
const MOST_STEPS: usize = 50;

/// A step below this part of the displacement changes nothing more.
const CONVERGED: f64 = 1e-15;

/// The beam of one row at one joint value.
#[derive(Clone, Debug)]
pub(super) struct Link {
    /// Row of the table, from 1.
    row: usize,
    /// Twist of the tip per wrench on it, in the axes of the row's frame, at its origin: `C_i = X
    /// C_beam Xᵀ`.
    flexibility: Matrix6<f64>,
    /// Along the link to its tip, unit, same axes: `(a, d sin α, d cos α)/L` in a standard row.
    chord: Vector3<f64>,
    /// m.
    pub(super) length: f64,
}

impl Link {
    /// `None` where the row has no beam or no length. `index` counts from 0.
    pub(super) fn new(arm: &Arm, index: usize, q: f64) -> Option<Self> {
        arm.joints[index].beam.as_ref()?;
        let single = single_row(arm, index);
        let frame = single.pose(&[q]);
        let chord = frame.rotation.inverse() * frame.translation.vector;
        let length = chord.norm();
        if length == 0.0 {
            return None;
        }
        let mut turned = frame.inverse();
        turned.translation.vector = Vector3::zeros();
        let turn = twist_matrix(&turned);
        let flexibility = turn * single.compliance(&[q]) * turn.transpose();
        Some(Link { row: index + 1, flexibility, chord: chord / length, length })
    }

    /// The tip's displacement under the wrench `w`, and its derivative, in one set of axes.
    fn bend(&self, w: &Vector6<f64>, foreshortening: bool) -> (Vector6<f64>, Matrix6<f64>) {
        let (mut bend, mut rate) = (self.flexibility * w, self.flexibility);
        if foreshortening {
            let (shorter, change) = self.foreshortening(w);
            bend -= stack(&(self.chord * shorter), &Vector3::zeros());
            let mut translations = rate.fixed_view_mut::<3, 6>(0, 0);
            translations -= self.chord * change;
        }
        (bend, rate)
    }

    /// Half the integral of the squared slope, m, and its derivative.
    ///
    /// At the distance s from the root the tip's wrench makes the slope
    /// `H (m s + e × f (L s − s²/2))`, H being the bending flexibility per length and e the chord.
    /// In a plane that is `(f_y (L s − s²/2) + m s)/EJ`, and half the integral of its square
    /// `(2/15 f_y² L⁵ + 5/12 f_y m L⁴ + m² L³/3)/2EJ²`.
    fn foreshortening(&self, w: &Vector6<f64>) -> (f64, RowVector6<f64>) {
        let l = self.length;
        let across = nalgebra::Matrix3::identity() - self.chord * self.chord.transpose();
        let turns = self.flexibility.fixed_view::<3, 3>(3, 3);
        let bending = across * turns * across / l;
        let by_moment = bending;
        let by_force = bending * self.chord.cross_matrix();
        let (m, f) = (by_moment * lower(w), by_force * upper(w));
        let (ff, fm, mm) = (2.0 / 15.0 * l.powi(5), 5.0 / 12.0 * l.powi(4), l.powi(3) / 3.0);
        let shorter = (ff * f.dot(&f) + fm * f.dot(&m) + mm * m.dot(&m)) / 2.0;
        let per_f = (f * (2.0 * ff) + m * fm).transpose() * by_force / 2.0;
        let per_m = (m * (2.0 * mm) + f * fm).transpose() * by_moment / 2.0;
        (shorter, RowVector6::new(per_f[0], per_f[1], per_f[2], per_m[0], per_m[1], per_m[2]))
    }

    /// The displacement under the wrench `w` in the displaced frame, and its derivative by `w`
    /// (6×6, of the six numbers).
    pub(super) fn displaced(
        &self,
        w: &Vector6<f64>,
        elasticity: Elasticity,
    ) -> Result<(Displacement, Matrix6<f64>), ChainError> {
        let (bend, rate) = match elasticity.axes {
            Axes::Deformed => self.bend(w, elasticity.foreshortening),
            Axes::Undeformed => self.undeformed(w, elasticity.foreshortening)?,
        };
        if bend.iter().all(|value| value.is_finite()) {
            Ok((Displacement::new(&bend), rate))
        } else {
            Err(ChainError::Link { row: self.row })
        }
    }

    /// The fixed point `x = bend(R(x) w)`: the wrench has the axes of the undisplaced tip.
    fn undeformed(
        &self,
        w: &Vector6<f64>,
        foreshortening: bool,
    ) -> Result<(Vector6<f64>, Matrix6<f64>), ChainError> {
        let failed = ChainError::Link { row: self.row };
        let (mut x, _) = self.bend(w, foreshortening);
        let mut last = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let at = Displacement::new(&x);
            let rotation = at.transform().rotation;
            let turned = stack(&(rotation * upper(w)), &(rotation * lower(w)));
            let (bend, rate) = self.bend(&turned, foreshortening);
            let turn = left_jacobian(&at.rotation);
            let mut spin = Matrix6::zeros();
            let (force, moment) = (upper(&turned).cross_matrix(), lower(&turned).cross_matrix());
            spin.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-force * turn));
            spin.fixed_view_mut::<3, 3>(3, 3).copy_from(&(-moment * turn));
            let yielding =
                (Matrix6::identity() - rate * spin).try_inverse().ok_or(failed.clone())?;
            let step = yielding * (bend - x);
            let size = step.amax();
            if size <= CONVERGED * x.amax() || (size < 1e-9 * x.amax() && size >= last) {
                let mut still = Displacement::new(&x).transform();
                still.translation.vector = Vector3::zeros();
                return Ok((x + step, yielding * rate * twist_matrix(&still)));
            }
            if !size.is_finite() {
                break;
            }
            (x, last) = (x + step, size);
        }
        Err(failed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::bent;
    use stiffarm_kernels::generic::Convention;

    /// `(a, d sin α, d cos α)/L` in a standard row, and the flexibility of eq. 5 (corrected) in its
    /// plane.
    #[test]
    fn the_chord_and_the_flexibility_along_it() {
        let mut arm = bent();
        arm.convention = Convention::Standard;
        (arm.joints[1].a, arm.joints[1].d, arm.joints[1].alpha) = (0.3, 0.4, 0.7);
        let link = Link::new(&arm, 1, 0.9).unwrap();
        let expected = Vector3::new(0.3, 0.4 * 0.7f64.sin(), 0.4 * 0.7f64.cos()) / 0.5;
        assert!((link.chord - expected).amax() < 1e-15);
        assert!((link.length - 0.5).abs() < 1e-15);
        let beam = arm.joints[1].beam.as_ref().unwrap();
        let (e, g, l) = (beam.youngs_modulus, beam.shear_modulus, link.length);
        let along = stack(&link.chord, &Vector3::zeros());
        let about = stack(&Vector3::zeros(), &link.chord);
        let quadratic = |v: Vector6<f64>| v.dot(&(link.flexibility * v));
        assert!((quadratic(along) / (l / (e * beam.area)) - 1.0).abs() < 1e-12);
        assert!((quadratic(about) / (l / (g * beam.j)) - 1.0).abs() < 1e-12);
        let y = link.chord.cross(&Vector3::x()).normalize();
        let across = stack(&y, &Vector3::zeros());
        assert!((quadratic(across) / (l.powi(3) / (3.0 * e * beam.iy)) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn foreshortening_in_a_plane() {
        let mut arm = bent();
        (arm.joints[1].d, arm.joints[1].alpha) = (0.0, 0.0);
        let link = Link::new(&arm, 1, 0.0).unwrap();
        let beam = arm.joints[1].beam.as_ref().unwrap();
        let (ej, l) = (beam.youngs_modulus * beam.iz, link.length);
        let (fy, m) = (700.0, -300.0);
        let w = Vector6::new(50.0, fy, 0.0, 20.0, 0.0, m);
        let (found, rate) = link.foreshortening(&w);
        let sum = 2.0 / 15.0 * fy * fy * l.powi(5)
            + 5.0 / 12.0 * fy * m * l.powi(4)
            + m * m * l.powi(3) / 3.0;
        assert!((found / (sum / (2.0 * ej * ej)) - 1.0).abs() < 1e-12);
        // Quadratic, so its derivative along w is twice itself.
        assert!(((rate * w)[0] / (2.0 * found) - 1.0).abs() < 1e-12);
    }

    /// In undeformed axes the displacement is that of the wrench turned back by it.
    #[test]
    fn the_undeformed_link_is_a_fixed_point() {
        let arm = bent();
        let link = Link::new(&arm, 1, 0.4).unwrap();
        let elasticity = Elasticity { axes: Axes::Undeformed, foreshortening: true };
        let w = Vector6::new(2e4, -1e4, 3e4, 1e3, -2e3, 4e3);
        let (found, _) = link.displaced(&w, elasticity).unwrap();
        let turn = found.transform().rotation;
        let turned = stack(&(turn * upper(&w)), &(turn * lower(&w)));
        let (again, _) = link.bend(&turned, true);
        assert!(found.rotation.norm() > 0.01);
        assert!((again - found.vector()).amax() < 1e-15);
    }
}
