//! Every kernel and the control loops, for the host and without std: linked against nothing, it
//! shows that no panic can be reached and that nothing allocates.
#![no_std]
#![allow(unsafe_code, reason = "C linkage: what is undefined must not link")]

#[cfg(feature = "control-alloc")]
extern crate alloc;

use core::panic::PanicInfo;

use stiffarm::kernels::{Kernels, Output};
use stiffarm_firmware_arms::Real;
use stiffarm_firmware_arms::draw::draw;
use stiffarm_firmware_arms::everything;
use stiffarm_firmware_arms::figures::{Counter, Kernel, each};
use stiffarm_firmware_arms::record::Sink;
use stiffarm_firmware_arms::robots::kuka_kr240;

unsafe extern "C" {
    // Nowhere defined: what can reach a panic does not link.
    fn a_panic_can_be_reached() -> !;
    // The linker is told of it: results are not to be left out as unused.
    fn stiffarm_sink(bits: u64);
}

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    // SAFETY: it is never called: it does not exist.
    unsafe { a_panic_can_be_reached() }
}

struct Out;

impl Sink for Out {
    fn word(&mut self, word: u32) {
        // SAFETY: it takes any number.
        unsafe { stiffarm_sink(word.into()) }
    }

    fn number<S: Real>(&mut self, number: S) {
        // SAFETY: it takes any number.
        unsafe { stiffarm_sink(u64::from_le_bytes(number.bytes())) }
    }
}

impl<S: Real> Counter<S> for Out {
    fn count<const N: usize, T>(&mut self, _: &str, kernel: Kernel<S, N, T>, mut out: T) {
        let (q, wrench) = draw::<S, N>(0);
        kernel(&q, &wrench, &mut out);
        core::hint::black_box(&out);
    }
}

fn all<S: Real>() {
    everything::write::<S>(&mut Out);
    each::<S>(&mut Out);
    through_a_pointer::<S>(&kuka_kr240::Robot, core::hint::black_box(5));
}

/// A robot behind a pointer, whatever the lengths.
fn through_a_pointer<S: Real>(robot: &dyn Kernels<S>, length: usize) {
    let mut block = [S::of(0); 180];
    let (q, wrench) = draw::<S, 7>(length as u32);
    for output in Output::EACH {
        let (Some(q), Some(out)) = (q.get(..output.state(length)), block.get_mut(..length)) else {
            return;
        };
        match robot.evaluate(output, q, &wrench, out) {
            Ok(()) => out.iter().for_each(|x| Out.number(*x)),
            Err(_) => Out.word(0),
        }
    }
}

/// Calls it all.
#[unsafe(no_mangle)]
pub extern "C" fn stiffarm_probe() {
    #[cfg(feature = "control-panic")]
    Out.word([1, 2, 3][core::hint::black_box(4)]);
    #[cfg(feature = "control-alloc")]
    Out.word(alloc::vec![core::hint::black_box(1); 4].len() as u32);
    all::<f32>();
    all::<f64>();
}
