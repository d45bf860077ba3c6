//! The inverse kinematics through the macro: its branches against the arm's own forward kinematics, in both precisions,
//! and what a controller takes of them.

mod as_it_is;

use stiffarm::kernels::lanes::f64x4;
use stiffarm::kernels::{Arm, ElbowAngle, Inverse, Pose, Scalar, SetPoints, Solutions, batch, has};
use stiffarm::robot;
use stiffarm_draws::Draws;

robot! { mod kr240 from "robots/arms/kuka_kr240.toml"; outputs: pose, inverse_kinematics; }
robot! { mod irb120 from "robots/arms/irb120.toml"; outputs: pose, inverse_kinematics; }
robot! { mod puma560 from "robots/arms/puma560.toml"; outputs: pose, inverse_kinematics; }
robot! { mod ur10 from "robots/arms/ur10.toml"; outputs: pose, inverse_kinematics; }
robot! { mod panda from "robots/arms/panda.toml"; outputs: pose, inverse_kinematics; }
robot! { mod iiwa14 from "robots/arms/iiwa14.toml"; outputs: pose, inverse_kinematics; }
robot! {
    mod elbow from "robots/arms/iiwa14.toml";
    outputs: pose, inverse_kinematics given elbow_angle;
}
robot! { mod panda_by_three from "robots/arms/panda.toml"; outputs: pose, inverse_kinematics given 3; }
robot! { mod stanford from "robots/arms/stanford.toml"; outputs: pose, inverse_kinematics; }
robot! { mod plane from "robots/arms/bicchi_3r.toml"; outputs: pose, inverse_kinematics; }
robot! { mod general from "tests/data/general.toml"; outputs: pose, inverse_kinematics; }
robot! { mod searched from "tests/data/offset_wrist.toml"; outputs: pose, inverse_kinematics; }

robot! {
    /// Link lengths that are known when the program runs.
    mod symbolic;
    convention: standard_dh;
    outputs: pose, inverse_kinematics;
    joint | theta | d  | a  | alpha
    a1    | q     | d1 | a1 | pi/2
    a2    | q     | 0  | a2 | 0
    a3    | q     | 0  | a3 | pi/2
    a4    | q     | d4 | 0  | -pi/2
    a5    | q     | 0  | 0  | pi/2
    a6    | q     | d6 | 0  | 0
}

robot! {
    /// Two turns, a stroke, a turn.
    mod scara;
    convention: standard_dh;
    outputs: pose, inverse_kinematics;
    joint | theta | d     | a     | alpha
    a1    | q     | 0.4   | 0.325 | 0
    a2    | q     | 0     | 0.225 | pi
    a3    | 0     | q     | 0     | 0
    a4    | q     | 0.05  | 0     | 0
}

robot! {
    /// The axes of a youBot: a waist, three parallel axes, a roll.
    mod five;
    convention: standard_dh;
    outputs: pose, inverse_kinematics;
    joint | theta    | d     | a     | alpha
    a1    | q        | 0.147 | 0.033 | pi/2
    a2    | q + pi/2 | 0     | 0.155 | 0
    a3    | q        | 0     | 0.135 | 0
    a4    | q + pi/2 | 0     | 0     | pi/2
    a5    | q        | 0.218 | 0     | 0
}

/// An arm with its forward and its inverse kinematics.
trait Both<S: Scalar, const N: usize, const K: usize>: Inverse<N, K, S> + has::Pose<N, S> {}
impl<S: Scalar, const N: usize, const K: usize, A: Inverse<N, K, S> + has::Pose<N, S>> Both<S, N, K>
    for A
{
}

fn at<S: Scalar, const N: usize>(arm: &impl has::Pose<N, S>, q: &[S; N]) -> Pose<S> {
    arm.pose(&arm.posture(q))
}

/// The largest difference of two poses.
fn apart<S: Scalar + Into<f64>>(a: Pose<S>, b: Pose<S>) -> f64 {
    let (a, b) = (a.columns(), b.columns());
    let each = a.as_flattened().iter().zip(b.as_flattened());
    each.map(|(a, b)| ((*a - *b).into()).abs()).fold(0.0, f64::max)
}

