//! Logs: the plant on its motion, and how large an effect is in multiples of the noise.

use std::cmp::Ordering;

use nalgebra::{Matrix3, Vector3};

use super::report::{Case, Named, Residual, Verdict};
use super::rigid::Rigid;
use super::run::{self, Planted, known_to};
use super::{Kind, Motion, Plan, WithholdError};
use crate::effects::{Catalogue, Place, Spot};
use crate::log::{Domain, Log, LogDiagnosis, LogOptions, diagnose};
use crate::plant::course::Course;
use crate::plant::motion::{Law, Logged, MotionError, MotionTruth, MovingPlant, known};
use crate::rng::Rng;

/// An effect of which other masses can do all but this part does not show.
const APART: f64 = 0.1;

/// Nothing is made larger than this part of what a joint's drive gives: it would be another arm.
const LARGEST: f64 = 1.0;

/// A drive that bends farther than this under what it gives, rad or m, is none that a controller of
/// encoders holds.
const BENT: f64 = 0.02;

/// Everything that cases share.
pub(super) struct Bench<'a> {
    plan: &'a Plan<'a>,
    own: &'a Motion<'a>,
    /// Of each run, what the arm of the file would tell.
    nominal: Vec<Vec<Vec<f64>>>,
    rigid: Rigid,
    /// Spread of what each joint tells, in its noise.
    spread: f64,
    /// Largest rate of each joint.
    rates: Vec<f64>,
}

