//! A file without some mistakes, exactly: every frame where it fits best, and the ordinary unknowns of an
//! arm, its joints' zeros and springs, about what the file says of them.
//!
//! ```text
//! p_k = B_s · T(q_k + δ + c ∘ τ_k) · o_m
//! ```
//!
//! The base B of each session and the point o of each marker in a session (with the tool's orientation where that
//! is measured) begin where closed forms put them (Kabsch; a mean), each exact where the other is. Then all
//! are refined by least squares with weights of Cauchy's form, for some rows are just wrong.

use nalgebra::{
    DMatrix, DVector, Isometry3, Matrix3, Point3, Rotation3, UnitQuaternion, Vector3, Vector6,
};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{self, Arm, Convention};

use super::kind::Mistake;
use super::rows::Rows;
use crate::diagnose::rigid;
use crate::doubts::reach;

/// Prior scale of a joint's zero, rad (m): marks and masters are good to some mrad.
const ZERO: f64 = 0.01;

/// Prior scale of the logarithm of a spring that the file has: published and identified stiffnesses of one
/// joint differ by half of it.
const SPRING: f64 = 0.5;

/// The same of a spring that the file has not, about [`SOFTNESS`].
const NO_SPRING: f64 = 2.0;

/// Compliance of a joint times the cube of the reach, 1/Pa: arms with published springs, from the iiwa
/// (1.5e4 N·m/rad at 1.3 m) to the KR 240 (3.8e6 at 3 m), lie within a factor of five.
const SOFTNESS: f64 = 3e-5;

/// Part of the rows, those that fit best, by which what is left is judged.
const KEPT: f64 = 0.75;

/// Turns of the closed forms, and steps of the least squares.
const TURNS: usize = 12;
const STEPS: usize = 12;

/// Part of the cost, and of the scale, that a step leaves where the fit is at its end.
const SETTLED: f64 = 0.999;

/// What is left of the gap.
#[derive(Clone, Copy, Debug)]
pub(super) struct Left {
    /// Root mean square of those rows that fit best, m; a rotation counts by a lever.
    pub size: f64,
    /// How far zeros and springs went from what the file says, in squares of their prior scales.
    pub strain: f64,
    /// Root mean square of all rows, positions (m) and rotations (rad).
    pub position: f64,
    pub rotation: f64,
    /// Rows that were fitted, less those whose joint was free.
    pub rows: f64,
    /// How far the base turned from where the file has it, rad.
    pub turned: f64,
}

/// One row.
struct Row {
    q: Vec<f64>,
    torque: Vec<f64>,
    at: Vector3<f64>,
    turn: UnitQuaternion<f64>,
    session: usize,
    point: usize,
    /// The joint whose reading is not known.
    free: Option<usize>,
}

/// A file without some mistakes, and its unknowns.
pub(super) struct Fit {
    arm: Arm,
    rows: Vec<Row>,
    has_rotation: bool,
    /// m per rad: what a rotation counts.
    lever: f64,
    is_loaded: bool,
    bases: Vec<Isometry3<f64>>,
    points: Vec<Vector3<f64>>,
    tools: Vec<UnitQuaternion<f64>>,
    zeros: Vec<f64>,
    springs: Vec<f64>,
    /// Compliances at which `springs` is zero, and the prior scales of their logarithms.
    soft: Vec<(f64, f64)>,
    first_base: UnitQuaternion<f64>,
}

/// The gap of a row: at the point, and of the rotation.
type Gap = (Vector3<f64>, Vector3<f64>);

