//! A file without some mistakes, exactly: every frame where it fits best, and the ordinary unknowns of an
//! arm, its joints' zeros and springs, about what the file says of them.
//!
//! ```text
//! p_k = B_s · T(q_k + δ + c ∘ τ_k) · o_m
//! ```
//!
//! Links that the file has as beams bend by what it says, to first order.
//!
//! The base B of each session and the point o of each marker in a session (with the tool's orientation where that
//! is measured) begin where closed forms put them (Kabsch; a mean), each exact where the other is. Then all
//! are refined by least squares with weights of Cauchy's form, for some rows are just wrong.

mod align;
mod open;
mod step;

use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3, Vector6};
use stiffarm_kernels::generic::{self, Arm, Convention};

use super::kind::Mistake;
use super::rows::Rows;
use crate::constants::{BEST_ROWS, NEARLY_ALL_ROWS};
use crate::doubts::reach;
use crate::gap::rms;
use crate::infer::ascending;
use crate::simulate::{rotation, translation};
use open::Open;

/// Prior scale of a joint's zero, rad (m): marks and masters are good to some mrad.
const ZERO: f64 = 0.01;

/// Prior scale of the logarithm of a spring that the file has: published and identified stiffnesses of one
/// joint differ by half of it.
const SPRING: f64 = 0.5;

/// Prior scale of a spring that the file has not, in units of [`SOFTNESS`]: small servos are ten times as soft.
const NO_SPRING: f64 = 10.0;

/// Compliance of a joint times the cube of the reach, 1/Pa: arms with published springs, from the iiwa
/// (1.5e4 N·m/rad at 1.3 m) to the KR 240 (3.8e6 at 3 m), lie within a factor of five.
const SOFTNESS: f64 = 3e-5;

/// Where Cauchy's weights are a half, in squares of the scale: nine of ten rows of a normal law weigh more.
const FLAT: f64 = 9.0;

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
    /// The same of [`NEARLY_ALL_ROWS`] rows.
    pub of_nearly_all: f64,
    /// How far zeros and springs went from what the file says, in squares of their prior scales.
    pub prior_penalty: f64,
    /// Root mean square of all rows, positions (m) and rotations (rad).
    pub position: f64,
    pub rotation: f64,
    /// Rows that were fitted.
    pub rows: f64,
    /// Part of what they say that is left beside joints whose reading is not known.
    pub told: f64,
    /// How far the base turned from where the file has it, rad.
    pub turned: f64,
}

/// One row.
struct Row {
    q: Vec<f64>,
    torque: Vec<f64>,
    /// By how much the links' bending shifts and turns the tool, base frame.
    bent: Option<(Vector3<f64>, UnitQuaternion<f64>)>,
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
    at: Unknowns,
    /// Whose amounts are fitted too.
    open: Vec<Open>,
    /// By which the prior scales of zeros and springs are multiplied.
    tight: f64,
    /// Part of the rows by which what is left is judged.
    kept: f64,
    /// Compliances at which `springs` is zero, and the prior scales of their logarithms.
    soft: Vec<(f64, f64)>,
    first_base: UnitQuaternion<f64>,
}

/// What is fitted.
#[derive(Clone)]
struct Unknowns {
    /// Of each session.
    bases: Vec<Isometry3<f64>>,
    /// Of each marker in a session, tool frame, m.
    points: Vec<Vector3<f64>>,
    /// The measured frame's orientation in the tool frame, of each session.
    tools: Vec<UnitQuaternion<f64>>,
    /// rad (m if prismatic).
    zeros: Vec<f64>,
    /// By which [`Fit::compliance`] is told.
    springs: Vec<f64>,
    /// By how much more each that is open is off.
    amounts: Vec<f64>,
    /// Of each row, what its joint turns by whose reading is not known, rad (m).
    turned: Vec<f64>,
}

