//! What the effects of a log see: the motion, and the rows in which it is told.
//!
//! A row is a joint at a time. Of torque rows the gap is what drives the joint, less what the rigid
//! links ask; of position rows it is where the joint is, less where it was to be.

use std::cell::OnceCell;

use nalgebra::Vector3;
use stiffarm_kernels::generic::Arm;

use super::read::TorqueSide;
use super::rigid::works::Works;
use crate::signal::Signals;

/// What the rows are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
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

    /// With so many times another.
    pub fn plus(mut self, times: f64, other: &Column) -> Column {
        for (joint, rows) in &other.parts {
            match self.parts.iter_mut().find(|(on, _)| on == joint) {
                Some((_, to)) => to.iter_mut().zip(rows).for_each(|(x, row)| *x += times * row),
                None => self.parts.push((*joint, rows.iter().map(|row| times * row).collect())),
            }
        }
        self
    }
}

/// What a model asks of each joint's drive at every fine sample, in the unit of the rows, and how late it has
/// servos follow. Not what was measured: a torque always explains itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Loads {
    /// Its rigid links.
    pub rigid: Vec<Vec<f64>>,
    /// Its Coulomb and viscous friction.
    pub friction: Vec<Vec<f64>>,
    /// The load that is known to be on the last link, which is among them.
    pub known: Vec<Vec<f64>>,
    /// Numbers of the links, ten each, that ask the same as the rigid links.
    pub numbers: Vec<f64>,
    /// How late commands are followed, s; of position rows.
    pub delay: f64,
}

/// A log as the effects see it.
#[derive(Debug)]
pub struct Scene<'a> {
    /// The arm of the robot file.
    pub arm: &'a Arm,
    /// Even and band-limited.
    pub signals: &'a Signals,
    /// What the rows are.
    pub domain: Domain,
    /// Where the torque is measured; `None` of position rows.
    pub side: Option<TorqueSide>,
    /// What a simple model asks of the drives: rigid links, Coulomb and viscous friction; and a servo's delay.
    pub loads: &'a Loads,
    /// Speeds below which a joint counts as standing, one per joint, rad/s or m/s.
    pub still: &'a [f64],
    /// Ripples of each joint that stand out, in periods per radian or metre.
    pub ripples: &'a [Vec<f64>],
    /// What each run carries, by its name; `None` is nothing.
    pub payloads: &'a [Option<String>],
    weights: OnceCell<[Vec<Vec<f64>>; 4]>,
}

impl<'a> Scene<'a> {
    /// Of some signals.
    pub fn new(
        arm: &'a Arm,
        signals: &'a Signals,
        (domain, side): (Domain, Option<TorqueSide>),
        loads: &'a Loads,
        still: &'a [f64],
        ripples: &'a [Vec<f64>],
        payloads: &'a [Option<String>],
    ) -> Self {
        let weights = OnceCell::new();
        Scene { arm, signals, domain, side, loads, still, ripples, payloads, weights }
    }

    /// What the weights of the robot file do to each joint, N·m or N, at the rows; then what they do
    /// per radian by which the base is turned about its own x, y and z.
    pub fn weights(&self) -> &[Vec<Vec<f64>>; 4] {
        self.weights.get_or_init(|| {
            let gravity = self.arm.gravity;
            // The base that turns is gravity that turns the other way.
            let turned = |axis: Vector3<f64>| gravity.cross(&axis);
            let rows: Vec<Vec<f64>> = self.signals.q.iter().map(|q| self.signals.kept(q)).collect();
            let axes = [Vector3::x(), Vector3::y(), Vector3::z()].map(turned);
            [gravity, axes[0], axes[1], axes[2]].map(|gravity| {
                let arm = Arm { gravity, ..self.arm.clone() };
                if gravity == Vector3::zeros() {
                    return vec![vec![0.0; self.signals.rows()]; arm.dof()];
                }
                let mut weights = vec![Vec::with_capacity(self.signals.rows()); arm.dof()];
                for k in 0..self.signals.rows() {
                    let q: Vec<f64> = rows.iter().map(|q| q[k]).collect();
                    let torques = arm.weight_torque(&q);
                    weights.iter_mut().zip(torques.iter()).for_each(|(of, x)| of.push(*x));
                }
                weights
            })
        })
    }

