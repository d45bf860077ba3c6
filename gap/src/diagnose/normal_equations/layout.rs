//! Which columns the candidates have, and what they have in common: most of them move the same few
//! joints and frames, each by another law.

use std::ops::Range;

use super::candidate::{Candidate, Source};
use super::probe::Probe;
use crate::effects::{Carrier, Effect, Scene, Spot};
use crate::infer::starts;
use nalgebra::{DMatrix, Matrix6xX};

/// A candidate that moves a carrier.
pub(crate) struct Moving {
    pub(crate) candidate: usize,
    /// Its motions among all.
    pub(crate) motions: Range<usize>,
}

/// A carrier and all that move it.
pub(crate) struct Borne {
    pub(crate) carrier: Carrier,
    /// Its columns among those of all carriers.
    pub(crate) columns: Range<usize>,
    /// The motions of all its candidates among all motions.
    pub(crate) motions: Range<usize>,
    pub(crate) candidates: Vec<Moving>,
    /// The products of each of these candidates' motions with each other among all such products.
    pub(crate) squares: Range<usize>,
    /// Its number among the carriers.
    pub(crate) index: usize,
    /// Whose motions these are, in their order.
    movers: Vec<Mover>,
}

/// What adds motions: candidates of one effect that follow each other, or a probe.
enum Mover {
    Effect(&'static dyn Effect, Vec<Spot>),
    Probe(Probe),
}

impl Borne {
    fn moved_by(&mut self, source: &Source) {
        match (self.movers.last_mut(), source) {
            (Some(Mover::Effect(last, spots)), Source::Effect { effect, spot })
                if last.identifier() == effect.identifier() =>
            {
                spots.push(*spot);
            }
            (_, Source::Effect { effect, spot }) => {
                self.movers.push(Mover::Effect(*effect, vec![*spot]));
            }
            (_, Source::Probe(probe)) => self.movers.push(Mover::Probe(*probe)),
        }
    }
}

/// The columns of a list of candidates.
pub(crate) struct Layout {
    /// Numbers of each candidate.
    pub(crate) sizes: Vec<usize>,
    /// First number of each candidate.
    pub(crate) at: Vec<usize>,
    pub(crate) borne: Vec<Borne>,
    /// Columns of all carriers.
    pub(crate) carriers: usize,
    /// Motions of all candidates.
    pub(crate) motions: usize,
    /// Products of the motions of each candidate with each other.
    pub(crate) squares: usize,
    /// Candidates with columns of their own, and where these are among all such columns.
    pub(crate) own: Vec<(usize, Range<usize>)>,
    /// All columns of their own.
    pub(crate) owned: usize,
}

impl Layout {
    /// `shared`: whether candidates that move one carrier stand together. Not so where the reading
    /// is the difference of two states: what a carrier does in each almost cancels, and has to
    /// before squares are taken.
    pub(crate) fn of(candidates: &[Candidate], shared: bool) -> Layout {
        let sizes: Vec<usize> = candidates.iter().map(|c| c.size).collect();
        let mut borne: Vec<Borne> = Vec::new();
        let mut own = Vec::new();
        let mut owned = 0;
        for (index, candidate) in candidates.iter().enumerate() {
            let Some(carrier) = candidate.carrier().filter(|_| shared) else {
                own.push((index, owned..owned + candidate.size));
                owned += candidate.size;
                continue;
            };
            let known = borne.iter().position(|b| b.carrier == carrier);
            let at = known.unwrap_or_else(|| {
                let candidates = Vec::new();
                let (index, none) = (borne.len(), 0..0);
                let (columns, motions, squares) = (none.clone(), none.clone(), none);
                let movers = Vec::new();
                borne.push(Borne { carrier, columns, motions, candidates, squares, index, movers });
                index
            });
            let count = candidate.size / carrier.size();
            borne[at].candidates.push(Moving { candidate: index, motions: 0..count });
            borne[at].moved_by(&candidate.source);
        }
        let (mut carriers, mut motions, mut squares) = (0, 0, 0);
        for one in &mut borne {
            one.columns = carriers..carriers + one.carrier.size();
            carriers = one.columns.end;
            let first = motions;
            for moving in &mut one.candidates {
                moving.motions = motions..motions + moving.motions.len();
                motions = moving.motions.end;
            }
            one.motions = first..motions;
            let count: usize = one.candidates.iter().map(|c| pairs(c.motions.len()).count()).sum();
            one.squares = squares..squares + count;
            squares += count;
        }
        let at = starts(&sizes);
        Layout { sizes, at, borne, carriers, motions, squares, own, owned }
    }

    /// Puts the twists of all carriers, and of all candidates with columns of their own, into the
    /// first and the last columns of `twists`; adds all motions.
    pub(crate) fn fill(
        &self,
        candidates: &[Candidate],
        scene: &Scene<'_>,
        twists: &mut Matrix6xX<f64>,
        motions: &mut Vec<f64>,
    ) {
        for borne in &self.borne {
            let into = borne.columns.clone();
            twists.columns_range_mut(into).copy_from(&borne.carrier.twists(scene.state));
            for mover in &borne.movers {
                match mover {
                    Mover::Effect(effect, spots) => effect.motions_of(scene, spots, motions),
                    Mover::Probe(probe) => probe.motions(scene, motions),
                }
            }
        }
        let first = twists.ncols() - self.owned;
        for (candidate, columns) in &self.own {
            let into = first + columns.start..first + columns.end;
            twists.columns_range_mut(into).copy_from(&candidates[*candidate].block(scene));
        }
    }

    /// Row by row the products of each candidate's motions with each other.
    pub(crate) fn squares(&self, motions: &DMatrix<f64>) -> DMatrix<f64> {
        let mut squares = DMatrix::zeros(motions.nrows(), self.squares);
        let candidates = self.borne.iter().flat_map(|b| &b.candidates);
        let each = candidates.flat_map(|c| {
            let from = c.motions.start;
            pairs(c.motions.len()).map(move |(m, n)| (from + m, from + n))
        });
        for (mut products, (a, b)) in squares.column_iter_mut().zip(each) {
            products.copy_from(&motions.column(a));
            products.component_mul_assign(&motions.column(b));
        }
        squares
    }

    /// Where column `column` of a carrier, moved by motion `motion` of a candidate, is among the
    /// numbers of all candidates.
    pub(crate) fn number(
        &self,
        borne: &Borne,
        moving: &Moving,
        motion: usize,
        column: usize,
    ) -> usize {
        self.at[moving.candidate] + motion * borne.columns.len() + column
    }
}

/// All pairs of so many, the first not after the second.
pub(crate) fn pairs(count: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..count).flat_map(move |m| (m..count).map(move |n| (m, n)))
}
