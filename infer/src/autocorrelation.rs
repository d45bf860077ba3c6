//! How long errors last, and what autocorrelated errors make of a slow pattern by chance.
//!
//! Residuals at steps that follow each other are the sum of white noise and a first-order
//! autoregression. Its share and its correlation time are estimated by restricted maximum likelihood beside a
//! mean and the pattern itself, which takes from them as it is fitted (Patterson & Thompson 1971; by the
//! Kalman filter: Harvey & Phillips 1979). Generalised least squares (Aitken 1936) then give the F test of
//! the pattern.

use nalgebra::{DMatrix, DVector, Vector6};
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use super::constants::SIGNIFICANT;
use super::limits::{CORRELATION_TIMES, LEAST_OWN};

/// Shares of what lingers that are tried.
const SHARES: [f64; 10] = [0.07, 0.15, 0.3, 0.5, 0.65, 0.8, 0.9, 0.95, 0.98, 1.0];

/// The next memory that is tried is longer by this factor; the longest is twice the campaign's.
const LONGER: f64 = std::f64::consts::SQRT_2;

/// By how much the squares fall with a pattern, beside autocorrelated errors.
#[derive(Clone, Copy, Debug, Default)]
pub struct Autoregression {
    /// In units of the variance of a step.
    fall: f64,
    /// Numbers beyond those that were fitted.
    freedom: f64,
    /// Components in which the pattern shows.
    components: usize,
    /// Steps that errors linger, 1 where they do not: their correlation, summed over all lags. The longer of positions'
    /// and rotations'.
    pub memory: f64,
}

/// Of one component what is left, a mean, the pattern that is asked for and each other, a row each, at every step of
/// time.
type Series = DMatrix<f64>;

/// The row of the pattern that is asked for.
const ASKED: usize = 2;

/// How errors forget.
#[derive(Clone, Copy, Debug)]
struct Memory {
    /// The part of their variance that lingers.
    share: f64,
    /// What of that is still there a step later.
    stays: f64,
}

/// Of a memory: −2 × the logarithm of its restricted likelihood, and the variance of a step.
#[derive(Clone, Copy, Debug)]
struct Likely {
    unlikely: f64,
    variance: f64,
}

impl Autoregression {
    /// Of the components that are `measured`, positions and rotations each with a memory of their own. `told`
    /// are at each step the residual beside all that follows time, a mean, and what each such effect does, that
    /// which is asked for first, in units of the noise; `variance` is that of a row. `None` of too few steps.
    pub fn of(measured: &[usize], told: &[Vec<Vector6<f64>>], variance: f64) -> Option<Self> {
        let series = |component: &usize| {
            Series::from_fn(told.len(), told[0].len(), |what, step| told[what][step][*component])
        };
        let kinds = [0..3, 3..6].map(|kind| {
            let own = measured.iter().filter(|component| kind.contains(*component));
            Self::of_kind(&own.map(series).collect::<Vec<_>>(), variance)
        });
        let both = |a: Self, b: Self| Self {
            fall: a.fall + b.fall,
            freedom: a.freedom + b.freedom,
            components: a.components + b.components,
            memory: a.memory.max(b.memory),
        };
        kinds.into_iter().flatten().reduce(both)
    }

    fn of_kind(all: &[Series], variance: f64) -> Option<Self> {
        let first = all.first()?;
        if first.ncols() <= first.nrows() {
            return None;
        }
        let (memory, likely) = likeliest(all);
        let fitted = (first.nrows() - 1) as f64;
        let falls: Vec<f64> = all.iter().filter_map(|series| memory.fall(series)).collect();
        Some(Self {
            fall: falls.iter().sum::<f64>() / likely.variance.max(variance),
            freedom: all.len() as f64 * (first.ncols() as f64 - fitted),
            components: falls.len(),
            memory: memory.steps(),
        })
    }

    /// The chance of a fall as large, where the best of `tried` patterns of so many numbers was taken (Bonferroni).
    pub fn p_value(&self, rank: usize, tried: usize) -> f64 {
        // A number less than components is one of them all; more are the shape of the pattern.
        let rank = rank.max(self.components) as f64;
        let p_value = FisherSnedecor::new(rank, self.freedom).map(|f| f.sf(self.fall / rank));
        let p_value = p_value.unwrap_or(1.0);
        if p_value.is_nan() { 1.0 } else { (p_value * tried as f64).min(1.0) }
    }
}

impl Memory {
    /// None: every step is forgotten in the next.
    const NONE: Self = Self { share: 0.0, stays: 0.0 };

    /// The correlation, summed over all lags.
    fn steps(self) -> f64 {
        1.0 + 2.0 * self.share * self.stays / (1.0 - self.stays)
    }

