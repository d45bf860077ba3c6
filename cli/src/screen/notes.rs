//! Where the gap lies, what a diagnosis leaves open, what could not be seen, what was not read.

use stiffarm_gap::Diagnosis;
use stiffarm_gap::diagnose::{LeftOut, NuisanceReport, Share};

use super::{MOST, Screen, WIDTH, percent, words};
use crate::input::quantity::counted;
use crate::terminal::text::{bold, listed, minus, short, wrapped};

/// Lines of the whole screen: reasons for which something could not be seen are left out beyond.
const HEIGHT: usize = 40;

/// Reasons that are given in any case.
const LEAST_REASONS: usize = 2;

/// Where the text beside the names begins.
const MARGIN: usize = 14;

/// Parts smaller than this are not shown.
const LEAST: f64 = 0.01;

/// What is left is called odd where chance makes it so less often, and it matters.
const ODD: f64 = 1e-3;
const HEAVY: f64 = 1.0;
const LINGERS: f64 = 0.2;

/// Columns that are named of those that were not used.
const MOST_UNUSED: usize = 12;

/// A part that is everything is none.
const MOST_OF_IT: f64 = 0.995;

/// Whose axes loads and gravity were told in, where that is not the convention.
pub fn loads(found: &Diagnosis) -> &'static str {
    match found.hangs_as_measured {
        true => "they and gravity stand in the measuring frame's axes, −z down: these data say so",
        false => "",
    }
}

