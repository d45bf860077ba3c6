//! How the difference between the flexible kinematics and its published approximation grows with
//! flexibility (Jweeg & Al-Khafaji 2012, conclusion), as a table and as a picture.

use std::fmt::Write as _;

use askama::Template;

use super::growth::{TwoLinkGrowth, two_link};

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

/// The picture: places in px.
#[derive(Template)]
#[template(path = "growth.svg")]
struct Figure {
    /// Powers of ten along each axis, and where they lie.
    across: Vec<(i32, f64)>,
    up: Vec<(i32, f64)>,
    curves: Vec<Curve>,
    /// The published maximum, and the turns that it needs.
    published: f64,
    needed: [f64; 3],
}

/// The curve of one length, with a dot at each row of the table.
struct Curve {
    reach: f64,
    path: String,
    dots: Vec<(f64, f64)>,
    /// The height of its label.
    label: f64,
}

/// The least difference that is shown, m.
const LEAST: f64 = 1e-9;

/// 1e-4 to 1 rad lie from 90 to 610 px.
fn across(turn: f64) -> f64 {
    90.0 + (turn.log10() + 4.0) / 4.0 * 520.0
}

/// 1e-9 to 1 m lie from 370 up to 46 px.
fn up(difference: f64) -> f64 {
    370.0 - (difference.log10() + 9.0) / 9.0 * 324.0
}

/// The picture; it follows the reader's light or dark mode.
pub fn svg() -> String {
    let turns: Vec<f64> =
        (0..=160).map(|k| 10f64.powf(-4.0 + 4.0 * f64::from(k) / 160.0)).collect();
    // From the uppermost down, each label at least a line below the last.
    let mut above = f64::NEG_INFINITY;
    let curve = |reach: f64| {
        let rows = two_link(reach, &turns);
        above = (up(rows.last().map_or(1.0, |row| row.difference)) + 4.0).max(above + 16.0);
        let seen = rows.iter().filter(|row| row.difference >= LEAST);
        let point = |(x, y): (f64, f64)| format!("{x:.1} {y:.1}");
        let place = |row: &TwoLinkGrowth| (across(row.phi), up(row.difference));
        let path: Vec<String> = seen.map(|row| point(place(row))).collect();
        let dots = two_link(reach, &TURNS).iter().map(place).collect();
        Curve { reach, path: path.join(" L"), dots, label: above }
    };
    let figure = Figure {
        across: (-4..=0).map(|k| (k, across(10f64.powi(k)))).collect(),
        up: (-9..=0).map(|k| (k, up(10f64.powi(k)))).collect(),
        curves: REACHES.into_iter().rev().map(curve).collect(),
        published: up(PUBLISHED),
        needed: REACHES.map(|reach| across((2.0 * PUBLISHED / reach).sqrt())),
    };
    // Text to memory, by a template that was checked when it was compiled.
    figure.render().unwrap_or_default() + "\n"
}
