//! The two boards.

/// A board of the emulator, and the numbers that its core has in hardware.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Board {
    /// Cortex-M4F, f32.
    M4,
    /// Cortex-M7 with a double-precision FPU, f64.
    M7,
}

impl Board {
    /// Both.
    pub const EACH: [Board; 2] = [Board::M4, Board::M7];

    /// What the budgets and the documentation call it.
    pub fn name(self) -> &'static str {
        match self {
            Board::M4 => "Cortex-M4F, f32",
            Board::M7 => "Cortex-M7, f64",
        }
    }

    /// Its section of the budgets.
    pub fn key(self) -> &'static str {
        match self {
            Board::M4 => "cortex-m4f",
            Board::M7 => "cortex-m7",
        }
    }

    /// The emulator's name for it.
    pub fn machine(self) -> &'static str {
        match self {
            Board::M4 => "mps2-an386",
            Board::M7 => "mps2-an500",
        }
    }

    /// What the compiler is told beyond the target.
    pub fn rustflags(self) -> &'static str {
        match self {
            Board::M4 => "",
            Board::M7 => "-C target-cpu=cortex-m7 -C target-feature=+fp64",
        }
    }

    /// The features of the image.
    pub fn features(self) -> &'static [&'static str] {
        match self {
            Board::M4 => &[],
            Board::M7 => &["double"],
        }
    }
}
