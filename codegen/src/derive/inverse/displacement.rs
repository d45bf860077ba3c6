//! Displacements of frames, and turns about the axes of the table.

use super::subproblem::{Pair, turned, turned_back};
use super::term::{Sheet, Term, Vector, dot, plus, times};
use crate::derive::chain::frame_rotation;
use crate::expr::Symbol;
use crate::robot::Frame;

/// A displacement: axes of the frame that it leads to, as columns, and its origin.
#[derive(Clone, Copy)]
pub(super) struct Displacement<'g> {
    pub axes: [Vector<'g>; 3],
    pub origin: Vector<'g>,
}

/// The pose that is asked for: input 0.
pub(super) fn target(sheet: &Sheet) -> Displacement<'_> {
    let column = |k: usize| {
        core::array::from_fn(|row| sheet.symbol(Symbol::Own { input: 0, entry: 3 * k + row }))
    };
    Displacement { axes: core::array::from_fn(column), origin: column(3) }
}

/// `Rx(−α) v`.
pub(super) fn about_x_back<'g>(alpha: Pair<'g>, [x, y, z]: Vector<'g>) -> Vector<'g> {
    let [y, z] = turned_back(alpha, [y, z]);
    [x, y, z]
}

/// `Rx(α) v`.
pub(super) fn about_x<'g>(alpha: Pair<'g>, [x, y, z]: Vector<'g>) -> Vector<'g> {
    let [y, z] = turned(alpha, [y, z]);
    [x, y, z]
}

/// `Rz(θ) v`.
pub(super) fn about_z<'g>(angle: Pair<'g>, [x, y, z]: Vector<'g>) -> Vector<'g> {
    let [x, y] = turned(angle, [x, y]);
    [x, y, z]
}

/// `Rz(−θ) v`.
pub(super) fn about_z_back<'g>(angle: Pair<'g>, [x, y, z]: Vector<'g>) -> Vector<'g> {
    let [x, y] = turned_back(angle, [x, y]);
    [x, y, z]
}

impl<'g> Displacement<'g> {
    /// Every column by a map of vectors.
    fn mapped(self, map: impl Fn(Vector<'g>) -> Vector<'g>) -> Self {
        Displacement { axes: self.axes.map(&map), origin: map(self.origin) }
    }

    /// `(Tx(a) Rx(α))⁻¹ self`.
    pub fn behind_link(mut self, (a, alpha): (Term<'g>, Pair<'g>)) -> Self {
        self.origin[0] = self.origin[0] - a;
        self.mapped(|v| about_x_back(alpha, v))
    }

    /// `self (Tx(a) Rx(α))⁻¹`.
    pub fn before_link(self, (a, [c, s]): (Term<'g>, Pair<'g>)) -> Self {
        let [x, y, z] = self.axes;
        let back = times(-a, x);
        let axes = [x, plus(times(c, y), times(-s, z)), plus(times(s, y), times(c, z))];
        Displacement { axes, origin: plus(self.origin, back) }
    }

    /// `(Rz(θ) Tz(d))⁻¹ self`.
    pub fn behind_joint(mut self, (angle, d): (Pair<'g>, Term<'g>)) -> Self {
        self.origin[2] = self.origin[2] - d;
        self.mapped(|v| about_z_back(angle, v))
    }

    /// `self (Rz(θ) Tz(d))⁻¹`.
    pub fn before_joint(self, ([c, s], d): (Pair<'g>, Term<'g>)) -> Self {
        let [x, y, z] = self.axes;
        let back = times(-d, z);
        let axes = [plus(times(c, x), times(-s, y)), plus(times(s, x), times(c, y)), z];
        Displacement { axes, origin: plus(self.origin, back) }
    }

    /// `F⁻¹ self`.
    pub fn after_inverse_of(self, sheet: &'g Sheet, frame: &Frame) -> Self {
        let (axes, translation) = constant(sheet, frame);
        let origin = plus(self.origin, translation.map(|length| -length));
        Displacement { origin, ..self }.mapped(|v| axes.map(|axis| dot(axis, v)))
    }

    /// `self F⁻¹`.
    pub fn before_inverse_of(self, sheet: &'g Sheet, frame: &Frame) -> Self {
        let (columns, translation) = constant(sheet, frame);
        // The columns of R Fᵀ are those of R by the rows of F.
        let axes: [Vector; 3] = core::array::from_fn(|k| {
            let [x, y, z]: [Vector; 3] =
                core::array::from_fn(|column| times(columns[column][k], self.axes[column]));
            plus(plus(x, y), z)
        });
        let lengths: [Vector; 3] = core::array::from_fn(|k| times(-translation[k], axes[k]));
        Displacement { axes, origin: lengths.into_iter().fold(self.origin, plus) }
    }

    /// `X self⁻¹ X` with `X` half a turn about x: the same chain from its other end.
    pub fn reversed(self) -> Self {
        let flip = |[x, y, z]: Vector<'g>| [x, -y, -z];
        let [x, y, z]: [Vector; 3] =
            core::array::from_fn(|k| core::array::from_fn(|row| self.axes[row][k]));
        let origin = self.axes.map(|axis| -dot(axis, self.origin));
        let axes = [flip(x), flip(y).map(|y| -y), flip(z).map(|z| -z)];
        Displacement { axes, origin: flip(origin) }
    }
}

/// Axes and origin of a frame of the table.
pub(super) fn constant<'g>(sheet: &'g Sheet, frame: &Frame) -> ([Vector<'g>; 3], Vector<'g>) {
    let axes = frame_rotation(frame).map(|column| column.map(|n| sheet.exact(n)));
    (axes, frame.translation.each_ref().map(|length| sheet.value(length)))
}
