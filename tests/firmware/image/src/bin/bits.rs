//! Sends the bits of every output of every arm at every draw, then those of the control loops.
#![no_std]
#![no_main]

#[cfg(feature = "control-alloc")]
extern crate alloc;

use cortex_m_rt::entry;
use stiffarm_firmware_arms::everything;
use stiffarm_firmware_image::Number;
use stiffarm_firmware_image::port::Port;

#[entry]
fn main() -> ! {
    let mut port = Port::open();
    #[cfg(feature = "control-panic")]
    port.send(&[stiffarm_firmware_image::indexed(&[1, 2, 3])]);
    everything::write::<Number>(&mut port);
    port.close()
}
