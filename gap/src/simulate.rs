//! The simulator: the arm at static equilibrium under its links' weight and a row's wrench.
//!
//! The joints' springs balance the loads *in the loaded geometry* (Dumas et al. 2011, eqs. 4-10,
//! not to first order but solved): `δθ = C τ(q + δθ)` with `τ = J(q + δθ)ᵀ w + τ_g(q + δθ)`. The
//! links are linear beams (Lin et al. 1991) in the posture that the joints have taken.

use nalgebra::{DMatrix, DVector, Isometry3, Matrix6xX, UnitQuaternion, Vector3, Vector6};
use stiffarm_kernels::Unstable;
use stiffarm_kernels::generic::Arm;

use crate::measurement::{Kind, Row};

/// Newton's steps: convergence is quadratic, so a load that needs more has no equilibrium near.
const MOST_STEPS: usize = 40;

/// A step below this (rad, m; relative to the largest reading) changes nothing more.
const CONVERGED: f64 = 1e-14;

/// A step that no longer shrinks is rounding error if it is below this.
const ROUNDING: f64 = 1e-10;

/// The arm at rest under a load.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Tool frame in the base frame, links bent, m.
    pub tool: Isometry3<f64>,
    /// Joint values where the springs have come to rest, n, rad (m if prismatic).
    pub joints: Vec<f64>,
    /// What the load does to each joint there, n, N·m (N if prismatic).
    pub torque: DVector<f64>,
    /// Twist of the tool per unit of each joint's motion there, 6×n, base axes.
    pub jacobian: Matrix6xX<f64>,
    /// Motion of all joints, springs yielding, per unit of motion imposed on each: `(I − C
    /// ∂τ/∂q)⁻¹`, n×n.
    pub response: DMatrix<f64>,
}

impl State {
    /// Twist of the tool, base axes, per unit of motion imposed at joint `joint` (from 0), the
    /// springs yielding to the change of load.
    pub fn twist_of_joint(&self, joint: usize) -> Vector6<f64> {
        let motions = self.response.column(joint);
        self.jacobian.column_iter().zip(motions.iter()).map(|(j, m)| j * *m).sum()
    }
}

/// The arm at equilibrium at the readings `q` under `wrench` (base axes, tool origin) and its
/// weights.
///
/// # Errors [`Unstable`] if no equilibrium is found near `q`, or if the symmetric part of `Kθ −
/// ∂τ/∂q` is not positive definite there.
///
/// # Panics
/// If `q` has not as many values as the arm has joints.
pub fn equilibrium(arm: &Arm, q: &[f64], wrench: &Vector6<f64>) -> Result<State, Unstable> {
    let n = arm.dof();
    let compliance = DVector::from_iterator(n, arm.joints.iter().map(|j| j.compliance));
    let elastic = compliance.iter().any(|c| *c != 0.0);
    let mut joints = q.to_vec();
    let mut last = f64::INFINITY;
    let scale = 1.0 + q.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    for _ in 0..MOST_STEPS {
        let torque = arm.joint_torque(&joints, wrench) + arm.gravity_torque(&joints);
        let stiffening = if elastic {
            arm.complementary_stiffness(&joints, wrench) + arm.gravity_stiffness(&joints)
        } else {
            DMatrix::zeros(n, n)
        };
        let yielding = DMatrix::from_diagonal(&compliance) * &stiffening;
        let response = (DMatrix::identity(n, n) - yielding).try_inverse().ok_or(Unstable)?;
        let moved = DVector::from_iterator(n, joints.iter().zip(q).map(|(now, from)| now - from));
        let step = &response * (compliance.component_mul(&torque) - moved);
        let size = if n == 0 { 0.0 } else { step.amax() };
        if !size.is_finite() {
            return Err(Unstable);
        }
        for (joint, change) in joints.iter_mut().zip(step.iter()) {
            *joint += change;
        }
        if size <= CONVERGED * scale || (size <= ROUNDING * scale && size >= last) {
            stable(&compliance, &stiffening)?;
            return settled(arm, joints, wrench, torque, response);
        }
        last = size;
    }
    Err(Unstable)
}

