//! Which mistakes explain a gap that is too large for an arm: one, else two.

use stiffarm_kernels::generic::Arm;

use super::fit::{Fit, Left};
use super::kind::Mistake;
use super::off;
use super::rows::Rows;
use crate::constants::{
    CERTAIN, CERTAIN_OF_LOADS, COUNTED_ROWS, FOREIGN_GAP, LARGE_GAP, LOADS_LEAVE, MISTAKE_LEAVES,
    ORDINARY_GAP, SECOND_LEAVES,
};
use crate::diagnose::Options;
use crate::doubts::reach;
use crate::infer::constants::DISTINGUISHABLE;
use crate::parallel;

/// Rows by which all pairs are compared, with the frames in closed form, and pairs that are then fitted.
pub(super) const FEW: usize = 36;
const FEW_TURNS: usize = 4;
const BEST_PAIRS: usize = 48;

/// Of the mistakes in what a bench reads so many are fitted with the table along.
const BEST_OF_BENCH: usize = 12;

/// With so many of them, those that leave least, another one is looked for.
const FIRST_OF_BENCH: usize = 4;

/// Part by which what the frames leave changes at least where a mistake does more than to move a frame;
/// rounding is far below.
const UNSEEN: f64 = 1e-6;

/// What was tried, and what it leaves.
#[derive(Clone, Debug)]
pub(super) struct Tried {
    pub mistakes: Vec<Mistake>,
    pub left: Left,
}

/// All that may be wrong, and the file in which it is.
pub(super) struct Search<'a> {
    pub arm: &'a Arm,
    pub family: &'a [Arm],
    pub rows: Rows<'a>,
    pub all: Vec<Mistake>,
    /// What a rotation counts, m per rad.
    pub lever: f64,
    /// The arm's reach, m, and three times what was measured where that is less.
    pub reach: f64,
    /// Whether the base is where the file says, so that its turn speaks against a mistake.
    pub base_is_known: bool,
    /// Part of the rows by which what is left is judged.
    pub kept: f64,
    /// How a bench, or single coordinates, are fitted; `None` of poses.
    pub bench: Option<&'a Options>,
}

/// What the search comes to.
pub(super) enum Found {
    /// The gap is that of an arm.
    Nothing,
    /// Mistakes, and others that explain as much.
    Mistakes(Tried, Vec<Tried>),
    /// A gap that is no arm's.
    Unexplained,
}

