//! Runs as the text of a joint log.

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::{Logged, Recorded, Side};

/// A log: comment lines, a header with SI units, and one line per sample. `run` and `payload` stand
/// there where there are several, and where something is held.
pub fn csv(arm: &Arm, logged: Logged, runs: &[Recorded], comments: &[String]) -> String {
    let mut text: String = comments.iter().map(|line| format!("# {}\n", line.trim_end())).collect();
    let side = match logged {
        Logged::Torque(Side::Motor) => Some("motor"),
        Logged::Torque(Side::Link) => Some("link"),
        Logged::Torque(Side::Commanded) => Some("commanded"),
        // A column of currents says it itself.
        Logged::Torque(Side::Current) | Logged::Position => None,
    };
    text.extend(side.map(|side| format!("# torque_side = {side}\n")));
    let (several, held) = (runs.len() > 1, runs.iter().any(|run| run.payload.is_some()));
    let mut heads = vec!["t[s]".to_owned()];
    heads.extend(several.then(|| "run".to_owned()));
    heads.extend(held.then(|| "payload".to_owned()));
    let mut add = |name: &str, units: [&str; 2]| {
        for (k, joint) in arm.joints.iter().enumerate() {
            let unit = units[usize::from(joint.motion == Motion::Prismatic)];
            heads.push(format!("{name}{}[{unit}]", k + 1));
        }
    };
    add("q", ["rad", "m"]);
    match logged {
        Logged::Torque(Side::Current) => add("i", ["A"; 2]),
        Logged::Torque(_) => add("tau", ["N*m", "N"]),
        Logged::Position => add("q_cmd", ["rad", "m"]),
    }
    text.push_str(&format!("{}\n", heads.join(",")));
    for run in runs {
        for k in 0..run.t.len() {
            text.push_str(&format!("{:.6}", run.t[k]));
            if several {
                text.push_str(&format!(",{}", run.run));
            }
            if held {
                text.push_str(&format!(",{}", run.payload.as_deref().unwrap_or_default()));
            }
            let beside = if run.tau.is_empty() { &run.q_cmd } else { &run.tau };
            for value in run.q.iter().chain(beside) {
                text.push_str(&format!(",{}", short(value[k])));
            }
            text.push('\n');
        }
    }
    text
}

/// Nine digits: finer than what any sensor says.
fn short(value: f64) -> String {
    let text = format!("{value:.9}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}
