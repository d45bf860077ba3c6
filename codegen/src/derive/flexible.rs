//! Flexible kinematics: a displacement `E_i` at every place of the chain (Jweeg & Al-Khafaji 2012,
//! eq. 20), as closed forms of any table:
//!
//! ```text
//! T = E_0 · A_1(q_1) E_1 · A_2(q_2) E_2 · … · A_n(q_n) E_n · T_tool E_tool
//! E = T(δx, δy, δz) Rz(dφ) Ry(dβ) Rx(dψ)
//! ```

use num_rational::Ratio;
use stiffarm_kernels::Output;

use super::chain::{Place, Step, expression, frame_rotation, row_steps};
use super::displacements::Displacements;
use super::own::Held;
use super::program::{Block, Program};
use super::readings::Readings;
use crate::expr::{Expr, Graph, Symbol, Turn, Vec3};
use crate::robot::{Angle, Frame, Robot};

/// How the displacements enter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Eq. 20 with eq. 18: products of transforms.
    Exact,
    /// Eq. 20 with eq. 19, as published (eqs. 57 and 58): sines are angles and cosines are 1 in
    /// each `E_i`, and the products between places are kept. What it gives is not quite a rotation.
    Published,
    /// The strict first order: every product of two displacements is left out.
    FirstOrder,
}

impl Form {
    /// Every form.
    pub const EACH: [Form; 3] = [Form::Exact, Form::Published, Form::FirstOrder];

    /// Its name, as functions and titles bear it.
    pub fn name(self) -> &'static str {
        match self {
            Form::Exact => "exact",
            Form::Published => "published",
            Form::FirstOrder => "first_order",
        }
    }
}

/// The pose of the displaced tool, base axes: a single block like [`Output::Pose`].
pub fn flexible(robot: &Robot, displacements: &Displacements, form: Form) -> Program {
    let mut walk = Walk::new(robot, displacements, form);
    let n = robot.dof();
    walk.frame(&robot.base);
    walk.displace(0);
    for row in 0..n {
        for step in row_steps(&mut walk.g, robot, row) {
            walk.step(&step);
        }
        walk.displace(row + 1);
    }
    walk.frame(&robot.tool);
    walk.displace(n + 1);
    let entries = walk.pose();
    let blocks = vec![Block { held: Held::Output(Output::Pose), entries }];
    let readings = Readings::of(robot);
    Program { graph: walk.g, blocks, solves: Vec::new(), cut: 0, dof: n, readings, own: None }
}

/// A displacement of the strict first order: where the chain stood, and by how much it turned.
struct Turned {
    /// Translations made before it.
    before: usize,
    shift: Vec3,
    turn: Vec3,
}

/// The way from the base to the tool.
struct Walk<'d> {
    g: Graph,
    displacements: &'d Displacements,
    form: Form,
    place: Place,
    /// Translations since the last turn, along the present axes.
    local: Vec3,
    /// Translations made so far, base axes.
    path: Vec<Vec3>,
    /// Displacements of the strict first order.
    turned: Vec<Turned>,
}

impl<'d> Walk<'d> {
    fn new(robot: &Robot, displacements: &'d Displacements, form: Form) -> Self {
        let mut g = Graph::new();
        for symbol in robot.symbols() {
            g.symbol(Symbol::Parameter(symbol.name));
        }
        let (place, local) = (Place::base(), [Expr::ZERO; 3]);
        Walk { g, displacements, form, place, local, path: Vec::new(), turned: Vec::new() }
    }

    fn step(&mut self, step: &Step) {
        match step {
            Step::TranslateX(length) => self.local[0] = self.g.add(self.local[0], *length),
            Step::TranslateZ(length) => self.local[2] = self.g.add(self.local[2], *length),
            Step::RotateZ(turn) | Step::RotateX(turn) if turn.is_zero() => {}
            turn => {
                self.translate();
                self.place = self.place.after(&mut self.g, turn);
            }
        }
    }

    /// Makes the translations that are pending.
    fn translate(&mut self) {
        if self.local.iter().any(|length| !length.is_zero()) {
            let local = core::mem::replace(&mut self.local, [Expr::ZERO; 3]);
            let translation = self.in_base(local);
            self.path.push(translation);
        }
    }

    fn axes(&mut self) -> [Vec3; 3] {
        self.place.clone().carried_out(&mut self.g)
    }

    /// A vector of the present frame in base axes.
    fn in_base(&mut self, v: Vec3) -> Vec3 {
        let axes = self.axes();
        self.g.along3(v, axes)
    }

    /// `E` at a place.
    fn displace(&mut self, place: usize) {
        let component = |walk: &mut Self, component: usize| {
            let kept = walk.displacements.has(place, component);
            let symbol = Symbol::Displacement { place, component };
            if kept { walk.g.symbol(symbol) } else { Expr::ZERO }
        };
        let shift: Vec3 = core::array::from_fn(|k| component(self, k));
        let turn: Vec3 = core::array::from_fn(|k| component(self, 3 + k));
        if self.form == Form::FirstOrder {
            self.translate();
            let (shift, turn) = (self.in_base(shift), self.in_base(turn));
            return self.turned.push(Turned { before: self.path.len(), shift, turn });
        }
        self.local = self.g.add3(self.local, shift);
        let still = turn.iter().all(|angle| angle.is_zero());
        match self.form {
            _ if still => {}
            Form::Exact => self.roll_pitch_yaw(turn),
            _ => {
                let [psi, beta, phi] = turn;
                self.multiply([
                    [Expr::ONE, phi, -beta],
                    [-phi, Expr::ONE, psi],
                    [beta, -psi, Expr::ONE],
                ]);
            }
        }
    }