impl Screen<'_> {
    /// The remarks below the findings, each with its name in front; `above` lines stand before
    /// them.
    pub(super) fn notes(&self, above: usize) -> String {
        let places = shares(&self.found.places);
        let places = match places.is_empty() {
            true => places,
            false => format!("{places} (each alone; they overlap)"),
        };
        let parts = self.found.parts.iter().filter(|p| (LEAST..MOST_OF_IT).contains(&p.share));
        let parts: Vec<String> =
            parts.map(|p| format!("{} {}", p.part, percent(p.share))).collect();
        let mut text = [
            note("Where", &places),
            note("Goes with", &listed(&parts, MOST + 2)),
            note("Fitted along", &self.frames()),
            note("Loads", loads(self.found)),
            note("Left out", &self.left_out()),
            note("Check", &self.checked()),
            note("Residual", &self.odd()),
            note("Unexplained", &self.unexplained()),
        ]
        .concat();
        let last = note("Not used", &self.not_used());
        let reasons = self.hidden();
        for (k, reason) in reasons.iter().enumerate() {
            let line = note(if k == 0 { "Cannot see" } else { "" }, reason);
            let lines = [&text, &line, &last].map(|t| t.lines().count()).iter().sum::<usize>();
            // A line stands between findings and remarks, another may count the reasons left out.
            if k >= LEAST_REASONS && above + lines + 2 > HEIGHT {
                let rest = counted(reasons.len() - k, "more reason");
                text.push_str(&note("", &format!("and what is hidden for {rest}: --json")));
                break;
            }
            text.push_str(&line);
        }
        text.push_str(&last);
        if text.is_empty() { text } else { format!("\n{text}") }
    }

    fn frames(&self) -> String {
        let frame = |n: &NuisanceReport| {
            let [x, y, z] = n.translation.map(|x| short(1e3 * x));
            let of = n.session.as_ref().map_or_else(String::new, |name| format!(" in {name}"));
            format!("{}{of} at ({x}, {y}, {z}) mm", words(&n.name))
        };
        let geometry = "geometry: lengths, twists and zeros of the table";
        let geometry = self.found.geometry_along.then(|| geometry.to_owned());
        let frames = self.found.nuisances.iter().map(frame).chain(geometry);
        let frames: Vec<String> = frames.collect();
        listed(&frames, MOST)
    }

    /// The rows that do not fit, the worst first.
    fn left_out(&self) -> String {
        let mut rows: Vec<&LeftOut> = self.found.left_out.iter().collect();
        if rows.is_empty() {
            return String::new();
        }
        let positions = self.measures(0..3);
        // A row in which the arm comes to no rest is the worst.
        let size = |row: &LeftOut| if positions { row.position } else { row.rotation };
        let order = |row: &LeftOut| size(row).unwrap_or(f64::INFINITY);
        rows.sort_by(|a, b| order(b).total_cmp(&order(a)));
        let far = |row: &&LeftOut| {
            let shown =
                |size| if positions { self.length(size, size) } else { self.angle(size, size) };
            let text = size(row)
                .map_or("no rest under its load".to_owned(), |size| shown(size).with_unit(size));
            format!("line {} ({text})", row.line)
        };
        let each: Vec<String> = rows.iter().map(far).collect();
        let (out, all) = (each.len(), self.found.measurements);
        let verb = if out == 1 { "does" } else { "do" };
        format!("{out} of {all} rows {verb} not fit: {} (--keep-all)", listed(&each, MOST))
    }

    fn checked(&self) -> String {
        let Some(check) = self.check else { return String::new() };
        let of = format!("{} of the {} rows of {}", check.inside, check.rows, check.file);
        let within = "within the joint ranges, loads and leverage of this data";
        let (Some(before), Some(after)) = (check.before, check.after) else {
            return format!("{of} lie {within}: none is judged");
        };
        let position = self.measures(0..3);
        let sizes = if position {
            let shown = self.length(
                before.position_rms.min(after.position_rms),
                before.position_rms.max(after.position_rms),
            );
            let arrow = |a: f64, b: f64| format!("{} → {}", shown.number(a), shown.with_unit(b));
            format!(
                "{} rms, 95 % {}, max {}",
                arrow(before.position_rms, after.position_rms),
                arrow(before.position_p95, after.position_p95),
                arrow(before.position_max, after.position_max)
            )
        } else {
            let (a, b) = (before.rotation_rms, after.rotation_rms);
            let shown = self.angle(a.min(b), a.max(b));
            format!("{} → {} rms", shown.number(a), shown.with_unit(b))
        };
        if check.fitted {
            let expected = self.main().with_unit(self.rms()[1]);
            return format!(
                "{sizes} on {of}, which are those that were fitted: on rows that no fit has seen \
                 expect {expected}"
            );
        }
        let outside = match check.rows - check.inside {
            0 => "no row lies outside".to_owned(),
            n => format!("{n} outside are not judged"),
        };
        format!("{sizes} on {of} that lie {within}; {outside}")
    }

    /// What of the rows that are left is not as least squares takes noise to be.
    fn odd(&self) -> String {
        let mut odd: Vec<String> = Vec::new();
        let left = self.found.residual.as_ref();
        let shape = left.and_then(|left| left.normality.as_ref());
        if let Some(shape) = shape.filter(|s| s.p_value < ODD && s.excess_kurtosis > HEAVY) {
            odd.push(format!("heavy tails (excess kurtosis {:.1})", shape.excess_kurtosis));
        }
        let order = left.and_then(|left| left.autocorrelation.as_ref());
        if let Some(order) = order.filter(|o| o.p_value < ODD && o.lag_1.abs() > LINGERS) {
            let lag = minus(format!("{:.2}", order.lag_1));
            odd.push(format!("errors that linger from one visit to the next (correlation {lag})"));
        }
        listed(&odd, MOST)
    }

    fn unexplained(&self) -> String {
        let left = &self.found.unexplained;
        if !left.present {
            return match &*self.found.gap.noise.from {
                "residual" => String::new(),
                _ => "nothing beyond the noise".to_owned(),
            };
        }
        let mut text = match left.position_rms > 0.0 {
            true => format!("{} beyond the noise", self.left()),
            false => "a pattern within the noise".to_owned(),
        };
        let places = shares(&left.places);
        if !places.is_empty() {
            text.push_str(&format!(", at {places}"));
        }
        if !left.depends_on.is_empty() {
            text.push_str(&format!("; it depends on {}", listed(&left.depends_on, MOST)));
        }
        text
    }

    fn not_used(&self) -> String {
        let rival = |name: &str| {
            self.rivals
                .iter()
                .any(|r| name.strip_prefix(r.as_str()).is_some_and(|n| n.starts_with('_')))
        };
        let unknown = self.data.extra.iter().filter(|column| !rival(&column.name));
        let unknown = unknown.map(|column| match &column.suggestion {
            Some(meant) => format!("{} (did you mean {meant}?)", column.column.header),
            None => column.column.header.clone(),
        });
        let unused = self.data.unused.iter().map(|c| format!("{} (not measured)", c.header));
        let all: Vec<String> = unknown.chain(unused).collect();
        if all.is_empty() {
            String::new()
        } else {
            format!("columns {}", listed(&all, MOST_UNUSED))
        }
    }
}

/// A remark with its name in front; nothing if there is none.
fn note(name: &str, text: &str) -> String {
    if text.is_empty() {
        return String::new();
    }
    let pad = " ".repeat(MARGIN - name.len());
    let head = if name.is_empty() { String::new() } else { bold(name) };
    wrapped(&format!("{head}{pad}{text}"), WIDTH, MARGIN)
}

/// `joint 1 99 %, joint 2 92 %`.
fn shares(places: &[Share]) -> String {
    let there = places.iter().filter(|s| s.share >= LEAST);
    let each: Vec<String> = there.map(|s| format!("{} {}", s.place, percent(s.share))).collect();
    listed(&each, MOST)
}
