//! What the printers of simulators' files share: a chain of bodies, names and numbers in XML.

use super::SymbolicTable;
use crate::robot::Robot;
use crate::robot::urdf::Chain;

/// A robot as bodies.
pub(super) struct Bodies {
    /// The robot's, as an attribute.
    pub name: String,
    pub chain: Chain,
    /// One per joint.
    pub names: Vec<Names>,
}

/// Of a joint and of the link that it moves, as attributes.
pub(super) struct Names {
    pub joint: String,
    pub link: String,
}

impl Bodies {
    pub fn new(robot: &Robot) -> Result<Bodies, SymbolicTable> {
        let chain = Chain::from_robot(robot).ok_or_else(|| SymbolicTable {
            parameters: robot.symbols().into_iter().map(|s| s.name).collect(),
        })?;
        let distinct = |name: &str| chain.steps.iter().filter(|s| s.name == name).count() == 1;
        let names = chain.steps.iter().enumerate().map(|(k, step)| Names {
            joint: match distinct(&step.name) && step.name != "tool_mount" {
                true => attribute(&step.name.replace(' ', "_")),
                false => format!("joint_{}", k + 1),
            },
            link: format!("link_{}", k + 1),
        });
        Ok(Bodies { name: attribute(&robot.name), names: names.collect(), chain })
    }
}

/// Moment of inertia of a ball of aluminium of this mass, kg·m²: 2/5 m r².
pub(super) fn ball(mass: f64) -> f64 {
    let radius = (3.0 * mass / (4.0 * core::f64::consts::PI * 2700.0)).cbrt();
    0.4 * mass * radius * radius
}

/// Numbers as an attribute has them; what rounding left of a zero is one.
pub(super) fn words(numbers: [f64; 3]) -> String {
    let clean = |x: f64| if x.abs() < 1e-15 { 0.0 } else { x };
    numbers.map(|x| clean(x).to_string()).join(" ")
}

/// Text within quotation marks. No control character may stand in XML.
fn attribute(text: &str) -> String {
    let escaped = text.chars().map(|c| match c {
        '&' => "&amp;".to_owned(),
        '<' => "&lt;".to_owned(),
        '>' => "&gt;".to_owned(),
        '"' => "&quot;".to_owned(),
        c if c.is_control() => " ".to_owned(),
        c => c.to_string(),
    });
    escaped.collect()
}
