//! Random numbers that depend on a seed and what they are for, and on nothing else.
//!
//! The generator is ChaCha8. Uniform numbers are those of `rand`; normal ones are Box and Muller's
//! and not the ziggurat of `rand_distr`, whose numbers differ: a seed gives the same bytes in every
//! version of this library.

use core::f64::consts::TAU;

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng as _, SeedableRng};
use nalgebra::Vector3;

/// What a stream of random numbers is for; one does not depend on how much another draws.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the names say what is drawn")]
pub enum Stream {
    /// Where a search starts.
    Starts = 0,
    Folds = 1,
    Signs = 2,
    Bootstrap = 3,
    Halves = 4,
    Noise = 101,
    Poses = 102,
    Loads = 103,
    Approach = 104,
    Climate = 105,
    Frames = 106,
    Truths = 107,
    Arm = 108,
    Visits = 109,
}

/// A seed for the `k`-th of many things that one seed decides (SplitMix64's finaliser).
pub fn seed_of(seed: u64, k: usize) -> u64 {
    let mut x = seed ^ (k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// A random number generator.
pub struct Rng(ChaCha8Rng);

impl Rng {
    /// Of one seed and one purpose.
    pub fn new(seed: u64, stream: Stream) -> Rng {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        generator.set_stream(stream as u64);
        Rng(generator)
    }

    /// Uniform from 0, included, to 1, excluded: 53 random bits.
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform from `low` to `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform within an interval.
    pub fn within(&mut self, [low, high]: [f64; 2]) -> f64 {
        self.between(low, high)
    }

    /// One point of a box.
    pub fn point(&mut self, bounds: &[[f64; 2]]) -> Vec<f64> {
        bounds.iter().map(|range| self.within(*range)).collect()
    }

    /// 0 to `n` − 1, `n` far below 2⁵³.
    pub fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n.saturating_sub(1))
    }

    /// 0 to `n` − 1 by 32 random bits, `n` below 2³² (the bias is below n/2³²): what folds and
    /// bootstraps draw by the thousand.
    pub fn index(&mut self, n: usize) -> usize {
        ((u64::from(self.0.next_u32()) * n as u64) >> 32) as usize
    }

    /// −1 or 1.
    pub fn sign(&mut self) -> f64 {
        if self.unit() < 0.5 { -1.0 } else { 1.0 }
    }

    /// −1 or 1, by one of 32 random bits.
    pub fn flip(&mut self) -> f64 {
        if self.0.next_u32() & 1 == 1 { -1.0 } else { 1.0 }
    }

    /// Of mean 0 and variance 1 (Box and Muller, one of the two).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        radius * (TAU * self.unit()).cos()
    }

    /// Student's t with so many degrees of freedom, at least 1: heavy tails.
    pub fn student(&mut self, freedom: u32) -> f64 {
        let freedom = freedom.max(1);
        let squares: f64 = (0..freedom).map(|_| self.normal().powi(2)).sum();
        self.normal() / (squares / f64::from(freedom)).sqrt()
    }

    /// Three independent normal numbers.
    pub fn normal3(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.normal())
    }

    /// A direction, uniform over the sphere.
    pub fn direction(&mut self) -> Vector3<f64> {
        let vector = self.normal3();
        let length = vector.norm();
        if length > 1e-3 { vector / length } else { self.direction() }
    }

    /// Puts a list into random order.
    pub fn shuffle<T>(&mut self, list: &mut [T]) {
        for last in (1..list.len()).rev() {
            list.swap(last, self.below(last + 1));
        }
    }

    /// 0 to `n` − 1 in random order, by [`Rng::index`].
    pub fn order(&mut self, n: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..n).collect();
        for last in (1..n).rev() {
            order.swap(last, self.index(last + 1));
        }
        order
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_numbers_are_normal() {
        let mut rng = Rng::new(1, Stream::Noise);
        let draws: Vec<f64> = (0..40_000).map(|_| rng.normal()).collect();
        let moment = |k: i32| draws.iter().map(|x| x.powi(k)).sum::<f64>() / draws.len() as f64;
        // Four standard errors: 1/√n, √(2/n), √(96/n).
        assert!(moment(1).abs() < 0.02 && (moment(2) - 1.0).abs() < 0.03);
        assert!((moment(4) - 3.0).abs() < 0.2, "{}", moment(4));
    }

    #[test]
    fn student_numbers_have_heavy_tails() {
        let mut rng = Rng::new(2, Stream::Noise);
        let beyond = |from: f64, rng: &mut Rng| {
            (0..40_000).filter(|_| rng.student(4).abs() > from).count() as f64 / 40_000.0
        };
        // Two-sided 5 % and 1 % points of four degrees of freedom; four standard errors.
        assert!((beyond(2.776, &mut rng) - 0.05).abs() < 0.0044);
        assert!((beyond(4.604, &mut rng) - 0.01).abs() < 0.002);
    }

    #[test]
    fn seed_and_purpose_decide() {
        let draw = |seed, stream| Rng::new(seed, stream).unit().to_bits();
        assert_eq!(draw(3, Stream::Poses), draw(3, Stream::Poses));
        assert_ne!(draw(3, Stream::Poses), draw(4, Stream::Poses));
        assert_ne!(draw(3, Stream::Poses), draw(3, Stream::Loads));
    }

    #[test]
    fn an_order_has_every_number() {
        let mut order = Rng::new(1, Stream::Folds).order(50);
        assert_ne!(order, (0..50).collect::<Vec<_>>());
        order.sort_unstable();
        assert_eq!(order, (0..50).collect::<Vec<_>>());
    }

    /// Users keep seeds: these are the first numbers of a stream since the first version.
    #[test]
    fn a_seed_gives_the_same_numbers_in_every_version() {
        let mut rng = Rng::new(7, Stream::Noise);
        assert_eq!(rng.unit(), 0.046_953_715_519_754_025);
        // Logarithm and cosine are the platform's.
        assert!((rng.normal() - 1.122_460_633_071_998_4).abs() < 1e-15);
        assert!((rng.student(3) - 0.406_375_151_375_778_2).abs() < 1e-15);
        assert_eq!(rng.index(1000), 779);
    }
}
