//! What could be added to a model: its held-out squares, and how likely chance is to do as well.

use nalgebra::{DMatrix, DVector};

use super::blocks::Blocks;
use super::fit::{Fitted, Term, minimum};
use super::sums::{Rows, Solver, Stack, sum};
use crate::dice::{Dice, Stream};
use crate::log::scene::{Column, Scene};

/// Random signs; the smallest chance that they tell is one in so many.
const FLIPS: usize = 999;

/// Rounds in which a candidate's values are linearised again.
const ROUNDS: usize = 4;

/// A model at its values, with the products of its columns, block by block.
pub struct Ground<'p> {
    scene: Scene<'p>,
    blocks: &'p Blocks,
    rows: Rows,
    /// The columns and the left side.
    stack: Stack,
    products: Vec<DMatrix<f64>>,
    /// Of the columns alone, over all blocks.
    solver: Solver,
    values: DVector<f64>,
    /// Squares that are left, held out, of each block.
    pub squares: Vec<f64>,
}

/// A term that could be added.
pub struct Candidate {
    /// With the values it would have.
    pub term: Term,
    /// Squares that are left with it, held out, of each block.
    pub squares: Vec<f64>,
    /// Whether it says anything beside the model.
    pub seen: bool,
    /// Of each probe what each block says for it, and the inverse of what it weighs.
    scores: Vec<Scores>,
}

/// How the blocks pull at a probe's numbers, each told so that their squares add up to one.
struct Scores {
    blocks: Vec<DVector<f64>>,
}

/// A candidate's columns beside the ground's.
struct Beside {
    /// With the ground's columns and left side, of each block.
    cross: Vec<DMatrix<f64>>,
    /// With each other.
    own: Vec<DMatrix<f64>>,
    /// What their values are added to.
    from: Vec<f64>,
}

impl<'p> Ground<'p> {
    /// Of a fit, told in these sizes.
    pub fn of(
        scene: Scene<'p>,
        counts: &[Vec<bool>],
        fit: &Fitted,
        sizes: &[f64],
        blocks: &'p Blocks,
    ) -> Self {
        let rows = Rows { counts: counts.to_vec(), sizes: sizes.to_vec() };
        let all: Vec<&Column> = fit.columns.iter().chain([&fit.left]).collect();
        let stack = Stack::of(&all, &rows);
        let products = stack.products(&stack, blocks);
        let n = fit.columns.len();
        let whole = sum(products.iter()).unwrap_or_else(|| DMatrix::zeros(n + 1, n + 1));
        let solver = Solver::of(&whole.view((0, 0), (n, n)).into_owned());
        let values = solver.solve(&whole.view((0, n), (n, 1)).into_owned()).column(0).into_owned();
        let squares = held_out(&products, blocks);
        Ground { scene, blocks, rows, stack, products, solver, values, squares }
    }

    /// A term that the model lacks, its values sought from all its starts.
    pub fn candidate(&self, term: &Term) -> Candidate {
        let at = |values: Vec<f64>| Term { values, ..term.clone() };
        let probes = term.effect.probes();
        let scores = probes.into_iter().map(|probe| self.scores(&self.beside(&at(probe))));
        let scores: Vec<Scores> = scores.collect();
        let mut best: Option<(Term, Vec<f64>, bool)> = None;
        for start in term.effect.starts() {
            let mut values = start;
            for _ in 0..ROUNDS {
                let here = at(values);
                let bends = here.effect.value(&self.scene, here.spot, &here.values).is_some();
                let (squares, found, seen) = self.with(&here);
                let total: f64 = squares.iter().sum();
                let better = best.as_ref().is_none_or(|b| total < b.1.iter().sum());
                if better {
                    best = Some((at(found.clone()), squares, seen));
                }
                if !bends || !better {
                    break;
                }
                values = found;
            }
        }
        let nothing = || (at(vec![0.0; term.effect.numbers().len()]), self.squares.clone(), false);
        let (term, squares, seen) = best.unwrap_or_else(nothing);
        Candidate { term, squares, seen, scores }
    }

    fn beside(&self, term: &Term) -> Beside {
        let linear = term.linear(&self.scene);
        let all: Vec<&Column> = linear.columns.iter().chain([&linear.done]).collect();
        let stack = Stack::of(&all, &self.rows);
        Beside {
            cross: self.stack.products(&stack, self.blocks),
            own: stack.products(&stack, self.blocks),
            from: linear.from,
        }
    }

