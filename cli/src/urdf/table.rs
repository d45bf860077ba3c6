//! A chain of axes as rows of the modified Denavit-Hartenberg convention (Khalil, Craig): row i is
//! `Rx(alpha) Tx(a) Rz(theta) Tz(d)`, its z axis the joint's.
//!
//! In the posture q = 0 each axis is a line. From line to line leads a common normal: its foot and
//! direction on one line are the origin and the x axis of that line's frame. Where lines are
//! parallel there are many normals, and where they coincide there is none: then the frame before is
//! kept as it is. Of the two directions of a normal the one that turns theta less is taken.

use core::f64::consts::PI;

use nalgebra::{IsometryMatrix3, Matrix3, Point3, Rotation3, Translation3, Unit, Vector3};

use super::chain::Chain;

/// Below this sine two axes are parallel: products of a few dozen rotations round to less.
const PARALLEL: f64 = 1e-12;

/// Below this, m (relative to the arm's size where that is larger), two lines meet.
const MEET: f64 = 1e-13;

/// Numbers of one row, rad and m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Row {
    /// The offset of a joint that turns.
    pub theta: f64,
    /// The offset of a joint that slides.
    pub d: f64,
    /// Along x.
    pub a: f64,
    /// About x.
    pub alpha: f64,
}

/// The chain as a table.
#[derive(Clone, Debug)]
pub struct Table {
    /// One per joint.
    pub rows: Vec<Row>,
    /// What stands before the first row: the table's base frame is the URDF's, turned by this angle
    /// about z, rad, and moved along z, m.
    pub lead: [f64; 2],
    /// The frames of the rows in the posture q = 0, in the URDF's base frame.
    pub frames: Vec<IsometryMatrix3<f64>>,
    /// The tip in the last row's frame.
    pub tool: IsometryMatrix3<f64>,
}

/// A point and a direction.
#[derive(Clone, Copy)]
struct Line {
    point: Point3<f64>,
    along: Unit<Vector3<f64>>,
}

/// A frame whose z axis lies on a line.
#[derive(Clone, Copy)]
struct Frame {
    origin: Point3<f64>,
    x: Vector3<f64>,
}

/// The way from one line to the next.
struct Normal {
    foot: Frame,
    a: f64,
    alpha: f64,
}

impl Table {
    /// Of a chain.
    pub fn new(chain: &Chain) -> Table {
        let (lines, tip) = lines(chain);
        let size = lines.iter().map(|line| line.point.coords.norm()).fold(1.0, f64::max);
        let mut at = Frame { origin: Point3::origin(), x: Vector3::x() };
        let mut rows: Vec<Row> = Vec::new();
        let mut lead = [0.0; 2];
        let mut frames = Vec::new();
        for k in 0..lines.len() {
            let here = lines[k];
            let normal = match lines.get(k + 1) {
                Some(next) => normal(&at, &here, next, MEET * size),
                None => Normal { foot: last(&at, &here, &tip), a: 0.0, alpha: 0.0 },
            };
            let [theta, d] = screw(&at, &normal.foot, &here);
            match rows.last_mut() {
                None => lead = [theta, d],
                Some(row) => (row.theta, row.d) = (theta, d),
            }
            if k > 0 {
                frames.push(isometry(&normal.foot, &here));
            }
            if k + 1 < lines.len() {
                rows.push(Row { a: normal.a, alpha: normal.alpha, ..Row::default() });
            }
            let origin = normal.foot.origin + normal.foot.x * normal.a;
            at = Frame { origin, x: normal.foot.x };
        }
        let tool = frames.last().map_or(tip, |last| last.inverse() * tip);
        Table { rows, lead, frames, tool }
    }
}

/// The base's z axis and the joints' axes at q = 0, and the tip.
fn lines(chain: &Chain) -> (Vec<Line>, IsometryMatrix3<f64>) {
    let mut lines = vec![Line { point: Point3::origin(), along: Vector3::z_axis() }];
    let mut frame = IsometryMatrix3::identity();
    for step in &chain.steps {
        frame *= step.before;
        let along = frame.rotation * step.axis;
        lines.push(Line { point: Point3::from(frame.translation.vector), along });
    }
    (lines, frame * chain.end)
}

/// The common normal of two lines; `at` is the frame that came to the first.
fn normal(at: &Frame, here: &Line, next: &Line, meet: f64) -> Normal {
    let (z, next_z) = (here.along.into_inner(), next.along.into_inner());
    let cross = z.cross(&next_z);
    let sine = cross.norm();
    if sine <= PARALLEL {
        let alpha = if z.dot(&next_z) > 0.0 { 0.0 } else { PI };
        let between = next.point - at.origin;
        let across = between - z * z.dot(&between);
        if across.norm() <= meet {
            return Normal { foot: *at, a: 0.0, alpha };
        }
        let x = facing(across.normalize(), at.x);
        return Normal { foot: Frame { origin: at.origin, x }, a: across.dot(&x), alpha };
    }
    let x = facing(cross / sine, at.x);
    let between = next.point - here.point;
    let along = between.cross(&next_z).dot(&cross) / (sine * sine);
    let origin = here.point + z * along;
    let a = between.dot(&x);
    let a = if a.abs() <= meet { 0.0 } else { a };
    Normal { foot: Frame { origin, x }, a, alpha: x.dot(&cross).atan2(z.dot(&next_z)) }
}

/// The direction or its opposite, whichever is nearer to `x`.
fn facing(direction: Vector3<f64>, x: Vector3<f64>) -> Vector3<f64> {
    if direction.dot(&x) < -1e-9 { -direction } else { direction }
}

/// On the last line: beside the tip, and where the tip's z is the line's, with its x.
fn last(at: &Frame, here: &Line, tip: &IsometryMatrix3<f64>) -> Frame {
    let z = here.along.into_inner();
    let tip_origin = Point3::from(tip.translation.vector);
    let origin = at.origin + z * z.dot(&(tip_origin - at.origin));
    let (tip_x, tip_z) = (tip.rotation * Vector3::x(), tip.rotation * Vector3::z());
    let same = z.cross(&tip_z).norm() <= PARALLEL && z.dot(&tip_z) > 0.0;
    Frame { origin, x: if same { tip_x } else { at.x } }
}

/// Angle about the line and distance along it from one of its frames to another.
fn screw(from: &Frame, to: &Frame, line: &Line) -> [f64; 2] {
    let z = line.along.into_inner();
    let theta = z.dot(&from.x.cross(&to.x)).atan2(from.x.dot(&to.x));
    [theta, z.dot(&(to.origin - from.origin))]
}

fn isometry(frame: &Frame, line: &Line) -> IsometryMatrix3<f64> {
    let z = line.along.into_inner();
    let axes = Matrix3::from_columns(&[frame.x, z.cross(&frame.x), z]);
    IsometryMatrix3::from_parts(
        Translation3::from(frame.origin.coords),
        Rotation3::from_matrix_unchecked(axes),
    )
}
