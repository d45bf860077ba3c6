//! What the columns are called by others.
//!
//! Joints count from 0 there (`actual_q_0`, `position[0]`, `q.0`), or stand by their names
//! (`observation.state.shoulder_pan`, `/joint_states/elbow/position`).

use super::column::{Role, Signal};
use crate::io::Map;
use crate::io::columns::split;

/// Of one program: what it calls the time, and the stems of what it logs of every joint.
struct Format {
    name: &'static str,
    time: &'static str,
    /// What tells the runs apart.
    run: &'static str,
    stems: &'static [(&'static str, Signal)],
}

const FORMATS: [Format; 6] = [
    Format {
        name: "ros",
        time: "header.stamp",
        run: "",
        stems: &[
            ("position", Signal::Q),
            ("velocity", Signal::Qd),
            ("effort", Signal::Torque),
            ("reference.positions", Signal::QCmd),
            ("reference.velocities", Signal::QdCmd),
            ("feedback.positions", Signal::Q),
            ("feedback.velocities", Signal::Qd),
            ("feedback.effort", Signal::Torque),
        ],
    },
    Format {
        name: "rtde",
        time: "timestamp",
        run: "",
        stems: &[
            ("actual_q", Signal::Q),
            ("actual_qd", Signal::Qd),
            ("actual_current", Signal::Current),
            ("target_q", Signal::QCmd),
            ("target_qd", Signal::QdCmd),
            ("target_moment", Signal::TorqueCmd),
            ("joint_temperatures", Signal::Temperature),
        ],
    },
    Format {
        name: "libfranka",
        time: "time",
        run: "",
        stems: &[
            ("q", Signal::Q),
            ("dq", Signal::Qd),
            ("tau_J", Signal::Torque),
            ("q_d", Signal::QCmd),
            ("dq_d", Signal::QdCmd),
            ("tau_J_d", Signal::TorqueCmd),
        ],
    },
    Format {
        name: "lerobot",
        time: "timestamp",
        run: "episode_index",
        stems: &[("observation.state", Signal::Q), ("action", Signal::QCmd)],
    },
    Format {
        name: "sage",
        time: "timestamp",
        run: "",
        stems: &[("positions", Signal::Q), ("velocities", Signal::Qd), ("torques", Signal::Torque)],
    },
    Format {
        name: "pace",
        time: "time",
        run: "",
        stems: &[("dof_pos", Signal::Q), ("des_dof_pos", Signal::QCmd)],
    },
];

/// What is said of a log's columns.
#[derive(Clone, Debug, Default)]
pub struct Names {
    format: Option<&'static Format>,
    map: Map,
    #[cfg_attr(
        not(any(feature = "mcap", feature = "rosbag2")),
        expect(dead_code, reason = "formats with topics are features")
    )]
    topic: Option<String>,
    /// The joints' names, base to tip.
    joints: Vec<String>,
    /// Whether joint values, sent or measured, are all that is needed.
    motion: bool,
}

impl core::fmt::Debug for Format {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.name)
    }
}

impl Names {
    /// Our own names, of an arm whose joints are called so.
    pub fn own(joints: Vec<String>) -> Names {
        Names { joints, ..Names::default() }
    }

    /// Of a motion that is to be followed: it needs no more than where the joints are sent.
    pub fn of_motion(self) -> Names {
        Names { motion: true, ..self }
    }

    /// Whether joint values, sent or measured, are all that is needed.
    pub(super) fn is_of_motion(&self) -> bool {
        self.motion
    }

    /// Those of a program, by its name; `None` if it is none of [`Names::formats`].
    pub fn of_format(self, name: &str) -> Option<Names> {
        let format = FORMATS.iter().find(|f| f.name == name)?;
        Some(Names { format: Some(format), ..self })
    }

    /// Those of a map, which may be given for any columns whatever.
    pub fn mapped(self, map: Map) -> Names {
        Names { map, ..self }
    }

    /// Of messages those of this topic.
    pub fn of_topic(self, topic: String) -> Names {
        Names { topic: Some(topic), ..self }
    }

    #[cfg(any(feature = "mcap", feature = "rosbag2"))]
    pub(super) fn topic(&self) -> Option<&str> {
        self.topic.as_deref()
    }

    /// Those of a program where no other is named.
    #[cfg(any(feature = "mcap", feature = "rosbag2"))]
    pub(super) fn or_of_format(self, name: &str) -> Names {
        if self.format.is_some() { self } else { self.clone().of_format(name).unwrap_or(self) }
    }

