//! Every solution of six joints that turn, wherever their axes are: a search, not a closed form.
//!
//! `e_1 … e_6 = G`, with `e_k` the turn about axis k where it stands at zero and G the displacement from the tool's pose at
//! zero to the target. Axis 6 is a line that `e_6` leaves alone: `e_3 e_4 e_5 ℓ = e_2⁻¹ e_1⁻¹ G ℓ`. With its direction l, a
//! point p on it, `p × l`, `p·l`, `p·p` and `(p·p) l − 2 (p·l) p`, fourteen numbers of a line are moved linearly by
//! displacements, so that each turn has the parts 1, cos θ, sin θ (Raghavan & Roth 1993). Of the fourteen equations eight
//! give the products of θ_1 and θ_2; by the six that are left, and by these times tan θ_4/2, a determinant of twelve rows is
//! zero. It has the eighth degree in cos θ_3 and sin θ_3: at most sixteen solutions. Its values at angles around the circle
//! give its coefficients, all roots are found at once (Aberth 1973), and Newton's method leads from each to joint values
//! which reach the target.

mod equations;
mod moved;
mod nearest;
mod roots;

use core::f64::consts::TAU;

use equations::{Rows, equations, first_two, six, twelve};
use moved::{Moved, V3, circle, cross, dot, plus};
use roots::{coefficients, roots};

use super::steps::{error, step};
use super::{Solutions, missed, turns};
use crate::{Motion, Pose, Scalar};

/// The most solutions that six joints have.
const MOST: usize = 16;

/// A root of the determinant is tried as an angle where the square of its distance from zero, or the inverse of that, is below
/// this: rounding moves double roots off the circle, and what is no solution ends nowhere. From exp 0.1 to exp 40 the share of
/// solutions that are found changes by less than 0.2 %; what is tried in vain takes time. This is exp 0.4.
const BESIDE: f64 = 1.4918;

/// A root that is this near the circle is most likely an angle. With 1 + 2e-6 the wrist of a Fanuc CRX misses 0.85 % of its
/// solutions, with this 0.26 %; of axes in general position none are missed with either.
const ON: f64 = 1.02;

/// Newton's steps from each root at most; nearly all take fewer than five.
const NEWTON: usize = 20;

/// What a solution misses its pose by at most, as a part of the arm's size, and rad.
const REACHED: f64 = 1e-9;

/// Two solutions are one where no joint differs by more, rad.
const APART: f64 = 1e-6;

/// The axes of an arm of N joints that turn, base axes, with the joints at zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes<const N: usize> {
    /// Direction of each axis and a point on it, m.
    pub lines: [[V3; 2]; N],
    /// The tool there.
    pub home: Pose<f64>,
}

/// The solutions found so far.
struct Found {
    q: [[f64; 6]; MOST],
    count: usize,
}

impl Found {
    fn add(&mut self, q: [f64; 6]) {
        let q = q.map(|q| q + turns(q, 0.0) * TAU);
        let one = |known: &[f64; 6]| {
            known.iter().zip(&q).all(|(a, b)| {
                let by = (a - b).abs();
                by.min((by - TAU).abs()) < APART
            })
        };
        if self.count < MOST && !self.q[..self.count].iter().any(one) {
            self.q[self.count] = q;
            self.count += 1;
        }
    }
}

/// Six axes as they are solved for: lengths by the arm's size, from a point on one of them.
struct SixAxes {
    lines: [[V3; 2]; 6],
    home: Pose<f64>,
    target: Pose<f64>,
    /// The arm's size, m.
    size: f64,
}

impl SixAxes {
    fn at(&self, q: &[f64; 6]) -> (Pose<f64>, [[f64; 6]; 6]) {
        let mut so_far = Moved::NOT;
        let lines: [[V3; 2]; 6] = core::array::from_fn(|k| {
            let line = so_far.line(self.lines[k]);
            so_far = so_far.then(self.lines[k], circle(q[k]));
            line
        });
        let pose = so_far.pose(&self.home);
        let column = |[z, o]: [V3; 2]| {
            let [x, y, w] = cross(z, plus(pose.position, -1.0, o));
            [x, y, w, z[0], z[1], z[2]]
        };
        (pose, lines.map(column))
    }

