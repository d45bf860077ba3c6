//! From a log to what is said of it.

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::effects::{CATALOGUE, LogEffect, Spot};
use super::options::{LogOptions, Refused};
use super::read::{Log, TorqueSide};
use super::report::{
    Alternative, Evidence, Filter, Finding, Hidden, JointGap, LogDiagnosis, Parameter,
};
use super::rigid::{Base, regressor};
use super::scene::{Column, Domain, Loads, Scene, weights};
use super::search::blocks::LEAST;
use super::search::fit::{Problem, Term};
use super::search::judge::{Judged, Unseen, Verdict, judged};
use super::search::{self, Round, effective};
use super::signal::Signals;

/// A joint that is slower than this part of its largest speed counts as standing.
const STILL: f64 = 0.005;

/// Why a log brings the gap that it has: which effects at which places, one after the other, and how far
/// it shrinks with them on time that no fit has seen.
///
/// # Errors
/// [`Refused`]: what in the log or the options stands in the way.
pub fn diagnose(arm: &Arm, log: &Log, options: &LogOptions) -> Result<LogDiagnosis, Refused> {
    let (domain, drive, side) = options.rows_of(log)?;
    options.checked(log.period())?;
    let signals = Signals::of(log, drive, options.band);
    let (found, expected) =
        (signals.rows() as f64 * signals.step(), 2.0 * LEAST as f64 * signals.reach());
    if found < expected {
        return Err(Refused::TooShort { file: log.files.join(", "), found, expected });
    }
    let fastest = |v: &Vec<f64>| v.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let still = |v: &Vec<f64>| options.standstill.unwrap_or(STILL * fastest(v));
    let still: Vec<f64> = signals.qd.iter().map(still).collect();
    let weights = match domain {
        Domain::Position => weights(arm, &signals),
        Domain::Torque => Vec::new(),
    };
    let nothing = vec![vec![0.0; signals.rows()]; signals.joints()];
    let loads = Loads { rigid: nothing.clone(), whole: nothing };
    let (weights, still, loads, signals) = (&weights[..], &still[..], &loads, &signals);
    let scene = Scene { arm, signals, domain, side, weights, loads, still };
    let base = if domain == Domain::Torque { rigid_columns(arm, signals) } else { Vec::new() };
    let problem = Problem { scene, target: scene.target(), counts: scene.rows(), base };
    if let Some(joint) = problem.counts.iter().position(|c| !c.contains(&true)) {
        return Err(Refused::Still { file: log.files.join(", "), joint: joint + 1 });
    }
    let wanted = search::wanted(&problem, options.effects.as_deref());
    let told = Told { problem: &problem, arm, current: side == Some(TorqueSide::Current) };
    let (mut left, mut before, mut cannot_see) = (Vec::new(), Vec::new(), Vec::new());
    let last = search::search(&problem, &wanted, options.seed, &mut |round| {
        let unseen = Unseen::of(&problem, &round.fit, &round.state.sizes, &round.blocks).sizes();
        left.push(told.mean(&unseen));
        if before.is_empty() {
            (before, cannot_see) = (unseen, hidden(&scene, round));
        }
    });
    let verdict = judged(&problem, &last, &wanted, options.seed);
    let after = Unseen::of(&problem, &verdict.fit, &verdict.state.sizes, &verdict.blocks);
    let counted = problem.counts.iter().flatten().filter(|c| **c).count();
    let blocks = &verdict.blocks;
    Ok(LogDiagnosis {
        stiffarm: options.version.clone(),
        robot: arm.name.clone(),
        files: log.files.clone(),
        rows: domain,
        torque_side: side,
        runs: log.runs.len(),
        samples: log.samples,
        damaged: log.damaged.len(),
        filter: Filter {
            period: log.period(),
            band: signals.band,
            band_given: options.band.is_some(),
            standstill: still.to_vec(),
        },
        evidence: Evidence {
            effective: effective(&problem.counts, &verdict.correlation, signals),
            correlation_time: verdict.correlation.clone(),
            rows: counted,
            blocks: blocks.rows.len(),
            block_length: blocks.length,
            long_enough: blocks.long_enough,
            held_out_by: if blocks.by_run { "run" } else { "block" },
            folds: blocks.folds,
        },
        rigid_parameters: problem.base.len(),
        gap: told.gap(&before, &after.sizes()),
        findings: told.findings(&last.fit.terms, &left, &verdict, &after),
        cannot_see,
        remarks: log.remarks(),
    })
}

/// What a unit of each base parameter asks of the joints.
fn rigid_columns(arm: &Arm, signals: &Signals) -> Vec<Column> {
    let (n, base) = (arm.dof(), Base::of(arm));
    let fine = signals.t.len();
    let at = |of: &[Vec<f64>], k: usize| of.iter().map(|x| x[k]).collect::<Vec<f64>>();
    let mut columns: Vec<Vec<Vec<f64>>> =
        base.columns.iter().map(|c| vec![Vec::with_capacity(fine); c / 10 + 1]).collect();
    for k in 0..fine {
        let rows = regressor(arm, &at(&signals.q, k), &at(&signals.qd, k), &at(&signals.qdd, k));
        for (column, index) in columns.iter_mut().zip(&base.columns) {
            // A link's inertia is felt by its own joint and those below.
            for (joint, values) in column.iter_mut().enumerate() {
                values.push(rows[joint * 10 * n + index]);
            }
        }
    }
    let filtered = |joints: Vec<Vec<f64>>| Column {
        parts: joints.iter().map(|values| signals.filtered(values)).enumerate().collect(),
    };
    columns.into_iter().map(filtered).collect()
}

