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

use core::f64::consts::TAU;

use super::steps::{error, step};
use super::{Solutions, missed};
use crate::{Motion, Pose, Scalar};

/// The most solutions that six joints have.
pub const MOST: usize = 16;

/// Values of the determinant around the circle. Its seventeen coefficients take seventeen.
const VALUES: usize = 24;

/// Degree of the determinant in cos θ_3 and sin θ_3.
const DEGREE: usize = 8;

/// Steps of Aberth's method at most; nearly all roots take fewer than twenty.
const ROOTS: usize = 60;

/// A root of the determinant is tried as an angle where its distance from the circle's logarithm is below this: rounding
/// moves double roots off the circle, and what is no solution ends nowhere.
const BESIDE: f64 = 0.2;

/// A root that is this near the circle is most likely an angle.
const ON: f64 = 1e-2;

/// Newton's steps from each root at most; nearly all take fewer than five.
const NEWTON: usize = 20;

/// What a solution misses its pose by at most, as a part of the arm's size, and rad.
const REACHED: f64 = 1e-9;

/// Two solutions are one where no joint differs by more, rad.
const APART: f64 = 1e-6;

/// A vector.
type V3 = [f64; 3];

/// The axes of an arm of N joints that turn, base axes, with the joints at zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes<const N: usize> {
    /// Direction of each axis and a point on it, m.
    pub lines: [[V3; 2]; N],
    /// The tool there.
    pub home: Pose<f64>,
}

/// A displacement: axes as columns, and the origin.
#[derive(Clone, Copy)]
struct Moved([V3; 3], V3);