    /// Newton's method from joint values.
    fn polished(&self, mut q: [f64; 6]) -> Option<[f64; 6]> {
        let mut before = f64::INFINITY;
        for _ in 0..NEWTON {
            let (pose, jacobian) = self.at(&q);
            let [distance, tilt] = missed(&pose, &self.target);
            let off = distance.max(tilt);
            // Rounding no longer falls.
            if off < REACHED && (off < 1e-15 || off > 0.5 * before) {
                return Some(q);
            }
            before = off;
            let by = step(&jacobian, &error(&pose, &self.target)).ok()?;
            let most = by.iter().fold(1.0_f64, |most, by| most.max(by.abs()));
            q.iter_mut().zip(by).for_each(|(q, by)| *q += by / most);
        }
        (before < REACHED).then_some(q)
    }

    /// Joint values by those of three joints.
    fn joints(
        &self,
        rows: &Rows,
        lines: &[[V3; 2]; 6],
        (third, [fourth, fifth]): (f64, [f64; 2]),
        displacement: &Moved,
        first: usize,
    ) -> [f64; 6] {
        let [one, two] = first_two(rows, [third, fourth, fifth].map(circle));
        let mut q = [one, two, third, fourth, fifth, 0.0];
        // What is left is a turn about the last axis.
        let so_far = (0..5).fold(Moved::NOT, |m, k| m.then(lines[k], circle(q[k])));
        let [z, _] = lines[5];
        let least = (0..3).fold(0, |l, k| if z[k].abs() < z[l].abs() { k } else { l });
        let x = cross(z, Moved::NOT.0[least]);
        let to = so_far.vector_back(displacement.vector(x));
        q[5] = Scalar::atan2(dot(z, cross(x, to)), dot(x, to));
        q.rotate_right(first);
        q
    }

    /// Joint values by each root this near the circle, with joint `third` from 0 in the middle of the equations; how many
    /// roots are most likely angles.
    fn begin(&self, third: usize, near: f64, mut with: impl FnMut([f64; 6])) -> usize {
        // e_1 … e_6 = G is e_{k+1} … e_6 (G⁻¹ e_1 G) … (G⁻¹ e_k G) = G.
        let displacement = {
            let axes = Moved::NOT.0.map(|axis| {
                let along = self.home.rotation.map(|x| dot(x, axis));
                Moved(self.target.rotation, [0.0; 3]).vector(along)
            });
            let moved = Moved(axes, [0.0; 3]).vector(self.home.position);
            Moved(axes, plus(self.target.position, -1.0, moved))
        };
        let first = (third + 4) % 6;
        let lines: [[V3; 2]; 6] = core::array::from_fn(|k| match (first + k).checked_sub(6) {
            None => self.lines[first + k],
            Some(over) => displacement.line_back(self.lines[over]),
        });
        let rows = equations(&lines, displacement.line(lines[5]));
        let six = six(&rows);
        let mut on_circle = 0;
        for z in roots(&coefficients(|at| twelve(&six, at).1)) {
            let square = z[0] * z[0] + z[1] * z[1];
            let beside = square.max(1.0 / square);
            if beside.is_nan() || beside >= near {
                continue;
            }
            on_circle += usize::from(beside < ON);
            let at = Scalar::atan2(z[1], z[0]);
            let angles = twelve(&six, circle(at)).angles();
            with(self.joints(&rows, &lines, (at, angles), &displacement, first));
        }
        on_circle
    }
}

impl<const N: usize> Axes<N> {
    /// The most solutions that six joints have.
    pub const MOST: usize = MOST;

    /// The tool at joint values.
    pub fn pose(&self, q: &[f64; N]) -> Pose<f64> {
        let each = self.lines.iter().zip(q);
        each.fold(Moved::NOT, |moved, (line, q)| moved.then(*line, circle(*q))).pose(&self.home)
    }

