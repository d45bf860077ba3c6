//! A chain of axes as rows of the modified Denavit-Hartenberg convention (Khalil, Craig): row i is
//! `Rx(alpha) Tx(a) Rz(theta) Tz(d)`, its z axis the joint's.
//!
//! In the posture q = 0 each axis is a line. From line to line leads a common normal: its foot and
//! direction on one line are the origin and the x axis of that line's frame. Where lines are
//! parallel there are many normals, and where they coincide there is none: then the frame before is
//! kept as it is. Of the two directions of a normal the one that turns theta less is taken.
//!
//! Where lines are parallel but for an error of assembly their one normal is anywhere, and metres away. There the
//! row has Hayati's parameter beta, `Rx(alpha) Ry(beta) Tx(a)`: it leads from the frame before to the point of
//! the next line that is nearest to it.

use core::f64::consts::PI;

use super::chain::Chain;
use crate::robot::space::{Frame, Vector, cross, dot, norm, plus, times};

/// Below this sine two axes are parallel: products of a few dozen rotations round to less.
const PARALLEL: f64 = 1e-12;

/// Below this, m (relative to the arm's size where that is larger), two lines meet.
const MEET: f64 = 1e-13;

/// Below this sine axes are meant to be parallel, as a diagnosis has it, which offers beta there.
const NEARLY: f64 = 0.01;

/// Below this sine, of 30°, axes may meet farther away than twice the length of the arm when stretched, which no
/// table of a designed arm has.
const ACUTE: f64 = 0.5;

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
    /// About y, behind alpha.
    pub beta: f64,
}

/// The chain as a table.
#[derive(Clone, Debug)]
pub struct Table {
    /// One per joint.
    pub rows: Vec<Row>,
    /// The table's base frame in the URDF's: the same where the first row can place axis 1 in it, else on axis 1.
    pub base: Frame,
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
    /// On the one, turned and moved by the theta and d of its row.
    foot: Foot,
    /// On the next.
    next: Foot,
    a: f64,
    alpha: f64,
    beta: f64,
}

impl Table {
    /// Of a chain.
    pub fn new(chain: &Chain) -> Table {
        let (mut lines, tip) = lines(chain);
        let size = lines.iter().map(|line| norm(line.point)).fold(1.0, f64::max);
        let steps = chain.steps.iter().map(|step| norm(step.before.origin)).sum::<f64>();
        let far = (steps + norm(chain.end.origin)) / ACUTE;
        let way = |at: &Foot, here: &Line, next: &Line| normal(at, here, next, (MEET * size, far));
        let mut at = Foot { origin: [0.0; 3], x: [1.0, 0.0, 0.0] };
        let first = way(&at, &lines[0], &lines[1]);
        let lead = screw(&at, &first.foot, &lines[0]);
        let mut base = Frame::IDENTITY;
        if first.beta != 0.0 || lead.iter().any(|x| x.abs() > PARALLEL) {
            let along = lines[1].along;
            let across = |v: Vector| plus(v, -dot(along, v), along);
            let x = across(at.x);
            // Where axis 1 lies along x, z is across it.
            let x = if norm(x) > NEARLY { x } else { across(lines[0].along) };
            let foot = beside(at.origin, &lines[1]);
            at = Foot { origin: foot, x: times(x, 1.0 / norm(x)) };
            lines[0] = Line { point: foot, ..lines[1] };
            base = at.frame(&lines[0]);
        }
        let mut rows: Vec<Row> = Vec::new();
        let mut frames = Vec::new();
        for k in 0..lines.len() {
            let here = lines[k];
            let normal = match lines.get(k + 1) {
                Some(next) => way(&at, &here, next),
                None => last(&at, &here, &tip),
            };
            if let Some(row) = rows.last_mut() {
                [row.theta, row.d] = screw(&at, &normal.foot, &here);
                frames.push(normal.foot.frame(&here));
            }
            if k + 1 < lines.len() {
                let Normal { a, alpha, beta, .. } = normal;
                rows.push(Row { a, alpha, beta, ..Row::default() });
            }
            at = normal.next;
        }
        let tool = frames.last().map_or(tip, |last| last.inverse().then(&tip));
        Table { rows, base, frames, tool }
    }
}

