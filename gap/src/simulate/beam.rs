//! A link of the robot file as a beam: what a load at its tip and its own weight do to the tip.
//!
//! Uniform section, clamped at the previous frame's origin (Lin et al. 1991, eqs. 18-21). The axes
//! are those of [`Beam`]: x along the chord, z the part of the previous z perpendicular to it.

use nalgebra::{Isometry3, Matrix3, Rotation3, Vector3, Vector6};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Beam, Convention, Joint};

/// Below this sine of the angle between chord and axis the two count as parallel.
const PARALLEL: f64 = 1e-9;

/// The beam of one row, in the frame of the row.
#[derive(Clone, Debug, PartialEq)]
pub struct Link<'a> {
    beam: &'a Beam,
    /// Beam axes in the frame of the row.
    axes: Rotation3<f64>,
    /// Length of the chord, m.
    length: f64,
    weightless: bool,
}

/// The chord of a row in the row's own frame: from the previous frame's origin to its own, m.
pub fn chord(row: &Isometry3<f64>) -> Vector3<f64> {
    row.rotation.inverse() * row.translation.vector
}

impl<'a> Link<'a> {
    /// The beam of a row whose transform is `row`; `None` where there is none or nothing to bend.
    pub fn new(joint: &'a Joint, convention: Convention, row: &Isometry3<f64>) -> Option<Self> {
        let beam = joint.beam.as_ref()?;
        let chord = chord(row);
        let length = chord.norm();
        if length == 0.0 {
            return None;
        }
        let along = chord / length;
        let previous = row.rotation.inverse();
        let z = previous * Vector3::z();
        let x = match convention {
            Convention::Standard => Rotation3::new(-joint.beta * Vector3::y()) * Vector3::x(),
            Convention::Modified => previous * Vector3::x(),
        };
        let across = z - along * along.dot(&z);
        let third = if across.norm() > PARALLEL { across } else { along.cross(&x) }.normalize();
        let columns = Matrix3::from_columns(&[along, third.cross(&along), third]);
        let weightless = joint.motion == Motion::Prismatic || beam.density == 0.0;
        let axes = Rotation3::from_matrix_unchecked(columns);
        Some(Self { beam, axes, length, weightless })
    }

    /// Its weight, N, in the axes in which gravity is given; acts at the middle of the chord.
    pub fn weight(&self, gravity: &Vector3<f64>) -> Vector3<f64> {
        if self.weightless {
            return Vector3::zeros();
        }
        gravity * (self.beam.density * self.beam.area * self.length)
    }

    /// The middle of the chord seen from the row's frame, m.
    pub fn middle(&self) -> Vector3<f64> {
        self.axes * Vector3::x() * (-self.length / 2.0)
    }

    /// Displacement of the tip in the row's axes under a wrench there and the beam's own weight
    /// `own` (N, the row's axes, spread along it).
    pub fn give(&self, wrench: &Vector6<f64>, own: &Vector3<f64>) -> Vector6<f64> {
        let f = self.axes.inverse() * wrench.fixed_rows::<3>(0);
        let m = self.axes.inverse() * wrench.fixed_rows::<3>(3);
        let own = self.axes.inverse() * own;
        let (b, l) = (self.beam, self.length);
        let (e, g) = (b.youngs_modulus, b.shear_modulus);
        let shear = b.shear_coefficient.map_or(0.0, |kappa| 1.0 / (kappa * g * b.area));
        // Force, moment and spread weight in one bending plane; `sign` is that of the slope.
        let bend = |f: f64, m: f64, own: f64, i: f64| {
            let ei = e * i;
            let shift = (f / 3.0 + own / 8.0) * l.powi(3) / ei
                + m * l * l / (2.0 * ei)
                + (f + own / 2.0) * l * shear;
            let turn = (f / 2.0 + own / 6.0) * l * l / ei + m * l / ei;
            (shift, turn)
        };
        let (y, about_z) = bend(f.y, m.z, own.y, b.iz);
        let (z, minus_about_y) = bend(f.z, -m.y, own.z, b.iy);
        let x = (f.x + own.x / 2.0) * l / (e * b.area);
        let translation = self.axes * Vector3::new(x, y, z);
        let rotation = self.axes * Vector3::new(m.x * l / (g * b.j), -minus_about_y, about_z);
        let (t, r) = (translation, rotation);
        Vector6::new(t.x, t.y, t.z, r.x, r.y, r.z)
    }
}
