//! Random numbers that depend on a seed and what they are for, and on nothing else.

use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use crate::random;

/// What a stream of random numbers is for; one does not depend on how much another draws.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the names say what is drawn")]
pub enum Stream {
    Noise = 101,
    Poses = 102,
    Loads = 103,
    Approach = 104,
    Climate = 105,
    Frames = 106,
    Truths = 107,
    Arm = 108,
    Visits = 109,
    Logs = 110,
}

/// A seed for the `k`-th of many things that one seed decides (SplitMix64's finaliser).
pub(crate) fn seed_of(seed: u64, k: usize) -> u64 {
    let mut x = seed ^ (k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// Random numbers.
pub struct Dice(ChaCha8Rng);

impl Dice {
    /// Of one seed and one purpose.
    pub fn new(seed: u64, stream: Stream) -> Dice {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        generator.set_stream(stream as u64);
        Dice(generator)
    }

    /// From 0, included, to 1, excluded: 53 random bits.
    pub fn unit(&mut self) -> f64 {
        random::uniform(&mut self.0)
    }

    /// Evenly from `low` to `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        random::between(&mut self.0, [low, high])
    }

    /// 0 to `n` − 1, `n` far below 2⁵³.
    pub fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n.saturating_sub(1))
    }

    /// −1 or 1.
    pub fn sign(&mut self) -> f64 {
        if self.unit() < 0.5 { -1.0 } else { 1.0 }
    }

    /// Of mean 0 and variance 1 (Box and Muller).
    pub fn normal(&mut self) -> f64 {
        random::normal(&mut self.0)
    }

    /// Student's t with so many degrees of freedom, at least 1: heavy tails.
    pub fn student(&mut self, freedom: u32) -> f64 {
        let freedom = freedom.max(1);
        let squares: f64 = (0..freedom).map(|_| self.normal().powi(2)).sum();
        self.normal() / (squares / f64::from(freedom)).sqrt()
    }

    /// Three normal numbers.
    pub fn normal3(&mut self) -> Vector3<f64> {
        random::normal3(&mut self.0)
    }

    /// A direction, evenly over the sphere.
    pub fn direction(&mut self) -> Vector3<f64> {
        let vector = self.normal3();
        let length = vector.norm();
        if length > 1e-3 { vector / length } else { self.direction() }
    }

    /// The order of a list, at random.
    pub fn shuffle<T>(&mut self, list: &mut [T]) {
        for last in (1..list.len()).rev() {
            list.swap(last, self.below(last + 1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_numbers_are_normal() {
        let mut dice = Dice::new(1, Stream::Noise);
        let draws: Vec<f64> = (0..40_000).map(|_| dice.normal()).collect();
        let moment = |k: i32| draws.iter().map(|x| x.powi(k)).sum::<f64>() / draws.len() as f64;
        // Four standard errors: 1/√n, √(2/n), √(96/n).
        assert!(moment(1).abs() < 0.02 && (moment(2) - 1.0).abs() < 0.03);
        assert!((moment(4) - 3.0).abs() < 0.2, "{}", moment(4));
    }

    #[test]
    fn student_numbers_have_heavy_tails() {
        let mut dice = Dice::new(2, Stream::Noise);
        let beyond = |from: f64, dice: &mut Dice| {
            (0..40_000).filter(|_| dice.student(4).abs() > from).count() as f64 / 40_000.0
        };
        // Two-sided 5 % and 1 % points of four degrees of freedom; four standard errors.
        assert!((beyond(2.776, &mut dice) - 0.05).abs() < 0.0044);
        assert!((beyond(4.604, &mut dice) - 0.01).abs() < 0.002);
    }

    #[test]
    fn seed_and_purpose_decide() {
        let draw = |seed, stream| Dice::new(seed, stream).unit().to_bits();
        assert_eq!(draw(3, Stream::Poses), draw(3, Stream::Poses));
        assert_ne!(draw(3, Stream::Poses), draw(4, Stream::Poses));
        assert_ne!(draw(3, Stream::Poses), draw(3, Stream::Loads));
    }
}
