//! One pass over the data: the products of everything that may be added with everything that is
//! already in the model, by blocks of poses. All that is asked afterwards (how much a candidate
//! explains, held out, under flipped signs, with some of the model taken out) is algebra on these.
//!
//! Memory is blocks × parameters in the model × numbers of all candidates, whatever the number of
//! rows; time is linear in rows. Blocks are worked on at once, each in the order of its rows, and
//! added up in their order: the bits do not depend on the number of threads.

use nalgebra::{DMatrix, Matrix6xX, Vector6};

use super::candidate::Candidate;
use super::layout::Layout;
use super::stack::{Seen, Stack, Sum};
use crate::diagnose::data::{Folds, Problem};
use crate::diagnose::fit::Fit;
use crate::infer::limits::CHUNK;
use crate::infer::{Choice, Products};
use crate::parallel;

/// Blocks of poses that are worked on at once, for each thread.
const AT_ONCE: usize = 2;

/// No candidates.
const NONE: &[Candidate] = &[];

/// Products of a fit's parameters and of further columns with candidates.
pub(crate) struct Gathered {
    /// Weighted, of each block of poses. Beside candidates the columns along are in the total alone.
    pub(crate) blocks: Vec<Products>,
    /// Of all rows.
    pub(crate) total: Products,
    /// Of each fold, what is measured first alone (positions, or rotations without them), in m or
    /// rad.
    pub(crate) plain: Vec<Products>,
    /// The same of each block, the model's parameters alone.
    pub(crate) plain_blocks: Vec<Products>,
}

/// What is gathered.
pub(crate) struct Wanted<'w> {
    pub(crate) problem: &'w Problem<'w>,
    pub(crate) fit: &'w Fit,
    /// Candidates whose columns stand beside the model's.
    pub(crate) along: &'w [Candidate],
    pub(crate) candidates: &'w [Candidate],
}

impl Gathered {
    pub(crate) fn new(wanted: &Wanted<'_>, folds: &Folds, weights: &Vector6<f64>) -> Self {
        let problem = wanted.problem;
        let shared = !problem.data.kind.is_difference();
        let layout = Layout::of(wanted.candidates, shared);
        let first = problem.first();
        let (main, other): (Vec<usize>, Vec<usize>) =
            problem.measured.iter().partition(|c| (first..first + 3).contains(*c));
        let kinds = [main, other];
        // All components of a kind weigh the same.
        let weigh = |kind: &[usize]| kind.first().map_or(0.0, |c| weights[*c].powi(2));
        let k = wanted.columns();
        let of_block = folds.rows_of_blocks();
        let of_rows = |rows: &Vec<usize>| {
            let (sums, alike) = wanted.sums(&layout, &kinds, rows);
            let mut white = Products::zeros(k, &layout.sizes);
            for (sum, kind) in sums.iter().zip(&kinds) {
                white.add_scaled(sum, weigh(kind));
            }
            let [main, _] = sums;
            let main = alike.unwrap_or(main);
            (white, main)
        };
        let kept = if wanted.candidates.is_empty() { k } else { wanted.parameters() };
        let (own, alone) = (Choice::first(kept, wanted.candidates), Choice::first(kept, NONE));
        let narrow = |products: Products| if kept < k { products.chosen(&own) } else { products };
        let mut total = Products::zeros(k, &layout.sizes);
        let mut plain = vec![Products::zeros(kept, &layout.sizes); folds.count];
        let (mut blocks, mut plain_blocks) = (Vec::new(), Vec::new());
        // Some blocks at once: of very many joints each has more numbers than all that is kept.
        for some in of_block.chunks(AT_ONCE * rayon::current_num_threads()) {
            let each: Vec<(Products, Products)> = parallel::each(some, &of_rows);
            for (white, main) in each {
                total.add(&white);
                let main = narrow(main);
                plain[folds.of_block[blocks.len()]].add(&main);
                plain_blocks.push(main.chosen(&alone));
                blocks.push(narrow(white));
            }
        }
        Self { blocks, total, plain, plain_blocks }
    }
}

impl Gathered {
    /// The same without what was gathered along, and of the first candidates alone.
    pub(crate) fn narrowed(&self, parameters: usize, candidates: &[Candidate]) -> Self {
        let choice = Choice::first(parameters, candidates);
        let each = |of: &[Products], choice: &Choice| of.iter().map(|p| p.chosen(choice)).collect();
        Self {
            blocks: each(&self.blocks, &choice),
            total: self.total.chosen(&choice),
            plain: each(&self.plain, &choice),
            plain_blocks: each(&self.plain_blocks, &Choice::first(parameters, NONE)),
        }
    }
}