impl Fit {
    /// Of `chosen` rows without `mistakes`, `arm` being the one without them; `lever` is what a rotation
    /// counts, m. The springs give only if it is `loaded`. `None` where numbers are no place of an arm.
    pub(super) fn new(
        all: &Rows<'_>,
        chosen: &[usize],
        mistakes: &[Mistake],
        arm: &Arm,
        lever: f64,
        loaded: bool,
    ) -> Option<Fit> {
        let first_base = arm.base.rotation;
        let mut arm = arm.clone();
        let is_heavy = |joint: &generic::Joint| joint.mass != 0.0 || joint.beam.is_some();
        let has_mass = loaded && arm.joints.iter().any(is_heavy);
        let down = arm.gravity;
        arm.base = Isometry3::identity();
        let mut rows = Vec::with_capacity(chosen.len());
        let mut is_loaded = has_mass && down != Vector3::zeros();
        for &number in chosen {
            let Some(told) = all.told(number, mistakes) else { continue };
            let free = mistakes.iter().find_map(|mistake| match mistake {
                Mistake::Stuck { joint, from } => (number >= *from).then_some(*joint),
                _ => None,
            });
            let measured = told.measured;
            if !told.q.iter().chain(&measured).chain(&told.wrench).all(|x| x.abs() < 1e9) {
                return None;
            }
            let mut torque = vec![0.0; arm.dof()];
            if has_mass {
                torque.copy_from_slice(arm.weight_torque(&told.q).as_slice());
            }
            if loaded && told.wrench.amax() > 0.0 {
                is_loaded = true;
                let own = arm.joint_torque(&told.q, &told.wrench);
                torque.iter_mut().zip(&own).for_each(|(sum, own)| *sum += own);
            }
            rows.push(Row {
                torque,
                at: measured.fixed_rows::<3>(0).into_owned(),
                turn: UnitQuaternion::from_scaled_axis(measured.fixed_rows::<3>(3).into_owned()),
                session: all.session_of[number],
                point: all.point_of[number],
                free,
                q: told.q,
            });
        }
        let has_rotation = all.data.kind.components()[3];
        let reach = reach(&arm).max(1e-3);
        let soft = arm.joints.iter().map(|joint| match joint.compliance {
            0.0 => (SOFTNESS / reach.powi(3), NO_SPRING),
            file => (file, SPRING),
        });
        Some(Fit {
            has_rotation,
            lever: if has_rotation { lever } else { 0.0 },
            is_loaded,
            bases: vec![Isometry3::identity(); all.sessions],
            points: all.points.iter().map(|point| Vector3::from(*point)).collect(),
            tools: vec![UnitQuaternion::identity(); all.sessions],
            zeros: vec![0.0; arm.dof()],
            springs: vec![0.0; arm.dof()],
            soft: soft.collect(),
            first_base,
            rows,
            arm,
        })
    }

    /// With the frames alone in closed form.
    pub(super) fn framed(mut self, turns: usize) -> Left {
        self.align(turns);
        let gaps = self.gaps();
        self.left(&gaps)
    }

    /// With all unknowns.
    pub(super) fn refined(mut self) -> Left {
        self.align(TURNS);
        let mut gaps = self.gaps();
        let mut damping = 1e-6;
        for _ in 0..STEPS {
            let scale = self.scale(&gaps);
            let cost = self.cost(&gaps, scale);
            let Some(step) = self.step(&gaps, scale, damping) else { break };
            let before = self.unknowns();
            self.advance(&step);
            self.free_joints();
            let next = self.gaps();
            let after = self.cost(&next, scale);
            if after.is_finite() && after < cost {
                (gaps, damping) = (next, damping * 0.1);
                if after > SETTLED * cost && self.scale(&gaps) > SETTLED * scale {
                    break;
                }
            } else {
                self.restore(before);
                damping = (damping * 100.0).max(1e-4);
            }
        }
        self.left(&gaps)
    }

    fn compliance(&self, joint: usize) -> f64 {
        let (soft, scale) = self.soft[joint];
        // A file's own spring is there; another one is as far as the data want it.
        if scale == NO_SPRING {
            soft * self.springs[joint]
        } else {
            soft * self.springs[joint].exp()
        }
    }

    /// The joints' values in a row as the springs give.
    fn joints(&self, row: &Row) -> Vec<f64> {
        let each = row.q.iter().zip(&row.torque).enumerate();
        let gives =
            |j: usize, torque: f64| if self.is_loaded { self.compliance(j) * torque } else { 0.0 };
        each.map(|(j, (q, torque))| q + self.zeros[j] + gives(j, *torque)).collect()
    }

