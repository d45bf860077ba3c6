//! What the instrument shows of the arm: frames, drift, slips, scale, noise.

use nalgebra::{Matrix3, Matrix4, Vector3, Vector6};

use super::assemble::Situation;
use super::balance::{Unstable, rest};
use super::campaign::Instrument;
use super::noise::Noise;
use super::reading::direction;
use super::reality::{Jump, Reality};
use super::transform::{carried, displaced, rotation, rotation_of, rotation_vector};
use crate::instrument::{Lens, View};
use crate::measurement::{Kind, Row};
use crate::rng::{Rng, Stream};

/// Frames that nobody knows.
#[derive(Clone, Debug, PartialEq)]
pub struct Frames {
    /// The robot's base in the measuring frame.
    pub base: nalgebra::Isometry3<f64>,
    /// The measured tool frame in the robot file's tool frame.
    pub tool: nalgebra::Isometry3<f64>,
}

impl Default for Frames {
    fn default() -> Self {
        Frames { base: nalgebra::Isometry3::identity(), tool: nalgebra::Isometry3::identity() }
    }
}

impl Frames {
    /// Frames that are nowhere near the robot file's: the base up to two metres off and turned any
    /// way, the tool up to a hand's breadth.
    pub fn unknown(seed: u64) -> Frames {
        let mut rng = Rng::new(seed, Stream::Frames);
        let mut draw = |reach: f64| {
            let place = reach * Vector3::from_fn(|_, _| rng.between(-1.0, 1.0));
            nalgebra::Isometry3::new(place, rng.between(0.5, 3.0) * rng.direction())
        };
        Frames { base: draw(2.0), tool: draw(0.1) }
    }
}

/// Position and orientation, or the difference of two.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shown {
    pub(super) position: Vector3<f64>,
    pub(super) rotation: Matrix3<f64>,
}

impl Shown {
    /// Out of what a file has.
    pub(super) fn of(vector: &Vector6<f64>) -> Shown {
        Shown {
            position: Vector3::new(vector[0], vector[1], vector[2]),
            rotation: rotation_of(&Vector3::new(vector[3], vector[4], vector[5])),
        }
    }

    /// As a file has it.
    pub(super) fn vector(&self) -> Vector6<f64> {
        let (p, r) = (self.position, rotation_vector(&self.rotation));
        Vector6::new(p.x, p.y, p.z, r.x, r.y, r.z)
    }

    fn less(&self, other: &Shown) -> Shown {
        Shown {
            position: self.position - other.position,
            rotation: self.rotation * other.rotation.transpose(),
        }
    }

    /// What the row's instrument reads, if it is no tracker.
    fn by(self, row: &Row) -> Shown {
        let Some(aim) = row.aim.as_deref() else { return self };
        let p = self.position;
        let one = |reading| Vector3::new(reading, 0.0, 0.0);
        let two = |first, second| Shown {
            position: Vector3::zeros(),
            rotation: rotation_of(&Vector3::new(first, second, 0.0)),
        };
        let position = match &aim.view {
            View::Point(at) => p - at,
            View::Distance { from, offset } => {
                let [x, y, z] = [p.x - from.x, p.y - from.y, p.z - from.z];
                one((x * x + y * y + z * z).sqrt() + offset)
            }
            View::Plane(plane) => {
                let n = plane.normal;
                one(n.x * p.x + n.y * p.y + n.z * p.z - plane.offset())
            }
            View::Direction { along: n, offset } => one(n.x * p.x + n.y * p.y + n.z * p.z + offset),
            View::Level([x, y]) => {
                // The last row has how much each axis rises.
                let rises = |k: usize| self.rotation[(2, k)].clamp(-1.0, 1.0).asin();
                return two(rises(0) + x, rises(1) + y);
            }
            View::Camera { lens, target } => {
                let before = match target {
                    None => p,
                    Some(target) => self.rotation.transpose() * (target - p),
                };
                let [u, v] = shown_by(lens, [before.x, before.y, before.z]);
                return two(u / lens.focus, v / lens.focus);
            }
        };
        Shown { position, rotation: Matrix3::identity() }
    }

