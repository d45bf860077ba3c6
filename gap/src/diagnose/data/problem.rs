//! The data as it is to be explained: an arm, its measurements, and what is known to be unknown.

use nalgebra::{Isometry3, Point3, Vector6};
use stiffarm_kernels::generic::Arm;

use super::outliers::ordinary;
use super::precision::Precision;
use super::visits::Visits;
use crate::diagnose::fit::Place;
use crate::diagnose::options::{DiagnoseError, Nuisance, Options, TOLERANCE};
use crate::diagnose::prior::Prior;
use crate::diagnose::progress::Stop;
use crate::effects::{Effect, Known};
use crate::gap::{Statistics, rms};
use crate::infer::limits::LAST_DIGITS;
use crate::instrument::{Aim, Pair, Seen};
use crate::measurement::{Kind, Measurements, Row, Stands, number_of};
use crate::parallel;
use crate::simulate::{Actual, Moments, Reading, Sim};
use crate::spring::Spring;

/// Readings, loads, places and gaps stay below this, N, N·m, m and rad: their squares, weighted and
/// added up, are then finite.
pub const LARGEST: f64 = 1e50;

/// Rows that are worked on at once: what is found of each is more than what is kept of it.
const AT_ONCE: usize = 1 << 14;

/// A thing of the bench that is unknown.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Thing {
    pub(crate) aim: Aim,
    /// Each session has its own.
    pub(crate) session: usize,
}

/// An arm and its measurements.
#[derive(Clone)]
pub(crate) struct Problem<'a> {
    pub(crate) arm: &'a Arm,
    pub(crate) data: &'a Measurements,
    pub(crate) moments: Moments<'a>,
    /// 1 where a component is measured, else 0.
    pub(crate) mask: Vector6<f64>,
    /// The components that are measured.
    pub(crate) measured: Vec<usize>,
    /// What the robot file says of the arm beyond its table, as far as it is there in this data.
    pub(crate) known: Vec<Known>,
    /// Frames that are unknown.
    pub(crate) nuisances: Vec<Nuisance>,
    /// The arm's geometry, where it is fitted along.
    pub(crate) along: Option<&'static dyn Effect>,
    /// What is usual of some effects' numbers, by the caller.
    pub(crate) priors: Vec<Prior>,
    /// To what makers hold lengths and angles, m and rad.
    pub(crate) tolerance: [f64; 2],
    /// Names of the markers whose place on the tool is unknown.
    pub(crate) markers: Vec<String>,
    /// Which of them a row has.
    pub(crate) marker_of: Vec<Option<usize>>,
    /// The frames that rows are told of.
    pub(crate) stands: Stands,
    /// Names of the sessions, at least one; empty where the file has no column.
    pub(crate) sessions: Vec<String>,
    /// The things of the bench that are unknown.
    pub(crate) bench: Vec<Thing>,
    /// Which of them a row reads.
    pub(crate) bench_of: Vec<Option<usize>>,
    /// Points of the bench whose distance is known, and where they are.
    pub(crate) pairs: Vec<(Pair, [Place; 2])>,
    /// The joints' springs as a log has them.
    pub(crate) springs: Vec<Spring>,
    /// Rows that have an unknown constant of their own, so that only what sets them apart counts;
    /// all rows stand in one of these sets, or there are none.
    pub(crate) constants: Vec<Vec<usize>>,
    /// Whether a row is fitted and counted; the gaps of others are 0.
    pub(crate) fits: Vec<bool>,
    /// How precise each row is beside the others.
    pub(crate) precision: Precision,
    pub(crate) visits: Visits,
    /// What the arm of the robot file reads in its own base frame; where the file has the user's
    /// own simulator only.
    pub(crate) nominal: Option<Vec<Reading>>,
    /// Largest distance of the tool from the base, m.
    pub(crate) reach: f64,
    /// Whether an end is asked for.
    pub(crate) stop: Stop,
}