/// How numbers are told.
struct Told<'a> {
    problem: &'a Problem<'a>,
    arm: &'a Arm,
    current: bool,
}

impl Told<'_> {
    /// What a joint's gap is measured in.
    fn gap_unit(&self, joint: usize) -> &'static str {
        match (self.problem.scene.domain, self.arm.joints[joint].motion) {
            (Domain::Torque, _) if self.current => "A",
            (Domain::Torque, Motion::Revolute) => "N·m",
            (Domain::Torque, Motion::Prismatic) => "N",
            (Domain::Position, Motion::Revolute) => "rad",
            (Domain::Position, Motion::Prismatic) => "m",
        }
    }

    /// The unit of an effect's number at a spot.
    fn unit(&self, unit: &str, spot: Spot) -> String {
        let slides = match spot {
            Spot::Joint(joint) | Spot::Pair(joint, _, _) => {
                self.arm.joints[joint].motion == Motion::Prismatic
            }
            Spot::Interface => false,
        };
        let unit = match (slides, unit) {
            (true, "kg·m²") if !self.current => "kg".to_owned(),
            (true, unit) => unit.replace("N·m", "N").replace("rad", "m"),
            (false, unit) => unit.to_owned(),
        };
        match (self.current, unit.as_str()) {
            (false, _) => unit,
            (true, "kg·m²") => "A·s²/rad".to_owned(),
            (true, unit) => unit.replace("N·m", "A").replace('N', "A"),
        }
    }

    /// Sizes of the joints' torques, or of their position errors.
    fn sizes(&self) -> Vec<f64> {
        if self.problem.scene.domain == Domain::Position {
            return self.problem.sizes(&self.problem.target);
        }
        let about = |(rows, counts): (&Vec<f64>, &Vec<bool>)| {
            let used = || rows.iter().zip(counts).filter(|(_, c)| **c).map(|(x, _)| *x);
            let mean = used().sum::<f64>() / used().count().max(1) as f64;
            rows.iter().map(|x| x - mean).collect()
        };
        let pairs = self.problem.target.iter().zip(&self.problem.counts);
        self.problem.sizes(&pairs.map(about).collect::<Vec<Vec<f64>>>())
    }

    fn gap(&self, before: &[f64], after: &[f64]) -> Vec<JointGap> {
        let pairs = before.iter().zip(after).zip(self.sizes());
        let told = |(joint, ((before, after), size)): (usize, ((&f64, &f64), f64))| JointGap {
            unit: self.gap_unit(joint),
            size,
            before: *before,
            after: *after,
        };
        pairs.enumerate().map(told).collect()
    }

    /// Mean over the joints of what is left, as a part of their sizes.
    fn mean(&self, left: &[f64]) -> f64 {
        let parts = left.iter().zip(self.sizes()).map(|(left, whole)| left / whole);
        parts.sum::<f64>() / left.len() as f64
    }

    /// Of the terms in the order in which they were `added`; `left` is what was left before each, and at
    /// the end.
    fn findings(
        &self,
        added: &[Term],
        left: &[f64],
        verdict: &Verdict,
        unseen: &Unseen,
    ) -> Vec<Finding> {
        let mut widths = unseen.half_widths[self.problem.base.len()..].iter();
        let tell = |judged: &Judged| {
            let term = &judged.term;
            let same =
                |t: &Term| t.effect.identifier() == term.effect.identifier() && t.spot == term.spot;
            let round = added.iter().position(same).unwrap_or(0);
            let numbers = term.effect.numbers().iter().zip(&term.values).zip(&mut widths);
            Finding {
                effect: term.effect.identifier(),
                place: term.spot.to_string(),
                parameters: numbers
                    .map(|(((name, unit), value), width)| Parameter {
                        name,
                        value: *value,
                        unit: self.unit(unit, term.spot),
                        ci95: [value - width, value + width],
                    })
                    .collect(),
                held_out_before: left[round],
                held_out_after: left[round + 1],
                p_value: judged.chance,
                alternatives: judged.rivals.iter().map(alternative).collect(),
                to_separate: (!judged.rivals.is_empty()).then(|| term.effect.about().separated_by),
            }
        };
        verdict.findings.iter().map(tell).collect()
    }
}

fn alternative((term, leaves): &(Term, f64)) -> Alternative {
    Alternative { effect: term.effect.identifier(), place: term.spot.to_string(), leaves: *leaves }
}

/// What this log cannot show.
fn hidden(scene: &Scene<'_>, first: &Round) -> Vec<Hidden> {
    let mut hidden = Vec::new();
    let mut tell = |effect: &'static str, place: String, reason: &str| {
        hidden.push(Hidden { effect, place, reason: reason.to_owned() });
    };
    if scene.domain == Domain::Torque {
        tell(
            "torque_scale",
            "every joint".to_owned(),
            "with free masses all inertias and frictions grow with it, exactly: only a payload of \
             known mass tells",
        );
    }
    let own = CATALOGUE.iter().filter(|e| e.domain() == scene.domain);
    for (effect, reason) in own.filter_map(|e: &&dyn LogEffect| Some((e, e.excluded(scene)?))) {
        tell(effect.identifier(), "every joint".to_owned(), &reason);
    }
    for candidate in first.asked.candidates.iter().filter(|c| !c.seen) {
        let reason = "what is fitted along does the same in this motion";
        tell(candidate.term.effect.identifier(), candidate.term.spot.to_string(), reason);
    }
    hidden
}
