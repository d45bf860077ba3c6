//! A log that is to be explained, and the columns of a stretch of it.

use stiffarm_kernels::generic::Arm;

use super::delay;
use super::dictionary::{Dictionary, Mixed};
use super::fit::{Links, Term};
use super::ripples;
use crate::constants::{BELOW_ZERO, TAKEN_BACK};
use crate::infer::limits::CONVERGED;
use crate::log::TorqueSide;
use crate::log::effects::{LogEffect, Spot};
use crate::log::model::Acting;
use crate::log::rigid::Base;
use crate::log::rigid::works::Works;
use crate::log::scene::{Column, Domain, Loads, Scene};
use crate::signal::Signals;

/// Fine samples are enough for the simple model.
const ENOUGH: usize = 60_000;

/// What is to be explained, and by what in any case.
pub struct Case<'a> {
    /// The arm of the robot file.
    pub arm: &'a Arm,
    /// Even and band-limited.
    pub signals: &'a Signals,
    /// What the rows are, and where a torque is measured.
    pub kind: (Domain, Option<TorqueSide>),
    /// Speeds below which a joint counts as standing, rad/s or m/s.
    pub still: &'a [f64],
    /// The rigid links, which are no finding; of torque rows.
    pub base: Option<&'a Base>,
    /// Of each run what it carries, by its name; `None` is nothing.
    pub payloads: &'a [Option<String>],
    /// What the robot file knows beyond its table.
    pub known: &'a [Acting],
    /// Of each run the numbers of the load that is known to be on the last link, in its frame.
    pub loaded: &'a [Option<[f64; 10]>],
    /// How late torques are told at most, s: at so far an end of a span they have no motion.
    pub late: f64,
    /// Joints that do not move, or whose channel is silent: no row of theirs counts.
    pub left_out: &'a [bool],
}

/// A simple model of the drives, and of how late they are told or servos follow.
#[derive(Clone, Debug, Default)]
pub struct Simple {
    /// Of the rigid links' columns.
    values: Vec<f64>,
    /// Coulomb and viscous friction of each joint.
    friction: Vec<[f64; 2]>,
    /// Ripples of each joint that stand out, in periods per radian or metre.
    pub ripples: Vec<Vec<f64>>,
    /// Between the commands and the servos, or the motion and its torques where that is long, s.
    pub delay: f64,
}

