//! What is known of the bench beside the rows: distances between its points, told to the fit as further
//! measurements of its constants.

use nalgebra::{DMatrix, DVector, Vector3};

use super::model::Model;
use crate::diagnose::data::Problem;

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
        let first = Model::nuisances(problem)
            - problem.bench.iter().map(|t| t.aim.free.len()).sum::<usize>();
        let begin = |thing: usize| {
            first + problem.bench[..thing].iter().map(|t| t.aim.free.len()).sum::<usize>()
        };
        let of_pair = |(pair, places): &(_, [Place; 2])| {
            let pair: &crate::observe::Pair = pair;
            let at = |place: &Place| match place {
                Place::Known(at) => *at,
                Place::Fitted(thing) => model.bench[*thing].place().unwrap_or_default(),
            };
            let (left, by_first) = pair.weighed([at(&places[0]), at(&places[1])]);
            let mut columns = Vec::new();
            for (place, by) in places.iter().zip([by_first, -by_first]) {
                if let Place::Fitted(thing) = place {
                    columns.extend((0..3).map(|k| (begin(*thing) + k, by[k])));
                }
            }
            Bond { columns, left }
        };
        problem.pairs.iter().map(of_pair).collect()
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
