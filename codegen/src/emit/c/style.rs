//! How C spells numbers and operations.

use super::super::literal::constant;
use super::Precision;
use crate::ir::{Operation, Style};
use crate::number::Number;

/// C99 in one precision, or CUDA's C.
pub(in crate::emit) struct C {
    pub precision: Precision,
    /// Whether functions are a GPU's, which takes sines and cosines itself.
    pub device: bool,
    /// Whether angles of directions are `math.h`'s.
    pub math: bool,
}

impl C {
    /// The numbers' type.
    pub fn real(&self) -> &'static str {
        match self.precision {
            Precision::F32 => "float",
            Precision::F64 => "double",
        }
    }

    /// What stands behind a literal and behind a function of `math.h`.
    pub fn suffix(&self) -> &'static str {
        match self.precision {
            Precision::F32 => "f",
            Precision::F64 => "",
        }
    }

    /// What stands before a function that others call.
    pub fn linkage(&self) -> &'static str {
        if self.device { "static __device__ " } else { "" }
    }

    /// What stands before a function of the file.
    pub fn local(&self) -> &'static str {
        if self.device { "static __device__" } else { "static" }
    }

    /// `0.0` or `0.0f`.
    pub fn zero(&self) -> String {
        format!("0.0{}", self.suffix())
    }
}

impl Style for C {
    /// The value that the Rust text gives: a `float` is the rounded `double`.
    fn number(&self, n: Number) -> String {
        let text = constant(n);
        let single = text.parse::<f64>().map(|x| x as f32).ok().filter(|x| x.is_finite());
        match (self.precision, single) {
            (Precision::F32, Some(x)) if x < 0.0 => format!("({x:?}f)"),
            (Precision::F32, Some(x)) => format!("{x:?}f"),
            (Precision::F32, None) => format!("((float)({text}))"),
            (Precision::F64, _) if text.contains('/') || text.starts_with('-') => {
                format!("({text})")
            }
            (Precision::F64, _) => text,
        }
    }
    fn of(&self, operation: Operation, numbers: &[String]) -> String {
        let a = &numbers[0];
        let (suffix, zero) = (self.suffix(), self.zero());
        match operation {
            Operation::Reciprocal => format!("(1.0{suffix} / ({a}))"),
            Operation::Root => format!("sqrt{suffix}({a})"),
            Operation::Sign => {
                let real = self.real();
                format!("((({real})({a} > {zero})) - (({real})({a} < {zero})))")
            }
            Operation::Sine => format!("sin{suffix}({a})"),
            Operation::Cosine => format!("cos{suffix}({a})"),
            Operation::Atan2 if self.math => {
                format!("atan2{suffix}(({a}) + {zero}, {})", numbers[1])
            }
            Operation::Atan2 => format!("direction({a}, {})", numbers[1]),
            Operation::Select => {
                format!("((({a}) > {zero}) ? ({}) : ({}))", numbers[1], numbers[2])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_value() {
        let [double, single] = [Precision::F64, Precision::F32].map(|precision| C {
            precision,
            device: false,
            math: false,
        });
        let third = Number::ratio(1, 3);
        assert_eq!(double.number(third), "(1.0 / 3.0)");
        assert_eq!(single.number(third), "((float)(1.0 / 3.0))");
        assert_eq!(double.number(Number::ratio(-1, 8)), "(-0.125)");
        assert_eq!(single.number(Number::ratio(-1, 8)), "(-0.125f)");
        assert_eq!(single.number(Number::ratio(1, 10)), "0.1f");
        assert_eq!(double.number(Number::ratio(1, 350_000)), "(1.0 / 350000.0)");
    }
}
