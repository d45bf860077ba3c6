//! What is the links' and not the joints' (Dumas et al., section 5.3: links 2 and 3 make up to 21 %
//! and 4.8 % of the displacement).
//!
//! Bending of a link in the plane of two joints that carry its ends looks like springs at these
//! joints: for parallel axes it is exactly the compliance block `L/6EI [[2, 1], [1, 2]]`. Its
//! diagonal cannot be told from the joints' own compliances; the part off the diagonal, bending out
//! of the plane and torsion can.

use nalgebra::{DMatrix, Vector6};
use stiffarm_kernels::generic::Arm;

use super::solve::{Solved, UNDETERMINED};
use super::system::links_only;
use super::{IdentifyError, System, Test, Weighting};
use crate::chain::transport::upper;

/// One link's part of a displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// Row of the table whose beam it is, from 1.
    pub row: usize,
    /// Twist of the tool by this beam only, m and rad.
    pub twist: Vector6<f64>,
    /// Size of its translation over that of the whole arm's; 0 if nothing moves.
    pub part: f64,
}

/// What each beam of the arm adds to the displacement under the wrench `w`, to first order.
///
/// # Errors
/// [`IdentifyError::Posture`], [`IdentifyError::NotFinite`].
pub fn shares(arm: &Arm, q: &[f64], w: &Vector6<f64>) -> Result<Vec<Share>, IdentifyError> {
    let test = Test { q: q.to_vec(), wrench: *w, displacement: Vector6::zeros() };
    super::check(arm, &[test])?;
    let whole = upper(&arm.deflection_first_order(q, w)).norm();
    let beams = (0..arm.dof()).filter(|&k| arm.joints[k].beam.is_some());
    Ok(beams
        .map(|k| {
            let twist = only_beam(arm, k).deflection_first_order(q, w);
            let size = upper(&twist).norm();
            Share { row: k + 1, twist, part: if whole > 0.0 { size / whole } else { 0.0 } }
        })
        .collect())
}

/// The arm with nothing that yields but one beam.
pub(super) fn only_beam(arm: &Arm, row: usize) -> Arm {
    let mut only = links_only(arm);
    for (k, joint) in only.joints.iter_mut().enumerate() {
        if k != row {
            joint.beam = None;
        }
    }
    only
}

/// A value and its standard deviation by the noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// As fitted.
    pub value: f64,
    /// Its standard deviation.
    pub deviation: f64,
}

/// Joints and links identified together.
#[derive(Clone, Debug, PartialEq)]
pub struct WithLinks {
    /// Compliance of each joint, rad/(N·m) or m/N.
    pub joints: Vec<Value>,
    /// Flexibility of each chosen beam as a multiple of the model's: 1 is the model's own EI, 2 is
    /// half of it.
    pub links: Vec<Value>,
    /// Correlations of the fitted values, joints first.
    pub correlation: DMatrix<f64>,
    /// As of [`super::Identified::reduced_chi2`].
    pub reduced_chi2: Option<f64>,
    /// Condition number with the columns brought to length 1.
    pub scaled_condition: f64,
}

/// Identifies the compliances of all joints and the flexibilities of the beams of `rows` (from 1)
/// at once; the shape of each beam's flexibility (EI to GJ to EA, the two planes) is that of the
/// model. `noise_known` as in [`super::Settings`].
///
/// # Errors
/// As [`System::stack`]; [`IdentifyError::Setting`] if a row has no beam, and if the tests do not
/// tell all of the unknowns apart.
pub fn identify_with_links(
    arm: &Arm,
    tests: &[Test],
    weighting: &Weighting,
    rows: &[usize],
    noise_known: bool,
) -> Result<WithLinks, IdentifyError> {
    let has_beam =
        |row: usize| row > 0 && arm.joints.get(row - 1).is_some_and(|j| j.beam.is_some());
    if let Some(&row) = rows.iter().find(|&&row| !has_beam(row)) {
        let (what, expected) = ("a row of the table, from 1", "one that has a beam");
        return Err(IdentifyError::Setting { what, found: row as f64, expected });
    }
    let mut others = arm.clone();
    rows.iter().for_each(|&row| others.joints[row - 1].beam = None);
    let mut system = System::stack(&others, tests, weighting)?;
    let n = arm.dof();
    system.b = system.b.resize_horizontally(n + rows.len(), 0.0);
    for (slot, &row) in rows.iter().enumerate() {
        let only = only_beam(arm, row - 1);
        for (k, test) in tests.iter().enumerate() {
            let twist = only.deflection_first_order(&test.q, &test.wrench);
            let weighted = weighting.matrix(arm, &test.q)? * twist;
            system.b.view_mut((6 * k, n + slot), (6, 1)).copy_from(&weighted);
        }
        system.empty.push(system.b.column(n + slot).norm() == 0.0);
    }
    let solved = Solved::of(&system);
    let (least, most) = (solved.values.min(), solved.values.max());
    let determined = solved.values.iter().filter(|s| **s > UNDETERMINED * most).count();
    if determined < n + rows.len() {
        let what = "the number of joints and links that the tests tell apart";
        let expected = "all of them: more postures and pulls, or fewer links";
        return Err(IdentifyError::Setting { what, found: determined as f64, expected });
    }
    let freedom = system.rows.saturating_sub(n + rows.len());
    let left = (&system.b * &solved.x - &system.c).norm_squared();
    let reduced_chi2 = (freedom > 0).then(|| left / freedom as f64);
    let variance = if noise_known { Some(1.0) } else { reduced_chi2 };
    let covariance = &solved.covariance;
    let root = |k: usize| covariance[(k, k)].max(0.0).sqrt();
    let value = |k: usize| Value {
        value: solved.x[k],
        deviation: variance.map_or(f64::INFINITY, |v| v.sqrt() * root(k)),
    };
    Ok(WithLinks {
        joints: (0..n).map(value).collect(),
        links: (n..n + rows.len()).map(value).collect(),
        correlation: DMatrix::from_fn(n + rows.len(), n + rows.len(), |i, j| {
            covariance[(i, j)] / (root(i) * root(j))
        }),
        reduced_chi2,
        scaled_condition: most / least,
    })
}
