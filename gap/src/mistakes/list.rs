//! All mistakes that an arm and its data may have, so that no two of them come to the same.

use core::cmp::Reverse;
use core::f64::consts::PI;

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::kind::{DEGREE, Entry, Mistake, Turns, own_wrench};
use crate::constants::{POSES_OF_LOADS, STUCK_ROWS};
use crate::measurement::{Kind, Measurements};

/// Factors of a length that is told in millimetres for metres, in inches for metres or in inches for
/// millimetres, each both ways: what is true is the factor times what is told.
const LENGTHS: [f64; 6] = [1e-3, 1e3, 0.0254, 1.0 / 0.0254, 25.4, 1.0 / 25.4];

/// No table has a shorter length that would have been meant, m: what is as good as none is no other unit's.
const SHORT: f64 = 5e-3;

/// Factors of a load: kilograms or pounds for newtons, a wrong sign, decanewtons and kilonewtons.
const LOADS: [f64; 7] = [9.80665, 1.0 / 9.80665, -1.0, -9.80665, 4.448_221_615_260_5, 10.0, 1e3];

/// Factors of moments beside forces that are right.
const MOMENTS: [f64; 5] = [1e-3, 1e3, -1.0, 9.80665, 1.0 / 9.80665];

/// Twists by which an entry may be off: a quarter, half a turn, and the slip of a digit.
const TWISTS: [i32; 5] = [90, -90, 180, 10, -10];

/// Zeros: quarters of a turn.
const ZEROS: [i32; 3] = [90, -90, 180];

/// Rows by which readings and positions may be apart.
const ROWS: [i32; 6] = [1, -1, 2, -2, 3, -3];

/// Of a joint's stretches with one reading so many are tried, the longest first: a plan of sweeps has one a joint.
const STUCK_RUNS: usize = 8;

impl Mistake {
    /// All that this arm and this data may have, so that no two of them come to the same; the robot may be
    /// any of `family` others.
    pub(super) fn all(arm: &Arm, data: &Measurements, family: usize) -> Vec<Mistake> {
        let mut all: Vec<Mistake> = (0..family).map(Mistake::Other).collect();
        all.push(Mistake::Convention);
        for row in 0..arm.dof() {
            of_row(arm, row, &mut all);
            of_readings(arm, data, row, &mut all);
        }
        let is_stream = data.sessions().any(crate::simulate::is_stream);
        // The delay of a stream is a number of its own, which `latency` fits; a socket holds its point at every posture.
        let is_told = !is_stream && !matches!(data.kind, Kind::Bench { lengths: 3, .. });
        all.extend(ROWS.iter().filter(|_| is_told).map(|rows| Mistake::Late { rows: *rows }));
        of_positions(data, &mut all);
        all.extend(of_loads(arm, data));
        all
    }
}

/// Whether two angles are one.
fn same_angle(a: f64, b: f64) -> bool {
    let off = (a - b) / (2.0 * PI);
    (off - off.round()).abs() < 1e-9
}

fn of_row(arm: &Arm, row: usize, all: &mut Vec<Mistake>) {
    let joint = &arm.joints[row];
    let is_revolute = joint.motion == Motion::Revolute;
    for (entry, value) in [(Entry::A, joint.a), (Entry::D, joint.d)] {
        let factors = LENGTHS.iter().filter(|factor| (*factor * value).abs() > SHORT);
        all.extend(factors.map(|&factor| Mistake::Entry { row, entry, factor }));
    }
    for (entry, value) in [(Entry::Theta, joint.theta), (Entry::Alpha, joint.alpha)] {
        let factors = [DEGREE, 1.0 / DEGREE].into_iter().filter(|factor| {
            // Beyond a turn no table has an angle in radians, and no entry of a milliradian was meant in degrees.
            value != 0.0 && (factor * value).abs() <= 2.0 * PI && !same_angle(value, factor * value)
        });
        all.extend(factors.map(|factor| Mistake::Entry { row, entry, factor }));
    }
    let has_sign = !same_angle(joint.alpha, -joint.alpha);
    all.extend(has_sign.then_some(Mistake::TwistSign { row }));
    let twists = TWISTS.iter().filter(|by| {
        !has_sign || !same_angle(joint.alpha + DEGREE * f64::from(**by), -joint.alpha)
    });
    all.extend(twists.map(|&by| Mistake::Twist { row, by }));
    let zeros = ZEROS.iter().filter(|_| is_revolute);
    all.extend(zeros.map(|&by| Mistake::Zero { joint: row, by }));
}

