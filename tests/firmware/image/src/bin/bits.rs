//! Sends the bits of every output of every arm at every draw, then those of the control loop.
#![no_std]
#![no_main]

#[cfg(feature = "control-alloc")]
extern crate alloc;

use cortex_m_rt::entry;
use stiffarm_firmware_arms::draw::COUNT;
use stiffarm_firmware_arms::outputs::visit;
use stiffarm_firmware_arms::record;
use stiffarm_firmware_arms::source::run;
use stiffarm_firmware_image::Number;
use stiffarm_firmware_image::port::Port;

#[entry]
fn main() -> ! {
    let mut port = Port::open();
    #[cfg(feature = "control-panic")]
    port.send(&[stiffarm_firmware_image::indexed(&[1, 2, 3])]);
    for k in 0..COUNT {
        visit::<Number>(k, |result| record::output(&mut port, result));
    }
    run::<Number>(|_, _, result| record::period(&mut port, result));
    port.close()
}
