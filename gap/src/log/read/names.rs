//! What the columns are called by others.
//!
//! Joints count from 0 there (`actual_q_0`, `position[0]`, `q.0`), or stand by their names
//! (`observation.state.shoulder_pan`, `/joint_states/elbow/position`).

use std::collections::BTreeMap;

use super::LogError;
use super::column::{Role, Signal, split};
use crate::readings::map::{Map, Theirs};

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

    /// What a header is, and what the map says of it; the index of the map's entry is marked used.
    pub(super) fn role<'m>(
        &'m self,
        header: &str,
        used: &mut BTreeMap<String, ()>,
    ) -> Result<Option<(Role, Option<&'m Theirs>)>, LogError> {
        let (name, _) = split(header);
        let said = |(_, theirs): &(&String, &Theirs)| [header, name].contains(&&*theirs.column);
        if let Some((ours, theirs)) = self.map.columns.iter().find(said) {
            used.insert(ours.clone(), ());
            let role = Role::of(ours).ok_or_else(|| LogError::Map {
                map: self.map.file.clone(),
                message: format!(
                    "found `{ours}` among the columns, expected a name of ours: t, q1 …, qd1, \
                     qdd1, tau1, i1, q_cmd1, qd_cmd1, tau_cmd1, temp1, fx … mz, payload, run, \
                     contact"
                ),
            })?;
            return Ok(Some((role, Some(theirs))));
        }
        let ours = Role::of(name).or_else(|| self.by_joint(name));
        let foreign = || self.format.and_then(|format| self.foreign(format, header));
        Ok(ours.or_else(foreign).map(|role| (role, None)))
    }

    /// The first entry of the map that no header has.
    pub(super) fn unused(&self, used: &BTreeMap<String, ()>) -> Option<(&str, &Theirs)> {
        let unused = self.map.columns.iter().find(|(ours, _)| !used.contains_key(*ours));
        unused.map(|(ours, theirs)| (ours.as_str(), theirs))
    }

    pub(super) fn map_file(&self) -> &str {
        &self.map.file
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
        self.joints.iter().position(|j| j == name)
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

#[cfg(test)]
mod tests {
    use super::*;

    fn names() -> Names {
        Names::own(vec!["shoulder_pan".to_owned(), "elbow".to_owned()])
    }

    fn role(names: &Names, header: &str) -> Option<Role> {
        names.role(header, &mut BTreeMap::new()).unwrap().map(|(role, _)| role)
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
            assert_eq!(role(&names, header), expected, "{format}: {header}");
        }
        assert!(names().of_format("excel").is_none());
    }

    #[test]
    fn ours_may_have_the_joints_names() {
        assert_eq!(role(&names(), "q_cmd_elbow[rad]"), Some(Role::Joint(Signal::QCmd, 1)));
        assert_eq!(role(&names(), "tau.shoulder_pan"), Some(Role::Joint(Signal::Torque, 0)));
        assert_eq!(role(&names(), "q_wrist"), None);
    }

    #[test]
    fn a_map_comes_first() {
        let map = Map::read("m.toml", "[columns]\nq1 = \"A\"\ntau1 = \"q2\"\n").unwrap();
        let names = names().mapped(map);
        assert_eq!(role(&names, "A[deg]"), Some(Role::Joint(Signal::Q, 0)));
        assert_eq!(role(&names, "q2"), Some(Role::Joint(Signal::Torque, 0)));
        let wrong = names.mapped(Map::read("m.toml", "[columns]\nspeed = \"v\"\n").unwrap());
        assert!(matches!(wrong.role("v", &mut BTreeMap::new()), Err(LogError::Map { .. })));
    }
}
