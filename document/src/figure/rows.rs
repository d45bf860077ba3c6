//! The rows as the page draws them: what was measured where, and the gap before and after.

use nalgebra::Vector6;
use serde::Serialize;
use serde_json::Value;
use stiffarm_gap::measurement::{Kind, Row};
use stiffarm_kernels::Motion;

use super::csv::{Csv, number, residual};
use super::experiment::Experiment;

/// Something that residuals are drawn against.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Against {
    /// With its unit.
    name: String,
    /// Column of the table.
    column: usize,
    /// What one of the shown unit is in SI.
    si: f64,
    /// Whether its values are a few classes, drawn beside one another.
    classes: bool,
}

/// A component of the gap.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Component {
    name: String,
    unit: &'static str,
    si: f64,
    /// Columns of the table.
    before: usize,
    after: usize,
}

/// All rows, and what is what in them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Rows {
    /// In SI.
    pub table: Csv,
    /// One panel each.
    pub against: Vec<Against>,
    /// The first is shown first.
    pub components: Vec<Component>,
    /// Columns of the gap's vector that is drawn in space, before and after; none where nothing is
    /// measured.
    pub vectors: [[Option<usize>; 3]; 2],
}

/// A table that grows by columns.
#[derive(Default)]
struct Columns {
    names: Vec<String>,
    cells: Vec<Vec<Value>>,
}

impl Columns {
    fn add(&mut self, name: impl Into<String>, cells: impl Iterator<Item = Value>) -> usize {
        self.names.push(name.into());
        self.cells.push(cells.collect());
        self.cells.len() - 1
    }

    fn table(self, rows: usize) -> Csv {
        let row = |k: usize| self.cells.iter().map(|column| column[k].clone()).collect();
        let rows = (0..rows).map(row).collect();
        Csv { columns: self.names, rows }
    }
}

pub fn rows(experiment: &Experiment<'_>) -> Rows {
    let rows = &experiment.data.rows;
    let mut columns = Columns::default();
    columns.add("line", rows.iter().map(|r| Value::from(r.line)));
    if rows.iter().any(|r| r.marker.is_some()) {
        columns.add("marker", rows.iter().map(|r| Value::from(r.marker.clone())));
    }
    let mut against = readings(experiment, &mut columns);
    against.extend(circumstances(rows, &mut columns));
    let components = gaps(experiment, &mut columns);
    let vectors = vectors(experiment, &components);
    Rows { table: columns.table(rows.len()), against, components, vectors }
}

/// Joint readings.
fn readings(experiment: &Experiment<'_>, columns: &mut Columns) -> Vec<Against> {
    let each = experiment.arm.joints.iter().enumerate().map(|(j, joint)| {
        let (file, shown, si) = match joint.motion {
            Motion::Revolute => ("rad", "°", 1_f64.to_radians()),
            Motion::Prismatic => ("m", "mm", 1e-3),
        };
        let cells = experiment.data.rows.iter().map(|r| number(r.q[j]));
        let column = columns.add(format!("q{}[{file}]", j + 1), cells);
        Against { name: format!("joint {}, {shown}", j + 1), column, si, classes: false }
    });
    each.collect()
}

/// Loads, directions, temperature and time, as far as they differ between rows.
fn circumstances(rows: &[Row], columns: &mut Columns) -> Vec<Against> {
    type Read<'a> = Box<dyn Fn(&Row) -> Option<f64> + 'a>;
    let load = |from: usize| move |r: &Row| Some(r.wrench.fixed_rows::<3>(from).norm());
    let mut things: Vec<(String, String, f64, bool, Read<'_>)> = vec![
        ("force[N]".to_owned(), "force, N".to_owned(), 1.0, false, Box::new(load(0))),
        ("moment[Nm]".to_owned(), "moment, N·m".to_owned(), 1.0, false, Box::new(load(3))),
    ];
    for j in 0..rows.first().map_or(0, |r| r.q.len()) {
        let side = move |r: &Row| r.direction.as_ref().map(|s| f64::from(s[j]));
        let name = format!("direction of joint {}", j + 1);
        things.push((format!("s{}", j + 1), name, 1.0, true, Box::new(side)));
    }
    let plain = |name: &str| name.to_owned();
    things.push((
        plain("temperature[degC]"),
        plain("temperature, °C"),
        1.0,
        false,
        Box::new(|r| r.temperature),
    ));
    let (unit, si) = match rows.iter().filter_map(|r| r.time).fold(0.0, f64::max) {
        last if last > 7200.0 => ("h", 3600.0),
        last if last > 300.0 => ("min", 60.0),
        _ => ("s", 1.0),
    };
    things.push((plain("time[s]"), format!("time, {unit}"), si, false, Box::new(|r| r.time)));
    let mut against = Vec::new();
    for (head, name, si, classes, read) in things {
        let values: Vec<Option<f64>> = rows.iter().map(read).collect();
        if values.windows(2).all(|pair| pair[0] == pair[1]) {
            continue;
        }
        let cells = values.into_iter().map(|v| v.map_or(Value::Null, number));
        let column = columns.add(head, cells);
        against.push(Against { name, column, si, classes });
    }
    // Rows stand in the order in which they were measured.
    let column = columns.add("row", (1..=rows.len()).map(Value::from));
    against.push(Against { name: plain("row, as measured"), column, si: 1.0, classes: false });
    against
}

/// Where the translation stands, or the rotation without one.
fn vectors(experiment: &Experiment<'_>, components: &[Component]) -> [[Option<usize>; 3]; 2] {
    if matches!(experiment.data.kind, Kind::Distance | Kind::Bench { .. }) {
        return [[None; 3]; 2];
    }
    let first = if experiment.has_positions() { 0 } else { 3 };
    let names = &experiment.data.kind.names()[first..first + 3];
    let find = |k: usize| components.iter().find(|c| c.name == names[k]);
    [
        std::array::from_fn(|k| find(k).map(|c| c.before)),
        std::array::from_fn(|k| find(k).map(|c| c.after)),
    ]
}

/// The measured components of the gap and their norms, the one that is judged first.
fn gaps(experiment: &Experiment<'_>, columns: &mut Columns) -> Vec<Component> {
    let names = experiment.data.kind.names();
    let measured = experiment.data.kind.components();
    let mut components = Vec::new();
    let mut add = |name: String, head: &str, is_turn: bool, of: &dyn Fn(&Vector6<f64>) -> f64| {
        let (file, unit) =
            if is_turn { ("rad", experiment.angle) } else { ("m", experiment.length) };
        let mut column = |when: &str, gaps: &[Vector6<f64>]| {
            let cells = gaps.iter().map(|g| residual(of(g)));
            columns.add(format!("{head}_{when}[{file}]"), cells)
        };
        let before = column("before", experiment.gaps[0]);
        let after = column("after", experiment.gaps[1]);
        components.push(Component { name, unit: unit.name, si: unit.si, before, after });
    };
    for (from, what) in [(0, "position"), (3, "rotation")] {
        let count = measured[from..from + 3].iter().filter(|m| **m).count();
        let norm = |g: &Vector6<f64>| g.fixed_rows::<3>(from).norm();
        if count > 1 {
            add(format!("{what}, all components"), &format!("gap_{what}"), from == 3, &norm);
        }
        for k in (from..from + 3).filter(|&k| measured[k]) {
            add(names[k].to_owned(), &format!("gap_{}", names[k]), from == 3, &|g| g[k]);
        }
    }
    components
}
