//! What a column is by its name, and the unit that stands in it.

use crate::instrument::Bench;
use crate::io::{Convention, Unit};
use crate::measurement::{BOARD_NAMES, DISPLACEMENT_NAMES, Layout, POSE_NAMES, Role, WRENCH_NAMES};

/// What a column is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    /// A column of the measurement file, by its name there.
    Ours(String),
    /// Joint `n` of a program that counts from 0.
    FromZero(usize),
    /// One number of an orientation that is no rotation vector.
    Orientation(Convention, usize),
    /// What hangs on the tool: its mass, or its name.
    Load,
    /// The day of a time of day.
    Date,
}

/// What others call a joint's reading, before its number.
const JOINTS: [&str; 10] =
    ["q", "j", "a", "joint", "axis", "achse", "gelenk", "theta", "jointangle", "jointposition"];

/// The same of a program that counts from 0 (UR's real-time data).
const JOINTS_FROM_ZERO: [&str; 2] = ["actualq", "actualqpos"];

/// What others write around the letter of an axis: `PosX`, `X_tcp`.
const AROUND: [(&str, &str); 11] = [
    ("", ""),
    ("pos", ""),
    ("position", ""),
    ("tcp", ""),
    ("", "pos"),
    ("", "position"),
    ("", "tcp"),
    ("actual", ""),
    ("measured", ""),
    ("tracker", ""),
    ("ist", ""),
];

/// What others call the columns that have no number.
const WORDS: [(&str, &[&str]); 8] = [
    ("temperature", &["temp", "temperatur", "temperature", "tempc"]),
    ("time", &["time", "timestamp", "zeit", "uhrzeit", "seconds"]),
    ("pose", &["pose", "poseid", "posture", "config", "configuration", "konfiguration"]),
    ("marker", &["marker", "target", "reflector", "smr", "reflektor"]),
    ("session", &["session", "sessionid", "sitting", "setup", "station", "sitzung", "aufstellung"]),
    ("sigma", &["sigma", "std", "stdev", "stddev", "standarddeviation", "standardabweichung"]),
    ("distance", &["distance", "dist", "ballbar", "abstand", "entfernung"]),
    ("from", &FIXED),
];

/// What others call the fixed end of a distance.
const FIXED: [&str; 5] = ["from", "anchor", "socket", "fixedpoint", "festpunkt"];

/// What others write before the name of a component whose standard deviation a column is.
const SIGMAS: [&str; 4] = ["sigma", "std", "stdev", "stddev"];

/// Names of what hangs on the tool.
const LOADS: [&str; 12] = [
    "mass",
    "payload",
    "payloadmass",
    "masse",
    "last",
    "zuladung",
    "load",
    "loadmass",
    "nutzlast",
    "traglast",
    "weight",
    "gewicht",
];

/// What others call the day.
const DATES: [&str; 3] = ["date", "datum", "day"];

/// Any arm: what is not a joint's is the same on all.
pub(super) const ANY: Layout = Layout {
    motions: Vec::new(),
    markers: Vec::new(),
    readings: false,
    payloads: None,
    bench: Bench::NONE,
};

/// The numbers of an orientation, by their names.
const ORIENTATIONS: [(Convention, &[&str]); 7] = [
    (Convention::ABC, &["a", "b", "c"]),
    (Convention::RPY, &["roll", "pitch", "yaw"]),
    (Convention::RPY, &["w", "p", "r"]),
    (Convention::Quaternion, &["qw", "qx", "qy", "qz"]),
    (Convention::Quaternion, &["quatw", "quatx", "quaty", "quatz"]),
    (Convention::Quaternion, &["ow", "ox", "oy", "oz"]),
    (Convention::Matrix, &["r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"]),
];

/// The name without its unit, and the unit as written: `X [mm]`, `X (mm)`, `X/mm`, `x_mm`.
pub(super) fn split(header: &str) -> (&str, Option<&str>) {
    let header = header.trim();
    for (open, close) in [('[', ']'), ('(', ')'), ('{', '}')] {
        if let Some((name, rest)) = header.split_once(open) {
            return (name.trim(), Some(rest.trim_end().trim_end_matches(close).trim()));
        }
    }
    let tail = header
        .rsplit_once(['/', '_', ' '])
        .filter(|(name, unit)| !name.trim().is_empty() && Unit::spelled(unit).is_some())
        // Of a letter or a minimum nobody knows that it is a unit.
        .filter(|(_, unit)| !["min", "h", "d"].contains(unit));
    match tail {
        Some((name, unit)) => (name.trim(), Some(unit.trim())),
        None => (header, None),
    }
}

impl Meaning {
    /// The same name for columns that mean the same.
    pub(super) fn name(&self) -> String {
        let orientation = |of: &Convention, k: &usize| {
            let names = ORIENTATIONS.iter().find(|(convention, _)| convention == of);
            names.map_or_else(String::new, |(_, names)| names[*k].to_owned())
        };
        match self {
            Meaning::Ours(name) => name.clone(),
            Meaning::FromZero(index) => format!("q{}", index + 1),
            Meaning::Orientation(convention, k) => orientation(convention, k),
            Meaning::Load => LOADS[0].to_owned(),
            Meaning::Date => DATES[0].to_owned(),
        }
    }