    /// Frames, each exact where the others are.
    fn align(&mut self, turns: usize) {
        let poses: Vec<Isometry3<f64>> =
            self.rows.iter().map(|row| self.arm.pose(&self.joints(row))).collect();
        let free = self.rows.iter().any(|row| row.free.is_some());
        let mut poses = poses;
        for turn in 0..turns {
            for session in 0..self.bases.len() {
                // Rows whose joint is free come in when the others have told where the base is.
                let of = |(row, _): &(&Row, &Isometry3<f64>)| {
                    row.session == session && (turn > 0 || row.free.is_none())
                };
                let pairs = self.rows.iter().zip(&poses).filter(of);
                let (from, to): (Vec<_>, Vec<_>) = pairs
                    .map(|(row, pose)| {
                        ((pose * Point3::from(self.points[row.point])).coords, row.at)
                    })
                    .unzip();
                if from.len() >= 3 {
                    self.bases[session] = rigid(&from, &to);
                }
            }
            let mut sums = vec![(Vector3::zeros(), 0.0); self.points.len()];
            for (row, pose) in self.rows.iter().zip(&poses) {
                let at = self.bases[row.session].inverse() * Point3::from(row.at);
                let sum = &mut sums[row.point];
                *sum = (sum.0 + (pose.inverse() * at).coords, sum.1 + 1.0);
            }
            for (point, (sum, rows)) in self.points.iter_mut().zip(sums) {
                if rows > 0.0 {
                    *point = sum / rows;
                }
            }
            if free {
                self.free_joints();
                poses = self.rows.iter().map(|row| self.arm.pose(&self.joints(row))).collect();
            }
        }
        if self.has_rotation {
            let mut sums = vec![Matrix3::zeros(); self.tools.len()];
            for (row, pose) in self.rows.iter().zip(&poses) {
                let turn = (self.bases[row.session].rotation * pose.rotation).inverse() * row.turn;
                sums[row.session] += turn.to_rotation_matrix().matrix();
            }
            for (tool, sum) in self.tools.iter_mut().zip(sums) {
                let mean = Rotation3::from_matrix_eps(&sum, 1e-9, 30, Rotation3::identity());
                *tool = UnitQuaternion::from_rotation_matrix(&mean);
            }
        }
    }

    /// Turns each free joint to where its row's point is nearest to what was measured: on a circle the
    /// nearest point lies in the same direction from the axis.
    fn free_joints(&mut self) {
        for number in 0..self.rows.len() {
            let Some(joint) = self.rows[number].free else { continue };
            let row = &self.rows[number];
            let (axes, pose) = self.axes(&self.joints(row));
            let (along, origin) = axes[joint];
            let is = (pose * Point3::from(self.points[row.point])).coords - origin;
            let to = (self.bases[row.session].inverse() * Point3::from(row.at)).coords - origin;
            let by = match self.arm.joints[joint].motion {
                Motion::Revolute => {
                    let flat = |v: Vector3<f64>| v - along * along.dot(&v);
                    let (is, to) = (flat(is), flat(to));
                    along.dot(&is.cross(&to)).atan2(is.dot(&to))
                }
                Motion::Prismatic => along.dot(&(to - is)),
            };
            if by.is_finite() {
                self.rows[number].q[joint] += by;
            }
        }
    }

    /// Axis and a point on it of every joint, and the tool, base frame.
    fn axes(&self, q: &[f64]) -> (Vec<(Vector3<f64>, Vector3<f64>)>, Isometry3<f64>) {
        let frames = self.arm.frames(q);
        let first = usize::from(self.arm.convention == Convention::Modified);
        let axis =
            |frame: &Isometry3<f64>| (frame.rotation * Vector3::z(), frame.translation.vector);
        let axes = frames[first..][..self.arm.dof()].iter().map(axis).collect();
        (axes, frames[self.arm.dof()] * self.arm.tool)
    }

    fn gaps(&self) -> Vec<Gap> {
        let gap = |row: &Row| {
            let pose = self.arm.pose(&self.joints(row));
            let base = &self.bases[row.session];
            let at = base * pose * Point3::from(self.points[row.point]);
            let turned = base.rotation * pose.rotation * self.tools[row.session];
            let turn = match self.has_rotation {
                true => (row.turn * turned.inverse()).scaled_axis(),
                false => Vector3::zeros(),
            };
            (row.at - at.coords, turn)
        };
        self.rows.iter().map(gap).collect()
    }

    fn size(&self, gap: &Gap) -> f64 {
        gap.0.norm().hypot(self.lever * gap.1.norm())
    }

    /// Root mean square of the rows that fit best.
    fn scale(&self, gaps: &[Gap]) -> f64 {
        let mut sizes: Vec<f64> = gaps.iter().map(|gap| self.size(gap)).collect();
        sizes.sort_by(f64::total_cmp);
        sizes.truncate(((KEPT * sizes.len() as f64).ceil() as usize).max(1));
        crate::gap::rms(&sizes).max(1e-9)
    }

    /// Of Cauchy's form, with the priors.
    fn cost(&self, gaps: &[Gap], scale: f64) -> f64 {
        let of_gap = |gap: &Gap| (self.size(gap) / scale).powi(2);
        let rows = gaps.iter().map(|gap| FLAT * (of_gap(gap) / FLAT).ln_1p()).sum::<f64>();
        rows + self.strain()
    }

