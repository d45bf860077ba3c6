//! Sends the bits of every output of every arm at every draw, by the kernels in C.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use stiffarm_firmware_arms::draw::COUNT;
use stiffarm_firmware_arms::record;
use stiffarm_firmware_image::foreign::visit;
use stiffarm_firmware_image::port::Port;

#[entry]
fn main() -> ! {
    let mut port = Port::open();
    for k in 0..COUNT {
        visit(k, |result| record::output(&mut port, result));
    }
    port.close()
}
