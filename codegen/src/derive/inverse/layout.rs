//! The table as axes and what stands between them, from base to tip or from tip to base, and the target between the same.

use super::displacement::{Displacement, about_x, constant, target};
use super::subproblem::{Pair, turned_back};
use crate::derive::chain::expression;
use crate::expr::{Expr, Graph, Symbol, Turn, Vec3};
use crate::number::Number;
use crate::robot::{Angle, ClosedForm, Convention, Motion, Robot};

/// The part of a unit vector, or of the arm's size, that counts as none: an angle that only so much determines stays where
/// it was, and the pose is missed by at most twice that. It is 4096 units of rounding of a double, since the angles before
/// bring their own errors: with the wrist's point a thousandth of the arm's size from axis 1 those of a thousand units.
pub(super) const NOTHING: f64 = 4096.0 * f64::EPSILON;

/// Where a joint stands.
#[derive(Clone, Copy)]
pub(super) enum Value {
    /// The angle about its axis, the table's offset included.
    Turn(Pair),
    /// The displacement along its axis, the table's offset included, m.
    Slide(Expr),
}

/// The joints that a closed form finds, n of them.
pub(super) struct Layout {
    pub g: Graph,
    /// Length along x from each axis to the next, n − 1.
    pub a: Vec<Expr>,
    /// Angle about x from each axis to the next, n − 1.
    pub alpha: Vec<Pair>,
    /// Length along each axis, as the table has it.
    pub d: Vec<Expr>,
    /// The angles where a joint is free.
    pub near: Vec<Pair>,
    /// What is added to each joint value; of a prismatic joint the turn of its row.
    pub offsets: Vec<Pair>,
    /// `Z_1 L_1 … L_{n−1} Z_n`.
    pub target: Displacement,
    /// The tool's origin as the target has it, in the same frame.
    pub tip: Vec3,
    /// The tool's origin in the frame that `Z_n` leads to.
    pub lever: Vec3,
    /// Square of a length that is rounding.
    pub tiny: Expr,
    /// Square of the arm's size.
    pub size: Expr,
    reversed: bool,
    /// The joint whose value is given, and that value.
    given: Option<(usize, Expr)>,
}

impl Layout {
    pub fn new(robot: &Robot, form: ClosedForm) -> Layout {
        let mut g = Graph::new();
        for symbol in robot.symbols() {
            g.symbol(Symbol::Parameter(symbol.name));
        }
        let n = robot.dof();
        let rows: Vec<[Expr; 2]> = robot
            .joints
            .iter()
            .map(|row| [&row.a, &row.d].map(|v| expression(&mut g, v)))
            .collect();
        let twists: Vec<Pair> = robot.joints.iter().map(|row| pair(&mut g, &row.alpha)).collect();
        let first = usize::from(robot.convention == Convention::Modified);
        let links = first..first + n - 1;
        let mut a: Vec<Expr> = rows[links.clone()].iter().map(|row| row[0]).collect();
        let mut alpha: Vec<Pair> = twists[links].to_vec();
        let mut d: Vec<Expr> = rows.iter().map(|row| row[1]).collect();
        let mut offsets: Vec<Pair> =
            robot.joints.iter().map(|row| pair(&mut g, &row.theta)).collect();
        let mut near: Vec<Pair> = (0..n).map(|k| near(&mut g, robot, k)).collect();
        let (outer, inner) = match robot.convention {
            Convention::Standard => (None, Some((rows[n - 1][0], twists[n - 1]))),
            Convention::Modified => (Some((rows[0][0], twists[0])), None),
        };
        let mut target = target(&mut g);
        target = target.after_inverse_of(&mut g, &robot.base);
        if let Some((a, alpha)) = outer {
            target = target.behind_link(&mut g, (a, alpha));
        }
        let tip = target.origin;
        let (_, mut lever) = constant(&mut g, &robot.tool);
        target = target.before_inverse_of(&mut g, &robot.tool);
        if let Some((a, alpha)) = inner {
            target = target.before_link(&mut g, (a, alpha));
            lever = about_x(&mut g, alpha, lever);
            lever[0] = g.add(a, lever[0]);
        }
        let mut given = None;
        if let Some(joint) = form.given {
            let value = g.symbol(Symbol::Joint(joint));
            given = Some((joint, value));
            let along = match robot.joints[joint].motion {
                Motion::Revolute => d[joint],
                Motion::Prismatic => g.add(d[joint], value),
            };
            let joint_there = (near[joint], along);
            if joint == 0 {
                target = target.behind_joint(&mut g, joint_there);
                target = target.behind_link(&mut g, (a.remove(0), alpha.remove(0)));
            } else {
                target = target.before_joint(&mut g, joint_there);
                target = target.before_link(&mut g, (a.remove(n - 2), alpha.remove(n - 2)));
            }
            d.remove(joint);
            offsets.remove(joint);
            near.remove(joint);
        }
        if form.reversed {
            a.iter_mut().for_each(|length| *length = -*length);
            alpha.iter_mut().for_each(|[_, s]| *s = -*s);
            target = target.reversed(&mut g);
            a.reverse();
            alpha.reverse();
            d.reverse();
            near.reverse();
            offsets.reverse();
        }
        let mut size = a.iter().chain(&d).fold(Expr::ZERO, |sum, length| {
            let square = g.mul(*length, *length);
            g.add(sum, square)
        });
        if !form.is_of_six() {
            // Of an arm with a few lengths the tool's may be the longest.
            let square = g.dot3(lever, lever);
            size = g.add(size, square);
        }
        if robot.joints.iter().any(|joint| joint.motion == Motion::Prismatic) {
            // Prismatic joints have no length in the table.
            let square = g.dot3(target.origin, target.origin);
            size = g.add(size, square);
        }
        let nothing = g.number(Number::rounded(NOTHING * NOTHING));
        let tiny = g.mul(nothing, size);
        let reversed = form.reversed;
        Layout { g, a, alpha, d, near, offsets, target, tip, lever, tiny, size, reversed, given }
    }