/// An effect at a place, and values about which it is asked for.
pub type Wanted = (&'static dyn LogEffect, Spot, Vec<Vec<f64>>);

impl Simple {
    /// Nothing, of so many joints.
    pub fn nothing(case: &Case<'_>) -> Simple {
        let joints = case.signals.joints();
        Simple {
            values: vec![0.0; case.base.map_or(0, |base| base.columns.len())],
            friction: vec![[0.0; 2]; joints],
            ripples: vec![Vec::new(); joints],
            delay: 0.0,
        }
    }

    /// With the links' values as they were fitted beside findings; whether what they ask of some joint has changed by more
    /// than [`CONVERGED`].
    pub fn moved_to(&mut self, dict: &Dictionary<'_>, values: Vec<f64>) -> bool {
        let columns: Vec<Mixed> = (0..values.len()).map(Mixed::one).collect();
        let less: Vec<f64> = values.iter().zip(&self.values).map(|(to, from)| to - from).collect();
        let sizes = |values: &[f64]| dict.sizes(&columns, values);
        let pairs = sizes(&less).into_iter().zip(sizes(&values));
        let has_moved = pairs.into_iter().any(|(change, size)| change > CONVERGED * size);
        self.values = values;
        has_moved
    }

    /// Of a log: rigid links, as they are known or fitted, friction and zeros, fitted to as much of it as is enough. Of
    /// position rows a delay.
    pub fn of(case: &Case<'_>, links: &Links, seed: u64) -> Simple {
        let nothing = Simple::nothing(case);
        let thinned = case.signals.t.len().div_ceil(ENOUGH);
        if case.kind.0 == Domain::Position {
            return Simple { delay: delay::of_servos(case, &nothing, thinned), ..nothing };
        }
        let late = delay::of_torques(case, &nothing, thinned);
        let case = &Case { late: case.late + late.abs(), ..*case };
        let (dict, fit) = delay::fitted_at(case, &nothing, thinned, late);
        let values = |effect: usize| fit.terms.iter().skip(effect).step_by(3).map(|t| t.values[0]);
        Simple {
            friction: values(0)
                .zip(values(1))
                .map(|(coulomb, viscous)| [coulomb, viscous])
                .collect(),
            ripples: ripples::found(&dict, &fit.sampled(&dict), seed),
            values: links.values(&fit.values, dict.base),
            delay: late,
        }
    }
}

impl Case<'_> {
    /// Of a run the first that carries the same by its name, itself where it names nothing: what is held is one body in all
    /// of them.
    pub fn held_as(&self, run: usize) -> usize {
        let name = self.payloads.get(run).and_then(Option::as_ref);
        let first = || self.payloads.iter().position(|other| other.as_ref() == name);
        name.and_then(|_| first()).unwrap_or(run)
    }

    /// Whether something that is named is carried in one run alone: with that run held out nothing tells of it.
    pub fn is_held_once(&self) -> bool {
        let named = self.payloads.iter().flatten();
        let times = |name: &String| self.payloads.iter().flatten().filter(|n| *n == name).count();
        named.into_iter().any(|name| times(name) == 1)
    }

    /// Which rows count, of each joint: away from the ends of the filters, no contact, and for torques
    /// no standstill, where friction takes any value up to Coulomb's, nor what is missing or at its limit.
    pub fn counts(&self) -> Vec<Vec<bool>> {
        let signals = self.signals;
        let touches = signals.near(&signals.contact, 0.0);
        let free =
            signals.settled(self.late).into_iter().zip(touches).map(|(s, touch)| s && !touch);
        let free: Vec<bool> = free.collect();
        let counts = |joint: usize| {
            if self.left_out.get(joint).is_some_and(|out| *out) {
                return vec![false; signals.rows()];
            }
            let speeds = signals.kept(&signals.qd[joint]);
            let moves = |speed: f64| speed.abs() > self.still[joint];
            let lacks = signals.near(&signals.holes[joint], self.late);
            let free = free.iter().zip(lacks).map(|(free, lacks)| *free && !lacks);
            let pairs = speeds.into_iter().zip(free);
            let position = self.kind.0 == Domain::Position;
            pairs.map(|(speed, free)| free && (position || moves(speed))).collect()
        };
        (0..signals.joints()).map(counts).collect()
    }

    /// A scene of some signals, with what the simple model asks there.
    pub fn scene<'s>(
        &'s self,
        simple: &'s Simple,
        signals: &'s Signals,
        loads: &'s Loads,
    ) -> Scene<'s> {
        let Simple { ripples, .. } = simple;
        Scene::new(self.arm, signals, self.kind, loads, self.still, ripples, self.payloads)
    }

    /// The stored columns of an effect that only changes what a link's numbers are.
    pub fn carried(&self, effect: &dyn LogEffect, spot: Spot) -> Option<Vec<Mixed>> {
        let carried = effect.carried(self.arm, spot)?;
        let base = self.base?;
        let column = |numbers: [f64; 10]| {
            let part = |row: usize| -> f64 {
                let mix = base.mix.row(row);
                (0..10).map(|k| mix[10 * carried.link + k] * numbers[k]).sum()
            };
            let parts = (0..base.columns.len()).map(|row| (row, part(row)));
            Mixed { of: parts.filter(|(_, x)| *x != 0.0).collect(), run: carried.run }
        };
        Some(carried.numbers.into_iter().map(column).collect())
    }

    /// All columns at the rows of some signals of one run: rigid links, effects, what is to be
    /// explained.
    pub fn columns(
        &self,
        simple: &Simple,
        wanted: &[Wanted],
        signals: &Signals,
        run: usize,
    ) -> Vec<Column> {
        let rigid = self.base.map_or_else(Vec::new, |base| rigid_columns(self.arm, base, signals));
        let loads = self.loads(simple, &rigid, signals, run);
        let scene = self.scene(simple, signals, &loads);
        let filtered = |column: &Column| {
            let parts = column.parts.iter();
            Column { parts: parts.map(|(on, fine)| (*on, signals.filtered(fine))).collect() }
        };
        let mut columns: Vec<Column> = rigid.iter().map(filtered).collect();
        for (effect, spot, probes) in wanted {
            if effect.carried(self.arm, *spot).is_some() {
                continue;
            }
            for values in probes {
                columns.extend(effect.columns(&scene, *spot, values));
                columns.extend(effect.bends().then(|| effect.value(&scene, *spot, values)));
            }
        }
        let mut target = scene.target();
        if let (Some(base), Some(load)) = (self.base, self.loaded.get(run).copied().flatten()) {
            let asks = loaded(base, &load);
            for (column, value) in columns.iter().zip(&asks) {
                for (joint, rows) in &column.parts {
                    let to = &mut target.parts[*joint].1;
                    to.iter_mut().zip(rows).for_each(|(x, asks)| *x -= value * asks);
                }
            }
        }
        for (joint, rows) in self.known.iter().flat_map(|known| known.does(&scene).parts) {
            target.parts[joint].1.iter_mut().zip(rows).for_each(|(x, does)| *x -= does);
        }
        columns.push(target);
        columns
    }

    /// What the simple model asks at every fine sample.
    fn loads(&self, simple: &Simple, rigid: &[Column], signals: &Signals, run: usize) -> Loads {
        let nothing = || vec![vec![0.0; signals.t.len()]; signals.joints()];
        let mut loads = Loads { rigid: nothing(), known: nothing(), ..Loads::default() };
        loads.delay = simple.delay;
        let Some(base) = self.base else { return loads };
        let add = |to: &mut [Vec<f64>], values: &[f64]| {
            for (column, value) in rigid.iter().zip(values) {
                for (joint, rows) in &column.parts {
                    to[*joint].iter_mut().zip(rows).for_each(|(x, asks)| *x += value * asks);
                }
            }
        };
        let mut values = simple.values.clone();
        if let Some(load) = self.loaded.get(run).copied().flatten() {
            let more = loaded(base, &load);
            add(&mut loads.known, &more);
            values.iter_mut().zip(more).for_each(|(x, more)| *x += more);
        }
        add(&mut loads.rigid, &values);
        let friction = |(joint, [coulomb, viscous]): (usize, &[f64; 2])| {
            // What was found is beyond the robot file's.
            let drive = &self.arm.joints[joint].drive;
            let is_driven = self.kind.1.is_some_and(TorqueSide::is_driven);
            let more = if is_driven { [drive.coulomb, drive.viscous] } else { [0.0; 2] };
            let [coulomb, viscous] = [coulomb + more[0], viscous + more[1]];
            let speeds = &signals.qd[joint];
            let braked = |(k, v): (usize, &f64)| coulomb * signals.sign(speeds, k) + viscous * v;
            speeds.iter().enumerate().map(braked).collect()
        };
        loads.friction = simple.friction.iter().enumerate().map(friction).collect();
        loads.numbers = base.numbers(&values);
        loads
    }
}