    /// Held-out squares with a term linearised at its values, the values that it then has, whether all
    /// data say anything of it.
    fn with(&self, term: &Term) -> (Vec<f64>, Vec<f64>, bool) {
        let beside = self.beside(term);
        let (n, q) = (self.values.len(), term.effect.numbers().len());
        let bordered = |((ground, cross), own): ((&DMatrix<f64>, &DMatrix<f64>), &DMatrix<f64>)| {
            let mut all = DMatrix::zeros(n + q + 1, n + q + 1);
            all.view_mut((0, 0), (n, n)).copy_from(&ground.view((0, 0), (n, n)));
            all.view_mut((0, n), (n, q)).copy_from(&cross.view((0, 0), (n, q)));
            all.view_mut((n, n), (q, q)).copy_from(&own.view((0, 0), (q, q)));
            // The left side is the ground's, less what the term does where it is.
            let last = n + q;
            for row in 0..n {
                all[(row, last)] = ground[(row, n)] + cross[(row, q)];
            }
            for row in 0..q {
                all[(n + row, last)] = cross[(n, row)] + own[(row, q)];
            }
            all[(last, last)] = ground[(n, n)] + 2.0 * cross[(n, q)] + own[(q, q)];
            all.fill_lower_triangle_with_upper_triangle();
            all
        };
        let pairs = self.products.iter().zip(&beside.cross).zip(&beside.own);
        let products: Vec<DMatrix<f64>> = pairs.map(bordered).collect();
        let whole = sum(products.iter()).unwrap_or_else(|| DMatrix::zeros(n + q + 1, n + q + 1));
        let seen = Solver::of(&whole.view((0, 0), (n + q, n + q)).into_owned()).seen;
        let from = beside.from.iter();
        let values = minimum(&whole)[n..].iter().zip(from).map(|(by, from)| from + by).collect();
        (held_out(&products, self.blocks), values, seen[n..].contains(&true))
    }

    /// What each block says for a probe, beside all that the model does.
    fn scores(&self, beside: &Beside) -> Scores {
        let n = self.values.len();
        let q = beside.own.first().map_or(0, DMatrix::nrows).saturating_sub(1);
        let cross = sum(beside.cross.iter()).unwrap_or_else(|| DMatrix::zeros(n + 1, q + 1));
        let own = sum(beside.own.iter()).unwrap_or_else(|| DMatrix::zeros(q + 1, q + 1));
        let cross = cross.view((0, 0), (n, q)).into_owned();
        let along = self.solver.solve(&cross);
        let apart = own.view((0, 0), (q, q)) - cross.tr_mul(&along);
        let root = Solver::inverse_root(&apart, &own.diagonal());
        let block = |(ground, cross): (&DMatrix<f64>, &DMatrix<f64>)| {
            let left =
                ground.view((0, n), (n, 1)).column(0) - ground.view((0, 0), (n, n)) * &self.values;
            let explained = cross.view((0, 0), (n, q)).tr_mul(&self.values);
            cross.view((n, 0), (1, q)).transpose().column(0) - explained - along.tr_mul(&left)
        };
        let pairs = self.products.iter().zip(&beside.cross);
        let mut blocks: Vec<DVector<f64>> = pairs.map(|pair| &root * block(pair)).collect();
        let size = blocks.iter().map(DVector::norm_squared).sum::<f64>().sqrt();
        if size > 0.0 {
            blocks.iter_mut().for_each(|b| *b /= size);
        }
        Scores { blocks }
    }

    /// Of each candidate the chance that something unrelated looks as good among as many.
    ///
    /// Under the signs of whole blocks what is left is as likely as it is; the largest of all candidates
    /// under random signs is what each is held against (Westfall & Young 1993; signs by blocks:
    /// Cameron, Gelbach & Miller 2008).
    pub fn chances(&self, candidates: &[Candidate], seed: u64) -> Vec<f64> {
        let mut dice = Dice::new(seed, Stream::Visits);
        let count = self.products.len();
        let found: Vec<f64> = candidates.iter().map(|c| c.size(&vec![1.0; count])).collect();
        let mut as_good = vec![1.0; candidates.len()];
        for _ in 0..FLIPS {
            let signs: Vec<f64> = (0..count).map(|_| dice.sign()).collect();
            let largest = candidates.iter().map(|c| c.size(&signs)).fold(0.0, f64::max);
            for (n, found) in as_good.iter_mut().zip(&found) {
                // Signs that are all one are the data's own: of few blocks they come often.
                *n += f64::from(u8::from(largest >= found * (1.0 - 1e-12)));
            }
        }
        as_good.into_iter().map(|n| n / (FLIPS + 1) as f64).collect()
    }
}

impl Candidate {
    /// By how much its blocks pull together under signs: 1 on average where they do not.
    fn size(&self, signs: &[f64]) -> f64 {
        let of = |scores: &Scores| {
            let numbers = scores.blocks.first().map_or(0, DVector::len);
            let pull =
                |k: usize| scores.blocks.iter().zip(signs).map(|(b, s)| s * b[k]).sum::<f64>();
            (0..numbers).map(|k| pull(k).powi(2)).sum::<f64>()
        };
        self.scores.iter().map(of).fold(0.0, f64::max)
    }
}

/// Values of least squares without each fold, of products by block.
pub fn without_each(products: &[DMatrix<f64>], blocks: &Blocks) -> Vec<Vec<f64>> {
    let Some(whole) = sum(products.iter()) else { return Vec::new() };
    let of = |fold: usize| {
        let own = products.iter().zip(&blocks.fold).filter(|(_, f)| **f == fold).map(|(p, _)| p);
        minimum(&sum(own).map_or_else(|| whole.clone(), |out| &whole - out))
    };
    (0..blocks.folds).map(of).collect()
}

/// Squares that are left in each block by the fit to all folds but its own.
fn held_out(products: &[DMatrix<f64>], blocks: &Blocks) -> Vec<f64> {
    let values = without_each(products, blocks);
    let square = |(product, fold): (&DMatrix<f64>, &usize)| {
        let mut values = values[*fold].clone();
        values.push(-1.0);
        let values = DVector::from_vec(values);
        values.dot(&(product * &values)).max(0.0)
    };
    products.iter().zip(&blocks.fold).map(square).collect()
}