    /// A joint's reading where joints count from 0.
    pub(super) fn after_zero(self) -> Meaning {
        let number = match &self {
            Meaning::Ours(name) => name.strip_prefix('q').and_then(|n| n.parse::<usize>().ok()),
            _ => None,
        };
        number.map_or(self, |n| Meaning::Ours(format!("q{}", n + 1)))
    }
}

/// Letters and digits alone, in small letters.
fn folded(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// What a column of this name is (without its unit); `None` if nothing is known of it.
pub(super) fn meaning(name: &str) -> Option<Meaning> {
    let folded = folded(name);
    let ours = |name: &str| Some(Meaning::Ours(name.to_owned()));
    if let Some(word) = WORDS.iter().find(|(_, theirs)| theirs.contains(&folded.as_str())) {
        return ours(word.0);
    }
    if LOADS.contains(&folded.as_str()) {
        return Some(Meaning::Load);
    }
    if DATES.contains(&folded.as_str()) {
        return Some(Meaning::Date);
    }
    if Role::of(name, &ANY).is_ok_and(|role| role != Role::Extra) {
        return ours(name);
    }
    let plain = POSE_NAMES.iter().chain(&DISPLACEMENT_NAMES).chain(&WRENCH_NAMES);
    if let Some(name) = plain.clone().find(|n| **n == folded) {
        return ours(name);
    }
    for (convention, names) in ORIENTATIONS {
        if let Some(k) = names.iter().position(|n| *n == folded) {
            return Some(Meaning::Orientation(convention, k));
        }
    }
    let behind = |words: &[&str]| -> Option<String> {
        words.iter().find_map(|word| folded.strip_prefix(word)).map(str::to_owned)
    };
    if let Some(component) = behind(&SIGMAS).filter(|of| plain.clone().any(|n| n == of)) {
        return ours(&format!("sigma_{component}"));
    }
    if let Some(axis) = behind(&FIXED).filter(|of| ["x", "y", "z"].contains(&of.as_str())) {
        return ours(&format!("from_{axis}"));
    }
    let numbered = |letters: &[&str]| {
        let digits = folded.trim_start_matches(|c: char| !c.is_ascii_digit());
        let before = &folded[..folded.len() - digits.len()];
        letters.contains(&before).then(|| digits.parse::<usize>().ok()).flatten()
    };
    if let Some(index) = numbered(&JOINTS_FROM_ZERO) {
        return Some(Meaning::FromZero(index));
    }
    if let Some(number) = numbered(&JOINTS) {
        return if number == 0 { Some(Meaning::FromZero(0)) } else { ours(&format!("q{number}")) };
    }
    if let Some(number) = numbered(&["s", "direction", "approach"]).filter(|n| *n > 0) {
        return ours(&format!("s{number}"));
    }
    let around = |axis: &str, word: &str| {
        AROUND.iter().any(|(before, after)| folded == format!("{before}{word}{axis}{after}"))
    };
    // OpenCV's vectors of a board in a camera's axes, by axes or by numbers from 0.
    for (word, first) in [("tvec", 0), ("rvec", 3)] {
        let axis = folded.strip_prefix(word).and_then(|axis| {
            ["x", "y", "z"].iter().position(|a| *a == axis).or(axis.parse().ok().filter(|n| *n < 3))
        });
        if let Some(axis) = axis {
            return ours(BOARD_NAMES[first + axis]);
        }
    }
    let words = [["", "r", "rot"], ["f", "force", "kraft"], ["t", "torque", "moment"]];
    for (letter, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let [poses, forces, moments] = words;
        if around(axis, poses[0]) {
            return ours(POSE_NAMES[letter]);
        }
        if poses[1..].iter().any(|word| around(axis, word)) {
            return ours(POSE_NAMES[3 + letter]);
        }
        if forces.iter().any(|word| around(axis, word)) {
            return ours(WRENCH_NAMES[letter]);
        }
        if moments.iter().any(|word| around(axis, word)) {
            return ours(WRENCH_NAMES[3 + letter]);
        }
    }
    None
}

/// The point and the axis of a coordinate in a row that has several points: `X1`, `SMR2_y`, `T3.Z`.
pub(super) fn of_point(name: &str) -> Option<(&str, usize)> {
    let axis = |c: char| ['x', 'y', 'z'].iter().position(|axis| *axis == c.to_ascii_lowercase());
    let separators = [' ', '_', '.', '-'];
    let (first, last) = (name.chars().next()?, name.chars().next_back()?);
    let (point, axis) = match (axis(first), axis(last)) {
        (Some(axis), _) => (&name[1..], axis),
        (None, Some(axis)) => (&name[..name.len() - 1], axis),
        (None, None) => return None,
    };
    let point = point.trim_matches(separators);
    // Points are numbered; what has no number (`Gx`) may be anything.
    point.contains(|c: char| c.is_ascii_digit()).then_some((point, axis))
}
