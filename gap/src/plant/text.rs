//! Measurements as the text of a measurement file.

use core::fmt::Write as _;

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use crate::measurement::{
    FROM_NAMES, Kind, Measurements, Row, SIGMA_PREFIX, SIM_PREFIX, WRENCH_NAMES,
};

/// One column: its header, and its cell of a row.
struct Column {
    header: String,
    cell: Box<dyn Fn(&Row) -> String>,
}

/// The measurement file of some measurements: comment lines, a header with SI units, and one line
/// per row. Numbers have as many digits as it takes to read the same numbers back.
///
/// Columns that no row uses (directions, temperature, time, pose, marker, session, payload, standard
/// deviations) are left out.
pub fn csv(arm: &Arm, data: &Measurements, comments: &[String]) -> String {
    let mut text = String::new();
    for line in comments.iter().flat_map(|comment| comment.lines()) {
        let _ = writeln!(text, "# {}", line.trim_end());
    }
    let columns = columns(arm, data);
    let headers: Vec<&str> = columns.iter().map(|c| c.header.as_str()).collect();
    let _ = writeln!(text, "{}", headers.join(","));
    for row in &data.rows {
        let cells: Vec<String> = columns.iter().map(|c| (c.cell)(row)).collect();
        let _ = writeln!(text, "{}", cells.join(","));
    }
    text
}

fn columns(arm: &Arm, data: &Measurements) -> Vec<Column> {
    let mut columns = Vec::new();
    let mut add = |header: String, cell: Box<dyn Fn(&Row) -> String>| {
        columns.push(Column { header, cell });
    };
    let all = |has: fn(&Row) -> bool| data.rows.iter().all(has);
    if all(|r| r.pose.is_some()) {
        add("pose".to_owned(), Box::new(|r| quoted(r.pose.as_deref())));
    }
    if all(|r| r.session.is_some()) {
        add("session".to_owned(), Box::new(|r| quoted(r.session.as_deref())));
    }
    if all(|r| r.payload.is_some()) {
        add(
            "payload".to_owned(),
            Box::new(|r| quoted(r.payload.as_ref().map(|p| p.name.as_str()))),
        );
    }
    if all(|r| r.time.is_some()) {
        add("time[s]".to_owned(), Box::new(|r| number(r.time.unwrap_or_default())));
    }
    if all(|r| r.temperature.is_some()) {
        let cell = |r: &Row| number(r.temperature.unwrap_or_default());
        add("temperature[degC]".to_owned(), Box::new(cell));
    }
    for (j, joint) in arm.joints.iter().enumerate() {
        let unit = if joint.motion == Motion::Revolute { "rad" } else { "m" };
        add(format!("q{}[{unit}]", j + 1), Box::new(move |r| number(r.q[j])));
    }
    if all(|r| r.direction.is_some()) {
        for j in 0..arm.dof() {
            let side = move |r: &Row| r.direction.as_ref().map_or(0, |s| s[j]).to_string();
            add(format!("s{}", j + 1), Box::new(side));
        }
    }
    if all(|r| r.marker.is_some()) {
        add("marker".to_owned(), Box::new(|r| quoted(r.marker.as_deref())));
    }
    for (k, name) in WRENCH_NAMES.iter().enumerate() {
        // A payload is told by its name.
        let load = move |r: &Row| r.wrench[k] - r.payload.as_ref().map_or(0.0, |p| p.weight[k]);
        if data.rows.iter().any(|r| load(r) != 0.0) {
            let unit = if k < 3 { "N" } else { "Nm" };
            add(format!("{name}[{unit}]"), Box::new(move |r| number(load(r))));
        }
    }
    if data.kind == Kind::Distance && all(|r| r.from_point.is_some()) {
        add("from".to_owned(), Box::new(|r| quoted(r.from_point.as_deref())));
    }
    if data.kind == Kind::Distance && all(|r| r.from.is_some()) {
        for (k, name) in FROM_NAMES.iter().enumerate() {
            add(format!("{name}[m]"), Box::new(move |r| number(r.from.unwrap_or_default()[k])));
        }
    }
    let names = data.kind.names();
    let measured = data.kind.components();
    for k in (0..6).filter(|k| measured[*k]) {
        let unit = if k < 3 { "m" } else { "rad" };
        add(format!("{}[{unit}]", names[k]), Box::new(move |r| number(r.measured[k])));
    }
    let has_sigma =
        |k: &usize| data.rows.iter().all(|r| r.sigma.as_ref().is_some_and(|s| s[*k] > 0.0));
    for k in (0..6).filter(|k| measured[*k]).filter(has_sigma) {
        let unit = if k < 3 { "m" } else { "rad" };
        let cell = move |r: &Row| number(r.sigma.as_ref().map_or(0.0, |sigma| sigma[k]));
        add(format!("{SIGMA_PREFIX}{}[{unit}]", names[k]), Box::new(cell));
    }
    for k in (0..6).filter(|k| data.sim_given[*k]) {
        let unit = if k < 3 { "m" } else { "rad" };
        let cell = move |r: &Row| number(r.sim.as_ref().map_or(0.0, |sim| sim[k]));
        add(format!("{SIM_PREFIX}{}[{unit}]", names[k]), Box::new(cell));
    }
    columns
}

/// A number as a cell: the shortest text that reads as the same number; −0 is 0.
pub fn number(value: f64) -> String {
    let value = value + 0.0;
    let size = value.abs();
    if size != 0.0 && !(1e-4..1e9).contains(&size) {
        format!("{value:e}")
    } else {
        value.to_string()
    }
}

/// An id as a cell, empty of none: in quotation marks where it needs them.
pub fn quoted(id: Option<&str>) -> String {
    let id = id.unwrap_or_default();
    if id.contains([',', '"', '\n', '\r', '#']) || id != id.trim() {
        return format!("\"{}\"", id.replace('"', "\"\""));
    }
    id.to_owned()
}