/// Every branch that is reached gives the pose, one of them is the posture that made it, and the nearest is that.
fn check<S, const N: usize, const K: usize, A: Both<S, N, K>>(
    arm: &A,
    draws: &mut Draws,
    within: f64,
) where
    S: Scalar + PartialOrd + Into<f64>,
{
    let [mut beside, mut elsewhere] = [0, 0];
    for _ in 0..2000 {
        let q = draws.array::<N>(-3.1, 3.1).map(S::lit);
        let pose = at(arm, &q);
        let solutions = arm.inverse_kinematics(&pose, &q);
        assert!(solutions.q.as_flattened().iter().all(|q| (*q).into().is_finite()));
        for solution in solutions.reached(within, within) {
            let off = apart(at(arm, &solution.q), pose);
            assert!(off < 10.0 * within, "{off:e}");
        }
        let nearest = solutions.nearest(&q, &[None; N], (within, within));
        let Some(nearest) = nearest else {
            // Fewer than six joints miss their pose near a stretched elbow, by the square root of rounding.
            let missed = within.sqrt();
            solutions.nearest(&q, &[None; N], (missed, missed)).expect("the posture");
            assert!(N < 6, "the posture");
            beside += 1;
            continue;
        };
        let change = nearest.q.iter().zip(&q).map(|(a, b)| ((*a - *b).into()).abs());
        // Near a double root a posture is known to the square root of the pose's rounding.
        let change = change.fold(0.0, f64::max);
        // Axes in general position have worse ones, and a stretched arm between a spherical shoulder and a spherical wrist
        // turns about itself, too.
        elsewhere += usize::from(change > 3.0 * within.sqrt());
    }
    // A search misses some postures of an arm whose axes are special.
    let most = if N == 7 || K == 16 { 8 } else { 1 };
    assert!(beside < 20 && elsewhere <= most, "{}: {beside} {elsewhere}", A::NAME);
}

/// The arms of the collection.
fn check_all<S: Scalar + PartialOrd + Into<f64>>(draws: &mut Draws, within: f64) {
    check::<S, 6, 8, _>(&kr240::Robot, draws, within);
    check::<S, 6, 8, _>(&irb120::Robot, draws, within);
    check::<S, 6, 8, _>(&puma560::Robot, draws, within);
    check::<S, 6, 8, _>(&ur10::Robot, draws, within);
    check::<S, 7, 8, _>(&panda::Robot, draws, within);
    check::<S, 7, 8, _>(&iiwa14::Robot, draws, within);
    check::<S, 7, 8, _>(&elbow::Robot, draws, within);
    check::<S, 6, 16, _>(&searched::Robot, draws, within);
    check::<S, 7, 16, _>(&panda_by_three::Robot, draws, within);
    check::<S, 6, 8, _>(&stanford::Robot, draws, within);
    check::<S, 6, 8, _>(&general::Robot, draws, within);
    check::<S, 5, 4, _>(&five::Robot, draws, within);
    check::<S, 4, 2, _>(&scara::Robot, draws, within);
    check::<S, 3, 2, _>(&plane::Robot, draws, within);
}

#[test]
fn branches_of_doubles_give_the_pose() {
    let mut draws = Draws::new(1);
    check_all::<f64>(&mut draws, 1e-11);
    let parameters =
        symbolic::Parameters { d1: 0.4, a1: 0.1, a2: 0.5, a3: -0.05, d4: 0.45, d6: 0.1 };
    check::<f64, 6, 8, _>(&symbolic::Robot::new(&parameters), &mut draws, 1e-11);
}

#[test]
fn branches_of_singles_give_the_pose() {
    check_all::<f32>(&mut Draws::new(2), 2e-4);
}

/// A path on which the wrist passes its singularity: the branch stays, and no joint jumps.
#[test]
fn a_path_through_a_singularity_is_continuous() {
    let limits = <kr240::Robot as Arm<6>>::LIMITS;
    let mut near = [0.3, 1.0, -0.4, 0.2, 0.6, -0.5];
    for k in 0..=1200 {
        let wrist = 0.6 - 0.001 * f64::from(k);
        let pose = at(&kr240::Robot, &[0.3, 1.0, -0.4, 0.2, wrist, -0.5]);
        let solutions: Solutions<f64, 6, 8> = kr240::Robot.inverse_kinematics(&pose, &near);
        let next = solutions.nearest(&near, &limits, (1e-9, 1e-9)).expect("a branch").q;
        let step = next.iter().zip(&near).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(step < 0.002, "{k}: {step}");
        near = next;
    }
}

/// What is out of reach is told, and the branch is stretched towards it.
#[test]
fn out_of_reach_is_told() {
    let q = [0.3, 1.0, -0.4, 0.2, 0.6, -0.5];
    let mut pose: Pose<f64> = at(&kr240::Robot, &q);
    pose.position = pose.position.map(|x| 5.0 * x);
    let solutions = kr240::Robot.inverse_kinematics(&pose, &q);
    assert_eq!(solutions.nearest(&q, &[None; 6], (1e-9, 1e-9)), None);
    for solution in solutions.iter() {
        let reached = at(&kr240::Robot, &solution.q);
        let off = pose.position.iter().zip(&reached.position).map(|(a, b)| (a - b) * (a - b));
        assert!((off.sum::<f64>().sqrt() - solution.distance).abs() < 1e-12);
    }
}

