//! What a robot module computes: every output described once, for the printers, the textbook, the
//! command line and the tests.

mod side;
mod table;
mod traits;

pub use side::{Form, Side};
pub use table::{Output, has};

/// What a function is given besides the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Input {
    /// The joint values, base to tip: rad, m of a prismatic joint.
    Joints,
    /// Their rates: rad/s, m/s.
    Rates,
    /// Their accelerations: rad/s², m/s².
    Accelerations,
    /// The torques of the joints' motors: N·m, N of a prismatic joint.
    Torques,
    /// The wrench on the tool: force, moment; N, N·m; base axes, at the tool origin.
    Wrench,
}

impl Input {
    /// Every input, in the order of arguments.
    pub const EACH: [Input; 5] =
        [Input::Joints, Input::Rates, Input::Accelerations, Input::Torques, Input::Wrench];

    /// The argument's name in generated code.
    pub const fn name(self) -> &'static str {
        match self {
            Input::Joints => "q",
            Input::Rates => "qd",
            Input::Accelerations => "qdd",
            Input::Torques => "tau",
            Input::Wrench => "wrench",
        }
    }

    /// What it is and in which unit.
    pub const fn sentence(self) -> &'static str {
        match self {
            Input::Joints => "joint values, base to tip, in rad (prismatic joint: m)",
            Input::Rates => "their rates, in rad/s (prismatic joint: m/s)",
            Input::Accelerations => "their accelerations, in rad/s² (prismatic joint: m/s²)",
            Input::Torques => "torques of the joints' motors, in N·m (prismatic joint: N)",
            Input::Wrench => {
                "force and moment on the tool, in N and N·m, base axes, at the tool origin"
            }
        }
    }

    /// What its numbers stand for; how many there are is the side's [count](Side::count).
    pub const fn side(self) -> Side {
        match self {
            Input::Wrench => Side::Wrench,
            _ => Side::Joints,
        }
    }
}

/// What of an arm's file enters an output besides its rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Part {
    /// The fixed transform from the last frame to the tool.
    Tool,
    /// The stiffness of the joints.
    Stiffness,
    /// The elasticity of the links as beams.
    Beams,
    /// Gravity, the links' masses and the distributed weight of beams.
    Weights,
    /// The links' masses and moments of inertia, motors, gears and friction.
    Inertias,
}

impl Output {
    /// What its function is given beside the joint values, in the order of its arguments.
    pub fn beside(self) -> impl Iterator<Item = Input> {
        Input::EACH.into_iter().filter(move |input| *input != Input::Joints && self.takes(*input))
    }

    /// Whether its function takes `input`.
    pub fn takes(self, input: Input) -> bool {
        self.inputs().contains(&input)
    }

    /// How many numbers of the joints of an arm of `n` its function takes: the joint values, and behind them
    /// rates, accelerations and torques as it takes them, in the order of [`Input::EACH`], each base to tip.
    pub fn state(self, n: usize) -> usize {
        self.inputs().iter().filter(|input| input.side() == Side::Joints).count() * n
    }

    /// Whether `part` of the arm's file enters.
    pub fn depends_on(self, part: Part) -> bool {
        self.parts().contains(&part)
    }

    /// Rows and columns for an arm of `n` joints.
    pub const fn shape(self, n: usize) -> (usize, usize) {
        (self.rows().count(n), self.columns().count(n))
    }

    /// How its numbers are arranged.
    pub const fn form(self) -> Form {
        match self.columns() {
            Side::Frame => Form::Pose,
            Side::Frames => Form::Poses,
            Side::One => Form::Vector,
            Side::JointsByJoints | Side::WrenchByJoints => Form::Stack,
            _ => Form::Matrix,
        }
    }

    /// What the fused function `all` computes.
    pub const ALL: [Output; Output::fused()] = {
        let mut all = [Output::EACH[0]; Output::fused()];
        let (mut at, mut next) = (0, 0);
        while at < Output::EACH.len() {
            if Output::EACH[at].is_fused() {
                all[next] = Output::EACH[at];
                next += 1;
            }
            at += 1;
        }
        all
    };

    /// One value for each output, in the order of [`Output::EACH`], from tables that stand beside what
    /// they list. In a constant, an output that is in none of them or in two does not compile.
    ///
    /// # Panics
    /// If an output is in none of the tables, or twice.
    pub const fn one_each<T: Copy>(tables: &[&[(Output, T)]]) -> [T; Output::EACH.len()] {
        let mut found: [Option<T>; Output::EACH.len()] = [None; Output::EACH.len()];
        let mut table = 0;
        while table < tables.len() {
            let mut row = 0;
            while row < tables[table].len() {
                let (output, value) = tables[table][row];
                assert!(found[output as usize].is_none(), "an output is listed twice");
                found[output as usize] = Some(value);
                row += 1;
            }
            table += 1;
        }
        let mut all = [tables[0][0].1; Output::EACH.len()];
        let mut at = 0;
        while at < all.len() {
            all[at] = found[at].expect("an output is listed nowhere");
            at += 1;
        }
        all
    }

    const fn fused() -> usize {
        let (mut at, mut count) = (0, 0);
        while at < Output::EACH.len() {
            count += Output::EACH[at].is_fused() as usize;
            at += 1;
        }
        count
    }
}
