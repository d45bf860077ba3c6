//! The pictures of a page: drawn here in SVG, or by the page's own scripts from embedded numbers.

mod corrections;
mod csv;
mod curves;
mod experiment;
mod forest;
mod rows;
mod scene;
mod shape;
mod waterfall;

use askama::{DynTemplate, Template};
use serde::Serialize;

pub use corrections::{corrected, curve, shares};
pub use csv::residual;
pub use curves::curves;
pub use experiment::{Experiment, Share};
pub use forest::{Multiple, forest};
pub use shape::Shaped;
pub use waterfall::{Step, waterfall};

use super::Block;
use experiment::{Drawn, drawn_of};
use rows::{Rows, rows};
use scene::{Scene, scene};
use shape::{Shape, shape};

/// The scripts that draw an experiment, one matter each.
pub const EXPERIMENT: &str = concat!(
    include_str!("script/plot.js"),
    include_str!("script/residuals.js"),
    include_str!("script/quantiles.js"),
    include_str!("script/arm.js"),
);

/// The scripts that draw a log.
pub const LOG: &str = concat!(include_str!("script/plot.js"), include_str!("script/logged.js"));

/// The script that fits documents within a page to it.
pub const WITHIN: &str = include_str!("script/both.js");

/// A picture that is put into a page.
pub type Picture = Box<dyn DynTemplate>;

/// What the scripts draw of an experiment.
#[derive(Serialize)]
pub struct Drawing {
    rows: Rows,
    scene: Scene,
    shapes: Vec<Shape>,
}

impl Drawing {
    /// Of an experiment, and what was found at its joints.
    pub fn of(whole: Experiment<'_>, curves: &[Shaped<'_>]) -> Drawing {
        let drawn = Drawn::of(&whole);
        let experiment = whole.with(&drawn);
        Drawing {
            rows: rows(&experiment),
            scene: scene(&experiment),
            shapes: curves.iter().filter_map(|curve| shape(&experiment, curve)).collect(),
        }
    }
}

#[derive(Template)]
#[template(path = "parts/arm.html")]
struct Arm;

#[derive(Template)]
#[template(path = "parts/residuals.html")]
struct Residuals {
    drawn: String,
    quantiles: Vec<String>,
    fitted: String,
}

#[derive(Template)]
#[template(path = "parts/joints.html")]
struct Joints {
    torque: bool,
}

/// The arm in space, which a script turns.
pub fn arm() -> Block {
    Block::Figure(Box::new(Arm), String::new())
}

/// Residuals of `rows` rows against everything that differs between them; how they are distributed, in
/// sentences; and the fitted shapes, of which `fitted` is said.
pub fn residuals(rows: usize, quantiles: Vec<String>, fitted: &str) -> Block {
    let fitted = fitted.to_owned();
    let picture = Residuals { drawn: drawn_of(rows), quantiles, fitted };
    Block::Figure(Box::new(picture), String::new())
}

/// The joints of a log against time and speed: torques, or position errors.
pub fn joints(torque: bool) -> Block {
    Block::Figure(Box::new(Joints { torque }), String::new())
}

/// To a tenth of a pixel.
fn px(x: f64) -> String {
    format!("{x:.1}")
}
