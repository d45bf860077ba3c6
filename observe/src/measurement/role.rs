//! What a column of the measurement file means, by its name.

use stiffarm_kernels::Motion;

use super::payload::Payloads;
use crate::instrument::Bench;
use crate::io::{Dimension, Fault, nearest};

/// Components of a measured pose, in the order of a twist.
pub const POSE_NAMES: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// Components of a measured displacement, in the order of a twist.
pub const DISPLACEMENT_NAMES: [&str; 6] = ["dx", "dy", "dz", "drx", "dry", "drz"];

/// What a distance measures: one number, told as the first of six.
pub const DISTANCE_NAMES: [&str; 6] = ["distance", "", "", "", "", ""];

/// What instruments of several kinds read: a length, or two angles.
pub const READING_NAMES: [&str; 6] = ["reading", "", "", "angle_u", "angle_v", ""];

/// The direction along which a component is read.
pub const NORMAL_NAMES: [&str; 3] = ["nx", "ny", "nz"];

/// Two axes of the flange above the horizontal.
pub const TILT_NAMES: [&str; 2] = ["tilt_x", "tilt_y"];

/// Where a camera shows a marker.
pub const PIXEL_NAMES: [&str; 2] = ["u", "v"];

/// The pose of a board in a camera's axes: its place, and its rotation vector.
pub const BOARD_NAMES: [&str; 6] = ["cx", "cy", "cz", "crx", "cry", "crz"];

/// Its orientation as a quaternion.
pub const BOARD_QUATERNION: [&str; 4] = ["cqw", "cqx", "cqy", "cqz"];

/// The point from which a distance is measured.
pub const FROM_NAMES: [&str; 3] = ["from_x", "from_y", "from_z"];

/// Components of a wrench.
pub const WRENCH_NAMES: [&str; 6] = ["fx", "fy", "fz", "mx", "my", "mz"];

/// Prefix of the columns that hold the user's own simulator.
pub const SIM_PREFIX: &str = "sim_";

/// The column of the instrument's standard deviation of every position.
pub const SIGMA: &str = "sigma";

/// Prefix of the columns that hold that of one component.
pub const SIGMA_PREFIX: &str = "sigma_";

/// What the reader has to know of the robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// One per joint, base to tip: a revolute reading is an angle, a prismatic one a length.
    pub motions: Vec<Motion>,
    /// Whether every row has its readings: targets may go without.
    pub readings: bool,
    /// The `[[marker]]` of the robot file.
    pub markers: Vec<Marker>,
    /// The `[[payload]]` of the robot file, and the arm that carries them; `None` without any.
    pub payloads: Option<Payloads>,
    /// What is known of the bench.
    pub bench: Bench,
}

impl Layout {
    /// Of an arm with these joints, base to tip, without markers and payloads, and a bench of which nothing is known.
    pub fn new(motions: impl IntoIterator<Item = Motion>) -> Layout {
        let motions = motions.into_iter().collect();
        Layout { motions, readings: true, markers: Vec::new(), payloads: None, bench: Bench::NONE }
    }
}

/// A measured point on the tool.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// The name that the `marker` column uses.
    pub name: String,
    /// In the tool frame, m; `None` is unknown.
    pub translation: Option<[f64; 3]>,
}

/// Which of the kinds of measurement a column belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Family {
    Pose,
    Displacement,
    Distance,
}

/// The meaning of a column; indices count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    Reading(usize),
    Wrench(usize),
    Direction(usize),
    Temperature,
    Time,
    Pose,
    Marker,
    Session,
    Payload,
    /// The name of the point from which a distance is measured.
    From,
    /// A coordinate of it.
    FromAt(usize),
    /// The name of a place in which the measured point is.
    Point,
    /// The name of a plane.
    Plane,
    /// The component along a direction.
    Along,
    /// A component of the direction.
    Normal(usize),
    /// The name of a zero of such components that nobody knows.
    Zero,
    /// An angle of an inclinometer.
    Tilt(usize),
    /// A coordinate in a camera's picture.
    Pixel(usize),
    /// The name of a camera.
    Camera,
    /// The name of a board.
    Board,
    /// A component of a board's pose.
    BoardPose(usize),
    /// A component of its quaternion.
    BoardTurn(usize),
    Measured(Family, usize),
    Sim(Family, usize),
    /// The instrument's standard deviation of one component; of all positions.
    Sigma(Option<(Family, usize)>),
    Extra,
}

/// The role of the columns of one kind by their number, from 0.
type Numbered = fn(usize) -> Role;

/// Columns of the joints: a letter before the number.
const OF_JOINTS: [(char, Numbered); 2] = [('q', Role::Reading), ('s', Role::Direction)];

