//! Measurements as the text of a measurement file.

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::{
    BOARD_NAMES, FROM_NAMES, Kind, Measurements, NORMAL_NAMES, PIXEL_NAMES, Row, SIGMA_PREFIX,
    SIM_PREFIX, TILT_NAMES, WRENCH_NAMES,
};
use crate::instrument::{Aim, Seen, View};
use crate::io::{Columns, number, quoted};

/// The measurement file of some measurements: comment lines, a header with SI units, and one line
/// per row. Numbers have as many digits as it takes to read the same numbers back.
///
/// Columns that no row uses (directions, temperature, time, pose, marker, session, payload, standard
/// deviations) are left out.
pub fn csv(arm: &Arm, data: &Measurements, comments: &[String]) -> String {
    let mut columns: Columns<'_, &Row> = Columns::default();
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
    let has_corners = data.by_board && data.rows.iter().any(|r| r.marker.is_some());
    if all(|r| r.marker.is_some()) || has_corners {
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
    let is_bench = matches!(data.kind, Kind::Bench { .. });
    if is_bench || data.kind == Kind::Distance {
        bench(&mut columns, data);
    }
    let names = if data.by_camera && !is_bench { BOARD_NAMES } else { data.kind.names() };
    let measured = data.kind.components();
    for k in (0..6).filter(|k| measured[*k] && !is_bench) {
        let unit = if k < 3 { "m" } else { "rad" };
        columns.add(format!("{}[{unit}]", names[k]), move |r| number(r.measured[k]));
    }
    let has_sigma =
        |k: &usize| data.rows.iter().all(|r| r.sigma.as_ref().is_some_and(|s| s[*k] > 0.0));
    let own_sigma = |r: &Row| {
        let view = r.aim.as_ref().map(|aim| aim.view);
        let sigma = r.sigma.as_ref()?;
        let own = match view {
            Some(View::Camera { lens, .. }) => sigma[3] * lens.focus,
            Some(View::Level(_)) => sigma[3],
            _ => sigma[0],
        };
        Some(own).filter(|own| *own > 0.0)
    };
    if is_bench && data.rows.iter().any(|r| own_sigma(r).is_some()) {
        columns.add("sigma", move |r| own_sigma(r).map_or_else(String::new, number));
    }
    for k in (0..6).filter(|k| measured[*k] && !is_bench).filter(has_sigma) {
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

/// The columns of what instruments read that are no trackers; cells of other kinds are empty.
fn bench(columns: &mut Columns<'_, &Row>, data: &Measurements) {
    let any = |is: &dyn Fn(&Aim) -> bool| data.rows.iter().filter_map(|r| r.aim.as_deref()).any(is);
    fn of(row: &Row, seen: Seen) -> Option<&Aim> {
        row.aim.as_deref().filter(|aim| aim.seen == seen)
    }
    let name = move |row: &&Row, seen: Seen| {
        of(row, seen).map_or_else(String::new, |aim| quoted(Some(&aim.name)))
    };
    for seen in [Seen::Point, Seen::Plane] {
        if any(&|aim| aim.seen == seen) {
            columns.add(seen.thing(), move |r| name(r, seen));
        }
    }
    if any(&|aim| aim.seen == Seen::Distance && !aim.name.is_empty()) {
        columns.add("from", move |r| name(r, Seen::Distance));
    }
    if any(&|aim| aim.seen == Seen::Distance && aim.free.is_empty()) {
        for (k, name) in FROM_NAMES.iter().enumerate() {
            let at = move |r: &&Row| {
                let place = of(r, Seen::Distance).and_then(|aim| aim.view.place());
                place.map_or_else(String::new, |at| number(at[k]))
            };
            columns.add(format!("{name}[m]"), at);
        }
    }
    let reads = |r: &&Row, seen: &[Seen]| {
        let is = r.aim.as_deref().is_some_and(|aim| seen.contains(&aim.seen));
        if is { number(r.measured[0]) } else { String::new() }
    };
    if data.kind != Kind::Distance && any(&|aim| matches!(aim.seen, Seen::Distance | Seen::Plane)) {
        columns.add("distance[m]", move |r| reads(r, &[Seen::Distance, Seen::Plane]));
    }
    let zero = |aim: &Aim| aim.seen == Seen::Direction && !aim.name.is_empty();
    if any(&zero) {
        columns.add("zero", move |r| name(r, Seen::Direction));
    }
    let angle = |r: &&Row, seen: Seen, k: usize| {
        let aim = of(r, seen);
        let unit =
            aim.map(|aim| if let View::Camera { lens, .. } = aim.view { lens.focus } else { 1.0 });
        unit.map_or_else(String::new, |unit| number(r.measured[3 + k] * unit))
    };
    for (seen, names, unit) in [(Seen::Level, TILT_NAMES, "rad"), (Seen::Camera, PIXEL_NAMES, "px")]
    {
        for (k, name) in names.into_iter().enumerate().filter(|_| any(&|aim| aim.seen == seen)) {
            columns.add(format!("{name}[{unit}]"), move |r| angle(r, seen, k));
        }
    }
    if any(&|aim| aim.seen == Seen::Camera) {
        columns.add("camera", |r| quoted(r.camera.as_deref().map(|sight| &*sight.camera)));
        columns.add("board", |r| quoted(r.camera.as_deref().map(|sight| &*sight.board)));
    }
    if any(&|aim| aim.seen == Seen::Direction) {
        columns.add("along[m]", move |r| reads(r, &[Seen::Direction]));
        for (k, name) in NORMAL_NAMES.iter().enumerate() {
            let cell = move |r: &&Row| match r.aim.as_deref().map(|aim| aim.view) {
                Some(View::Direction { along, .. }) => number(along[k]),
                _ => String::new(),
            };
            columns.add(*name, cell);
        }
    }
}
