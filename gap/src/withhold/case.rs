//! Which cases there are: kinds in fixed proportion, effects in turn, places and sizes by chance.

use super::Kind;
use super::bench::{Bench, Planted};
use crate::diagnose::Nuisance;
use crate::effects::Effect;
use crate::measurement::Measurements;
use crate::plant::PlantError;
use crate::rng::{Rng, Stream, seed_of};

/// Effects in some order.
type Effects = Vec<&'static dyn Effect>;

/// A case before it is diagnosed.
pub(super) struct Setup {
    pub(super) kind: Kind,
    pub(super) planted: Vec<Planted>,
    /// Without noise.
    pub(super) exact: Measurements,
    pub(super) seed: u64,
}

/// Of every twenty cases five are without an effect, nine with one, three with two, and three with
/// one that the diagnosis does not know.
const TURNS: [Kind; 20] = {
    use Kind::{None as N, Pair as P, Removed as R, Single as S};
    [S, N, S, R, S, P, S, N, S, N, S, R, S, P, N, S, R, P, S, N]
};

/// The kind of the `k`-th case, and which of its kind it is, both from 0.
pub(super) fn turn(k: usize) -> (Kind, usize) {
    let kind = TURNS[k % TURNS.len()];
    let of_kind = |turns: &[Kind]| turns.iter().filter(|t| **t == kind).count();
    let (rounds, rest) = (k / TURNS.len(), k % TURNS.len());
    (kind, rounds * of_kind(&TURNS) + of_kind(&TURNS[..rest]))
}

impl Bench<'_> {
    /// Sets up the `k`-th case. `effects` are those that show on this design.
    ///
    /// # Errors
    /// [`PlantError`] if two effects together are too much for the arm.
    pub(super) fn set_up(
        &self,
        k: usize,
        effects: &[&'static dyn Effect],
    ) -> Result<Setup, PlantError> {
        let (kind, nth) = turn(k);
        let seed = seed_of(self.plan.seed, k);
        let mut rng = Rng::new(seed, Stream::Truths);
        let [low, high] = self.plan.multiple;
        let mut put = |effect: &'static dyn Effect| {
            let multiple = rng.between(low, high);
            self.plant(effect, multiple, &mut rng)
        };
        let in_turn = |n: usize| effects[n % effects.len()];
        let planted: Vec<Planted> = match kind {
            _ if effects.is_empty() => Vec::new(),
            Kind::None => Vec::new(),
            Kind::Single => put(in_turn(nth)).into_iter().collect(),
            // From the other end, so that a few cases already show most effects.
            Kind::Removed => {
                put(in_turn(effects.len() - 1 - nth % effects.len())).into_iter().collect()
            }
            Kind::Pair => {
                // Every effect meets all others in the course of many cases.
                let step = 1 + (nth / effects.len()) % (effects.len() - 1).max(1);
                let both = [in_turn(nth), in_turn(nth + step)];
                both.into_iter().filter_map(&mut put).collect()
            }
        };
        let kind = match planted.len() {
            0 => Kind::None,
            1 if kind == Kind::Pair => Kind::Single,
            _ => kind,
        };
        let exact = match planted.as_slice() {
            [only] => only.exact.clone(),
            several => {
                let truths: Vec<_> = several.iter().map(|p| p.truth.clone()).collect();
                self.exact(&truths)?
            }
        };
        Ok(Setup { kind, planted, exact, seed })
    }

    /// Which of the plan's effects show on this design at some place, in random order, and which do
    /// not.
    pub(super) fn shows(&self) -> (Effects, Effects) {
        let [_, high] = self.plan.multiple;
        let moves_frames = |effect: &&dyn Effect| Nuisance::of(*effect).is_some();
        let wanted = self.plan.effects.iter().copied();
        let to_be_put = wanted.filter(|e| self.plan.frames.is_none() || !moves_frames(e));
        let (mut shown, hidden): (Effects, Effects) = to_be_put.partition(|effect| {
            let mut rng = Rng::new(self.plan.seed, Stream::Truths);
            self.plant(*effect, high, &mut rng).is_some()
        });
        Rng::new(self.plan.seed, Stream::Truths).shuffle(&mut shown);
        (shown, hidden)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_come_in_proportion_and_effects_in_turn() {
        let count = |kind: Kind| (0..200).filter(|k| turn(*k).0 == kind).count();
        assert_eq!(
            [Kind::None, Kind::Single, Kind::Pair, Kind::Removed].map(count),
            [50, 90, 30, 30]
        );
        let singles: Vec<usize> =
            (0..60).map(turn).filter(|(k, _)| *k == Kind::Single).map(|(_, nth)| nth).collect();
        assert_eq!(singles, (0..27).collect::<Vec<_>>());
    }
}
