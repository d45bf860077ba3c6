//! Joint states as ROS says them: messages of a topic into rows.
//!
//! Read are `sensor_msgs/JointState` and `control_msgs/JointTrajectoryControllerState` (where joints were to
//! be, and where they are), as ROS 1 and ROS 2 write them. A topic in which two nodes speak of different
//! joints is two: the one that has the arm's joints is read.

use stiffarm_kernels::Motion;

use super::cdr::{Encoding, Fields};
use super::table::{Cell, Header, Table};
use super::{Log, Names};
use crate::io::cell::Decimals;
use crate::io::{Fault, ReadError};

/// What a message is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Positions, velocities and efforts.
    JointState,
    /// What was to be, and what is.
    Controller,
}

/// Vectors of a message in their order, as the columns of a joint are called.
const STATE: [&str; 3] = ["position", "velocity", "effort"];
const CONTROLLER: [&str; 8] = [
    "reference.positions",
    "reference.velocities",
    "reference.accelerations",
    "reference.effort",
    "feedback.positions",
    "feedback.velocities",
    "feedback.accelerations",
    "feedback.effort",
];

impl Kind {
    /// Of the name of a message's type.
    pub(super) fn of(schema: &str) -> Option<Kind> {
        let (package, name) = schema.split_once('/')?;
        match (package, name.trim_start_matches("msg/")) {
            ("sensor_msgs", "JointState") => Some(Kind::JointState),
            ("control_msgs", "JointTrajectoryControllerState") => Some(Kind::Controller),
            _ => None,
        }
    }

    fn parts(self) -> &'static [&'static str] {
        match self {
            Kind::JointState => &STATE,
            Kind::Controller => &CONTROLLER,
        }
    }
}

#[derive(Debug, Default, PartialEq)]
struct Message {
    /// ns.
    stamp: i64,
    joints: Vec<String>,
    /// Those of its kind; empty where it has none.
    parts: Vec<Vec<f64>>,
}

impl Message {
    fn read(kind: Kind, encoding: Encoding, bytes: &[u8]) -> Result<Message, String> {
        let mut fields = Fields::new(encoding, bytes)?;
        let stamp = fields.stamp()?;
        fields.skip_text()?;
        let joints = fields.texts()?;
        let mut parts = Vec::with_capacity(kind.parts().len());
        for k in 0..kind.parts().len() {
            if kind == Kind::Controller && k == CONTROLLER.len() / 2 {
                // The time of a trajectory's point, which ends the first.
                fields.duration()?;
            }
            parts.push(fields.numbers()?);
        }
        Ok(Message { stamp, joints, parts })
    }
}

/// What one topic says of the same joints.
struct Source {
    topic: String,
    kind: Kind,
    joints: Vec<String>,
    /// Which of the kind's vectors the first message has.
    has: Vec<bool>,
    /// Each message: its number in the topic, its stamp in ns, and how many numbers.
    heads: Vec<(u64, i64)>,
    /// The numbers of all of them.
    numbers: Vec<f64>,
    damaged: Vec<(u64, String)>,
}

/// What was heard of joints in a file.
#[derive(Default)]
pub(super) struct Heard {
    sources: Vec<Source>,
    /// Messages of each topic that tells of joints.
    topics: Vec<(String, u64)>,
}

impl Heard {
    /// Takes a message.
    pub(super) fn push(&mut self, topic: &str, kind: Kind, encoding: Encoding, bytes: &[u8]) {
        let count = match self.topics.iter_mut().find(|(name, _)| name == topic) {
            Some((_, count)) => count,
            None => &mut self.topics.push_mut((topic.to_owned(), 0)).1,
        };
        *count += 1;
        let number = *count;
        let message = match Message::read(kind, encoding, bytes) {
            Ok(message) if message.stamp == 0 => Err((message, "found no stamp in its header")),
            Ok(message) => Ok(message),
            Err(reason) => {
                let source = self.sources.iter_mut().find(|s| s.topic == topic);
                return source.map_or((), |s| s.damaged.push((number, reason)));
            }
        };
        let said = match &message {
            Ok(m) | Err((m, _)) => m,
        };
        let same = |s: &Source| s.topic == topic && s.kind == kind && s.joints == said.joints;
        let at = self.sources.iter().position(same);
        let source = match at {
            Some(at) => &mut self.sources[at],
            None => self.sources.push_mut(Source {
                topic: topic.to_owned(),
                kind,
                joints: said.joints.clone(),
                has: said.parts.iter().map(|part| !part.is_empty()).collect(),
                heads: Vec::new(),
                numbers: Vec::new(),
                damaged: Vec::new(),
            }),
        };
        match message {
            Ok(message) => source.push(number, message),
            Err((_, reason)) => source.damaged.push((number, reason.to_owned())),
        }
    }

