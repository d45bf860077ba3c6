//! Comparing kernels with the textbook.

use stiffarm::kernels::generic::Arm;
pub use stiffarm::kernels::parity::scale::{
    CANCELLED, CANCELLED_SINGLE as CANCELLED_F32, deviation as relative, terms,
};
use stiffarm::kernels::{Kernels, Output, Scalar};
use stiffarm_codegen::robot::Robot;
pub use stiffarm_draws::Draws;
use stiffarm_robots::ARMS;

/// Numbers for the parameters of a symbolic arm: as its struct, by name, and for any scalar.
macro_rules! parameters {
    (
        pub const $set:ident: $($ty:ident)::+<f64> = { $($name:ident: $value:expr),* $(,)? };
        pub fn $lookup:ident;
    ) => {
        pub const $set: $($ty)::+<f64> = $($ty)::+ { $($name: $value),* };

        pub fn $lookup(name: &str) -> Option<f64> {
            [$((stringify!($name), $value)),*].into_iter().find(|(n, _)| *n == name).map(|(_, x)| x)
        }

        #[allow(dead_code)]
        pub fn parameters_as<S>(cast: impl Fn(f64) -> S) -> $($ty)::+<S> {
            $($ty)::+ { $($name: cast($value)),* }
        }
    };
}

/// The table of a robot file in numbers, and what the textbook makes of it.
pub fn read(text: &str, name: &str) -> (Robot, Arm) {
    let (robot, warnings) = Robot::from_toml(text, name).expect("the file is valid");
    assert!(warnings.is_empty(), "{warnings:?}");
    let arm = stiffarm_gap::robot::arm(&robot).expect("every parameter has a number");
    (robot, arm)
}

/// The same of an arm of the collection.
pub fn known(id: &str) -> (Robot, Arm) {
    read(stiffarm_robots::arm(id).expect("in the collection").toml, id)
}

/// The same of every arm of the collection.
pub fn collection() -> impl Iterator<Item = (&'static stiffarm_robots::Arm, Robot, Arm)> {
    ARMS.iter().map(|entry| {
        let (robot, arm) = known(entry.id);
        (entry, robot, arm)
    })
}

/// Compares every output with the textbook, at so many states.
pub fn agrees(name: &str, arm: &Arm, kernels: &dyn Kernels<f64>, (states, seed): (usize, u64)) {
    let mut draws = Draws::new(seed);
    for _ in 0..states {
        let (q, wrench) = (draws.state(arm), draws.wrench(arm));
        for &output in kernels.outputs() {
            let worst = deviation(kernels, arm, output, (&q, &wrench), (CANCELLED, |x| x));
            assert!(worst <= 1e-12, "{name} {}: {worst:e} at {q:?} {wrench:?}", output.name());
        }
    }
}

/// What an arm is asked.
pub trait ForArm {
    /// Joint values within ±3 rad or ±0.5 m beyond 0.6 m.
    fn posture(&mut self, arm: &Arm) -> Vec<f64>;
    /// The same, and behind them rates, and accelerations or torques: what an output takes of it is its
    /// beginning.
    fn state(&mut self, arm: &Arm) -> Vec<f64>;
    /// Up to 100 N and 30 N·m, or what leaves the softest joint clearly stable at full reach.
    fn wrench(&mut self, arm: &Arm) -> [f64; 6];
}

impl ForArm for Draws {
    fn posture(&mut self, arm: &Arm) -> Vec<f64> {
        use stiffarm::kernels::Motion;
        arm.joints
            .iter()
            .map(|joint| match joint.motion {
                Motion::Revolute => 3.0 * self.unit(),
                Motion::Prismatic => 0.6 + 0.5 * self.unit(),
            })
            .collect()
    }

    fn state(&mut self, arm: &Arm) -> Vec<f64> {
        let mut state = self.posture(arm);
        for most in [2.0, 5.0] {
            state.extend((0..arm.dof()).map(|_| most * self.unit()));
        }
        state
    }

    fn wrench(&mut self, arm: &Arm) -> [f64; 6] {
        let reach: f64 = arm.joints.iter().map(|j| j.a.abs() + j.d.abs()).sum();
        let softest = arm.joints.iter().map(|j| j.compliance).fold(0.0, f64::max);
        let bearable = 0.02 / (softest * (1.0 + reach));
        core::array::from_fn(|k| self.unit() * bearable.min(if k < 3 { 100.0 } else { 30.0 }))
    }
}

/// An output of an arm that bears its load, as one block.
pub fn block<S: Scalar>(
    kernels: &(impl Kernels<S> + ?Sized),
    output: Output,
    state: &[S],
    wrench: &[S; 6],
) -> Vec<S> {
    let (rows, columns) = output.shape(kernels.dof());
    let mut out = vec![S::lit(0.0); rows * columns];
    kernels.evaluate(output, state, wrench, &mut out).expect("the arm is stable");
    out
}

/// The largest deviation of an output from the textbook, relative to the output's scale.
pub fn deviation<S: Scalar>(
    kernels: &dyn Kernels<S>,
    arm: &Arm,
    output: Output,
    (state, wrench): (&[f64], &[f64; 6]),
    (cancelled, back): (f64, impl Fn(S) -> f64),
) -> f64 {
    let q = &state[..output.state(arm.dof())];
    let expected = arm.evaluate(output, q, wrench).expect("the textbook finds the arm stable");
    let cast: Vec<S> = q.iter().map(|x| S::lit(*x)).collect();
    let got = block(kernels, output, &cast, &wrench.map(S::lit));
    let got: Vec<f64> = got.into_iter().map(back).collect();
    relative(&got, &expected, cancelled * terms(arm, output, q, wrench))
}
