//! The arm with what was found, as a robot file (at its top stands what was put in, and where) and as
//! other programs read it.

use std::cell::OnceCell;
use std::mem::take;

use stiffarm_codegen::emit::{lost_in_mjcf, lost_in_urdf, mjcf, urdf};
use stiffarm_codegen::robot::Robot;
use stiffarm_document::words::capital;
use stiffarm_gap::Measurements;
use stiffarm_gap::corrected::{Corrected, Outcome, corrected};
use stiffarm_gap::diagnose::{Diagnosed, Nuisance, NuisanceReport};
use stiffarm_gap::effects;

use crate::input::source::Source;
use crate::terminal::failure::Failure;

/// The corrected arm, worked out once something asks for it.
pub struct Corrections<'a> {
    source: &'a Source,
    data: &'a Measurements,
    diagnosed: &'a Diagnosed,
    found: OnceCell<(Corrected, Option<String>)>,
}

/// What other programs read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Links and joints.
    Urdf,
    /// MuJoCo's.
    Mjcf,
}

impl<'a> Corrections<'a> {
    pub fn new(source: &'a Source, data: &'a Measurements, diagnosed: &'a Diagnosed) -> Self {
        Corrections { source, data, diagnosed, found: OnceCell::new() }
    }

    fn found(&self) -> &Corrected {
        &self.found_and_lost().0
    }

    /// The same, and a sentence on effects of one's own.
    fn found_and_lost(&self) -> &(Corrected, Option<String>) {
        self.found.get_or_init(|| {
            let mut found = corrected(&self.source.robot, self.diagnosed);
            found.robot.effects.extend(self.source.in_motion_alone());
            let lost = without_own(&mut found.robot);
            (found, lost)
        })
    }

    /// What has to be known of any file of the corrected arm, a sentence each.
    pub fn caveats(&self) -> Vec<String> {
        let mut caveats = Vec::new();
        if self.data.sim_given.contains(&true) {
            let text = "the arm is corrected by what the simulator of the sim_ columns lacks";
            caveats.push(text.to_owned());
        }
        let wrong = self.diagnosed.diagnosis.mistaken.iter().flat_map(|all| &all.mistakes);
        let in_data = wrong.filter(|wrong| !wrong.in_robot_file);
        caveats.extend(in_data.map(|wrong| {
            format!("no robot file mends that {}: {}", wrong.sentence, wrong.mending)
        }));
        let is_of_session =
            |n: &NuisanceReport| n.session.is_some() && n.name != Nuisance::ToolFrame.identifier();
        if self.diagnosed.diagnosis.nuisances.iter().any(is_of_session) {
            let text = "every session was measured in a frame of its own: [base] stays as it was, and \
                        another diagnosis of these rows takes --nuisance base_frame";
            caveats.push(text.to_owned());
        }
        caveats.extend(self.found_and_lost().1.clone());
        caveats
    }

    /// What the robot file says at its top.
    pub fn head(&self) -> Vec<String> {
        let mut lines = vec![made_from(self.source, &self.data.file)];
        lines.extend(self.caveats().iter().map(|caveat| capital(caveat) + "."));
        lines.push(String::new());
        lines.extend(self.lines());
        lines
    }

    pub fn robot(&self) -> &Robot {
        &self.found().robot
    }

    /// What was put in, line by line.
    pub fn lines(&self) -> Vec<String> {
        let (diagnosis, found) = (&self.diagnosed.diagnosis, self.found());
        let wrong = diagnosis.mistaken.iter().flat_map(|mistaken| &mistaken.mistakes);
        let mended = wrong.filter(|wrong| wrong.in_robot_file);
        let mut lines: Vec<String> =
            mended.map(|wrong| format!("Mended: {}.", wrong.sentence)).collect();
        lines.push("Put in, with 95 % intervals:".to_owned());
        lines.extend(found.outcomes.iter().map(line));
        let explanation = &self.diagnosed.explanation;
        let tool: [f64; 3] = explanation.arm().tool.translation.vector.into();
        let is_held = |n: &&NuisanceReport| match Nuisance::parse(&n.name) {
            Ok(Nuisance::BaseFrame) => n.session.is_none(),
            Ok(Nuisance::ToolFrame) => n.translation == tool,
            Err(_) => explanation.markers().any(|(name, _)| name == n.name),
        };
        let (held, lost): (Vec<_>, Vec<_>) = diagnosis.nuisances.iter().partition(is_held);
        lines.extend(held.into_iter().map(frame));
        if diagnosis.hangs_as_measured {
            lines.push("  gravity: down as the measuring frame stands, in gravity".to_owned());
        }
        if lines.last().is_some_and(|last| !last.starts_with(' ')) {
            lines.push("  nothing".to_owned());
        }
        if !lost.is_empty() {
            lines.push("Co-estimated, and in no robot file:".to_owned());
            lines.extend(lost.into_iter().map(frame));
        }
        lines
    }
}

