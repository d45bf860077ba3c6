//! Equations of one angle.

use super::term::Term;
use crate::number::Number;

/// Cosine and sine of an angle, or two components in the plane that it turns.
pub(super) type Pair<'g> = [Term<'g>; 2];

/// `R(θ) v` in the plane.
pub(super) fn turned<'g>([c, s]: Pair<'g>, [x, y]: Pair<'g>) -> Pair<'g> {
    let [cx, sy, sx, cy] = [c * x, s * y, s * x, c * y];
    [cx - sy, sx + cy]
}

/// `R(−θ) v` in the plane.
pub(super) fn turned_back<'g>([c, s]: Pair<'g>, v: Pair<'g>) -> Pair<'g> {
    turned([c, -s], v)
}

/// `x² + y²`.
pub(super) fn square([x, y]: Pair<'_>) -> Term<'_> {
    x * x + y * y
}

/// Where an equation determines no angle: the angle to take, and the square of what counts as nothing.
#[derive(Clone, Copy)]
pub(super) struct Free<'g> {
    pub near: Pair<'g>,
    pub tiny: Term<'g>,
}

impl<'g> Free<'g> {
    pub fn or(self, length: Term<'g>, determined: Pair<'g>) -> Pair<'g> {
        let beyond = length - self.tiny;
        [0, 1].map(|k| beyond.select(determined[k], self.near[k]))
    }
}

/// A direction as a unit vector, and how long it was.
pub(super) fn unit(direction: Pair<'_>) -> (Pair<'_>, Term<'_>) {
    let length = square(direction).sqrt();
    let inverse = length.recip();
    (direction.map(|component| inverse * component), length)
}

/// The two angles with `a cos θ + b sin θ = c`; where there is none, twice that which comes closest. `free` is for an
/// equation whose coefficients can vanish.
pub(super) fn two_angles<'g>(by: Pair<'g>, c: Term<'g>, free: Option<Free<'g>>) -> [Pair<'g>; 2] {
    let (most, asked) = (square(by), c * c);
    let left = (most - asked).positive_part();
    about(by, c, (most, asked, left), free)
}

/// The same where the two are one if they are so within a part of `a² + b²`.
pub(super) fn two_angles_within<'g>(by: Pair<'g>, c: Term<'g>, part: Number) -> [Pair<'g>; 2] {
    let (most, asked) = (square(by), c * c);
    let left = above(most - asked, part, most);
    about(by, c, (most, asked, left), None)
}

/// What is more than a part of something, else nothing.
pub(super) fn above<'g>(left: Term<'g>, part: Number, of: Term<'g>) -> Term<'g> {
    let beyond = left - left.exact(part) * of;
    beyond.select(left, left.zero())
}

fn about<'g>(
    [a, b]: Pair<'g>,
    c: Term<'g>,
    (most, asked, left): (Term<'g>, Term<'g>, Term<'g>),
    free: Option<Free<'g>>,
) -> [Pair<'g>; 2] {
    // (cos θ, sin θ) ∥ (a c ∓ b h, b c ± a h), h² = a² + b² − c², whose length is √((a² + b²)(c² + h²)).
    let h = left.sqrt();
    let length = (most * (asked + left)).sqrt();
    let inverse = length.recip();
    [-h, h].map(|h| {
        let unit = turned([c, h], [a, b]).map(|component| inverse * component);
        free.map_or(unit, |free| free.or(length, unit))
    })
}

/// The angle that turns `from` into the direction of `to`.
pub(super) fn angle_between<'g>(from: Pair<'g>, to: Pair<'g>, free: Option<Free<'g>>) -> Pair<'g> {
    // (u + i v)⁻¹ (x + i y) ∥ (u − i v)(x + i y).
    let (unit, length) = unit(turned_back(from, to));
    free.map_or(unit, |free| free.or(length, unit))
}

/// The angle of the turn about z that is nearest to one whose first two columns these are, in the plane of the turn.
pub(super) fn nearest_turn<'g>([xx, xy]: Pair<'g>, [yx, yy]: Pair<'g>, free: Free<'g>) -> Pair<'g> {
    let direction = [xx + yy, xy - yx];
    angle_between([xx.one(), xx.zero()], direction, Some(free))
}

/// Where the line `p + t e` meets the circle of a radius about the origin, given by its square; where it misses the circle,
/// twice where it comes closest.
pub(super) fn on_circle<'g>(
    [px, py]: Pair<'g>,
    [ex, ey]: Pair<'g>,
    radius_squared: Term<'g>,
) -> [Term<'g>; 2] {
    // t |e|² = −p·e ± √(ρ² |e|² − (p × e)²).
    let length = square([ex, ey]);
    let along = px * ex + py * ey;
    let across = px * ey - py * ex;
    let left = radius_squared * length - across * across;
    let root = left.positive_part().sqrt();
    let inverse = length.recip();
    [-root, root].map(|root| inverse * (root - along))
}
