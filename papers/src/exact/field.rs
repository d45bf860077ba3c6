//! Fast evaluation without rounding: arithmetic modulo the prime 2⁶¹ − 1, in which every rational
//! operation is exact. Two different formulas agree at a random point with a probability below
//! 10⁻¹⁵, so one point rejects and a few points convince.

use std::cell::RefCell;
use std::collections::HashMap;

use num_rational::Ratio;

use super::arithmetic::Arithmetic;
use crate::latex::tree::{Angle, Function};

/// 2⁶¹ − 1.
const P: u64 = (1 << 61) - 1;

/// A point: a residue for every symbol, a rational point of the circle for every angle.
#[derive(Debug, Default)]
pub struct Modular {
    seed: u64,
    /// Names that stand for a formula, with its value here.
    pub defined: HashMap<String, u64>,
    /// A name whose residue is another one.
    pub moved: Option<String>,
    circle: RefCell<HashMap<String, (u64, u64)>>,
}

impl Modular {
    /// The point number `seed`.
    pub fn point(seed: u64) -> Self {
        Modular { seed, ..Modular::default() }
    }

    fn residue(&self, salt: u64, name: &str) -> u64 {
        // FNV-1a, then splitmix64: the same point on every machine.
        let moved = u64::from(self.moved.as_deref() == Some(name));
        let start = 0xcbf2_9ce4_8422_2325 ^ salt ^ moved;
        let hash =
            name.bytes().fold(start, |h, b| (h ^ u64::from(b)).wrapping_mul(0x100_0000_01b3));
        let mut z = hash.wrapping_add(self.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % (P - 1000)) + 500
    }

    /// A double from 0 to 1 that follows from the point and a name.
    pub fn part(&self, name: &str) -> f64 {
        self.residue(0, name) as f64 / P as f64
    }

    /// Sine and cosine of one angle: (2t, 1 − t²)/(1 + t²).
    fn sin_cos(&self, name: &str) -> (u64, u64) {
        if let Some(known) = self.circle.borrow().get(name) {
            return *known;
        }
        let t = self.residue(0x5151, name);
        let square = mul(t, t);
        // −1 is no square modulo P, so 1 + t² has an inverse.
        let inverse = power(add(1, square), P - 2);
        let pair = (mul(add(t, t), inverse), mul(minus(1, square), inverse));
        self.circle.borrow_mut().insert(name.to_owned(), pair);
        pair
    }
}

fn add(a: u64, b: u64) -> u64 {
    let sum = a + b;
    if sum >= P { sum - P } else { sum }
}

/// `a − b` of two residues.
pub(crate) fn minus(a: u64, b: u64) -> u64 {
    add(a, P - b)
}

fn mul(a: u64, b: u64) -> u64 {
    let wide = u128::from(a) * u128::from(b);
    let folded = (wide & u128::from(P)) as u64 + (wide >> 61) as u64;
    if folded >= P { folded - P } else { folded }
}

fn power(mut base: u64, mut n: u64) -> u64 {
    let mut out = 1;
    while n > 0 {
        if n & 1 == 1 {
            out = mul(out, base);
        }
        base = mul(base, base);
        n >>= 1;
    }
    out
}

impl Arithmetic for Modular {
    type Value = u64;
    type Error = &'static str;

    fn number(&self, n: Ratio<i128>) -> Result<u64, &'static str> {
        let residue = |i: i128| i.rem_euclid(i128::from(P)) as u64;
        self.div(residue(*n.numer()), residue(*n.denom()))
    }

    fn named(&self, key: &str) -> Result<u64, &'static str> {
        Ok(self.defined.get(key).copied().unwrap_or_else(|| self.residue(0, key)))
    }

    fn trig(&self, function: Function, angle: &Angle) -> Result<u64, &'static str> {
        let (mut s, mut c) = (0, 1);
        for (name, times) in angle.terms() {
            let (one, other) = self.sin_cos(name);
            let one = if times < 0 { minus(0, one) } else { one };
            for _ in 0..times.unsigned_abs().min(64) {
                (s, c) = (add(mul(s, other), mul(c, one)), minus(mul(c, other), mul(s, one)));
            }
        }
        Ok(if function == Function::Sin { s } else { c })
    }

    fn add(&self, a: u64, b: u64) -> Result<u64, &'static str> {
        Ok(add(a, b))
    }

    fn sub(&self, a: u64, b: u64) -> Result<u64, &'static str> {
        Ok(minus(a, b))
    }

    fn mul(&self, a: u64, b: u64) -> Result<u64, &'static str> {
        Ok(mul(a, b))
    }

    fn div(&self, a: u64, b: u64) -> Result<u64, &'static str> {
        if b != 0 { Ok(mul(a, power(b, P - 2))) } else { Err("a division by zero") }
    }

    /// The root that is a square itself.
    fn sqrt(&self, a: u64) -> Result<u64, &'static str> {
        let root = power(a, P.div_ceil(4));
        if mul(root, root) == a { Ok(root) } else { Err("a root of what is no square") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_field_is_a_field() {
        let f = Modular::point(3);
        let (a, b) = (f.named("a").unwrap(), f.named("b").unwrap());
        assert_ne!(a, b);
        assert_eq!(f.mul(f.div(a, b).unwrap(), b), Ok(a));
        assert_eq!(f.sub(add(a, b), b), Ok(a));
        assert!(f.div(a, 0).is_err());
        let square = mul(a, a);
        let root = f.sqrt(square).unwrap();
        assert!(root == a || root == P - a);
        assert_eq!(f.number(Ratio::new(-1, 2)), f.div(P - 1, 2));
    }

    #[test]
    fn sines_lie_on_the_circle_and_add() {
        let f = Modular::point(1);
        let sum: Angle = {
            let mut angle = Angle::single("a");
            angle.add("b", -2);
            angle
        };
        let (s, c) = (f.trig(Function::Sin, &sum).unwrap(), f.trig(Function::Cos, &sum).unwrap());
        assert_eq!(add(mul(s, s), mul(c, c)), 1);
    }
}
