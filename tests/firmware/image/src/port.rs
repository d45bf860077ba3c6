//! The way out: bytes to the emulator's host, by semihosting.

use cortex_m_semihosting::debug::{EXIT_FAILURE, EXIT_SUCCESS, exit};
use cortex_m_semihosting::hio::{HostStream, hstdout};
use stiffarm_firmware_arms::Real;
use stiffarm_firmware_arms::record::Sink;

/// Bytes on their way, a buffer at a time.
pub struct Port {
    host: HostStream,
    buffer: [u8; 4096],
    used: usize,
}

impl Port {
    /// Opens the way; ends the emulation as failed where there is none.
    pub fn open() -> Self {
        loop {
            if let Ok(host) = hstdout() {
                return Port { host, buffer: [0; 4096], used: 0 };
            }
            exit(EXIT_FAILURE);
        }
    }

    /// Sends bytes.
    pub fn send(&mut self, bytes: &[u8]) {
        for byte in bytes {
            if self.used == self.buffer.len() {
                self.flush();
            }
            if let Some(place) = self.buffer.get_mut(self.used) {
                *place = *byte;
                self.used += 1;
            }
        }
    }

    /// Sends an integer in decimal digits.
    pub fn decimal(&mut self, mut integer: u32) {
        let mut digits = [b'0'; 10];
        for digit in digits.iter_mut().rev() {
            *digit = b'0' + (integer % 10) as u8;
            integer /= 10;
        }
        let leading = digits.iter().take_while(|digit| **digit == b'0').count().min(9);
        self.send(digits.get(leading..).unwrap_or(&digits));
    }

    fn flush(&mut self) {
        if self.host.write_all(self.buffer.get(..self.used).unwrap_or(&[])).is_err() {
            exit(EXIT_FAILURE);
        }
        self.used = 0;
    }

    /// Sends what is left and ends the emulation.
    pub fn close(mut self) -> ! {
        self.flush();
        loop {
            exit(EXIT_SUCCESS);
        }
    }
}

impl Sink for Port {
    fn word(&mut self, word: u32) {
        self.send(&word.to_le_bytes());
    }

    fn number<S: Real>(&mut self, number: S) {
        self.send(number.bytes().get(..S::BYTES).unwrap_or(&[]));
    }
}
