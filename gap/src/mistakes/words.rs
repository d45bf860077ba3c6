//! What a mistake is in a sentence, and how it is mended.

use super::kind::{DEGREE, Entry, Mistake, Turns};

const AXES: [char; 3] = ['x', 'y', 'z'];

impl Mistake {
    /// What it is called.
    pub(super) fn kind(self) -> &'static str {
        match self {
            Mistake::Other(_) => "other_robot",
            Mistake::Convention => "convention",
            Mistake::Entry { entry: Entry::A | Entry::D, .. } => "table_unit",
            Mistake::Entry { .. } => "table_angle_unit",
            Mistake::TwistSign { .. } => "twist_sign",
            Mistake::Twist { .. } => "twist",
            Mistake::Zero { .. } | Mistake::Off { entry: Entry::Theta, .. } => "joint_zero",
            Mistake::Off { entry: Entry::Alpha, .. } => "twist",
            Mistake::Off { .. } => "table_length",
            Mistake::Sign { .. } => "joint_sign",
            Mistake::Geared { joint, of, .. } if joint == of => "reading_scale",
            Mistake::Coupling { .. } | Mistake::Geared { .. } => "reading_coupling",
            Mistake::Swapped { .. } => "swapped_readings",
            Mistake::ReadingUnit { .. } => "reading_unit",
            Mistake::Late { .. } => "late_readings",
            Mistake::Stuck { .. } => "stuck_reading",
            Mistake::Coordinate { .. } => "coordinate_unit",
            Mistake::Exchanged { .. } | Mistake::Mirrored { .. } => "measuring_axes",
            Mistake::Load { factor: -1.0 } => "load_sign",
            Mistake::Load { .. } => "load_unit",
            Mistake::Moment { .. } => "moment_unit",
        }
    }

    /// Where it is.
    pub(super) fn place(self) -> String {
        match self {
            Mistake::Entry { row, .. }
            | Mistake::TwistSign { row }
            | Mistake::Twist { row, .. }
            | Mistake::Zero { joint: row, .. }
            | Mistake::Off { row, .. }
            | Mistake::Sign { joint: row }
            | Mistake::Coupling { joint: row, .. }
            | Mistake::Geared { joint: row, .. }
            | Mistake::ReadingUnit { joint: row, .. }
            | Mistake::Stuck { joint: row, .. } => format!("joint {}", row + 1),
            Mistake::Swapped { joints: [a, b] } => format!("joints {} and {}", a + 1, b + 1),
            Mistake::Other(_) | Mistake::Convention => "robot".to_owned(),
            Mistake::Late { .. } => "readings".to_owned(),
            Mistake::Coordinate { axis: Some(axis), .. } | Mistake::Mirrored { axis, .. } => {
                AXES[axis].to_string()
            }
            Mistake::Exchanged { axes: [a, b], .. } => format!("{} and {}", AXES[a], AXES[b]),
            Mistake::Coordinate { axis: None, .. } => "coordinates".to_owned(),
            Mistake::Load { .. } | Mistake::Moment { .. } => "load".to_owned(),
        }
    }

    /// What is wrong in a file of `count` rows; `family` are the names of the other robots.
    pub(super) fn sentence(self, family: &[&str], count: usize) -> String {
        match self {
            Mistake::Other(k) => format!("the robot is the built-in {}", family[k]),
            Mistake::Convention => {
                "the table is of the other convention (standard for modified, or modified for standard)"
                    .to_owned()
            }
            Mistake::Entry { row, entry, factor } => {
                let (name, told) = match entry {
                    Entry::A => ("a", length(factor)),
                    Entry::D => ("d", length(factor)),
                    Entry::Theta => ("theta", angle(factor)),
                    Entry::Alpha => ("alpha", angle(factor)),
                };
                format!("the table's {name} of joint {} is {told}", row + 1)
            }
            Mistake::TwistSign { row } => {
                format!("the table's alpha of joint {} has the wrong sign", row + 1)
            }
            Mistake::Twist { row, by } => {
                format!("the table's alpha of joint {} is off by {by}°", row + 1)
            }
            Mistake::Zero { joint, by } => {
                format!("the zero of joint {} is off by {by}°: J{0} := J{0} {1} {2}°", joint + 1,
                    if by < 0 { '-' } else { '+' }, by.abs())
            }
            Mistake::Off { row, entry, by } => off(row + 1, entry, by),
            Mistake::Sign { joint } => {
                format!("joint {0} turns against its reading: J{0} := -J{0}", joint + 1)
            }
            Mistake::Coupling { joint, of, ratio } => format!(
                "joint {0}'s reading counts joint {1}'s angle: J{0} := J{0} {2} J{1}{3}",
                joint + 1,
                of + 1,
                if ratio > 0.0 { '+' } else { '-' },
                if (joint, of) == (2, 1) { " (a Fanuc's convention)" } else { "" }
            ),
            Mistake::Geared { joint, of, ratio } if joint == of => format!(
                "joint {0} turns {1:.4} times as far as its reading: J{0} := {1:.4} J{0}",
                joint + 1,
                1.0 + ratio
            ),
            Mistake::Geared { joint, of, ratio } => format!(
                "joint {0} turns with joint {1}, which its reading does not tell: J{0} := J{0} {2} {3:.4} J{1}",
                joint + 1,
                of + 1,
                if ratio > 0.0 { '+' } else { '-' },
                ratio.abs()
            ),
            Mistake::Swapped { joints: [a, b] } => {
                format!("the readings of joints {} and {} stand in each other's columns", a + 1, b + 1)
            }
            Mistake::ReadingUnit { joint, factor } => {
                let told = if factor == DEGREE || factor == 1.0 / DEGREE { angle } else { length };
                format!("the reading of joint {} is {}", joint + 1, told(factor))
            }
            Mistake::Late { rows } => format!(
                "the readings stand {} row{} {} the positions that belong to them",
                rows.abs(),
                if rows.abs() == 1 { "" } else { "s" },
                if rows > 0 { "behind" } else { "ahead of" }
            ),
            Mistake::Stuck { joint, from: 0, until } if until == count => {
                format!("the reading of joint {} is stuck: the joint moves, and its column never changes", joint + 1)
            }
            Mistake::Stuck { joint, from, until } => format!(
                "the reading of joint {} is stuck from measurement {} {}: the joint moves, and its column does not change",
                joint + 1,
                from + 1,
                if until == count { "on".into() } else { format!("to {until}") }
            ),
            Mistake::Coordinate { axis: Some(axis), factor } => {
                format!("the measured {} is {}", AXES[axis], length(factor))
            }
            Mistake::Coordinate { axis: None, factor } => {
                format!("the measured coordinates are {}", length(factor))
            }
            Mistake::Exchanged { axes: [a, b], turns } => format!(
                "the measured {} and {} stand in each other's columns{}",
                AXES[a], AXES[b], of_turns(turns)
            ),
            Mistake::Mirrored { axis, turns } => {
                format!("the measured {} has the wrong sign{}", AXES[axis], of_turns(turns))
            }
            Mistake::Load { factor } => format!("the loads are {}", load(factor)),
            Mistake::Moment { factor } => format!("the moments of the loads are {}", moment(factor)),
        }
    }

    /// How it is mended where `--write-robot` does not do it; empty where it does.
    pub(super) fn mending(self) -> String {
        let (q, unit) = (
            |joint: usize| format!("q{}", joint + 1),
            |name: &str, told: &str, factor: f64| {
                format!(
                    "write {name}[{told}] in the header of the measurement file, or, if that is there, \
                     multiply by {factor:.6}"
                )
            },
        );
        match self {
            _ if self.is_of_robot() => String::new(),
            Mistake::Swapped { joints: [a, b] } => {
                format!(
                    "exchange the names {} and {} in the header of the measurement file",
                    q(a),
                    q(b)
                )
            }
            Mistake::ReadingUnit { joint, factor } => match factor {
                f if f == DEGREE => unit(&q(joint), "deg", f),
                f if f == 1.0 / DEGREE => unit(&q(joint), "rad", f),
                f => unit(&q(joint), length_unit(f), f),
            },
            Mistake::Late { rows } => format!(
                "move the columns of readings {} by {} row{} in the measurement file",
                if rows > 0 { "up" } else { "down" },
                rows.abs(),
                if rows.abs() == 1 { "" } else { "s" }
            ),
            Mistake::Stuck { joint, .. } => {
                format!("read {} again, or leave out the measurements where it is stuck", q(joint))
            }
            Mistake::Coordinate { axis: Some(axis), factor } => {
                unit(&AXES[axis].to_string(), length_unit(factor), factor)
            }
            Mistake::Coordinate { axis: None, factor } => {
                let told = length_unit(factor);
                unit(&format!("x[{told}], y[{told}], z"), told, factor)
            }
            Mistake::Exchanged { axes: [a, b], .. } => format!(
                "exchange the names {} and {} in the header of the measurement file",
                AXES[a], AXES[b]
            ),
            Mistake::Mirrored { axis, .. } => {
                format!("change the sign of {} in the measurement file", AXES[axis])
            }
            Mistake::Load { factor } | Mistake::Moment { factor } => format!(
                "multiply {} by {factor} in the measurement file",
                if self.kind() == "moment_unit" { "mx, my, mz" } else { "fx, fy, fz, mx, my, mz" }
            ),
            _ => String::new(),
        }
    }
}