impl<'a> Problem<'a> {
    pub(crate) fn new(
        arm: &'a Arm,
        data: &'a Measurements,
        options: &Options,
    ) -> Result<Self, DiagnoseError> {
        let file = || data.file.clone();
        if data.rows.is_empty() {
            return Err(DiagnoseError::NoRows { file: file() });
        }
        let wrong = data.rows.iter().map(|r| r.q.len()).find(|found| *found != arm.dof());
        if let Some(found) = wrong {
            return Err(DiagnoseError::Joints { file: file(), found, expected: arm.dof() });
        }
        let mut markers: Vec<String> = Vec::new();
        let marker_of = (data.rows.iter())
            .map(|row| {
                let unknown = row.marker.as_ref().filter(|_| row.offset.is_none());
                unknown.map(|name| number_of(&mut markers, name.clone()))
            })
            .collect();
        let (mut sessions, mut session_of) = (Vec::new(), Vec::with_capacity(data.rows.len()));
        for rows in data.sessions() {
            session_of.extend(rows.iter().map(|_| sessions.len()));
            sessions.push(rows[0].session.clone().unwrap_or_default());
        }
        let (mut bench, mut bench_of) = (Vec::new(), Vec::with_capacity(data.rows.len()));
        for (row, session) in data.rows.iter().zip(&session_of) {
            let unknown = row.aim.as_deref().filter(|aim| !aim.free.is_empty());
            let thing = unknown.map(|aim| Thing { aim: aim.instrument(), session: *session });
            bench_of.push(thing.map(|thing| number_of(&mut bench, thing)));
        }
        let pairs = pairs(data, &bench, &session_of);
        let known: Vec<Known> =
            options.known.iter().filter(|known| known.is_there(data)).cloned().collect();
        let moments = Moments::of(data);
        let fits = match options.keep_all {
            true => vec![true; data.rows.len()],
            false => ordinary(data),
        };
        let seen = |number: usize| -> Result<(Reading, f64), DiagnoseError> {
            let (row, when) = (&data.rows[number], moments.at(number));
            let line = row.line;
            let too_large = || DiagnoseError::TooLarge { file: file(), line };
            let is_small = |x: &f64| x.abs() < LARGEST;
            if !row.q.iter().chain(&row.measured).all(is_small) {
                return Err(too_large());
            }
            let [x, y, z] = row.offset.unwrap_or_default();
            let sim = |load: Vector6<f64>| {
                Sim::of(data.kind, Isometry3::translation(x, y, z), None, |loaded| {
                    let wrench = if loaded { load } else { Vector6::zeros() };
                    let mut actual = Actual::new(arm, &row.q, &wrench);
                    actual.base = Isometry3::identity();
                    known.iter().for_each(|known| known.alter(&mut actual, row, &when));
                    actual
                })
            };
            let unloaded = |wrong| if fits[number] { Err(wrong) } else { sim(Vector6::zeros()) };
            let sim = sim(row.wrench).or_else(unloaded);
            let sim = sim.map_err(|_| DiagnoseError::Unstable { file: file(), line })?;
            let sim = sim.seen_by(row.view(data.kind));
            let tool = sim.loaded.tool.translation.vector;
            if !sim.loaded.torque.iter().chain(tool.iter()).all(is_small) {
                return Err(too_large());
            }
            Ok((sim.reading(), tool.norm()))
        };
        let own = data.sim_given.contains(&true);
        let (mut readings, mut reach) = (Vec::new(), 0.0_f64);
        // The first row's error is told, however many rows are worked on at once.
        for first in (0..data.rows.len()).step_by(AT_ONCE) {
            let some = first..(first + AT_ONCE).min(data.rows.len());
            for one in parallel::map(some.len(), &|k| seen(first + k)) {
                let (reading, far) = one?;
                reach = reach.max(far);
                readings.extend(own.then_some(reading));
            }
        }
        Ok(Problem {
            arm,
            data,
            moments,
            mask: Vector6::from_iterator(data.kind.components().map(f64::from)),
            measured: (0..6).filter(|&k| data.kind.components()[k]).collect(),
            known,
            nuisances: Nuisance::unknown(data, &options.nuisances),
            along: options.along().filter(|e| e.excluded(data).is_none()),
            priors: options.priors.clone(),
            tolerance: options.tolerance.unwrap_or(TOLERANCE),
            markers,
            marker_of,
            stands: Stands::of(data),
            sessions,
            bench,
            bench_of,
            pairs,
            springs: Vec::new(),
            constants: Vec::new(),
            fits,
            precision: Precision::default(),
            visits: Visits::of(data),
            nominal: own.then_some(readings),
            reach,
            stop: options.stop.clone(),
        })
    }