/// Whether the symmetric part of `Kθ − K` is positive definite over the joints that give.
fn stable(compliance: &DVector<f64>, stiffening: &DMatrix<f64>) -> Result<(), Unstable> {
    let giving: Vec<usize> = (0..compliance.len()).filter(|&j| compliance[j] != 0.0).collect();
    if giving.is_empty() {
        return Ok(());
    }
    // In units of each joint's own spring, so that a very stiff one does not drown the others.
    let part = DMatrix::from_fn(giving.len(), giving.len(), |r, c| {
        let (i, j) = (giving[r], giving[c]);
        let symmetric = (stiffening[(i, j)] + stiffening[(j, i)]) / 2.0;
        f64::from(r == c) - symmetric * (compliance[i] * compliance[j]).sqrt()
    });
    part.cholesky().map(|_| ()).ok_or(Unstable)
}

fn settled(
    arm: &Arm,
    joints: Vec<f64>,
    wrench: &Vector6<f64>,
    torque: DVector<f64>,
    response: DMatrix<f64>,
) -> Result<State, Unstable> {
    let mut tool = arm.pose(&joints);
    if arm.joints.iter().any(|j| j.beam.is_some()) {
        let mut links_only = arm.clone();
        links_only.joints.iter_mut().for_each(|j| j.compliance = 0.0);
        let bend = links_only.deflection_with_gravity(&joints, wrench)?;
        tool.translation.vector += translation(&bend);
        tool.rotation = UnitQuaternion::from_scaled_axis(rotation(&bend)) * tool.rotation;
    }
    let jacobian = arm.jacobian(&joints);
    let finite = tool.translation.vector.iter().chain(tool.rotation.coords.iter());
    if !finite.chain(torque.iter()).all(|x| x.is_finite()) {
        return Err(Unstable);
    }
    Ok(State { tool, joints, torque, jacobian, response })
}

/// Translation of a twist.
pub(crate) fn translation(twist: &Vector6<f64>) -> Vector3<f64> {
    twist.fixed_rows::<3>(0).into_owned()
}

/// Rotation of a twist.
pub(crate) fn rotation(twist: &Vector6<f64>) -> Vector3<f64> {
    twist.fixed_rows::<3>(3).into_owned()
}

/// What an instrument reads: of a pose its position and orientation, of a displacement the
/// difference and the rotation from the unloaded to the loaded tool; base axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// m.
    pub position: Vector3<f64>,
    /// As a rotation in base axes.
    pub rotation: UnitQuaternion<f64>,
}

impl Reading {
    /// From position (or displacement) and rotation vector, m and rad.
    pub fn from_vector(vector: &Vector6<f64>) -> Reading {
        Reading {
            position: translation(vector),
            rotation: UnitQuaternion::from_scaled_axis(rotation(vector)),
        }
    }

    /// Position and rotation vector, m and rad.
    pub fn vector(&self) -> Vector6<f64> {
        let (p, r) = (self.position, self.rotation.scaled_axis());
        Vector6::new(p.x, p.y, p.z, r.x, r.y, r.z)
    }
}

/// The simulated states behind one row.
#[derive(Clone, Debug, PartialEq)]
pub struct Sim {
    /// Under the wrench and the weights.
    pub loaded: State,
    /// Under the weights alone, if the row measures a displacement.
    pub unloaded: Option<State>,
    /// The measured point in the tool frame, m.
    pub offset: Vector3<f64>,
}

/// Simulates one row. An unknown marker offset counts as zero.
///
/// # Errors
/// [`Unstable`] if the arm has no stable equilibrium under the row's load.
pub fn simulate(arm: &Arm, row: &Row, kind: Kind) -> Result<Sim, Unstable> {
    let loaded = equilibrium(arm, &row.q, &row.wrench)?;
    let unloaded = match kind {
        Kind::Pose { .. } => None,
        Kind::Displacement { .. } => Some(equilibrium(arm, &row.q, &Vector6::zeros())?),
    };
    Ok(Sim { loaded, unloaded, offset: row.offset.unwrap_or_default().into() })
}

