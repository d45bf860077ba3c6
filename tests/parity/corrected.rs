//! Arms with all that a robot file says beyond the table: what is generated = the effects' own laws on the
//! textbook, each alone and all together.
//!
//! The second way is the diagnosis': it puts each effect into the arm of a row by a law that shares no code
//! with the generator, and knows nothing of springs as columns.

use nalgebra::{Isometry3, UnitQuaternion, Vector3, Vector6};
use stiffarm::kernels::parity::Comparison;
use stiffarm::kernels::{Arm as _, Kernels, Output, Scalar, has};
use stiffarm::robot;
use stiffarm_codegen::derive::{Given, Program, derive};
use stiffarm_codegen::robot::Robot;
use stiffarm_gap::effects::{Catalogue, Known};
use stiffarm_gap::whole::{Situation, Whole};

use crate::compare::{CANCELLED, CANCELLED_F32, Draws, ForArm, block, relative, terms};

robot! { pub mod standard from "tests/data/corrected_standard.toml"; }
robot! { pub mod modified from "tests/data/corrected_modified.toml"; }
robot! { pub mod kuka from "tests/data/corrected_kuka.toml"; }

const FILES: [(&str, &str); 3] = [
    ("standard", include_str!("../data/corrected_standard.toml")),
    ("modified", include_str!("../data/corrected_modified.toml")),
    ("kuka", include_str!("../data/corrected_kuka.toml")),
];

/// An arm as its file says, and as the diagnosis understands it.
struct Corrected {
    name: String,
    file: Robot,
    arm: stiffarm::kernels::generic::Arm,
    known: Vec<Known>,
    /// The table with all masses in it, by which outputs are scaled.
    sized: stiffarm::kernels::generic::Arm,
}

/// A posture, and what is known of it.
struct Drawn {
    /// Readings, and three times as many numbers behind them for what else joints have.
    state: Vec<f64>,
    /// In the axes of the kernels: the world's.
    wrench: [f64; 6],
    at: Situation,
    given: Given,
}

impl Corrected {
    fn new(name: &str, file: Robot) -> Corrected {
        let arm = stiffarm_gap::robot::arm(&file).expect("a table of numbers");
        let known =
            Known::all(&file, &arm, &Catalogue::default()).expect("effects of the catalogue");
        let compiled = file.with_effects().expect("effects of kernels");
        let sized = stiffarm_gap::robot::arm(&compiled).expect("a table of numbers");
        Corrected { name: name.to_owned(), file, arm, known, sized }
    }

    fn whole(&self) -> Whole<'_> {
        Whole { arm: &self.arm, known: &self.known }
    }

    /// As its kernels are made of it.
    fn compiled(&self) -> Robot {
        self.file.with_effects().expect("effects of kernels")
    }

    fn draw(&self, draws: &mut Draws) -> Drawn {
        let (mut state, wrench) = (draws.posture(&self.arm), draws.wrench(&self.arm));
        let n = state.len();
        let sides: Vec<i8> = (0..n).map(|_| (1.5 * draws.unit()).round() as i8).collect();
        let warming = 20.0 * draws.unit();
        state.extend((0..3 * n).map(|_| draws.unit()));
        // The situation's load is in the axes of the base, as it stands.
        let base = self.sized.base.rotation.inverse();
        let [fx, fy, fz, mx, my, mz] = wrench;
        let (f, m) = (base * Vector3::new(fx, fy, fz), base * Vector3::new(mx, my, mz));
        let at = Situation {
            direction: Some(sides.clone()),
            warming: Some(warming),
            ..Situation::under(Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z))
        };
        let sides = sides.into_iter().map(f64::from).collect();
        let given = Given { sides, warming, ..Given::default() };
        Drawn { state, wrench, at, given }
    }

    /// The largest deviation of an output from the effects' own laws, relative to its scale and to what the
    /// arithmetic accounts for.
    fn deviation(&self, output: Output, got: &[f64], drawn: &Drawn, cancelled: f64) -> f64 {
        let (whole, state) = (self.whole(), drawn.of(output, self.arm.dof()));
        let (expected, limit) =
            match whole.evaluate(output, state, &drawn.at).expect("a stable arm") {
                Some(expected) => (expected, Comparison::Textbook.limit()),
                None => {
                    let slopes = whole.slopes(output, state, &drawn.at).expect("differences");
                    (slopes, Comparison::Differences.limit())
                }
            };
        let terms = terms(&self.sized, output, state, &drawn.wrench);
        relative(got, &expected, cancelled * terms) / limit
    }
}

impl Drawn {
    /// What an output takes of the joints.
    fn of(&self, output: Output, n: usize) -> &[f64] {
        &self.state[..output.state(n)]
    }
}

/// The arms with all their effects.
fn arms() -> impl Iterator<Item = Corrected> {
    let read = |text| Robot::from_toml(text, "corrected").expect("a robot file").0;
    FILES.into_iter().map(move |(name, text)| Corrected::new(name, read(text)))
}