    /// Origin of the target less d along its last axis: what does not move with the last joint.
    pub fn before_last(&mut self) -> Vec3 {
        let back = self.d.last().map_or(Expr::ZERO, |d| -*d);
        let back = self.g.scale3(back, self.target.axes[2]);
        self.g.add3(self.target.origin, back)
    }

    /// The point on the last axis beside the tool's origin, as the target has it.
    pub fn beside_tip(&mut self) -> Vec3 {
        let ([x, y, _], [lx, ly, _]) = (self.target.axes, self.lever);
        let off = self.g.combine3(-lx, x, -ly, y);
        self.g.add3(self.tip, off)
    }

    /// How a joint turns that stands so.
    pub fn turn(&self, joint: usize, value: Value) -> Pair {
        match value {
            Value::Turn(angle) => angle,
            Value::Slide(_) => self.offsets[joint],
        }
    }

    /// How far along its axis a joint stands.
    pub fn along(&self, joint: usize, value: Value) -> Expr {
        match value {
            Value::Turn(_) => self.d[joint],
            Value::Slide(along) => along,
        }
    }

    /// A point of the frame before joint 1 in that behind the last of these, and behind its link if there is one.
    pub fn peeled(&mut self, values: &[Value], target: Displacement) -> Displacement {
        let mut left = target;
        for (k, value) in values.iter().enumerate() {
            let joint = (self.turn(k, *value), self.along(k, *value));
            left = left.behind_joint(&mut self.g, joint);
            if let (Some(a), Some(alpha)) = (self.a.get(k), self.alpha.get(k)) {
                left = left.behind_link(&mut self.g, (*a, *alpha));
            }
        }
        left
    }

    /// How far the tool's origin is from the target's, m, and how far its axes are turned, twice the sine of half the angle.
    pub fn missed(&mut self, values: &[Value]) -> (Expr, Expr) {
        let Displacement { axes, origin } = self.peeled(values, self.target);
        let (g, lever) = (&mut self.g, self.lever);
        // Axes of the target in the tool's place: the identity where it is reached.
        let mut turned = Expr::ZERO;
        let mut off = origin;
        for (k, axis) in axes.into_iter().enumerate() {
            let mut by = axis;
            by[k] = g.sub(axis[k], Expr::ONE);
            let square = g.dot3(by, by);
            turned = g.add(turned, square);
            let part = g.scale3(lever[k], by);
            off = g.add3(off, part);
        }
        let half = g.number(Number::ratio(1, 2));
        let turned = g.mul(half, turned);
        let square = g.dot3(off, off);
        (g.sqrt(square), g.sqrt(turned))
    }

    /// The joint values of the robot where the joints of the closed form stand so.
    pub fn joint_values(&mut self, joints: &[Value]) -> Vec<Expr> {
        let mut values: Vec<Expr> = Vec::with_capacity(joints.len() + 1);
        for (k, value) in joints.iter().enumerate() {
            values.push(match *value {
                Value::Turn(angle) => {
                    let [cosine, sine] = turned_back(&mut self.g, self.offsets[k], angle);
                    self.g.atan2(sine, cosine)
                }
                Value::Slide(along) => self.g.sub(along, self.d[k]),
            });
        }
        if self.reversed {
            values.reverse();
        }
        if let Some((joint, value)) = self.given {
            values.insert(joint, value);
        }
        values
    }
}

/// The angle of a joint where it is free; of a prismatic one the turn of its row.
fn near(g: &mut Graph, robot: &Robot, k: usize) -> Pair {
    let joint = &robot.joints[k];
    let offset = Turn::constant(g, &joint.theta);
    let turn = match joint.motion {
        Motion::Revolute => Turn::joint(g, k).plus(g, &offset),
        Motion::Prismatic => offset,
    };
    let (sine, cosine) = turn.sin_cos(g);
    [cosine, sine]
}

fn pair(g: &mut Graph, angle: &Angle) -> Pair {
    let (sine, cosine) = Turn::constant(g, angle).sin_cos(g);
    [cosine, sine]
}
