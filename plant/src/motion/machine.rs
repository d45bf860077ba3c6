//! The real arm: links, drives, and motors that two joints share.

use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Vector3};
use stiffarm_kernels::generic::Arm;

use super::body::{Body, Piece};
use super::drive::{Drive, Memory, Sliding};
use super::stick::{Slider, braked};
use super::truth::MotionTruth;
use crate::effects::Place;

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
    step: f64,
}

/// How an arm is.
#[derive(Clone, Debug)]
pub(super) struct Moving {
    pub(super) time: f64,
    pub(super) q: Vec<f64>,
    pub(super) qd: Vec<f64>,
    /// Of the last step.
    qdd: Vec<f64>,
    /// Since when the rates are those, s: while it is driven they are told between steps.
    since: f64,
    /// Of each joint's drive, then of each shared motor.
    memories: Vec<Memory>,
    /// What the links asked of the joints last.
    pub(super) loads: Vec<f64>,
}

impl Machine {
    /// The robot file's arm with these truths, to be followed in steps of so long.
    ///
    /// # Errors
    /// In words: a joint that moves no mass, or friction that drives.
    pub(super) fn new(arm: &Arm, truths: &[MotionTruth], step: f64) -> Result<Machine, String> {
        let mut machine = Machine {
            body: Body::of(arm),
            drives: arm.joints.iter().map(Drive::of).collect(),
            shared: Vec::new(),
            gravity: arm.gravity,
            delay: 0.0,
            step,
        };
        truths.iter().for_each(|truth| machine.put(truth));
        machine.checked()?;
        Ok(machine)
    }

    /// Holding something; its centre in the tool frame.
    pub(super) fn holding(mut self, mass: f64, com: Vector3<f64>) -> Machine {
        self.body.grip(&Piece::about(mass, com, Matrix3::zeros()));
        self
    }

    fn put(&mut self, truth: &MotionTruth) {
        match truth.spot.place {
            Place::Joint(joint) => self.drives[joint - 1].put(truth),
            Place::Pair(a, b, sum) => self.shared.push(Shared {
                joints: [a - 1, b - 1],
                sum: f64::from(sum),
                inertia: truth.value("inertia"),
                viscous: truth.value("viscous"),
                brake: Drive::braked(truth.value("coulomb")),
            }),
            Place::Link(link) => self.body.add(link - 1, &body(truth)),
            // A machine is that of one run.
            Place::Held(_) | Place::Tool => self.body.grip(&body(truth)),
            Place::Arm => self.drives.iter_mut().for_each(|drive| drive.put(truth)),
            Place::Base => {
                let turn = Vector3::from(["rx", "ry", "rz"].map(|name| truth.value(name)));
                self.gravity = Rotation3::from_scaled_axis(turn) * self.gravity;
            }
            Place::Interface | Place::Instrument => self.delay += truth.value("delay"),
        }
    }

    fn checked(&self) -> Result<(), String> {
        let usual = self.body.posture(&vec![0.7; self.drives.len()]);
        if self.with_motors(self.body.masses(&usual)).cholesky().is_none() {
            return Err(
                "the arm's joints move no mass, or a motor that two share outweighs them: \
                        give its rows `mass`, `com` and `inertia`, or `rotor_inertia`"
                    .to_owned(),
            );
        }
        let mut faults = self.drives.iter().enumerate();
        let fault = faults.find_map(|(j, drive)| Some((j + 1, drive.fault()?)));
        fault.map_or(Ok(()), |(joint, fault)| Err(format!("joint {joint}: {fault}")))
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
        let own = self.drives.iter().zip(qd).map(|(drive, rate)| Memory::of(drive, *rate));
        let shared = self.shared.iter().map(|s| Memory::of(&s.brake, s.rate(qd)));
        let still = vec![0.0; q.len()];
        Moving {
            time: 0.0,
            q: q.to_vec(),
            qd: qd.to_vec(),
            qdd: still.clone(),
            since: 0.0,
            memories: own.chain(shared).collect(),
            loads: self.links(q, &still, &still),
        }
    }

    /// What the links ask of the joints.
    pub(super) fn links(&self, q: &[f64], qd: &[f64], qdd: &[f64]) -> Vec<f64> {
        self.body.torques(&self.body.posture(q), qd, qdd, &self.gravity)
    }

