//! What a call costs: instructions by the emulator's clock, stack by its paint.

use core::hint::black_box;

use cortex_m::asm::nop;
use cortex_m::peripheral::SYST;
use stiffarm_firmware_arms::draw::draw;
use stiffarm_firmware_arms::figures::{Counter, Kernel};

use crate::Number;
use crate::bare::stack_of;
use crate::port::Port;

/// Draws that each kernel is counted on: the wild ones are among them.
const DRAWS: core::ops::Range<u32> = 0..64;

/// Counts every kernel and sends a line for each: its name, the fewest and the most ticks of
/// SysTick, bytes of stack; an empty call's subtracted from all three.
pub struct Ticks {
    /// Where the lines go.
    pub port: Port,
    /// SysTick, running.
    pub clock: SYST,
}

impl Counter<Number> for Ticks {
    #[inline(never)]
    fn count<const N: usize, T>(&mut self, name: &str, kernel: Kernel<Number, N, T>, mut out: T) {
        let (mut fewest, mut most, mut deepest) = (u32::MAX, 0, 0);
        for k in DRAWS {
            let (q, wrench) = draw::<Number, N>(k);
            let own = ticks(kernel, &q, &wrench, &mut out) - ticks(empty, &q, &wrench, &mut out);
            fewest = own.min(fewest);
            most = own.max(most);
            let used = depth(kernel, &q, &wrench, &mut out) - depth(empty, &q, &wrench, &mut out);
            deepest = used.max(deepest);
        }
        self.port.send(name.as_bytes());
        for figure in [fewest, most, deepest] {
            self.port.send(b" ");
            self.port.decimal(figure);
        }
        self.port.send(b"\n");
    }
}

/// Ticks from before the call to after it.
#[inline(never)]
fn ticks<const N: usize, T>(
    kernel: Kernel<Number, N, T>,
    q: &[Number; N],
    wrench: &[Number; 6],
    out: &mut T,
) -> u32 {
    let kernel = black_box(kernel);
    let before = SYST::get_current();
    kernel(q, wrench, out);
    // It counts down, in 24 bits.
    before.wrapping_sub(SYST::get_current()) & 0x00ff_ffff
}

#[inline(never)]
fn depth<const N: usize, T>(
    kernel: Kernel<Number, N, T>,
    q: &[Number; N],
    wrench: &[Number; 6],
    out: &mut T,
) -> u32 {
    let kernel = black_box(kernel);
    stack_of(|| kernel(q, wrench, out))
}

/// The controls of both counts: a hundred instructions, and 64 words of stack.
pub fn controls(counter: &mut impl Counter<Number>) {
    counter.count("hundred_instructions", hundred_instructions, ());
    counter.count("words_of_stack", words_of_stack, [0; 64]);
}

#[inline(never)]
fn hundred_instructions(_: &[Number; 6], _: &[Number; 6], (): &mut ()) {
    macro_rules! ten {
        ($($what:tt)*) => { $($what)* $($what)* $($what)* $($what)* $($what)*
                            $($what)* $($what)* $($what)* $($what)* $($what)* };
    }
    ten!(ten!(nop();););
}

#[inline(never)]
fn words_of_stack(_: &[Number; 6], _: &[Number; 6], out: &mut [u32; 64]) {
    let mut words = [0; 64];
    for word in black_box(&mut words) {
        *word = 0x5555_5555;
    }
    *out = words;
}

#[inline(never)]
fn empty<const N: usize, T>(_: &[Number; N], _: &[Number; 6], _: &mut T) {}
