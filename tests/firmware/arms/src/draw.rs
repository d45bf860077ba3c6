//! Joint values and wrenches, drawn from integers: the same bits on every machine.

use crate::Real;

/// How many are drawn of each arm.
pub const COUNT: u32 = 1_000;

/// A small generator: Steele, Lea & Flood (2014), SplitMix64.
struct SplitMix(u64);

impl SplitMix {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
}

/// Draw number `k` for an arm of `N` joints: joint values (rad, m), wrench (N, N·m).
///
/// Postures within ±3, every tenth within ±100; loads up to 100, every 25th one that no arm bears.
/// The first four are zero, an angle beyond all reason, one that is infinite and one that is none.
pub fn draw<S: Real, const N: usize>(k: u32) -> ([S; N], [S; 6]) {
    let mut random = SplitMix((u64::from(k) << 8) | N as u64);
    let turn = S::of(if k % 10 == 7 { 100 } else { 3 });
    let load = S::of(if k % 25 == 4 { 1_000_000 } else { 100 });
    let heavy = if k % 25 == 4 { S::of(1_000) } else { S::of(1) };
    let mut q = [S::of(0); N];
    for value in &mut q {
        *value = turn * S::unit(random.next());
    }
    let mut wrench = [S::of(0); 6];
    for value in &mut wrench {
        *value = load * heavy * S::unit(random.next());
    }
    match k {
        0 => q = [S::of(0); N],
        1 => q[0] = S::of(1_000_000) * S::of(1_000_000),
        2 => q[0] = S::INFINITY,
        3 => q[N - 1] = S::NAN,
        _ => {}
    }
    (q, wrench)
}
