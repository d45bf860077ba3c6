//! How precise each reading is beside the others, where the file says what its instrument's standard
//! deviation was.

use std::collections::HashMap;

use nalgebra::Vector6;

use crate::constants::{MOST_PRECISE, OWN_PRECISION};
use crate::gap::rms;
use crate::measurement::{Kind, Measurements, Row};

/// Halvings of an interval of variances: each is a binary digit.
const HALVINGS: usize = 60;

/// What each measured number is to be multiplied by to be as uncertain as all others, of both kinds by
/// itself; nothing where the file has no standard deviations.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Precision {
    /// One for each row; none where all are alike.
    rows: Vec<Vector6<f64>>,
    /// The instrument's standard deviation of positions and of rotations, root mean square.
    pub(crate) instrument: [Option<f64>; 2],
}

impl Precision {
    /// By the instrument alone.
    pub(crate) fn of(data: &Measurements) -> Self {
        Self::with(data, [0.0; 2])
    }

    /// By the instrument, and by what each kind scatters beyond it, so that the squares of what is
    /// left (rows that fit, `parameters` fitted to them) are what is to be expected (Paule & Mandel
    /// 1982).
    pub(crate) fn beyond(
        data: &Measurements,
        gaps: &[Vector6<f64>],
        fits: &[bool],
        parameters: usize,
    ) -> Self {
        let kinds = [0..3, 3..6].map(|range| {
            let numbers: Vec<[f64; 2]> = (data.rows.iter().zip(gaps).zip(fits))
                .filter(|(_, fits)| **fits)
                .filter_map(|((row, gap), _)| Some((row, row.sigma.as_deref()?, gap)))
                .flat_map(|(row, sigma, gap)| {
                    let is = row.components(data.kind);
                    let own = range.clone().filter(move |k| is[*k]);
                    own.map(move |k| [sigma[k].powi(2), gap[k].powi(2)])
                })
                .filter(|[variance, _]| *variance > 0.0)
                .collect();
            numbers
        });
        let all = (kinds.iter().map(Vec::len).sum::<usize>()).max(1) as f64;
        let part = 1.0 - (parameters as f64 / all).min(1.0);
        Self::with(data, kinds.map(|numbers| scatter(&numbers, part)))
            .by_instrument(data, gaps, fits)
    }

    /// Of a bench each instrument of each session by itself is as precise as what it leaves says.
    fn by_instrument(self, data: &Measurements, gaps: &[Vector6<f64>], fits: &[bool]) -> Self {
        let Kind::Bench { .. } = data.kind else { return self };
        let of = |row: &Row| (row.session.clone(), row.aim.as_ref().map(|aim| aim.seen));
        let mut instruments: HashMap<_, [f64; 2]> = HashMap::new();
        let mut pooled = [0.0; 2];
        for (number, (row, gap)) in data.rows.iter().zip(gaps).enumerate().filter(|(k, _)| fits[*k])
        {
            let size = gap.component_mul(&self.of_row(number)).norm_squared();
            let count = row.components(data.kind).iter().filter(|is| **is).count() as f64;
            for sums in [instruments.entry(of(row)).or_default(), &mut pooled] {
                *sums = [sums[0] + size, sums[1] + count];
            }
        }
        let mean = |[squares, count]: [f64; 2]| (squares / count.max(1.0)).sqrt();
        if instruments.len() < 2 || mean(pooled) <= 0.0 {
            return self;
        }
        let scale = |row: &Row| match instruments.get(&of(row)) {
            Some(own) if own[1] >= OWN_PRECISION && mean(*own) > 0.0 => {
                (mean(pooled) / mean(*own)).clamp(1.0 / MOST_PRECISE, MOST_PRECISE)
            }
            _ => 1.0,
        };
        let each = data.rows.iter().enumerate().map(|(k, row)| self.of_row(k) * scale(row));
        Self { rows: each.collect(), ..self }
    }

