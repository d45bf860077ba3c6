//! A figure of growth as a self-contained SVG: logarithmic axes, lines with their names at their
//! ends, the reader's light or dark theme.

use std::fmt::Write as _;
use std::path::Path;

/// Size of the figure and the sides of its axes, px: left, top, right, bottom.
const SIZE: [f64; 2] = [720.0, 440.0];
const EDGES: [f64; 4] = [70.0, 56.0, 560.0, 380.0];

/// Least distance between two names, px.
const APART: f64 = 15.0;

const STYLE: &str = "text{font:12px sans-serif;fill:#222}.title{font-size:16px;font-weight:bold}\
.grid{stroke:#ddd}.axis{fill:none;stroke:#444}.line{fill:none;stroke:#1f5fa8;stroke-width:1.5}\
circle{fill:#1f5fa8}.paper{fill:#fff}@media(prefers-color-scheme:dark){text{fill:#ddd}\
.paper{fill:#16181c}.grid{stroke:#333}.axis{stroke:#aaa}.line{stroke:#7db4f0}circle{fill:#7db4f0}}";

/// Lines of growth.
pub struct Chart<'c> {
    /// Above it.
    pub title: &'c str,
    /// Below the title.
    pub subtitle: &'c str,
    /// What grows with what, for those who do not see it.
    pub description: &'c str,
    /// Along.
    pub x: &'c str,
    /// Upward.
    pub y: &'c str,
    /// Each with its name; what is not positive is left out.
    pub lines: Vec<(&'c str, Vec<[f64; 2]>)>,
}

/// A logarithmic scale.
struct Scale {
    ends: [f64; 2],
    places: [f64; 2],
}

impl Scale {
    fn of(values: impl Iterator<Item = f64> + Clone, places: [f64; 2]) -> Scale {
        let low = values.clone().fold(f64::INFINITY, f64::min).log10();
        let high = values.fold(f64::NEG_INFINITY, f64::max).log10();
        let margin = 0.04 * (high - low).max(0.5);
        Scale { ends: [low - margin, high + margin], places }
    }

    fn at(&self, value: f64) -> f64 {
        let ([low, high], [from, to]) = (self.ends, self.places);
        from + (value.log10() - low) / (high - low) * (to - from)
    }

    /// Powers of ten, with some times these where they are few.
    fn marks(&self) -> Vec<f64> {
        let [low, high] = self.ends;
        let parts: &[f64] = match high - low {
            decades if decades > 2.5 => &[1.0],
            decades if decades > 1.0 => &[1.0, 2.0, 5.0],
            _ => &[1.0, 2.0, 3.0, 4.0, 5.0, 7.0],
        };
        let powers = low.floor() as i32..=high.ceil() as i32;
        // Read from its digits, a mark prints as these.
        let mark = |part: f64, power: i32| format!("{part}e{power}").parse().unwrap_or(part);
        let all = powers.flat_map(|p| parts.iter().map(move |part| mark(*part, p)));
        all.filter(|mark| (low..=high).contains(&mark.log10())).collect()
    }
}

impl Chart<'_> {
    /// Writes it where `--svg DIRECTORY` says, from the workspace's own directory on, and tells so.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, name: &str) -> std::io::Result<()> {
        let mut arguments = std::env::args().skip_while(|a| a != "--svg");
        let Some(directory) = arguments.nth(1) else { return Ok(()) };
        // Benches run in their package's directory, not where they were asked for.
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        std::fs::write(root.join(&directory).join(name), self.svg())?;
        println!("wrote {directory}/{name}");
        Ok(())
    }

    fn svg(&self) -> String {
        let [left, top, right, bottom] = EDGES;
        let points = || self.lines.iter().flat_map(|(_, line)| line).filter(|p| p[1] > 0.0);
        let x = Scale::of(points().map(|p| p[0]), [left, right]);
        let y = Scale::of(points().map(|p| p[1]), [bottom, top]);
        let [width, height] = SIZE;
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-labelledby=\"t d\" \
             viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\">\n\
             <title id=\"t\">{}</title>\n<desc id=\"d\">{}</desc>\n<style>{STYLE}</style>\n\
             <rect class=\"paper\" width=\"{width}\" height=\"{height}\"/>\n",
            self.title, self.description
        );
        let mut put = |piece: String| {
            let _ = writeln!(text, "{piece}");
        };
        put(format!("<text class=\"title\" x=\"{left}\" y=\"24\">{}</text>", self.title));
        put(format!("<text x=\"{left}\" y=\"42\">{}</text>", self.subtitle));
        for mark in x.marks() {
            let at = x.at(mark);
            put(format!("<path class=\"grid\" d=\"M{at:.1} {top}V{bottom}\"/>"));
            let place = format!("x=\"{at:.1}\" y=\"{}\"", bottom + 18.0);
            put(format!("<text text-anchor=\"middle\" {place}>{mark}</text>"));
        }
        for mark in y.marks() {
            let at = y.at(mark);
            put(format!("<path class=\"grid\" d=\"M{left} {at:.1}H{right}\"/>"));
            let place = format!("x=\"{}\" y=\"{:.1}\"", left - 6.0, at + 4.0);
            put(format!("<text text-anchor=\"end\" {place}>{mark}</text>"));
        }
        let sides = format!("M{left} {top}H{right}V{bottom}H{left}Z");
        put(format!("<path class=\"axis\" d=\"{sides}\"/>"));
        let middle = [0.5 * (left + right), 0.5 * (top + bottom)];
        let place = format!("x=\"{}\" y=\"{}\"", middle[0], bottom + 40.0);
        put(format!("<text text-anchor=\"middle\" {place}>{}</text>", self.x));
        let turned = format!("transform=\"translate(18 {}) rotate(-90)\"", middle[1]);
        put(format!("<text text-anchor=\"middle\" {turned}>{}</text>", self.y));
        let mut names: Vec<(f64, &str)> = Vec::new();
        for (name, line) in &self.lines {
            let at = |p: &[f64; 2]| [x.at(p[0]), y.at(p[1])];
            let places: Vec<[f64; 2]> = line.iter().filter(|p| p[1] > 0.0).map(at).collect();
            let path: Vec<String> =
                places.iter().map(|p| format!("{:.1} {:.1}", p[0], p[1])).collect();
            put(format!("<path class=\"line\" d=\"M{}\"/>", path.join("L")));
            for [x, y] in &places {
                put(format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\"/>"));
            }
            names.extend(places.last().map(|p| (p[1], *name)));
        }
        // From below to above, none on another.
        names.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut free = f64::INFINITY;
        for (at, name) in names {
            let at = at.min(free);
            free = at - APART;
            put(format!("<text x=\"{}\" y=\"{:.1}\">{name}</text>", right + 8.0, at + 4.0));
        }
        text.push_str("</svg>\n");
        text
    }
}
