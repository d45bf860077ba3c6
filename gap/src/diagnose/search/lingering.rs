//! Errors that linger look like what follows time: how long they do decides how much they make of a
//! slow pattern by chance.
//!
//! What is left at visits that follow each other is taken for noise of two parts: one that is forgotten
//! from step to step, and one of which a part stays (a first-order autoregression). Shares and memory are
//! the likeliest beside a mean and the pattern itself, which takes from what lingers as it is fitted
//! (restricted likelihood: Patterson & Thompson 1971; by the Kalman filter: Harvey & Phillips 1979). So many
//! steps as the correlation lasts, summed over all lags, then tell as much as one alone (Bartlett 1946).

use nalgebra::{DMatrix, DVector, Vector6};
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use super::forward::SIGNIFICANT;
use crate::diagnose::data::Problem;

/// Steps of time, at most: of more visits neighbours are one step, so that the cost is bounded.
const MOST_STEPS: usize = 1024;

/// Shares of what lingers that are tried.
const SHARES: [f64; 10] = [0.07, 0.15, 0.3, 0.5, 0.65, 0.8, 0.9, 0.95, 0.98, 1.0];

/// The next memory that is tried is longer by this factor; the longest is twice the campaign's.
const LONGER: f64 = std::f64::consts::SQRT_2;

/// Less of a pattern beside the others is nothing of its own.
const OWN: f64 = 1e-9;

/// Errors of one kind, positions or rotations, and how much chance makes of a slow pattern.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lingering {
    /// Variance of a row in the mean of very many that follow each other.
    variance: f64,
    /// How many independent numbers the rows are worth, beyond the means.
    freedom: f64,
}

/// Of one component what is left, a mean and each pattern, a row each, at every step of time.
type Series = DMatrix<f64>;

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

impl Lingering {
    /// The kind, among the components that are `measured`, whose errors make most of a slow pattern. `told`
    /// is [`by_steps`] what is left beside all that follows time, a mean, and what each such effect does, in
    /// units of the noise. `None` of fewer steps than can tell.
    pub(super) fn worst(measured: &[usize], told: &[Vec<Vector6<f64>>]) -> Option<Self> {
        let series = |component: &usize| {
            Series::from_fn(told.len(), told[0].len(), |what, step| told[what][step][*component])
        };
        let kinds = [0..3, 3..6].map(|kind| {
            let own = measured.iter().filter(|component| kind.contains(*component));
            Self::of(&own.map(series).collect::<Vec<_>>())
        });
        kinds.into_iter().flatten().max_by(|a, b| a.variance.total_cmp(&b.variance))
    }

    fn of(all: &[Series]) -> Option<Self> {
        let first = all.first()?;
        if first.ncols() <= first.nrows() {
            return None;
        }
        let (memory, likely) = likeliest(all);
        let lasts = memory.lasts();
        let freedom = all.len() as f64 * (first.ncols() as f64 / lasts - 1.0);
        Some(Self { variance: likely.variance * lasts, freedom })
    }

    /// The chance that errors that linger so make as large a fall of the squares, where the best of
    /// `tried` patterns of so many numbers was taken (Bonferroni); `variance` is that of a row.
    pub(super) fn chance(&self, fall: f64, rank: usize, variance: f64, tried: usize) -> f64 {
        let (rank, freedom) = (rank as f64, self.freedom - rank as f64);
        if freedom < 1.0 {
            return 1.0;
        }
        let ratio = fall / rank / self.variance.max(variance);
        let chance = FisherSnedecor::new(rank, freedom).map_or(1.0, |f| f.sf(ratio));
        if chance.is_nan() { 1.0 } else { (chance * tried as f64).min(1.0) }
    }
}

impl Memory {
    /// None: every step is forgotten in the next.
    const NONE: Self = Self { share: 0.0, stays: 0.0 };

