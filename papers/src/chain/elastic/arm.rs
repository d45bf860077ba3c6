//! The elastic arm at rest under a load, and how its wrenches and its tip change with the joints.

use nalgebra::{Isometry3, Matrix6, Matrix6xX, Vector6};
use stiffarm_kernels::generic::Arm;

use super::Elasticity;
use super::dead;
use super::row::Row;
use crate::chain::product::between;
use crate::chain::transport::{along, stack, turning, twist_matrix, wrench_matrix};
use crate::chain::{ChainError, Displacement, Load, Response, Settled, settle, steps};

/// An arm whose joint springs and beams give way.
#[derive(Clone, Copy, Debug)]
pub struct ElasticArm<'a> {
    arm: &'a Arm,
    elasticity: Elasticity,
}

impl<'a> ElasticArm<'a> {
    /// The arm with the springs and beams of its table.
    pub fn new(arm: &'a Arm, elasticity: Elasticity) -> Self {
        Self { arm, elasticity }
    }

    /// The arm's table.
    pub fn arm(&self) -> &'a Arm {
        self.arm
    }

    /// The arm at the joint values `q`, not yet loaded.
    ///
    /// # Errors
    /// As [`steps`].
    pub fn posture(&self, q: &[f64]) -> Result<Posture, ChainError> {
        let steps = steps(self.arm, q)?;
        let rows = (0..q.len())
            .map(|i| Row::new(self.arm, i, q[i], &steps[i + 1], self.elasticity))
            .collect();
        Ok(Posture { steps, rows })
    }

    /// The arm at the joint values `q` at rest under `load`.
    ///
    /// # Errors
    /// As [`steps`]; [`ChainError::Link`] or [`ChainError::Load`] if there is no rest.
    pub fn settle(&self, q: &[f64], load: &Load) -> Result<Loaded, ChainError> {
        if !load.wrench().iter().all(|value| value.is_finite()) {
            return Err(ChainError::NotFinite { what: "a component of the load" });
        }
        let posture = self.posture(q)?;
        let settled = match load {
            Load::Follower(wrench) => posture.settle(wrench)?,
            Load::Dead(wrench) => dead::settle(&posture, wrench)?,
        };
        Ok(Loaded { posture, settled, load: *load })
    }
}

/// The places of an elastic arm at one set of joint values, for [`settle`].
#[derive(Clone, Debug)]
pub struct Posture {
    steps: Vec<Isometry3<f64>>,
    rows: Vec<Row>,
}

impl Posture {
    /// The nominal transforms, [`steps`].
    pub fn steps(&self) -> &[Isometry3<f64>] {
        &self.steps
    }

    /// What a place's spring and link do under the wrench `w` in its displaced frame. Nothing gives
    /// way at the base and the tool.
    ///
    /// # Errors
    /// [`ChainError::Link`].
    pub fn respond(&self, place: usize, w: &Vector6<f64>) -> Result<Response, ChainError> {
        match place.checked_sub(1).and_then(|row| self.rows.get(row)) {
            Some(row) => row.respond(w),
            None => Ok(Response::fixed(Isometry3::identity())),
        }
    }

    /// The arm under a wrench given in the displaced tool.
    pub(super) fn settle(&self, tip: &Vector6<f64>) -> Result<Settled, ChainError> {
        settle(&self.steps, tip, |place, w| self.respond(place, w))
    }
}

/// An elastic arm at rest.
#[derive(Clone, Debug)]
pub struct Loaded {
    posture: Posture,
    settled: Settled,
    load: Load,
}

impl Loaded {
    /// The chain at rest: wrenches, errors and frames of all places.
    pub fn chain(&self) -> &Settled {
        &self.settled
    }

    /// The displaced tool frame in the base frame, m.
    pub fn pose(&self) -> Isometry3<f64> {
        self.settled.pose()
    }

    /// `ᴮw = ᴮK_E ᴱw`: the tool's wrench in base axes about the base's origin, N and N·m (Bicchi &
    /// Melchiorri, eqs. 6, 7 and 18).
    pub fn base_wrench(&self) -> Vector6<f64> {
        self.settled.base_wrench()
    }

    /// The errors of all places.
    pub fn errors(&self) -> Vec<Displacement> {
        self.settled.responses().iter().map(|r| Displacement::of(&r.error)).collect()
    }

    /// From the nominal to the displaced tool: translation and rotation vector in base axes, at
    /// the tool origin, m and rad.
    pub fn deflection(&self) -> Vector6<f64> {
        let nominal = along(self.posture.steps.iter().copied());
        between(&nominal, &self.pose())
    }

