//! Measurements as the text of a measurement file.

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::text::{Columns, number, quoted};
use crate::measurement::{
    FROM_NAMES, Kind, Measurements, Row, SIGMA_PREFIX, SIM_PREFIX, WRENCH_NAMES,
};

/// The measurement file of some measurements: comment lines, a header with SI units, and one line
/// per row. Numbers have as many digits as it takes to read the same numbers back.
///
/// Columns that no row uses (directions, temperature, time, pose, marker, session, payload, standard
/// deviations) are left out.
pub fn csv(arm: &Arm, data: &Measurements, comments: &[String]) -> String {
    let mut columns: Columns<'_, &Row> = Columns::new();
    let all = |has: fn(&Row) -> bool| data.rows.iter().all(has);
    if all(|r| r.pose.is_some()) {
        columns.add("pose", |r| quoted(r.pose.as_deref()));
    }
    if all(|r| r.session.is_some()) {
        columns.add("session", |r| quoted(r.session.as_deref()));
    }
    if all(|r| r.payload.is_some()) {
        columns.add("payload", |r| quoted(r.payload.as_ref().map(|p| p.name.as_str())));
    }
    if all(|r| r.time.is_some()) {
        columns.add("time[s]", |r| number(r.time.unwrap_or_default()));
    }
    if all(|r| r.temperature.is_some()) {
        let cell = |r: &&Row| number(r.temperature.unwrap_or_default());
        columns.add("temperature[degC]", cell);
    }
    for (j, joint) in arm.joints.iter().enumerate() {
        let unit = if joint.motion == Motion::Revolute { "rad" } else { "m" };
        columns.add(format!("q{}[{unit}]", j + 1), move |r| number(r.q[j]));
    }
    if all(|r| r.direction.is_some()) {
        for j in 0..arm.dof() {
            let side = move |r: &&Row| r.direction.as_ref().map_or(0, |s| s[j]).to_string();
            columns.add(format!("s{}", j + 1), side);
        }
    }
    if all(|r| r.marker.is_some()) {
        columns.add("marker", |r| quoted(r.marker.as_deref()));
    }
    for (k, name) in WRENCH_NAMES.iter().enumerate() {
        // A payload is told by its name.
        let load = move |r: &Row| r.wrench[k] - r.payload.as_ref().map_or(0.0, |p| p.weight[k]);
        if data.rows.iter().any(|r| load(r) != 0.0) {
            let unit = if k < 3 { "N" } else { "Nm" };
            columns.add(format!("{name}[{unit}]"), move |r| number(load(r)));
        }
    }
    if data.kind == Kind::Distance && all(|r| r.from_point.is_some()) {
        columns.add("from", |r| quoted(r.from_point.as_deref()));
    }
    if data.kind == Kind::Distance && all(|r| r.from.is_some()) {
        for (k, name) in FROM_NAMES.iter().enumerate() {
            columns.add(format!("{name}[m]"), move |r| number(r.from.unwrap_or_default()[k]));
        }
    }
    let names = data.kind.names();
    let measured = data.kind.components();
    for k in (0..6).filter(|k| measured[*k]) {
        let unit = if k < 3 { "m" } else { "rad" };
        columns.add(format!("{}[{unit}]", names[k]), move |r| number(r.measured[k]));
    }
    let has_sigma =
        |k: &usize| data.rows.iter().all(|r| r.sigma.as_ref().is_some_and(|s| s[*k] > 0.0));
    for k in (0..6).filter(|k| measured[*k]).filter(has_sigma) {
        let unit = if k < 3 { "m" } else { "rad" };
        let cell = move |r: &&Row| number(r.sigma.as_ref().map_or(0.0, |sigma| sigma[k]));
        columns.add(format!("{SIGMA_PREFIX}{}[{unit}]", names[k]), cell);
    }
    for k in (0..6).filter(|k| data.sim_given[*k]) {
        let unit = if k < 3 { "m" } else { "rad" };
        let cell = move |r: &&Row| number(r.sim.as_ref().map_or(0.0, |sim| sim[k]));
        columns.add(format!("{SIM_PREFIX}{}[{unit}]", names[k]), cell);
    }
    columns.text(comments, data.rows.iter())
}