/// The graph of each output; of links without moments of inertia nothing determines an acceleration.
fn programs(robot: &Robot) -> Vec<(Output, Program)> {
    let determined = Output::EACH.into_iter().filter(|output| *output != Output::ForwardDynamics);
    determined.map(|output| (output, derive(robot, &[output]))).collect()
}

fn by_graph(program: &Program, drawn: &Drawn) -> Vec<f64> {
    let Drawn { state, wrench, given, .. } = drawn;
    program.evaluate_given(state, wrench, |_| f64::NAN, given).expect("a stable arm").remove(0)
}

fn check(arm: &Corrected, count: usize) {
    let programs = programs(&arm.compiled());
    let mut draws = Draws::new(5);
    for _ in 0..count {
        let drawn = arm.draw(&mut draws);
        for (output, program) in &programs {
            let worst = arm.deviation(*output, &by_graph(program, &drawn), &drawn, CANCELLED);
            assert!(worst <= 1.0, "{} {}: {worst:e} at {:?}", arm.name, output.name(), drawn.state);
        }
    }
}

#[test]
fn all_effects_together_agree_with_their_own_laws() {
    arms().for_each(|arm| check(&arm, 60));
}

#[test]
fn each_effect_alone_agrees_with_its_own_law() {
    let mut seen: Vec<String> = Vec::new();
    for arm in arms() {
        for effect in &arm.file.effects {
            let name = format!("{}: {} at {}", arm.name, effect.id.value, effect.place.value);
            let alone = Robot { effects: vec![effect.clone()], ..arm.file.clone() };
            check(&Corrected::new(&name, alone), 5);
            seen.push(effect.id.value.clone());
        }
    }
    seen.sort_unstable();
    seen.dedup();
    // Every effect of the catalogue but those that no posture, load, side and temperature decides, two that
    // are not the arm's, and those that no row of a table and no formula of a joint's reading says.
    let not_compiled = [
        "bearing_wobble",
        "counterbalance",
        "drift",
        "geometric_stiffness",
        "geometry",
        "instrument_scale",
        "latency",
        "loaded_backlash",
        "motor_error",
        "settling_lag",
        "slip",
        "soft_zone",
    ];
    let compiled = Catalogue::default().identifiers().into_iter();
    let mut compiled: Vec<&str> = compiled.filter(|id| !not_compiled.contains(id)).collect();
    compiled.sort_unstable();
    assert_eq!(seen, compiled);
}

/// The module of an arm, asked for its outputs, its pose and its joint values.
trait Module<S> {
    fn kernels(sides: &[S], warming: S) -> Box<dyn Kernels<S>>;
}

macro_rules! modules {
    ($($name:ident: $($given:ident),*;)+) => {$(
        impl<S: Scalar + 'static> Module<S> for $name::Robot<S> {
            fn kernels(sides: &[S], warming: S) -> Box<dyn Kernels<S>> {
                let all = (<[S; $name::N]>::try_from(sides).expect("a side for each joint"), warming);
                let mut robot = $name::Robot::default();
                $(modules!(@ $given robot all);)*
                Box::new(robot)
            }
        }
    )+};
    (@ sides $robot:ident $all:ident) => { $robot.sides = $all.0 };
    (@ warming $robot:ident $all:ident) => { $robot.warming = $all.1 };
}

modules! {
    standard: sides;
    modified: sides, warming;
    kuka: sides;
}

fn kernels<S: Scalar + 'static>(name: &str, given: &Given) -> Box<dyn Kernels<S>> {
    let (sides, warming) = (given.sides.iter().map(|s| S::lit(*s)), S::lit(given.warming));
    let sides: Vec<S> = sides.collect();
    match name {
        "standard" => standard::Robot::kernels(&sides, warming),
        "modified" => modified::Robot::kernels(&sides, warming),
        _ => kuka::Robot::kernels(&sides, warming),
    }
}

fn by_kernels<S: Scalar + 'static>(
    arm: &Corrected,
    output: Output,
    drawn: &Drawn,
    back: impl Fn(S) -> f64,
) -> Vec<f64> {
    let state: Vec<S> = drawn.of(output, arm.arm.dof()).iter().map(|x| S::lit(*x)).collect();
    let kernels = kernels::<S>(&arm.name, &drawn.given);
    block(&*kernels, output, &state, &drawn.wrench.map(S::lit)).into_iter().map(back).collect()
}

#[test]
fn kernels_agree_in_both_precisions() {
    for arm in arms() {
        let mut draws = Draws::new(6);
        for _ in 0..200 {
            let mut drawn = arm.draw(&mut draws);
            for output in arm.compiled().generated() {
                let double = by_kernels::<f64>(&arm, output, &drawn, |x| x);
                let worst = arm.deviation(output, &double, &drawn, CANCELLED);
                assert!(worst <= 1.0, "{} {}: {worst:e}", arm.name, output.name());
            }
            // Of numbers that both precisions have.
            let single = |x: &mut f64| *x = f64::from(*x as f32);
            drawn.state.iter_mut().chain(&mut drawn.wrench).for_each(single);
            single(&mut drawn.given.warming);
            for output in arm.compiled().generated() {
                let double = by_kernels::<f64>(&arm, output, &drawn, |x| x);
                let single = by_kernels::<f32>(&arm, output, &drawn, f64::from);
                let floor = CANCELLED_F32
                    * terms(&arm.sized, output, drawn.of(output, arm.arm.dof()), &drawn.wrench);
                let worst = relative(&single, &double, floor);
                assert!(worst <= 4e-6, "{} {}: {worst:e} in f32", arm.name, output.name());
            }
        }
    }
}

