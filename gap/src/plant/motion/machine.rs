//! The real arm: links, drives, and motors that two joints share.

use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Vector3};
use stiffarm_kernels::generic::Arm;

use super::body::{Body, Piece};
use super::drive::{Bristles, Drive, Sliding};
use super::laws::Spot;
use super::truth::MotionTruth;

/// A motor that turns with two joints, as they feel it beside what is each one's own.
#[derive(Clone, Debug)]
struct Shared {
    joints: [usize; 2],
    /// 1 for their sum, −1 for their difference.
    sum: f64,
    inertia: f64,
    viscous: f64,
    /// A drive that has Coulomb friction alone.
    brake: Drive,
}

/// What does not change while the arm moves.
#[derive(Clone, Debug)]
pub(super) struct Machine {
    body: Body,
    pub(super) drives: Vec<Drive>,
    shared: Vec<Shared>,
    gravity: Vector3<f64>,
    /// By which torques are told late, or commands followed, s.
    pub(super) delay: f64,
    /// Of bristles before it moves, one for each joint, one for each shared motor.
    travel: Vec<f64>,
    of_shared: Vec<f64>,
    step: f64,
}

/// How an arm is.
#[derive(Clone, Debug)]
pub(super) struct Moving {
    pub(super) time: f64,
    pub(super) q: Vec<f64>,
    pub(super) qd: Vec<f64>,
    bristles: Vec<Bristles>,
    of_shared: Vec<Bristles>,
    /// What the links asked of the joints last.
    pub(super) loads: Vec<f64>,
}

impl Machine {
    /// The robot file's arm with these truths, to be followed in steps of so long.
    ///
    /// # Errors
    /// In words: a joint that moves no mass.
    pub(super) fn new(arm: &Arm, truths: &[MotionTruth], step: f64) -> Result<Machine, String> {
        let mut machine = Machine {
            body: Body::of(arm),
            drives: arm.joints.iter().map(Drive::of).collect(),
            shared: Vec::new(),
            gravity: arm.gravity,
            delay: 0.0,
            travel: Vec::new(),
            of_shared: Vec::new(),
            step,
        };
        truths.iter().for_each(|truth| machine.put(truth));
        machine.bristle()?;
        Ok(machine)
    }

    /// Holding something; its centre in the tool frame.
    pub(super) fn holding(mut self, mass: f64, com: Vector3<f64>) -> Machine {
        self.body.grip(&Piece::about(mass, com, Matrix3::zeros()));
        self
    }

    fn put(&mut self, truth: &MotionTruth) {
        match truth.spot {
            Spot::Joint(joint) => self.drives[joint].put(truth),
            Spot::Pair(a, b, sum) => self.shared.push(Shared {
                joints: [a, b],
                sum: f64::from(sum),
                inertia: truth.value("inertia"),
                viscous: truth.value("viscous"),
                brake: Drive::braked(truth.value("coulomb")),
            }),
            Spot::Link(link) => self.body.add(link, &body(truth)),
            // A machine is that of one run.
            Spot::Tool(_) => self.body.grip(&body(truth)),
            Spot::Arm => self.drives.iter_mut().for_each(|drive| drive.put(truth)),
            Spot::Base => {
                let turn = Vector3::from(["rx", "ry", "rz"].map(|name| truth.value(name)));
                self.gravity = Rotation3::from_scaled_axis(turn) * self.gravity;
            }
            Spot::Interface => self.delay += truth.value("delay"),
        }
    }

    /// Bristles that the steps can follow, by the inertias of a usual posture.
    fn bristle(&mut self) -> Result<(), String> {
        let usual = self.body.posture(&vec![0.7; self.drives.len()]);
        let masses = self.with_motors(self.body.masses(&usual));
        if masses.clone().cholesky().is_none() {
            return Err(
                "the arm's joints move no mass, or a motor that two share outweighs them: \
                        give its rows `mass`, `com` and `inertia`, or `rotor_inertia`"
                    .to_owned(),
            );
        }
        // What a joint feels where all others are free is the least that it does.
        let free = masses.try_inverse().unwrap_or_else(|| DMatrix::identity(1, 1));
        let inertia = |joint: usize| 1.0 / free[(joint, joint)];
        let drives = self.drives.iter().enumerate();
        self.travel = drives.map(|(j, drive)| drive.travel(inertia(j), self.step)).collect();
        let least = |s: &Shared| inertia(s.joints[0]).min(inertia(s.joints[1]));
        self.of_shared = self.shared.iter().map(|s| s.brake.travel(least(s), self.step)).collect();
        Ok(())
    }

    /// What accelerates beside the links.
    fn with_motors(&self, mut masses: DMatrix<f64>) -> DMatrix<f64> {
        for (j, drive) in self.drives.iter().enumerate() {
            masses[(j, j)] += drive.rotor;
        }
        for Shared { joints: [a, b], sum, inertia, .. } in &self.shared {
            masses[(*a, *b)] += sum * inertia;
            masses[(*b, *a)] += sum * inertia;
        }
        masses
    }

