//! The steps of a table and the orientation behind each of them.

use num_rational::Ratio;

use crate::expr::{Expr, Graph, Symbol, Turn, Vec3, negate3};
use crate::robot::{Angle, Convention, Motion, Robot, Value};

/// Steps of a row, whatever the convention: `Ry(beta)` is three, `Rz(π/2) Rx(beta) Rz(−π/2)`.
pub const ROW: usize = 7;

/// Which of a row's steps are those of theta, d, a and alpha.
pub fn entries(convention: Convention) -> [usize; 4] {
    match convention {
        Convention::Standard => [0, 1, 2, 3],
        Convention::Modified => [5, 6, 4, 0],
    }
}

/// Which of a row's steps turns by beta.
pub fn tilt(convention: Convention) -> usize {
    entries(convention)[3] + 2
}

/// An elementary transform.
#[derive(Clone, Debug)]
pub enum Step {
    RotateZ(Turn),
    TranslateZ(Expr),
    RotateX(Turn),
    TranslateX(Expr),
}

/// The orientation at a place of the chain: axes in the working frame, then a turn about z that is
/// only carried out when x or y is needed. Turns of parallel joints thus add up to one angle.
#[derive(Clone, Debug)]
pub struct Place {
    pub axes: [Vec3; 3],
    pub turn: Turn,
}

impl Place {
    /// The working frame itself.
    pub fn base() -> Place {
        let axis =
            |k: usize| core::array::from_fn(|row| if row == k { Expr::ONE } else { Expr::ZERO });
        Place { axes: core::array::from_fn(axis), turn: Turn::ZERO }
    }

    /// The orientation behind a step.
    pub fn after(&self, g: &mut Graph, step: &Step) -> Place {
        match step {
            Step::TranslateZ(_) | Step::TranslateX(_) => self.clone(),
            Step::RotateZ(turn) => Place { axes: self.axes, turn: self.turn.plus(g, turn) },
            Step::RotateX(turn) if turn.is_zero() => self.clone(),
            // Rz(t) Rx(pi) = Rx(pi) Rz(-t): antiparallel axes keep adding up, with the other sign.
            Step::RotateX(turn) if turn.is_half_turn() => {
                let [x, y, z] = self.axes;
                Place { axes: [x, negate3(y), negate3(z)], turn: self.turn.negated() }
            }
            Step::RotateX(turn) => {
                let [x, y, z] = self.clone().carried_out(g);
                let (s, c) = turn.sin_cos(g);
                let (y, z) = (g.combine3(c, y, s, z), g.combine3(-s, y, c, z));
                Place { axes: [x, y, z], turn: Turn::ZERO }
            }
        }
    }

    pub fn before(&self, g: &mut Graph, step: &Step) -> Place {
        match step {
            Step::RotateZ(turn) => self.after(g, &Step::RotateZ(turn.negated())),
            Step::RotateX(turn) => self.after(g, &Step::RotateX(turn.negated())),
            translation => self.after(g, translation),
        }
    }

    /// The same with its turn carried out if `now`.
    pub fn at_once(self, g: &mut Graph, now: bool) -> Place {
        if now { Place { axes: self.carried_out(g), turn: Turn::ZERO } } else { self }
    }

    /// A vector in the axes of this place, in the working frame.
    pub fn turned(&self, g: &mut Graph, v: Vec3) -> Vec3 {
        let [x, y, z] = v;
        let turn = self.turn.sin_cos(g);
        let [x, y] = g.turn2(turn, [x, y]);
        g.along3([x, y, z], self.axes)
    }

    /// The axes, the pending turn carried out.
    pub fn carried_out(self, g: &mut Graph) -> [Vec3; 3] {
        let [x, y, z] = self.axes;
        let (s, c) = self.turn.sin_cos(g);
        [g.combine3(c, x, s, y), g.combine3(-s, x, c, y), z]
    }
}

pub fn expression(g: &mut Graph, value: &Value) -> Expr {
    match value {
        Value::Number(n) => g.number(*n),
        Value::Symbol(name) => g.symbol(Symbol::Parameter(name.clone())),
    }
}

/// What all lengths are of those of the table.
pub fn growth(g: &mut Graph, robot: &Robot) -> Expr {
    if robot.beyond.grows() { g.symbol(Symbol::Growth) } else { Expr::ONE }
}

/// A length of the table as it is.
pub fn length(g: &mut Graph, robot: &Robot, value: &Value) -> Expr {
    let (length, growth) = (expression(g, value), growth(g, robot));
    g.mul(growth, length)
}

/// The steps of a row in the order of its convention.
pub fn row_steps(g: &mut Graph, robot: &Robot, row: usize) -> [Step; ROW] {
    let joint = &robot.joints[row];
    let mut theta = Turn::constant(g, &joint.theta);
    let mut d = length(g, robot, &joint.d);
    match joint.motion {
        Motion::Revolute => theta = Turn::joint(g, row).plus(g, &theta),
        Motion::Prismatic => {
            let q = g.symbol(Symbol::Joint(row));
            d = g.add(q, d);
        }
    }
    let a = Step::TranslateX(length(g, robot, &joint.a));
    let alpha = Step::RotateX(Turn::constant(g, &joint.alpha));
    let beta = Turn::constant(g, &joint.beta);
    let quarter = match joint.beta.is_zero() {
        true => Turn::ZERO,
        false => Turn::constant(g, &Angle::Pi(Ratio::new(1, 2))),
    };
    let back = Step::RotateZ(quarter.negated());
    let [turn, about, back] = [Step::RotateZ(quarter), Step::RotateX(beta), back];
    let (theta, d) = (Step::RotateZ(theta), Step::TranslateZ(d));
    match robot.convention {
        Convention::Standard => [theta, d, a, alpha, turn, about, back],
        Convention::Modified => [alpha, turn, about, back, a, theta, d],
    }
}
