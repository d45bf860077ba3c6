//! What a diagnosis has found, as a model that predicts: the same log, term by term, or another one.

use stiffarm_kernels::generic::Arm;

use super::effects::{LATE, LogEffect, Spot};
use super::options::Refused;
use super::read::{Log, Signal, TorqueSide};
use super::readings::Readings;
use super::report::JointGap;
use super::rigid::Base;
use super::scene::{Column, Domain, Scene};
use super::search::case::{Case, Simple, Wanted};
pub use super::search::springs::Springs;
use super::verdict::loaded;
use crate::measurement::Body;
use crate::signal::Signals;

/// An effect at a place, with its numbers.
#[derive(Clone)]
pub struct Acting {
    /// The effect.
    pub effect: &'static dyn LogEffect,
    /// Where.
    pub spot: Spot,
    /// Its numbers, SI.
    pub values: Vec<f64>,
}

impl Acting {
    /// What it does to the rows of a scene, unless it only changes what a link's numbers are.
    pub fn does(&self, scene: &Scene<'_>) -> Column {
        if self.effect.bends() {
            return self.effect.value(scene, self.spot, &self.values);
        }
        let columns = self.effect.columns(scene, self.spot, &self.values);
        let scaled = |(column, value): (Column, &f64)| {
            let rows = |(joint, rows): (usize, Vec<f64>)| {
                (joint, rows.into_iter().map(|x| x * value).collect::<Vec<f64>>())
            };
            column.parts.into_iter().map(rows).collect::<Vec<_>>()
        };
        Column { parts: columns.into_iter().zip(&self.values).flat_map(scaled).collect() }
    }
}

/// How late torques are told, s, as the robot file knows it, and what else it knows: the torques are brought beside the
/// motion that they belong to, and a delay that is found is beyond that one.
pub(super) fn late(known: &[Acting], rows: Domain) -> (f64, Vec<Acting>) {
    let is_late =
        |known: &&Acting| rows == Domain::Torque && known.effect.identifier() == LATE.identifier();
    let late = known.iter().filter(is_late).map(|known| known.values[0]).sum();
    (late, known.iter().filter(|known| !is_late(known)).cloned().collect())
}

/// Rigid links and findings, with their numbers.
#[derive(Clone)]
pub struct Model {
    /// What its rows are.
    pub rows: Domain,
    /// What drives the joints in them.
    pub drive: Option<Signal>,
    /// Where that is measured.
    pub side: Option<TorqueSide>,
    /// The band's edge, Hz.
    pub band: f64,
    /// Speeds below which a joint counts as standing, rad/s or m/s.
    pub still: Vec<f64>,
    /// Loads that are known, by their names.
    pub payloads: Vec<Body>,
    /// What the robot file knows.
    pub known: Vec<Acting>,
    /// The findings, in the order in which they are told.
    pub terms: Vec<Acting>,
    /// Values of the rigid links' columns, known or as they are fitted beside the findings.
    pub rigid: Vec<f64>,
    /// The same as they were before any finding.
    pub alone: Vec<f64>,
    /// The simple model that says how the drives are loaded.
    pub simple: Simple,
    /// What is wrong with the log's readings, and with others of its recorder.
    pub readings: Readings,
    /// What the log tells of the joints' springs.
    pub springs: Springs,
}

/// The rows of a log as a model has them.
#[derive(Clone, Debug, PartialEq)]
pub struct Explained {
    /// s, since the first sample of the row's run.
    pub t: Vec<f64>,
    /// Of each row, which run.
    pub run: Vec<usize>,
    /// Each joint.
    pub joints: Vec<JointRows>,
}

/// The rows of one joint, N·m (N, A) or rad (m).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointRows {
    /// rad or m.
    pub q: Vec<f64>,
    /// Its rate.
    pub qd: Vec<f64>,
    /// Whether a row counts.
    pub counts: Vec<bool>,
    /// What drove the joint, or where it was, as it was logged, through the filter.
    pub measured: Vec<f64>,
    /// What was to be explained.
    pub target: Vec<f64>,
    /// What the rigid links ask.
    pub rigid: Vec<f64>,
    /// What they would ask had there been no findings.
    pub alone: Vec<f64>,
    /// What each finding that acts on the joint does, by its index.
    pub parts: Vec<(usize, Vec<f64>)>,
}

impl JointRows {
    /// What is left of a row with all findings.
    pub fn left(&self, row: usize) -> f64 {
        let found: f64 = self.parts.iter().filter_map(|(_, rows)| rows.get(row)).sum();
        self.target[row] - self.rigid[row] - found
    }

    /// What would be left without any.
    pub fn without(&self, row: usize) -> f64 {
        self.target[row] - self.alone[row]
    }

    /// Root mean square of something over the rows that count; 0 of none.
    pub fn rms(&self, of: impl Fn(usize) -> f64) -> f64 {
        let rows = (0..self.counts.len()).filter(|k| self.counts[*k]);
        let (sum, count) = rows.fold((0.0, 0.0), |(s, n), k| (s + of(k).powi(2), n + 1.0));
        if count > 0.0 { f64::sqrt(sum / count) } else { 0.0 }
    }

    /// What its gap is measured against: the spread of torques, the size of position errors.
    fn size(&self, rows: Domain) -> f64 {
        let used = (0..self.counts.len()).filter(|k| self.counts[*k]);
        let (sum, count) = used.fold((0.0, 0.0), |(s, n), k| (s + self.target[k], n + 1.0));
        let mean = if rows == Domain::Torque && count > 0.0 { sum / count } else { 0.0 };
        self.rms(|k| self.target[k] - mean)
    }
}

