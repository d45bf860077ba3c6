//! The first three angles of an arm with a spherical wrist whose first three axes are in general position.
//!
//! What joint 2 turns, `f`, and what it turns it into, `g`, have the same length across axis 2. `|r|²` gives `g_x` and `r_z`
//! gives `g_y` as sums of the cosine and the sine of θ_3: an equation of the second degree in both (Pieper 1968). It is a
//! conic that meets the circle in four points at most. Two lines through the four are one of the three degenerate conics
//! among the sums of both, and each line meets the circle where an equation of one angle says.

use super::layout::Layout;
use super::point::{Linear, Point};
use super::position::free;
use super::subproblem::{Pair, angle_between, turned, two_angles, unit};
use super::term::{Term, dot};
use crate::number::Number;

/// Steps to the degenerate conic, by Laguerre's method: of 48 000 postures of random tables four steps leave 44 that are not
/// found, and five none; six leave none of a million.
const STEPS: usize = 6;

/// Newton's steps of each angle behind it, whose rounding is then that of the equation. Near a double root they are
/// shorter.
const POLISHED: usize = 3;

/// Shoulder (which of both lines) and elbow as the bits of the number, from the higher.
pub(super) fn general<'g>(arm: &Layout<'g>, point: &Point<'g>) -> [[Pair<'g>; 3]; 4] {
    // Turned so, the equation has no product of the cosine and the sine.
    let turn = {
        let [cc, cs, ss] = Equation::new(arm, point).squares().map(Term::constant);
        let angle = 0.5 * libm::atan2(2.0 * cs, cc - ss);
        [libm::cos(angle), libm::sin(angle)].map(|x| arm.tiny.exact(Number::cosine(x)))
    };
    let point = &Point { c: turned(turn, point.c), ..*point };
    let equation = Equation::new(arm, point);
    let [rx, ry, _] = point.r;
    equation.conic().angles().map(|third| {
        let [fx, fy, fz] = point.f(arm, third);
        let to = [equation.x.at(third), equation.y.at(third)];
        let second = angle_between([fx, fy], to, free(arm, 1));
        let [gx, gy] = turned(second, [fx, fy]);
        let [x, y, _] = arm.link(0, [gx, gy, fz + arm.d[1]]);
        let first = angle_between([x, y], [rx, ry], free(arm, 0));
        [first, second, turned(turn, third)]
    })
}

impl<'g> Linear<'g> {
    fn at(&self, [cosine, sine]: Pair<'g>) -> Term<'g> {
        self.by[0] * cosine + self.by[1] * sine + self.constant
    }

    /// `factor · self + more`.
    fn scaled(&self, factor: Term<'g>, more: Term<'g>) -> Linear<'g> {
        let by = self.by.map(|part| factor * part);
        Linear { by, constant: factor * self.constant + more }
    }
}

/// `x² + y² + z² − square = 0`, of sums of the cosine and the sine of θ_3.
struct Equation<'g> {
    /// `g_x`.
    x: Linear<'g>,
    /// `g_y`.
    y: Linear<'g>,
    /// `f_z`.
    z: Linear<'g>,
    /// `|f|²`.
    square: Linear<'g>,
}

impl<'g> Equation<'g> {
    fn new(arm: &Layout<'g>, point: &Point<'g>) -> Equation<'g> {
        let (square, z) = (point.square(arm), point.fz(arm));
        let (a, d, r, [cosine, sine]) = (arm.a[0], arm.d[1], point.r, arm.alpha[0]);
        // |r|² = |f|² + 2 d_2 f_z + d_2² + a_1² + 2 a_1 g_x.
        let lifted = z.scaled(d + d, d.zero());
        let sum = Linear {
            by: [0, 1].map(|k| square.by[k] + lifted.by[k]),
            constant: square.constant + lifted.constant,
        };
        let own = a * a + d * d;
        let rest = dot(r, r) - own;
        let inverse = (a + a).recip();
        let x = sum.scaled(-inverse, inverse * rest);
        // r_z = sin α_1 g_y + cos α_1 (f_z + d_2).
        let inverse = sine.recip();
        let slope = cosine * inverse;
        let y = z.scaled(-slope, inverse * r[2] - slope * d);
        Equation { x, y, z, square }
    }

    /// The sum of something of the three whose squares it holds.
    fn summed(&self, of: impl Fn(&Linear<'g>) -> Term<'g>) -> Term<'g> {
        of(&self.x) + of(&self.y) + of(&self.z)
    }

    /// Coefficients of the cosine's square, of half the product, and of the sine's square.
    fn squares(&self) -> [Term<'g>; 3] {
        [(0, 0), (0, 1), (1, 1)].map(|(k, l)| self.summed(|part| part.by[k] * part.by[l]))
    }

    /// The same as a conic, of which the product is none.
    fn conic(&self) -> Conic<'g> {
        let [cc, _, ss] = self.squares();
        let inverse = (cc - ss).recip();
        let [d, e] = [0, 1].map(|k| {
            let sum = self.summed(|part| part.constant * part.by[k]);
            inverse * (sum + sum - self.square.by[k])
        });
        let each = [&self.x, &self.y, &self.z].into_iter();
        let own = each.fold(ss, |sum, part| sum + part.constant * part.constant);
        Conic { d, e, f: inverse * (own - self.square.constant) }
    }
}