    fn with(data: &Measurements, beyond: [f64; 2]) -> Self {
        let measured = data.kind.components();
        let own = |k: usize| {
            let each = data.rows.iter().filter_map(move |row| Some(row.sigma.as_ref()?[k]));
            each.filter(move |s| *s > 0.0 && measured[k])
        };
        let instrument = [0, 3].map(|first| {
            let all: Vec<f64> = (first..first + 3).flat_map(own).collect();
            (!all.is_empty()).then(|| rms(&all))
        });
        if instrument == [None; 2] {
            return Self::default();
        }
        let whole = [0, 1].map(|kind| instrument[kind].map_or(1.0, |s| s.hypot(beyond[kind])));
        let row = |sigma: Option<&Vector6<f64>>| {
            Vector6::from_fn(|k, _| {
                let own = sigma.map_or(0.0, |sigma| sigma[k]);
                if own > 0.0 { whole[k / 3] / own.hypot(beyond[k / 3]) } else { 1.0 }
            })
        };
        Self { rows: data.rows.iter().map(|r| row(r.sigma.as_deref())).collect(), instrument }
    }

    /// Of one row.
    pub(crate) fn of_row(&self, row: usize) -> Vector6<f64> {
        self.rows.get(row).copied().unwrap_or_else(|| Vector6::repeat(1.0))
    }

    /// Whether the rows are not alike.
    pub(crate) fn differs(&self) -> bool {
        !self.rows.is_empty()
    }

    /// Whether no number's differs by more than this part.
    pub(crate) fn is_near(&self, other: &Self, part: f64) -> bool {
        let both = self.rows.iter().zip(&other.rows);
        self.rows.len() == other.rows.len()
            && both.into_iter().all(|(a, b)| a.zip_map(b, |a, b| (a / b).ln().abs()).max() < part)
    }
}

/// The standard deviation beyond the own variances at which the squares of numbers are, over their
/// variances, this part of their count.
fn scatter(numbers: &[[f64; 2]], part: f64) -> f64 {
    let expected = part * numbers.len() as f64;
    let sum =
        |beyond: f64| numbers.iter().map(|[own, square]| square / (own + beyond)).sum::<f64>();
    let [mut low, mut high] = [0.0, numbers.iter().map(|[_, square]| square).sum::<f64>()];
    if expected <= 0.0 || sum(0.0) <= expected {
        return 0.0;
    }
    // A sum of squares over at least their own sum is no more than 1.
    high /= expected.min(1.0);
    for _ in 0..HALVINGS {
        let middle = (low + high) / 2.0;
        *(if sum(middle) > expected { &mut low } else { &mut high }) = middle;
    }
    high.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{row, table};
    use crate::measurement::{Kind, Row};
    use crate::noisy::normal;
    use crate::rng::{Rng, Stream};

    #[test]
    fn what_scatters_beyond_the_instrument_is_told_from_it() {
        let mut rng = Rng::new(4, Stream::Signs);
        let sigmas = |k: usize| if k.is_multiple_of(3) { 8e-5 } else { 1e-5 };
        let rows = (0..4000).map(|k| {
            let sigma = Vector6::from_fn(|c, _| if c < 3 { sigmas(k) } else { 0.0 });
            Row { sigma: Some(Box::new(sigma)), ..row(&[0.1], Vector6::zeros()) }
        });
        let data = table(rows.collect(), Kind::Pose { orientation: false });
        let gaps: Vec<_> = (0..4000)
            .map(|k| {
                let sd = sigmas(k).hypot(3e-5);
                Vector6::from_fn(|c, _| if c < 3 { sd * normal(&mut rng) } else { 0.0 })
            })
            .collect();
        let precision = Precision::beyond(&data, &gaps, &[true; 4000], 0);
        let ratio = precision.of_row(1)[0] / precision.of_row(0)[0];
        // A variance of 12,000 numbers is known to 1.3 %: some four of these.
        let expected = 8e-5_f64.hypot(3e-5) / 1e-5_f64.hypot(3e-5);
        assert!((ratio / expected - 1.0).abs() < 0.05, "{ratio} {expected}");
        assert_eq!(precision.of_row(0)[3], 1.0);
        let instrument = (8e-5_f64.powi(2) + 2.0 * 1e-5_f64.powi(2)) / 3.0;
        assert!((precision.instrument[0].unwrap() / instrument.sqrt() - 1.0).abs() < 1e-3);
        assert_eq!(precision.instrument[1], None);
        let quiet: Vec<_> = gaps.iter().map(|gap| gap * 0.1).collect();
        let alone = Precision::beyond(&data, &quiet, &[true; 4000], 0);
        assert_eq!(alone, Precision::of(&data));
        assert!(!Precision::of(&table(vec![Row::new(1, vec![0.0])], data.kind)).differs());
    }
}
