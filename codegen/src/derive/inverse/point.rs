//! The point that the joints behind the third only turn about, where it stands behind joint 3 and where it is to be.

use super::layout::Layout;
use super::subproblem::{Pair, square, turned};
use super::term::{Term, Vector};

/// What does not depend on the angles.
pub(super) struct Point<'g> {
    /// Where the wrist's point is to be, in the frame before joint 1.
    pub wrist: Vector<'g>,
    /// The same from that frame moved by d_1.
    pub r: Vector<'g>,
    /// The point in the frame that joint 3 turns; its third component less what d_3 moves.
    pub c: Pair<'g>,
    /// That component.
    pub cz: Term<'g>,
    /// Component of the point along axis 3, d_3 included.
    pub uz: Term<'g>,
}

/// `a cos θ_3 + b sin θ_3 + constant`.
pub(super) struct Linear<'g> {
    pub by: Pair<'g>,
    pub constant: Term<'g>,
}

impl<'g> Point<'g> {
    /// The point that so many joints behind the third only turn about: the tool's origin, or that beside it on axis 4, or
    /// where the axes meet.
    pub fn new(arm: &Layout<'g>, behind: usize) -> Point<'g> {
        let (wrist, [x, y, z]) = match behind {
            0 => (arm.tip, arm.lever),
            _ => {
                let (wrist, along) = match behind {
                    1 => (arm.beside_tip(), arm.d[3] + arm.lever[2]),
                    _ => (arm.before_last(), arm.d[3]),
                };
                let [cosine, sine] = arm.alpha[2];
                (wrist, [arm.a[2], -sine * along, cosine * along])
            }
        };
        let r = [wrist[0], wrist[1], wrist[2] - arm.d[0]];
        Point { wrist, r, c: [x, y], cz: z, uz: z + arm.d[2] }
    }

    /// `f` at an angle of joint 3.
    pub fn f(&self, arm: &Layout<'g>, third: Pair<'g>) -> Vector<'g> {
        let [x, y] = turned(third, self.c);
        arm.link(1, [x, y, self.uz])
    }

    /// Its third component, which no other angle changes.
    pub fn fz(&self, arm: &Layout<'g>) -> Linear<'g> {
        let ([cosine, sine], [x, y]) = (arm.alpha[1], self.c);
        Linear { by: [sine * y, sine * x], constant: cosine * self.uz }
    }

    /// Its square.
    pub fn square(&self, arm: &Layout<'g>) -> Linear<'g> {
        let twice = arm.a[1] + arm.a[1];
        let by = [twice * self.c[0], -(twice * self.c[1])];
        Linear { by, constant: square(self.c) + square([self.uz, arm.a[1]]) }
    }

    /// The square of what of it is across axis 2, which is parallel to 3.
    pub fn square_across(&self, arm: &Layout<'g>) -> Linear<'g> {
        let Linear { by, constant } = self.square(arm);
        Linear { by, constant: constant - self.uz * self.uz }
    }
}