fn dot(a: V3, b: V3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: V3, b: V3) -> V3 {
    core::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

/// `a + f b`.
fn plus(a: V3, f: f64, b: V3) -> V3 {
    core::array::from_fn(|k| a[k] + f * b[k])
}

/// `v` turned about a unit vector by an angle of this cosine and sine.
fn turned(v: V3, z: V3, [c, s]: [f64; 2]) -> V3 {
    let along = dot(z, v) * (1.0 - c);
    let across = cross(z, v);
    core::array::from_fn(|k| c * v[k] + s * across[k] + along * z[k])
}

fn circle(angle: f64) -> [f64; 2] {
    [libm::cos(angle), libm::sin(angle)]
}

impl Moved {
    const NOT: Moved = Moved([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [0.0; 3]);

    fn vector(&self, v: V3) -> V3 {
        let [x, y, z] = self.0;
        core::array::from_fn(|k| x[k] * v[0] + y[k] * v[1] + z[k] * v[2])
    }

    fn vector_back(&self, v: V3) -> V3 {
        self.0.map(|axis| dot(axis, v))
    }

    fn line(&self, [z, p]: [V3; 2]) -> [V3; 2] {
        [self.vector(z), plus(self.vector(p), 1.0, self.1)]
    }

    fn line_back(&self, [z, p]: [V3; 2]) -> [V3; 2] {
        [self.vector_back(z), self.vector_back(plus(p, -1.0, self.1))]
    }

    /// Behind it a turn about a line.
    fn then(&self, [z, p]: [V3; 2], by: [f64; 2]) -> Moved {
        let back = plus(p, -1.0, turned(p, z, by));
        let axes = Moved::NOT.0.map(|axis| self.vector(turned(axis, z, by)));
        Moved(axes, plus(self.vector(back), 1.0, self.1))
    }

    fn pose(&self, home: &Pose<f64>) -> Pose<f64> {
        let position = plus(self.vector(home.position), 1.0, self.1);
        Pose { rotation: home.rotation.map(|axis| self.vector(axis)), position }
    }
}

/// The numbers of a line: l, p, p × l, (p·p) l − 2 (p·l) p, p·l, p·p, 1.
type Numbers = [f64; 15];

fn numbers([l, p]: [V3; 2]) -> Numbers {
    let (pl, pp) = (dot(p, l), dot(p, p));
    let w = core::array::from_fn(|k| pp * l[k] - 2.0 * pl * p[k]);
    gathered([l, p, cross(p, l), w], [pl, pp, 1.0])
}

fn gathered(vectors: [V3; 4], scalars: V3) -> Numbers {
    let mut out = [0.0; 15];
    out[..12].copy_from_slice(vectors.as_flattened());
    out[12..].copy_from_slice(&scalars);
    out
}

fn parted(numbers: &Numbers) -> ([V3; 4], V3) {
    let at = |k: usize| [numbers[k], numbers[k + 1], numbers[k + 2]];
    ([at(0), at(3), at(6), at(9)], at(12))
}

/// The numbers of what is shifted.
fn shifted(of: &Numbers, t: V3) -> Numbers {
    let ([l, p, m, w], [pl, pp, one]) = parted(of);
    let (tt, tl) = (dot(t, t), dot(t, l));
    let turn = cross(t, m);
    let w = core::array::from_fn(|k| w[k] - 2.0 * (turn[k] + (pl + tl) * t[k]) + tt * l[k]);
    let moment = plus(m, 1.0, cross(t, l));
    gathered([l, plus(p, one, t), moment, w], [pl + tl, pp + 2.0 * dot(t, p) + tt * one, one])
}

/// The parts 1, cos θ, sin θ of what is turned about a line.
fn parts([z, o]: [V3; 2], of: &Numbers) -> [Numbers; 3] {
    let (vectors, scalars) = parted(&shifted(of, o.map(|x| -x)));
    let along = vectors.map(|v| z.map(|x| dot(z, v) * x));
    let across = core::array::from_fn(|k| plus(vectors[k], -1.0, along[k]));
    let quarter = vectors.map(|v| cross(z, v));
    let none = [0.0; 3];
    [(along, scalars), (across, none), (quarter, none)].map(|(v, s)| shifted(&gathered(v, s), o))
}

/// The parts' coefficients of 1, t, t² of t = tan θ/2, times 1 + t².
fn tangents<T: Copy>([one, c, s]: [T; 3], sum: impl Fn(T, f64, T) -> T) -> [T; 3] {
    [sum(one, 1.0, c), sum(s, 1.0, s), sum(one, -1.0, c)]
}

/// Rows of the fourteen equations: eight columns of 1 and 2, then 27 of 5, 4, 3.
type Rows = [[f64; 35]; 14];

/// The equations with the eight columns in triangular form.
fn equations(axes: &[[V3; 2]; 6], target: [V3; 2]) -> Rows {
    let mut rows = [[0.0; 35]; 14];
    let back = |[z, o]: [V3; 2]| [z.map(|x| -x), o];
    let mut put = |column: usize, by: f64, of: &Numbers| {
        rows.iter_mut().zip(of).for_each(|(row, x)| row[column] += by * x);
    };
    for (j, first) in parts(back(axes[0]), &numbers(target)).iter().enumerate() {
        for (k, both) in parts(back(axes[1]), first).iter().enumerate() {
            match (j, k) {
                (0, 0) => put(8, -1.0, both),
                _ => put(3 * j + k - 1, 1.0, both),
            }
        }
    }
    for (i, fifth) in parts(axes[4], &numbers(axes[5])).iter().enumerate() {
        for (j, fourth) in parts(axes[3], fifth).iter().enumerate() {
            for (k, third) in parts(axes[2], fourth).iter().enumerate() {
                put(8 + 9 * i + 3 * j + k, 1.0, third);
            }
        }
    }
    triangular(&mut rows);
    rows
}

/// Householder's reflections of the first eight columns.
fn triangular(rows: &mut Rows) {
    for column in 0..8 {
        let norm = libm::sqrt(rows[column..].iter().map(|row| row[column] * row[column]).sum());
        if norm <= 0.0 {
            continue;
        }
        let first = rows[column][column];
        let to = if first > 0.0 { -norm } else { norm };
        let mut v = [0.0; 14];
        v.iter_mut().zip(rows.iter()).skip(column).for_each(|(v, row)| *v = row[column]);
        v[column] = first - to;
        let scale = 1.0 / (norm * (norm + first.abs()));
        for k in column..35 {
            let along: f64 = (column..14).map(|row| v[row] * rows[row][k]).sum();
            rows[column..].iter_mut().zip(&v[column..]).for_each(|(row, v)| {
                row[k] -= scale * along * v;
            });
        }
    }
}

/// The six rows without θ_1 and θ_2 as coefficients of 1, cos θ_3, sin θ_3 of the products of tan θ_4/2 and tan θ_5/2.
type Six = [[[[f64; 3]; 3]; 3]; 6];

fn six(rows: &Rows) -> Six {
    core::array::from_fn(|row| {
        let at = |i: usize, j: usize, k: usize| rows[8 + row][8 + 9 * i + 3 * j + k];
        let of_three = |i, j| core::array::from_fn(|k| at(i, j, k));
        let of_four = |i| tangents(core::array::from_fn(|j| of_three(i, j)), plus);
        tangents(core::array::from_fn(of_four), |a: [V3; 3], f, b| {
            core::array::from_fn(|j| plus(a[j], f, b[j]))
        })
    })
}

/// A matrix of twelve rows in triangular form, its determinant, and the rows' right sides.
struct Twelve([[f64; 13]; 12], f64);

/// At an angle of joint 3: columns are tan^j θ_4/2 · tan^i θ_5/2 at 3 j + i.
fn twelve(six: &Six, by: [f64; 2]) -> Twelve {
    let mut a = [[0.0; 13]; 12];
    for (row, each) in six.iter().enumerate() {
        for (i, fifth) in each.iter().enumerate() {
            for (j, [one, c, s]) in fifth.iter().enumerate() {
                let value = one + c * by[0] + s * by[1];
                a[row][3 * j + i] = value;
                a[row + 6][3 * j + 3 + i] = value;
            }
        }
    }
    a.iter_mut().for_each(|row| row[12] = 1.0);
    let mut determinant = 1.0;
    for k in 0..12 {
        let pivot = (k..12).fold(k, |p, row| if a[row][k].abs() > a[p][k].abs() { row } else { p });
        if pivot != k {
            a.swap(pivot, k);
            determinant = -determinant;
        }
        determinant *= a[k][k];
        // Of a matrix that is singular the last row is none: what it leaves free is large.
        if a[k][k] == 0.0 {
            a[k][k] = f64::MIN_POSITIVE;
        }
        let above = a[k];
        for row in &mut a[k + 1..] {
            let factor = row[k] / above[k];
            if factor != 0.0 {
                row[k..].iter_mut().zip(&above[k..]).for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    Twelve(a, determinant)
}

impl Twelve {
    /// The angles of joints 4 and 5 by the vector that the matrix makes nothing of.
    fn angles(&self) -> [f64; 2] {
        let Twelve(a, _) = self;
        let mut x = [0.0; 12];
        for k in (0..12).rev() {
            let rest: f64 = (k + 1..12).map(|column| a[k][column] * x[column]).sum();
            x[k] = (a[k][12] - rest) / a[k][k];
            // Numbers stay finite; the vector's length is its own.
            if x[k].abs() > 1e100 {
                let scale = x[k].abs();
                x.iter_mut().for_each(|x| *x /= scale);
            }
        }
        let angle = |pairs: &mut dyn Iterator<Item = (usize, usize)>| {
            let most = pairs.map(|(low, high)| (x[low], x[high])).fold((0.0, 0.0), |m, p| {
                let size = |(a, b): (f64, f64)| a * a + b * b;
                if size(p) > size(m) { p } else { m }
            });
            2.0 * libm::atan2(most.1, most.0)
        };
        let fourth = angle(&mut (0..9).map(|k| (k, k + 3)));
        let fifth = angle(&mut (0..12).filter(|k| k % 3 < 2).map(|k| (k, k + 1)));
        [fourth, fifth]
    }
}

/// The angles of joints 1 and 2 by the eight rows.
fn first_two(rows: &Rows, [third, fourth, fifth]: [[f64; 2]; 3]) -> [f64; 2] {
    let all = |[c, s]: [f64; 2]| [1.0, c, s];
    let mut x = [0.0; 8];
    for k in (0..8).rev() {
        let mut sum = 0.0;
        for (i, five) in all(fifth).iter().enumerate() {
            for (j, four) in all(fourth).iter().enumerate() {
                for (l, three) in all(third).iter().enumerate() {
                    sum += rows[k][8 + 9 * i + 3 * j + l] * five * four * three;
                }
            }
        }
        let rest: f64 = (k + 1..8).map(|column| rows[k][column] * x[column]).sum();
        let pivot = rows[k][k];
        x[k] = if pivot.abs() > 1e-12 { (sum - rest) / pivot } else { 0.0 };
    }
    // Columns are c_2, s_2, c_1, c_1 c_2, c_1 s_2, s_1, s_1 c_2, s_1 s_2.
    [libm::atan2(x[5], x[2]), libm::atan2(x[1], x[0])]
}

/// A complex number.
type Complex = [f64; 2];

fn product([a, b]: Complex, [c, d]: Complex) -> Complex {
    [a * c - b * d, a * d + b * c]
}

fn quotient(a: Complex, [c, d]: Complex) -> Complex {
    let inverse = 1.0 / (c * c + d * d);
    product(a, [c * inverse, -d * inverse])
}

/// The roots of `Σ c_m z^m`, m from −8 to 8, with `c_{−m}` conjugate to `c_m`, all at once.
fn roots(c: &[Complex; DEGREE + 1]) -> [Complex; 2 * DEGREE] {
    let coefficient = |k: usize| match k.checked_sub(DEGREE) {
        Some(m) => c[m],
        None => [c[DEGREE - k][0], -c[DEGREE - k][1]],
    };
    let mut z: [Complex; 2 * DEGREE] = core::array::from_fn(|k| {
        // Half of them within the circle, half without.
        let radius = if k % 2 == 0 { 0.9 } else { 1.0 / 0.9 };
        circle(0.3 + TAU * k as f64 / (2 * DEGREE) as f64).map(|x| radius * x)
    });
    for _ in 0..ROOTS {
        let mut moved = 0.0_f64;
        for k in 0..2 * DEGREE {
            let at = z[k];
            // Far from zero by the inverse, of which the polynomial is its own conjugate.
            let inside = at[0] * at[0] + at[1] * at[1] <= 1.0;
            let x = if inside { at } else { quotient([1.0, 0.0], at) };
            let (mut value, mut slope) = ([0.0; 2], [0.0; 2]);
            for power in (0..=2 * DEGREE).rev() {
                let next = coefficient(if inside { power } else { 2 * DEGREE - power });
                let (s, v) = (product(slope, x), product(value, x));
                slope = [s[0] + value[0], s[1] + value[1]];
                value = [v[0] + next[0], v[1] + next[1]];
            }
            if value == [0.0; 2] {
                continue;
            }
            // p'/p, of p(z) = z^16 r(1/z): 16/z − r'(1/z)/(z² r(1/z)).
            let mut ratio = quotient(slope, value);
            if !inside {
                let inner = product(ratio, product(x, x));
                ratio = [16.0 * x[0] - inner[0], 16.0 * x[1] - inner[1]];
            }
            for (other, w) in z.iter().enumerate() {
                let by = [at[0] - w[0], at[1] - w[1]];
                if other != k && by != [0.0; 2] {
                    let inverse = quotient([1.0, 0.0], by);
                    ratio = [ratio[0] - inverse[0], ratio[1] - inverse[1]];
                }
            }
            let by = quotient([1.0, 0.0], ratio);
            if by[0].is_finite() && by[1].is_finite() {
                z[k] = [at[0] - by[0], at[1] - by[1]];
                let size = at[0].abs() + at[1].abs() + 1e-300;
                moved = moved.max((by[0].abs() + by[1].abs()) / size);
            }
        }
        if moved < 1e-12 {
            break;
        }
    }
    z
}

/// The coefficients of what has these values around the circle.
fn coefficients(values: &[f64; VALUES]) -> [Complex; DEGREE + 1] {
    core::array::from_fn(|m| {
        let each = values.iter().enumerate();
        each.fold([0.0; 2], |[a, b], (k, value)| {
            let [c, s] = circle(TAU * (m * k % VALUES) as f64 / VALUES as f64);
            [a + value * c, b - value * s]
        })
    })
}

/// The solutions found so far.
struct Found {
    q: [[f64; 6]; MOST],
    count: usize,
}

impl Found {
    fn add(&mut self, q: [f64; 6]) {
        let q = q.map(|q| q - libm::round(q / TAU) * TAU);
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
        q[5] = libm::atan2(dot(z, cross(x, to)), dot(x, to));
        q.rotate_right(first);
        q
    }

    /// Every solution, with joint `third` from 0 in the middle of the equations.
    fn solve(&self, third: usize, found: &mut Found) -> usize {
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
        let values = core::array::from_fn(|k| {
            let Twelve(_, determinant) = twelve(&six, circle(TAU * k as f64 / VALUES as f64));
            determinant
        });
        let mut on_circle = 0;
        for z in roots(&coefficients(&values)) {
            let beside = 0.5 * libm::log(z[0] * z[0] + z[1] * z[1]).abs();
            if beside.is_nan() || beside >= BESIDE {
                continue;
            }
            on_circle += usize::from(beside < ON);
            let at = libm::atan2(z[1], z[0]);
            let angles = twelve(&six, circle(at)).angles();
            let q = self.joints(&rows, &lines, (at, angles), &displacement, first);
            if let Some(q) = self.polished(q) {
                found.add(q);
            }
        }
        on_circle
    }
}

impl<const N: usize> Axes<N> {
    /// The tool at joint values.
    pub fn pose(&self, q: &[f64; N]) -> Pose<f64> {
        let each = self.lines.iter().zip(q);
        each.fold(Moved::NOT, |moved, (line, q)| moved.then(*line, circle(*q))).pose(&self.home)
    }

    /// Every solution at a pose of the tool, base axes, with the joint that is `given` where `near` has it; joint `third`, of
    /// the six that are left, is in the middle of the equations. What is no solution misses the pose by an infinite distance.
    pub fn search<S: Scalar + Into<f64>>(
        &self,
        pose: &Pose<S>,
        near: &[S; N],
        (given, third): (Option<usize>, usize),
    ) -> Solutions<S, N, MOST> {
        let into = |v: [S; 3]| v.map(Into::into);
        let target = Pose { rotation: pose.rotation.map(into), position: into(pose.position) };
        let mut all = *self;
        if let Some(joint) = given.filter(|joint| *joint < N) {
            let by = Moved::NOT.then(self.lines[joint], circle(near[joint].into()));
            all.lines.iter_mut().skip(joint + 1).for_each(|line| *line = by.line(*line));
            all.home = by.pose(&self.home);
        }
        let kept = |k: usize| if given.is_some_and(|joint| k >= joint) { k + 1 } else { k };
        let lines: [[V3; 2]; 6] = core::array::from_fn(|k| all.lines[kept(k).min(N - 1)]);
        let [_, origin] = lines[2];
        let from = |p: V3| plus(p, -1.0, origin);
        let most = lines.iter().map(|[_, p]| from(*p)).chain([from(all.home.position)]);
        let size = most.fold(0.0_f64, |most, p| most.max(libm::sqrt(dot(p, p))));
        let scaled = |p: V3| from(p).map(|x| x / size);
        let arm = SixAxes {
            lines: lines.map(|[z, p]| [z, scaled(p)]),
            home: Pose { position: scaled(all.home.position), ..all.home },
            target: Pose { position: scaled(target.position), ..target },
        };
        let mut found = Found { q: [[0.0; 6]; MOST], count: 0 };
        // Solutions come and go in pairs, and each is a root: where one is missing, other equations may find it.
        for turn in [0, 3, 4, 1] {
            let roots = arm.solve((third + turn) % 6, &mut found);
            if found.count > 0 && found.count.is_multiple_of(2) && found.count >= roots {
                break;
            }
        }
        let mut out = Solutions {
            q: [*near; MOST],
            distance: [S::lit(f64::INFINITY); MOST],
            tilt: [S::lit(f64::INFINITY); MOST],
            motion: [Motion::Revolute; N],
        };
        for (branch, q) in found.q[..found.count].iter().enumerate() {
            let [distance, tilt] = missed(&arm.at(q).0, &arm.target);
            (out.distance[branch], out.tilt[branch]) = (S::lit(size * distance), S::lit(tilt));
            q.iter().enumerate().for_each(|(k, q)| out.q[branch][kept(k)] = S::lit(*q));
        }
        out
    }
}