    /// Squares of zeros and springs in their prior scales.
    fn strain(&self) -> f64 {
        let zeros = self.zeros.iter().map(|zero| (zero / ZERO).powi(2)).sum::<f64>();
        let springs = self.springs.iter().zip(&self.soft);
        zeros + springs.map(|(by, (_, scale))| (by / scale).powi(2)).sum::<f64>()
    }

    fn left(&self, gaps: &[Gap]) -> Left {
        let of =
            |part: fn(&Gap) -> f64| crate::gap::rms(&gaps.iter().map(part).collect::<Vec<_>>());
        let free = self.rows.iter().filter(|row| row.free.is_some()).count() as f64;
        let part = if self.has_rotation { 6.0 } else { 3.0 };
        let turned =
            self.bases.first().map_or(0.0, |base| base.rotation.angle_to(&self.first_base));
        let size = self.scale(gaps);
        Left {
            size: if size.is_finite() { size } else { f64::INFINITY },
            strain: self.strain(),
            position: of(|gap| gap.0.norm()),
            rotation: of(|gap| gap.1.norm()),
            rows: self.rows.len() as f64 - free / part,
            turned,
        }
    }

    /// Number of unknowns of frames and points.
    fn frames(&self) -> [usize; 3] {
        let bases = 6 * self.bases.len();
        let points = bases + 3 * self.points.len();
        [bases, points, points + if self.has_rotation { 3 * self.tools.len() } else { 0 }]
    }

    /// A step of least squares.
    fn step(&self, gaps: &[Gap], scale: f64, damping: f64) -> Option<DVector<f64>> {
        let (dof, [bases, points, tools]) = (self.arm.dof(), self.frames());
        let count = tools + dof * if self.is_loaded { 2 } else { 1 };
        let (mut normal, mut right) = (DMatrix::zeros(count, count), DVector::zeros(count));
        let mut columns: Vec<(usize, Vector6<f64>)> = Vec::new();
        for (row, gap) in self.rows.iter().zip(gaps) {
            let q = self.joints(row);
            let (axes, pose) = self.axes(&q);
            let base = &self.bases[row.session];
            let turn = base.rotation * pose.rotation;
            let at = (pose * Point3::from(self.points[row.point])).coords;
            let out = base.rotation * at;
            columns.clear();
            for k in 0..3 {
                let axis = Vector3::ith(k, 1.0);
                columns.push((6 * row.session + k, stacked(axis, Vector3::zeros())));
                columns.push((6 * row.session + 3 + k, stacked(axis.cross(&out), axis)));
                columns.push((bases + 3 * row.point + k, stacked(turn * axis, Vector3::zeros())));
                if self.has_rotation {
                    let about = turn * (self.tools[row.session] * axis);
                    columns.push((points + 3 * row.session + k, stacked(Vector3::zeros(), about)));
                }
            }
            for (j, (along, origin)) in axes.iter().enumerate() {
                let twist = match self.arm.joints[j].motion {
                    Motion::Revolute => stacked(along.cross(&(at - origin)), *along),
                    Motion::Prismatic => stacked(*along, Vector3::zeros()),
                };
                let twist = rotated(&base.rotation, &twist);
                columns.push((tools + j, twist));
                if self.is_loaded {
                    let (soft, scale) = self.soft[j];
                    let gives = if scale == NO_SPRING { soft } else { self.compliance(j) };
                    columns.push((tools + dof + j, twist * (gives * row.torque[j])));
                }
            }
            let mut gap = stacked(gap.0, gap.1);
            let weight =
                1.0 / (1.0 + (self.size(&(head(&gap), tail(&gap))) / scale).powi(2) / FLAT);
            for (_, column) in &mut columns {
                weighted(column, self.lever);
            }
            weighted(&mut gap, self.lever);
            if let Some(joint) = row.free {
                // What the free joint can take up tells nothing.
                let own = columns.iter().find(|(k, _)| *k == tools + joint).map(|(_, c)| *c);
                if let Some(own) = own.and_then(|own| own.try_normalize(1e-12)) {
                    columns.iter_mut().for_each(|(_, c)| *c -= own * own.dot(c));
                    gap -= own * own.dot(&gap);
                }
            }
            let weight = weight / (scale * scale);
            for (a, (i, one)) in columns.iter().enumerate() {
                right[*i] += weight * one.dot(&gap);
                for (j, other) in &columns[a..] {
                    let product = weight * one.dot(other);
                    normal[(*i, *j)] += product;
                    if i != j {
                        normal[(*j, *i)] += product;
                    }
                }
            }
        }
        for j in 0..dof {
            held(&mut normal, &mut right, tools + j, self.zeros[j], ZERO);
            if self.is_loaded {
                held(&mut normal, &mut right, tools + dof + j, self.springs[j], self.soft[j].1);
            }
        }
        for k in 0..count {
            normal[(k, k)] += damping * normal[(k, k)] + 1e-9 * normal[(0, 0)].max(1.0);
        }
        normal.cholesky().map(|factor| factor.solve(&right))
    }

