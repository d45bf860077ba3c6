//! Moments of mass: all that the equations of motion know of a rigid body.

use crate::expr::{Expr, Graph, Turn, Vec3};
use crate::number::Number;

/// `∫ dm`, `∫ r dm` and `∫ r rᵀ dm` of a body, `r` from the origin of its link in that link's axes.
///
/// Of the second moments `S` the tensor of inertia is `tr(S) − S`. They are carried from one origin to another
/// more simply than it is, and a line of mass along an axis has one of them.
#[derive(Clone, Debug, Default)]
pub(super) struct Moments {
    pub mass: Expr,
    pub first: Vec3,
    /// Symmetric.
    pub second: [Vec3; 3],
}

impl Moments {
    /// A body's, by its centre and its second moments about it.
    pub fn body(g: &mut Graph, mass: Expr, centre: Vec3, own: [Vec3; 3]) -> Moments {
        let point = Moments { mass, first: [Expr::ZERO; 3], second: own };
        point.moved(g, centre)
    }

    /// The same body seen from an origin from which the old one is at `by`.
    pub fn moved(&self, g: &mut Graph, by: Vec3) -> Moments {
        let first = core::array::from_fn(|k| {
            let carried = g.mul(self.mass, by[k]);
            g.add(self.first[k], carried)
        });
        // (s + m p) pᵀ + p sᵀ
        let second = symmetric(|i, j| {
            let (far, near) = (g.mul(first[i], by[j]), g.mul(by[i], self.first[j]));
            let both = g.add(far, near);
            g.add(self.second[i][j], both)
        });
        Moments { mass: self.mass, first, second }
    }

    /// Both bodies as one.
    pub fn with(&self, g: &mut Graph, other: &Moments) -> Moments {
        Moments {
            mass: g.add(self.mass, other.mass),
            first: g.add3(self.first, other.first),
            second: symmetric(|i, j| g.add(self.second[i][j], other.second[i][j])),
        }
    }

    /// In the axes in which the body's own are turned about axis `k`.
    pub fn turned(&self, g: &mut Graph, turn: &Turn, k: usize) -> Moments {
        Moments {
            mass: self.mass,
            first: turned(g, turn, k, self.first),
            second: turned_matrix(g, turn, k, &self.second),
        }
    }

    /// In axes that are turned by half a turn about x.
    pub fn over(&self) -> Moments {
        let sign = |i: usize, x: Expr| x.signed(i > 0);
        Moments {
            mass: self.mass,
            first: core::array::from_fn(|i| sign(i, self.first[i])),
            second: symmetric(|i, j| sign(i, sign(j, self.second[i][j]))),
        }
    }

    /// Takes the part that lies on the link's z axis: it does not feel a turn about that axis, and belongs
    /// to the link before as much as to this one. What is left has no mass, its centre on the axis at the
    /// origin, and no second moment along the axis.
    pub fn take_axis(&mut self) -> Moments {
        let none = Expr::ZERO;
        let mut on_axis = Moments { mass: self.mass, ..Moments::default() };
        on_axis.first[2] = self.first[2];
        on_axis.second[2][2] = self.second[2][2];
        (self.mass, self.first[2], self.second[2][2]) = (none, none, none);
        on_axis
    }

    /// Takes the second moments: where a joint slides, the link before feels them as its own.
    pub fn take_second(&mut self) -> Moments {
        let second = core::mem::take(&mut self.second);
        Moments { second, ..Moments::default() }
    }
}

/// A symmetric matrix by the entries on and below its diagonal.
fn symmetric(mut entry: impl FnMut(usize, usize) -> Expr) -> [Vec3; 3] {
    let (xx, yx, yy) = (entry(0, 0), entry(1, 0), entry(1, 1));
    let (zx, zy, zz) = (entry(2, 0), entry(2, 1), entry(2, 2));
    [[xx, yx, zx], [yx, yy, zy], [zx, zy, zz]]
}

/// A vector of axes that are turned about axis `k`, in the axes before.
pub(super) fn turned(g: &mut Graph, turn: &Turn, k: usize, v: Vec3) -> Vec3 {
    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
    let turn = turn.sin_cos(g);
    let mut out = v;
    [out[i], out[j]] = g.turn2(turn, [v[i], v[j]]);
    out
}

/// `R D Rᵀ` of a turn about axis `k`. In the plane of the turn, with `h = s (D_ii − D_jj) + c (D_ij + D_ji)`:
/// `D_ii − s h`, `D_jj + s h`, `c h − D_ji` and `c h − D_ij`.
pub(super) fn turned_matrix(g: &mut Graph, turn: &Turn, k: usize, m: &[Vec3; 3]) -> [Vec3; 3] {
    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
    let (s, c) = turn.sin_cos(g);
    let two = g.number(Number::integer(2));
    let difference = g.sub(m[i][i], m[j][j]);
    let both = match m[i][j] == m[j][i] {
        true => g.mul(two, m[i][j]),
        false => g.add(m[i][j], m[j][i]),
    };
    let (across, along) = (g.mul(s, difference), g.mul(c, both));
    let h = g.add(across, along);
    let (sh, ch) = (g.mul(s, h), g.mul(c, h));
    // By quarters of a turn the sums are single entries.
    let (ii, jj, ij, ji) = match (s.is_zero(), c.is_zero()) {
        (true, _) => (m[i][i], m[j][j], m[i][j], m[j][i]),
        (_, true) => (m[j][j], m[i][i], -m[j][i], -m[i][j]),
        _ => (g.sub(m[i][i], sh), g.add(m[j][j], sh), g.sub(ch, m[j][i]), g.sub(ch, m[i][j])),
    };
    let mut all = [[Expr::ZERO; 3]; 3];
    all[k] = turned(g, turn, k, m[k]);
    let column = turned(g, turn, k, m.map(|row| row[k]));
    (all[i][k], all[j][k]) = (column[i], column[j]);
    (all[i][i], all[j][j], all[i][j], all[j][i]) = (ii, jj, ij, ji);
    all
}
