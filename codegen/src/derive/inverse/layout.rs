//! The table as axes and what stands between them, from base to tip or from tip to base, and the target between the same.

use super::displacement::{Displacement, about_x, about_x_back, constant, target};
use super::subproblem::{Pair, turned_back};
use super::term::{Sheet, Term, Vector, dot, plus, times};
use crate::expr::{Symbol, Turn};
use crate::number::Number;
use crate::robot::{ClosedForm, Convention, Motion, Robot};

/// The part of a unit vector, or of the arm's size, that counts as none: an angle that only so much determines stays where
/// it was, and the pose is missed by at most twice that. It is 4096 units of rounding of a double, since the angles before
/// bring their own errors: with the wrist's point a thousandth of the arm's size from axis 1 those of a thousand units.
pub(super) const NOTHING: f64 = 4096.0 * f64::EPSILON;

/// Where a joint stands.
#[derive(Clone, Copy)]
pub(super) enum Value<'g> {
    /// The angle about its axis, the table's offset included.
    Turn(Pair<'g>),
    /// The displacement along its axis, the table's offset included, m.
    Slide(Term<'g>),
}

/// The joints that a closed form finds, n of them.
pub(super) struct Layout<'g> {
    /// Length along x from each axis to the next, n − 1.
    pub a: Vec<Term<'g>>,
    /// Angle about x from each axis to the next, n − 1.
    pub alpha: Vec<Pair<'g>>,
    /// Length along each axis, as the table has it.
    pub d: Vec<Term<'g>>,
    /// The angles where a joint is free.
    pub near: Vec<Pair<'g>>,
    /// What is added to each joint value; of a prismatic joint the turn of its row.
    pub offsets: Vec<Pair<'g>>,
    /// `Z_1 L_1 … L_{n−1} Z_n`.
    pub target: Displacement<'g>,
    /// The tool's origin as the target has it, in the same frame.
    pub tip: Vector<'g>,
    /// The tool's origin in the frame that `Z_n` leads to.
    pub lever: Vector<'g>,
    /// Square of a length that is rounding.
    pub tiny: Term<'g>,
    /// Square of the arm's size.
    pub size: Term<'g>,
    reversed: bool,
    /// The joint whose value is given, and that value.
    given: Option<(usize, Term<'g>)>,
}

impl<'g> Layout<'g> {
    pub fn new(sheet: &'g Sheet, robot: &Robot, form: ClosedForm) -> Layout<'g> {
        for symbol in robot.symbols() {
            sheet.symbol(Symbol::Parameter(symbol.name));
        }
        let n = robot.dof();
        let rows = robot.joints.iter().map(|row| [&row.a, &row.d].map(|v| sheet.value(v)));
        let rows: Vec<[Term; 2]> = rows.collect();
        let pair = |turn: &Turn| {
            let (sine, cosine) = sheet.with(|g| turn.sin_cos(g));
            [sheet.term(cosine), sheet.term(sine)]
        };
        let constant_of = |angle| sheet.with(|g| Turn::constant(g, angle));
        let twists = robot.joints.iter().map(|row| pair(&constant_of(&row.alpha)));
        let twists: Vec<Pair> = twists.collect();
        let first = usize::from(robot.convention == Convention::Modified);
        let links = first..first + n - 1;
        let mut a: Vec<Term> = rows[links.clone()].iter().map(|row| row[0]).collect();
        let mut alpha: Vec<Pair> = twists[links].to_vec();
        let mut d: Vec<Term> = rows.iter().map(|row| row[1]).collect();
        let offsets = robot.joints.iter().map(|row| pair(&constant_of(&row.theta)));
        let mut offsets: Vec<Pair> = offsets.collect();
        // The angle of a joint where it is free; of a prismatic one the turn of its row.
        let near = robot.joints.iter().enumerate().map(|(k, row)| {
            let offset = constant_of(&row.theta);
            pair(&match row.motion {
                Motion::Revolute => sheet.with(|g| Turn::joint(g, k).plus(g, &offset)),
                Motion::Prismatic => offset,
            })
        });
        let mut near: Vec<Pair> = near.collect();
        let (outer, inner) = match robot.convention {
            Convention::Standard => (None, Some((rows[n - 1][0], twists[n - 1]))),
            Convention::Modified => (Some((rows[0][0], twists[0])), None),
        };
        let mut target = target(sheet).after_inverse_of(sheet, &robot.base);
        if let Some(link) = outer {
            target = target.behind_link(link);
        }
        let tip = target.origin;
        let (_, mut lever) = constant(sheet, &robot.tool);
        target = target.before_inverse_of(sheet, &robot.tool);
        if let Some((a, alpha)) = inner {
            target = target.before_link((a, alpha));
            lever = about_x(alpha, lever);
            lever[0] = a + lever[0];
        }
        let mut given = None;
        if let Some(joint) = form.given {
            let value = sheet.symbol(Symbol::Joint(joint));
            given = Some((joint, value));
            let along = match robot.joints[joint].motion {
                Motion::Revolute => d[joint],
                Motion::Prismatic => d[joint] + value,
            };
            let there = (near[joint], along);
            target = match joint {
                0 => target.behind_joint(there).behind_link((a.remove(0), alpha.remove(0))),
                _ => {
                    let link = (a.remove(n - 2), alpha.remove(n - 2));
                    target.before_joint(there).before_link(link)
                }
            };
            d.remove(joint);
            offsets.remove(joint);
            near.remove(joint);
        }
        if form.reversed {
            a.iter_mut().for_each(|length| *length = -*length);
            alpha.iter_mut().for_each(|[_, s]| *s = -*s);
            target = target.reversed();
            a.reverse();
            alpha.reverse();
            d.reverse();
            near.reverse();
            offsets.reverse();
        }
        let lengths = a.iter().chain(&d);
        let mut size = lengths.fold(tip[0].zero(), |sum, length| sum + *length * *length);
        if !form.is_of_six() {
            // Of an arm with a few lengths the tool's may be the longest.
            size = size + dot(lever, lever);
        }
        if robot.joints.iter().any(|joint| joint.motion == Motion::Prismatic) {
            // Prismatic joints have no length in the table.
            size = size + dot(target.origin, target.origin);
        }
        let tiny = sheet.exact(Number::rounded(NOTHING * NOTHING)) * size;
        let reversed = form.reversed;
        Layout { a, alpha, d, near, offsets, target, tip, lever, tiny, size, reversed, given }
    }

    /// `a x + Rx(α) v` of the link behind joint `k`, from 0.
    pub fn link(&self, k: usize, v: Vector<'g>) -> Vector<'g> {
        let [x, y, z] = about_x(self.alpha[k], v);
        [self.a[k] + x, y, z]
    }

    /// `Rx(−α) (v − a x)`.
    pub fn behind_link(&self, k: usize, [x, y, z]: Vector<'g>) -> Vector<'g> {
        about_x_back(self.alpha[k], [x - self.a[k], y, z])
    }

    /// Origin of the target less d along its last axis: what does not move with the last joint.
    pub fn before_last(&self) -> Vector<'g> {
        let back = self.d.last().map_or(self.tiny.zero(), |d| -*d);
        plus(self.target.origin, times(back, self.target.axes[2]))
    }

    /// The point on the last axis beside the tool's origin, as the target has it.
    pub fn beside_tip(&self) -> Vector<'g> {
        let ([x, y, _], [lx, ly, _]) = (self.target.axes, self.lever);
        plus(self.tip, plus(times(-lx, x), times(-ly, y)))
    }

    /// How a joint turns that stands so.
    pub fn turn(&self, joint: usize, value: Value<'g>) -> Pair<'g> {
        match value {
            Value::Turn(angle) => angle,
            Value::Slide(_) => self.offsets[joint],
        }
    }

    /// How far along its axis a joint stands.
    pub fn along(&self, joint: usize, value: Value<'g>) -> Term<'g> {
        match value {
            Value::Turn(_) => self.d[joint],
            Value::Slide(along) => along,
        }
    }

    /// How far the tool's origin is from the target's, m, and how far its axes are turned, twice the sine of half the angle.
    pub fn missed(&self, values: &[Value<'g>]) -> (Term<'g>, Term<'g>) {
        // The target in the frame behind the last of these joints.
        let mut left = self.target;
        for (k, value) in values.iter().enumerate() {
            left = left.behind_joint((self.turn(k, *value), self.along(k, *value)));
            if let (Some(a), Some(alpha)) = (self.a.get(k), self.alpha.get(k)) {
                left = left.behind_link((*a, *alpha));
            }
        }
        let Displacement { axes, origin } = left;
        let (mut turned, mut off) = (self.tiny.zero(), origin);
        // Axes of the target in the tool's place: the identity where it is reached.
        for (k, axis) in axes.into_iter().enumerate() {
            let mut by = axis;
            by[k] = axis[k] - axis[k].one();
            turned = turned + dot(by, by);
            off = plus(off, times(self.lever[k], by));
        }
        let turned = turned.exact(Number::ratio(1, 2)) * turned;
        (dot(off, off).sqrt(), turned.sqrt())
    }

    /// The joint values of the robot where the joints of the closed form stand so.
    pub fn joint_values(&self, joints: &[Value<'g>]) -> Vec<Term<'g>> {
        let value = |(k, value): (usize, &Value<'g>)| match *value {
            Value::Turn(angle) => {
                let [cosine, sine] = turned_back(self.offsets[k], angle);
                sine.atan2(cosine)
            }
            Value::Slide(along) => along - self.d[k],
        };
        let mut values: Vec<Term> = joints.iter().enumerate().map(value).collect();
        if self.reversed {
            values.reverse();
        }
        if let Some((joint, value)) = self.given {
            values.insert(joint, value);
        }
        values
    }
}
