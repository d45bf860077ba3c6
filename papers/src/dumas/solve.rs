//! Least squares over the stacked system (Dumas et al., eqs. 25-26), and how sure the result is.

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};
use stiffarm_kernels::generic::Arm;

use super::hidden::{self, Hidden};
use super::{IdentifyError, System, Test, Weighting};

/// Singular values of the scaled columns below this part of the largest are not determined.
pub(super) const UNDETERMINED: f64 = 1e-8;

/// How to solve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// QR of the columns brought to length 1, then the singular values of R.
    Orthogonal,
    /// `(Bᵀ B)⁻¹ Bᵀ c` as it is printed (eq. 26), which squares the condition number.
    NormalEquations,
}

/// How to identify.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Of the rows.
    pub weighting: Weighting,
    /// The weights are one over the noise; otherwise the noise is estimated from what is left.
    pub noise_known: bool,
    /// How to solve.
    pub method: Method,
    /// Of the intervals, between 0 and 1.
    pub confidence: f64,
    /// A joint is reported as weak if the standard deviation of its compliance is above this part
    /// of the compliance.
    pub weak: f64,
}

impl Settings {
    /// Orthogonal, intervals of 95 %, weak above one half, noise estimated from what is left.
    pub fn new(weighting: Weighting) -> Settings {
        let method = Method::Orthogonal;
        Settings { weighting, noise_known: false, method, confidence: 0.95, weak: 0.5 }
    }

    /// The same with weights that are one over the noise.
    pub fn known_noise(weighting: Weighting) -> Settings {
        Settings { noise_known: true, ..Settings::new(weighting) }
    }
}

/// The compliance of one joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// From 1.
    pub joint: usize,
    /// rad/(N·m), or m/N; negative if the tests say so.
    pub compliance: f64,
    /// Its standard deviation, by the noise of the displacements alone (not of the wrench).
    pub deviation: f64,
    /// Its interval.
    pub interval: [f64; 2],
}

impl Estimate {
    /// 1/compliance, N·m/rad or N/m; none if the compliance is not positive.
    pub fn stiffness(&self) -> Option<f64> {
        (self.compliance > 0.0).then(|| 1.0 / self.compliance)
    }

    /// The interval of the stiffness; its upper end is infinite if the joint may be rigid.
    pub fn stiffness_interval(&self) -> [f64; 2] {
        let inverse = |c: f64| if c > 0.0 { 1.0 / c } else { f64::INFINITY };
        [inverse(self.interval[1]), inverse(self.interval[0])]
    }
}

/// What the tests say.
#[derive(Clone, Debug, PartialEq)]
pub struct Identified {
    /// One for each joint.
    pub joints: Vec<Estimate>,
    /// Sum of the squares left per degree of freedom, in units of the weights: about 1 if the
    /// weights are one over the noise and the model is complete. None without degrees of freedom.
    pub reduced_chi2: Option<f64>,
    /// Rows that count less unknowns.
    pub freedom: usize,
    /// Condition number of B, weighted.
    pub condition: f64,
    /// Condition number of B with its columns brought to length 1.
    pub scaled_condition: f64,
    /// Joints that are determined, but badly.
    pub weak: Vec<Hidden>,
}

impl Identified {
    /// The arm with these compliances; one that is not positive becomes rigid.
    pub fn applied_to(&self, arm: &Arm) -> Arm {
        let mut soft = arm.clone();
        for (joint, estimate) in soft.joints.iter_mut().zip(&self.joints) {
            joint.compliance = estimate.compliance.max(0.0);
        }
        soft
    }
}

