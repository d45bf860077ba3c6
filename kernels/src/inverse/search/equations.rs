//! The fourteen equations, the six that are left of them, and their determinant.

use super::moved::{V3, cross, dot, plus};
use crate::Scalar;

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
pub(super) type Rows = [[f64; 35]; 14];

/// The equations with the eight columns in triangular form.
pub(super) fn equations(axes: &[[V3; 2]; 6], target: [V3; 2]) -> Rows {
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
pub(super) type Six = [[[[f64; 3]; 3]; 3]; 6];

pub(super) fn six(rows: &Rows) -> Six {
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
pub(super) struct Twelve([[f64; 13]; 12], pub(super) f64);

/// At an angle of joint 3: columns are tan^j θ_4/2 · tan^i θ_5/2 at 3 j + i.
pub(super) fn twelve(six: &Six, by: [f64; 2]) -> Twelve {
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
    pub(super) fn angles(&self) -> [f64; 2] {
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
            2.0 * Scalar::atan2(most.1, most.0)
        };
        let fourth = angle(&mut (0..9).map(|k| (k, k + 3)));
        let fifth = angle(&mut (0..12).filter(|k| k % 3 < 2).map(|k| (k, k + 1)));
        [fourth, fifth]
    }
}

/// The angles of joints 1 and 2 by the eight rows.
pub(super) fn first_two(rows: &Rows, [third, fourth, fifth]: [[f64; 2]; 3]) -> [f64; 2] {
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
    [Scalar::atan2(x[5], x[2]), Scalar::atan2(x[1], x[0])]
}
