//! Equations of one angle.

use crate::expr::{Expr, Graph};

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
    // (cos θ, sin θ) ∥ (a c ∓ b h, b c ± a h), h² = a² + b² − c², whose length is √((a² + b²)(c² + h²)).
    let most = square(g, [a, b]);
    let asked = g.mul(c, c);
    let left = g.sub(most, asked);
    let left = g.positive_part(left);
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