impl Explained {
    /// The gap of each joint before and after, in the units of `like`.
    pub fn gap(&self, rows: Domain, like: &[JointGap]) -> Vec<JointGap> {
        let of = |(joint, like): (&JointRows, &JointGap)| JointGap {
            unit: like.unit.clone(),
            size: joint.size(rows),
            before: joint.rms(|k| joint.without(k)),
            after: joint.rms(|k| joint.left(k)),
            nested: None,
        };
        self.joints.iter().zip(like).map(of).collect()
    }
}

impl Model {
    /// A log's rows as this model has them: the one that it was found in, or another of the same arm.
    ///
    /// # Errors
    /// [`Refused`]: the log has not the rows of the model, or is too slow for its band.
    pub fn explain(&self, arm: &Arm, log: &Log) -> Result<Explained, Refused> {
        let needed = match self.rows {
            Domain::Torque => self.drive,
            Domain::Position => Some(Signal::QCmd),
        };
        if needed.is_some_and(|signal| !log.has(signal)) {
            let (file, rows) = (log.files.join(", "), "the same");
            let missing = needed.map_or("", Signal::name);
            return Err(Refused::NoRows { file, missing, rows });
        }
        let limit = 0.25 / log.period();
        if self.band >= limit {
            return Err(Refused::Band { found: self.band, limit });
        }
        let log = &*self.readings.mended(log);
        let mut signals = Signals::of(log, self.drive, Some(self.band));
        let (late, known) = late(&self.known, self.rows);
        signals.align(late);
        signals.mark_ways(&self.still);
        let base = (self.rows == Domain::Torque).then(|| Base::of(arm));
        let payloads: Vec<Option<String>> = log.runs.iter().map(|r| r.payload.clone()).collect();
        let current = self.side == Some(TorqueSide::Current);
        let case = Case {
            arm,
            signals: &signals,
            kind: (self.rows, self.side),
            still: &self.still,
            base: base.as_ref(),
            payloads: &payloads,
            known: &known,
            loaded: &loaded(arm, &payloads, &self.payloads, current),
            late: late.abs() + self.simple.delay.abs(),
            left_out: &self.readings.left_out(arm.dof()),
        };
        let mut joints: Vec<JointRows> = case
            .counts()
            .into_iter()
            .zip(signals.q.iter().zip(&signals.qd))
            .zip(if self.rows == Domain::Torque { &signals.drive } else { &signals.measured })
            .map(|((counts, (q, qd)), measured)| JointRows {
                q: signals.kept(q),
                qd: signals.kept(qd),
                counts,
                measured: signals.filtered(measured),
                ..JointRows::default()
            })
            .collect();
        for span in &signals.spans {
            let (part, _) = signals.stretch(span, &span.kept, case.late);
            self.add(&case, &part, span.run, &mut joints);
        }
        let run = signals.spans.iter().flat_map(|s| core::iter::repeat_n(s.run, s.kept.len()));
        Ok(Explained { t: signals.kept(&signals.t), run: run.collect(), joints })
    }

    /// The rows of one span behind those before it.
    fn add(&self, case: &Case<'_>, signals: &Signals, run: usize, joints: &mut [JointRows]) {
        let wanted: Vec<Wanted> =
            self.terms.iter().map(|t| (t.effect, t.spot, vec![t.values.clone()])).collect();
        let mut columns = case.columns(&self.simple, &wanted, signals, run);
        let target = columns.pop().unwrap_or_default();
        let (rigid, own) = columns.split_at(self.rigid.len());
        let count = signals.rows();
        for (joint, rows) in joints.iter_mut().enumerate() {
            let sum = |parts: &mut dyn Iterator<Item = (&Column, f64)>| -> Option<Vec<f64>> {
                let mut sum: Option<Vec<f64>> = None;
                for (column, by) in parts {
                    for (_, part) in column.parts.iter().filter(|(on, _)| *on == joint) {
                        let to = sum.get_or_insert_with(|| vec![0.0; count]);
                        to.iter_mut().zip(part).for_each(|(x, row)| *x += by * row);
                    }
                }
                sum
            };
            let none = || vec![0.0; count];
            let of = |values: &[f64]| {
                sum(&mut rigid.iter().zip(values.iter().copied())).unwrap_or_else(none)
            };
            rows.target.extend(sum(&mut [(&target, 1.0)].into_iter()).unwrap_or_else(none));
            rows.rigid.extend(of(&self.rigid));
            rows.alone.extend(of(&self.alone));
            let before = rows.target.len() - count;
            let mut at = 0;
            for (k, term) in self.terms.iter().enumerate() {
                let numbers = term.effect.parameters().len();
                let does = match case.carried(term.effect, term.spot) {
                    Some(mixed) => {
                        let mine = mixed.iter().zip(&term.values);
                        let mine =
                            mine.filter(|(m, _)| m.run.is_none_or(|of| of == case.held_as(run)));
                        let each = mine.flat_map(|(m, value)| {
                            m.of.iter().map(move |(column, x)| (&rigid[*column], x * value))
                        });
                        sum(&mut each.into_iter())
                    }
                    None if term.effect.bends() => {
                        at += numbers + 1;
                        sum(&mut [(&own[at - 1], 1.0)].into_iter())
                    }
                    None => {
                        at += numbers;
                        let each = own[at - numbers..at].iter().zip(term.values.iter().copied());
                        sum(&mut each.into_iter())
                    }
                };
                let Some(does) = does else { continue };
                let part = match rows.parts.iter_mut().find(|(of, _)| *of == k) {
                    Some((_, part)) => part,
                    None => &mut rows.parts.push_mut((k, vec![0.0; before])).1,
                };
                part.resize(before, 0.0);
                part.extend(does);
            }
        }
    }
}
