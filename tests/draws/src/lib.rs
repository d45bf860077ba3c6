//! Random numbers for tests and benches: the same in every run, on every machine.
#![forbid(unsafe_code)]

pub mod golden;
#[cfg(feature = "texts")]
pub mod texts;

/// How many cases a test has: `few`, or `many` where `STIFFARM_THOROUGH` is set, as `.ci/run` does.
pub fn few_or_many<T>(few: T, many: T) -> T {
    if std::env::var_os("STIFFARM_THOROUGH").is_some() { many } else { few }
}

/// Knuth's 64-bit linear congruential generator, of which the upper 53 bits are used.
pub struct Draws(u64);

impl Draws {
    /// A stream of its own for each seed.
    pub fn new(seed: u64) -> Draws {
        Draws(seed.wrapping_mul(2).wrapping_add(1))
    }

    /// The stream that goes on from a state.
    pub fn from_state(state: u64) -> Draws {
        Draws(state)
    }

    /// Uniform in [0, 1).
    pub fn part(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in [-1, 1).
    pub fn unit(&mut self) -> f64 {
        2.0 * self.part() - 1.0
    }

    /// Uniform in [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.part()
    }

    /// True so often.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.part() < probability
    }

    /// Each uniform in [low, high).
    pub fn array<const N: usize>(&mut self, low: f64, high: f64) -> [f64; N] {
        core::array::from_fn(|_| self.between(low, high))
    }

    /// A wrench of up to 100 N and 30 N·m along each axis.
    pub fn load(&mut self) -> [f64; 6] {
        core::array::from_fn(|k| self.unit() * if k < 3 { 100.0 } else { 30.0 })
    }

    /// So many of them.
    pub fn loads(&mut self, count: usize) -> Vec<[f64; 6]> {
        (0..count).map(|_| self.load()).collect()
    }

    /// Joint angles within ±3 rad, each posture drawn by itself.
    pub fn postures<const N: usize>(&mut self, count: usize) -> Vec<[f64; N]> {
        (0..count).map(|_| core::array::from_fn(|_| 3.0 * self.unit())).collect()
    }

    /// Joint angles along a path: each joint swings by ±2 rad once in some hundred postures.
    pub fn path<const N: usize>(&mut self, count: usize) -> Vec<[f64; N]> {
        let phase: [f64; N] = core::array::from_fn(|_| 3.0 * self.unit());
        let at =
            |k: usize, j: usize| 2.0 * (phase[j] + 0.01 * (1.0 + 0.1 * j as f64) * k as f64).sin();
        (0..count).map(|k| core::array::from_fn(|j| at(k, j))).collect()
    }
}
