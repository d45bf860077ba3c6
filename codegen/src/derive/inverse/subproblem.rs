//! Equations of one angle.

use crate::expr::{Expr, Graph};
use crate::number::Number;

/// Cosine and sine of an angle, or two components in the plane that it turns.
pub(super) type Pair = [Expr; 2];

/// `R(θ) v` in the plane.
pub(super) fn turned(g: &mut Graph, [c, s]: Pair, v: Pair) -> Pair {
    g.turn2((s, c), v)
}

/// `R(−θ) v` in the plane.
pub(super) fn turned_back(g: &mut Graph, [c, s]: Pair, v: Pair) -> Pair {
    turned(g, [c, -s], v)
}

/// `x² + y²`.
pub(super) fn square(g: &mut Graph, [x, y]: Pair) -> Expr {
    let (x, y) = (g.mul(x, x), g.mul(y, y));
    g.add(x, y)
}

/// Where an equation determines no angle: the angle to take, and the square of what counts as nothing.
#[derive(Clone, Copy)]
pub(super) struct Free {
    pub near: Pair,
    pub tiny: Expr,
}

impl Free {
    fn or(self, g: &mut Graph, length: Expr, determined: Pair) -> Pair {
        let beyond = g.sub(length, self.tiny);
        [0, 1].map(|k| g.select(beyond, determined[k], self.near[k]))
    }
}

/// A direction as a unit vector, and how long it was.
pub(super) fn unit(g: &mut Graph, direction: Pair) -> (Pair, Expr) {
    let square = square(g, direction);
    let length = g.sqrt(square);
    let inverse = g.recip(length);
    (direction.map(|component| g.mul(inverse, component)), length)
}

/// The two angles with `a cos θ + b sin θ = c`; where there is none, twice that which comes closest. `free` is for an
/// equation whose coefficients can vanish.
pub(super) fn two_angles(g: &mut Graph, [a, b]: Pair, c: Expr, free: Option<Free>) -> [Pair; 2] {
    let most = square(g, [a, b]);
    let asked = g.mul(c, c);
    let left = g.sub(most, asked);
    let left = g.positive_part(left);
    about(g, [a, b], c, (most, asked, left), free)
}

/// The same where the two are one if they are so within a part of `a² + b²`.
pub(super) fn two_angles_within(g: &mut Graph, [a, b]: Pair, c: Expr, part: Number) -> [Pair; 2] {
    let most = square(g, [a, b]);
    let asked = g.mul(c, c);
    let left = g.sub(most, asked);
    let part = g.number(part);
    let none = g.mul(part, most);
    let beyond = g.sub(left, none);
    let left = g.select(beyond, left, Expr::ZERO);
    about(g, [a, b], c, (most, asked, left), None)
}

fn about(
    g: &mut Graph,
    [a, b]: Pair,
    c: Expr,
    (most, asked, left): (Expr, Expr, Expr),
    free: Option<Free>,
) -> [Pair; 2] {
    // (cos θ, sin θ) ∥ (a c ∓ b h, b c ± a h), h² = a² + b² − c², whose length is √((a² + b²)(c² + h²)).
    let h = g.sqrt(left);
    let reached = g.add(asked, left);
    let product = g.mul(most, reached);
    let length = g.sqrt(product);
    let inverse = g.recip(length);
    [-h, h].map(|h| {
        let direction = turned(g, [c, h], [a, b]);
        let unit = direction.map(|component| g.mul(inverse, component));
        free.map_or(unit, |free| free.or(g, length, unit))
    })
}

/// The angle that turns `from` into the direction of `to`.
pub(super) fn angle_between(g: &mut Graph, from: Pair, to: Pair, free: Option<Free>) -> Pair {
    // (u + i v)⁻¹ (x + i y) ∥ (u − i v)(x + i y).
    let direction = turned_back(g, from, to);
    let (unit, length) = unit(g, direction);
    free.map_or(unit, |free| free.or(g, length, unit))
}

/// The angle of the turn about z that is nearest to one whose first two columns these are, in the plane of the turn.
pub(super) fn nearest_turn(g: &mut Graph, [xx, xy]: Pair, [yx, yy]: Pair, free: Free) -> Pair {
    let direction = [g.add(xx, yy), g.sub(xy, yx)];
    angle_between(g, [Expr::ONE, Expr::ZERO], direction, Some(free))
}

/// Where the line `p + t e` meets the circle of a radius about the origin, given by its square; where it misses the circle,
/// twice where it comes closest.
pub(super) fn on_circle(g: &mut Graph, p: Pair, e: Pair, radius_squared: Expr) -> [Expr; 2] {
    // t |e|² = −p·e ± √(ρ² |e|² − (p × e)²).
    let [px, py] = p;
    let [ex, ey] = e;
    let length = square(g, e);
    let (x, y) = (g.mul(px, ex), g.mul(py, ey));
    let along = g.add(x, y);
    let (x, y) = (g.mul(px, ey), g.mul(py, ex));
    let across = g.sub(x, y);
    let (reach, across) = (g.mul(radius_squared, length), g.mul(across, across));
    let left = g.sub(reach, across);
    let left = g.positive_part(left);
    let root = g.sqrt(left);
    let inverse = g.recip(length);
    [-root, root].map(|root| {
        let t = g.sub(root, along);
        g.mul(inverse, t)
    })
}
