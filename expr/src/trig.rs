//! Angles: a sum of joint angles and an offset, whose sine and cosine fold exactly where they can.

use num_rational::Ratio;
use num_traits::CheckedAdd;

use super::graph::{Expr, Graph, Node, Symbol};
use stiffarm_table::number::Number;
use stiffarm_table::robot::Angle;

const LONG_DENOMINATOR: i64 = 1 << 30;

/// An angle of rotation: joint angles (summed over parallel axes) plus a constant.
#[derive(Clone, Debug, PartialEq)]
pub struct Turn {
    /// The part that depends on joints or symbolic parameters.
    variable: Expr,
    /// Constant part as a multiple of π.
    pi: Ratio<i64>,
    /// Constant part that is no multiple of π, rad.
    radians: Number,
}

impl Turn {
    /// No rotation.
    pub const ZERO: Turn =
        Turn { variable: Expr::ZERO, pi: Ratio::new_raw(0, 1), radians: Number::ZERO };

    /// A constant or symbolic angle of the table.
    pub fn constant(g: &mut Graph, angle: &Angle) -> Turn {
        match angle {
            Angle::Pi(r) => Turn { pi: *r, ..Turn::ZERO },
            Angle::Radians(n) => Turn { radians: *n, ..Turn::ZERO },
            Angle::Symbol(name) => {
                Turn { variable: g.symbol(Symbol::Parameter(name.clone())), ..Turn::ZERO }
            }
        }
    }

    /// The angle of a joint without its offset.
    pub fn joint(g: &mut Graph, joint: usize) -> Turn {
        Turn { variable: g.symbol(Symbol::Joint(joint)), ..Turn::ZERO }
    }

    /// An angle that is an expression of its own.
    pub fn variable(angle: Expr) -> Turn {
        Turn { variable: angle, ..Turn::ZERO }
    }

    /// `self + other`.
    pub fn plus(&self, g: &mut Graph, other: &Turn) -> Turn {
        let variable = g.add(self.variable, other.variable);
        let radians = self.radians + other.radians;
        // A common denominator this long would overflow later on: such offsets are added rounded.
        let sum = self.pi.checked_add(&other.pi).filter(|sum| *sum.denom() < LONG_DENOMINATOR);
        match sum {
            Some(pi) => Turn { variable, pi: reduce(pi), radians },
            None => {
                let rounded = Number::rounded(to_radians(other.pi));
                Turn { variable, pi: self.pi, radians: radians + rounded }
            }
        }
    }

    /// `-self`.
    pub fn negated(&self) -> Turn {
        Turn { variable: -self.variable, pi: -self.pi, radians: -self.radians }
    }

    /// Whether the rotation is the identity.
    pub fn is_zero(&self) -> bool {
        self.is_constant() && self.radians.is_zero() && *reduce(self.pi).numer() == 0
    }

    /// Whether the rotation is exactly half a turn.
    pub fn is_half_turn(&self) -> bool {
        self.is_constant() && self.radians.is_zero() && reduce(self.pi) == Ratio::new_raw(1, 1)
    }

    fn is_constant(&self) -> bool {
        self.variable.is_zero()
    }

    /// Sine and cosine. Quarter turns of the offset are folded into signs and an exchange of the two,
    /// so that `q + pi/2` needs no addition.
    pub fn sin_cos(&self, g: &mut Graph) -> (Expr, Expr) {
        if self.is_constant() && self.radians.is_zero() {
            let (s, c) = sin_cos_pi(self.pi);
            return (g.number(s), g.number(c));
        }
        if self.is_constant() {
            let total = self.radians.to_f64() + to_radians(self.pi);
            return (
                g.number(Number::cosine(libm::sin(total))),
                g.number(Number::cosine(libm::cos(total))),
            );
        }
        let quarters = (self.pi * 2).floor();
        let rest = self.pi - quarters / 2;
        let constant = match (*rest.numer() == 0, self.radians.is_zero()) {
            (true, _) => self.radians,
            (false, true) => Number::rounded(to_radians(rest)),
            (false, false) => Number::rounded(to_radians(rest)) + self.radians,
        };
        let constant = g.number(constant);
        let angle = g.add(self.variable, constant);
        let (s, c) = (g.sin(angle), g.cos(angle));
        match quarters.to_integer().rem_euclid(4) {
            0 => (s, c),
            1 => (c, -s),
            2 => (-s, -c),
            _ => (-c, s),
        }
    }
}

impl Graph {
    /// The terms of an angle: joints in order, then symbolic offsets, then the constant.
    pub fn terms(&self, angle: Expr) -> Vec<Expr> {
        let mut terms = Vec::new();
        let mut stack = vec![angle];
        while let Some(e) = stack.pop() {
            match self.node(e) {
                Node::Add(a, b) => stack.extend([a, b].map(|o| o.signed(e.is_negative()))),
                _ => terms.push(e),
            }
        }
        terms.sort_by_key(|e| match self.symbol_at(e.node()) {
            Some(Symbol::Joint(joint)) => (0, *joint),
            Some(_) => (1, e.node()),
            None => (2, e.node()),
        });
        terms
    }