    /// A row in which the arm comes to no rest.
    pub(crate) fn unstable(&self, row: usize) -> DiagnoseError {
        DiagnoseError::Unstable { file: self.data.file.clone(), line: self.data.rows[row].line }
    }

    /// What there is one of for each row, of the rows that are counted.
    pub(crate) fn kept<'r, T>(&'r self, of_rows: &'r [T]) -> impl Iterator<Item = &'r T> + Clone {
        of_rows.iter().zip(&self.fits).filter(|(_, fits)| **fits).map(|(one, _)| one)
    }

    /// The rows that are counted.
    pub(crate) fn kept_rows(&self) -> impl Iterator<Item = &'a Row> + Clone + '_ {
        self.data.rows.iter().zip(&self.fits).filter(|(_, fits)| **fits).map(|(row, _)| row)
    }

    /// The size of the gaps of all rows, of those that are counted.
    pub(crate) fn statistics(&self, gaps: &[Vector6<f64>]) -> Statistics {
        Statistics::of_rows(self.data.kind, self.kept_rows().zip(self.kept(gaps)))
    }

    /// Below this a gap is rounding error, m or rad.
    pub(crate) fn rounding(&self) -> f64 {
        LAST_DIGITS * (1.0 + self.reach)
    }

    /// Whether gaps are more than rounding.
    pub(crate) fn is_there(&self, gaps: &[Vector6<f64>]) -> bool {
        let size = Statistics::of(self.kept(gaps));
        size.position_max.max(size.rotation_rms) > self.rounding()
    }

    /// What a row's gap is multiplied by, whitened by `weights` of its kinds.
    pub(crate) fn weights(&self, row: usize, weights: &Vector6<f64>) -> Vector6<f64> {
        self.precision.of_row(row).component_mul(weights)
    }

    /// The gaps of all rows as they would be if all were equally precise.
    pub(crate) fn standard(&self, gaps: &[Vector6<f64>]) -> impl Iterator<Item = Vector6<f64>> {
        let each = gaps.iter().enumerate();
        each.map(|(row, gap)| gap.component_mul(&self.precision.of_row(row)))
    }

    /// Numbers that are measured and counted, beyond those that constants take.
    pub(crate) fn numbers(&self) -> usize {
        let of_row = |row: &Row| row.components(self.data.kind).iter().filter(|is| **is).count();
        let counted: usize = self.kept_rows().map(of_row).sum();
        counted - self.constants.len() * self.measured.len()
    }

    /// Whether positions are measured; else only rotations are.
    pub(crate) fn measures_position(&self) -> bool {
        self.measured.iter().any(|k| *k < 3)
    }

    /// How far a gap is, by what is measured first: m, or rad where no position is.
    pub(crate) fn size(&self, gap: &Vector6<f64>) -> f64 {
        gap.fixed_rows::<3>(self.first()).norm()
    }

    /// Root mean square of the rows' sizes, over the rows that are counted and read what is measured first.
    pub(crate) fn rms(&self, sizes: &[f64]) -> f64 {
        let read = self.kept_rows().zip(self.kept(sizes)).filter(|(row, _)| self.is_judged(row));
        rms(&read.map(|(_, size)| *size).collect::<Vec<_>>())
    }

    /// Whether a row reads what is measured first.
    pub(crate) fn is_judged(&self, row: &Row) -> bool {
        row.reads(self.data.kind, self.first())
    }

    /// The first component of what is measured first: positions, or rotations without them.
    pub(crate) fn first(&self) -> usize {
        if self.measures_position() { 0 } else { 3 }
    }

    pub(crate) fn is_unknown(&self, frame: Nuisance) -> bool {
        self.nuisances.contains(&frame)
    }