    /// The correlation summed over all lags, on both sides: in steps, 1 where nothing lingers.
    fn lasts(self) -> f64 {
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
                if own > OWN * whole[k] {
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

/// What is told of each row at steps of time. A step of many rows counts as many, in units of one row's noise.
pub(super) fn by_steps(
    problem: &Problem<'_>,
    of_rows: impl Iterator<Item = Vector6<f64>>,
) -> Vec<Vector6<f64>> {
    let visits = problem.visits.count();
    let count = visits.min(MOST_STEPS);
    let mut sums = vec![(Vector6::zeros(), 0.0); count];
    for (row, it) in of_rows.enumerate().filter(|(row, _)| problem.fits[*row]) {
        let (sum, rows) = &mut sums[problem.visits.of_row[row] * count / visits];
        *sum += it;
        *rows += 1.0;
    }
    let there = sums.into_iter().filter(|(_, rows)| *rows > 0.0);
    there.map(|(sum, rows): (Vector6<f64>, f64)| sum / rows.sqrt()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::data::{Stream, generator};
    use crate::diagnose::tests::normal;

    /// Steps of a campaign, and the jumps that are tried in it.
    const STEPS: usize = 180;
    const JUMPS: usize = 24;

    /// Errors of three components, a third of them of the instrument: they linger over `memory` steps, and
    /// the first jumps after two fifths of the steps.
    fn campaign(seed: u64, memory: f64, jump: f64) -> [Vec<f64>; 3] {
        let mut dice = generator(seed, Stream::Signs);
        let stays = if memory > 0.0 { (-1.0 / memory).exp() } else { 0.0 };
        std::array::from_fn(|component| {
            let mut error = normal(&mut dice);
            let step = |k: usize| {
                error = stays * error + (1.0 - stays * stays).sqrt() * normal(&mut dice);
                let off = if component == 0 && k >= 2 * STEPS / 5 { jump } else { 0.0 };
                error + off + normal(&mut dice) / 3.0
            };
            (0..STEPS).map(step).collect()
        })
    }

    /// What the best jump explains of the errors, and what errors that linger as they do make of one.
    fn best(errors: &[Vec<f64>; 3]) -> (f64, f64, Lingering) {
        let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
        let size = |errors: &Vec<f64>, at: usize| mean(&errors[at..]) - mean(&errors[..at]);
        let fall = |at: usize| {
            let pairs = (at * (STEPS - at)) as f64 / STEPS as f64;
            errors.iter().map(|errors| pairs * size(errors, at).powi(2)).sum::<f64>()
        };
        let jumps = (1..=JUMPS).map(|k| k * STEPS / (JUMPS + 1));
        let at = jumps.max_by(|a, b| fall(*a).total_cmp(&fall(*b))).unwrap();
        let part = (STEPS - at) as f64 / STEPS as f64;
        let of = |errors: &Vec<f64>| {
            let (size, whole) = (size(errors, at), mean(errors));
            Series::from_fn(3, STEPS, |what, k| {
                let pattern = if k < at { 0.0 } else { size };
                [errors[k] - whole - pattern + size * part, 1.0, pattern][what]
            })
        };
        let series: Vec<Series> = errors.iter().map(of).collect();
        let squares: f64 = series.iter().map(|series| series.row(0).norm_squared()).sum();
        (fall(at), squares / (3 * STEPS - 6) as f64, Lingering::of(&series).unwrap())
    }

    fn is_claimed(seed: u64, memory: f64, jump: f64) -> bool {
        let (fall, variance, errors) = best(&campaign(seed, memory, jump));
        errors.chance(fall, 3, variance, JUMPS) <= SIGNIFICANT
    }

    #[test]
    fn a_jump_is_claimed_of_one_campaign_in_twenty_however_long_errors_linger() {
        for memory in [0.0, 2.0, 8.0, 33.0, 100.0] {
            let alarms = (0..100).filter(|seed| is_claimed(*seed, memory, 0.0)).count();
            // More of a hundred where five are allowed come once in 1500 times.
            assert!(alarms <= 12, "{alarms} of 100 at {memory}");
        }
    }

    #[test]
    fn a_jump_beyond_the_errors_is_found() {
        for (memory, jump) in [(0.0, 1.0), (2.0, 3.0), (8.0, 10.0)] {
            let found = (0..40).filter(|seed| is_claimed(*seed, memory, jump)).count();
            assert!(found >= 36, "{found} of 40: {jump} at {memory}");
        }
    }

    /// Errors that linger over a third of the campaign have jumped as far as that before.
    #[test]
    fn of_few_that_are_independent_nothing_is_claimed() {
        let found = (0..20).filter(|seed| is_claimed(*seed, 60.0, 2.0)).count();
        assert!(found <= 4, "{found} of 20");
    }

    /// As long as it is: what was fitted has not taken it away.
    #[test]
    fn memory_is_told_beside_what_was_fitted() {
        for (memory, low, high) in [(0.0, 0.5, 1.5), (8.0, 8.0, 25.0), (33.0, 25.0, 120.0)] {
            let mut all: Vec<f64> = (0..21)
                .map(|seed| {
                    let (_, variance, errors) = best(&campaign(seed, memory, 0.0));
                    errors.variance / variance
                })
                .collect();
            all.sort_by(f64::total_cmp);
            assert!((low..high).contains(&all[10]), "{} at {memory}", all[10]);
        }
    }
}
