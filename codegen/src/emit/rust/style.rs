//! How Rust spells numbers and operations.

use super::super::expression::Style;
use super::super::literal::constant;
use crate::number::Number;

/// Rust over the scalar trait.
pub(super) struct Rust {
    /// Whether products are fused into sums.
    pub fused: bool,
    /// The argument whose fields are the constants.
    pub constants: &'static str,
}

impl Style for Rust {
    fn number(&self, n: Number) -> String {
        format!("S::lit({})", constant(n))
    }
    fn name(&self, name: &str) -> String {
        match name.strip_prefix("constants.") {
            Some(field) => format!("{}.{field}", self.constants),
            None => name.to_string(),
        }
    }
    fn product(&self, a: &str, b: &str) -> String {
        format!("{a} * {b}")
    }
    fn bracket(&self, inner: &str) -> String {
        format!("({inner})")
    }
    fn recip(&self, a: &str) -> String {
        format!("({a}).recip()")
    }
    fn sqrt(&self, a: &str) -> String {
        format!("({a}).sqrt()")
    }
    fn sign(&self, a: &str) -> String {
        format!("({a}).sign()")
    }
    fn fused(&self, a: &str, b: &str, c: &str) -> Option<String> {
        self.fused.then(|| format!("S::mul_add({a}, {b}, {c})"))
    }
}