    /// The products of the rows of a series, told so that its steps are independent and of one variance;
    /// and the logarithm of the determinant of that change.
    fn independent(self, series: &Series) -> (DMatrix<f64>, f64) {
        let Self { share, stays } = self;
        let rows = series.nrows();
        let (mut products, mut logarithm) = (DMatrix::zeros(rows, rows), 0.0);
        let (mut expected, mut doubt) = (DVector::zeros(rows), share);
        for now in series.column_iter() {
            let variance = doubt + 1.0 - share;
            let gain = doubt / variance;
            let new = now - &expected;
            products.ger(1.0 / variance, &new, &new, 1.0);
            logarithm += variance.ln();
            expected.axpy(stays * gain, &new, stays);
            doubt = stays * stays * doubt * (1.0 - gain) + share * (1.0 - stays * stays);
        }
        (products, logarithm)
    }

    /// By how much the squares fall with the pattern that is asked for, beside the mean and the others; `None` where it
    /// is nothing of its own.
    fn fall(self, series: &Series) -> Option<f64> {
        let (mut p, _) = self.independent(series);
        let whole = p.diagonal();
        for k in (1..series.nrows()).filter(|k| *k != ASKED) {
            if p[(k, k)] > LEAST_OWN * whole[k] {
                let (own, column) = (p[(k, k)], p.column(k).into_owned());
                p.ger(-1.0 / own, &column, &column, 1.0);
            }
        }
        // What is left has lost the pattern as it was fitted.
        let own = p[(ASKED, ASKED)];
        (own > LEAST_OWN * whole[ASKED]).then(|| (p[(0, ASKED)] + own).powi(2) / own)
    }

    fn likely(self, all: &[Series]) -> Likely {
        let (mut squares, mut freedom, mut unlikely) = (0.0, 0.0, 0.0);
        for series in all {
            let (mut p, logarithm) = self.independent(series);
            let whole = p.diagonal();
            unlikely += logarithm;
            freedom += series.ncols() as f64;
            // The mean and each pattern take their part.
            for k in 1..series.nrows() {
                let own = p[(k, k)];
                if own > LEAST_OWN * whole[k] {
                    let column = p.column(k).into_owned();
                    p.ger(-1.0 / own, &column, &column, 1.0);
                    unlikely += own.ln();
                    freedom -= 1.0;
                }
            }
            squares += p[(0, 0)];
        }
        let variance = (squares / freedom).max(f64::MIN_POSITIVE);
        Likely { unlikely: unlikely + freedom * variance.ln(), variance }
    }
}

/// The likeliest memory of those that are tried; none unless it is likelier than by chance.
fn likeliest(all: &[Series]) -> (Memory, Likely) {
    let none = (Memory::NONE, Memory::NONE.likely(all));
    let steps = all[0].ncols() as f64;
    let memories = std::iter::successors(Some(0.5), |time| Some(time * LONGER))
        .take_while(|time| *time <= 2.0 * steps)
        .flat_map(|time: f64| SHARES.map(|share| Memory { share, stays: (-1.0 / time).exp() }));
    let tried = memories.map(|memory| (memory, memory.likely(all)));
    let best = tried.min_by(|a, b| a.1.unlikely.total_cmp(&b.1.unlikely));
    // Two numbers more: twice the logarithm of the ratio is chi-squared (Wilks 1938).
    let enough = ChiSquared::new(2.0).map_or(f64::INFINITY, |d| d.inverse_cdf(1.0 - SIGNIFICANT));
    best.filter(|(_, it)| it.unlikely + enough < none.1.unlikely).unwrap_or(none)
}

/// The correlation time, s, of samples every `step`: half the integral of the correlation over all lags, up
/// to where the sum no longer matters (Sokal 1997). Parts are independent; what does not count is a hole.
pub fn correlation_time(parts: &[Vec<Option<f64>>], step: f64) -> f64 {
    let all = || parts.iter().flatten().filter_map(|x| *x);
    let mean = all().sum::<f64>() / all().count().max(1) as f64;
    let at = |lag: usize| {
        let pairs = parts.iter().flat_map(|part| part.iter().zip(part.iter().skip(lag)));
        let both = pairs.filter_map(|(a, b)| Some((*a)? - mean).zip(Some((*b)? - mean)));
        let (sum, count) = both.fold((0.0, 0.0), |(sum, n), (a, b)| (sum + a * b, n + 1.0));
        if count > 0.0 { sum / count } else { 0.0 }
    };
    let whole = at(0);
    let longest = parts.iter().map(Vec::len).max().unwrap_or(0);
    let mut time = 0.5;
    if whole > 0.0 {
        for lag in 1..longest / 2 {
            time += at(lag) / whole;
            if lag as f64 >= CORRELATION_TIMES * time {
                break;
            }
        }
    }
    time.max(0.5) * step
}