    /// At the start of a run.
    pub(super) fn at(&self, q: &[f64], qd: &[f64]) -> Moving {
        let way = |rate: f64| if rate == 0.0 { 0.0 } else { rate.signum() };
        let bristles = self.drives.iter().zip(qd).map(|(d, v)| Bristles::of(d, way(*v)));
        let still = vec![0.0; q.len()];
        Moving {
            time: 0.0,
            q: q.to_vec(),
            qd: qd.to_vec(),
            bristles: bristles.collect(),
            of_shared: self.shared.iter().map(|s| Bristles::of(&s.brake, 0.0)).collect(),
            loads: self.links(q, &still, &still),
        }
    }

    /// What the links ask of the joints.
    pub(super) fn links(&self, q: &[f64], qd: &[f64], qdd: &[f64]) -> Vec<f64> {
        self.body.torques(&self.body.posture(q), qd, qdd, &self.gravity)
    }

    /// What holds each joint back beside its links and rotors.
    fn held(&self, now: &Moving) -> Vec<f64> {
        let own = |(j, drive): (usize, &Drive)| {
            let at = Sliding { rate: now.qd[j], load: now.loads[j], time: now.time };
            drive.friction(at, &now.bristles[j]) + drive.springs(now.q[j])
        };
        let mut held: Vec<f64> = self.drives.iter().enumerate().map(own).collect();
        for (shared, bristles) in self.shared.iter().zip(&now.of_shared) {
            let [a, b] = shared.joints;
            let at = Sliding { rate: shared.rate(&now.qd), load: 0.0, time: now.time };
            let brake = shared.brake.friction(at, bristles);
            held[a] += brake + shared.sum * shared.viscous * now.qd[b];
            held[b] += shared.sum * (brake + shared.viscous * now.qd[a]);
        }
        held
    }

    /// What the motors give for accelerations.
    pub(super) fn needed(&self, now: &mut Moving, qdd: &[f64]) -> Vec<f64> {
        now.loads = self.links(&now.q, &now.qd, qdd);
        let mut torques = self.held(now);
        for ((torque, load), (drive, qdd)) in
            torques.iter_mut().zip(&now.loads).zip(self.drives.iter().zip(qdd))
        {
            *torque += load + drive.rotor * qdd;
        }
        for Shared { joints: [a, b], sum, inertia, .. } in &self.shared {
            torques[*a] += sum * inertia * qdd[*b];
            torques[*b] += sum * inertia * qdd[*a];
        }
        torques
    }

    /// The accelerations that torques of the motors bring about; none where a joint moves no mass.
    pub(super) fn driven(&self, now: &mut Moving, torques: &[f64]) -> Option<Vec<f64>> {
        let posture = self.body.posture(&now.q);
        let still = vec![0.0; now.q.len()];
        let bias = self.body.torques(&posture, &now.qd, &still, &self.gravity);
        let held = self.held(now);
        let free = torques.iter().zip(&bias).zip(&held).map(|((t, b), h)| t - b - h);
        let free = DVector::from_iterator(torques.len(), free);
        let links = self.body.masses(&posture);
        let solved = self.with_motors(links.clone()).cholesky()?.solve(&free);
        // What the links ask with it is the bias and their share of the inertias.
        now.loads = bias.iter().zip((links * &solved).iter()).map(|(b, l)| b + l).collect();
        Some(solved.iter().copied().collect())
    }

    /// Goes on by a step with these accelerations.
    pub(super) fn step(&self, now: &mut Moving, qdd: &[f64]) {
        for ((q, qd), qdd) in now.q.iter_mut().zip(&mut now.qd).zip(qdd) {
            *qd += qdd * self.step;
            *q += *qd * self.step;
        }
        self.bend(now, self.step);
    }

    /// Bends the bristles for so long at the rates that there are.
    pub(super) fn bend(&self, now: &mut Moving, step: f64) {
        now.time += step;
        for (j, bristles) in now.bristles.iter_mut().enumerate() {
            bristles.bend(&self.drives[j], self.travel[j], now.qd[j], step);
        }
        for ((shared, bristles), travel) in
            self.shared.iter().zip(&mut now.of_shared).zip(&self.of_shared)
        {
            bristles.bend(&shared.brake, *travel, shared.rate(&now.qd), step);
        }
    }

    /// What the weights ask of the joints at rest.
    pub(super) fn weights(&self, q: &[f64]) -> Vec<f64> {
        let still = vec![0.0; q.len()];
        self.links(q, &still, &still)
    }
}

/// The body that ten numbers say.
fn body(truth: &MotionTruth) -> Piece {
    let [xx, xy, xz, yy, yz, zz] =
        ["xx", "xy", "xz", "yy", "yz", "zz"].map(|name| truth.value(name));
    Piece {
        mass: truth.value("m"),
        first: Vector3::from(["mx", "my", "mz"].map(|name| truth.value(name))),
        second: Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
    }
}

impl Shared {
    fn rate(&self, qd: &[f64]) -> f64 {
        let [a, b] = self.joints;
        qd[a] + self.sum * qd[b]
    }
}