impl Sim {
    /// What the instrument would read.
    pub fn reading(&self) -> Reading {
        let point = |s: &State| s.tool * nalgebra::Point3::from(self.offset);
        let loaded = point(&self.loaded);
        match &self.unloaded {
            None => Reading { position: loaded.coords, rotation: self.loaded.tool.rotation },
            Some(unloaded) => Reading {
                position: loaded - point(unloaded),
                rotation: self.loaded.tool.rotation * unloaded.tool.rotation.inverse(),
            },
        }
    }

    /// Change of the reading, 6×p, by changes of the tool that `twists` gives for a state, 6×p at
    /// the tool origin: carried to the measured point, and of a displacement loaded minus unloaded.
    pub fn change(&self, twists: impl Fn(&State) -> Matrix6xX<f64>) -> Matrix6xX<f64> {
        let at_point = |state: &State| {
            let lever = state.tool.rotation * self.offset;
            let mut twists = twists(state);
            for mut column in twists.column_iter_mut() {
                let turn = Vector3::new(column[3], column[4], column[5]);
                let mut shift = column.fixed_rows_mut::<3>(0);
                shift += turn.cross(&lever);
            }
            twists
        };
        match &self.unloaded {
            None => at_point(&self.loaded),
            Some(unloaded) => at_point(&self.loaded) - at_point(unloaded),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{bent, springy};

    #[test]
    fn the_springs_balance_the_loads_in_the_loaded_geometry() {
        let arm = springy();
        let (q, w) = ([0.3, -0.7, 0.4], Vector6::new(300.0, -200.0, -800.0, 20.0, -30.0, 10.0));
        let state = equilibrium(&arm, &q, &w).unwrap();
        let torque = arm.joint_torque(&state.joints, &w) + arm.gravity_torque(&state.joints);
        for j in 0..3 {
            let twist = state.joints[j] - q[j];
            assert!(twist.abs() > 1e-4);
            assert!((twist - arm.joints[j].compliance * torque[j]).abs() < 1e-15);
        }
    }

    #[test]
    fn a_small_load_gives_the_textbook_deflection() {
        let arm = bent();
        let (q, w) = ([0.3, -0.7, 0.4], Vector6::new(3e-3, -2e-3, -8e-3, 2e-4, -3e-4, 1e-4));
        let mut light = arm.clone();
        light.gravity = Vector3::zeros();
        let state = equilibrium(&light, &q, &w).unwrap();
        let moved = state.tool.translation.vector - light.pose(&q).translation.vector;
        let want = translation(&light.deflection(&q, &w).unwrap());
        assert!((moved - want).norm() < 1e-6 * want.norm() + 1e-15, "{moved} {want}");
    }

    #[test]
    fn a_buckling_load_is_refused() {
        let arm = springy();
        let push = Vector6::new(-1e9, 0.0, 0.0, 0.0, 0.0, 0.0);
        assert_eq!(equilibrium(&arm, &[0.0; 3], &push).unwrap_err(), Unstable);
        let nan = Vector6::repeat(f64::MAX);
        assert_eq!(equilibrium(&arm, &[0.0; 3], &nan).unwrap_err(), Unstable);
    }

    #[test]
    fn an_arm_without_joints_stands_still() {
        let mut arm = springy();
        arm.joints.clear();
        let state = equilibrium(&arm, &[], &Vector6::repeat(10.0)).unwrap();
        assert_eq!(state.tool, arm.tool);
    }

    #[test]
    fn a_marker_turns_with_the_tool() {
        let arm = springy();
        let mut row = crate::fixture::row(&[0.3, -0.7, 0.4], Vector6::zeros());
        row.offset = Some([0.0, 0.1, 0.2]);
        let kind = Kind::Pose { orientation: true };
        let sim = simulate(&arm, &row, kind).unwrap();
        let want = sim.loaded.tool * nalgebra::Point3::new(0.0, 0.1, 0.2);
        assert_eq!(sim.reading().position, want.coords);
    }
}
