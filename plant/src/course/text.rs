//! A motion as a file of commands.

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::{Course, State};
use crate::io::Columns;

/// Digits behind the point: finer than any controller is told.
const DIGITS: usize = 7;

/// `t`, `q_cmd1 …` and `qd_cmd1 …` at even steps, as controllers take them and a log has them.
pub fn commands(arm: &Arm, course: &dyn Course, rate: f64, comments: &[String]) -> String {
    // Of zero no sign is told.
    let shown = |x: f64| format!("{:.DIGITS$}", (x * 1e7).round() / 1e7 + 0.0);
    let mut columns: Columns<'_, (f64, State)> = Columns::default();
    columns.add("t[s]", |(time, _)| shown(*time));
    type Numbers = fn(&State) -> &Vec<f64>;
    let both: [(&str, &str, Numbers); 2] = [("q_cmd", "", |s| &s.q), ("qd_cmd", "/s", |s| &s.qd)];
    for (name, per, numbers) in both {
        for (k, joint) in arm.joints.iter().enumerate() {
            let unit = if joint.motion == Motion::Revolute { "rad" } else { "m" };
            let cell = move |(_, state): &(f64, State)| shown(numbers(state)[k]);
            columns.add(format!("{name}{}[{unit}{per}]", k + 1), cell);
        }
    }
    let times = (0..=(course.duration() * rate).round() as usize).map(|k| k as f64 / rate);
    columns.text(comments, times.map(|time| (time, course.at(time))))
}
