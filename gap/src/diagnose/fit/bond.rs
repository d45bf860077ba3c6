//! What is known of the bench beside the rows: distances between its points and what a lens is near, told to the fit
//! as further measurements of its constants.

use nalgebra::{DMatrix, DVector, Vector3};

use super::model::Model;
use crate::diagnose::data::{Problem, Thing};
use crate::observe::{Pair, View};

/// A measurement of constants alone.
pub(crate) struct Bond {
    /// Its derivatives by some parameters of the model, over its standard deviation.
    columns: Vec<(usize, f64)>,
    /// Measured minus fitted, over the same.
    left: f64,
}

impl Bond {
    /// All of a model.
    pub(super) fn all(problem: &Problem<'_>, model: &Model) -> Vec<Bond> {
        let begins = Model::begins_of_bench(problem);
        let of_pair = |(pair, places): &(Pair, [Place; 2])| {
            let (left, by_first) = pair.weighed(places.map(|place| place.at(model)));
            let mut columns = Vec::new();
            for (place, by) in places.iter().zip([by_first, -by_first]) {
                if let Place::Fitted(thing) = place {
                    columns.extend((0..3).map(|k| (begins[*thing] + k, by[k])));
                }
            }
            Bond { columns, left }
        };
        let of_lens = |(number, (thing, view)): (usize, (&Thing, &View))| {
            let free = thing.aim.free.iter().enumerate();
            let of = free.filter_map(move |(k, constant)| {
                let (left, by) = view.strayed(&thing.aim.view, *constant)?;
                Some((k, left, by))
            });
            let begin = begins[number];
            let bond = move |(k, left, by)| Bond { columns: vec![(begin + k, by)], left };
            of.map(bond).collect::<Vec<_>>()
        };
        let things = problem.bench.iter().zip(&model.bench).enumerate();
        problem.pairs.iter().map(of_pair).chain(things.flat_map(of_lens)).collect()
    }

    /// Adds it to normal equations whose first parameters are the model's.
    pub(crate) fn add(&self, normal: &mut DMatrix<f64>, right: &mut DVector<f64>) {
        for (at, by) in &self.columns {
            right[*at] += by * self.left;
            self.columns.iter().for_each(|(other, with)| normal[(*at, *other)] += by * with);
        }
    }

    /// The square of what it leaves.
    pub(crate) fn square(&self) -> f64 {
        self.left * self.left
    }
}

/// One end of a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Place {
    /// m, measuring frame.
    Known(Vector3<f64>),
    /// Of the bench's unknown things, the one of this number.
    Fitted(usize),
}

impl Place {
    /// Where it is by a model, m, measuring frame.
    pub(crate) fn at(self, model: &Model) -> Vector3<f64> {
        match self {
            Place::Known(at) => at,
            // A pair's ends are points, which are in a place.
            Place::Fitted(thing) => model.bench[thing].place().unwrap_or_default(),
        }
    }
}
