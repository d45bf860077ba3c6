//! The chain: a table as a sequence of turns and slides about z and x, and the axes of every place
//! along it in the working frame.

use super::jacobian::Twist;
use super::passes::Passes;
use super::runs::{ByRun, by_run};
use crate::expr::{Expr, Graph, Symbol, Turn, Vec3, negate3};
use crate::number::Number;
use crate::robot::{Convention, Motion, Robot, Value};

/// Steps of a row, whatever the convention.
pub(super) const ROW: usize = 4;

/// An elementary transform. Slides do not rotate, turns do not move the origin.
#[derive(Clone, Debug)]
pub(super) enum Step {
    TurnZ(Turn),
    SlideZ(Expr),
    TurnX(Turn),
    SlideX(Expr),
}

/// The orientation at a place of the chain: axes in the working frame, then a turn about z that is
/// only carried out when x or y is needed. Turns of parallel joints thus add up to one angle.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub axes: [Vec3; 3],
    pub turn: Turn,
}

/// An arm laid out in one working frame.
pub(super) struct Chain<'r> {
    pub g: Graph,
    pub robot: &'r Robot,
    /// What may be done to save operations.
    pub passes: Passes,
    /// Boundary of the working frame.
    pub cut: usize,
    steps: Vec<Step>,
    /// Orientation before step `s`; one more than there are steps.
    places: Vec<Place>,
    /// The axes of places that were asked for.
    axes: Vec<Option<[Vec3; 3]>>,
    tool: [Vec3; 3],
    /// The joints' twists, once they were asked for.
    pub twists: Option<Vec<Twist>>,
    /// What was worked out run by run, where it is.
    by_run: Option<ByRun>,
}

impl<'r> Chain<'r> {
    /// Lays out the arm with the working frame at boundary `cut` (before step `cut`).
    pub fn new(robot: &'r Robot, cut: usize, passes: Passes) -> Self {
        let mut g = Graph::new();
        // In the order of the table, so that products of parameters look alike in every graph.
        for symbol in robot.symbols() {
            g.symbol(Symbol::Parameter(symbol.name));
        }
        let steps: Vec<Step> =
            (0..robot.dof()).flat_map(|row| row_steps(&mut g, robot, row)).collect();
        let mut places = vec![Place::base(); steps.len() + 1];
        for s in cut..steps.len() {
            places[s + 1] = places[s].after(&mut g, &steps[s]).at_once(&mut g, !passes.sums);
        }
        for s in (0..cut).rev() {
            places[s] = places[s + 1].before(&mut g, &steps[s]).at_once(&mut g, !passes.sums);
        }
        let axes = vec![None; places.len()];
        let tool = [[Expr::ZERO; 3]; 3];
        let (twists, by_run) = (None, None);
        let mut chain = Chain { g, robot, passes, cut, steps, places, axes, tool, twists, by_run };
        if passes.runs {
            chain.by_run = Some(self::by_run(&mut chain));
        }
        chain.tool = chain.turned_tool();
        // The tool's axes in base axes are Paul's n, o, a; in another frame they are not.
        chain.name_axes(if cut == 0 { ["n", "o", "a"] } else { ["xt", "yt", "zt"] });
        chain
    }

    /// Boundaries at which a working frame may lie: the base, and after every row's turns.
    pub fn cuts(robot: &Robot) -> Vec<usize> {
        let turns = match robot.convention {
            Convention::Standard => [1, 4],
            Convention::Modified => [1, 3],
        };
        let mut cuts = vec![0];
        cuts.extend((0..robot.dof()).flat_map(|row| turns.map(|t| ROW * row + t)));
        cuts
    }

    /// Number of joints.
    pub fn dof(&self) -> usize {
        self.robot.dof()
    }