    /// What the rigid links ask of all joints less, per unit, if a joint's acceleration, rate and value are less by as many
    /// times these: at the fine samples, from `by` of it.
    pub fn when_moved(&self, joint: usize, by: f64, less: &[Vec<f64>; 3]) -> Vec<Vec<f64>> {
        let (signals, n) = (self.signals, self.arm.dof());
        let mut change = vec![Vec::with_capacity(signals.t.len()); n];
        if by == 0.0 || self.loads.numbers.is_empty() {
            return vec![vec![0.0; signals.t.len()]; n];
        }
        let works = Works::of(self.arm);
        let mut motion = [(); 3].map(|()| vec![0.0; n]);
        for k in 0..signals.t.len() {
            for (at, of) in motion.iter_mut().zip([&signals.q, &signals.qd, &signals.qdd]) {
                at.iter_mut().zip(of).for_each(|(at, joint)| *at = joint[k]);
            }
            let [acceleration, rate, value] = less;
            for (at, less) in motion.iter_mut().zip([value, rate, acceleration]) {
                at[joint] -= by * less[k];
            }
            let asks = works.torques(motion.each_ref().map(Vec::as_slice), &self.loads.numbers);
            for ((to, asks), load) in change.iter_mut().zip(asks).zip(&self.loads.rigid) {
                to.push((asks - load[k]) / by);
            }
        }
        change
    }

    /// The column of all joints, of what each is at the fine samples.
    pub fn of_all(&self, fine: &[Vec<f64>]) -> Column {
        let rows = fine.iter().map(|fine| self.signals.filtered(fine));
        Column { parts: rows.enumerate().collect() }
    }

    /// The column of one joint, of what a fine sample is.
    pub fn column(&self, joint: usize, of: impl Fn(usize) -> f64) -> Column {
        let fine: Vec<f64> = (0..self.signals.t.len()).map(of).collect();
        Column::of(joint, self.signals.filtered(&fine))
    }

    /// The column of one joint of what does nothing there: a log of a million samples has many.
    pub fn nothing(&self, joint: usize) -> Column {
        Column::of(joint, vec![0.0; self.signals.rows()])
    }

    /// A joint's commands of so long ago, by straight lines; at the beginning of a span its first.
    pub fn ago(&self, joint: usize, delay: f64) -> Vec<f64> {
        let commands = &self.signals.command[joint];
        let back = delay / self.signals.period;
        let mut then = Vec::with_capacity(commands.len());
        for span in &self.signals.spans {
            let part = &commands[span.fine.clone()];
            let last = (part.len() - 1) as f64;
            then.extend((0..part.len()).map(|k| {
                let at = (k as f64 - back).clamp(0.0, last);
                let (before, within) = (at.floor() as usize, at.fract());
                let after = (before + 1).min(part.len() - 1);
                part[before] + within * (part[after] - part[before])
            }));
        }
        then
    }

    /// Which way a joint moves at a fine sample.
    pub fn sign(&self, joint: usize, k: usize) -> f64 {
        self.signals.sign(&self.signals.qd[joint], k)
    }

    /// What friction and rotor of the robot file ask of a drive at a fine sample, where the torque is
    /// one that has them in it.
    pub fn modelled(&self, joint: usize, k: usize) -> f64 {
        if !self.side.is_some_and(TorqueSide::is_driven) {
            return 0.0;
        }
        let (drive, signals) = (&self.arm.joints[joint].drive, self.signals);
        let rotor = drive.gear * drive.gear * drive.rotor_inertia * signals.qdd[joint][k];
        rotor + drive.viscous * signals.qd[joint][k] + drive.coulomb * self.sign(joint, k)
    }

    /// What is to be explained.
    pub fn target(&self) -> Column {
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
        Column { parts: (0..signals.joints()).map(|joint| (joint, of(joint))).collect() }
    }
}
