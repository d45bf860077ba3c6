//! Runs as the text of a joint log.

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::{Logged, Recorded, Side};
use crate::io::{Columns, digits, quoted};

/// Digits behind the point: finer than what any sensor says.
const DIGITS: usize = 9;

/// A log: comment lines, a header with SI units, and one line per sample. `run` and `payload` stand
/// there where there are several, and where something is held.
pub fn csv(arm: &Arm, logged: Logged, runs: &[Recorded], comments: &[String]) -> String {
    let (beside, units, side) = match logged {
        Logged::Torque(Side::Motor) => ("tau", ["N*m", "N"], Some("motor")),
        Logged::Torque(Side::Link) => ("tau", ["N*m", "N"], Some("link")),
        Logged::Torque(Side::Commanded) => ("tau", ["N*m", "N"], Some("commanded")),
        // A column of currents says it itself.
        Logged::Torque(Side::Current) => ("i", ["A"; 2], None),
        Logged::Position => ("q_cmd", ["rad", "m"], None),
    };
    let side = side.map(|side| format!("torque_side = {side}"));
    let mut columns: Columns<'_, (&Recorded, usize)> = Columns::default();
    columns.add("t[s]", |(run, k)| format!("{:.6}", run.t[*k]));
    if runs.len() > 1 {
        columns.add("run", |(run, _)| run.run.to_string());
    }
    if runs.iter().any(|run| run.payload.is_some()) {
        columns.add("payload", |(run, _)| quoted(run.payload.as_deref()));
    }
    type Signal = fn(&Recorded) -> &Vec<Vec<f64>>;
    let q: Signal = |run| &run.q;
    let driven: Signal = |run| if run.tau.is_empty() { &run.q_cmd } else { &run.tau };
    for (name, units, signal) in [("q", ["rad", "m"], q), (beside, units, driven)] {
        for (j, joint) in arm.joints.iter().enumerate() {
            let unit = units[usize::from(joint.motion == Motion::Prismatic)];
            columns.add(format!("{name}{}[{unit}]", j + 1), move |(run, k)| {
                digits(signal(run)[j][*k], DIGITS)
            });
        }
    }
    let samples = runs.iter().flat_map(|run| (0..run.t.len()).map(move |k| (run, k)));
    columns.text(comments.iter().chain(&side), samples)
}
