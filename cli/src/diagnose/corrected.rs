//! The robot file with what was found: what was put in, and what it cannot hold, stand at its top.

use stiffarm_gap::Measurements;
use stiffarm_gap::corrected::{Fate, Outcome, corrected};
use stiffarm_gap::diagnose::{Diagnosed, Nuisance, NuisanceReport};

use crate::input::source::Source;

/// The file.
pub fn text(source: &Source, data: &Measurements, diagnosed: &Diagnosed) -> String {
    let diagnosis = &diagnosed.diagnosis;
    let found = corrected(&source.robot, diagnosed);
    let is_in = |o: &&Outcome| matches!(o.fate, Fate::PutIn(_));
    let (put_in, left_out): (Vec<_>, Vec<_>) = found.outcomes.iter().partition(is_in);
    let version = &diagnosis.stiffarm;
    let mut lines = vec![format!(
        "Corrected by stiffarm {version} from {}, diagnosed with {}.",
        source.given, data.file
    )];
    if data.sim_given.contains(&true) {
        lines.push("What was found is what the simulator of the sim_ columns lacks.".to_owned());
    }
    let tool = Nuisance::ToolFrame.identifier();
    let fitted = |n: &&NuisanceReport| found.tool_was_fitted && n.name == tool;
    lines.push(String::new());
    lines.push("Put in, with 95 % intervals:".to_owned());
    lines.extend(put_in.iter().map(|o| line(o)));
    lines.extend(diagnosis.nuisances.iter().filter(fitted).map(frame));
    if put_in.is_empty() && !found.tool_was_fitted {
        lines.push("  nothing".to_owned());
    }
    lines.push(String::new());
    lines.push("Found, and not in this file:".to_owned());
    lines.extend(left_out.iter().map(|o| line(o)));
    lines.extend(diagnosis.nuisances.iter().filter(|n| !fitted(n)).map(frame));
    if left_out.is_empty() && diagnosis.nuisances.iter().all(|n| fitted(&n)) {
        lines.push("  nothing".to_owned());
    }
    let head: String = lines.iter().map(|line| comment(line)).collect();
    format!("{head}\n{}", found.robot.to_toml())
}

fn line(outcome: &Outcome) -> String {
    let (p, fate) = (&outcome.parameter, &outcome.fate);
    let [low, high] = p.ci95;
    let unit = if p.unit == "1" { String::new() } else { format!(" {}", p.unit) };
    let number = match low == high {
        // A form, such as the row after which a frame jumps, has no interval.
        true => format!("{}{unit}", p.value),
        false => format!("{:.6e}{unit} [{low:.3e} to {high:.3e}]", p.value),
    };
    format!("  {} at {}: {} {number}, {fate}", outcome.effect, outcome.place, p.name)
}

/// A frame that was fitted along.
fn frame(n: &NuisanceReport) -> String {
    let list = |v: [f64; 3]| v.map(|x| format!("{x:.9}")).join(", ");
    let (at, turned) = (list(n.translation), list(n.rotation));
    format!("  {}, fitted along: at [{at}] m, turned by [{turned}] rad", n.name)
}

/// A line of comment, whatever the names in it hold.
fn comment(line: &str) -> String {
    let plain: String = line.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    format!("# {plain}").trim_end().to_owned() + "\n"
}