impl Case<'_> {
    /// What the robot file has of a proportional effect's parameters at a spot, in its table and in its `[[effect]]`s.
    fn of_file(&self, effect: &dyn LogEffect, spot: Spot) -> Vec<f64> {
        let mut of = vec![0.0; effect.parameters().len()];
        if effect.bends() || of.is_empty() {
            return of;
        }
        of[0] = effect.file_value(self.arm, self.kind.1, spot);
        let is_it = |k: &&Acting| k.effect.identifier() == effect.identifier() && k.spot == spot;
        for known in self.known.iter().filter(is_it) {
            of.iter_mut().zip(&known.values).for_each(|(of, value)| *of += value);
        }
        of
    }

    /// Whether an effect may have such values beyond the robot file's. Where in truth there is none of it the sum comes
    /// out on either side of zero: a little below is none.
    pub fn is_feasible(&self, term: &Term) -> bool {
        let of = self.of_file(term.effect, term.spot);
        let is_little =
            |(of, value): (&f64, &f64)| *of > 0.0 && *value < 0.0 && *value > -TAKEN_BACK * of;
        if of.iter().zip(&term.values).any(is_little) {
            return false;
        }
        let sum = of.iter().zip(&term.values).map(|(of, value)| match of + value {
            sum if sum < 0.0 && sum >= -BELOW_ZERO * of => 0.0,
            sum => sum,
        });
        term.effect.is_feasible(&sum.collect::<Vec<f64>>())
    }

    /// The same values, none of them below what takes away all that the robot file has.
    pub fn at_least_none(&self, term: &Term) -> Vec<f64> {
        let of = self.of_file(term.effect, term.spot);
        let each = of.iter().zip(&term.values).zip(term.effect.parameters());
        each.map(|((of, value), p)| if *of > 0.0 { value.max(p.least - of) } else { *value })
            .collect()
    }
}

/// What a load on the last link adds to the values of the base columns.
fn loaded(base: &Base, load: &[f64; 10]) -> Vec<f64> {
    let last = base.mix.ncols() - 10;
    let add = |row: usize| (0..10).map(|k| base.mix[(row, last + k)] * load[k]).sum();
    (0..base.columns.len()).map(add).collect()
}

/// What a unit of each base parameter asks of the joints at the fine samples.
fn rigid_columns(arm: &Arm, base: &Base, signals: &Signals) -> Vec<Column> {
    let (fine, n) = (signals.t.len(), arm.dof());
    let works = Works::of(arm);
    let mut columns: Vec<Vec<Vec<f64>>> =
        base.columns.iter().map(|c| vec![Vec::with_capacity(fine); c / 10 + 1]).collect();
    let (mut motion, mut asks) = ([(); 3].map(|()| vec![0.0; n]), vec![0.0; 10 * n * n]);
    for k in 0..fine {
        for (at, of) in motion.iter_mut().zip([&signals.q, &signals.qd, &signals.qdd]) {
            at.iter_mut().zip(of).for_each(|(at, joint)| *at = joint[k]);
        }
        works.regressor(motion.each_ref().map(Vec::as_slice), &mut asks);
        for (column, index) in columns.iter_mut().zip(&base.columns) {
            // A link's inertia is felt by its own joint and those below.
            let own = &asks[n * index..];
            column.iter_mut().zip(own).for_each(|(values, asks)| values.push(*asks));
        }
    }
    let column = |joints: Vec<Vec<f64>>| Column { parts: joints.into_iter().enumerate().collect() };
    columns.into_iter().map(column).collect()
}