    pub(super) fn noisy(mut self, noise: Noise, rng: &mut Rng) -> Shown {
        self.position += noise.position * rng.normal3();
        self.rotation = rotation_of(&(noise.rotation * rng.normal3())) * self.rotation;
        self
    }

    pub(super) fn by_instrument(mut self, instrument: Instrument, rng: &mut Rng) -> Shown {
        let Instrument { scale, freedom, wrong, wrong_by } = instrument;
        let mut three = |scale: f64| scale * Vector3::from_fn(|_, _| rng.student(freedom));
        let (moved, turned) = (three(scale.position), three(scale.rotation));
        self.position += moved;
        self.rotation = rotation_of(&turned) * self.rotation;
        if rng.unit() < wrong { self.noisy(wrong_by, rng) } else { self }
    }

    /// From here towards `other`, part of the way.
    pub(super) fn towards(&self, other: &Shown, part: f64) -> Shown {
        let turn = rotation_vector(&(other.rotation * self.rotation.transpose()));
        Shown {
            position: self.position + part * (other.position - self.position),
            rotation: rotation_of(&(part * turn)) * self.rotation,
        }
    }
}

/// A place in a camera's axes in its picture, px, as OpenCV documents its model term by term.
fn shown_by(lens: &Lens, [x, y, z]: [f64; 3]) -> [f64; 2] {
    let [fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6] =
        core::array::from_fn(|k| lens.constant(k));
    let (a, b) = (x / z, y / z);
    let r = (a * a + b * b).sqrt();
    let radial = (1.0 + k1 * r.powi(2) + k2 * r.powi(4) + k3 * r.powi(6))
        / (1.0 + k4 * r.powi(2) + k5 * r.powi(4) + k6 * r.powi(6));
    let across = a * radial + 2.0 * p1 * a * b + p2 * (r.powi(2) + 2.0 * a.powi(2));
    let down = b * radial + p1 * (r.powi(2) + 2.0 * b.powi(2)) + 2.0 * p2 * a * b;
    [fx * across + cx, fy * down + cy]
}

/// A row among the rows: what came before counts.
#[derive(Clone, Copy)]
pub(super) struct InOrder<'a> {
    pub(super) row: &'a Row,
    /// From 1.
    pub(super) number: usize,
    pub(super) all: &'a [Row],
    /// The rows of its session, numbers from 1.
    pub(super) session: (usize, usize),
}

impl InOrder<'_> {
    /// The rows of its session.
    pub(super) fn sitting(&self) -> &[Row] {
        &self.all[self.session.0 - 1..self.session.1]
    }

    /// The row before it, in its session.
    pub(super) fn before(&self) -> Option<&Row> {
        (self.number > self.session.0).then(|| &self.all[self.number - 2])
    }

    /// Seconds since the first row of its session; rows where there is no time.
    fn elapsed(&self) -> f64 {
        match (self.row.time, self.sitting()[0].time) {
            (Some(now), Some(then)) => now - then,
            _ => (self.number - self.session.0) as f64,
        }
    }

    /// Whether it comes after a jump in its session.
    fn follows(&self, slip: &Jump) -> bool {
        self.number > slip.after && slip.after + 1 >= self.session.0
    }

    /// Kelvin above the first row; 0 where there is no temperature.
    pub(super) fn warmth(&self) -> f64 {
        match (self.row.temperature, self.all[0].temperature) {
            (Some(now), Some(then)) => now - then,
            _ => 0.0,
        }
    }
}

impl Reality {
    fn situation(&self, at: InOrder<'_>, wrench: &Vector6<f64>) -> Situation {
        let after = |slips: &[Jump]| {
            let over = slips.iter().filter(|slip| at.follows(slip));
            over.map(|slip| slip.by).sum::<Vector6<f64>>()
        };
        Situation {
            values: self.joint_values(at),
            directions: (0..self.joints.len()).map(|j| direction(at.row, j)).collect(),
            growth: 1.0 + self.expansion * at.warmth(),
            tool_frame: self.tool_frame + after(&self.tool_slips),
            wrench: (1.0 + self.wrench_scale) * self.hanging(wrench),
        }
    }