/// `c² + d c + e s + f = 0`.
struct Conic<'g> {
    d: Term<'g>,
    e: Term<'g>,
    f: Term<'g>,
}

impl<'g> Conic<'g> {
    /// The angles where it meets the circle; where it does not, those where lines come closest.
    fn angles(&self) -> [Pair<'g>; 4] {
        let Conic { d, e, f } = *self;
        let m = self.degenerate();
        // (1 + m) (c + d/2(1 + m))² = −m (s + e/2m)²: lines with normals (α, ∓β) of length 1.
        let half = d.exact(Number::ratio(1, 2));
        let [alpha, beta] = [d.one() + m, -m].map(|square| square.positive_part().sqrt());
        let apart = |by: Term<'g>, root: Term<'g>| half * by * root.recip();
        // That of the smaller of both follows from the larger's: its own is zero by zero where a conic is symmetric.
        let (by_d, by_e) = (apart(d, alpha), apart(e, beta));
        let difference = f - m;
        let (square_d, square_e) = (by_d * by_d, by_e * by_e);
        let signed = |square: Term<'g>, by: Term<'g>| {
            let root = square.positive_part().sqrt();
            by.select(root, -root)
        };
        let from_d = signed(square_d - difference, e);
        let from_e = signed(square_e + difference, d);
        let larger = half + m;
        let k_d = larger.select(by_d, from_e);
        let k_e = larger.select(from_d, by_e);
        let (sum, rest) = (k_d + k_e, k_e - k_d);
        let lines = [([alpha, -beta], -sum), ([alpha, beta], rest)];
        let [[a, b], [c, d]] = lines.map(|(normal, value)| {
            // An angle of a line that does not meet the circle stays where it comes closest: a step would lead to another's.
            let meets = value.one() - value * value;
            two_angles(normal, value, None).map(|angle| {
                let polished = self.polished(angle);
                [0, 1].map(|k| meets.select(polished[k], angle[k]))
            })
        });
        [a, b, c, d]
    }

    /// The `m` between −1 and 0 of which `c² + d c + e s + f + m (c² + s² − 1)` is two lines: a root of the cubic
    /// `4 (f − m) m (1 + m) − d² m − e² (1 + m)`, which is not negative at −1, nor positive at 0.
    ///
    /// It is the root on the one side of the inflection on which there is no other, by Laguerre's steps from the end of that
    /// side, which do not leave the interval.
    fn degenerate(&self) -> Term<'g> {
        let number = |n: Number| self.f.exact(n);
        let (zero, one) = (self.f.zero(), self.f.one());
        let [dd, ee] = [self.d, self.e].map(|x| x * x);
        let four = number(Number::integer(4));
        let scaled = four * self.f;
        let second = scaled - four;
        let first = scaled - dd - ee;
        let horner = |m: Term<'g>, coefficients: &[Term<'g>]| {
            coefficients.iter().fold(zero, |sum, next| sum * m + *next)
        };
        let value_of = [-four, second, first, -ee];
        let twelve = number(Number::integer(12));
        let slope_of = [-twelve, second + second, first];
        let inflection = number(Number::ratio(1, 12)) * second;
        let there = horner(inflection, &value_of);
        let (low, high) = (-one, zero);
        let inside = there.select(high, low);
        let start = (inflection + one).select(inside, high);
        let mut at = inflection.select(low, start);
        let [two, three] = [2, 3].map(|n| number(Number::integer(n)));
        let curvature_of = [-(two * twelve), second + second];
        for _ in 0..STEPS {
            let value = horner(at, &value_of);
            let (slope, curvature) = (horner(at, &slope_of), horner(at, &curvature_of));
            let (square, product) = (slope * slope, value * curvature);
            let left = two * square - three * product;
            let root = (two * left.positive_part()).sqrt();
            // The cubic falls there; where it does not, the root is there but for rounding.
            let down = root - slope;
            let inverse = down.select(down, one).recip();
            let by = three * value * inverse;
            at = at + down.select(by, zero);
            at = at.select(high, at);
            at = (at + one).select(at, low);
        }
        at
    }

    /// A few of Newton's steps from an angle, shorter where the slope is none.
    fn polished(&self, mut angle: Pair<'g>) -> Pair<'g> {
        let Conic { d, e, f } = *self;
        let [two, four] = [2, 4].map(|n| f.exact(Number::integer(n)));
        for _ in 0..POLISHED {
            let [c, s] = angle;
            let value = c * (c + d) + e * s + f;
            let double = two * c + d;
            let slope = e * c - double * s;
            let size = value.select(value, -value);
            let inner = slope * slope + four * size;
            // Nothing is divided by zero where the equation holds and has no slope.
            let inverse = inner.select(inner, inner.one()).recip();
            let by = value * slope * inverse;
            let (turned_c, turned_s) = (by * s, by * c);
            (angle, _) = unit([c + turned_c, s - turned_s]);
        }
        angle
    }
}