    /// The unknown frames, and the number of each among its like: every session has a base of its own, and all have
    /// one tool; of cameras and boards each has a base or a place on the tool.
    pub(crate) fn frames(&self) -> impl Iterator<Item = (Nuisance, usize)> + '_ {
        let count = |frame: Nuisance| match frame {
            Nuisance::BaseFrame => self.stands.bases.len(),
            Nuisance::ToolFrame => self.stands.mounts.len().max(1),
        };
        self.nuisances.iter().flat_map(move |&frame| (0..count(frame)).map(move |k| (frame, k)))
    }

    /// Whether a row is told of a frame; one that has no place on the tool of its own, of the first.
    pub(crate) fn is_told_of(&self, row: usize, (frame, number): (Nuisance, usize)) -> bool {
        number
            == match frame {
                Nuisance::BaseFrame => self.stands.base_of[row],
                Nuisance::ToolFrame => self.stands.mount_of[row].unwrap_or(0),
            }
    }

    /// Of what a frame is, where there are several.
    pub(crate) fn frame_of(&self, (frame, number): (Nuisance, usize)) -> Option<String> {
        match frame {
            Nuisance::BaseFrame => self.stands.base(number),
            Nuisance::ToolFrame => self.stands.mount(number),
        }
    }

    /// The reading of a row with the user's own simulator in place of the arm's: what the arm's
    /// changes by, the user's is taken to change by. `instrument` is where the base stands.
    pub(crate) fn with_own_sim(
        &self,
        row: usize,
        model: &Reading,
        instrument: &Isometry3<f64>,
    ) -> Reading {
        let (Some(nominal), Some(own)) = (&self.nominal, &self.data.rows[row].sim) else {
            return *model;
        };
        let nominal = &nominal[row];
        let told =
            |reading: &Reading, frame: &Isometry3<f64>| placed(reading, frame, self.data.kind);
        let mut merged = told(nominal, &self.arm.base).vector();
        for k in (0..6).filter(|&k| self.data.sim_given[k]) {
            merged[k] = own[k];
        }
        // All in the arm's base frame, then placed.
        let own = told(&Reading::from_vector(&merged), &self.arm.base.inverse());
        let local = told(model, &instrument.inverse());
        let sum = Reading {
            position: own.position + local.position - nominal.position,
            rotation: local.rotation * nominal.rotation.inverse() * own.rotation,
        };
        told(&sum, instrument)
    }
}

/// What a frame at `frame` reads, told from where that stands; of a displacement only the axes change,
/// of a distance nothing.
fn placed(reading: &Reading, frame: &Isometry3<f64>, kind: Kind) -> Reading {
    let turn = frame.rotation;
    match kind {
        Kind::Pose { .. } | Kind::Coordinates { .. } => Reading {
            position: (frame * Point3::from(reading.position)).coords,
            rotation: turn * reading.rotation,
        },
        Kind::Displacement { .. } => Reading {
            position: turn * reading.position,
            rotation: turn * reading.rotation * turn.inverse(),
        },
        Kind::Distance | Kind::Bench { .. } => *reading,
    }
}

/// The pairs of points that were measured in one session; of points that are known both ends are, and the pair
/// says nothing.
fn pairs(data: &Measurements, bench: &[Thing], session_of: &[usize]) -> Vec<(Pair, [Place; 2])> {
    let mut all: Vec<(Pair, [Place; 2])> = Vec::new();
    let sessions = session_of.last().map_or(0, |last| last + 1);
    for (pair, session) in data.pairs.iter().flat_map(|p| (0..sessions).map(move |s| (p, s))) {
        let place = |name: &String| {
            let is = |aim: &Aim| aim.seen == Seen::Point && aim.name == *name;
            let fitted = bench.iter().position(|t| t.session == session && is(&t.aim));
            let of_session = data.rows.iter().zip(session_of).filter(|(_, s)| **s == session);
            let known = || of_session.filter_map(|(row, _)| row.aim.as_deref()).find(|aim| is(aim));
            fitted.map(Place::Fitted).or_else(|| known()?.view.place().map(Place::Known))
        };
        if let [Some(one), Some(other)] = pair.points.each_ref().map(place) {
            all.push((pair.clone(), [one, other]));
        }
    }
    all
}
