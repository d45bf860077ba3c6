//! A chain of axes as rows of the modified Denavit-Hartenberg convention (Khalil, Craig): row i is
//! `Rx(alpha) Tx(a) Rz(theta) Tz(d)`, its z axis the joint's.
//!
//! In the posture q = 0 each axis is a line. From line to line leads a common normal: its foot and
//! direction on one line are the origin and the x axis of that line's frame. Where lines are
//! parallel there are many normals, and where they coincide there is none: then the frame before is
//! kept as it is. Of the two directions of a normal the one that turns theta less is taken.

use core::f64::consts::PI;

use super::chain::Chain;
use crate::robot::space::{Frame, Vector, cross, dot, norm, plus, times};

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
    pub frames: Vec<Frame>,
    /// The tip in the last row's frame.
    pub tool: Frame,
}

/// A point and a unit vector.
#[derive(Clone, Copy)]
struct Line {
    point: Vector,
    along: Vector,
}

/// Origin and x axis of a frame whose z axis lies on a line.
#[derive(Clone, Copy)]
struct Foot {
    origin: Vector,
    x: Vector,
}

/// The way from one line to the next.
struct Normal {
    foot: Foot,
    a: f64,
    alpha: f64,
}

impl Table {
    /// Of a chain.
    pub fn new(chain: &Chain) -> Table {
        let (lines, tip) = lines(chain);
        let size = lines.iter().map(|line| norm(line.point)).fold(1.0, f64::max);
        let mut at = Foot { origin: [0.0; 3], x: [1.0, 0.0, 0.0] };
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
                frames.push(normal.foot.frame(&here));
            }
            if k + 1 < lines.len() {
                rows.push(Row { a: normal.a, alpha: normal.alpha, ..Row::default() });
            }
            let Foot { origin, x } = normal.foot;
            at = Foot { origin: plus(origin, normal.a, x), x };
        }
        let tool = frames.last().map_or(tip, |last| last.inverse().then(&tip));
        Table { rows, lead, frames, tool }
    }
}

/// The base's z axis and the joints' axes at q = 0, and the tip.
fn lines(chain: &Chain) -> (Vec<Line>, Frame) {
    let mut lines = vec![Line { point: [0.0; 3], along: [0.0, 0.0, 1.0] }];
    let mut frame = Frame::IDENTITY;
    for step in &chain.steps {
        frame = frame.then(&step.before);
        lines.push(Line { point: frame.origin, along: frame.direction(step.axis) });
    }
    (lines, frame.then(&chain.end))
}

/// The common normal of two lines; `at` is the frame that came to the first.
fn normal(at: &Foot, here: &Line, next: &Line, meet: f64) -> Normal {
    let (z, next_z) = (here.along, next.along);
    let cross_z = cross(z, next_z);
    let sine = norm(cross_z);
    if sine <= PARALLEL {
        let alpha = if dot(z, next_z) > 0.0 { 0.0 } else { PI };
        let between = plus(next.point, -1.0, at.origin);
        let across = plus(between, -dot(z, between), z);
        let distance = norm(across);
        if distance <= meet {
            return Normal { foot: *at, a: 0.0, alpha };
        }
        let x = facing(times(across, 1.0 / distance), at.x);
        return Normal { foot: Foot { origin: at.origin, x }, a: dot(across, x), alpha };
    }
    let x = facing(times(cross_z, 1.0 / sine), at.x);
    let between = plus(next.point, -1.0, here.point);
    let along = dot(cross(between, next_z), cross_z) / (sine * sine);
    let a = dot(between, x);
    let a = if a.abs() <= meet { 0.0 } else { a };
    let alpha = dot(x, cross_z).atan2(dot(z, next_z));
    Normal { foot: Foot { origin: plus(here.point, along, z), x }, a, alpha }
}

/// The direction or its opposite, whichever is nearer to `x`.
fn facing(direction: Vector, x: Vector) -> Vector {
    if dot(direction, x) < -1e-9 { times(direction, -1.0) } else { direction }
}

/// On the last line: beside the tip, and where the tip's z is the line's, with its x.
fn last(at: &Foot, here: &Line, tip: &Frame) -> Foot {
    let z = here.along;
    let origin = plus(at.origin, dot(z, plus(tip.origin, -1.0, at.origin)), z);
    let [tip_x, _, tip_z] = tip.axes;
    let same = norm(cross(z, tip_z)) <= PARALLEL && dot(z, tip_z) > 0.0;
    Foot { origin, x: if same { tip_x } else { at.x } }
}

/// Angle about the line and distance along it from one of its frames to another.
fn screw(from: &Foot, to: &Foot, line: &Line) -> [f64; 2] {
    let z = line.along;
    let theta = dot(z, cross(from.x, to.x)).atan2(dot(from.x, to.x));
    [theta, dot(z, plus(to.origin, -1.0, from.origin))]
}

impl Foot {
    fn frame(&self, line: &Line) -> Frame {
        Frame { axes: [self.x, cross(line.along, self.x), line.along], origin: self.origin }
    }
}