    /// All steps, base to tip, the tool's transform not among them.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Index of the step that joint `row` moves.
    pub fn joint_step(&self, row: usize) -> usize {
        let offset = match (self.robot.convention, self.robot.joints[row].motion) {
            (Convention::Standard, Motion::Revolute) => 0,
            (Convention::Standard, Motion::Prismatic) => 1,
            (Convention::Modified, Motion::Revolute) => 2,
            (Convention::Modified, Motion::Prismatic) => 3,
        };
        ROW * row + offset
    }

    /// Whether joint `row` turns.
    pub fn revolute(&self, row: usize) -> bool {
        self.robot.joints[row].motion == Motion::Revolute
    }

    /// The joint's axis.
    pub fn joint_axis(&self, row: usize) -> Vec3 {
        match &self.by_run {
            Some(known) if self.revolute(row) => known.twists[row].1,
            Some(known) => known.twists[row].0,
            None => self.z(self.joint_step(row)),
        }
    }

    /// The joints' twists and the tool's origin, where they were worked out run by run.
    pub fn by_run(&self) -> Option<&ByRun> {
        self.by_run.as_ref()
    }

    /// The z axis before step `s`.
    pub fn z(&self, s: usize) -> Vec3 {
        self.places[s].axes[2]
    }

    /// All three axes before step `s`.
    pub fn axes(&mut self, s: usize) -> [Vec3; 3] {
        let known = self.axes[s];
        let axes = known.unwrap_or_else(|| self.places[s].clone().carried_out(&mut self.g));
        self.axes[s] = Some(axes);
        axes
    }

    /// Length and axis of the slide at step `s`; `None` if the step turns.
    pub fn slide(&mut self, s: usize) -> Option<(Expr, Vec3)> {
        match self.steps[s] {
            Step::SlideZ(length) => Some((length, self.z(s))),
            Step::SlideX(length) => Some((length, self.axes(s)[0])),
            Step::TurnZ(_) | Step::TurnX(_) => None,
        }
    }

    /// Axes of the tool.
    pub fn tool_axes(&self) -> [Vec3; 3] {
        self.tool
    }

    /// A vector of the working frame in base axes.
    pub fn in_base(&mut self, v: Vec3) -> Vec3 {
        let base = self.axes(0);
        base.map(|axis| self.g.dot3(axis, v))
    }

    /// A vector given in base axes, in the working frame.
    pub fn in_frame(&mut self, v: Vec3) -> Vec3 {
        let base = self.axes(0);
        let parts: [Vec3; 3] = core::array::from_fn(|k| self.g.scale3(v[k], base[k]));
        let sum = self.g.add3(parts[0], parts[1]);
        self.g.add3(sum, parts[2])
    }

    /// A cell of the table.
    pub fn value(&mut self, value: &Value) -> Expr {
        expression(&mut self.g, value)
    }

    /// Names the three components of a vector `prefix` + x, y, z.
    pub fn name3(&mut self, v: Vec3, prefix: &str) {
        for (component, axis) in v.into_iter().zip(["x", "y", "z"]) {
            self.g.name(component, || format!("{prefix}{axis}"));
        }
    }

    /// The tool's axes: its rotation vector turned by the last frame.
    fn turned_tool(&mut self) -> [Vec3; 3] {
        let last = self.steps.len();
        let rotation = &self.robot.tool.rotation;
        if rotation[0].is_zero() && rotation[1].is_zero() {
            let turn = Turn::constant(&mut self.g, &rotation[2]);
            let place = self.places[last].after(&mut self.g, &Step::TurnZ(turn));
            return place.carried_out(&mut self.g);
        }
        let matrix = super::parameters::tool_rotation(&self.robot.tool);
        self.turned(matrix, last)
    }

    /// The columns of a constant matrix given in the axes before step `s`.
    pub fn turned(&mut self, matrix: [[Number; 3]; 3], s: usize) -> [Vec3; 3] {
        let frame = self.axes(s);
        matrix.map(|column| {
            let parts: [Vec3; 3] = core::array::from_fn(|k| {
                let c = self.g.number(column[k]);
                self.g.scale3(c, frame[k])
            });
            let sum = self.g.add3(parts[0], parts[1]);
            self.g.add3(sum, parts[2])
        })
    }

