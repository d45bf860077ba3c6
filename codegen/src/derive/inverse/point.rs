//! The point that the joints behind the third only turn about, where it stands behind joint 3 and where it is to be.

use super::displacement::about_x;
use super::layout::Layout;
use super::subproblem::{Pair, square, turned};
use crate::expr::{Expr, Vec3};

/// What does not depend on the angles.
pub(super) struct Point {
    /// Where the wrist's point is to be, in the frame before joint 1.
    pub wrist: Vec3,
    /// The same from that frame moved by d_1.
    pub r: Vec3,
    /// The point in the frame that joint 3 turns; its third component less what d_3 moves.
    pub c: Pair,
    /// That component.
    pub cz: Expr,
    /// Component of the point along axis 3, d_3 included.
    pub uz: Expr,
}

impl Point {
    /// The point that so many joints behind the third only turn about: the tool's origin, or that beside it on axis 4, or
    /// where the axes meet.
    pub fn new(arm: &mut Layout, behind: usize) -> Point {
        let (wrist, c) = match behind {
            0 => (arm.tip, arm.lever),
            _ => {
                let (wrist, along) = match behind {
                    1 => (arm.beside_tip(), arm.g.add(arm.d[3], arm.lever[2])),
                    _ => (arm.before_last(), arm.d[3]),
                };
                let [cosine, sine] = arm.alpha[2];
                let (y, z) = (arm.g.mul(-sine, along), arm.g.mul(cosine, along));
                (wrist, [arm.a[2], y, z])
            }
        };
        let [x, y, z] = c;
        let r = [wrist[0], wrist[1], arm.g.sub(wrist[2], arm.d[0])];
        Point { wrist, r, c: [x, y], cz: z, uz: arm.g.add(z, arm.d[2]) }
    }
}

/// `a cos θ_3 + b sin θ_3 + constant`.
pub(super) struct Linear {
    pub by: Pair,
    pub constant: Expr,
}

impl Point {
    /// `f` at an angle of joint 3.
    pub fn f(&self, arm: &mut Layout, third: Pair) -> Vec3 {
        let g = &mut arm.g;
        let [x, y] = turned(g, third, self.c);
        let [x, y, z] = about_x(g, arm.alpha[1], [x, y, self.uz]);
        [g.add(arm.a[1], x), y, z]
    }

    /// Its third component, which no other angle changes.
    pub fn fz(&self, arm: &mut Layout) -> Linear {
        let (g, [cosine, sine], [x, y]) = (&mut arm.g, arm.alpha[1], self.c);
        Linear { by: [g.mul(sine, y), g.mul(sine, x)], constant: g.mul(cosine, self.uz) }
    }

    /// Its square.
    pub fn square(&self, arm: &mut Layout) -> Linear {
        let g = &mut arm.g;
        let twice = g.add(arm.a[1], arm.a[1]);
        let by = [g.mul(twice, self.c[0]), -g.mul(twice, self.c[1])];
        let (in_plane, own) = (square(g, self.c), square(g, [self.uz, arm.a[1]]));
        Linear { by, constant: g.add(in_plane, own) }
    }
}
