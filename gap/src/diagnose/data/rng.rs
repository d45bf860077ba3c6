//! Random numbers that depend on the seed and on what they are for, and on nothing else.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// What a stream of random numbers is for; each is independent of how much the others draw.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Stream {
    Folds = 1,
    Signs = 2,
    Bootstrap = 3,
    Halves = 4,
}

/// The generator of one stream.
pub(crate) fn generator(seed: u64, stream: Stream) -> ChaCha8Rng {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(stream as u64);
    generator
}

/// A number from 0 to `n` − 1, `n` below 2³² (the bias of the multiplication is below n/2³²).
pub(crate) fn below(generator: &mut ChaCha8Rng, n: usize) -> usize {
    let wide = u64::from(generator.next_u32()) * n as u64;
    (wide >> 32) as usize
}

/// 0 to `n` − 1 in random order.
pub(crate) fn shuffled(generator: &mut ChaCha8Rng, n: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..n).collect();
    for last in (1..n).rev() {
        order.swap(last, below(generator, last + 1));
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_seed_decides() {
        let draw = |seed, stream| generator(seed, stream).next_u64();
        assert_eq!(draw(7, Stream::Folds), draw(7, Stream::Folds));
        assert_ne!(draw(7, Stream::Folds), draw(8, Stream::Folds));
        assert_ne!(draw(7, Stream::Folds), draw(7, Stream::Signs));
    }

    #[test]
    fn a_shuffle_keeps_every_number() {
        let mut order = shuffled(&mut generator(1, Stream::Folds), 50);
        assert_ne!(order, (0..50).collect::<Vec<_>>());
        order.sort_unstable();
        assert_eq!(order, (0..50).collect::<Vec<_>>());
    }
}
