//! A campaign as it is: an arm that does not come back to the same place, readings that flutter, an
//! instrument with heavy tails, and now and then a row that is just wrong.

use super::noise::Noise;
use super::observe::Shown;
use super::{Plant, PlantError, only};
use crate::measurement::Measurements;
use crate::rng::{Rng, Stream};

/// An instrument whose errors are Student's t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instrument {
    /// Scales of the distribution, m and rad.
    pub scale: Noise,
    /// Degrees of freedom, at least 1.
    pub freedom: u32,
    /// Part of the rows that are just wrong: a beam that was broken, a reflector touched.
    pub wrong: f64,
    /// Standard deviations of the error that such rows have on top.
    pub wrong_by: Noise,
}

/// What the arm's own drives do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatter {
    /// Standard deviation of each joint from one visit to the next, rad: the arm's repeatability.
    pub visits: f64,
    /// Standard deviation of each joint's reading, rad.
    pub readings: f64,
}

/// What was measured, and what it would have been without instrument and scatter.
#[derive(Clone, Debug, PartialEq)]
pub struct Campaign {
    /// As a file has it.
    pub measured: Measurements,
    /// What the arm with its truths shows at the readings of `measured`: the rest is noise.
    pub exact: Measurements,
}

impl Plant {
    /// Visits every row of a design once. The design's readings are where the controller sends the
    /// arm.
    ///
    /// # Errors
    /// As [`Plant::measure`].
    pub fn campaign(
        &self,
        design: &Measurements,
        instrument: Instrument,
        scatter: Scatter,
        seed: u64,
    ) -> Result<Campaign, PlantError> {
        let mut visits = Rng::new(seed, Stream::Visits);
        let (mut visited, mut read) = (design.clone(), design.clone());
        for (real, told) in visited.rows.iter_mut().zip(&mut read.rows) {
            for (real, told) in real.q.iter_mut().zip(&mut told.q) {
                *real += scatter.visits * visits.normal();
                *told += scatter.readings * visits.normal();
            }
        }
        let exact = self.exact(&read)?;
        let mut measured = self.exact(&visited)?;
        let mut rng = Rng::new(seed, Stream::Noise);
        let components = design.kind.components();
        for (row, told) in measured.rows.iter_mut().zip(&read.rows) {
            row.q.clone_from(&told.q);
            let shown = Shown::of(&row.measured).by_instrument(instrument, &mut rng);
            row.measured = only(shown.vector(), components);
        }
        Ok(Campaign { measured, exact })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector6;

    use super::*;
    use crate::fixture::{rigid, row, table};
    use crate::measurement::Kind;

    fn design() -> Measurements {
        let rows =
            (0..4000).map(|k| row(&[0.1 + 1e-4 * f64::from(k), 0.2, -0.4], Vector6::zeros()));
        table(rows.collect(), Kind::Pose { orientation: true })
    }

    const QUIET: Noise = Noise { position: 0.0, rotation: 0.0 };

    /// Without scatter what is left is the instrument's: its variance is that of Student's t.
    #[test]
    fn the_instrument_is_students() {
        let scale = Noise { position: 30e-6, rotation: 50e-6 };
        let instrument = Instrument { scale, freedom: 8, wrong: 0.0, wrong_by: QUIET };
        let still = Scatter { visits: 0.0, readings: 0.0 };
        let plant = Plant::new(&rigid(), &[]).unwrap();
        let campaign = plant.campaign(&design(), instrument, still, 1).unwrap();
        let off = campaign.measured.rows.iter().zip(&campaign.exact.rows);
        let squares: f64 = off.map(|(m, e)| (m.measured[0] - e.measured[0]).powi(2)).sum();
        // ν/(ν − 2) of the scale's square; its kurtosis is 4.5: four standard errors.
        let expected = 4000.0 * (30e-6_f64).powi(2) * 8.0 / 6.0;
        assert!((squares / expected - 1.0).abs() < 4.0 * (3.5_f64 / 4000.0).sqrt());
    }

    /// Of a rigid arm's first joint alone the tool moves along its circle.
    #[test]
    fn visits_and_readings_scatter_at_the_joints() {
        let instrument = Instrument { scale: QUIET, freedom: 4, wrong: 0.0, wrong_by: QUIET };
        let scatter = Scatter { visits: 2e-5, readings: 1e-5 };
        let plant = Plant::new(&rigid(), &[]).unwrap();
        let design = design();
        let campaign = plant.campaign(&design, instrument, scatter, 2).unwrap();
        let turned = |row: &crate::measurement::Row| row.measured[1].atan2(row.measured[0]);
        let rows = campaign.measured.rows.iter().zip(&campaign.exact.rows).zip(&design.rows);
        let (mut gap, mut readings) = (0.0, 0.0);
        for ((measured, exact), wanted) in rows {
            assert_eq!(measured.q, exact.q);
            gap += (turned(measured) - turned(exact)).powi(2) / 4000.0;
            readings += (measured.q[0] - wanted.q[0]).powi(2) / 4000.0;
        }
        // Four standard errors of a variance of 4000.
        let close = 4.0 * (2.0_f64 / 4000.0).sqrt();
        assert!((gap / 5e-10 - 1.0).abs() < close && (readings / 1e-10 - 1.0).abs() < close);
    }

    #[test]
    fn some_rows_are_just_wrong() {
        let wrong_by = Noise { position: 1e-3, rotation: 1e-3 };
        let instrument = Instrument { scale: QUIET, freedom: 4, wrong: 0.02, wrong_by };
        let still = Scatter { visits: 0.0, readings: 0.0 };
        let plant = Plant::new(&rigid(), &[]).unwrap();
        let campaign = plant.campaign(&design(), instrument, still, 3).unwrap();
        let rows = campaign.measured.rows.iter().zip(&campaign.exact.rows);
        let off = rows.filter(|(m, e)| (m.measured - e.measured).norm() > 1e-6).count() as f64;
        // Four standard deviations of a binomial count.
        assert!((off - 80.0).abs() < 4.0 * (80.0_f64 * 0.98).sqrt(), "{off}");
    }
}