/// Columns of one kind by their names.
type Group = (&'static [&'static str], Numbered);

/// All columns but those of the joints and those with a prefix.
const GROUPS: [Group; 24] = [
    (&["temperature"], |_| Role::Temperature),
    (&["time"], |_| Role::Time),
    (&["pose"], |_| Role::Pose),
    (&["marker"], |_| Role::Marker),
    (&["session"], |_| Role::Session),
    (&["payload"], |_| Role::Payload),
    (&DISTANCE_NAMES, |k| Role::Measured(Family::Distance, k)),
    (&["from"], |_| Role::From),
    (&FROM_NAMES, Role::FromAt),
    (&["point"], |_| Role::Point),
    (&["plane"], |_| Role::Plane),
    (&["along"], |_| Role::Along),
    (&["zero"], |_| Role::Zero),
    (&["camera"], |_| Role::Camera),
    (&["board"], |_| Role::Board),
    (&[SIGMA], |_| Role::Sigma(None)),
    (&TILT_NAMES, Role::Tilt),
    (&POSE_NAMES, |k| Role::Measured(Family::Pose, k)),
    (&DISPLACEMENT_NAMES, |k| Role::Measured(Family::Displacement, k)),
    (&WRENCH_NAMES, Role::Wrench),
    (&NORMAL_NAMES, Role::Normal),
    (&PIXEL_NAMES, Role::Pixel),
    (&BOARD_NAMES, Role::BoardPose),
    (&BOARD_QUATERNION, Role::BoardTurn),
];

impl Family {
    pub(crate) const ALL: [Family; 3] = [Family::Pose, Family::Displacement, Family::Distance];

    pub const fn names(self) -> [&'static str; 6] {
        match self {
            Family::Pose => POSE_NAMES,
            Family::Displacement => DISPLACEMENT_NAMES,
            Family::Distance => DISTANCE_NAMES,
        }
    }

    /// As a sentence has it.
    pub const fn words(self) -> &'static str {
        match self {
            Family::Pose => "a pose",
            Family::Displacement => "a displacement",
            Family::Distance => "a distance",
        }
    }

    /// The family and component of `x`, `drz`, ….
    pub(crate) fn component(name: &str) -> Option<(Family, usize)> {
        let of = |f: Family| f.names().iter().position(|n| *n == name).map(|k| (f, k));
        Family::ALL.into_iter().filter(|_| !name.is_empty()).find_map(of)
    }
}

/// Translations come first in a twist, as forces do in a wrench.
pub(crate) const fn component_dimension(component: usize) -> Dimension {
    if component < 3 { Dimension::Length } else { Dimension::Angle }
}

impl Role {
    /// Whether a file with such a column has what instruments read that are no trackers.
    pub(crate) fn is_of_bench(self) -> bool {
        let named = matches!(self, Role::Point | Role::Plane | Role::Along);
        named || matches!(self, Role::Tilt(_) | Role::Pixel(_))
    }

    /// The role of the column called `name` (without its unit).
    pub fn of(name: &str, layout: &Layout) -> Result<Role, Fault> {
        for (letter, role) in OF_JOINTS {
            if let Some(joint) = numbered(name, letter, layout)? {
                return Ok(role(joint));
            }
        }
        let behind = |prefix| name.strip_prefix(prefix).and_then(Family::component);
        if let Some((family, k)) = behind(SIM_PREFIX) {
            return Ok(Role::Sim(family, k));
        }
        if let Some(of) = behind(SIGMA_PREFIX) {
            return Ok(Role::Sigma(Some(of)));
        }
        let within = |(names, role): &Group| names.iter().position(|n| *n == name).map(role);
        let known = GROUPS.iter().filter(|_| !name.is_empty()).find_map(within);
        Ok(known.unwrap_or(Role::Extra))
    }

    /// The quantity that the column holds; `None` for those that carry no unit.
    pub(crate) fn dimension(self, layout: &Layout) -> Option<Dimension> {
        match self {
            Role::Reading(j) => Some(match layout.motions[j] {
                Motion::Revolute => Dimension::Angle,
                Motion::Prismatic => Dimension::Length,
            }),
            Role::Wrench(k) => Some(if k < 3 { Dimension::Force } else { Dimension::Moment }),
            Role::Temperature => Some(Dimension::Temperature),
            Role::Time => Some(Dimension::Time),
            Role::Measured(_, k)
            | Role::BoardPose(k)
            | Role::Sim(_, k)
            | Role::Sigma(Some((_, k))) => Some(component_dimension(k)),
            Role::Sigma(None) => Some(Dimension::Length),
            Role::FromAt(_) | Role::Along => Some(Dimension::Length),
            Role::Tilt(_) => Some(Dimension::Angle),
            Role::Pixel(_) => Some(Dimension::Pixels),
            Role::Direction(_) | Role::Pose | Role::Marker | Role::Extra => None,
            Role::Session | Role::Payload | Role::From | Role::Point | Role::Plane => None,
            Role::Zero => None,
            Role::Normal(_) | Role::BoardTurn(_) | Role::Camera | Role::Board => None,
        }
    }
}

