//! The robot file with what was found: at its top stands what was put in, and where.

use stiffarm_gap::Measurements;
use stiffarm_gap::corrected::{Outcome, corrected};
use stiffarm_gap::diagnose::{Diagnosed, NuisanceReport};

use crate::input::source::Source;

/// The file.
pub fn text(source: &Source, data: &Measurements, diagnosed: &Diagnosed) -> String {
    let diagnosis = &diagnosed.diagnosis;
    let found = corrected(&source.robot, diagnosed);
    let version = &diagnosis.stiffarm;
    let mut lines = vec![format!(
        "Corrected by stiffarm {version} from {}, diagnosed with {}.",
        source.given, data.file
    )];
    if data.sim_given.contains(&true) {
        lines.push("What was found is what the simulator of the sim_ columns lacks.".to_owned());
    }
    lines.push(String::new());
    lines.push("Put in, with 95 % intervals:".to_owned());
    lines.extend(found.outcomes.iter().map(line));
    lines.extend(diagnosis.nuisances.iter().map(frame));
    if found.outcomes.is_empty() && diagnosis.nuisances.is_empty() {
        lines.push("  nothing".to_owned());
    }
    let head: String = lines.iter().map(|line| comment(line)).collect();
    format!("{head}\n{}", found.robot.to_toml())
}

fn line(outcome: &Outcome) -> String {
    let (p, entry) = (&outcome.parameter, &outcome.entry);
    let [low, high] = p.ci95;
    let unit = if p.unit == "1" { String::new() } else { format!(" {}", p.unit) };
    let number = match low == high {
        // A form, such as the row after which a frame jumps, has no interval.
        true => format!("{}{unit}", p.value),
        false => format!("{:.6e}{unit} [{low:.3e} to {high:.3e}]", p.value),
    };
    format!("  {} at {}: {} {number}, in {entry}", outcome.effect, outcome.place, p.name)
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