/// The arm in a row as the springs give: the joints' values, the chain's frames and the tool, base frame.
struct Posture {
    q: Vec<f64>,
    frames: Vec<Isometry3<f64>>,
    tool: Isometry3<f64>,
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
        let has_beams = loaded && arm.joints.iter().any(|joint| joint.beam.is_some());
        let mut links = arm.clone();
        links.joints.iter_mut().for_each(|joint| joint.compliance = 0.0);
        let mut rows = Vec::with_capacity(chosen.len());
        let mut is_loaded = has_mass && down != Vector3::zeros();
        for &number in chosen {
            let Some(told) = all.told(number, mistakes) else { continue };
            let stuck = mistakes.iter().filter_map(|mistake| mistake.stuck());
            let free = stuck.into_iter().find(|(_, rows)| rows.contains(&number)).map(|(j, _)| j);
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
            let bent = || links.deflection_with_gravity(&told.q, &told.wrench).ok();
            let moved = |by: Vector6<f64>| (translation(&by), UnitQuaternion::new(rotation(&by)));
            let bent = has_beams.then(bent).flatten().map(moved);
            rows.push(Row {
                torque,
                bent,
                at: measured.fixed_rows::<3>(0).into_owned(),
                turn: UnitQuaternion::from_scaled_axis(measured.fixed_rows::<3>(3).into_owned()),
                session: all.frame_of[number],
                point: all.point_of[number],
                free,
                q: told.q,
            });
        }
        // Few rows fit anything.
        if 2 * rows.len() < chosen.len() {
            return None;
        }
        let has_rotation = all.data.kind.components()[3];
        let open = Open::all(mistakes, &mut arm);
        let reach = reach(&arm).max(1e-3);
        let soft = arm.joints.iter().map(|joint| match joint.compliance {
            0.0 => (SOFTNESS / reach.powi(3), NO_SPRING),
            file => (file, SPRING),
        });
        Some(Fit {
            has_rotation,
            lever: if has_rotation { lever } else { 0.0 },
            is_loaded,
            at: Unknowns {
                bases: vec![Isometry3::identity(); all.frames],
                points: all.points.iter().map(|point| Vector3::from(*point)).collect(),
                tools: vec![UnitQuaternion::identity(); all.frames],
                zeros: vec![0.0; arm.dof()],
                springs: vec![0.0; arm.dof()],
                amounts: vec![0.0; open.len()],
                turned: vec![0.0; rows.len()],
            },
            soft: soft.collect(),
            open,
            tight: 1.0,
            kept: BEST_ROWS,
            first_base,
            rows,
            arm,
        })
    }

    /// With the frames alone in closed form.
    pub(super) fn framed(mut self, turns: usize) -> Left {
        let postures = self.align(turns);
        self.left(&self.gaps(&postures))
    }

    /// Judged by this part of the rows, those that fit best.
    pub(super) fn kept(self, kept: f64) -> Fit {
        Fit { kept, ..self }
    }

    /// With zeros and springs as the file has them, but for this part of what is usual.
    pub(super) fn tightened(self, tight: f64) -> Fit {
        Fit { tight, ..self }
    }

    /// With all unknowns: what is left, and by how much more the open amounts are off.
    pub(super) fn refined(mut self) -> (Left, Vec<f64>) {
        let mut postures = self.align(TURNS);
        let mut gaps = self.gaps(&postures);
        let mut damping = 1e-6;
        for _ in 0..STEPS {
            let scale = self.scale(&gaps);
            let cost = self.cost(&gaps, scale);
            let Some(step) = self.step(&postures, &gaps, scale, damping) else {
                break;
            };
            let before = self.at.clone();
            self.advance(&step);
            self.free_joints();
            let moved = self.postures();
            let next = self.gaps(&moved);
            let after = self.cost(&next, scale);
            if after.is_finite() && after < cost {
                (postures, gaps, damping) = (moved, next, damping * 0.1);
                if after > SETTLED * cost && self.scale(&gaps) > SETTLED * scale {
                    break;
                }
            } else {
                self.at = before;
                self.put_amounts();
                damping = (damping * 100.0).max(1e-4);
            }
        }
        (self.left(&gaps), self.at.amounts)
    }

    fn compliance(&self, joint: usize) -> f64 {
        let (soft, scale) = self.soft[joint];
        // A file's own spring is there; another one is as far as the data want it.
        if scale == NO_SPRING {
            soft * self.at.springs[joint]
        } else {
            soft * self.at.springs[joint].exp()
        }
    }

    /// The joints' values in a row as the springs give.
    fn joints(&self, number: usize) -> Vec<f64> {
        let row = &self.rows[number];
        let gives =
            |j: usize| if self.is_loaded { self.compliance(j) * row.torque[j] } else { 0.0 };
        let each = row.q.iter().zip(&self.at.zeros).enumerate();
        let mut q: Vec<f64> = each.map(|(j, (q, zero))| q + zero + gives(j)).collect();
        self.add_readings(row, &mut q);
        if let Some(joint) = row.free {
            q[joint] += self.at.turned[number];
        }
        q
    }

    fn posture(&self, number: usize) -> Posture {
        let q = self.joints(number);
        let frames = self.arm.frames(&q);
        let mut tool = frames[self.arm.dof()] * self.arm.tool;
        if let Some((shift, turn)) = &self.rows[number].bent {
            tool.translation.vector += shift;
            tool.rotation = turn * tool.rotation;
        }
        Posture { q, frames, tool }
    }

    fn postures(&self) -> Vec<Posture> {
        (0..self.rows.len()).map(|number| self.posture(number)).collect()
    }

    /// Direction of a joint's axis, and a point on it, base frame.
    fn axis(&self, posture: &Posture, joint: usize) -> [Vector3<f64>; 2] {
        let first = usize::from(self.arm.convention == Convention::Modified);
        let frame = &posture.frames[first + joint];
        [frame.rotation * Vector3::z(), frame.translation.vector]
    }

    fn gaps(&self, postures: &[Posture]) -> Vec<Gap> {
        let gap = |(row, Posture { tool, .. }): (&Row, &Posture)| {
            let base = &self.at.bases[row.session];
            let at = base * (tool * Point3::from(self.at.points[row.point]));
            let turned = base.rotation * tool.rotation * self.at.tools[row.session];
            let turn = match self.has_rotation {
                true => (row.turn * turned.inverse()).scaled_axis(),
                false => Vector3::zeros(),
            };
            (row.at - at.coords, turn)
        };
        self.rows.iter().zip(postures).map(gap).collect()
    }

    fn size(&self, gap: &Gap) -> f64 {
        gap.0.norm().hypot(self.lever * gap.1.norm())
    }

    /// Root mean square of the rows that fit best.
    fn scale(&self, gaps: &[Gap]) -> f64 {
        best(BEST_ROWS, gaps.iter().map(|gap| self.size(gap)))
    }

    /// Of Cauchy's form, with the priors.
    fn cost(&self, gaps: &[Gap], scale: f64) -> f64 {
        let of_gap = |gap: &Gap| (self.size(gap) / scale).powi(2);
        let rows = gaps.iter().map(|gap| FLAT * (of_gap(gap) / FLAT).ln_1p()).sum::<f64>();
        rows + self.prior_penalty()
    }

    /// Squares of zeros and springs in their prior scales.
    fn prior_penalty(&self) -> f64 {
        let zeros = self.at.zeros.iter().map(|zero| (zero / ZERO).powi(2)).sum::<f64>();
        let springs = self.at.springs.iter().zip(&self.soft);
        let springs = springs.map(|(by, (_, scale))| (by / scale).powi(2)).sum::<f64>();
        (zeros + springs) / (self.tight * self.tight)
    }

    fn left(&self, gaps: &[Gap]) -> Left {
        let of = |part: fn(&Gap) -> f64| rms(&gaps.iter().map(part).collect::<Vec<_>>());
        let free = self.rows.iter().filter(|row| row.free.is_some()).count() as f64;
        let part = if self.has_rotation { 6.0 } else { 3.0 };
        let turned =
            self.at.bases.first().map_or(0.0, |base| base.rotation.angle_to(&self.first_base));
        let sizes = || gaps.iter().map(|gap| self.size(gap));
        Left {
            size: best(self.kept, sizes()),
            of_nearly_all: best(NEARLY_ALL_ROWS, sizes()),
            prior_penalty: self.prior_penalty(),
            position: of(|gap| gap.0.norm()),
            rotation: of(|gap| gap.1.norm()),
            rows: self.rows.len() as f64,
            told: 1.0 - free / (part * self.rows.len() as f64),
            turned,
        }
    }
}

/// Root mean square of a part of the sizes, the smallest; infinite where that is no number.
pub(super) fn best(part: f64, sizes: impl Iterator<Item = f64>) -> f64 {
    let mut sizes = ascending(sizes);
    sizes.truncate(((part * sizes.len() as f64).ceil() as usize).max(1));
    let size = rms(&sizes);
    if size.is_finite() { size.max(1e-9) } else { f64::INFINITY }
}
