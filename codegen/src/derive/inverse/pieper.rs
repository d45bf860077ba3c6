//! The first three angles of an arm with a spherical wrist whose first three axes are in general position.
//!
//! What joint 2 turns, `f`, and what it turns it into, `g`, have the same length across axis 2. `|r|²` gives `g_x` and `r_z`
//! gives `g_y` as sums of the cosine and the sine of θ_3: an equation of the second degree in both (Pieper 1968). It is a
//! conic that meets the circle in four points at most. Two lines through the four are one of the three degenerate conics
//! among the sums of both, and each line meets the circle where an equation of one angle says.

use super::displacement::about_x;
use super::layout::Layout;
use super::point::{Linear, Point};
use super::position::free;
use super::subproblem::{Pair, angle_between, turned, two_angles, unit};
use crate::expr::{Expr, Graph};
use crate::number::Number;

/// Steps to the degenerate conic, by Laguerre's method: of 48 000 postures of random tables four steps leave 44 that are not
/// found, and five none; six leave none of a million.
const STEPS: usize = 6;

/// Newton's steps of each angle behind it, whose rounding is then that of the equation. Near a double root they are
/// shorter.
const POLISHED: usize = 3;

/// Shoulder (which of both lines) and elbow as the bits of the number, from the higher.
pub(super) fn general(arm: &mut Layout, point: &Point) -> [[Pair; 3]; 4] {
    // Turned so, the equation has no product of the cosine and the sine.
    let turn = {
        let all = Equation::new(arm, point);
        let [cc, cs, ss] = all.squares(&mut arm.g);
        let [cc, cs, ss] = [cc, cs, ss].map(|e| arm.g.evaluate(&[e], |_| f64::NAN)[0]);
        let angle = 0.5 * libm::atan2(2.0 * cs, cc - ss);
        let [cosine, sine] = [libm::cos(angle), libm::sin(angle)];
        [cosine, sine].map(|x| arm.g.number(Number::cosine(x)))
    };
    let point = &Point { c: turned(&mut arm.g, turn, point.c), ..*point };
    let equation = Equation::new(arm, point);
    let conic = equation.conic(&mut arm.g);
    let thirds = conic.angles(&mut arm.g);
    let [rx, ry, _] = point.r;
    thirds.map(|third| {
        let [fx, fy, fz] = point.f(arm, third);
        let (free_first, free_second) = (free(arm, 0), free(arm, 1));
        let g = &mut arm.g;
        let to = [equation.x.at(g, third), equation.y.at(g, third)];
        let second = angle_between(g, [fx, fy], to, free_second);
        let [gx, gy] = turned(g, second, [fx, fy]);
        let gz = g.add(fz, arm.d[1]);
        let [_, y, _] = about_x(g, arm.alpha[0], [gx, gy, gz]);
        let x = g.add(arm.a[0], gx);
        let first = angle_between(g, [x, y], [rx, ry], free_first);
        [first, second, turned(g, turn, third)]
    })
}

impl Linear {
    fn at(&self, g: &mut Graph, [cosine, sine]: Pair) -> Expr {
        let (a, b) = (g.mul(self.by[0], cosine), g.mul(self.by[1], sine));
        let sum = g.add(a, b);
        g.add(sum, self.constant)
    }

    /// `factor · self + more`.
    fn scaled(&self, g: &mut Graph, factor: Expr, more: Expr) -> Linear {
        let by = self.by.map(|part| g.mul(factor, part));
        let part = g.mul(factor, self.constant);
        Linear { by, constant: g.add(part, more) }
    }
}

/// `x² + y² + z² − square = 0`, of sums of the cosine and the sine of θ_3.
struct Equation {
    /// `g_x`.
    x: Linear,
    /// `g_y`.
    y: Linear,
    /// `f_z`.
    z: Linear,
    /// `|f|²`.
    square: Linear,
}

