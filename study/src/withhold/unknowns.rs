//! What is fitted along whatever a case has, frames and the bench's unknown constants: what they can take up is no
//! effect's to show.

use nalgebra::{DMatrix, DVector};

use super::campaign::Bench;
use super::exact;
use crate::diagnose::Nuisance;
use crate::infer::Basis;
use crate::instrument::{Aim, Pair, Seen};
use crate::measurement::{Measurements, Row};
use crate::plant::{PlantError, Truth};

/// By how much unknowns are moved to see what they do, m, rad, or parts of a focal length.
const MOVED: f64 = 1e-5;

impl Bench<'_> {
    /// What all of them could do to the whitened gap, and which of that is decided.
    pub(super) fn what_unknowns_do(&self) -> Result<(DMatrix<f64>, Basis), PlantError> {
        let mut columns = self.what_the_bench_does()?;
        if self.own.frames.is_some() {
            columns.extend(self.what_frames_do()?);
        }
        let columns = match columns.is_empty() {
            true => DMatrix::zeros(0, 0),
            false => DMatrix::from_columns(&columns),
        };
        let basis = Basis::new(&columns.tr_mul(&columns));
        Ok((columns, basis))
    }

    fn what_frames_do(&self) -> Result<Vec<DVector<f64>>, PlantError> {
        let mut columns = Vec::new();
        for effect in Nuisance::ALL.map(Nuisance::effect) {
            let places = effect.places(self.plan.arm).into_iter();
            for (place, number) in places
                .flat_map(|p| effect.numbers(self.plan.arm, p).into_iter().map(move |n| (p, n)))
            {
                let values = vec![(number.name.into_owned(), MOVED)];
                columns.push(self.whitened(&self.exact(&[Truth { effect, place, values }])?));
            }
        }
        Ok(columns)
    }

    /// Each free constant of each thing moved in all rows that read it.
    fn what_the_bench_does(&self) -> Result<Vec<DVector<f64>>, PlantError> {
        let thing = |row: &Row| {
            let aim = row.aim.as_deref().filter(|aim| !aim.free.is_empty())?;
            Some((aim.instrument(), row.session.clone()))
        };
        let mut things = Vec::new();
        for one in self.own.design.rows.iter().filter_map(thing) {
            if !things.contains(&one) {
                things.push(one);
            }
        }
        let each = things.iter().flat_map(|one| (0..one.0.free.len()).map(move |k| (one, k)));
        let moved = each.map(|(one, k)| {
            let mut by = vec![0.0; one.0.free.len()];
            by[k] = MOVED;
            let mut design = self.own.design.clone();
            for row in design.rows.iter_mut().filter(|row| thing(row).as_ref() == Some(one)) {
                row.aim.iter_mut().for_each(|aim| aim.view = aim.moved(aim.view, &by));
            }
            let whole = self.own.whole(self.plan.arm);
            let shown = exact(whole, &[], self.own.frames.as_ref(), &design)?;
            Ok(self.whitened(&shown))
        });
        moved.collect()
    }

    /// How much farther apart than they are the places of each known distance stand, over its standard deviation.
    pub(super) fn apart(&self, shown: &Measurements) -> Vec<f64> {
        let apart = |data: &Measurements, pair: &Pair| {
            let place = |name: &String| {
                let aims = data.rows.iter().filter_map(|row| row.aim.as_deref());
                let own = |aim: &&Aim| aim.seen == Seen::Point && aim.name == *name;
                aims.filter(own).find_map(|aim| aim.view.place())
            };
            Some((place(&pair.points[0])? - place(&pair.points[1])?).norm() / pair.sigma)
        };
        let each = shown.pairs.iter();
        each.filter_map(|pair| Some(apart(shown, pair)? - apart(&self.nominal, pair)?)).collect()
    }
}