/// Leaves effects of one's own out of a robot, which no file holds; a sentence on them.
pub fn without_own(robot: &mut Robot) -> Option<String> {
    let (known, own): (Vec<_>, Vec<_>) =
        take(&mut robot.effects).into_iter().partition(|table| is_known(&table.id.value));
    robot.effects = known;
    let names: Vec<String> =
        own.iter().map(|table| format!("{} at {}", table.id.value, table.place.value)).collect();
    let names = names.join(", ");
    (!own.is_empty()).then(|| {
        format!("no robot file has a place for {names}, of one's own: what it does is missing from this one")
    })
}

/// Whether stiffarm knows an effect.
pub fn is_known(id: &str) -> bool {
    effects::Entry::all().iter().any(|effect| effect.is_called(id))
}

/// Where a number of an effect stands.
pub fn stands_in<'a>(effect: &str, entry: &'a str) -> &'a str {
    if is_known(effect) { entry } else { "no robot file" }
}

/// The first line of a corrected robot file.
pub fn made_from(source: &Source, data: &str) -> String {
    let version = env!("CARGO_PKG_VERSION");
    format!("Corrected by stiffarm {version} from {}, diagnosed with {data}.", source.given)
}

/// A robot file with comments at its head.
pub fn commented(lines: Vec<String>, robot: &Robot) -> String {
    let head: String = lines.iter().map(|line| comment(line)).collect();
    format!("{head}\n{}", robot.to_toml())
}

/// A corrected arm as another program reads it, and a sentence on what it has no place for.
pub fn exported(robot: &Robot, format: Format) -> Result<(String, Option<String>), Failure> {
    let (written, lost, name) = match format {
        Format::Urdf => (urdf(robot), lost_in_urdf(robot), "a URDF"),
        Format::Mjcf => (mjcf(robot), lost_in_mjcf(robot), "an MJCF"),
    };
    let text = written?;
    let sentence =
        format!("{name} has no place for {}: --write-robot keeps all of it", lost.join(", "));
    Ok((text, (!lost.is_empty()).then_some(sentence)))
}

fn line(outcome: &Outcome) -> String {
    let (p, entry) = (&outcome.parameter, stands_in(&outcome.effect, &outcome.entry));
    let [low, high] = p.ci95;
    let unit = if p.unit == "1" { String::new() } else { format!(" {}", p.unit) };
    let number = match low == high {
        // A form, such as the row after which a frame jumps, has no interval.
        true => format!("{}{unit}", p.value),
        false => format!("{:.6e}{unit} [{low:.3e} to {high:.3e}]", p.value),
    };
    format!("  {} at {}: {} {number}, in {entry}", outcome.effect, outcome.place, p.name)
}

/// A co-estimated frame.
fn frame(n: &NuisanceReport) -> String {
    let list = |v: [f64; 3]| v.map(|x| format!("{x:.9}")).join(", ");
    let (at, turned) = (list(n.translation), list(n.rotation));
    let of = n.session.as_ref().map_or_else(String::new, |name| format!(" in session {name}"));
    format!("  {}{of}, co-estimated: at [{at}] m, turned by [{turned}] rad", n.name)
}

/// A line of comment, whatever the names in it hold.
fn comment(line: &str) -> String {
    let plain: String = line.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    format!("# {plain}").trim_end().to_owned() + "\n"
}
