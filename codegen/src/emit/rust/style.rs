//! How Rust spells numbers and operations.

use super::super::literal::constant;
use crate::ir::{Operation, Style};
use crate::number::Number;

/// Rust over the scalar trait.
pub(super) struct Rust {
    /// Whether products are fused into sums.
    pub fused: bool,
    /// The argument whose fields are the constants.
    pub constants: &'static str,
}

impl Rust {
    /// The function of the runtime that solves a system.
    pub fn solve(&self) -> &'static str {
        if self.fused { "solve_fused" } else { "solve" }
    }
}

impl Style for Rust {
    fn number(&self, n: Number) -> String {
        format!("S::lit({})", constant(n))
    }
    fn constant(&self, name: &str) -> String {
        format!("{}.{name}", self.constants)
    }
    fn of(&self, operation: Operation, numbers: &[String]) -> String {
        let a = &numbers[0];
        match operation {
            Operation::Reciprocal => format!("({a}).recip()"),
            Operation::Root => format!("({a}).sqrt()"),
            Operation::Sign => format!("({a}).sign()"),
            Operation::Sine => format!("S::sin_cos_all([{a}]).0[0]"),
            Operation::Cosine => format!("S::sin_cos_all([{a}]).1[0]"),
            Operation::Atan2 => format!("({a}).atan2({})", numbers[1]),
            Operation::Select => format!("({a}).select({}, {})", numbers[1], numbers[2]),
        }
    }
    fn fused(&self, a: &str, b: &str, c: &str) -> String {
        format!("S::mul_add({a}, {b}, {c})")
    }
}