impl<'a> Bench<'a> {
    pub(super) fn new(plan: &'a Plan<'a>, own: &'a Motion<'a>) -> Result<Bench<'a>, WithholdError> {
        let nominal = exact(plan, own, &[])?;
        let n = plan.arm.dof();
        let spread = |j: usize| {
            let values: Vec<f64> = nominal.iter().flat_map(|run| run[j].iter().copied()).collect();
            crate::plant::motion::spread(&values)
        };
        let noise: Vec<f64> = (0..n)
            .map(|j| match own.logged {
                Logged::Torque(_) => own.recording.torque * spread(j),
                Logged::Position => own.recording.reading,
            })
            .collect();
        if noise.iter().any(|size| *size <= 0.0) {
            let what = if own.logged == Logged::Position { "reading" } else { "torque" };
            return Err(WithholdError::NoNoise { what });
        }
        let courses: Vec<&dyn Course> = own.stages.iter().map(|stage| stage.course).collect();
        // The links are fitted along, unless the diagnosis is told that the file's masses are theirs.
        let weighed = plan.arm.joints.iter().any(|joint| joint.mass != 0.0);
        let known = own.options.known_links && weighed;
        let free = own.logged != Logged::Position && !known;
        let rates = (0..n).map(|j| fastest(&courses, j)).collect();
        let largest = (0..n).map(|j| spread(j) / noise[j]).fold(0.0, f64::max);
        let rigid = Rigid::of(plan.arm, &courses, &noise, free);
        Ok(Bench { plan, own, nominal, rigid, spread: largest, rates })
    }

    /// Where an effect may be put. Of runs only those that are told to hold something may hold more, and
    /// what acts at rest too acts where it does at rest: nobody balances a joint that no weight turns.
    fn spots(&self, law: &Law) -> Vec<Spot> {
        let (arm, stages) = (self.plan.arm, self.own.stages);
        let mut spots = law.spots(arm, stages.len());
        let at_rest = Catalogue::default().named(law.name).map(|effect| effect.places(arm));
        spots.retain(|spot| match spot.place {
            Place::Held(run) => stages[run - 1].payload.is_some(),
            Place::Joint(_) => at_rest
                .as_ref()
                .is_none_or(|places| places.iter().any(|place| place.row() == spot.row())),
            _ => true,
        });
        spots
    }

    fn plant_at(
        &self,
        law: &'static Law,
        spot: Spot,
        multiple: f64,
        rng: &mut Rng,
    ) -> Option<(MotionTruth, f64)> {
        let mut truth = MotionTruth { law, spot, values: self.draw(law, spot, rng) };
        let (mut found, mut all) = (0.0, 0.0);
        // What is no multiple of its size comes close in a few steps.
        for _ in 0..6 {
            [all, found] = self.sizes(&truth).ok()?;
            if found.partial_cmp(&(APART * all)) != Some(Ordering::Greater) {
                return None;
            }
            let off = multiple / found;
            if (off - 1.0).abs() < 0.05 {
                break;
            }
            for ((name, _), value) in law.numbers.iter().zip(&mut truth.values) {
                *value *= if is_form(law, name) { 1.0 } else { off };
            }
        }
        let close = (found / multiple - 1.0).abs() < 0.2 && all <= LARGEST * self.spread;
        (close && self.is_feasible(&truth)).then_some((truth, found))
    }

    /// Whether there is such a thing: gears that give way little and do not hold themselves, iron that
    /// saturates by less than what is given, friction that is there at the end.
    fn is_feasible(&self, truth: &MotionTruth) -> bool {
        let Some(joint) = truth.spot.joint() else { return true };
        let given = self.nominal.iter().flat_map(|run| &run[joint]);
        let given = given.fold(0.0_f64, |most, x| most.max(x.abs()));
        let size = truth.values[0].abs();
        let longest = self.own.stages.iter().map(|stage| stage.course.duration());
        match truth.law.name {
            "joint_elasticity" => size * given < BENT && self.is_held(truth),
            "load_friction" | "torque_scale" => size < 1.0,
            // What is more is read as meant before any effect.
            "joint_offset" => size < 0.25,
            "torque_saturation" => size * given < 1.0,
            "warm_up" => size * longest.fold(0.0, f64::max) / 60.0 < 1.0,
            _ => true,
        }
    }

    /// Whether the controller holds such an arm: what gives lies between its encoders and the links.
    fn is_held(&self, truth: &MotionTruth) -> bool {
        let truths = core::slice::from_ref(truth);
        let plant = plant(self.plan, self.own, truths);
        plant.and_then(|plant| plant.record(self.own.stages, self.plan.seed)).is_ok()
    }

    fn sizes(&self, truth: &MotionTruth) -> Result<[f64; 2], MotionError> {
        let mut changed = exact(self.plan, self.own, core::slice::from_ref(truth))?;
        for (changed, nominal) in changed.iter_mut().zip(&self.nominal) {
            for (changed, nominal) in changed.iter_mut().zip(nominal) {
                changed.iter_mut().zip(nominal).for_each(|(c, n)| *c -= n);
            }
        }
        Ok(self.rigid.sizes(&changed, self.own.recording.rate))
    }

    /// Numbers of chance, of which the size is made right afterwards.
    fn draw(&self, law: &Law, spot: Spot, rng: &mut Rng) -> Vec<f64> {
        let joints = spot.pair().unwrap_or([spot.joint().unwrap_or(0); 2]);
        let fastest = joints.map(|j| self.rates[j]).into_iter().fold(0.0, f64::max);
        let drives = joints.map(|j| &self.plan.arm.joints[j].drive);
        let rotor = drives.map(|d| d.gear * d.gear * d.rotor_inertia);
        if matches!(spot.place, Place::Link(_) | Place::Held(_)) {
            return body(1.0, 0.15 * rng.normal3());
        }
        let mut number = |name: &str| match name {
            // A film of grease has built up well below the largest rate.
            "speed" => fastest * rng.between(0.03, 0.1),
            // Gears and grease yield by some milliradians.
            "distance" => rng.between(0.005, 0.02),
            // Teeth of a gear and poles of a motor.
            "order" => rng.between(20.0, 200.0).round(),
            "viscous" if law.name == "joint_coupling" => 1.0 / fastest,
            // No motor drives two joints that do not feel it each as their own.
            "inertia" if law.name == "joint_coupling" => 0.5 * rotor[0].min(rotor[1]),
            "inertia" if law.name == "tracking_lag" => 0.02,
            // Friction falls while it warms, and is there to fall.
            "rate" => -0.1,
            "compliance" => 1e-5,
            "delay" => 0.01,
            "part" => 1e-2,
            "cos" | "sin" | "rx" | "ry" | "rz" => 0.1 * rng.normal(),
            "offset" | "half_difference" | "scale" => 0.1 * rng.sign(),
            _ => 1.0,
        };
        law.numbers.iter().map(|(name, _)| number(name)).collect()
    }

    /// The log as a file.
    fn text(&self, truths: &[MotionTruth], seed: u64) -> Result<String, MotionError> {
        plant(self.plan, self.own, truths)?.text(self.own.stages, seed)
    }

    /// What the diagnosis says of a file.
    fn diagnosed(&self, text: &str, options: &LogOptions) -> Result<Verdict, String> {
        let arm = self.plan.arm;
        let log = Log::of_arm(arm, "withheld", text).map_err(|error| error.to_string())?;
        let found = diagnose(arm, &log, options);
        Ok(Verdict::of_log(&found.map_err(|error| error.to_string())?))
    }

    /// The plan's options of the diagnosis, as the case has them.
    fn options(&self, seed: u64, case: &Case) -> LogOptions {
        let options = self.own.options.clone();
        let known = options.catalogue.iter().map(|effect| effect.identifier());
        let effects = known_to(case, known, options.effects.as_ref());
        let of_position = (self.own.logged == Logged::Position).then_some(Domain::Position);
        LogOptions { seed, effects, rows: of_position.or(options.rows), ..options }
    }
}

