//! What may be wrong with a robot file or with readings: each mistake changes the arm, or what a row says,
//! exactly and by no number that would have to be fitted.

use core::f64::consts::PI;

use nalgebra::{Vector3, Vector6};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention};

use crate::measurement::{Kind, Measurements};

/// Factors of a length that is told in millimetres for metres, in inches for metres or in inches for
/// millimetres, each both ways: what is true is the factor times what is told.
pub(super) const LENGTHS: [f64; 6] = [1e-3, 1e3, 0.0254, 1.0 / 0.0254, 25.4, 1.0 / 25.4];

/// rad in a degree.
pub(super) const DEGREE: f64 = PI / 180.0;

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

/// Fewer rows with one reading are a pose that was measured again, or a sweep of another joint.
const STUCK_ROWS: usize = 8;

/// An entry of a row of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Entry {
    A,
    D,
    Theta,
    Alpha,
}

/// One mistake. Joints and rows count from 0; a factor times what is told is what is true.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Mistake {
    /// The robot is another one of the options' family.
    Other(usize),
    /// The table is of the other convention.
    Convention,
    /// An entry has another unit.
    Entry { row: usize, entry: Entry, factor: f64 },
    /// The twist has the wrong sign.
    TwistSign { row: usize },
    /// The twist is off by so many degrees.
    Twist { row: usize, by: i32 },
    /// A joint's zero is off by so many degrees.
    Zero { joint: usize, by: i32 },
    /// A joint turns against its reading.
    Sign { joint: usize },
    /// A joint's reading leaves out another's, or counts it: `q += ratio · q of`.
    Coupling { joint: usize, of: usize, ratio: f64 },
    /// The readings of two joints stand in each other's columns.
    Swapped { joints: [usize; 2] },
    /// A joint's reading has another unit.
    ReadingUnit { joint: usize, factor: f64 },
    /// Readings stand so many rows behind the positions that belong to them.
    Late { rows: i32 },
    /// A joint's reading does not change any more from a row on, though the joint moves.
    Stuck { joint: usize, from: usize },
    /// Coordinates have another unit: one, or all of them.
    Coordinate { axis: Option<usize>, factor: f64 },
    /// Two coordinates stand in each other's columns; those of the rotation too.
    Exchanged { axes: [usize; 2], turns: Turns },
    /// A coordinate has the wrong sign.
    Mirrored { axis: usize, turns: Turns },
    /// Loads have another unit, or the other sign.
    Load { factor: f64 },
    /// Moments have another unit.
    Moment { factor: f64 },
}

/// What becomes of rotation vectors where coordinates are mirrored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turns {
    /// They are right.
    Kept,
    /// Their columns went the coordinates' way.
    AsColumns,
    /// They are told in the left-handed frame.
    LeftHanded,
}

