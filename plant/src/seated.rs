//! Balls in sockets: the arm goes where the bench holds it, and the controller reads the joints there.

use nalgebra::{DMatrix, Vector3};

use super::{Plant, PlantError};
use crate::instrument::Seen;
use crate::measurement::Measurements;

/// Step of the joints by which a derivative is taken, rad or m.
const STEP: f64 = 1e-6;

/// Rounds at most; ordinary postures need three.
const ROUNDS: usize = 60;

/// A ball this near its place lies in it, m, and joints that move by less have settled: far below any play, far
/// above the rounding of derivatives.
const SEATED: f64 = 1e-9;

/// Damping at first, m²/rad²: it is felt where a joint's turn moves the ball by less than a millimetre per radian.
const DAMPING: f64 = 1e-6;

impl Plant {
    /// Measurements of points in places with the joints moved, by as little as can be, until the reading of the
    /// point from its place is 0: what such a file has no column for. The play that was drawn as noise stays in
    /// the joints, as far as they can follow it. Rows of other instruments stay as they are.
    ///
    /// # Errors
    /// As [`Plant::measure`], and [`PlantError::Unseated`] where the socket is farther off than its play.
    pub fn seated(&self, measured: &Measurements) -> Result<Measurements, PlantError> {
        let is_held = |row: usize| {
            measured.rows[row].aim.as_deref().is_some_and(|aim| aim.seen == Seen::Point)
        };
        let held: Vec<usize> = (0..measured.rows.len()).filter(|row| is_held(*row)).collect();
        let Some(joints) = held.first().map(|row| measured.rows[*row].q.len()) else {
            return Ok(measured.clone());
        };
        let read = |data: &Measurements| -> Result<Vec<Vector3<f64>>, PlantError> {
            let exact = self.exact(data)?;
            let three = |row: &usize| exact.rows[*row].measured.fixed_rows::<3>(0).into_owned();
            Ok(held.iter().map(three).collect())
        };
        let mut seated = measured.clone();
        let first = read(&seated)?;
        let noise = held
            .iter()
            .zip(&first)
            .map(|(row, exact)| measured.rows[*row].measured.fixed_rows::<3>(0) - exact);
        let noise: Vec<Vector3<f64>> = noise.collect();
        let off = |now: &[Vector3<f64>]| -> Vec<Vector3<f64>> {
            now.iter().zip(&noise).map(|(exact, noise)| exact + noise).collect()
        };
        let (mut now, mut damping) = (first, vec![DAMPING; held.len()]);
        for _ in 0..ROUNDS {
            let left = off(&now);
            if left.iter().all(|left| left.norm() <= SEATED) {
                break;
            }
            let mut slopes = vec![DMatrix::zeros(3, joints); held.len()];
            for joint in 0..joints {
                let mut moved = seated.clone();
                held.iter().for_each(|row| moved.rows[*row].q[joint] += STEP);
                for ((slope, then), now) in slopes.iter_mut().zip(read(&moved)?).zip(&now) {
                    slope.set_column(joint, &((then - now) / STEP));
                }
            }
            // A step of Levenberg and Marquardt: where the arm is stretched one of Newton's is anything.
            let mut tried = seated.clone();
            let mut farthest = 0.0_f64;
            for (k, row) in held.iter().enumerate().filter(|(k, _)| left[*k].norm() > SEATED) {
                let squares = &slopes[k] * slopes[k].transpose();
                let damped = squares + DMatrix::identity(3, 3) * damping[k];
                let Some(across) = damped.cholesky() else { continue };
                let back = slopes[k].tr_mul(&across.solve(&-left[k]));
                farthest = farthest.max(back.norm());
                tried.rows[*row].q.iter_mut().zip(back.iter()).for_each(|(q, back)| *q += back);
            }
            if farthest <= SEATED {
                break;
            }
            let then = read(&tried)?;
            for (k, (row, after)) in held.iter().zip(off(&then)).enumerate() {
                if after.norm() < left[k].norm() {
                    seated.rows[*row].q.clone_from(&tried.rows[*row].q);
                    now[k] = then[k];
                    damping[k] /= 10.0;
                } else {
                    damping[k] *= 10.0;
                }
            }
        }
        let is_astray =
            |(left, play): (Vector3<f64>, &Vector3<f64>)| left.norm() > play.norm() + SEATED;
        if let Some(astray) = off(&now).into_iter().zip(&noise).position(is_astray) {
            let (file, line) = (measured.file.clone(), measured.rows[held[astray]].line);
            return Err(PlantError::Unseated { file, line });
        }
        held.iter().for_each(|row| seated.rows[*row].measured.fill(0.0));
        Ok(seated)
    }
}
