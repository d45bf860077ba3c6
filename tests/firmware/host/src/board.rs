//! The two boards.

/// A board of the emulator, and the numbers that its core has in hardware.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Board {
    /// What the budgets and the documentation call it.
    pub name: &'static str,
    /// Its section of the budgets.
    pub key: &'static str,
    /// The emulator's name for it.
    pub machine: &'static str,
    /// What the compiler is told beyond the target.
    pub rustflags: &'static str,
    /// The features of the image.
    pub features: &'static [&'static str],
}

impl Board {
    /// Cortex-M4F, f32.
    pub const M4: Board = Board {
        name: "Cortex-M4F, f32",
        key: "cortex-m4f",
        machine: "mps2-an386",
        rustflags: "",
        features: &[],
    };

    /// Cortex-M7 with a double-precision FPU, f64.
    pub const M7: Board = Board {
        name: "Cortex-M7, f64",
        key: "cortex-m7",
        machine: "mps2-an500",
        rustflags: "-C target-cpu=cortex-m7 -C target-feature=+fp64",
        features: &["double"],
    };
}
