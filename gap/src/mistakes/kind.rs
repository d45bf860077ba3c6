//! What may be wrong with a robot file or with readings: each mistake changes the arm, or what a row says,
//! exactly. But for an entry that is off by any amount there is no number in it that would have to be fitted.

use core::f64::consts::PI;
use core::ops::Range;

use nalgebra::{Vector3, Vector6};
use stiffarm_kernels::generic::{Arm, Convention, Joint};

use crate::constants::ANY_AMOUNT;

/// rad in a degree.
pub(super) const DEGREE: f64 = PI / 180.0;

/// An entry of a row of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Entry {
    A,
    D,
    Theta,
    Alpha,
}

impl Entry {
    /// In a row.
    pub(super) fn of(self, joint: &mut Joint) -> &mut f64 {
        match self {
            Entry::A => &mut joint.a,
            Entry::D => &mut joint.d,
            Entry::Theta => &mut joint.theta,
            Entry::Alpha => &mut joint.alpha,
        }
    }

    /// Whether it is an angle.
    pub(super) fn is_angle(self) -> bool {
        matches!(self, Entry::Theta | Entry::Alpha)
    }
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
    /// An entry is off by as much as the data say, rad or m.
    Off { row: usize, entry: Entry, by: f64 },
    /// A joint turns against its reading.
    Sign { joint: usize },
    /// A joint's reading leaves out another's, or counts it: `q += ratio · q of`.
    Coupling { joint: usize, of: usize, ratio: f64 },
    /// The readings of two joints stand in each other's columns.
    Swapped { joints: [usize; 2] },
    /// A joint's reading has another unit.
    ReadingUnit { joint: usize, factor: f64 },
    /// A joint goes with a reading, its own or another's, by as much as the data say: `q += ratio · q of`.
    Geared { joint: usize, of: usize, ratio: f64 },
    /// Readings stand so many rows behind the positions that belong to them.
    Late { rows: i32 },
    /// A joint's reading does not change from a row on until another, which is not one of them, though the joint moves.
    Stuck { joint: usize, from: usize, until: usize },
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
    /// Those of them that concern what loads the arm.
    pub(super) fn is_of_load(self) -> bool {
        matches!(self, Mistake::Load { .. } | Mistake::Moment { .. })
    }

    /// The rows in which a joint's reading is not known, and the joint.
    pub(super) fn stuck(self) -> Option<(usize, Range<usize>)> {
        match self {
            Mistake::Stuck { joint, from, until } => Some((joint, from..until)),
            _ => None,
        }
    }

    /// Whether a joint's reading is not known.
    pub(super) fn is_stuck(self) -> bool {
        self.stuck().is_some()
    }

    /// Whether a change of the robot file mends it; else the measurement file is to be changed.
    pub(super) fn is_of_robot(self) -> bool {
        self.order() < 4
    }

    /// The entry of the table that it changes, and nothing else.
    fn entry(self) -> Option<(usize, Entry)> {
        match self {
            Mistake::Entry { row, entry, .. } | Mistake::Off { row, entry, .. } => {
                Some((row, entry))
            }
            Mistake::TwistSign { row } | Mistake::Twist { row, .. } => Some((row, Entry::Alpha)),
            Mistake::Zero { joint, .. } => Some((joint, Entry::Theta)),
            _ => None,
        }
    }

    /// Whether both may be made: an entry is wrong once.
    pub(super) fn may_join(self, other: Mistake) -> bool {
        self != other && (self.entry().is_none() || self.entry() != other.entry())
    }

    /// What is changed first where there are two: the table before its entries, columns before what they say.
    pub(super) fn order(self) -> usize {
        match self {
            Mistake::Other(_) => 0,
            Mistake::Convention => 1,
            Mistake::Entry { .. } | Mistake::TwistSign { .. } | Mistake::Twist { .. } => 2,
            Mistake::Off { .. } => 2,
            Mistake::Zero { .. }
            | Mistake::Sign { .. }
            | Mistake::Coupling { .. }
            | Mistake::Geared { .. } => 3,
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
            Mistake::Off { .. } | Mistake::Geared { .. } => ANY_AMOUNT,
            // One entry is less to be wrong than a whole table, by whatever amount.
            Mistake::Other(_) => ANY_AMOUNT + 1.0,
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
                *entry.of(&mut arm.joints[row]) *= factor;
            }
            Mistake::Off { row, entry, by } => *entry.of(&mut arm.joints[row]) += by,
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
            Mistake::Coupling { joint, of, ratio } | Mistake::Geared { joint, of, ratio } => {
                q[joint] += ratio * q[of];
            }
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

/// The wrench of a row's own columns, without what hangs on the tool by name.
pub(super) fn own_wrench(row: &crate::measurement::Row) -> Vector6<f64> {
    row.wrench - row.payload.as_ref().map_or_else(Vector6::zeros, |hung| hung.weight)
}