/// An entry of a row, counted from 1, that is off by an amount, rad or m.
fn off(row: usize, entry: Entry, by: f64) -> String {
    let sign = if by < 0.0 { '-' } else { '+' };
    match entry {
        Entry::Theta => {
            let by = (by / DEGREE).abs();
            format!("the zero of joint {row} is off by {by:.2}°: J{row} := J{row} {sign} {by:.2}°")
        }
        Entry::Alpha => format!("the table's alpha of joint {row} is off by {:.2}°", by / DEGREE),
        Entry::A => format!("the table's a of joint {row} is off by {:.2} mm", 1e3 * by),
        Entry::D => format!("the table's d of joint {row} is off by {:.2} mm", 1e3 * by),
    }
}

fn of_turns(turns: Turns) -> &'static str {
    match turns {
        Turns::Kept => "",
        Turns::AsColumns => ", and so do those of the rotation",
        Turns::LeftHanded => ": the measuring frame is left-handed",
    }
}

/// What a length that has to be multiplied by `factor` is.
fn length(factor: f64) -> &'static str {
    match factor {
        1e-3 => "in millimetres, taken for metres",
        1e3 => "in metres, taken for millimetres",
        0.0254 => "in inches, taken for metres",
        25.4 => "in inches, taken for millimetres",
        f if f < 1.0 => "in millimetres, taken for inches",
        _ => "in metres, taken for inches",
    }
}

