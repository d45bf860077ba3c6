//! The only unsafe code of the proof: a panic that cannot be linked, and the stack as memory.
#![allow(unsafe_code, reason = "an undefined symbol and the free stack cannot be had otherwise")]

use core::panic::PanicInfo;
use core::ptr::{read_volatile, write_volatile};

use cortex_m::register::msp;

unsafe extern "C" {
    // Nowhere defined: an image from which a panic can be reached does not link.
    fn a_panic_can_be_reached() -> !;
}

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    // SAFETY: it is never called: it does not exist.
    unsafe { a_panic_can_be_reached() }
}

/// What the free stack is painted with.
const PAINT: u32 = 0x5aa5_c33c;

/// Words of the free stack that are painted: 32 KiB.
const WORDS: u32 = 8_192;

/// Bytes of the stack below the caller's own that `call` writes to, from the lowest word that
/// changes. A word that is reserved and not written to does not show, unless one below it is.
#[inline(never)]
pub fn stack_of(call: impl FnOnce()) -> u32 {
    let top = msp::read() & !3;
    for k in 1..=WORDS {
        // SAFETY: the stack grows down through 4 MB of RAM, nothing interrupts, and below the stack
        // pointer nothing is anyone's.
        unsafe { write_volatile((top - 4 * k) as *mut u32, PAINT) };
    }
    call();
    let mut lowest = WORDS;
    // SAFETY: as above.
    while lowest > 0 && unsafe { read_volatile((top - 4 * lowest) as *const u32) } == PAINT {
        lowest -= 1;
    }
    4 * lowest
}