/// `q3` as joint index 2; `None` if the name is not the letter and digits alone.
fn numbered(name: &str, letter: char, layout: &Layout) -> Result<Option<usize>, Fault> {
    let Some(digits) = name.strip_prefix(letter) else { return Ok(None) };
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return Ok(None);
    }
    let joints = layout.motions.len();
    let known = digits.parse().ok().filter(|n: &usize| (1..=joints).contains(n));
    match known.filter(|_| !digits.starts_with('0')) {
        Some(number) => Ok(Some(number - 1)),
        None => {
            let expected = if joints == 1 { "1".to_owned() } else { format!("1 to {joints}") };
            let help = "joints are numbered from 1 at the base, without leading zeros";
            Err(Fault::new(format!("joint number {digits}"), expected, help))
        }
    }
}

/// The known column that an unknown one may have been meant to be.
pub(crate) fn nearest_name(found: &str, layout: &Layout) -> Option<String> {
    let joints = (1..=layout.motions.len()).flat_map(|j| OF_JOINTS.map(|(l, _)| format!("{l}{j}")));
    let plain = GROUPS.iter().flat_map(|(names, _)| *names).map(|name| (*name).to_owned());
    let measured = || POSE_NAMES.into_iter().chain(DISPLACEMENT_NAMES);
    let prefixed = |prefix| measured().map(move |n| format!("{prefix}{n}"));
    let prefixed = prefixed(SIM_PREFIX).chain(prefixed(SIGMA_PREFIX));
    let names: Vec<String> = joints.chain(plain).chain(prefixed).collect();
    // One edit turns any short name into any other; of those only the case can be mistaken.
    let of_case = names.iter().find(|n| !n.is_empty() && n.eq_ignore_ascii_case(found));
    let near = || nearest(found, names.iter().map(String::as_str).filter(|n| n.len() > 3));
    of_case.map(String::as_str).or_else(near).map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layout() -> Layout {
        Layout::new([Motion::Revolute, Motion::Prismatic])
    }

    #[test]
    fn names_have_roles() {
        let role = |name| Role::of(name, &layout()).unwrap();
        assert_eq!(role("q2"), Role::Reading(1));
        assert_eq!(role("s1"), Role::Direction(0));
        assert_eq!(role("mz"), Role::Wrench(5));
        assert_eq!(role("drx"), Role::Measured(Family::Displacement, 3));
        assert_eq!(role("sim_rz"), Role::Sim(Family::Pose, 5));
        assert_eq!(role("sigma"), Role::Sigma(None));
        assert_eq!(role("sigma_dy"), Role::Sigma(Some((Family::Displacement, 1))));
        assert_eq!(role("sim_distance"), Role::Sim(Family::Distance, 0));
        assert_eq!((role("from_z"), role("session")), (Role::FromAt(2), Role::Session));
        for extra in ["Q1", "q", "qa", "q1b", "speed", "sim_q1", "sigma_q1", "sim_", "", "ycd_dy"] {
            assert_eq!(role(extra), Role::Extra, "{extra}");
        }
    }

    #[test]
    fn joints_that_are_not_there_are_mistakes() {
        for name in ["q0", "q3", "s3", "q01", "q99999999999999999999999"] {
            let fault = Role::of(name, &layout()).unwrap_err();
            let told = (fault.found, &*fault.expected);
            assert_eq!(told, (format!("joint number {}", &name[1..]), "1 to 2"), "{name}");
        }
    }

    #[test]
    fn a_prismatic_reading_is_a_length() {
        let layout = layout();
        assert_eq!(Role::Reading(0).dimension(&layout), Some(Dimension::Angle));
        assert_eq!(Role::Reading(1).dimension(&layout), Some(Dimension::Length));
        assert_eq!(Role::Pose.dimension(&layout), None);
    }

    #[test]
    fn suggests_what_may_have_been_meant() {
        let near = |name| nearest_name(name, &layout());
        assert_eq!(near("temprature").as_deref(), Some("temperature"));
        assert_eq!(near("Q1").as_deref(), Some("q1"));
        assert_eq!(near("sim_drq").as_deref(), Some("sim_drx"));
        assert_eq!(near("w"), None);
        assert_eq!(near("ycd_dy"), None);
    }
}
