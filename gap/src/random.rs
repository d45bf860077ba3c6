//! Random numbers of a seeded generator.

use core::f64::consts::TAU;

use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;

/// From 0 up to 1.
pub fn uniform(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// Between two numbers.
pub fn between(random: &mut ChaCha8Rng, [low, high]: [f64; 2]) -> f64 {
    low + (high - low) * uniform(random)
}

/// Standard normal (Box & Muller, one of the two).
pub fn normal(random: &mut ChaCha8Rng) -> f64 {
    let radius = (-2.0 * (1.0 - uniform(random)).ln()).sqrt();
    radius * (TAU * uniform(random)).cos()
}

/// Three independent standard normals.
pub fn normal3(random: &mut ChaCha8Rng) -> Vector3<f64> {
    Vector3::new(normal(random), normal(random), normal(random))
}