/// The point of a line that is nearest to one.
fn beside(point: Vector, line: &Line) -> Vector {
    plus(line.point, dot(line.along, plus(point, -1.0, line.point)), line.along)
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

/// The way between two lines; `at` is the frame that came to the first.
fn normal(at: &Foot, here: &Line, next: &Line, (meet, far): (f64, f64)) -> Normal {
    let (z, next_z) = (here.along, next.along);
    let cross_z = cross(z, next_z);
    let sine = norm(cross_z);
    if sine <= PARALLEL {
        let alpha = if dot(z, next_z) > 0.0 { 0.0 } else { PI };
        let between = plus(next.point, -1.0, at.origin);
        let across = plus(between, -dot(z, between), z);
        let distance = norm(across);
        if distance <= meet {
            return Normal { foot: *at, next: *at, a: 0.0, alpha, beta: 0.0 };
        }
        let x = facing(times(across, 1.0 / distance), at.x);
        return Normal::along(Foot { origin: at.origin, x }, dot(across, x), alpha);
    }
    let between = plus(next.point, -1.0, here.point);
    let along = dot(cross(between, next_z), cross_z) / (sine * sine);
    let origin = plus(here.point, along, z);
    let is_far = sine < ACUTE && norm(plus(origin, -1.0, at.origin)) > far;
    if sine < NEARLY || is_far {
        return tilted(at, here, next, meet);
    }
    let x = facing(times(cross_z, 1.0 / sine), at.x);
    let a = dot(between, x);
    let a = if a.abs() <= meet { 0.0 } else { a };
    let alpha = dot(x, cross_z).atan2(dot(z, next_z));
    Normal::along(Foot { origin, x }, a, alpha)
}

/// The way to the point of the next line that is nearest to the frame's origin: where it lies, and how the line
/// leans, are theta, alpha, beta and a.
fn tilted(at: &Foot, here: &Line, next: &Line, meet: f64) -> Normal {
    let (z, next_z) = (here.along, next.along);
    let origin = beside(at.origin, next);
    let across = plus(origin, -1.0, at.origin);
    let distance = norm(across);
    let level = |v: Vector| {
        let v = plus(v, -dot(next_z, v), next_z);
        times(v, 1.0 / norm(v))
    };
    let next_x = match distance <= meet {
        true => level(at.x),
        false => level(facing(times(across, 1.0 / distance), at.x)),
    };
    // Turned about this, y behind alpha, the x of the row before becomes the next one.
    let y = cross(next_z, next_x);
    let x = cross(y, z);
    let x = facing(times(x, 1.0 / norm(x)), next_x);
    Normal {
        foot: Foot { origin: at.origin, x },
        next: Foot { origin, x: next_x },
        a: if distance <= meet { 0.0 } else { dot(across, next_x) },
        alpha: dot(y, z).atan2(dot(y, cross(z, x))),
        beta: dot(next_z, x).atan2(dot(next_x, x)),
    }
}

impl Normal {
    /// Along x.
    fn along(foot: Foot, a: f64, alpha: f64) -> Normal {
        let next = Foot { origin: plus(foot.origin, a, foot.x), ..foot };
        Normal { foot, next, a, alpha, beta: 0.0 }
    }
}

/// The direction or its opposite, whichever is nearer to `x`.
fn facing(direction: Vector, x: Vector) -> Vector {
    if dot(direction, x) < -1e-9 { times(direction, -1.0) } else { direction }
}

/// On the last line: beside the tip, and where the tip's z is the line's, with its x.
fn last(at: &Foot, here: &Line, tip: &Frame) -> Normal {
    let z = here.along;
    let origin = plus(at.origin, dot(z, plus(tip.origin, -1.0, at.origin)), z);
    let [tip_x, _, tip_z] = tip.axes;
    let same = norm(cross(z, tip_z)) <= PARALLEL && dot(z, tip_z) > 0.0;
    Normal::along(Foot { origin, x: if same { tip_x } else { at.x } }, 0.0, 0.0)
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