    /// The load with gravity where it is. What pulls along the robot file's gravity hangs: from a
    /// point as high as the tool's origin, straight down.
    fn hanging(&self, wrench: &Vector6<f64>) -> Vector6<f64> {
        let force = Vector3::new(wrench[0], wrench[1], wrench[2]);
        let couple = Vector3::new(wrench[3], wrench[4], wrench[5]);
        let turn = rotation_of(&self.tilt);
        let down = turn.tr_mul(&self.gravity);
        let size = force.norm();
        if size == 0.0 || down.norm() == 0.0 || (force / size - down.normalize()).norm() > 1e-5 {
            return *wrench;
        }
        let hook = down.normalize().cross(&couple) / size;
        let pull = size * self.gravity.normalize();
        let couple = couple + hook.cross(&pull) - hook.cross(&force);
        Vector6::new(pull.x, pull.y, pull.z, couple.x, couple.y, couple.z)
    }

    /// The arm's base in the measuring frame; its small displacements add up.
    fn standing(&self, at: InOrder<'_>, frames: &Frames) -> Matrix4<f64> {
        let over = self.base_slips.iter().filter(|slip| at.follows(slip));
        let slipped: Vector6<f64> = over.map(|slip| slip.by).sum();
        let all = self.base_frame + slipped + at.elapsed() * self.drift;
        let first =
            at.row.camera.as_ref().map_or_else(Matrix4::identity, |s| s.first.to_homogeneous());
        frames.base.to_homogeneous() * first * self.base * displaced(&all)
    }

    fn seen(&self, standing: &Matrix4<f64>, tool: &Matrix4<f64>, row: &Row) -> Shown {
        let sits =
            row.camera.as_ref().map_or_else(Matrix4::identity, |sight| sight.at.to_homogeneous());
        let frame = standing * tool * sits;
        // A marker whose place is not known sits where the tool frame does.
        let offset = Vector3::from(row.offset.unwrap_or([0.0; 3]));
        Shown {
            position: (1.0 + self.instrument_scale) * carried(&frame, &offset),
            rotation: rotation(&frame),
        }
    }

    /// What a noiseless instrument shows.
    pub(super) fn shown(
        &self,
        at: InOrder<'_>,
        kind: Kind,
        frames: &Frames,
    ) -> Result<Shown, Unstable> {
        let mount = frames.tool.to_homogeneous();
        let standing = self.standing(at, frames);
        let under = |wrench: &Vector6<f64>| {
            let chain = self.chain(&self.situation(at, wrench), &mount);
            let tool = chain.shape(&rest(&chain)?).tool;
            Ok(self.seen(&standing, &tool, at.row))
        };
        let loaded: Shown = under(&at.row.wrench)?;
        match kind {
            Kind::Displacement { .. } => Ok(loaded.less(&under(&Vector6::zeros())?)),
            Kind::Distance | Kind::Bench { .. } => Ok(loaded.by(at.row)),
            Kind::Pose { .. } | Kind::Coordinates { .. } => Ok(loaded),
        }
    }

    /// What a sim of first order predicts: the loads are those of the undeformed arm, and move it
    /// by `J C Jᵀ w` and the links' bending alone.
    pub(super) fn first_order(&self, at: InOrder<'_>, kind: Kind) -> Shown {
        let mount = Matrix4::identity();
        let standing = self.standing(at, &Frames::default());
        let under = |wrench: &Vector6<f64>| {
            let chain = self.chain(&self.situation(at, wrench), &mount);
            let straight = vec![0.0; chain.unknowns];
            let yielded = chain.wanted(&straight);
            let twist = chain.first_order_twist(&yielded);
            let mut tool = chain.shape(&straight).tool;
            let turned = rotation_of(&Vector3::new(twist[3], twist[4], twist[5])) * rotation(&tool);
            tool.fixed_view_mut::<3, 3>(0, 0).copy_from(&turned);
            for k in 0..3 {
                tool[(k, 3)] += twist[k];
            }
            self.seen(&standing, &tool, at.row)
        };
        let loaded = under(&at.row.wrench);
        match kind {
            Kind::Displacement { .. } => loaded.less(&under(&Vector6::zeros())),
            Kind::Distance | Kind::Bench { .. } => loaded.by(at.row),
            Kind::Pose { .. } | Kind::Coordinates { .. } => loaded,
        }
    }
}