    /// What loads each joint, N·m (N if prismatic), positive like the joint's motion: the paper's
    /// τ.
    ///
    /// # Errors
    /// [`ChainError::Link`], which an arm at rest does not give.
    pub fn joint_loads(&self) -> Result<Vec<f64>, ChainError> {
        let rows = self.posture.rows.iter().enumerate();
        rows.map(|(i, row)| row.joint_load(&self.wrench(i + 1))).collect()
    }

    /// The largest turn of one link's or joint's error, rad: what tells whether the links bend
    /// little. The displacement of a link with tip slope φ is off by about 0.4 φ of itself.
    pub fn largest_turn(&self) -> f64 {
        self.errors().iter().map(|error| error.rotation.norm()).fold(0.0, f64::max)
    }

    /// G with everything, 6×n: the change of [`Loaded::base_wrench`] per unit of each joint value,
    /// all deformations following. Column k is `(∏_{i<k} J_i) ∂w_{k−1}/∂q_k`, `J_i` the whole
    /// derivative `dw_{i−1}/dw_i`; under a dead load the wrench in the tool's own frame follows.
    ///
    /// # Errors
    /// [`ChainError::Link`], [`ChainError::Load`] where the arm is about to give way.
    pub fn wrench_jacobian(&self) -> Result<Matrix6xX<f64>, ChainError> {
        let (base, tip) = self.follower_jacobians()?;
        Ok(match self.follow(&tip)? {
            None => base,
            Some(change) => base + self.settled.base_rate() * change,
        })
    }

    /// G as the paper has it, 6×n: the deformations of all places stay as they are while one joint
    /// turns (its T_i, with the product from j = 1 and `∂K_{i,kin}/∂q_i`). Exact in column 1.
    pub fn frozen_wrench_jacobian(&self) -> Matrix6xX<f64> {
        let frames = self.settled.undisplaced();
        let rows = self.posture.rows.iter().enumerate();
        let columns: Vec<_> = rows
            .map(|(i, row)| {
                let turned = turning(&self.settled.nominal_wrench(i + 1)) * row.axis();
                wrench_matrix(&frames[i + 1]) * turned
            })
            .collect();
        gather(&columns)
    }

    /// Twist of the displaced tool, base axes, at its origin, per unit of each joint value, all
    /// deformations following, 6×n.
    ///
    /// # Errors
    /// As [`Loaded::wrench_jacobian`].
    pub fn tip_jacobian(&self) -> Result<Matrix6xX<f64>, ChainError> {
        let (_, tip) = self.follower_jacobians()?;
        Ok(match self.follow(&tip)? {
            None => tip,
            Some(change) => tip + self.settled.tip_rate() * change,
        })
    }

    /// Both Jacobians for a tool's wrench that stays as it is in the displaced tool.
    fn follower_jacobians(&self) -> Result<(Matrix6xX<f64>, Matrix6xX<f64>), ChainError> {
        let seen: Vec<Matrix6<f64>> =
            self.settled.seen_from_tip().iter().map(twist_matrix).collect();
        let (mut base, mut tip) = (Vec::new(), Vec::new());
        for (i, row) in self.posture.rows.iter().enumerate() {
            let place = i + 1;
            let twist = row.joint_rate(&self.wrench(place))?;
            let nominal = self.settled.nominal_wrench(place);
            let mut wrench =
                wrench_matrix(&self.posture.steps[place]) * (turning(&nominal) * twist);
            let mut moved = seen[place] * twist;
            for nearer in (0..place).rev() {
                moved += seen[nearer] * (self.settled.responses()[nearer].rate * wrench);
                wrench = self.settled.wrench_rate(nearer) * wrench;
            }
            base.push(wrench);
            tip.push(moved);
        }
        Ok((gather(&base), gather(&tip)))
    }

    /// How a dead load's wrench in the displaced tool changes with each joint value; `None` for a
    /// load that does not.
    fn follow(&self, tip: &Matrix6xX<f64>) -> Result<Option<Matrix6xX<f64>>, ChainError> {
        match self.load {
            Load::Follower(_) => Ok(None),
            Load::Dead(wrench) => {
                let turned = dead::spin(&wrench) * tip.fixed_rows::<3>(3);
                let solve = dead::balance(&self.settled).lu().solve(&-turned);
                solve.map(Some).ok_or(ChainError::Load)
            }
        }
    }

    fn wrench(&self, place: usize) -> Vector6<f64> {
        let none = stack(&nalgebra::Vector3::zeros(), &nalgebra::Vector3::zeros());
        self.settled.wrench(place).copied().unwrap_or(none)
    }
}

fn gather(columns: &[Vector6<f64>]) -> Matrix6xX<f64> {
    Matrix6xX::from_fn(columns.len(), |row, column| columns[column][row])
}