fn of_readings(arm: &Arm, data: &Measurements, joint: usize, all: &mut Vec<Mistake>) {
    let is_revolute = |j: usize| arm.joints[j].motion == Motion::Revolute;
    all.push(Mistake::Sign { joint });
    let factors: &[f64] = if is_revolute(joint) { &[DEGREE, 1.0 / DEGREE] } else { &LENGTHS };
    all.extend(factors.iter().map(|&factor| Mistake::ReadingUnit { joint, factor }));
    let alike = (0..arm.dof()).filter(|j| *j != joint && is_revolute(*j) == is_revolute(joint));
    for of in alike {
        all.extend([1.0, -1.0].map(|ratio| Mistake::Coupling { joint, of, ratio }));
        all.extend((joint < of).then_some(Mistake::Swapped { joints: [joint, of] }));
    }
    let mut runs = Vec::new();
    let mut from = 0;
    for run in data.rows.chunk_by(|one, next| one.q[joint] == next.q[joint]) {
        let moves = run.windows(2).filter(|pair| pair[0].q != pair[1].q).count();
        let until = from + run.len();
        runs.extend((moves >= STUCK_ROWS).then_some(Mistake::Stuck { joint, from, until }));
        from = until;
    }
    runs.sort_by_key(|run| run.stuck().map(|(_, rows)| Reverse(rows.len())));
    all.extend(runs.into_iter().take(STUCK_RUNS));
}

fn of_positions(data: &Measurements, all: &mut Vec<Mistake>) {
    if !data.kind.is_pose() {
        return;
    }
    for axis in [Some(0), Some(1), Some(2), None] {
        all.extend(LENGTHS.map(|factor| Mistake::Coordinate { axis, factor }));
    }
    let turns: &[Turns] = match data.kind {
        Kind::Pose { orientation: true } => &[Turns::Kept, Turns::AsColumns, Turns::LeftHanded],
        _ => &[Turns::Kept],
    };
    for &turns in turns {
        all.extend([[0, 1], [0, 2], [1, 2]].map(|axes| Mistake::Exchanged { axes, turns }));
        all.extend([0, 1, 2].map(|axis| Mistake::Mirrored { axis, turns }));
    }
}

/// Springs ten times as soft are loads of ten times the size: where the file lacks a spring, only the sign of the loads
/// is told.
fn of_loads(arm: &Arm, data: &Measurements) -> Vec<Mistake> {
    // A bench, or few poses, say too little to tell another unit from springs.
    if !data.kind.is_pose() || data.poses < POSES_OF_LOADS {
        return Vec::new();
    }
    let has_springs = arm.joints.iter().all(|joint| joint.compliance > 0.0);
    let loaded = |from: usize| {
        data.rows.iter().any(|row| own_wrench(row).fixed_rows::<3>(from).amax() > 0.0)
    };
    let (forces, moments) = (loaded(0), loaded(3));
    let is_told = |factor: &&f64| (forces || moments) && (has_springs || **factor == -1.0);
    let loads = LOADS.iter().filter(is_told).map(|&factor| Mistake::Load { factor });
    let moments = MOMENTS.iter().filter(|_| forces && moments);
    loads.chain(moments.map(|&factor| Mistake::Moment { factor })).collect()
}
