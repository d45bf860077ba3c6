//! Stability of a finding: how often it is the best explanation again when only half of the poses
//! are there (Meinshausen & Bühlmann 2010).

use nalgebra::{DMatrix, DVector};

use crate::constants::FEWEST_TO_JUDGE;
use crate::diagnose::normal_equations::Screen;
use crate::diagnose::search::{Explained, Search};
use crate::infer::constants::OWN;
use crate::infer::{Basis, Observations, Own, Products, Scale};
use crate::parallel;
use crate::rng::{Rng, Stream};

/// Random halves.
const HALVES: usize = 40;

/// Candidates far behind on all poses are not the best on half of them.
const CONTENDERS: usize = 24;

impl Search<'_, '_> {
    /// Part of the halves in which one of `is_it` is the best of the contenders, which come best
    /// first; 1 where the poses are too few to be halved.
    pub(crate) fn stability(
        &self,
        screen: &Screen<'_>,
        contenders: &[usize],
        now: &Explained,
        is_it: &(dyn Fn(usize) -> bool + Sync),
    ) -> f64 {
        let blocks = screen.blocks.len();
        if blocks < FEWEST_TO_JUDGE {
            return 1.0;
        }
        let contenders: Vec<usize> = contenders.iter().copied().take(CONTENDERS).collect();
        let mut generator = Rng::new(self.options.seed, Stream::Halves);
        let halves: Vec<Vec<usize>> = (0..HALVES).map(|_| generator.order(blocks)).collect();
        let found_again = |order: &Vec<usize>| {
            let half: Vec<&Products> =
                order.iter().take(blocks / 2).map(|b| &screen.blocks[*b]).collect();
            let costs = self.costs(screen, &half, &contenders, now);
            let best = costs.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
            best.is_some_and(|(candidate, _)| is_it(candidate))
        };
        let again = parallel::each(&halves, &found_again);
        again.iter().filter(|again| **again).count() as f64 / HALVES as f64
    }

    /// Cost of each contender on some of the blocks, at the noise of all.
    fn costs(
        &self,
        screen: &Screen<'_>,
        half: &[&Products],
        contenders: &[usize],
        now: &Explained,
    ) -> Vec<(usize, f64)> {
        let k = screen.basis.rank();
        let (mut zz, mut zr) = (screen.prior.zz.clone(), screen.prior.zr.clone());
        for block in half {
            zz += &block.zz;
            zr += &block.zr;
        }
        let basis = Basis::new(&zz);
        let zr = basis.t.tr_mul(&zr);
        let fitted = now.fit.model.parameters(self.problem);
        let variance = self.scale(now).variance(self.left(now), fitted);
        let numbers = self.problem.numbers() * half.len() / screen.blocks.len();
        let cost = |&candidate: &usize| {
            let range = screen.range(candidate);
            let p = range.len();
            let xx = screen.prior.xx[candidate].clone();
            let mut own = Own { zx: DMatrix::zeros(k, p), xr: DVector::zeros(p), xx };
            for block in half {
                own.zx += block.zx.columns_range(range.clone());
                own.xr += block.xr.rows_range(range.clone());
                own.xx += &block.xx[candidate];
            }
            own.zx = basis.t.tr_mul(&own.zx);
            let it = &screen.candidates[candidate];
            let score = own.score(&zr, it);
            if score.own <= OWN {
                return (candidate, f64::MAX);
            }
            let price = own.price(&it.usual.held, &score.values, numbers, variance);
            (candidate, Scale::cost(price, it.usual.multiplicity) - score.drop / variance)
        };
        contenders.iter().map(cost).collect()
    }
}
