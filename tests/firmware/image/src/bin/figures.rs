//! Counts what the kernels cost and sends a line for each.
#![no_std]
#![no_main]

use cortex_m::Peripherals;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::entry;
use stiffarm_firmware_arms::figures;
use stiffarm_firmware_image::count::{Ticks, controls};
use stiffarm_firmware_image::port::Port;

#[entry]
fn main() -> ! {
    let port = Port::open();
    let Some(peripherals) = Peripherals::take() else { port.close() };
    let mut clock = peripherals.SYST;
    clock.set_clock_source(SystClkSource::Core);
    clock.set_reload(0x00ff_ffff);
    clock.clear_current();
    clock.enable_counter();
    let mut ticks = Ticks { port, clock };
    controls(&mut ticks);
    figures::each(&mut ticks);
    #[cfg(feature = "c")]
    stiffarm_firmware_image::foreign::each(&mut ticks);
    ticks.port.close()
}