    /// Whether an angle is one of the posture's: a sum of joint values and of what does not change with them (`once`).
    pub fn is_of_posture(&self, angle: Expr, once: &[bool]) -> bool {
        self.terms(angle).iter().all(|e| match self.node(*e) {
            Node::Number(_) => true,
            Node::Symbol(s) => !matches!(
                self.symbol_of(s),
                Symbol::Own { .. }
                    | Symbol::Wrench(_)
                    | Symbol::Deflection { .. }
                    | Symbol::Response(_)
            ),
            _ => once[e.node()],
        })
    }
}

/// The same direction with the multiple of π in (-1, 1].
fn reduce(pi: Ratio<i64>) -> Ratio<i64> {
    let turns = ((pi - 1) / 2).ceil();
    pi - turns * 2
}

fn to_radians(pi: Ratio<i64>) -> f64 {
    core::f64::consts::PI * *pi.numer() as f64 / *pi.denom() as f64
}

/// `(sin rπ, cos rπ)`: exact where they are 0, ±1/2 or ±1 (by Niven's theorem nowhere else
/// rational), reduced to the first octant before rounding elsewhere.
fn sin_cos_pi(r: Ratio<i64>) -> (Number, Number) {
    let quarters = (r * 2 + Ratio::new(1, 2)).floor();
    let rest = r - quarters / 2; // in [-1/4, 1/4)
    let negative = *rest.numer() < 0;
    let (s, c) = first_octant(if negative { -rest } else { rest });
    let s = if negative { -s } else { s };
    match quarters.to_integer().rem_euclid(4) {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

fn first_octant(r: Ratio<i64>) -> (Number, Number) {
    let root = |n: i128, d: i128| Number::rounded(libm::sqrt(n as f64 / d as f64));
    match (*r.numer(), *r.denom()) {
        (0, _) => (Number::ZERO, Number::ONE),
        (1, 6) => (Number::ratio(1, 2), root(3, 4)),
        (1, 4) => (root(1, 2), root(1, 2)),
        _ => (Number::rounded(libm::sin(to_radians(r))), Number::rounded(libm::cos(to_radians(r)))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multiples_of_pi_fold_exactly() {
        for k in -48i64..=48 {
            let (s, c) = sin_cos_pi(Ratio::new(k, 24));
            let angle = k as f64 * core::f64::consts::PI / 24.0;
            assert!((s.to_f64() - angle.sin()).abs() < 1e-15, "sin {k}/24 pi");
            assert!((c.to_f64() - angle.cos()).abs() < 1e-15, "cos {k}/24 pi");
            assert_eq!(s.is_zero(), k % 24 == 0);
            assert_eq!(c.is_zero(), (k - 12) % 24 == 0);
        }
        assert_eq!(sin_cos_pi(Ratio::new(1, 3)).1, Number::ratio(1, 2));
        assert_eq!(sin_cos_pi(Ratio::new(-7, 6)).0, Number::ratio(1, 2));
    }

    #[test]
    fn quarter_turns_of_an_offset_exchange_sine_and_cosine() {
        let mut g = Graph::new();
        let q = Turn::joint(&mut g, 0);
        let (s, c) = q.sin_cos(&mut g);
        for (quarters, expected) in [(1, (c, -s)), (2, (-s, -c)), (-1, (-c, s)), (4, (s, c))] {
            let offset = Turn::constant(&mut g, &Angle::Pi(Ratio::new(quarters, 2)));
            assert_eq!(q.plus(&mut g, &offset).sin_cos(&mut g), expected);
        }
    }

    #[test]
    fn half_turns_and_identities_are_recognised() {
        let mut g = Graph::new();
        let half = Turn::constant(&mut g, &Angle::Pi(Ratio::new(-3, 1)));
        assert!(half.is_half_turn() && !half.is_zero());
        assert!(half.plus(&mut g, &half).is_zero());
        let q = Turn::joint(&mut g, 0);
        assert!(q.plus(&mut g, &q.negated()).is_zero());
    }

    #[test]
    fn other_offsets_stay_in_the_angle() {
        let mut g = Graph::new();
        let q = Turn::joint(&mut g, 0);
        let offset = Turn::constant(&mut g, &Angle::Pi(Ratio::new(2, 3)));
        let (s, _) = q.plus(&mut g, &offset).sin_cos(&mut g);
        let value = g.evaluate(&[s], |_| 0.4)[0];
        assert!((value - (0.4 + 2.0 * core::f64::consts::PI / 3.0).sin()).abs() < 1e-15);
    }
}
