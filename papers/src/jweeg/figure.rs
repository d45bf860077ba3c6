//! How the difference between the flexible kinematics and its published approximation grows with
//! flexibility (Jweeg & Al-Khafaji 2012, conclusion), as a table and as a picture.

use std::fmt::Write as _;

use super::growth::two_link;

/// Lengths of the second link, m: the paper does not print it.
const REACHES: [f64; 3] = [0.2, 0.4, 1.0];

/// Turns of the first link's tip, rad.
const TURNS: [f64; 8] = [1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3];

/// The published largest difference, m.
const PUBLISHED: f64 = 6.3e-8;

/// The table in Markdown.
pub fn table() -> String {
    let mut out = String::from("| dφ1, rad |");
    for reach in REACHES {
        let _ = write!(out, " a2 = {reach} m |");
    }
    out.push_str(" leading term |\n|---|---|---|---|---|\n");
    for turn in TURNS {
        let _ = write!(out, "| {turn} |");
        let rows = REACHES.map(|reach| two_link(reach, &[turn])[0]);
        for row in rows {
            let _ = write!(out, " {:.2e} m |", row.difference);
        }
        let _ = writeln!(out, " {:.2} % |", 100.0 * rows[0].leading / rows[0].difference);
    }
    out
}

/// Decades along each axis: the picture shows 10^low to 10^high.
struct Axis {
    low: f64,
    high: f64,
    /// Where these lie, px.
    from: f64,
    to: f64,
}

impl Axis {
    fn at(&self, value: f64) -> f64 {
        let part = (value.log10() - self.low) / (self.high - self.low);
        self.from + part * (self.to - self.from)
    }

    fn decades(&self) -> impl Iterator<Item = i32> {
        self.low as i32..=self.high as i32
    }
}

const ACROSS: Axis = Axis { low: -4.0, high: 0.0, from: 90.0, to: 610.0 };
const UP: Axis = Axis { low: -9.0, high: 0.0, from: 370.0, to: 46.0 };

const STYLE: &str = "\
:root { color-scheme: light dark; --ink: #1b1d20; --mute: #6b7078; --grid: #e3e5e8; --line: #1f5fbf;
  --mark: #b3401a; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6e6e6; --mute: #a0a6ae; --grid: #33373d;
  --line: #7fb0ff; --mark: #ff9d70; } }
text { font: 13px system-ui, sans-serif; fill: var(--ink); } .mute { fill: var(--mute); }
.grid { stroke: var(--grid); fill: none; }
.line { stroke: var(--line); stroke-width: 2; fill: none; }
.dot { fill: var(--line); } .mark { stroke: var(--mark); stroke-dasharray: 5 4; fill: none; }
.at { fill: var(--mark); }";

/// The picture; it follows the reader's light or dark mode.
pub fn svg() -> String {
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 720 430\" role=\"img\" \
         aria-labelledby=\"title\">\n<title id=\"title\">Difference between the exact and the \
         published approximate flexible kinematics of the two-link arm, growing with the square of \
         the first link's turn</title>\n<style>\n{STYLE}\n</style>\n"
    );
    grid(&mut out);
    // From the uppermost down, each at least a line below the last.
    let mut above = f64::NEG_INFINITY;
    for reach in REACHES.into_iter().rev() {
        let end = line(&mut out, reach);
        above = (end + 4.0).max(above + 16.0);
        text(&mut out, [ACROSS.to + 8.0, above], "start", "", &format!("a₂ = {reach} m"));
    }
    published(&mut out);
    out.push_str("</svg>\n");
    out
}

fn text(out: &mut String, [x, y]: [f64; 2], anchor: &str, class: &str, words: &str) {
    let _ = writeln!(
        out,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" class=\"{class}\">{words}</text>"
    );
}

fn grid(out: &mut String) {
    let power = |k: i32| match k {
        0 => "1".to_string(),
        k => {
            let exponent = k.to_string().replace('-', "−");
            format!("10<tspan dy=\"-5\" font-size=\"10\">{exponent}</tspan>")
        }
    };
    for k in ACROSS.decades() {
        let x = ACROSS.at(10f64.powi(k));
        let _ = writeln!(out, "<path class=\"grid\" d=\"M{x:.1} {} V{}\"/>", UP.to, UP.from);
        text(out, [x, UP.from + 20.0], "middle", "mute", &power(k));
    }
    for k in UP.decades() {
        let y = UP.at(10f64.powi(k));
        let _ =
            writeln!(out, "<path class=\"grid\" d=\"M{} {y:.1} H{}\"/>", ACROSS.from, ACROSS.to);
        text(out, [ACROSS.from - 8.0, y + 4.0], "end", "mute", &power(k));
    }
    text(out, [ACROSS.from, 26.0], "start", "", "|approximate − exact|, m");
    let end = [(ACROSS.from + ACROSS.to) / 2.0, 416.0];
    text(out, end, "middle", "", "turn dφ₁ of the first link’s tip, rad");
}

/// The curve of one length, with a dot at each row of the table; gives the height of its end.
fn line(out: &mut String, reach: f64) -> f64 {
    let turns: Vec<f64> =
        (0..=160).map(|k| 10f64.powf(-4.0 + 4.0 * f64::from(k) / 160.0)).collect();
    let rows = two_link(reach, &turns);
    let seen = rows.iter().filter(|row| row.difference >= 10f64.powf(UP.low));
    let points: Vec<String> =
        seen.map(|row| format!("{:.1} {:.1}", ACROSS.at(row.phi), UP.at(row.difference))).collect();
    let _ = writeln!(out, "<path class=\"line\" d=\"M{}\"/>", points.join(" L"));
    for row in two_link(reach, &TURNS) {
        let (x, y) = (ACROSS.at(row.phi), UP.at(row.difference));
        let _ = writeln!(out, "<circle class=\"dot\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.6\"/>");
    }
    UP.at(rows.last().map_or(1.0, |row| row.difference))
}

/// The published maximum, and the turn that it needs with each length.
fn published(out: &mut String) {
    let y = UP.at(PUBLISHED);
    let _ = writeln!(out, "<path class=\"mark\" d=\"M{} {y:.1} H{}\"/>", ACROSS.from, ACROSS.to);
    for reach in REACHES {
        let x = ACROSS.at((2.0 * PUBLISHED / reach).sqrt());
        let _ = writeln!(out, "<circle class=\"at\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\"/>");
    }
    let at = [ACROSS.to - 4.0, y - 7.0];
    text(out, at, "end", "at", "published maximum, 6.3·10⁻⁸ m");
}
