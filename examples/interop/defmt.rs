//! What kernels return, told to `defmt`: a function for firmware, which brings the logger and the link script.
//!
//! ```text
//! cargo build -p stiffarm --example with_defmt --features defmt
//! ```
#![no_std]

stiffarm::robot! {
    /// The arm.
    pub mod ur5 from "robots/arms/ur5.toml";
    outputs: pose, deflection;
}

/// Tells where the tool is and what the load does to it.
pub fn tell(q: &[f32; 6], wrench: &[f32; 6]) {
    defmt::info!("{} of {=str}", ur5::pose(q), ur5::NAME);
    match ur5::deflection(q, wrench) {
        Ok(moved) => defmt::debug!("moved by {}", moved),
        Err(unstable) => defmt::warn!("{}", unstable),
    }
}