    /// The log of the topic that has the arm's joints.
    pub(super) fn log(
        mut self,
        file: &str,
        motions: &[Motion],
        names: &Names,
    ) -> Result<Log, ReadError> {
        let names = names.clone().or_of_format("ros");
        if let Some(topic) = names.topic() {
            self.sources.retain(|source| source.topic == topic);
        }
        let listed = |all: &mut dyn Iterator<Item = &str>| {
            let mut all: Vec<&str> = all.collect();
            all.dedup();
            all.join(", ")
        };
        // Most messages first: of several that do not fit it says why.
        self.sources.sort_by_key(|source| core::cmp::Reverse(source.heads.len()));
        let (mut fit, mut error) = (Vec::new(), None);
        for source in self.sources {
            match Table::new(file, &source.header(), motions, &names) {
                Ok(table) => fit.push((table, source)),
                Err(wrong) => {
                    let file = format!("{file}: topic {}", source.topic);
                    error = error.or(Some(ReadError { file, ..wrong }));
                }
            }
        }
        if fit.len() > 1 {
            let topics = listed(&mut fit.iter().map(|(_, source)| source.topic.as_str()));
            let found = format!("the arm's joints in {topics}");
            let fault = Fault::new(found, "them in one topic", "say which with --topic");
            return Err(fault.of(file));
        }
        match (fit.pop(), error) {
            (Some((table, source)), _) => source.fill(table),
            (None, Some(wrong)) => Err(wrong),
            (None, None) => {
                let there = match listed(&mut self.topics.iter().map(|(name, _)| name.as_str())) {
                    none if none.is_empty() => none,
                    topics => format!(" (there are {topics})"),
                };
                let expected = "messages of sensor_msgs/JointState or \
                                control_msgs/JointTrajectoryControllerState in the topic";
                Err(Fault::new(format!("no joint states{there}"), expected, "").of(file))
            }
        }
    }
}

impl Source {
    fn push(&mut self, number: u64, message: Message) {
        let (joints, kinds) = (self.joints.len(), self.kind.parts());
        let parts = || message.parts.iter().zip(&self.has).zip(kinds);
        // What it lacks at first and tells later is not a column: it is let be.
        let wrong = parts().find(|((part, has), _)| **has && part.len() != joints);
        if let Some(((part, _), name)) = wrong {
            let reason = format!("found {} numbers of {name}, expected {joints}", part.len());
            return self.damaged.push((number, reason));
        }
        let told =
            parts().filter(|((_, has), _)| **has).flat_map(|((part, _), _)| part.iter().copied());
        self.numbers.extend(told);
        self.heads.push((number, message.stamp));
    }

    /// `/joint_states/header.stamp`, `/joint_states/elbow/position` …
    fn header(&self) -> Header {
        let topic = format!("/{}", self.topic.trim_start_matches('/'));
        let mut names = vec![format!("{topic}/header.stamp")];
        for (part, has) in self.kind.parts().iter().zip(&self.has) {
            let all = self.joints.iter().filter(|_| *has);
            names.extend(all.map(|joint| format!("{topic}/{joint}/{part}")));
        }
        Header { names, line: None, row: "message", side: None, decimals: Decimals::default() }
    }

    fn fill(self, mut table: Table) -> Result<Log, ReadError> {
        let cells = self.joints.len() * self.has.iter().filter(|has| **has).count();
        let first = self.heads.first().map_or(0, |(_, stamp)| *stamp);
        for (k, (number, stamp)) in self.heads.iter().enumerate() {
            // Nanoseconds since 1970 are more than a double holds; those since the first are not.
            let t = (stamp - first) as f64 * 1e-9;
            let row = &self.numbers[k * cells..(k + 1) * cells];
            let cell = |c: usize| Cell::Number(if c == 0 { t } else { row[c - 1] });
            table.push(*number, (0..cells + 1).map(cell));
        }
        self.damaged.into_iter().for_each(|(number, reason)| table.damaged(number, reason));
        table.end()
    }
}
