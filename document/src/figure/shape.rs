//! A joint's motion as a function of its angle, torque or direction, with the rows around it.
//!
//! A row's point is a partial residual: the fitted shape there, plus what the row's remaining gap
//! is as a motion of the joint (its projection on the joint's Jacobian column, at the measured
//! point). Points that lie along the curve say that the shape is right; a bend says what it lacks.

use nalgebra::{Isometry3, Vector3, Vector6};
use serde::Serialize;
use serde_json::Value;
use stiffarm_gap::effects::{Curve, Over};
use stiffarm_gap::measurement::{Kind, Row};
use stiffarm_gap::simulate::equilibrium;
use stiffarm_kernels::Motion;

use super::csv::{Csv, number, residual};
use super::experiment::Experiment;

/// Points of a curve.
const STEPS: usize = 96;

/// A joint that moves the point by less than this part of the most it does tells nothing of itself.
const LEAST_LEVER: f64 = 0.1;

/// Below this a thousandth of the unit is shown, rad or m.
const SMALL: f64 = 2e-4;

/// A fitted shape.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Shape {
    title: String,
    x: Axis,
    y: Axis,
    /// Whether x is a direction.
    classes: bool,
    /// Through these, SI.
    curve: Vec<[Value; 2]>,
    /// Line, x, partial residual, fitted: SI.
    table: Csv,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct Axis {
    name: String,
    si: f64,
}

/// What was found at a joint as a function of one thing.
pub struct Shaped<'a> {
    /// What it is.
    pub title: String,
    /// From 0.
    pub joint: usize,
    /// The joint's motion.
    pub curve: Curve<'a>,
}

/// A curve with the rows around it; none where its argument does not vary.
pub fn shape(experiment: &Experiment<'_>, shaped: &Shaped<'_>) -> Option<Shape> {
    let Shaped { title, joint, curve: Curve { over, value, .. } } = shaped;
    let (joint, over) = (*joint, *over);
    let motion = experiment.arm.joints.get(joint)?.motion;
    let rows = &experiment.data.rows;
    let levers: Vec<Vector6<f64>> = rows.iter().map(|row| lever(experiment, row, joint)).collect();
    let longest = levers.iter().map(Vector6::norm_squared).fold(0.0, f64::max);
    let rows = rows.iter().zip(experiment.gaps[1]).zip(&levers);
    let mut points: Vec<[f64; 3]> = Vec::new();
    for ((row, gap), lever) in rows {
        let size = lever.norm_squared();
        if size <= LEAST_LEVER.powi(2) * longest {
            continue;
        }
        let x = match over {
            Over::Torque => torque(experiment, row, joint)?,
            Over::Reading => row.q[joint],
            Over::Direction => f64::from(row.direction.as_ref()?[joint]),
        };
        points.push([row.line as f64, x, value(x) + lever.dot(gap) / size]);
    }
    let low = points.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let high = points.iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
    if low >= high {
        return None;
    }
    let (x, head) = names(over, motion, joint);
    let most = points.iter().map(|p| p[2].abs()).fold(0.0, f64::max);
    let (file, y) = shown(motion, most);
    let mut table = Csv::new(&["line"]);
    table.columns.extend([head, format!("partial_residual[{file}]"), format!("fitted[{file}]")]);
    let cells = |p: &[f64; 3]| {
        vec![Value::from(p[0] as u64), number(p[1]), residual(p[2]), residual(value(p[1]))]
    };
    table.rows = points.iter().map(cells).collect();
    let at = |k: usize| low + (high - low) * k as f64 / STEPS as f64;
    Some(Shape {
        title: title.clone(),
        x,
        y,
        classes: over == Over::Direction,
        curve: (0..=STEPS).map(|k| [number(at(k)), number(value(at(k)))]).collect(),
        table,
    })
}

/// What load and weight do to a joint of the robot file's arm; for a displacement, what the load
/// adds. None where it has no equilibrium.
pub(super) fn torque(experiment: &Experiment<'_>, row: &Row, joint: usize) -> Option<f64> {
    let under = |wrench: &Vector6<f64>| {
        equilibrium(experiment.arm, &row.q, wrench).ok().map(|state| state.torque[joint])
    };
    let loaded = under(&row.wrench)?;
    match experiment.data.kind {
        Kind::Displacement { .. } => Some(loaded - under(&Vector6::zeros())?),
        _ => Some(loaded),
    }
}

