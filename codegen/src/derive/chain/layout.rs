//! The chain: a table as a sequence of rotations about and translations along z and x, and the axes of
//! every place along it in the working frame.

use super::place::{Place, ROW, Step, entries, expression, length, row_steps};
use super::tool::frame_rotation;
use crate::derive::passes::Passes;
use crate::expr::{Expr, Graph, Symbol, Turn, Twist, Vec3};
use crate::number::Number;
use crate::robot::{Angle, Convention, Motion, Robot, Value};

/// What is known of an arm whose twists were worked out run by run of parallel joints.
pub struct ByRun {
    /// The joints' twists in the working frame.
    pub twists: Vec<Twist>,
    /// The tool's origin from the working frame's.
    pub tip: Vec3,
}

/// An arm laid out in one working frame.
pub struct Chain<'r> {
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
        Chain { g, robot, passes, cut, steps, places, axes, tool, twists, by_run }
    }

    /// Turns the tool, whose axes are then known, and names all axes; `by_run` is what was worked out
    /// run by run, where it was.
    pub fn with_tool(mut self, by_run: Option<ByRun>) -> Self {
        self.by_run = by_run;
        self.tool = self.turned_tool();
        // The tool's axes in base axes are Paul's n, o, a; in another frame they are not.
        self.name_axes(if self.cut == 0 { ["n", "o", "a"] } else { ["xt", "yt", "zt"] });
        self
    }

    /// Boundaries at which a working frame may lie: the base, and after every row's rotations.
    pub fn cuts(robot: &Robot) -> Vec<usize> {
        let rotations = match robot.convention {
            Convention::Standard => [1, ROW],
            Convention::Modified => [4, 6],
        };
        let mut cuts = vec![0];
        cuts.extend((0..robot.dof()).flat_map(|row| rotations.map(|t| ROW * row + t)));
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
        let [theta, d, ..] = entries(self.robot.convention);
        ROW * row + if self.revolute(row) { theta } else { d }
    }

    /// Whether joint `row` is revolute.
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

    /// Length and axis of the translation at step `s`; `None` if the step is a rotation.
    pub fn translation(&mut self, s: usize) -> Option<(Expr, Vec3)> {
        match self.steps[s] {
            Step::TranslateZ(length) => Some((length, self.z(s))),
            Step::TranslateX(length) => Some((length, self.axes(s)[0])),
            Step::RotateZ(_) | Step::RotateX(_) => None,
        }
    }

    /// The two translations of a row: (step of the translation along z, step of the translation along x).
    pub fn row_translations(&self, row: usize) -> (usize, usize) {
        let [_, d, a, _] = entries(self.robot.convention);
        (ROW * row + d, ROW * row + a)
    }

    /// Axes of the tool.
    pub fn tool_axes(&self) -> [Vec3; 3] {
        self.tool
    }

    /// A vector of the working frame in base axes, or in the world's where the base is turned in it.
    pub fn in_base(&mut self, v: Vec3) -> Vec3 {
        let base = self.axes(0);
        let own = base.map(|axis| self.g.dot3(axis, v));
        let Some(world) = self.base_axes() else { return own };
        self.g.along3(own, world)
    }

    /// A twist, as [vectors](Chain::in_base).
    pub fn twist_in_base(&mut self, (v, w): Twist) -> Twist {
        (self.in_base(v), self.in_base(w))
    }

    /// A place told from the base, told from the world in which the base stands.
    pub fn in_world(&mut self, place: Vec3) -> Vec3 {
        let base = self.robot.base.translation.each_ref().map(|length| self.value(length));
        self.g.add3(base, place)
    }

    /// A vector given in these axes, in the working frame.
    pub fn in_frame(&mut self, v: Vec3) -> Vec3 {
        let own = match self.base_axes() {
            Some(world) => world.map(|axis| self.g.dot3(axis, v)),
            None => v,
        };
        self.of_base(own)
    }

    /// The axes of the base in the world; `None` where they are the world's.
    fn base_axes(&mut self) -> Option<[Vec3; 3]> {
        let base = &self.robot.base;
        let turned = !base.rotation.iter().all(Angle::is_zero);
        turned.then(|| frame_rotation(base).map(|column| column.map(|n| self.g.number(n))))
    }

    /// A vector given in the base's own axes, in the working frame.
    pub fn of_base(&mut self, v: Vec3) -> Vec3 {
        let base = self.axes(0);
        self.g.along3(v, base)
    }

    /// A cell of the table.
    pub fn value(&mut self, value: &Value) -> Expr {
        expression(&mut self.g, value)
    }

    /// The tool's origin in the last frame.
    pub fn tool_lengths(&mut self) -> Vec3 {
        let robot = self.robot;
        robot.tool.translation.each_ref().map(|offset| length(&mut self.g, robot, offset))
    }

    /// The tool's axes: its rotation vector turned by the last frame.
    fn turned_tool(&mut self) -> [Vec3; 3] {
        let last = self.steps.len();
        let rotation = &self.robot.tool.rotation;
        if rotation[0].is_zero() && rotation[1].is_zero() {
            let turn = Turn::constant(&mut self.g, &rotation[2]);
            let place = self.places[last].after(&mut self.g, &Step::RotateZ(turn));
            return place.carried_out(&mut self.g);
        }
        let matrix = frame_rotation(&self.robot.tool);
        self.turned(matrix, last)
    }

    /// The columns of a constant matrix given in the axes before step `s`.
    pub fn turned(&mut self, matrix: [[Number; 3]; 3], s: usize) -> [Vec3; 3] {
        let frame = self.axes(s);
        matrix.map(|column| {
            let column = column.map(|c| self.g.number(c));
            self.g.along3(column, frame)
        })
    }

    fn name_axes(&mut self, tool: [&str; 3]) {
        for row in 0..self.dof() {
            let z = self.joint_axis(row);
            self.g.name3(z, &format!("z{}", row + 1));
        }
        for (axis, name) in self.tool.into_iter().zip(tool) {
            self.g.name3(axis, name);
        }
    }
}
