//! A diagnosis on one screen.

mod campaign;
mod effect;
mod finding;
mod hidden;
pub mod log;
mod notes;
mod sentence;
mod size;
pub mod together;
mod unit;
mod words;

pub use finding::chance;
pub use notes::loads;
pub use size::Size;

use stiffarm_gap::diagnose::Rival;
use stiffarm_gap::effects::Catalogue;
use stiffarm_gap::gap::Statistics;
use stiffarm_gap::shrink::Shrink;
use stiffarm_gap::{Diagnosis, Measurements};
use stiffarm_kernels::generic::Arm;

use super::diagnose::{Accepted, Check, Compared};
use crate::input::quantity::counted;
use crate::terminal::text::{
    Align, bad, bar, bold, dim, fixed, good, indented, minus, table, wrapped,
};

/// Entries of a list before the rest is counted.
const MOST: usize = 4;

/// Width of the bars.
const BAR: usize = 20;

/// Width of the screen.
const WIDTH: usize = 100;

/// What is to be shown.
pub struct Screen<'a> {
    /// The diagnosis.
    pub found: &'a Diagnosis,
    /// What it was made of.
    pub data: &'a Measurements,
    /// The arm without any finding.
    pub arm: &'a Arm,
    /// The effects that there are.
    pub catalogue: &'a Catalogue,
    /// Prefixes of the columns that were used as rivals.
    pub rivals: &'a [String],
    /// Another file, predicted.
    pub check: Option<&'a Check>,
    /// Against a tolerance.
    pub accepted: Option<&'a Accepted>,
    /// Against an earlier diagnosis.
    pub compared: Option<&'a Compared>,
}