/// Motion of the measured components per motion of a joint: translations if there are any, else
/// rotations; measuring frame.
pub(super) fn lever(experiment: &Experiment<'_>, row: &Row, joint: usize) -> Vector6<f64> {
    let column: Vector6<f64> = experiment.placed.jacobian(&row.q).column(joint).into_owned();
    let turn: Vector3<f64> = column.fixed_rows::<3>(3).into_owned();
    let point = experiment.point(row);
    let from_tool = point.coords - experiment.placed.pose(&row.q).translation.vector;
    let shift: Vector3<f64> = column.fixed_rows::<3>(0) + turn.cross(&from_tool);
    if let Some(aim) = &row.aim {
        let at = Isometry3::from_parts(point.into(), experiment.frame(row).rotation);
        let moved =
            aim.view.by_frame(&at) * Vector6::from_iterator(shift.iter().chain(&turn).copied());
        let first = if aim.view.is_angle() { 3 } else { 0 };
        let mut lever = Vector6::zeros();
        lever.fixed_rows_mut::<3>(first).copy_from(&moved);
        return lever;
    }
    let (from, part) = if experiment.has_positions() { (0, shift) } else { (3, turn) };
    let measured = experiment.data.kind.components();
    let mut lever = Vector6::zeros();
    for k in (0..3).filter(|k| measured[from + k]) {
        lever[from + k] = part[k];
    }
    lever
}

/// The axis, and the column's head.
fn names(over: Over, motion: Motion, joint: usize) -> (Axis, String) {
    let number = joint + 1;
    let (name, si, head) = match (over, motion) {
        (Over::Torque, Motion::Revolute) => ("torque, N·m", 1.0, "torque[Nm]".to_owned()),
        (Over::Torque, Motion::Prismatic) => ("force, N", 1.0, "force[N]".to_owned()),
        (Over::Reading, Motion::Revolute) => {
            ("reading, °", 1_f64.to_radians(), format!("q{number}[rad]"))
        }
        (Over::Reading, Motion::Prismatic) => ("reading, mm", 1e-3, format!("q{number}[m]")),
        (Over::Direction, _) => ("direction of approach", 1.0, format!("s{number}")),
    };
    (Axis { name: name.to_owned(), si }, head)
}

/// The file's unit of a joint's motion, and in what motions up to `most` are shown.
fn shown(motion: Motion, most: f64) -> (&'static str, Axis) {
    let (file, names) = match motion {
        Motion::Revolute => ("rad", ["µrad", "mrad"]),
        Motion::Prismatic => ("m", ["µm", "mm"]),
    };
    let (unit, si) = if most < SMALL { (names[0], 1e-6) } else { (names[1], 1e-3) };
    (file, Axis { name: format!("joint moves, {unit}"), si })
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;
    use stiffarm_gap::Measurements;
    use stiffarm_gap::measurement::Sight;
    use stiffarm_plant::design::{Design, Shape};
    use stiffarm_table::robot::Robot;

    use super::*;
    use crate::Unit;

    /// What a joint moves a marker by, with the arm's base turned and the marker on something that is mounted on the
    /// tool, by central differences of where the marker is.
    #[test]
    fn a_lever_is_the_motion_of_the_point() {
        let text = stiffarm_robots::toml("irb120").expect("of the collection");
        let (robot, _) = Robot::from_toml(text, "irb120.toml").expect("a robot file");
        let mut arm = stiffarm_gap::robot::arm(&robot).expect("with numbers");
        arm.base = Isometry3::new(Vector3::new(0.3, -0.2, 0.1), Vector3::new(0.4, 1.1, -0.7));
        let kind = Kind::Pose { orientation: true };
        let drawn =
            Design { shape: Shape::Payload, poses: 5, repeats: 1, payload: 0.0, kind, seed: 1 };
        let mut rows = drawn.rows(&arm).rows;
        for row in &mut rows {
            let sight = Sight { board: "plate".to_owned(), has_board: true, ..Sight::default() };
            row.camera = Some(Box::new(sight));
            row.offset = Some([0.2, -0.1, 0.3]);
        }
        let data = Measurements::new("lever.csv", kind, rows);
        let mount = Isometry3::new(Vector3::new(0.1, 0.0, 0.2), Vector3::new(-0.5, 0.2, 0.9));
        let unit = Unit::of("m", 1.0);
        let experiment = Experiment {
            data: &data,
            arm: &arm,
            placed: &arm,
            mounts: vec![("plate", mount)],
            markers: Vec::new(),
            gaps: [&[], &[]],
            shares: Vec::new(),
            length: unit,
            angle: unit,
        };
        const STEP: f64 = 1e-5;
        for (row, joint) in data.rows.iter().flat_map(|row| (0..arm.dof()).map(move |j| (row, j))) {
            let at = |by: f64| {
                let mut moved = row.clone();
                moved.q[joint] += by;
                arm.frames(&moved.q)[arm.dof()] * arm.tool * mount * Point3::from([0.2, -0.1, 0.3])
            };
            let moved = (at(STEP) - at(-STEP)) / (2.0 * STEP);
            let lever = lever(&experiment, row, joint);
            // h²/6 of a metre, and rounding over h.
            assert!((lever.fixed_rows::<3>(0) - moved).norm() < 1e-9, "{joint}: {lever} {moved}");
        }
    }
}
