//! The findings of a diagnosis that are a function of one thing, as curves.

use stiffarm_gap::Measurements;
use stiffarm_gap::diagnose::{Diagnosis, Finding};
use stiffarm_gap::measurement::Kind;

use super::shape::{Curve, Over};

/// The curves of all findings that have one.
pub fn curves<'a>(found: &'a Diagnosis, data: &Measurements) -> Vec<Curve<'a>> {
    let curve = |finding: &'a Finding| {
        let joint = finding.place.strip_prefix("joint ")?.parse::<usize>().ok()?.checked_sub(1)?;
        Some(Curve {
            title: format!("{} at {}", finding.effect.replace('_', " "), finding.place),
            joint,
            over: over(data, finding.effect)?,
            value: Box::new(|x| value(finding, x)),
        })
    };
    found.findings.iter().filter_map(curve).collect()
}

/// Of a displacement only what is in proportion to the load is a function of one state.
fn over(data: &Measurements, effect: &str) -> Option<Over> {
    let displaced = matches!(data.kind, Kind::Displacement { .. });
    match effect {
        "joint_compliance" => Some(Over::Torque),
        "joint_hardening" if !displaced => Some(Over::Torque),
        "joint_ratio" | "transmission_error" if !displaced => Some(Over::Reading),
        "backlash" if !displaced => Some(Over::Direction),
        _ => None,
    }
}

/// The joint's motion by the finding, rad (m).
fn value(finding: &Finding, x: f64) -> f64 {
    let first = finding.parameters.first().map_or(0.0, |p| p.value);
    match finding.effect {
        "joint_hardening" => first * x.powi(3),
        // Half the dead band to either side, against the approach.
        "backlash" => -0.5 * first * x,
        "transmission_error" => finding.parameters.iter().map(|p| wave(&p.name, x) * p.value).sum(),
        _ => first * x,
    }
}

/// `cos 2` and `sin 2` at an angle; what is no wave is 0.
fn wave(name: &str, angle: f64) -> f64 {
    let Some((function, order)) = name.split_once(' ') else { return 0.0 };
    let Ok(order) = order.parse::<f64>() else { return 0.0 };
    match function {
        "cos" => (order * angle).cos(),
        "sin" => (order * angle).sin(),
        _ => 0.0,
    }
}