    fn advance(&mut self, step: &DVector<f64>) {
        let (dof, [bases, points, tools]) = (self.arm.dof(), self.frames());
        let three = |at: usize| Vector3::new(step[at], step[at + 1], step[at + 2]);
        for (s, base) in self.bases.iter_mut().enumerate() {
            base.translation.vector += three(6 * s);
            base.rotation = UnitQuaternion::from_scaled_axis(three(6 * s + 3)) * base.rotation;
        }
        for (m, point) in self.points.iter_mut().enumerate() {
            *point += three(bases + 3 * m);
        }
        if self.has_rotation {
            for (s, tool) in self.tools.iter_mut().enumerate() {
                *tool *= UnitQuaternion::from_scaled_axis(three(points + 3 * s));
            }
        }
        for j in 0..dof {
            self.zeros[j] += step[tools + j];
            if self.is_loaded {
                let (now, most) = (&mut self.springs[j], step[tools + dof + j].clamp(-1.5, 1.5));
                *now += most;
                if self.soft[j].1 == NO_SPRING {
                    // A spring that the file has not is no softer than nothing.
                    *now = now.max(0.0);
                }
            }
        }
    }

    #[allow(clippy::type_complexity, reason = "all unknowns, kept for a step back")]
    fn unknowns(
        &self,
    ) -> (
        Vec<Isometry3<f64>>,
        Vec<Vector3<f64>>,
        Vec<UnitQuaternion<f64>>,
        Vec<f64>,
        Vec<f64>,
        Vec<f64>,
    ) {
        let free = self.rows.iter().filter_map(|row| row.free.map(|joint| row.q[joint])).collect();
        let (bases, points, tools) = (self.bases.clone(), self.points.clone(), self.tools.clone());
        (bases, points, tools, self.zeros.clone(), self.springs.clone(), free)
    }

    #[allow(clippy::type_complexity, reason = "as it was kept")]
    fn restore(
        &mut self,
        (bases, points, tools, zeros, springs, free): (
            Vec<Isometry3<f64>>,
            Vec<Vector3<f64>>,
            Vec<UnitQuaternion<f64>>,
            Vec<f64>,
            Vec<f64>,
            Vec<f64>,
        ),
    ) {
        (self.bases, self.points, self.tools) = (bases, points, tools);
        (self.zeros, self.springs) = (zeros, springs);
        let rows = self.rows.iter_mut().filter_map(|row| row.free.map(|j| &mut row.q[j]));
        rows.zip(free).for_each(|(now, was)| *now = was);
    }
}

/// Where Cauchy's weights are a half, in squares of the scale: nine of ten rows of a normal law weigh more.
const FLAT: f64 = 9.0;

fn stacked(shift: Vector3<f64>, turn: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z)
}

fn head(six: &Vector6<f64>) -> Vector3<f64> {
    six.fixed_rows::<3>(0).into_owned()
}

fn tail(six: &Vector6<f64>) -> Vector3<f64> {
    six.fixed_rows::<3>(3).into_owned()
}

fn rotated(by: &UnitQuaternion<f64>, twist: &Vector6<f64>) -> Vector6<f64> {
    stacked(by * head(twist), by * tail(twist))
}

/// Rotations by the lever that they count.
fn weighted(twist: &mut Vector6<f64>, lever: f64) {
    let mut turn = twist.fixed_rows_mut::<3>(3);
    turn *= lever;
}

/// Holds an unknown that is `now` to zero by its prior scale.
fn held(normal: &mut DMatrix<f64>, right: &mut DVector<f64>, at: usize, now: f64, scale: f64) {
    normal[(at, at)] += 1.0 / (scale * scale);
    right[at] -= now / (scale * scale);
}
