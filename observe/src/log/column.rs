//! What a column of a log is, by its name.

use stiffarm_kernels::Motion;

use crate::io::Dimension;
use crate::io::columns::split;
use crate::measurement::WRENCH_NAMES;

/// What is logged of every joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Signal {
    /// Measured value, rad or m.
    Q,
    /// Its rate.
    Qd,
    /// Its acceleration.
    Qdd,
    /// Torque, N·m or N.
    Torque,
    /// The motor's current, A.
    Current,
    /// Commanded value.
    QCmd,
    /// Its rate.
    QdCmd,
    /// Commanded torque.
    TorqueCmd,
    /// °C.
    Temperature,
}

impl Signal {
    /// All of them.
    pub const ALL: [Signal; 9] = [
        Signal::Q,
        Signal::Qd,
        Signal::Qdd,
        Signal::Torque,
        Signal::Current,
        Signal::QCmd,
        Signal::QdCmd,
        Signal::TorqueCmd,
        Signal::Temperature,
    ];

    /// What its columns are called, before the joint's number from 1.
    pub fn name(self) -> &'static str {
        match self {
            Signal::Q => "q",
            Signal::Qd => "qd",
            Signal::Qdd => "qdd",
            Signal::Torque => "tau",
            Signal::Current => "i",
            Signal::QCmd => "q_cmd",
            Signal::QdCmd => "qd_cmd",
            Signal::TorqueCmd => "tau_cmd",
            Signal::Temperature => "temp",
        }
    }

    fn dimension(self, motion: Motion) -> Dimension {
        let [turning, sliding] = match self {
            Signal::Q | Signal::QCmd => [Dimension::Angle, Dimension::Length],
            Signal::Qd | Signal::QdCmd => [Dimension::AngularSpeed, Dimension::Speed],
            Signal::Qdd => [Dimension::AngularAcceleration, Dimension::Acceleration],
            Signal::Torque | Signal::TorqueCmd => [Dimension::Moment, Dimension::Force],
            Signal::Current => [Dimension::Current; 2],
            Signal::Temperature => [Dimension::Temperature; 2],
        };
        if motion == Motion::Revolute { turning } else { sliding }
    }
}

/// The meaning of a column; joints count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Time,
    Joint(Signal, usize),
    Wrench(usize),
    Payload,
    Run,
    Contact,
}

impl Role {
    /// Of a name without its unit; `None` if nothing is known of it.
    pub(super) fn of(name: &str) -> Option<Role> {
        match name {
            "t" => return Some(Role::Time),
            "payload" => return Some(Role::Payload),
            "run" => return Some(Role::Run),
            "contact" => return Some(Role::Contact),
            _ => {}
        }
        if let Some(k) = WRENCH_NAMES.iter().position(|n| *n == name) {
            return Some(Role::Wrench(k));
        }
        let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
        let joint: usize = name[stem.len()..].parse().ok().filter(|joint| *joint > 0)?;
        let signal = Signal::ALL.into_iter().find(|s| s.name() == stem)?;
        Some(Role::Joint(signal, joint - 1))
    }

    pub(super) fn name(self) -> String {
        match self {
            Role::Time => "t".to_owned(),
            Role::Joint(signal, joint) => format!("{}{}", signal.name(), joint + 1),
            Role::Wrench(k) => WRENCH_NAMES[k].to_owned(),
            Role::Payload => "payload".to_owned(),
            Role::Run => "run".to_owned(),
            Role::Contact => "contact".to_owned(),
        }
    }

    /// The quantity of its numbers; `None` of what has no unit.
    pub(super) fn dimension(self, motions: &[Motion]) -> Option<Dimension> {
        match self {
            Role::Time => Some(Dimension::Time),
            Role::Joint(signal, joint) => motions.get(joint).map(|m| signal.dimension(*m)),
            Role::Wrench(k) => Some(if k < 3 { Dimension::Force } else { Dimension::Moment }),
            Role::Payload | Role::Run | Role::Contact => None,
        }
    }
}

/// Whether a header is that of a log: `t`, joint values, and what drives or commands a joint.
pub(super) fn is_log(header: &[impl AsRef<str>]) -> bool {
    let role = |name: &_| Role::of(split(AsRef::as_ref(name)).0);
    let roles: Vec<Role> = header.iter().filter_map(role).collect();
    let has = |signal| roles.iter().any(|r| matches!(r, Role::Joint(s, _) if *s == signal));
    roles.contains(&Role::Time)
        && has(Signal::Q)
        && [Signal::Torque, Signal::Current, Signal::QCmd].into_iter().any(has)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_come_back() {
        for signal in Signal::ALL {
            let role = Role::Joint(signal, 6);
            assert_eq!(Role::of(&role.name()), Some(role));
        }
        for name in ["q", "q0", "tau", "load1", "time", "qx1", "qdd_cmd1", ""] {
            assert_eq!(Role::of(name), None, "{name}");
        }
    }

    #[test]
    fn a_log_is_known_by_its_columns() {
        assert!(is_log(&["t[s]", "q1[rad]", "i1[A]"]));
        assert!(is_log(&["run", "t", "q_cmd1", "q1"]));
        assert!(!is_log(&["t", "q1", "x", "y", "z"]));
        assert!(!is_log(&["time", "q1", "tau1"]));
    }
}