impl Equation {
    fn new(arm: &mut Layout, point: &Point) -> Equation {
        let (square, z) = (point.square(arm), point.fz(arm));
        let (g, [cosine, sine]) = (&mut arm.g, arm.alpha[0]);
        let (a, d, r) = (arm.a[0], arm.d[1], point.r);
        // |r|² = |f|² + 2 d_2 f_z + d_2² + a_1² + 2 a_1 g_x.
        let twice = g.add(d, d);
        let lifted = z.scaled(g, twice, Expr::ZERO);
        let sum = Linear {
            by: [0, 1].map(|k| g.add(square.by[k], lifted.by[k])),
            constant: g.add(square.constant, lifted.constant),
        };
        let own = [g.mul(a, a), g.mul(d, d)];
        let own = g.add(own[0], own[1]);
        let reach = g.dot3(r, r);
        let rest = g.sub(reach, own);
        let double = g.add(a, a);
        let inverse = g.recip(double);
        let more = g.mul(inverse, rest);
        let x = sum.scaled(g, -inverse, more);
        // r_z = sin α_1 g_y + cos α_1 (f_z + d_2).
        let inverse = g.recip(sine);
        let slope = g.mul(cosine, inverse);
        let (height, own) = (g.mul(inverse, r[2]), g.mul(slope, d));
        let more = g.sub(height, own);
        let y = z.scaled(g, -slope, more);
        Equation { x, y, z, square }
    }

    /// Coefficients of the cosine's square, of half the product, and of the sine's square.
    fn squares(&self, g: &mut Graph) -> [Expr; 3] {
        [(0, 0), (0, 1), (1, 1)].map(|(k, l)| {
            [&self.x, &self.y, &self.z].into_iter().fold(Expr::ZERO, |sum, part| {
                let product = g.mul(part.by[k], part.by[l]);
                g.add(sum, product)
            })
        })
    }

    /// The same as a conic, of which the product is none.
    fn conic(&self, g: &mut Graph) -> Conic {
        let [cc, _, ss] = self.squares(g);
        let excess = g.sub(cc, ss);
        let inverse = g.recip(excess);
        let each = [&self.x, &self.y, &self.z];
        let [d, e] = [0, 1].map(|k| {
            let twice = each.into_iter().fold(Expr::ZERO, |sum, part| {
                let product = g.mul(part.constant, part.by[k]);
                g.add(sum, product)
            });
            let twice = g.add(twice, twice);
            let rest = g.sub(twice, self.square.by[k]);
            g.mul(inverse, rest)
        });
        let own = each.into_iter().fold(ss, |sum, part| {
            let square = g.mul(part.constant, part.constant);
            g.add(sum, square)
        });
        let rest = g.sub(own, self.square.constant);
        Conic { d, e, f: g.mul(inverse, rest) }
    }
}

/// `c² + d c + e s + f = 0`.
struct Conic {
    d: Expr,
    e: Expr,
    f: Expr,
}

impl Conic {
    /// The angles where it meets the circle; where it does not, those where lines come closest.
    fn angles(&self, g: &mut Graph) -> [Pair; 4] {
        let Conic { d, e, f } = *self;
        let m = self.degenerate(g);
        // (1 + m) (c + d/2(1 + m))² = −m (s + e/2m)²: lines with normals (α, ∓β) of length 1.
        let half = g.number(Number::ratio(1, 2));
        let first = g.add(Expr::ONE, m);
        let [alpha, beta] = [first, -m].map(|square| {
            let square = g.positive_part(square);
            g.sqrt(square)
        });
        let apart = |g: &mut Graph, by: Expr, root: Expr| {
            let (half_by, inverse) = (g.mul(half, by), g.recip(root));
            g.mul(half_by, inverse)
        };
        // That of the smaller of both follows from the larger's: its own is zero by zero where a conic is symmetric.
        let (by_d, by_e) = (apart(g, d, alpha), apart(g, e, beta));
        let difference = g.sub(f, m);
        let (square_d, square_e) = (g.mul(by_d, by_d), g.mul(by_e, by_e));
        let from_d = {
            let square = g.sub(square_d, difference);
            let square = g.positive_part(square);
            let root = g.sqrt(square);
            g.select(e, root, -root)
        };
        let from_e = {
            let square = g.add(square_e, difference);
            let square = g.positive_part(square);
            let root = g.sqrt(square);
            g.select(d, root, -root)
        };
        let larger = g.add(half, m);
        let k_d = g.select(larger, by_d, from_e);
        let k_e = g.select(larger, from_d, by_e);
        let (sum, rest) = (g.add(k_d, k_e), g.sub(k_e, k_d));
        let lines = [([alpha, -beta], -sum), ([alpha, beta], rest)];
        let [[a, b], [c, d]] = lines.map(|(normal, value)| {
            // An angle of a line that does not meet the circle stays where it comes closest: a step would lead to another's.
            let square = g.mul(value, value);
            let meets = g.sub(Expr::ONE, square);
            two_angles(g, normal, value, None).map(|angle| {
                let polished = self.polished(g, angle);
                [0, 1].map(|k| g.select(meets, polished[k], angle[k]))
            })
        });
        [a, b, c, d]
    }