impl Search<'_> {
    /// The arm without some mistakes.
    pub(super) fn arm_without(&self, mistakes: &[Mistake]) -> Arm {
        let mut arm = self.arm.clone();
        mistakes.iter().for_each(|mistake| mistake.alter(&mut arm, self.family));
        arm
    }

    /// How far an arm without the mistakes can be, m. A length in a wrong unit is no arm's, nor is a reach that
    /// is far beyond what was measured.
    fn reach_without(&self, mistakes: &[Mistake]) -> f64 {
        let rescaled = mistakes.iter().any(|m| matches!(m, Mistake::Coordinate { .. }));
        let given = if rescaled { reach(self.arm) } else { self.reach };
        reach(&self.arm_without(mistakes)).min(given)
    }

    /// What some rows leave with the frames alone; infinite where they are no place of an arm.
    pub(super) fn framed(&self, mistakes: Vec<Mistake>, rows: &[usize]) -> f64 {
        if let Some(options) = self.bench {
            let left = self.left_of_bench(options, &mistakes, rows, false);
            return left.map_or(f64::INFINITY, |left| left.size);
        }
        let fit = self.fit(mistakes, rows, false);
        fit.map_or(f64::INFINITY, |(_, fit)| fit.framed(FEW_TURNS).size)
    }

    /// The first of those that leave least with the frames alone, with all unknowns.
    pub(super) fn refined(&self, mut found: Vec<(f64, Vec<Mistake>)>, most: usize) -> Vec<Tried> {
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found.truncate(most);
        let all = parallel::each(&found, &|(_, mistakes)| self.tried(mistakes.clone()));
        all.into_iter().flatten().collect()
    }

    pub(super) fn fit(
        &self,
        mut mistakes: Vec<Mistake>,
        rows: &[usize],
        loaded: bool,
    ) -> Option<(Vec<Mistake>, Fit)> {
        mistakes.sort_by_key(|mistake| mistake.order());
        let arm = self.arm_without(&mistakes);
        let fit = Fit::new(&self.rows, rows, &mistakes, &arm, self.lever, loaded)?;
        Some((mistakes, fit.kept(self.kept)))
    }

    /// With all unknowns.
    pub(super) fn tried(&self, mistakes: Vec<Mistake>) -> Option<Tried> {
        if let Some(options) = self.bench {
            let mistakes = self.settled(mistakes, &self.rows.fewer(FEW));
            let left = self.left_of_bench(options, &mistakes, &self.rows.chosen, true)?;
            return Some(Tried { mistakes, left });
        }
        let (mut mistakes, fit) = self.fit(mistakes, &self.rows.chosen, true)?;
        let (mut left, mut more) = fit.refined();
        if !more.is_empty() {
            // Once more with the loads of the arm that it is.
            off::put(&mut mistakes, &more);
            (left, more) = self.fit(mistakes.clone(), &self.rows.chosen, true)?.1.refined();
            off::put(&mut mistakes, &more);
        }
        left.size.is_finite().then_some(Tried { mistakes, left })
    }

    /// Whether it is what arms leave, by zeros and springs that they have.
    fn is_ordinary(&self, left: &Left) -> bool {
        left.size <= ORDINARY_GAP * self.reach && 0.5 * left.prior_penalty <= CERTAIN
    }

    /// Log-odds of what was tried, up to a constant.
    fn score(&self, tried: &Tried, floor: f64) -> f64 {
        let rarity: f64 = tried.mistakes.iter().map(|mistake| mistake.rarity()).sum();
        let turned = if self.base_is_known { tried.left.turned } else { 0.0 };
        -tried.left.told * tried.left.rows.min(COUNTED_ROWS) * tried.left.size.max(floor).ln()
            - 0.5 * tried.left.prior_penalty
            - rarity
            - turned
    }

    /// Of those that leave what an arm leaves, the likeliest, and others that are as likely.
    fn best(
        &self,
        against: &Tried,
        part: f64,
        mut tried: Vec<Tried>,
    ) -> Option<(Tried, Vec<Tried>)> {
        let least = tried.iter().map(|one| one.left.size).fold(f64::INFINITY, f64::min);
        // Differences below a thousandth of the gap are those of the fit's end.
        let floor = 1e-3 * against.left.size.min(self.reach) + 1e-2 * least;
        let tried_all = (self.all.len() as f64).ln();
        let before = self.score(against, floor);
        tried.retain(|one| {
            let gain = self.score(one, floor) - before;
            // Springs make up for another unit of all loads, at the cost of being no arm's.
            let is_load = |mistake: &Mistake| matches!(mistake, Mistake::Load { .. });
            let (part, certain) = match one.mistakes.iter().all(is_load) {
                true => (LOADS_LEAVE, CERTAIN_OF_LOADS),
                false => (part, CERTAIN),
            };
            // Beside a free reading in each row, rows that fit best say little of the others.
            let is_free = one.mistakes.iter().any(|mistake| mistake.is_stuck());
            let size = |left: &Left| if is_free { left.of_nearly_all } else { left.size };
            let ends = size(&one.left) <= part * size(&against.left);
            let is_explained = one.left.size <= LARGE_GAP * self.reach_without(&one.mistakes);
            ends && is_explained && gain > tried_all + certain
        });
        tried.sort_by(|a, b| self.score(b, floor).total_cmp(&self.score(a, floor)));
        let mut tried = tried.into_iter();
        let best = tried.next()?;
        let level = self.score(&best, floor) - 0.5 * DISTINGUISHABLE;
        let same = tried.take_while(|one| self.score(one, floor) > level).collect();
        Some((best, same))
    }

    /// Every mistake beside others, but for those that only move a frame.
    fn beside(&self, others: &[Mistake]) -> Vec<Tried> {
        let framed = |mistakes| self.framed(mistakes, &self.rows.chosen);
        let before = framed(others.to_vec());
        let is_new = |mistake: &&Mistake| {
            let seen = || framed([others, &[**mistake]].concat());
            others.iter().all(|other| other.may_join(**mistake))
                && (mistake.is_of_load() || (seen() / before - 1.0).abs() > UNSEEN)
        };
        let joined = |mistake: &Mistake| [others, &[*mistake]].concat();
        if self.bench.is_some() {
            let few = self.rows.fewer(FEW);
            let framed = |mistake: &Mistake| {
                let may = others.iter().all(|other| other.may_join(*mistake));
                may.then(|| (self.framed(joined(mistake), &few), joined(mistake)))
            };
            let found = parallel::each(&self.all, &framed);
            return self.refined(found.into_iter().flatten().collect(), BEST_OF_BENCH);
        }
        let tried = |mistake: &Mistake| {
            let new = Some(mistake).filter(is_new);
            new.and_then(|mistake| self.tried(joined(mistake)))
        };
        parallel::each(&self.all, &tried).into_iter().flatten().collect()
    }

    /// The pairs that leave least with frames alone, on few rows.
    fn pairs(&self) -> Vec<Tried> {
        let few = self.rows.fewer(FEW);
        let is_apart = |mistake: &&Mistake| !mistake.is_stuck() && !mistake.is_of_load();
        let all: Vec<Mistake> = self.all.iter().filter(is_apart).copied().collect();
        let of_first = |first: usize| {
            let pair = |second: usize| {
                let pair = vec![all[first], all[second]];
                let size = self.framed(pair.clone(), &few);
                size.is_finite().then_some((size, pair))
            };
            let joined = (first + 1..all.len()).filter(|k| all[first].may_join(all[*k]));
            joined.filter_map(pair).collect::<Vec<_>>()
        };
        let pairs = parallel::map(all.len(), &of_first);
        self.refined(pairs.concat(), BEST_PAIRS)
    }

    /// Pairs with those of some mistakes that leave least.
    fn pairs_with(&self, mut singles: Vec<Tried>) -> Vec<Tried> {
        singles.sort_by(|a, b| a.left.size.total_cmp(&b.left.size));
        let first = singles.into_iter().take(FIRST_OF_BENCH);
        first.flat_map(|first| self.beside(&first.mistakes)).collect()
    }

    /// The mistakes. `nothing` is the file as it is.
    pub(super) fn run(&self, nothing: &Tried, is_stream: bool) -> Found {
        let is_large = nothing.left.size > ORDINARY_GAP * self.reach;
        if !is_large {
            // What loads do is of the size of what springs do, whatever their unit.
            let loads: Vec<&Mistake> =
                self.all.iter().filter(|mistake| mistake.is_of_load()).collect();
            let tried = parallel::each(&loads, &|load| self.tried(vec![**load]));
            let best = self.best(nothing, MISTAKE_LEAVES, tried.into_iter().flatten().collect());
            return best.map_or(Found::Nothing, |(best, same)| Found::Mistakes(best, same));
        }
        let singles = self.beside(&[]);
        let is_plain = |(first, _): &(Tried, Vec<Tried>)| {
            let is_other = matches!(first.mistakes[..], [Mistake::Other(_)]);
            self.is_ordinary(&first.left) && !is_other
        };
        let mut first = self.best(nothing, MISTAKE_LEAVES, singles.clone());
        if !first.as_ref().is_some_and(is_plain) {
            first = self.best(nothing, MISTAKE_LEAVES, [singles.clone(), self.offs(&[])].concat());
        }
        if let Some((first, same)) = first {
            if first.mistakes.iter().any(|mistake| mistake.is_small(self.reach)) {
                return Found::Nothing;
            }
            if !self.is_ordinary(&first.left) {
                let more = [self.beside(&first.mistakes), self.offs(&first.mistakes)].concat();
                if let Some((both, same)) = self.best(&first, SECOND_LEAVES, more) {
                    return Found::Mistakes(both, same);
                }
            }
            return Found::Mistakes(first, same);
        }
        let best = |pairs| self.best(nothing, MISTAKE_LEAVES, pairs);
        let pairs = match self.bench {
            Some(_) => best(self.pairs_with(singles)),
            None => best(self.pairs()).or_else(|| best(self.pairs_with_zeros())),
        };
        if let Some((pair, same)) = pairs {
            return Found::Mistakes(pair, same);
        }
        match nothing.left.size > FOREIGN_GAP * self.reach && !is_stream {
            true => Found::Unexplained,
            false => Found::Nothing,
        }
    }
}