    /// The programs whose names are known.
    pub fn formats() -> impl Iterator<Item = &'static str> {
        FORMATS.iter().map(|f| f.name)
    }

    /// What is said of the columns.
    pub(super) fn map(&self) -> &Map {
        &self.map
    }

    /// What a column of this header is by its name.
    pub(super) fn role(&self, header: &str) -> Option<Role> {
        let (name, _) = split(header);
        let ours = Role::of(name).or_else(|| self.by_joint(name));
        ours.or_else(|| self.format.and_then(|format| self.foreign(format, header)))
    }

    /// `q_elbow`: ours with a joint's name.
    fn by_joint(&self, name: &str) -> Option<Role> {
        let signals = Signal::ALL.into_iter().rev();
        signals.into_iter().find_map(|signal| {
            let joint = name.strip_prefix(signal.name())?.strip_prefix(['_', '.'])?;
            Some(Role::Joint(signal, self.joint(joint)?))
        })
    }

    fn joint(&self, name: &str) -> Option<usize> {
        // LeRobot says what of a motor: `elbow_flex.pos`.
        let name = name.strip_suffix(".pos").unwrap_or(name);
        let own = self.joints.iter().position(|j| j == name);
        let is_unnamed = |(k, j): (usize, &String)| *j == format!("joint {}", k + 1);
        own.or_else(|| {
            let drivers =
                self.joints.iter().enumerate().all(is_unnamed).then(|| driver_joint(name));
            drivers.flatten().filter(|joint| *joint < self.joints.len())
        })
    }

    fn foreign(&self, format: &Format, header: &str) -> Option<Role> {
        let plain = header.trim_start_matches('/');
        if plain == format.time || plain.ends_with(&format!("/{}", format.time)) {
            return Some(Role::Time);
        }
        if plain == format.run {
            return Some(Role::Run);
        }
        format.stems.iter().find_map(|(stem, signal)| {
            let role = |joint| Role::Joint(*signal, joint);
            // `/joint_states/elbow/position`.
            if let Some(before) = plain.strip_suffix(&format!("/{stem}")) {
                return self.joint(before.rsplit('/').next()?).map(role);
            }
            let last = plain.rsplit('/').next()?;
            let index = last.strip_prefix(stem)?.strip_prefix(['_', '.', '['])?;
            let index = index.trim_end_matches(']');
            index.parse().ok().or_else(|| self.joint(index)).map(role)
        })
    }
}

/// Universal Robots' names in ROS, before `_joint`.
const UNIVERSAL_ROBOTS: [&str; 6] =
    ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"];

/// The joint that a maker's driver for ROS calls so, whatever the arm is called before it: `panda_joint1`, `joint_a2`,
/// `lbr_A3`, `ur10e_elbow_joint`. A gripper's fingers are joints, too, and none of the arm's.
fn driver_joint(name: &str) -> Option<usize> {
    let name = name.to_ascii_lowercase();
    if ["finger", "gripper", "hand"].iter().any(|tool| name.contains(tool)) {
        return None;
    }
    if let Some(stem) = name.strip_suffix("_joint") {
        return UNIVERSAL_ROBOTS.iter().position(|joint| stem.ends_with(joint));
    }
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let number: usize = name[stem.len()..].parse().ok()?;
    let word = stem.trim_end_matches('_').rsplit(['_', ' ', '/']).next()?;
    ["joint", "axis", "a", "j"].contains(&word).then(|| number.checked_sub(1)).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names() -> Names {
        Names::own(vec!["shoulder_pan".to_owned(), "elbow".to_owned()])
    }

    #[test]
    fn each_program_has_its_names() {
        let second = |signal| Some(Role::Joint(signal, 1));
        for (format, header, expected) in [
            ("rtde", "actual_q_1", second(Signal::Q)),
            ("rtde", "actual_qd_1", second(Signal::Qd)),
            ("rtde", "timestamp", Some(Role::Time)),
            ("rtde", "actual_TCP_pose_1", None),
            ("ros", "/joint_states/position[1]", second(Signal::Q)),
            ("ros", "/joint_states/elbow/effort", second(Signal::Torque)),
            ("ros", "/joint_states/header.stamp", Some(Role::Time)),
            ("libfranka", "tau_J[1]", second(Signal::Torque)),
            ("libfranka", "tau_J_d[1]", second(Signal::TorqueCmd)),
            ("libfranka", "q_d[1]", second(Signal::QCmd)),
            ("lerobot", "observation.state.elbow.pos", second(Signal::Q)),
            ("lerobot", "action.1", second(Signal::QCmd)),
            ("pace", "des_dof_pos_1", second(Signal::QCmd)),
            ("sage", "torques.elbow", second(Signal::Torque)),
            ("sage", "positions[1]", second(Signal::Q)),
            ("lerobot", "episode_index", Some(Role::Run)),
            ("ros", "/arm/elbow/reference.positions", second(Signal::QCmd)),
        ] {
            let names = names().of_format(format).unwrap();
            assert_eq!(names.role(header), expected, "{format}: {header}");
        }
        assert!(names().of_format("excel").is_none());
    }

    #[test]
    fn ours_may_have_the_joints_names() {
        assert_eq!(names().role("q_cmd_elbow[rad]"), Some(Role::Joint(Signal::QCmd, 1)));
        assert_eq!(names().role("tau.shoulder_pan"), Some(Role::Joint(Signal::Torque, 0)));
        assert_eq!(names().role("q_wrist"), None);
    }
    /// The joints of a built-in arm have no names: those of its maker's driver are known.
    #[test]
    fn drivers_names_are_known_where_a_file_has_none() {
        let arm = |dof: usize| {
            let own = (1..=dof).map(|k| format!("joint {k}")).collect();
            Names::own(own).of_format("ros").unwrap()
        };
        for (header, joint) in [
            ("/joint_states/panda_joint7/position", Some(6)),
            ("/joint_states/fr3_joint1/position", Some(0)),
            ("/joint_states/panda_finger_joint1/position", None),
            ("/joint_states/joint_a2/position", Some(1)),
            ("/joint_states/lbr_A3/position", Some(2)),
            ("/joint_states/joint_8/position", None),
            ("/joint_states/joint_0/position", None),
            ("/joint_states/wheel1/position", None),
            ("/joint_states/ur10e_wrist_2_joint/position", Some(4)),
            ("/joint_states/elbow_joint/position", Some(2)),
        ] {
            let role = joint.map(|joint| Role::Joint(Signal::Q, joint));
            assert_eq!(arm(7).role(header), role, "{header}");
        }
        // Of a file that names its joints only its own.
        assert_eq!(names().of_format("ros").unwrap().role("/joint_states/joint_1/position"), None);
    }
}