impl Wanted<'_> {
    fn parameters(&self) -> usize {
        self.fit.model.parameters(self.problem)
    }

    /// Columns beside which candidates stand: the model's parameters, and those along.
    fn columns(&self) -> usize {
        self.parameters() + self.along.iter().map(|c| c.size).sum::<usize>()
    }

    /// Products of some rows, of each kind of component by itself, each row as precise as it is; and,
    /// where not all are alike, those of the first kind as if they were.
    fn sums(
        &self,
        layout: &Layout,
        kinds: &[Vec<usize>; 2],
        rows: &[usize],
    ) -> ([Products; 2], Option<Products>) {
        let (k, precision) = (self.columns(), &self.problem.precision);
        let mut sums = [0, 1].map(|_| Sum::zeros(k, layout));
        let mut alike = precision.differs().then(|| Sum::zeros(k, layout));
        for chunk in rows.chunks(CHUNK) {
            let mut seen: Vec<Seen> = chunk.iter().map(|row| self.row(layout, k, *row)).collect();
            let motions = DMatrix::from_fn(seen.len(), layout.motions, |r, m| seen[r].motions[m]);
            let squares = layout.squares(&motions);
            let stack = |seen: &[Seen], kind: &[usize]| {
                Stack::new(layout, k, seen, kind, &motions, &squares)
            };
            if let Some(alike) = &mut alike {
                alike.add(layout, &stack(&seen, &kinds[0]));
                let each = seen.iter_mut().zip(chunk);
                each.for_each(|(seen, row)| seen.weigh(&precision.of_row(*row)));
            }
            for (sum, kind) in sums.iter_mut().zip(kinds).filter(|(_, kind)| !kind.is_empty()) {
                sum.add(layout, &stack(&seen, kind));
            }
        }
        let products = |sum: Sum| sum.into_products(layout);
        (sums.map(products), alike.map(products))
    }

    /// Everything of one row.
    fn row(&self, layout: &Layout, k: usize, row: usize) -> Seen {
        let (problem, model) = (self.problem, &self.fit.model);
        let gap = self.fit.predicted.gaps[row];
        let columns = layout.carriers + k + layout.owned;
        let state = model.state(problem, &self.fit.predicted, row);
        let Some(sim) = state.ok().filter(|_| problem.fits[row]) else {
            let twists = Matrix6xX::zeros(columns);
            return Seen { twists, motions: vec![0.0; layout.motions], gap };
        };
        let (fitted, when) = (model.parameters(problem), problem.moments.at(row));
        let mut motions = Vec::with_capacity(layout.motions);
        let twists = sim.change(|state, loaded| {
            let actual = model.actual(problem, row, loaded);
            let scene = model.scene(problem, row, (&sim, state), &actual, &when);
            let mut twists = Matrix6xX::zeros(columns);
            let mut column = layout.carriers;
            let mut put = |block: &Matrix6xX<f64>| {
                twists.columns_mut(column, block.ncols()).copy_from(block);
                column += block.ncols();
            };
            if fitted > 0 {
                put(&model.block(problem, row, &scene));
            }
            self.along.iter().for_each(|candidate| put(&candidate.block(&scene)));
            layout.fill(self.candidates, &scene, &mut twists, &mut motions);
            twists
        });
        Seen { twists, motions, gap }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::fit::Model;
    use crate::diagnose::options::Options;
    use crate::effects::CATALOGUE;
    use crate::fixture::{bent, row, table};
    use crate::measurement::{Kind, Measurements, Row};
    use nalgebra::DVector;
    use std::sync::Arc;

    /// More rows than one chunk has.
    fn data() -> Measurements {
        let load = Vector6::new(300.0, -200.0, -800.0, 20.0, -30.0, 10.0);
        let rows = (0..CHUNK + 9).map(|k| {
            let at = k as f64;
            let q = [(0.7 * at).sin(), (1.3 * at).cos(), (2.1 * at).sin()];
            let measured = Vector6::new(0.3, 0.1 * at.sin(), 0.2, 0.0, 0.1, 0.0);
            let direction = Some(vec![1, -1, if k % 3 == 0 { 1 } else { -1 }]);
            Row { group: k, measured, direction, ..row(&q, load * (at / 20.0).cos()) }
        });
        table(rows.collect(), Kind::Pose { orientation: true })
    }

    #[test]
    fn what_shares_a_carrier_has_the_products_of_its_own_columns() {
        let (arm, data) = (bent(), data());
        let problem = Problem::new(&arm, &data, &Options::default()).unwrap();
        let model = Model::nominal(&problem);
        let predicted = Arc::new(model.predict(&problem, None).unwrap());
        let mut candidates = Candidate::all(&problem, &CATALOGUE);
        candidates.extend(Candidate::probes(&problem));
        let (along, fit) = (candidates[..5].to_vec(), Fit { model, predicted });
        let wanted =
            Wanted { problem: &problem, fit: &fit, along: &along, candidates: &candidates };
        let rows: Vec<usize> = (0..data.rows.len()).collect();
        let sums = |shared: bool| {
            let layout = Layout::of(&candidates, shared);
            assert_eq!(layout.borne.is_empty(), !shared);
            wanted.sums(&layout, &[vec![0, 1, 2], vec![3, 4, 5]], &rows)
        };
        for (shared, own) in sums(true).0.iter().zip(&sums(false).0) {
            assert_eq!((&shared.zz, &shared.zr, shared.rr), (&own.zz, &own.zr, own.rr));
            // Sums of some hundred products, of periodic motions that have rounded forty times.
            let sizes = DVector::from_iterator(
                own.xr.len(),
                own.xx.iter().flat_map(|xx| xx.diagonal().map(f64::sqrt).data.as_vec().clone()),
            );
            for (number, size) in sizes.iter().enumerate() {
                let close = |a: f64, b: f64, other: f64| {
                    assert!((a - b).abs() <= 1e-12 * size * other, "{number}: {a} {b}");
                };
                close(shared.xr[number], own.xr[number], own.rr.sqrt());
                for k in 0..own.zr.len() {
                    let other = own.zz[(k, k)].sqrt();
                    close(shared.zx[(k, number)], own.zx[(k, number)], other);
                }
            }
            for (a, b) in shared.xx.iter().zip(own.xx.iter()) {
                assert!((a - b).amax() <= 1e-12 * b.amax(), "{a}{b}");
            }
        }
    }
}
