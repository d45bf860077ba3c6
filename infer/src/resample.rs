//! How far statistics scatter from one campaign or log to another: independent units are drawn again.

use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::rng::{Rng, Stream};

/// Student's t of so many degrees of freedom, at least 1, that is exceeded with probability 1 − `p`.
pub fn students_t(freedom: f64, p: f64) -> f64 {
    StudentsT::new(0.0, 1.0, freedom.max(1.0)).map_or(f64::INFINITY, |t| t.inverse_cdf(p))
}

/// The chance that Student's t of so many degrees of freedom is as far from 0.
pub fn two_sided(freedom: f64, t: f64) -> f64 {
    StudentsT::new(0.0, 1.0, freedom.max(1.0)).map_or(1.0, |d| (2.0 * d.sf(t.abs())).min(1.0))
}

/// 95 % interval of a shrink whose logarithm of what is left scatters by `spread` over data
/// that are drawn again from so many poses or blocks. What is drawn again scatters less than what it was drawn
/// from: the limits stand off by Student's deviate, and by the ratio of the variances.
pub fn interval(shrink: f64, spread: f64, count: usize) -> [f64; 2] {
    let freedom = count.saturating_sub(1).max(1) as f64;
    let off = students_t(freedom, 0.975) * spread * (1.0 + 1.0 / freedom).sqrt();
    [off, -off].map(|off| 1.0 - (1.0 - shrink) * off.exp())
}

/// Pairs of data sets: a standard deviation of so many is known to 3 %.
const DRAWS: usize = 500;

/// How often each of so many independent units stands in data sets that are drawn from them: pairs, one to
/// fit and one on which the gap is measured.
pub fn drawn(count: usize, seed: u64) -> Vec<[Vec<f64>; 2]> {
    let mut rng = Rng::new(seed, Stream::Bootstrap);
    let mut one = || {
        let mut times = vec![0.0; count];
        (0..count).for_each(|_| times[rng.index(count)] += 1.0);
        times
    };
    (0..DRAWS).map(|_| [one(), one()]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_shrink_is_certain() {
        assert_eq!(interval(0.5, 0.0, 3), [0.5, 0.5]);
        // Student's t of 9 degrees of freedom.
        let [low, high] = interval(0.5, 0.1, 10);
        let off = 2.262_157 * 0.1 * (10.0_f64 / 9.0).sqrt();
        assert!((low - (1.0 - 0.5 * off.exp())).abs() < 1e-6, "{low}");
        assert!((high - (1.0 - 0.5 / off.exp())).abs() < 1e-6, "{high}");
    }
}
