//! The table as axes and what stands between them, from base to tip or from tip to base, and the target between the same.

use super::subproblem::{Pair, turned, turned_back};
use crate::derive::chain::{expression, frame_rotation};
use crate::expr::{Expr, Graph, Symbol, Turn, Vec3, negate3};
use crate::number::Number;
use crate::robot::{Angle, Convention, Frame, Robot};

/// The part of a unit vector, or of the arm's size, that counts as none: an angle that only so much determines stays where
/// it was, and the pose is missed by at most twice that. It is 4096 units of rounding of a double, since the angles before
/// bring their own errors: with the wrist's point a thousandth of the arm's size from axis 1 those of a thousand units.
pub(super) const NOTHING: f64 = 4096.0 * f64::EPSILON;

/// A displacement: axes of the frame that it leads to, as columns, and its origin.
#[derive(Clone, Copy)]
pub(super) struct Displacement {
    pub axes: [Vec3; 3],
    pub origin: Vec3,
}

/// An arm of six revolute joints.
pub(super) struct Layout {
    pub g: Graph,
    /// Length along x from each axis to the next.
    pub a: [Expr; 5],
    /// Angle about x from each axis to the next.
    pub alpha: [Pair; 5],
    /// Length along each axis.
    pub d: [Expr; 6],
    /// The angles where a joint is free.
    pub near: [Pair; 6],
    /// What is added to each joint value.
    offsets: [Pair; 6],
    /// `Z_1 L_1 … L_5 Z_6`.
    pub target: Displacement,
    /// Square of a length that is rounding.
    pub tiny: Expr,
    /// Square of the arm's size.
    pub size: Expr,
    reversed: bool,
}

impl Layout {
    pub fn new(robot: &Robot, reversed: bool) -> Layout {
        let mut g = Graph::new();
        for symbol in robot.symbols() {
            g.symbol(Symbol::Parameter(symbol.name));
        }
        let rows: Vec<[Expr; 2]> = robot
            .joints
            .iter()
            .map(|row| [&row.a, &row.d].map(|v| expression(&mut g, v)))
            .collect();
        let twists: Vec<Pair> = robot.joints.iter().map(|row| pair(&mut g, &row.alpha)).collect();
        let first = usize::from(robot.convention == Convention::Modified);
        let mut a: [Expr; 5] = core::array::from_fn(|k| rows[first + k][0]);
        let mut alpha: [Pair; 5] = core::array::from_fn(|k| twists[first + k]);
        let mut d: [Expr; 6] = core::array::from_fn(|k| rows[k][1]);
        let mut offsets: [Pair; 6] = core::array::from_fn(|k| pair(&mut g, &robot.joints[k].theta));
        let mut near: [Pair; 6] = core::array::from_fn(|k| {
            let (joint, offset) =
                (Turn::joint(&mut g, k), Turn::constant(&mut g, &robot.joints[k].theta));
            let (sine, cosine) = joint.plus(&mut g, &offset).sin_cos(&mut g);
            [cosine, sine]
        });
        let (outer, inner) = match robot.convention {
            Convention::Standard => (None, Some((rows[5][0], twists[5]))),
            Convention::Modified => (Some((rows[0][0], twists[0])), None),
        };
        let mut target = target(&mut g);
        target = target.after_inverse_of(&mut g, &robot.base);
        if let Some((a, alpha)) = outer {
            target = target.mapped(&mut g, |g, v| about_x_back(g, alpha, v));
            target.origin[0] = g.sub(target.origin[0], a);
        }
        target = target.before_inverse_of(&mut g, &robot.tool);
        if let Some((a, [c, s])) = inner {
            let [x, y, z] = target.axes;
            let back = g.scale3(-a, x);
            // Right of the rest: L⁻¹ = Rx(−α) Tx(−a).
            let axes = [x, g.combine3(c, y, -s, z), g.combine3(s, y, c, z)];
            target = Displacement { axes, origin: g.add3(target.origin, back) };
        }
        if reversed {
            a = a.map(|length| -length);
            alpha = alpha.map(|[c, s]| [c, -s]);
            target = target.reversed(&mut g);
            a.reverse();
            alpha.reverse();
            d.reverse();
            near.reverse();
            offsets.reverse();
        }
        let size = a.iter().chain(&d).fold(Expr::ZERO, |sum, length| {
            let square = g.mul(*length, *length);
            g.add(sum, square)
        });
        let nothing = g.number(Number::rounded(NOTHING * NOTHING));
        let tiny = g.mul(nothing, size);
        Layout { g, a, alpha, d, near, offsets, target, tiny, size, reversed }
    }

    /// Origin of the target less d_6 along its last axis: what does not move with joint 6.
    pub fn before_last(&mut self) -> Vec3 {
        let back = self.g.scale3(-self.d[5], self.target.axes[2]);
        self.g.add3(self.target.origin, back)
    }

    /// The joint values of the robot with these angles of the chain.
    pub fn joint_values(&mut self, angles: [Pair; 6]) -> [Expr; 6] {
        let mut values = [Expr::ZERO; 6];
        for (k, angle) in angles.into_iter().enumerate() {
            let [cosine, sine] = turned_back(&mut self.g, self.offsets[k], angle);
            values[k] = self.g.atan2(sine, cosine);
        }
        if self.reversed {
            values.reverse();
        }
        values
    }
}

fn pair(g: &mut Graph, angle: &Angle) -> Pair {
    let (sine, cosine) = Turn::constant(g, angle).sin_cos(g);
    [cosine, sine]
}

/// The pose that is asked for: input 0.
fn target(g: &mut Graph) -> Displacement {
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

    /// `F⁻¹ self`.
    fn after_inverse_of(self, g: &mut Graph, frame: &Frame) -> Displacement {
        let (axes, translation) = constant(g, frame);
        let origin = g.add3(self.origin, negate3(translation));
        Displacement { origin, ..self }.mapped(g, |g, v| axes.map(|axis| g.dot3(axis, v)))
    }

    /// `self F⁻¹`.
    fn before_inverse_of(self, g: &mut Graph, frame: &Frame) -> Displacement {
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
    fn reversed(self, g: &mut Graph) -> Displacement {
        let flip = |[x, y, z]: Vec3| [x, -y, -z];
        let axes = core::array::from_fn(|k| core::array::from_fn(|row| self.axes[row][k]));
        let [x, y, z]: [Vec3; 3] = axes;
        let origin = self.axes.map(|axis| -g.dot3(axis, self.origin));
        Displacement { axes: [flip(x), negate3(flip(y)), negate3(flip(z))], origin: flip(origin) }
    }
}

fn constant(g: &mut Graph, frame: &Frame) -> ([Vec3; 3], Vec3) {
    let axes = frame_rotation(frame).map(|column| column.map(|n| g.number(n)));
    (axes, frame.translation.each_ref().map(|length| expression(g, length)))
}