    /// `Rz(φ) Ry(β) Rx(ψ)`; a turn about y is one about x, seen from a frame a quarter turn on.
    fn roll_pitch_yaw(&mut self, [psi, beta, phi]: Vec3) {
        let quarter = Turn::constant(&mut self.g, &Angle::Pi(Ratio::new(1, 2)));
        self.step(&Step::RotateZ(Turn::variable(phi)));
        if !beta.is_zero() {
            self.step(&Step::RotateZ(quarter.clone()));
            self.step(&Step::RotateX(Turn::variable(beta)));
            self.step(&Step::RotateZ(quarter.negated()));
        }
        self.step(&Step::RotateX(Turn::variable(psi)));
    }

    /// Goes on with the axes times a matrix given by columns.
    fn multiply(&mut self, columns: [Vec3; 3]) {
        self.translate();
        let axes = columns.map(|column| self.in_base(column));
        self.place = Place { axes, turn: Turn::ZERO };
    }

    /// A fixed transform.
    fn frame(&mut self, frame: &Frame) {
        let shift = frame.translation.each_ref().map(|value| expression(&mut self.g, value));
        self.local = self.g.add3(self.local, shift);
        let [x, y, z] = &frame.rotation;
        if x.is_zero() && y.is_zero() {
            let turn = Turn::constant(&mut self.g, z);
            return self.step(&Step::RotateZ(turn));
        }
        let columns = frame_rotation(frame).map(|column| column.map(|n| self.g.number(n)));
        self.multiply(columns);
    }

    /// Columns x, y, z and origin of the tool.
    fn pose(&mut self) -> Vec<Expr> {
        self.translate();
        let mut axes = self.axes();
        // The way from each point of the path to the tool, summed from the tool.
        let mut ahead = vec![[Expr::ZERO; 3]; self.path.len() + 1];
        for at in (0..self.path.len()).rev() {
            ahead[at] = self.g.add3(self.path[at], ahead[at + 1]);
        }
        let mut origin = ahead[0];
        let mut omega = [Expr::ZERO; 3];
        for Turned { before, shift, turn } in core::mem::take(&mut self.turned) {
            let swung = self.g.cross3(turn, ahead[before]);
            let moved = self.g.add3(shift, swung);
            origin = self.g.add3(origin, moved);
            omega = self.g.add3(omega, turn);
        }
        axes = axes.map(|axis| {
            let swung = self.g.cross3(omega, axis);
            self.g.add3(axis, swung)
        });
        axes.into_iter().flatten().chain(origin).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn planar() -> Robot {
        let text = "name = 'two'\nconvention = 'standard'\n\
            [[joint]]\ntype = 'revolute'\na = 'a1'\n[[joint]]\ntype = 'revolute'\na = 'a2'\n";
        Robot::from_toml(text, "two.toml").unwrap().0
    }

    fn value(symbol: &Symbol) -> f64 {
        match symbol {
            Symbol::Joint(k) => 0.4 + 0.7 * *k as f64,
            Symbol::Parameter(name) => {
                if name == "a1" {
                    0.5
                } else {
                    0.3
                }
            }
            Symbol::Displacement { place, component } => {
                0.01 * (1.0 + *place as f64) - 0.003 * *component as f64
            }
            _ => f64::NAN,
        }
    }

    /// The compact form: parallel axes and turns about them are one angle.
    #[test]
    fn two_links_in_the_plane_are_two_angles() {
        let kept = Displacements::read("dx, dy, dphi1", 2).unwrap();
        let program = flexible(&planar(), &kept, Form::Exact);
        let found = program.graph.evaluate(&program.blocks[0].entries, value);
        let e = |place: usize, component| value(&Symbol::Displacement { place, component });
        let (t1, t2) = (0.4, 0.4 + 0.4 + 0.7 + e(1, 5));
        let x = f64::cos(t1) * (0.5 + e(1, 0)) - f64::sin(t1) * e(1, 1)
            + f64::cos(t2) * (0.3 + e(2, 0))
            - f64::sin(t2) * e(2, 1);
        assert!((found[9] - x).abs() < 1e-15, "{} {x}", found[9]);
        assert!((found[0] - f64::cos(t2)).abs() < 1e-15);
        assert_eq!(program.ops().sin_cos, 2);
        assert!(program.blocks[0].entries[2].is_zero() && program.blocks[0].entries[11].is_zero());
    }

    /// Scaled displacements: `Published` and `FirstOrder` are exact to the first order, and the
    /// latter has none of the second.
    #[test]
    fn the_forms_agree_to_the_first_order() {
        let robot = planar();
        let at = |form, scale: f64| {
            let program = flexible(&robot, &Displacements::all(2), form);
            program.graph.evaluate(&program.blocks[0].entries, |s| match s {
                Symbol::Displacement { .. } => scale * value(s),
                other => value(other),
            })
        };
        let gap = |form, scale| {
            let (a, b) = (at(form, scale), at(Form::Exact, scale));
            a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        for form in [Form::Published, Form::FirstOrder] {
            assert!(gap(form, 0.0) < 1e-15);
            let ratio = gap(form, 1e-2) / gap(form, 1e-3);
            assert!((95.0..105.0).contains(&ratio), "{form:?} {ratio}");
        }
        let (none, one, two) =
            (at(Form::FirstOrder, 0.0), at(Form::FirstOrder, 1.0), at(Form::FirstOrder, 2.0));
        for k in 0..12 {
            assert!((two[k] - 2.0 * one[k] + none[k]).abs() < 1e-15);
        }
    }
}
