//! Joint vectors and wrenches that every candidate is given.

/// A small deterministic generator (PCG's multiplier).
pub struct Draws(u64);

impl Draws {
    /// A stream of its own for each seed.
    pub fn new(seed: u64) -> Self {
        Draws(seed.wrapping_mul(2).wrapping_add(1))
    }

    /// Uniform in (-1, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Joint angles within ±3 rad, each pose drawn by itself.
    pub fn random<const N: usize>(&mut self, poses: usize) -> Vec<[f64; N]> {
        (0..poses).map(|_| core::array::from_fn(|_| 3.0 * self.unit())).collect()
    }

    /// Joint angles along a path: each joint swings by ±2 rad once in some hundred poses.
    pub fn smooth<const N: usize>(&mut self, poses: usize) -> Vec<[f64; N]> {
        let phase: [f64; N] = core::array::from_fn(|_| 3.0 * self.unit());
        let at =
            |k: usize, j: usize| 2.0 * (phase[j] + 0.01 * (1.0 + 0.1 * j as f64) * k as f64).sin();
        (0..poses).map(|k| core::array::from_fn(|j| at(k, j))).collect()
    }

    /// Up to 100 N and 30 N·m.
    pub fn wrenches(&mut self, poses: usize) -> Vec<[f64; 6]> {
        let mut one = |k: usize| self.unit() * if k < 3 { 100.0 } else { 30.0 };
        (0..poses).map(|_| core::array::from_fn(&mut one)).collect()
    }
}