/// The elbow turns about the line from shoulder to wrist, and the tool stays.
#[test]
fn the_elbow_is_turned_by_its_angle() {
    let q = [0.3, 0.7, -0.2, 1.1, 0.4, 0.9, 0.1];
    let (pose, own) = (at(&elbow::Robot, &q), elbow::elbow_angle(&q));
    let keeps = elbow::Robot.inverse_kinematics(&pose, &q);
    assert_eq!(keeps, elbow::Robot.inverse_kinematics_at(&pose, &q, own));
    let mut near = q;
    for k in 1..=60 {
        let angle = own + 0.02 * f64::from(k);
        let found = elbow::Robot.inverse_kinematics_at(&pose, &near, angle);
        let next = found.nearest(&near, &[None; 7], (1e-9, 1e-9)).expect("a branch").q;
        let step = next.iter().zip(&near).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let off = (elbow::elbow_angle(&next) - angle).sin();
        assert!(step < 0.1 && off.abs() < 1e-9, "{k}: {step} {off}");
        near = next;
    }
}

/// Four poses at once have the bits of one after the other.
fn in_lanes<A, const N: usize, const K: usize>(
    one: &A,
    lanes: &impl Both<f64x4, N, K>,
    draws: &mut Draws,
) where
    A: Both<f64, N, K>,
{
    for _ in 0..100 {
        let near: [[f64; N]; 4] = core::array::from_fn(|_| draws.array(-3.1, 3.1));
        let packed = |values: &dyn Fn(usize) -> f64| f64x4::from(core::array::from_fn(values));
        let poses: [Pose<f64>; 4] = near.map(|q| at(one, &q));
        let pose = Pose {
            rotation: core::array::from_fn(|k| {
                core::array::from_fn(|row| packed(&|lane| poses[lane].rotation[k][row]))
            }),
            position: core::array::from_fn(|row| packed(&|lane| poses[lane].position[row])),
        };
        let q: [f64x4; N] = core::array::from_fn(|joint| packed(&|lane| near[lane][joint]));
        let together = lanes.inverse_kinematics(&pose, &q);
        for lane in 0..4 {
            let alone = one.inverse_kinematics(&poses[lane], &near[lane]);
            let numbers = alone.q.as_flattened().iter().chain(&alone.distance).chain(&alone.tilt);
            let of_lane = together.q.as_flattened().iter().chain(&together.distance);
            for (a, b) in numbers.zip(of_lane.chain(&together.tilt)) {
                assert_eq!(a.to_bits(), b.to_array()[lane].to_bits(), "{a} {b:?}");
            }
        }
    }
}

#[test]
fn lanes_have_the_bits_of_one_pose() {
    let mut draws = Draws::new(8);
    in_lanes(&kr240::Robot, &kr240::Robot, &mut draws);
    in_lanes(&irb120::Robot, &irb120::Robot, &mut draws);
    in_lanes(&ur10::Robot, &ur10::Robot, &mut draws);
    in_lanes(&panda::Robot, &panda::Robot, &mut draws);
    in_lanes(&general::Robot, &general::Robot, &mut draws);
    in_lanes(&elbow::Robot, &elbow::Robot, &mut draws);
    in_lanes(&stanford::Robot, &stanford::Robot, &mut draws);
    in_lanes(&five::Robot, &five::Robot, &mut draws);
    in_lanes(&scara::Robot, &scara::Robot, &mut draws);
    let sides = as_it_is::SIDES.map(f64::from);
    let lanes = sides.map(f64x4::lit);
    in_lanes(&as_it_is::ur10::Robot { sides }, &as_it_is::ur10::Robot { sides: lanes }, &mut draws);
}

/// The branches of a pose by as many at once as lanes hold have the bits of one after the other, and so they have where the
/// arm does not bear its load.
#[test]
fn branches_at_once_have_the_bits_of_one() {
    type Lanes = <f64 as batch::Number>::Lanes;
    let sides = as_it_is::SIDES.map(f64::from);
    let arm = as_it_is::ur10::Robot { sides };
    let lanes = as_it_is::ur10::Robot { sides: sides.map(Lanes::lit) };
    let mut draws = Draws::new(9);
    let mut infinite = 0;
    for k in 0..200 {
        let q: [f64; 6] = draws.array(-3.1, 3.1);
        let (pose, wrench) = (at(&arm, &q), draws.load().map(|x| x * [1.0, 1e4][k % 2]));
        let rigid =
            (arm.inverse_kinematics(&pose, &q), batch::inverse_kinematics(&arm, &lanes, &pose, &q));
        let loaded = (
            arm.set_points(&pose, &q, &wrench),
            batch::set_points(&arm, &lanes, &pose, &q, &wrench),
        );
        for (one, at_once) in [rigid, loaded] {
            let bits = |of: Solutions<f64, 6, 8>| {
                let all = of.q.into_iter().flatten().chain(of.distance).chain(of.tilt);
                all.map(f64::to_bits).collect::<Vec<_>>()
            };
            infinite += one.distance.iter().filter(|distance| distance.is_infinite()).count();
            assert_eq!(bits(one), bits(at_once));
        }
    }
    assert!(infinite > 0);
}
