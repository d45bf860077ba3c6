//! Balls in sockets: the arm goes where the bench holds it, and the controller reads the joints there.

use nalgebra::{DMatrix, Vector3};

use super::{Plant, PlantError};
use crate::measurement::Measurements;
use crate::observe::Seen;

/// Step of the joints by which a derivative is taken, rad or m.
const STEP: f64 = 1e-6;

/// Rounds at most; ordinary postures need four.
const ROUNDS: usize = 60;

/// A ball this near its place lies in it, m: far below any play, far above the rounding of derivatives.
const SEATED: f64 = 1e-9;

/// No joint moves by more in a round, rad or m: of a posture in which the arm is stretched a step of Newton's is
/// anything.
const LARGEST: f64 = 0.05;

impl Plant {
    /// Measurements of points in places with the joints moved, by as little as can be, until the reading of the
    /// point from its place is 0: what such a file has no column for. The play that was drawn as noise stays in
    /// the joints. Rows of other instruments stay as they are.
    ///
    /// # Errors
    /// As [`Plant::measure`], and [`PlantError::Unseated`].
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
        let mut now = first;
        for round in 0.. {
            let off: Vec<_> = now.iter().zip(&noise).map(|(exact, noise)| exact + noise).collect();
            let Some(astray) = off.iter().position(|off| off.norm() > SEATED) else { break };
            if round == ROUNDS {
                let (file, line) = (measured.file.clone(), measured.rows[held[astray]].line);
                return Err(PlantError::Unseated { file, line });
            }
            let mut slopes = vec![DMatrix::zeros(3, joints); held.len()];
            for joint in 0..joints {
                let mut moved = seated.clone();
                held.iter().for_each(|row| moved.rows[*row].q[joint] += STEP);
                for ((slope, then), now) in slopes.iter_mut().zip(read(&moved)?).zip(&now) {
                    slope.set_column(joint, &((then - now) / STEP));
                }
            }
            for ((row, slope), off) in held.iter().zip(&slopes).zip(&off) {
                // Levenberg and Marquardt: s/(s² + d²) is 1/(2d) at most, and nothing as the ball comes home.
                let damping = off.norm_squared() / (2.0 * LARGEST).powi(2);
                let squares = slope * slope.transpose() + DMatrix::identity(3, 3) * damping;
                let Some(across) = squares.cholesky() else { continue };
                let back = slope.tr_mul(&across.solve(&-off));
                let q = &mut seated.rows[*row].q;
                q.iter_mut().zip(back.iter()).for_each(|(q, back)| *q += back);
            }
            now = read(&seated)?;
        }
        held.iter().for_each(|row| seated.rows[*row].measured.fill(0.0));
        Ok(seated)
    }
}
