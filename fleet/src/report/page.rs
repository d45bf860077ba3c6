//! The page: self-contained, without scripts, light and dark.

use askama::Template;

use super::facts::{Fleet, Frequency, Line};
use super::numbers::short;
use super::pooled::{Outlier, Pooled};

/// The style of all pages.
const STYLE: &str = include_str!("../../../document/src/style.css");

#[derive(Template)]
#[template(path = "report.html")]
struct Page<'a> {
    style: &'static str,
    table: &'a str,
    fleet: &'a Fleet,
    sentence: String,
    arms: Vec<Bar<'a>>,
}

/// An arm's gap on a scale of powers of ten, in per cent of the scale's length.
struct Bar<'a> {
    line: &'a Line,
    before: f64,
    after: f64,
    noise: f64,
    said: String,
}

/// The page of a fleet's table.
///
/// # Errors
/// [`askama::Error`] if it cannot be made.
pub fn html(table: &str, fleet: &Fleet) -> Result<String, askama::Error> {
    let arms = bars(&fleet.arms);
    Page { style: STYLE, table, fleet, sentence: sentence(fleet), arms }.render()
}

/// What stands at the top.
fn sentence(fleet: &Fleet) -> String {
    let Some(middle) = median(&fleet.arms) else {
        return format!("No arm of {} campaigns has a diagnosis.", fleet.campaigns);
    };
    let [before, after, _] = middle.gap;
    let first = fleet.effects.first().map_or_else(String::new, |most| {
        format!("; most often found: {}, {} of {} arms", most.finding, most.arms, most.of)
    });
    let out = match &fleet.outliers[..] {
        [] => "no arm stands out".to_owned(),
        some => {
            let mut names: Vec<&str> = some.iter().map(|outlier| outlier.arm.as_str()).collect();
            names.sort_unstable();
            names.dedup();
            let verb = if names.len() == 1 { "stands" } else { "stand" };
            format!("{} {verb} out", few(&names))
        }
    };
    format!(
        "{} arms: the middle one's gap shrinks from {} to {}{first}; {out}.",
        fleet.arms.len(),
        length(before, middle.is_length),
        length(after, middle.is_length)
    )
}

fn few(names: &[&str]) -> String {
    match names {
        [first, second, rest @ ..] if rest.len() > 1 => {
            format!("{first}, {second} and {} more", rest.len())
        }
        all => all.join(", "),
    }
}

/// The arm with the median of what is left; the lines are in that order.
fn median(arms: &[Line]) -> Option<&Line> {
    arms.get(arms.len() / 2)
}

fn bars<'a>(arms: &'a [Line]) -> Vec<Bar<'a>> {
    let all = arms.iter().flat_map(|line| line.gap).filter(|x| *x > 0.0);
    let (low, high) =
        all.fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
    let width = (high / low).ln();
    let at = |x: f64| match x > 0.0 && width > 0.0 {
        true => (1000.0 * (x / low).ln() / width).round() / 10.0,
        false => 0.0,
    };
    let bar = |line: &'a Line| {
        let Line { gap: [before, after, noise], is_length, .. } = *line;
        let said = format!("{} → {}", length(before, is_length), length(after, is_length));
        Bar { line, before: at(before), after: at(after), noise: at(noise), said }
    };
    arms.iter().map(bar).collect()
}

fn length(gap: f64, is_length: bool) -> String {
    match (is_length, gap >= 1e-4) {
        (true, true) => format!("{} mm", short(1e3 * gap)),
        (true, false) => format!("{} µm", short(1e6 * gap)),
        (false, _) => format!("{} mrad", short(1e3 * gap)),
    }
}

impl Bar<'_> {
    fn from(&self) -> f64 {
        self.before.min(self.after)
    }

    fn width(&self) -> f64 {
        (self.before - self.after).abs()
    }

    fn findings(&self) -> String {
        match &self.line.findings[..] {
            [] => "nothing found".to_owned(),
            some => some.join(", "),
        }
    }
}

impl Frequency {
    fn percent(&self) -> usize {
        100 * self.arms / self.of
    }
}

impl Pooled {
    fn usual(&self) -> String {
        let (pool, unit) = (&self.pool, &self.what.unit);
        format!("{} ± {} {unit}", short(pool.mean), short(pool.spread))
    }

    fn gained(&self) -> String {
        let Some(gain) = &self.gain else { return "too few arms with two campaigns".to_owned() };
        let told = match gain.gain_ci95 {
            [low, _] if low > 0.0 => "better",
            [_, high] if high < 0.0 => "worse",
            _ => "not told apart",
        };
        format!(
            "{} → {} {} on {} arms ({told})",
            short(gain.alone),
            short(gain.pooled),
            self.what.unit,
            gain.arms
        )
    }
}

impl Outlier {
    fn said(&self) -> String {
        let unit = &self.what.unit;
        format!(
            "{} ± {} {unit}; the {} others {} ± {}",
            short(self.own.value),
            short(self.own.error),
            self.others.arms,
            short(self.others.mean),
            short(self.others.spread)
        )
    }

    fn p(&self) -> String {
        short(self.p_value)
    }
}
