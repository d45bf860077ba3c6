//! What the page's scripts read: the numbers of every plot and table.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::Value;
use stiffarm_gap::report::{CannotSee, Diagnosis, Hidden};

use super::Report;
use super::curves::curves;
use super::experiment::Drawn;
use super::rows::{Rows, rows};
use super::scene::{Scene, scene};
use super::shape::{Shape, shape};
use super::table::{Table, number};

/// Everything.
#[derive(Serialize)]
struct Embedded<'a> {
    rows: Rows,
    scene: Scene,
    shapes: Vec<Shape>,
    tables: BTreeMap<&'static str, Table>,
    diagnosis: &'a Diagnosis,
}

/// As JSON that may stand within a script element: nothing in it ends the element.
///
/// # Errors
/// [`serde_json::Error`] if something in it is no JSON.
pub fn json(report: &Report<'_>) -> Result<String, serde_json::Error> {
    let whole = report.experiment();
    let drawn = Drawn::of(&whole);
    let experiment = whole.with(&drawn);
    let curves = curves(report.found, report.data, &report.options.catalogue);
    let embedded = Embedded {
        rows: rows(&experiment),
        scene: scene(&experiment),
        shapes: curves.iter().filter_map(|curve| shape(&experiment, curve)).collect(),
        tables: tables(report),
        diagnosis: report.found,
    };
    within_script(&embedded)
}

/// JSON that may stand within a script element.
///
/// # Errors
/// [`serde_json::Error`] if it is no JSON.
pub fn within_script(value: &impl Serialize) -> Result<String, serde_json::Error> {
    Ok(serde_json::to_string(value)?.replace('<', "\\u003c"))
}

fn tables(report: &Report<'_>) -> BTreeMap<&'static str, Table> {
    BTreeMap::from([
        ("gap", gap(report)),
        ("places", places(report)),
        ("alternatives", alternatives(report)),
        ("cannot_see", cannot_see(report)),
        ("parameters", parameters(report)),
        ("frames", frames(report)),
    ])
}

/// The waterfall.
fn gap(report: &Report<'_>) -> Table {
    let unit = if report.has_positions() { "m" } else { "rad" };
    let mut table = Table::new(&["step"]);
    let numbers = ["before", "after"].map(|name| format!("{name}_rms[{unit}]"));
    table.columns.extend(numbers);
    table.columns.extend(["shrink", "shrink_low", "shrink_high"].map(str::to_owned));
    let gap = &report.found.gap;
    let main = |position: f64, rotation: f64| {
        number(if report.has_positions() { position } else { rotation })
    };
    let (before, after) = (&gap.before, &gap.after);
    let before = main(before.position_rms, before.rotation_rms);
    let after = main(after.position_rms, after.rotation_rms);
    let mut plain = |step: &str, before: Value, after: Value| {
        table.rows.push(vec![step.into(), before, after, Value::Null, Value::Null, Value::Null]);
    };
    plain("whole", before, after);
    plain("noise", Value::Null, main(gap.noise.position_rms, gap.noise.rotation_rms));
    for finding in &report.found.findings {
        let held = &finding.held_out;
        let mut row = vec![format!("{} at {}", finding.effect, finding.place).into()];
        row.extend([held.before(), held.after()].map(number));
        let shrink = held.shrink().map(|s| [s.shrink, s.shrink_ci95[0], s.shrink_ci95[1]]);
        row.extend(shrink.into_iter().flatten().map(number));
        table.rows.push(row);
    }
    table
}

fn places(report: &Report<'_>) -> Table {
    let mut table = Table::new(&["place", "share"]);
    let row = |share: &stiffarm_gap::diagnose::Share| {
        vec![share.place.as_str().into(), number(share.share)]
    };
    table.rows = report.found.places.iter().map(row).collect();
    table
}

fn alternatives(report: &Report<'_>) -> Table {
    let unit = if report.has_positions() { "m" } else { "rad" };
    let mut table = Table::new(&["finding", "alternative", "place"]);
    table.columns.extend([format!("held_out_after[{unit}]"), "separable".to_owned()]);
    for finding in &report.found.findings {
        let name = format!("{} at {}", finding.effect, finding.place);
        for other in &finding.alternatives {
            table.rows.push(vec![
                name.as_str().into(),
                other.effect.as_ref().into(),
                other.place.as_str().into(),
                number(other.left.size()),
                other.separable().into(),
            ]);
        }
    }
    table
}

fn cannot_see(report: &Report<'_>) -> Table {
    let mut table = Table::new(&["effect", "place", "visible", "because"]);
    let row = |one: &CannotSee| {
        let visible = match one.why {
            Hidden::AtRest { visible, .. } => number(visible),
            Hidden::InMotion { .. } => Value::Null,
        };
        vec![(*one.effect).into(), one.place.as_str().into(), visible, one.because().into()]
    };
    table.rows = report.found.cannot_see.iter().map(row).collect();
    table
}

fn parameters(report: &Report<'_>) -> Table {
    let heads = ["effect", "place", "parameter", "value", "unit", "low", "high"];
    let mut table = Table::new(&heads);
    for finding in &report.found.findings {
        for p in &finding.parameters {
            let mut row: Vec<Value> =
                [&*finding.effect, &finding.place, &p.name].map(Value::from).to_vec();
            row.extend([number(p.value), (*p.unit).into()]);
            row.extend(p.ci95.map(number));
            table.rows.push(row);
        }
    }
    table
}

/// The frames that were fitted along.
fn frames(report: &Report<'_>) -> Table {
    let heads = ["frame", "session", "x[m]", "y[m]", "z[m]", "rx[rad]", "ry[rad]", "rz[rad]"];
    let mut table = Table::new(&heads);
    for frame in &report.found.nuisances {
        let mut row = vec![frame.name.as_str().into(), frame.session.clone().into()];
        row.extend(frame.translation.into_iter().chain(frame.rotation).map(number));
        table.rows.push(row);
    }
    table
}
