//! Base parameters: the sums of the links' moments of mass that the motors' torques can tell apart.
//!
//! Gautier: *Numerical calculation of the base inertial parameters of robots*, J. Robotic Systems 8(4) (1991). Over
//! random motions columns of the regressor depend on others; what would multiply them is added, in the proportion of the
//! columns, to what multiplies those. Base to tip, the first columns stand: so the sums are gathered towards the base, as
//! those of Khalil & Dombre are.

use core::fmt;
use std::vec::Vec;

use nalgebra::{DMatrix, DVector};

use super::arm::Arm;

/// Random motions in which columns are held against each other.
const MOTIONS: usize = 60;

/// A column of which less than this part of the largest stands apart from those before it depends on
/// them: rounding leaves about 1e-14.
const APART: f64 = 1e-9;

/// A part of a sum below this, to the second power of metres, is rounding.
const LEAST: f64 = 1e-9;

/// What the moments of mass of a link are called, in the order of the regressor's columns.
const NAMES: [&str; 10] = ["m", "mx", "my", "mz", "xx", "xy", "yy", "xz", "yz", "zz"];

/// A sum of moments of mass.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseParameter {
    /// The moment that names it, a column of [`Arm::torque_regressor`]: that column is the sum's.
    pub moment: usize,
    /// What is added to it: other moments, and how many times.
    pub others: Vec<(usize, f64)>,
}

impl BaseParameter {
    /// Its value, of all moments of mass.
    pub fn of(&self, moments: &[f64]) -> f64 {
        self.others.iter().fold(moments[self.moment], |sum, (k, times)| sum + times * moments[*k])
    }
}

/// `mx2 + 0.4318 m3`: a moment's name and its link's number, the tensor's entries about the row's origin.
impl fmt::Display for BaseParameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |moment: usize| (NAMES[moment % 10], moment / 10 + 1);
        let (moment, link) = name(self.moment);
        write!(f, "{moment}{link}")?;
        for (other, times) in &self.others {
            let (moment, link) = name(*other);
            write!(f, " {} ", if *times < 0.0 { '-' } else { '+' })?;
            // Six digits: rounding leaves more, no table has them.
            let size = (times.abs() * 1e6).round() / 1e6;
            if size != 1.0 {
                write!(f, "{size} ")?;
            }
            write!(f, "{moment}{link}")?;
        }
        Ok(())
    }
}

impl Arm {
    /// The moments of mass π of links 1 to n, ten each, with which `τ = Y π` but for beams, rotors and friction: mass,
    /// first moments, and xx, xy, yy, xz, yz, zz of the tensor of inertia about the origin of the row's frame.
    pub fn moments(&self) -> Vec<f64> {
        let of_link = |joint: &super::arm::Joint| {
            let (m, c) = (joint.mass, joint.com);
            let tensor = joint.inertia - m * c.cross_matrix() * c.cross_matrix();
            let [x, y, z] = [c.x, c.y, c.z].map(|c| m * c);
            let of = |i, j| tensor[(i, j)];
            [m, x, y, z, of(0, 0), of(0, 1), of(1, 1), of(0, 2), of(1, 2), of(2, 2)]
        };
        self.joints.iter().flat_map(of_link).collect()
    }

    /// The base parameters, base to tip: the torques of any motion are their values times their columns.
    pub fn base_parameters(&self) -> Vec<BaseParameter> {
        let columns = self.columns_of_motions();
        let (standing, rest) = apart(&columns);
        let basis = columns.select_columns(&standing).qr();
        let (q, r) = (basis.q(), basis.r());
        let mut found: Vec<BaseParameter> = standing
            .into_iter()
            .map(|moment| BaseParameter { moment, others: Vec::new() })
            .collect();
        for moment in rest {
            let along = q.tr_mul(&columns.column(moment));
            let Some(shares) = r.solve_upper_triangular(&along) else { continue };
            for (parameter, times) in found.iter_mut().zip(shares.iter()) {
                if times.abs() > LEAST {
                    parameter.others.push((moment, *times));
                }
            }
        }
        found
    }

    /// The regressor at random motions, one below the other.
    fn columns_of_motions(&self) -> DMatrix<f64> {
        let n = self.dof();
        let mut seed = 0_u64;
        let mut columns = DMatrix::zeros(MOTIONS * n, 10 * n);
        for motion in 0..MOTIONS {
            let mut draw = |size: f64| (0..n).map(|_| size * drawn(&mut seed)).collect::<Vec<_>>();
            let (q, rates, accelerations) = (draw(3.0), draw(3.0), draw(10.0));
            let rows = self.torque_regressor(&q, &rates, &accelerations);
            columns.rows_mut(motion * n, n).copy_from(&rows);
        }
        columns
    }
}

/// Between −1 and 1 (SplitMix64).
pub(super) fn drawn(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut x = (*seed ^ (*seed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (x ^ (x >> 31)) as f64 / (u64::MAX / 2) as f64 - 1.0
}

/// Which columns stand apart from those before them, and which depend on them.
fn apart(columns: &DMatrix<f64>) -> (Vec<usize>, Vec<usize>) {
    // Against the largest of all: a column that is nothing but rounding is apart from all others.
    let largest = columns.column_iter().map(|column| column.norm()).fold(0.0, f64::max);
    let mut directions: Vec<DVector<f64>> = Vec::new();
    (0..columns.ncols()).partition(|at| {
        let mut column = columns.column(*at).into_owned();
        // Twice: once leaves rounding behind that is as large as what is looked for.
        for _ in 0..2 {
            for other in &directions {
                column -= other * column.dot(other);
            }
        }
        let left = column.norm();
        let stands = left > APART * largest;
        if stands {
            directions.push(column / left);
        }
        stands
    })
}