    /// Every solution at a pose of the tool, base axes, with the joint that is `given` where `near` has it; joint `third`, of
    /// the six that are left, is in the middle of the equations. Of a pose out of reach the only one is the posture with the
    /// least distance² + tilt², m and rad. What is no solution misses the pose by an infinite distance; of arms with other
    /// than six joints, or seven of which one is given, nothing is one.
    pub fn search<S: Scalar + Into<f64>>(
        &self,
        pose: &Pose<S>,
        near: &[S; N],
        (given, third): (Option<usize>, usize),
    ) -> Solutions<S, N, MOST> {
        let into = |v: [S; 3]| v.map(Into::into);
        let [x, y, _] = pose.rotation.map(into);
        // Axes of single precision are not at right angles.
        let unit = |v: V3| v.map(|x| x / libm::sqrt(dot(v, v)));
        let x = unit(x);
        let y = unit(plus(y, -dot(x, y), x));
        let target = Pose { rotation: [x, y, cross(x, y)], position: into(pose.position) };
        let mut all = *self;
        if let Some(joint) = given.filter(|joint| *joint < N) {
            let by = Moved::NOT.then(self.lines[joint], circle(near[joint].into()));
            all.lines.iter_mut().skip(joint + 1).for_each(|line| *line = by.line(*line));
            all.home = by.pose(&self.home);
        }
        let mut out = Solutions {
            q: [*near; MOST],
            distance: [S::lit(f64::INFINITY); MOST],
            tilt: [S::lit(f64::INFINITY); MOST],
            motion: [Motion::Revolute; N],
        };
        if N != if given.is_some() { 7 } else { 6 } {
            return out;
        }
        let kept = |k: usize| if given.is_some_and(|joint| k >= joint) { k + 1 } else { k };
        let lines: [[V3; 2]; 6] = core::array::from_fn(|k| all.lines[kept(k)]);
        let [_, origin] = lines[2];
        let from = |p: V3| plus(p, -1.0, origin);
        let most = lines.iter().map(|[_, p]| from(*p)).chain([from(all.home.position)]);
        let size = most.fold(0.0_f64, |most, p| most.max(libm::sqrt(dot(p, p))));
        let scaled = |p: V3| from(p).map(|x| x / size);
        let arm = SixAxes {
            lines: lines.map(|[z, p]| [z, scaled(p)]),
            home: Pose { position: scaled(all.home.position), ..all.home },
            target: Pose { position: scaled(target.position), ..target },
            size,
        };
        let mut found = Found { q: [[0.0; 6]; MOST], count: 0 };
        // Solutions come and go in pairs, and each is a root: where one is missing, other equations may find it.
        const OTHERS: [usize; 4] = [0, 3, 4, 1];
        for turn in OTHERS {
            let polish = |q| arm.polished(q).into_iter().for_each(|q| found.add(q));
            let roots = arm.begin((third + turn) % 6, BESIDE, polish);
            if found.count > 0 && found.count.is_multiple_of(2) && found.count >= roots {
                break;
            }
        }
        if found.count == 0 {
            let mut least = (f64::INFINITY, [0.0; 6]);
            let mut nearer = |q| {
                let other = arm.nearest(q);
                if other.0 < least.0 {
                    least = other;
                }
            };
            nearer(core::array::from_fn(|k| near[kept(k)].into()));
            for turn in OTHERS {
                arm.begin((third + turn) % 6, f64::INFINITY, &mut nearer);
            }
            if least.0.is_finite() {
                found.add(least.1);
            }
        }
        for (branch, q) in found.q[..found.count].iter().enumerate() {
            let [distance, tilt] = missed(&arm.at(q).0, &arm.target);
            (out.distance[branch], out.tilt[branch]) = (S::lit(size * distance), S::lit(tilt));
            q.iter().enumerate().for_each(|(k, q)| out.q[branch][kept(k)] = S::lit(*q));
        }
        out
    }
}
