//! What reality does, in half a sentence with its size.

use stiffarm_gap::diagnose::Finding;

use super::{Screen, words};
use crate::terminal::text::short;

impl Screen<'_> {
    /// `joint 2 twists 0.150 µrad/(N·m) more than modelled`.
    pub(super) fn said(&self, finding: &Finding) -> String {
        let (effect, place) = (finding.effect, &finding.place);
        let first = finding.parameters.first().map_or(0.0, |p| p.value);
        let sized = |value: f64| {
            let unit = finding.parameters.first().map_or("", |p| p.unit);
            self.unit(effect, unit, value.abs()).with_unit(value)
        };
        let size = sized(first.abs());
        let compared = if first < 0.0 { "less" } else { "more" };
        match effect {
            "joint_offset" => format!("the zero of {place} is off by {}", sized(first)),
            "link_geometry" => {
                format!("the table's row of {place} is off by {}", self.row(finding))
            }
            "base_frame" => format!("the base stands {} off", self.moved(finding)),
            "tool_frame" => format!("the tool is {} off", self.moved(finding)),
            "joint_compliance" => {
                let yields = if finding.parameters.iter().any(|p| p.unit == "m/N") {
                    "yields"
                } else {
                    "twists"
                };
                format!("{place} {yields} {size} {compared} than modelled")
            }
            "joint_hardening" => format!("{place} does not give in proportion to its torque"),
            "bearing_compliance" => {
                let most = finding.parameters.iter().map(|p| p.value).fold(0.0, f64::max);
                format!("the bearing of {place} tilts {}", sized(most))
            }
            "link_compliance" => format!("{place} bends and twists {compared} than modelled"),
            "link_weight" => {
                let compared = if first < 0.0 { "lighter" } else { "heavier" };
                format!("{place} is {size} {compared} than modelled")
            }
            "base_compliance" => "the foundation gives under load".to_owned(),
            "wrench_scale" => {
                let compared = if first < 0.0 { "smaller" } else { "larger" };
                format!("the load is {size} {compared} than its columns say")
            }
            "payload_com" => {
                let beside =
                    self.unit(effect, "m", 1e-3).with_unit(norm(finding, &["x", "y", "z"]));
                format!("the load acts {beside} beside the tool origin")
            }
            "backlash" => format!("{place} has {size} of backlash"),
            "friction_hysteresis" => format!("friction winds {place} up by {size}"),
            "transmission_error" => {
                let (order, amplitude) = wave(finding);
                let size = sized(amplitude);
                format!("the gear of {place} errs by {size} with {order} periods per turn")
            }
            "joint_coupling" => {
                let other = finding.parameters.first().map_or("another joint", |p| &p.name);
                format!("{place} turns with {other}, by {}", sized(first))
            }
            "thermal_growth" => format!("the arm grows by {}", sized(first)),
            "instrument_scale" => {
                let compared = if first < 0.0 { "short" } else { "long" };
                format!("the instrument reads {size} too {compared}")
            }
            "joint_ratio" => format!("{place} turns {size} {compared} than its reading"),
            "settling_lag" => {
                format!("{place} is read {} of its last move before it rests", sized(first))
            }
            "drift" => "the measuring frame drifts with time".to_owned(),
            "slip" => {
                let of = if place == "tool" { "the reflector" } else { "the base" };
                let moved = self.moved(finding);
                format!("{of} jumps by {moved} after row {}", short(first))
            }
            "geometric_stiffness" => {
                format!("the simulator leaves out {size} of what the loaded geometry does")
            }
            other => format!("{} at {place}", words(other)),
        }
    }

    /// Lengths and angles of a row that are told from zero; all of them if none is.
    fn row(&self, finding: &Finding) -> String {
        let is_told = |ci: [f64; 2]| ci[0] > 0.0 || ci[1] < 0.0;
        let any = finding.parameters.iter().any(|p| is_told(p.ci95));
        let told = finding.parameters.iter().filter(|p| !any || is_told(p.ci95));
        let each = told.map(|p| {
            let size = self.unit(finding.effect, p.unit, p.value.abs());
            format!("{} in {}", size.with_unit(p.value), p.name)
        });
        each.collect::<Vec<_>>().join(", ")
    }

    /// How far a frame is moved and turned.
    fn moved(&self, finding: &Finding) -> String {
        let parts = [("m", ["x", "y", "z"]), ("rad", ["rx", "ry", "rz"])].map(|(unit, names)| {
            let size = norm(finding, &names);
            (size, self.unit(finding.effect, unit, size).with_unit(size))
        });
        let there = parts.into_iter().filter(|(size, _)| *size > 0.0);
        there.map(|(_, text)| text).collect::<Vec<_>>().join(" and ")
    }
}

fn value(finding: &Finding, name: &str) -> f64 {
    finding.parameters.iter().find(|p| p.name == name).map_or(0.0, |p| p.value)
}

fn norm(finding: &Finding, names: &[&str]) -> f64 {
    names.iter().map(|name| value(finding, name).powi(2)).sum::<f64>().sqrt()
}

/// Order and amplitude of the strongest wave.
fn wave(finding: &Finding) -> (String, f64) {
    let orders = finding.parameters.iter().filter_map(|p| p.name.strip_prefix("cos "));
    let each = orders.map(|order| {
        let amplitude =
            value(finding, &format!("cos {order}")).hypot(value(finding, &format!("sin {order}")));
        (order.to_owned(), amplitude)
    });
    each.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default()
}