/// The unit that the header lacks, where the file has plain metres.
fn length_unit(factor: f64) -> &'static str {
    match factor {
        1e-3 => "mm",
        0.0254 | 25.4 => "in",
        f if f < 1.0 => "mm",
        _ => "m",
    }
}

fn angle(factor: f64) -> &'static str {
    if factor < 1.0 { "in degrees, taken for radians" } else { "in radians, taken for degrees" }
}

fn load(factor: f64) -> String {
    match factor {
        9.80665 => "in kilograms, taken for newtons".to_owned(),
        -9.80665 => "in kilograms, taken for newtons, and have the wrong sign".to_owned(),
        -1.0 => "of the wrong sign".to_owned(),
        4.448_221_615_260_5 => "in pounds, taken for newtons".to_owned(),
        1e3 => "in kilonewtons, taken for newtons".to_owned(),
        f if f < 1.0 => "in newtons, taken for kilograms".to_owned(),
        f => format!("{f} times what the file says"),
    }
}

fn moment(factor: f64) -> &'static str {
    match factor {
        1e-3 => "in N·mm, taken for N·m",
        1e3 => "in kN·m, taken for N·m",
        -1.0 => "of the wrong sign",
        f if f > 1.0 => "in kg·m, taken for N·m",
        _ => "in N·m, taken for kg·m",
    }
}