    fn name_axes(&mut self, tool: [&str; 3]) {
        for row in 0..self.dof() {
            let z = self.joint_axis(row);
            self.name3(z, &format!("z{}", row + 1));
        }
        for (axis, name) in self.tool.into_iter().zip(tool) {
            self.name3(axis, name);
        }
    }
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
            Step::SlideZ(_) | Step::SlideX(_) => self.clone(),
            Step::TurnZ(turn) => Place { axes: self.axes, turn: self.turn.plus(g, turn) },
            Step::TurnX(turn) if turn.is_zero() => self.clone(),
            // Rz(t) Rx(pi) = Rx(pi) Rz(-t): antiparallel axes keep adding up, with the other sign.
            Step::TurnX(turn) if turn.is_half_turn() => {
                let [x, y, z] = self.axes;
                Place { axes: [x, negate3(y), negate3(z)], turn: self.turn.negated() }
            }
            Step::TurnX(turn) => {
                let [x, y, z] = self.clone().carried_out(g);
                let (s, c) = turn.sin_cos(g);
                let (y, z) = (g.combine3(c, y, s, z), g.combine3(-s, y, c, z));
                Place { axes: [x, y, z], turn: Turn::ZERO }
            }
        }
    }

    fn before(&self, g: &mut Graph, step: &Step) -> Place {
        match step {
            Step::TurnZ(turn) => self.after(g, &Step::TurnZ(turn.negated())),
            Step::TurnX(turn) => self.after(g, &Step::TurnX(turn.negated())),
            slide => self.after(g, slide),
        }
    }

    /// The same with its turn carried out if `now`.
    pub fn at_once(self, g: &mut Graph, now: bool) -> Place {
        if now { Place { axes: self.carried_out(g), turn: Turn::ZERO } } else { self }
    }

    /// A vector in the axes of this place, in the working frame.
    pub fn turned(&self, g: &mut Graph, v: Vec3) -> Vec3 {
        let (s, c) = self.turn.sin_cos(g);
        let [x, y, z] = v;
        let products = [(c, x), (s, y), (s, x), (c, y)].map(|(a, b)| g.mul(a, b));
        let (x, y) = (g.sub(products[0], products[1]), g.add(products[2], products[3]));
        let parts = [(x, 0), (y, 1), (z, 2)].map(|(part, k)| g.scale3(part, self.axes[k]));
        let sum = g.add3(parts[0], parts[1]);
        g.add3(sum, parts[2])
    }

    /// The axes, the pending turn carried out.
    pub fn carried_out(self, g: &mut Graph) -> [Vec3; 3] {
        let [x, y, z] = self.axes;
        let (s, c) = self.turn.sin_cos(g);
        [g.combine3(c, x, s, y), g.combine3(-s, x, c, y), z]
    }
}

pub(super) fn expression(g: &mut Graph, value: &Value) -> Expr {
    match value {
        Value::Number(n) => g.number(*n),
        Value::Symbol(name) => g.symbol(Symbol::Parameter(name.clone())),
    }
}

/// The four steps of a row in the order of its convention.
pub(super) fn row_steps(g: &mut Graph, robot: &Robot, row: usize) -> [Step; ROW] {
    let joint = &robot.joints[row];
    let mut theta = Turn::constant(g, &joint.theta);
    let mut d = expression(g, &joint.d);
    match joint.motion {
        Motion::Revolute => theta = Turn::joint(g, row).plus(g, &theta),
        Motion::Prismatic => {
            let q = g.symbol(Symbol::Joint(row));
            d = g.add(q, d);
        }
    }
    let a = Step::SlideX(expression(g, &joint.a));
    let alpha = Step::TurnX(Turn::constant(g, &joint.alpha));
    match robot.convention {
        Convention::Standard => [Step::TurnZ(theta), Step::SlideZ(d), a, alpha],
        Convention::Modified => [alpha, a, Step::TurnZ(theta), Step::SlideZ(d)],
    }
}
