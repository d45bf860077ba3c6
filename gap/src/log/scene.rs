//! What the effects of a log see: the motion, and the rows in which it is told.
//!
//! A row is a joint at a time. Of torque rows the gap is what drives the joint, less what the rigid
//! links ask; of position rows it is where the joint is, less where it was to be.

use stiffarm_kernels::generic::Arm;

use super::read::TorqueSide;
use super::signal::Signals;

/// What the rows are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Domain {
    /// Torques, forces or currents of the joints.
    Torque,
    /// Measured less commanded joint values.
    Position,
}

/// Something at every row of some joints.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Column {
    /// A joint and its rows.
    pub parts: Vec<(usize, Vec<f64>)>,
}

impl Column {
    /// Of one joint.
    pub fn of(joint: usize, rows: Vec<f64>) -> Column {
        Column { parts: vec![(joint, rows)] }
    }
}

/// What a model asks of each joint's drive, N·m or N, at the rows. Not what was measured: a torque always
/// explains itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Loads {
    /// Its rigid links.
    pub rigid: Vec<Vec<f64>>,
    /// The whole model.
    pub whole: Vec<Vec<f64>>,
}

/// A log as the effects see it.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// The arm of the robot file.
    pub arm: &'a Arm,
    /// Even and band-limited.
    pub signals: &'a Signals,
    /// What the rows are.
    pub domain: Domain,
    /// Where the torque is measured; `None` of position rows.
    pub side: Option<TorqueSide>,
    /// What the weights of the robot file do to each joint, N·m or N, at the rows.
    pub weights: &'a [Vec<f64>],
    /// What the model so far asks of the drives.
    pub loads: &'a Loads,
    /// Speeds below which a joint counts as standing, one per joint, rad/s or m/s.
    pub still: &'a [f64],
}

/// What an arm's weights do to each joint, N·m or N, at the rows.
pub fn weights(arm: &Arm, signals: &Signals) -> Vec<Vec<f64>> {
    let rows: Vec<Vec<f64>> = signals.q.iter().map(|q| signals.kept(q)).collect();
    let mut weights = vec![Vec::with_capacity(signals.rows()); arm.dof()];
    for k in 0..signals.rows() {
        let q: Vec<f64> = rows.iter().map(|q| q[k]).collect();
        let torques = arm.weight_torque(&q);
        weights.iter_mut().zip(torques.iter()).for_each(|(of, torque)| of.push(*torque));
    }
    weights
}

impl Scene<'_> {
    /// The column of one joint, of what a fine sample is.
    pub fn column(&self, joint: usize, of: impl Fn(usize) -> f64) -> Column {
        let fine: Vec<f64> = (0..self.signals.t.len()).map(of).collect();
        Column::of(joint, self.signals.filtered(&fine))
    }

    /// Which way a joint moves at a fine sample.
    pub fn sign(&self, joint: usize, k: usize) -> f64 {
        self.signals.qd[joint][k].signum()
    }

    /// Which way each joint moved last, as soon as it moves; 0 before its first move. A joint that
    /// stands keeps its direction.
    pub fn last_way(&self, joint: usize) -> Vec<f64> {
        let mut ways = Vec::with_capacity(self.signals.t.len());
        for span in &self.signals.spans {
            let mut way = 0.0;
            for speed in &self.signals.qd[joint][span.fine.clone()] {
                if speed.abs() > self.still[joint] {
                    way = speed.signum();
                }
                ways.push(way);
            }
        }
        ways
    }

    /// Rows that count, of each joint: away from the ends of the filters, no contact, and for torques no standstill, where friction takes any
    /// value up to Coulomb's.
    pub fn rows(&self) -> Vec<Vec<bool>> {
        let touches = self.signals.kept(&self.signals.contact);
        let free = self.signals.settled().into_iter().zip(touches).map(|(s, touch)| s && !touch);
        let free: Vec<bool> = free.collect();
        let counts = |joint: usize| {
            let speeds = self.signals.kept(&self.signals.qd[joint]);
            let moves = |speed: f64| speed.abs() > self.still[joint];
            speeds
                .into_iter()
                .zip(&free)
                .map(|(speed, free)| *free && (self.domain == Domain::Position || moves(speed)))
                .collect()
        };
        (0..self.signals.joints()).map(counts).collect()
    }

    /// What friction and rotor of the robot file ask of a drive at a fine sample, where the torque is
    /// one that has them in it.
    fn modelled(&self, joint: usize, k: usize) -> f64 {
        if !matches!(self.side, Some(TorqueSide::Motor | TorqueSide::Commanded)) {
            return 0.0;
        }
        let (drive, signals) = (&self.arm.joints[joint].drive, self.signals);
        let rotor = drive.gear * drive.gear * drive.rotor_inertia * signals.qdd[joint][k];
        rotor + drive.viscous * signals.qd[joint][k] + drive.coulomb * self.sign(joint, k)
    }

    /// What is to be explained, of each joint.
    pub fn target(&self) -> Vec<Vec<f64>> {
        let signals = self.signals;
        let of = |joint: usize| match self.domain {
            Domain::Torque => {
                let given = signals.drive[joint].iter().enumerate();
                let left = given.map(|(k, torque)| torque - self.modelled(joint, k));
                signals.filtered(&left.collect::<Vec<f64>>())
            }
            Domain::Position => {
                let pairs = signals.measured[joint].iter().zip(&signals.command[joint]);
                let gaps: Vec<f64> = pairs.map(|(is, was_to_be)| is - was_to_be).collect();
                signals.filtered(&gaps)
            }
        };
        (0..signals.joints()).map(of).collect()
    }
}
