//! Displacements of frames, and turns about the axes of the table.

use super::subproblem::{Pair, turned, turned_back};
use crate::derive::chain::{expression, frame_rotation};
use crate::expr::{Expr, Graph, Symbol, Vec3, negate3};
use crate::robot::Frame;

/// A displacement: axes of the frame that it leads to, as columns, and its origin.
#[derive(Clone, Copy)]
pub(super) struct Displacement {
    pub axes: [Vec3; 3],
    pub origin: Vec3,
}

/// The pose that is asked for: input 0.
pub(super) fn target(g: &mut Graph) -> Displacement {
    let mut column = |k: usize| {
        core::array::from_fn(|row| g.symbol(Symbol::Own { input: 0, entry: 3 * k + row }))
    };
    Displacement { axes: core::array::from_fn(&mut column), origin: column(3) }
}

/// `Rx(−α) v`.
pub(super) fn about_x_back(g: &mut Graph, alpha: Pair, [x, y, z]: Vec3) -> Vec3 {
    let [y, z] = turned_back(g, alpha, [y, z]);
    [x, y, z]
}

/// `Rx(α) v`.
pub(super) fn about_x(g: &mut Graph, alpha: Pair, [x, y, z]: Vec3) -> Vec3 {
    let [y, z] = turned(g, alpha, [y, z]);
    [x, y, z]
}

/// `Rz(θ) v`.
pub(super) fn about_z(g: &mut Graph, angle: Pair, [x, y, z]: Vec3) -> Vec3 {
    let [x, y] = turned(g, angle, [x, y]);
    [x, y, z]
}

/// `Rz(−θ) v`.
pub(super) fn about_z_back(g: &mut Graph, angle: Pair, [x, y, z]: Vec3) -> Vec3 {
    let [x, y] = turned_back(g, angle, [x, y]);
    [x, y, z]
}

impl Displacement {
    /// Every column by a map of vectors.
    fn mapped(self, g: &mut Graph, map: impl Fn(&mut Graph, Vec3) -> Vec3) -> Displacement {
        Displacement { axes: self.axes.map(|axis| map(g, axis)), origin: map(g, self.origin) }
    }

    /// `(Tx(a) Rx(α))⁻¹ self`.
    pub fn behind_link(mut self, g: &mut Graph, (a, alpha): (Expr, Pair)) -> Displacement {
        self.origin[0] = g.sub(self.origin[0], a);
        self.mapped(g, |g, v| about_x_back(g, alpha, v))
    }

    /// `self (Tx(a) Rx(α))⁻¹`.
    pub fn before_link(self, g: &mut Graph, (a, [c, s]): (Expr, Pair)) -> Displacement {
        let [x, y, z] = self.axes;
        let back = g.scale3(-a, x);
        let axes = [x, g.combine3(c, y, -s, z), g.combine3(s, y, c, z)];
        Displacement { axes, origin: g.add3(self.origin, back) }
    }

    /// `(Rz(θ) Tz(d))⁻¹ self`.
    pub fn behind_joint(mut self, g: &mut Graph, (angle, d): (Pair, Expr)) -> Displacement {
        self.origin[2] = g.sub(self.origin[2], d);
        self.mapped(g, |g, v| about_z_back(g, angle, v))
    }

    /// `self (Rz(θ) Tz(d))⁻¹`.
    pub fn before_joint(self, g: &mut Graph, ([c, s], d): (Pair, Expr)) -> Displacement {
        let [x, y, z] = self.axes;
        let back = g.scale3(-d, z);
        let axes = [g.combine3(c, x, -s, y), g.combine3(s, x, c, y), z];
        Displacement { axes, origin: g.add3(self.origin, back) }
    }

    /// `F⁻¹ self`.
    pub fn after_inverse_of(self, g: &mut Graph, frame: &Frame) -> Displacement {
        let (axes, translation) = constant(g, frame);
        let origin = g.add3(self.origin, negate3(translation));
        Displacement { origin, ..self }.mapped(g, |g, v| axes.map(|axis| g.dot3(axis, v)))
    }

    /// `self F⁻¹`.
    pub fn before_inverse_of(self, g: &mut Graph, frame: &Frame) -> Displacement {
        let (columns, translation) = constant(g, frame);
        // The columns of R Fᵀ are those of R by the rows of F.
        let row = |g: &mut Graph, k: usize| {
            let parts: [Vec3; 3] =
                core::array::from_fn(|column| g.scale3(columns[column][k], self.axes[column]));
            let sum = g.add3(parts[0], parts[1]);
            g.add3(sum, parts[2])
        };
        let axes = core::array::from_fn(|k| row(g, k));
        let lengths: [Vec3; 3] = core::array::from_fn(|k| g.scale3(-translation[k], axes[k]));
        let origin = lengths.into_iter().fold(self.origin, |sum, part| g.add3(sum, part));
        Displacement { axes, origin }
    }

    /// `X self⁻¹ X` with `X` half a turn about x: the same chain from its other end.
    pub fn reversed(self, g: &mut Graph) -> Displacement {
        let flip = |[x, y, z]: Vec3| [x, -y, -z];
        let axes = core::array::from_fn(|k| core::array::from_fn(|row| self.axes[row][k]));
        let [x, y, z]: [Vec3; 3] = axes;
        let origin = self.axes.map(|axis| -g.dot3(axis, self.origin));
        Displacement { axes: [flip(x), negate3(flip(y)), negate3(flip(z))], origin: flip(origin) }
    }
}

/// Axes and origin of a frame of the table.
pub(super) fn constant(g: &mut Graph, frame: &Frame) -> ([Vec3; 3], Vec3) {
    let axes = frame_rotation(frame).map(|column| column.map(|n| g.number(n)));
    (axes, frame.translation.each_ref().map(|length| expression(g, length)))
}