    /// What holds each joint back beside its links and rotors and dry friction.
    fn held(&self, now: &Moving, rates: &[f64]) -> Vec<f64> {
        let own = |(j, drive): (usize, &Drive)| {
            drive.smooth(now.sliding(j, rates[j]), &now.memories[j]) + drive.springs(now.q[j])
        };
        let mut held: Vec<f64> = self.drives.iter().enumerate().map(own).collect();
        for Shared { joints: [a, b], sum, viscous, .. } in &self.shared {
            held[*a] += sum * viscous * rates[*b];
            held[*b] += sum * viscous * rates[*a];
        }
        held
    }

    /// What has dry friction: joints, then shared motors.
    fn sliders(&self, now: &Moving, rates: &[f64]) -> Vec<Slider> {
        let along = |of: &[(usize, f64)]| {
            let mut along = DVector::zeros(rates.len());
            of.iter().for_each(|(joint, times)| along[*joint] = *times);
            along
        };
        let own = self.drives.iter().enumerate().map(|(j, drive)| Slider {
            along: along(&[(j, 1.0)]),
            dry: drive.dry(now.sliding(j, rates[j])),
        });
        let shared = self.shared.iter().map(|shared| Slider {
            along: along(&[(shared.joints[0], 1.0), (shared.joints[1], shared.sum)]),
            dry: shared.brake.dry(Sliding { rate: shared.rate(rates), load: 0.0, time: now.time }),
        });
        own.chain(shared).collect()
    }

    /// What the motors give for accelerations.
    pub(super) fn needed(&self, now: &mut Moving, qdd: &[f64]) -> Vec<f64> {
        now.loads = self.links(&now.q, &now.qd, qdd);
        self.bend(now, 0.0);
        let mut torques = self.held(now, &now.qd);
        for (slider, memory) in self.sliders(now, &now.qd).iter().zip(&now.memories) {
            let dry = slider.against(memory.way);
            torques
                .iter_mut()
                .zip(&slider.along)
                .for_each(|(torque, along)| *torque += along * dry);
        }
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

    /// The accelerations that torques of the motors bring about; none where a joint moves no mass. Rates
    /// are those between steps: what goes with them asks them as they are by now.
    pub(super) fn driven(&self, now: &mut Moving, torques: &[f64]) -> Option<Vec<f64>> {
        let posture = self.body.posture(&now.q);
        let still = vec![0.0; now.q.len()];
        let rates: Vec<f64> =
            now.qd.iter().zip(&now.qdd).map(|(qd, qdd)| qd + now.since * qdd).collect();
        let bias = self.body.torques(&posture, &rates, &still, &self.gravity);
        let held = self.held(now, &rates);
        let free = torques.iter().zip(&bias).zip(&held).map(|((t, b), h)| t - b - h);
        let free = DVector::from_iterator(torques.len(), free);
        let links = self.body.masses(&posture);
        let inverse = self.with_motors(links.clone()).cholesky()?.inverse();
        let sliders = self.sliders(now, &rates);
        let before = DVector::from_column_slice(&now.qd);
        let span = now.since + 0.5 * self.step;
        let solved = braked(&sliders, &inverse, &before, &inverse * free, span)?;
        // What the links ask with it is the bias and their share of the inertias.
        now.loads = bias.iter().zip((links * &solved).iter()).map(|(b, l)| b + l).collect();
        Some(solved.iter().copied().collect())
    }

    /// Goes on by a step with these accelerations (leapfrog: Störmer 1907, Verlet 1967).
    pub(super) fn step(&self, now: &mut Moving, qdd: &[f64]) {
        for ((q, qd), qdd) in now.q.iter_mut().zip(&mut now.qd).zip(qdd) {
            *qd += qdd * (now.since + 0.5 * self.step);
            *q += *qd * self.step;
        }
        (now.qdd, now.since) = (qdd.to_vec(), 0.5 * self.step);
        self.bend(now, self.step);
    }

    /// Goes on for so long at the rates that there are: what drives remember.
    pub(super) fn bend(&self, now: &mut Moving, step: f64) {
        now.time += step;
        let own = self.drives.iter().zip(now.qd.iter().copied());
        let shared = self.shared.iter().map(|s| (&s.brake, s.rate(&now.qd)));
        for ((drive, rate), memory) in own.chain(shared).zip(&mut now.memories) {
            memory.bend(drive, rate, step);
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

impl Moving {
    fn sliding(&self, joint: usize, rate: f64) -> Sliding {
        Sliding { rate, load: self.loads[joint], time: self.time }
    }
}