impl Screen<'_> {
    /// The whole screen.
    pub fn text(&self) -> String {
        let sentence = wrapped(&self.sentence(), WIDTH, 0);
        let parts = [
            self.head(),
            self.stopped(),
            format!("\n{sentence}\n"),
            self.verdict_on_tolerance(),
            self.gap(),
            self.findings(),
            self.compared(),
            self.campaigns(),
        ];
        let mut text = parts.concat();
        text.push_str(&self.notes(text.lines().count()));
        text
    }

    /// Said of a search that was told to stop.
    fn stopped(&self) -> String {
        if !self.found.stopped {
            return String::new();
        }
        let text = "Stopped before the search was at its end: there may be more to be found.";
        format!("{}\n", bad(text))
    }

    fn head(&self) -> String {
        let (found, data) = (self.found, self.data);
        let measured = data.kind.measured();
        let held_out = if found.held_out.folds == data.poses {
            "each pose held out in turn".to_owned()
        } else {
            format!("held out in {} folds of poses", found.held_out.folds)
        };
        let rows = counted(found.measurements, "measurement");
        let poses = counted(data.poses, "pose");
        let facts =
            format!("{}: {rows} of {} at {poses}, {held_out}", data.file, measured.join(" "));
        let sittings = data.sessions().count();
        let each = match self.found.nuisances.iter().any(|frame| frame.session.is_some()) {
            true => ", each with a frame of its own",
            false => "",
        };
        let sessions = match sittings {
            0 | 1 => String::new(),
            _ => format!(", in {sittings} sessions{each}"),
        };
        let own = match data.sim_given.contains(&true) {
            true => ", against the simulator of its sim_ columns",
            false => "",
        };
        format!(
            "{}\n{}\n",
            bold(&found.robot),
            dim(wrapped(&format!("{facts}{sessions}{own}"), WIDTH, 2).trim_end())
        )
    }

    fn gap(&self) -> String {
        let (gap, shown) = (&self.found.gap, self.main());
        let (position, rotation) = (self.measures(0..3), self.measures(3..6));
        let turned = self
            .angle(gap.before.rotation_rms.min(gap.after.rotation_rms), gap.before.rotation_rms);
        let mut heads = vec![bold("Gap")];
        if position {
            heads.extend(["rms", "95 %", "max"].map(|h| format!("{h} {}", shown.name)).map(dim));
        }
        if rotation {
            heads.push(dim(format!("rms {}", turned.name)));
        }
        if shown.name == "mil" {
            heads.push(dim("1 mil = 0.001 in"));
        }
        let main = |s: f64, r: f64| if position { s } else { r };
        let whole = main(gap.before.position_rms, gap.before.rotation_rms);
        let line = |name: &str, position_is: [Option<f64>; 3], rotation_is: Option<f64>| {
            let mut cells = vec![name.to_owned()];
            if position {
                cells.extend(position_is.map(|x| x.map_or_else(String::new, |x| shown.number(x))));
            }
            if rotation {
                cells.push(rotation_is.map_or_else(String::new, |x| turned.number(x)));
            }
            let size = if position { position_is[0] } else { rotation_is };
            cells.push(bar(size.filter(|_| whole > 0.0).map_or(0.0, |s| s / whole), BAR));
            cells
        };
        let all = |name: &str, s: &Statistics| {
            let positions = [s.position_rms, s.position_p95, s.position_max].map(Some);
            line(name, positions, Some(s.rotation_rms))
        };
        let mut rows = vec![heads, all(self.found.before_is(), &gap.before)];
        if !self.found.findings.is_empty() {
            let name = match self.found.findings.len() {
                1 => "with the finding, held out",
                _ => "with the findings, held out",
            };
            rows.push(all(name, &gap.after));
            rows.push(all("the same on its own rows", &gap.fitted));
        }
        if let Some(nested) = &gap.nested {
            rows.push(all("searched anew without each fold", nested));
        }
        if let Some(in_time) = &gap.nested_in_time {
            rows.push(all("the same without each fifth in time", in_time));
        }
        let noise = &gap.noise;
        let mut known = |name: &str, position: Option<f64>, rotation: Option<f64>| {
            rows.push(line(name, [position, None, None], rotation));
        };
        let from = |source: &str| format!("noise, {}", noise_from(source));
        let (own, turned) = (Some(noise.position_rms), Some(noise.rotation_rms));
        match (noise.position_from.as_deref(), noise.rotation_from.as_deref()) {
            (Some(position), Some(rotation)) if position != rotation => {
                known(&from(position), own, None);
                known(&from(rotation), None, turned);
            }
            _ => known(&from(&noise.from), own, turned),
        }
        if noise.visits_position_rms.is_some() || noise.visits_rotation_rms.is_some() {
            let name = "of it the arm's repeatability";
            known(name, noise.visits_position_rms, noise.visits_rotation_rms);
        }
        let mut align = vec![Align::Right; rows[1].len()];
        (align[0], align[rows[1].len() - 1]) = (Align::Left, Align::Left);
        let lines = table(&rows, &align);
        // The heading stands out to the left.
        let (head, rest) = lines.split_once('\n').unwrap_or((&lines, ""));
        format!("{}\n{}", head.replacen("  ", "    ", 1), indented(rest, 2))
    }

    fn compared(&self) -> String {
        let Some(rivals) = self.found.rivals.as_ref().filter(|r| !r.is_empty()) else {
            return String::new();
        };
        let shown = self.main();
        let square = |si: f64| minus(format!("{:.*}", shown.decimals, si / shown.size.powi(2)));
        let row = |r: &Rival| {
            let [low, high] = r.ci95.map(square);
            vec![
                r.name.clone(),
                shown.number(r.rms),
                shown.number(r.held_out_rms),
                format!("{} [{low} to {high}]", square(r.mean_square_gain)),
                self.verdict(r),
            ]
        };
        let unit = shown.name;
        let heads = [
            "rival".to_owned(),
            format!("its rms {unit}"),
            "ours, held out".to_owned(),
            format!("gain in mean square {unit}²"),
        ];
        let mut rows = vec![heads.map(dim).to_vec()];
        rows.extend(rivals.iter().map(row));
        use Align::{Left, Right};
        let lines = indented(&table(&rows, &[Left, Right, Right, Left, Left]), 2);
        let poses = counted(self.data.poses, "pose");
        let what = dim(format!("with other models' predictions in the file, over {poses} ours is"));
        format!("\n{}  {what}\n{lines}", bold("Compared"))
    }

    fn verdict(&self, rival: &Rival) -> String {
        match (rival.significant, rival.mean_square_gain > 0.0) {
            (true, true) => good("significantly better"),
            (true, false) => bad("significantly worse"),
            (false, true) => "not significantly better".to_owned(),
            (false, false) => "not better".to_owned(),
        }
    }
}

/// Where a noise is known from.
pub fn noise_from(source: &str) -> &'static str {
    match source {
        "residual" => "from what is left",
        "repeats" => "from repeats",
        "columns" => "by the file's sigma",
        _ => "as given",
    }
}

/// `joint_compliance` as it is said.
pub(crate) fn words(identifier: &str) -> String {
    identifier.replace('_', " ")
}

/// How much less is left, with its interval.
pub fn less(shrink: &Shrink) -> String {
    let [low, high] = shrink.shrink_ci95.map(|x| fixed(100.0 * x, 0));
    format!("{} less [{low} to {high}]", percent(shrink.shrink))
}

fn percent(part: f64) -> String {
    format!("{} %", fixed(100.0 * part, 0))
}
