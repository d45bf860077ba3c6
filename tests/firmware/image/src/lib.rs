//! What the images have in common. On the host this is an empty crate.
#![no_std]
#![deny(unsafe_code)]

/// The kernels' numbers: f32, or f64 on a core that has it in hardware.
#[cfg(not(feature = "double"))]
pub type Number = f32;
/// The kernels' numbers: f32, or f64 on a core that has it in hardware.
#[cfg(feature = "double")]
pub type Number = f64;

/// One indexed access whose index nobody knows: what the panic-free link has to refuse.
#[cfg(feature = "control-panic")]
pub fn indexed(bytes: &[u8]) -> u8 {
    bytes[core::hint::black_box(4)]
}

#[cfg(target_os = "none")]
pub mod bare;
#[cfg(target_os = "none")]
pub mod count;
#[cfg(all(target_os = "none", feature = "c"))]
pub mod foreign;
#[cfg(target_os = "none")]
pub mod port;