impl run::Bench for Bench<'_> {
    type Effect = &'static Law;
    type Truth = MotionTruth;

    /// Of every twenty cases five are without an effect, twelve with one, and three with one that
    /// the diagnosis does not know.
    const TURNS: [Kind; 20] = {
        use Kind::{None as N, Removed as R, Single as S};
        [S, N, S, R, S, S, N, S, S, N, S, R, S, N, S, S, R, S, N, S]
    };

    fn effects(&self) -> Vec<&'static Law> {
        let shows = |law: &&Law| law.rows.contains(&self.own.logged.rows());
        self.own.effects.iter().copied().filter(shows).collect()
    }

    fn identifier(law: &'static Law) -> &'static str {
        law.name
    }

    /// Beyond what other masses could do.
    fn plant(
        &self,
        law: &'static Law,
        multiple: f64,
        rng: &mut Rng,
    ) -> Option<Planted<MotionTruth>> {
        let mut spots = self.spots(law);
        rng.shuffle(&mut spots);
        let (truth, multiple) =
            spots.into_iter().find_map(|spot| self.plant_at(law, spot, multiple, rng))?;
        let label = Named::new(law.name, &truth.spot);
        Some(Planted { truth, label, multiple })
    }

    fn judge(
        &self,
        truths: &[MotionTruth],
        seed: u64,
        case: &mut Case,
    ) -> Result<(), WithholdError> {
        let options = self.options(seed, case);
        if case.kind == Kind::Removed {
            case.without = self.diagnosed(&self.text(&[], seed)?, &options).ok();
        }
        match self.diagnosed(&self.text(truths, seed)?, &options) {
            Ok(verdict) => case.verdict = Some(verdict),
            Err(error) => case.error = Some(error),
        }
        Ok(())
    }
}

impl Verdict {
    /// Of a diagnosis of a log.
    pub fn of_log(found: &LogDiagnosis) -> Verdict {
        let left = found.gap.iter().map(|g| g.after / g.size).sum::<f64>();
        let depends = found.unexplained.depends_on.iter();
        Verdict {
            sets: found.findings.iter().map(Named::set).collect(),
            unexplained: found.unexplained.present,
            unexplained_places: depends.map(|on| on.place.clone()).collect(),
            residual: Residual::Log {
                left: left / found.gap.len() as f64,
                after: found.gap.iter().map(|gap| gap.after).collect(),
            },
        }
    }
}

/// The ten numbers of a point mass.
fn body(mass: f64, at: Vector3<f64>) -> Vec<f64> {
    let second = Matrix3::identity() * at.norm_squared() - at * at.transpose();
    let [x, y, z] = at.into();
    let second = [(0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2)].map(|at| second[at]);
    [1.0, x, y, z].into_iter().chain(second).map(|number| mass * number).collect()
}

/// Numbers that do not grow with the size.
fn is_form(law: &Law, name: &str) -> bool {
    law.is_form(name) || (law.name == "joint_coupling" && name == "inertia")
}

/// The arm with some truths and those that the robot file knows.
fn plant<'p>(
    plan: &Plan<'p>,
    own: &Motion<'_>,
    truths: &[MotionTruth],
) -> Result<MovingPlant<'p>, MotionError> {
    let known = known(&own.options.known, plan.arm, own.stages.len(), own.logged);
    let known = known
        .map_err(|error| MotionError { arm: plan.arm.name.clone(), fault: error.to_string() })?;
    let all = [&known, truths].concat();
    Ok(MovingPlant::new(plan.arm, &all, own.logged, own.recording))
}

fn exact(
    plan: &Plan<'_>,
    own: &Motion<'_>,
    truths: &[MotionTruth],
) -> Result<Vec<Vec<Vec<f64>>>, MotionError> {
    let plant = plant(plan, own, truths)?;
    own.stages.iter().enumerate().map(|(k, stage)| plant.exact(k, stage)).collect()
}

fn fastest(courses: &[&dyn Course], joint: usize) -> f64 {
    let rates = courses.iter().flat_map(|course| {
        (0..500).map(move |k| course.at(course.duration() * f64::from(k) / 500.0).qd[joint])
    });
    rates.fold(0.0, |most: f64, rate| most.max(rate.abs()))
}
