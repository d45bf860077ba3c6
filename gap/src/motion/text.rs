//! A motion as a file of commands.

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::Course;

/// Digits behind the point: finer than any controller is told.
const DIGITS: usize = 7;

/// `t`, `q_cmd1 …` and `qd_cmd1 …` at even steps, as controllers take them and a log has them.
pub fn commands(arm: &Arm, course: &dyn Course, rate: f64, comments: &[String]) -> String {
    let mut text: String = comments.iter().map(|line| format!("# {line}\n")).collect();
    let unit = |motion: Motion| if motion == Motion::Revolute { "rad" } else { "m" };
    let heads = |name: &str, per: &str| -> Vec<String> {
        let head = |(k, joint): (usize, &stiffarm_kernels::generic::Joint)| {
            format!("{name}{}[{}{per}]", k + 1, unit(joint.motion))
        };
        arm.joints.iter().enumerate().map(head).collect()
    };
    let all = [vec!["t[s]".to_owned()], heads("q_cmd", ""), heads("qd_cmd", "/s")].concat();
    text.push_str(&format!("{}\n", all.join(",")));
    let steps = (course.duration() * rate).round() as usize;
    for k in 0..=steps {
        let time = k as f64 / rate;
        let state = course.at(time);
        let numbers = core::iter::once(&time).chain(&state.q).chain(&state.qd);
        // Of zero no sign is told.
        let cells: Vec<String> =
            numbers.map(|x| format!("{:.DIGITS$}", (x * 1e7).round() / 1e7 + 0.0)).collect();
        text.push_str(&format!("{}\n", cells.join(",")));
    }
    text
}