/// Poses by central differences of the readings = the Jacobian, of joint values, times how these go with the
/// readings.
#[test]
fn the_jacobian_is_that_of_the_joint_values() {
    const STEP: f64 = 1e-5;
    let robot = modified::Robot { sides: [1.0, -1.0, 1.0, 0.0, 1.0], warming: 8.0 };
    let mut draws = Draws::new(7);
    let moved = |q: &[f64; 5], j: usize, by: f64| {
        let mut q = *q;
        q[j] += by;
        q
    };
    for _ in 0..100 {
        let q: [f64; 5] = core::array::from_fn(|_| 2.0 * draws.unit());
        let jacobian: [[f64; 6]; 5] = has::Jacobian::jacobian(&robot, &robot.posture(&q));
        let joints = |q: &[f64; 5]| modified::joints(q, &robot.sides, robot.warming);
        let pose = |q: &[f64; 5]| {
            let pose = modified::pose(q, &robot.sides, robot.warming);
            let axes = nalgebra::Matrix3::from_columns(&pose.rotation.map(Vector3::from));
            let turn = UnitQuaternion::from_matrix(&axes);
            Isometry3::from_parts(Vector3::from(pose.position).into(), turn)
        };
        for j in 0..5 {
            let [low, high] = [-STEP, STEP].map(|by| pose(&moved(&q, j, by)));
            let shift = (high.translation.vector - low.translation.vector) / (2.0 * STEP);
            let turn = (high.rotation * low.rotation.inverse()).scaled_axis() / (2.0 * STEP);
            let [low, high] = [-STEP, STEP].map(|by| joints(&moved(&q, j, by)));
            let by_joints: Vec<f64> = (0..6)
                .map(|row| {
                    let each = (0..5).map(|k| jacobian[k][row] * (high[k] - low[k]) / (2.0 * STEP));
                    each.sum()
                })
                .collect();
            // A wave of order 100 and 0.03 mrad has a third derivative of 30: 30 h²/6 = 5e-10 on either side
            // alike; what is left is that of the pose, and rounding over the step, 1e-11 each.
            for (a, b) in shift.iter().chain(turn.iter()).zip(by_joints) {
                assert!((a - b).abs() < 5e-9, "joint {}: {a} {b}", j + 1);
            }
        }
    }
}

/// Where the arm comes to rest on its deformed geometry differs from pose and deflection by the second order of
/// the load: at a quarter of the load by a sixteenth.
#[test]
fn what_is_left_out_is_of_second_order() {
    for arm in arms() {
        let compiled = arm.compiled();
        let [pose, deflection] = [Output::Pose, Output::DeflectionWithGravity];
        let mut draws = Draws::new(8);
        let (mut most, mut least) = (0.0_f64, f64::INFINITY);
        for _ in 0..20 {
            let drawn = arm.draw(&mut draws);
            let miss = |part: f64| {
                let scaled = |robot: &Robot| {
                    let mut robot = robot.clone();
                    for g in &mut robot.gravity {
                        let was = g.number().expect("a number").to_f64();
                        let now = stiffarm_codegen::number::Number::from_decimal(&format!(
                            "{:e}",
                            part * was
                        ));
                        *g = stiffarm_codegen::robot::Value::Number(now.expect("a number"));
                    }
                    robot
                };
                let lighter = Corrected::new(&arm.name, scaled(&arm.file));
                let at = Situation { load: drawn.at.load * part, ..drawn.at.clone() };
                let (state, base) =
                    lighter.whole().at(&drawn.state[..arm.arm.dof()], &at).expect("a rest");
                let rest = base * state.tool;
                let robot = scaled(&compiled);
                let at = Drawn {
                    state: drawn.state.clone(),
                    wrench: drawn.wrench.map(|w| w * part),
                    at,
                    given: drawn.given.clone(),
                };
                let by = |output| by_graph(&derive(&robot, &[output]), &at);
                let (pose, moved) = (by(pose), by(deflection));
                (0..3)
                    .map(|k| (pose[9 + k] + moved[k] - rest.translation.vector[k]).powi(2))
                    .sum::<f64>()
                    .sqrt()
            };
            let (whole, quarter) = (miss(1.0), miss(0.25));
            assert!(quarter < whole / 12.0 + 1e-12, "{}: {whole:e} {quarter:e}", arm.name);
            (most, least) = (most.max(whole), least.min(whole));
        }
        assert!(most > 1e-9 && most < 1e-4, "{}: {least:e} to {most:e}", arm.name);
    }
}