/// The compliances that make `|B x − c|²` least.
///
/// # Errors
/// [`IdentifyError::Hidden`] names every joint that the tests leave open and the pull that would
/// show it; otherwise as [`System::stack`].
pub fn identify(
    arm: &Arm,
    tests: &[Test],
    settings: &Settings,
) -> Result<Identified, IdentifyError> {
    if !(settings.confidence > 0.0 && settings.confidence < 1.0) {
        let (what, found) = ("the confidence", settings.confidence);
        return Err(IdentifyError::Setting { what, found, expected: "between 0 and 1" });
    }
    let system = System::stack(arm, tests, &settings.weighting)?;
    let solved = Solved::of(&system);
    let open = hidden::open(&solved, &system);
    if !open.is_empty() {
        let named = open.into_iter().map(|(joint, reason)| Hidden {
            joint: joint + 1,
            reason,
            pull: hidden::pull(arm, tests, &settings.weighting, joint),
        });
        return Err(IdentifyError::Hidden(named.collect()));
    }
    let x = match settings.method {
        Method::Orthogonal => solved.x.clone(),
        Method::NormalEquations => {
            let product = system.b.tr_mul(&system.b).try_inverse();
            let inverse = product.unwrap_or_else(|| solved.covariance.clone());
            inverse * system.b.tr_mul(&system.c)
        }
    };
    let freedom = system.rows.saturating_sub(x.len());
    let left = (&system.b * &x - &system.c).norm_squared();
    let reduced_chi2 = (freedom > 0).then(|| left / freedom as f64);
    let variance = if settings.noise_known { Some(1.0) } else { reduced_chi2 };
    let factor = quantile(settings, freedom);
    let joints: Vec<Estimate> = (0..x.len())
        .map(|j| {
            let square = variance.map(|v| v * solved.covariance[(j, j)].max(0.0));
            let deviation = square.map_or(f64::INFINITY, f64::sqrt);
            let interval = [x[j] - factor * deviation, x[j] + factor * deviation];
            Estimate { joint: j + 1, compliance: x[j], deviation, interval }
        })
        .collect();
    let weak = joints
        .iter()
        .filter(|e| e.deviation > settings.weak * e.compliance)
        .map(|e| Hidden {
            joint: e.joint,
            reason: hidden::Reason::Weak { deviation: e.deviation, compliance: e.compliance },
            pull: hidden::pull(arm, tests, &settings.weighting, e.joint - 1),
        })
        .collect();
    Ok(Identified {
        joints,
        reduced_chi2,
        freedom,
        condition: ratio(&system.b.clone().singular_values()),
        scaled_condition: ratio(&solved.values),
        weak,
    })
}

fn quantile(settings: &Settings, freedom: usize) -> f64 {
    let upper = 0.5 + settings.confidence / 2.0;
    if settings.noise_known {
        return Normal::standard().inverse_cdf(upper);
    }
    let students = StudentsT::new(0.0, 1.0, freedom.max(1) as f64);
    students.map_or(f64::INFINITY, |t| t.inverse_cdf(upper))
}

fn ratio(values: &DVector<f64>) -> f64 {
    let (least, most) = (values.min(), values.max());
    if least > 0.0 { most / least } else { f64::INFINITY }
}

/// A system decomposed.
pub(super) struct Solved {
    /// Least squares, of least length where columns are not determined.
    pub(super) x: DVector<f64>,
    /// `(Bᵀ B)⁻¹` over what is determined.
    pub(super) covariance: DMatrix<f64>,
    /// Singular values of the scaled columns.
    pub(super) values: DVector<f64>,
    /// Right singular vectors of the scaled columns, one in each row.
    pub(super) directions: DMatrix<f64>,
}

impl Solved {
    pub(super) fn of(system: &System) -> Solved {
        let n = system.b.ncols();
        let scale = DVector::from_fn(n, |j, _| {
            if system.empty[j] { 0.0 } else { 1.0 / system.b.column(j).norm() }
        });
        let mut scaled = system.b.clone();
        for (mut column, factor) in scaled.column_iter_mut().zip(scale.iter()) {
            column *= *factor;
        }
        let mut right = system.c.clone();
        if scaled.nrows() < n {
            scaled = scaled.resize_vertically(n, 0.0);
            right = right.resize_vertically(n, 0.0);
        }
        let qr = scaled.qr();
        qr.q_tr_mul(&mut right);
        let parts = qr.r().svd(true, true);
        let (Some(u), Some(v_t)) = (parts.u, parts.v_t) else {
            // Both were asked for; without them nothing is determined.
            let zeros = DMatrix::zeros(n, n);
            let (x, values) = (DVector::zeros(n), DVector::zeros(n));
            return Solved { x, covariance: zeros.clone(), values, directions: zeros };
        };
        let most = parts.singular_values.max();
        let inverse = parts
            .singular_values
            .map(|s| if most > 0.0 && s > UNDETERMINED * most { 1.0 / s } else { 0.0 });
        let turned = v_t.transpose() * DMatrix::from_diagonal(&inverse);
        let x = (&turned * u.tr_mul(&right.rows(0, n))).component_mul(&scale);
        let back = DMatrix::from_diagonal(&scale) * turned;
        let covariance = &back * back.transpose();
        Solved { x, covariance, values: parts.singular_values, directions: v_t }
    }
}