/// What a row says, as far as a mistake may change it.
#[derive(Clone, Debug)]
pub(super) struct Told {
    /// Joint readings, rad (m if prismatic).
    pub q: Vec<f64>,
    /// Position and rotation vector, m and rad.
    pub measured: Vector6<f64>,
    /// Wrench without what hangs on the tool by name, N and N·m.
    pub wrench: Vector6<f64>,
}

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
        // The delay of a stream is a number of its own, which `latency` fits.
        all.extend(ROWS.iter().filter(|_| !is_stream).map(|rows| Mistake::Late { rows: *rows }));
        of_positions(data, &mut all);
        all.extend(of_loads(arm, data));
        all
    }

    /// Those of them that concern what loads the arm.
    pub(super) fn is_of_load(self) -> bool {
        matches!(self, Mistake::Load { .. } | Mistake::Moment { .. })
    }

    /// Whether a change of the robot file mends it; else the measurement file is to be changed.
    pub(super) fn is_of_robot(self) -> bool {
        self.order() < 4
    }

    /// What is changed first where there are two: the table before its entries, columns before what they say.
    pub(super) fn order(self) -> usize {
        match self {
            Mistake::Other(_) => 0,
            Mistake::Convention => 1,
            Mistake::Entry { .. } | Mistake::TwistSign { .. } | Mistake::Twist { .. } => 2,
            Mistake::Zero { .. } | Mistake::Sign { .. } | Mistake::Coupling { .. } => 3,
            Mistake::ReadingUnit { .. } | Mistake::Coordinate { .. } => 4,
            _ => 5,
        }
    }

    /// How many nats less likely than the likeliest it is beforehand: what people do often comes first where
    /// two mistakes explain the same.
    pub(super) fn rarity(self) -> f64 {
        match self {
            Mistake::Sign { .. } | Mistake::Stuck { .. } => 0.0,
            Mistake::Load { factor } => match factor {
                9.80665 | -1.0 => 0.0,
                f if f == 1.0 / 9.80665 => 0.5,
                _ => 2.0,
            },
            Mistake::Exchanged { axes: [0, 1], turns: Turns::Kept } => 0.0,
            Mistake::Coupling { joint, of, .. } if joint == of + 1 => 0.0,
            Mistake::Zero { .. } | Mistake::TwistSign { .. } | Mistake::ReadingUnit { .. } => 0.5,
            Mistake::Entry { factor, .. } | Mistake::Coordinate { factor, .. } => {
                if [1e3, 1e-3].contains(&factor) { 0.5 } else { 1.5 }
            }
            Mistake::Swapped { joints: [a, b] } if b == a + 1 => 0.5,
            Mistake::Coupling { .. } | Mistake::Twist { .. } => 2.0,
            // One entry is less to be wrong than a whole table.
            Mistake::Other(_) => 6.0,
            _ => 1.0,
        }
    }

    /// Changes the arm; `family` are the others that it may be.
    pub(super) fn alter(self, arm: &mut Arm, family: &[Arm]) {
        match self {
            Mistake::Other(k) => {
                let other = &family[k];
                (arm.joints, arm.convention) = (other.joints.clone(), other.convention);
            }
            Mistake::Convention => {
                arm.convention = match arm.convention {
                    Convention::Standard => Convention::Modified,
                    Convention::Modified => Convention::Standard,
                }
            }
            Mistake::Entry { row, entry, factor } => {
                let joint = &mut arm.joints[row];
                *match entry {
                    Entry::A => &mut joint.a,
                    Entry::D => &mut joint.d,
                    Entry::Theta => &mut joint.theta,
                    Entry::Alpha => &mut joint.alpha,
                } *= factor;
            }
            Mistake::TwistSign { row } => arm.joints[row].alpha *= -1.0,
            Mistake::Twist { row, by } => arm.joints[row].alpha += DEGREE * f64::from(by),
            Mistake::Zero { joint, by } => arm.joints[joint].theta += DEGREE * f64::from(by),
            _ => {}
        }
    }

    /// What the joints' values are where this is how they differ from their readings.
    pub(super) fn turn(self, q: &mut [f64]) {
        match self {
            Mistake::Sign { joint } => q[joint] *= -1.0,
            Mistake::Coupling { joint, of, ratio } => q[joint] += ratio * q[of],
            _ => {}
        }
    }

    /// Changes what a row says, without the rows around it.
    pub(super) fn reword(self, told: &mut Told) {
        let mut position: Vector3<f64> = told.measured.fixed_rows::<3>(0).into_owned();
        let mut rotation: Vector3<f64> = told.measured.fixed_rows::<3>(3).into_owned();
        let turned = |turns: Turns, rotation: &mut Vector3<f64>, was: Vector3<f64>| match turns {
            Turns::Kept => *rotation = was,
            Turns::AsColumns => {}
            Turns::LeftHanded => *rotation *= -1.0,
        };
        match self {
            Mistake::Swapped { joints: [a, b] } => told.q.swap(a, b),
            Mistake::ReadingUnit { joint, factor } => told.q[joint] *= factor,
            Mistake::Coordinate { axis: Some(axis), factor } => position[axis] *= factor,
            Mistake::Coordinate { axis: None, factor } => position *= factor,
            Mistake::Exchanged { axes: [a, b], turns } => {
                let was = rotation;
                position.swap_rows(a, b);
                rotation.swap_rows(a, b);
                turned(turns, &mut rotation, was);
            }
            Mistake::Mirrored { axis, turns } => {
                let was = rotation;
                position[axis] *= -1.0;
                rotation[axis] *= -1.0;
                turned(turns, &mut rotation, was);
            }
            Mistake::Load { factor } => told.wrench *= factor,
            Mistake::Moment { factor } => {
                let mut moments = told.wrench.fixed_rows_mut::<3>(3);
                moments *= factor;
            }
            _ => {}
        }
        told.measured.fixed_rows_mut::<3>(0).copy_from(&position);
        told.measured.fixed_rows_mut::<3>(3).copy_from(&rotation);
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
        let factors = LENGTHS.iter().filter(|_| value != 0.0);
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
    let last = data.rows.last().map_or(0.0, |row| row.q[joint]);
    let from = data.rows.iter().rposition(|row| row.q[joint] != last).map_or(0, |row| row + 1);
    let moves = data.rows[from..].windows(2).filter(|pair| pair[0].q != pair[1].q).count();
    all.extend((moves >= STUCK_ROWS).then_some(Mistake::Stuck { joint, from }));
}

fn of_positions(data: &Measurements, all: &mut Vec<Mistake>) {
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

/// The wrench of a row's own columns, without what hangs on the tool by name.
pub(super) fn own_wrench(row: &crate::measurement::Row) -> Vector6<f64> {
    row.wrench - row.payload.as_ref().map_or_else(Vector6::zeros, |hung| hung.weight)
}