    /// The `m` between −1 and 0 of which `c² + d c + e s + f + m (c² + s² − 1)` is two lines: a root of the cubic
    /// `4 (f − m) m (1 + m) − d² m − e² (1 + m)`, which is not negative at −1, nor positive at 0.
    ///
    /// It is the root on the one side of the inflection on which there is no other, by Laguerre's steps from the end of that
    /// side, which do not leave the interval.
    fn degenerate(&self, g: &mut Graph) -> Expr {
        let [dd, ee] = [self.d, self.e].map(|x| g.mul(x, x));
        let four = g.number(Number::integer(4));
        let scaled = g.mul(four, self.f);
        let second = g.sub(scaled, four);
        let first = g.sub(scaled, dd);
        let first = g.sub(first, ee);
        let horner = |g: &mut Graph, m: Expr, coefficients: &[Expr]| {
            coefficients.iter().fold(Expr::ZERO, |sum, next| {
                let product = g.mul(sum, m);
                g.add(product, *next)
            })
        };
        let value_of = [-four, second, first, -ee];
        let twelve = g.number(Number::integer(12));
        let slope_of = [-twelve, g.add(second, second), first];
        let twelfth = g.number(Number::ratio(1, 12));
        let inflection = g.mul(twelfth, second);
        let there = horner(g, inflection, &value_of);
        let (low, high) = (-Expr::ONE, Expr::ZERO);
        let inside = g.select(there, high, low);
        let above_low = g.add(inflection, Expr::ONE);
        let start = g.select(above_low, inside, high);
        let mut at = g.select(inflection, low, start);
        let [two, three] = [2, 3].map(|n| g.number(Number::integer(n)));
        let curvature_of = [-g.mul(two, twelve), g.add(second, second)];
        for _ in 0..STEPS {
            let value = horner(g, at, &value_of);
            let (slope, curvature) = (horner(g, at, &slope_of), horner(g, at, &curvature_of));
            let (square, product) = (g.mul(slope, slope), g.mul(value, curvature));
            let (square, product) = (g.mul(two, square), g.mul(three, product));
            let left = g.sub(square, product);
            let left = g.positive_part(left);
            let left = g.mul(two, left);
            let root = g.sqrt(left);
            // The cubic falls there; where it does not, the root is there but for rounding.
            let down = g.sub(root, slope);
            let safe = g.select(down, down, Expr::ONE);
            let inverse = g.recip(safe);
            let triple = g.mul(three, value);
            let by = g.mul(triple, inverse);
            let by = g.select(down, by, Expr::ZERO);
            at = g.add(at, by);
            at = g.select(at, high, at);
            let over = g.add(at, Expr::ONE);
            at = g.select(over, at, low);
        }
        at
    }

    /// A few of Newton's steps from an angle, shorter where the slope is none.
    fn polished(&self, g: &mut Graph, mut angle: Pair) -> Pair {
        let two = g.number(Number::integer(2));
        let four = g.number(Number::integer(4));
        for _ in 0..POLISHED {
            let [c, s] = angle;
            let inner = g.add(c, self.d);
            let (first, second) = (g.mul(c, inner), g.mul(self.e, s));
            let value = g.add(first, second);
            let value = g.add(value, self.f);
            let double = g.mul(two, c);
            let double = g.add(double, self.d);
            let (along, across) = (g.mul(self.e, c), g.mul(double, s));
            let slope = g.sub(along, across);
            let size = g.select(value, value, -value);
            let (square, damping) = (g.mul(slope, slope), g.mul(four, size));
            let inner = g.add(square, damping);
            // Nothing is divided by zero where the equation holds and has no slope.
            let inner = g.select(inner, inner, Expr::ONE);
            let inverse = g.recip(inner);
            let by = g.mul(value, slope);
            let by = g.mul(by, inverse);
            let (turned_c, turned_s) = (g.mul(by, s), g.mul(by, c));
            let direction = [g.add(c, turned_c), g.sub(s, turned_s)];
            (angle, _) = unit(g, direction);
        }
        angle
    }
}
