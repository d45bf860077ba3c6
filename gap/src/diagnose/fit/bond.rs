//! What is known beside the rows: distances between points of the bench, what a lens is near, the joints' springs as a
//! log has them. The fit takes them as further measurements of its parameters.

use nalgebra::{DMatrix, DVector, Vector3};

use super::model::Model;
use crate::diagnose::data::{Problem, Thing};
use crate::instrument::{Pair, View};
use crate::spring::Spring;

/// A measurement of parameters alone.
pub(crate) struct Bond {
    /// Its derivatives by some parameters of the model, over its standard deviation.
    pub(crate) columns: Vec<(usize, f64)>,
    /// Measured minus fitted, over the same.
    pub(crate) left: f64,
    /// The joint whose spring it measures, which the model may lack, and its derivative by that, over the same.
    pub(crate) spring: Option<(usize, f64)>,
}

impl Bond {
    /// All of a model, at its values.
    pub(crate) fn all(problem: &Problem<'_>, model: &Model) -> Vec<Bond> {
        let begins = Model::begins_of_bench(problem);
        let of_pair = |(pair, places): &(Pair, [Place; 2])| {
            let (left, by_first) = pair.weighed(places.map(|place| place.at(model)));
            let mut columns = Vec::new();
            for (place, by) in places.iter().zip([by_first, -by_first]) {
                if let Place::Fitted(thing) = place {
                    columns.extend((0..3).map(|k| (begins[*thing] + k, by[k])));
                }
            }
            Bond { columns, left, spring: None }
        };
        let of_lens = |(number, (thing, view)): (usize, (&Thing, &View))| {
            let free = thing.aim.free.iter().enumerate();
            let of = free.filter_map(move |(k, constant)| {
                let (left, by) = view.strayed(&thing.aim.view, *constant)?;
                Some((k, left, by))
            });
            let begin = begins[number];
            let columns = move |k: usize, by: f64| vec![(begin + k, by)];
            let bond = move |(k, left, by)| Bond { columns: columns(k, by), left, spring: None };
            of.map(bond).collect::<Vec<_>>()
        };
        let of_spring = |spring: &Spring| {
            let more = spring.value - problem.arm.joints[spring.joint].compliance;
            let by = 1.0 / spring.deviation();
            let own = model.found.iter().position(|found| found.is_spring_of(spring.joint));
            let before =
                own.map(|own| model.found[..own].iter().map(|f| f.values.len()).sum::<usize>());
            let at = before.map(|before| Model::nuisances(problem) + before);
            Bond {
                columns: at.map(|at| (at, by)).into_iter().collect(),
                left: by * (more - own.map_or(0.0, |own| model.found[own].values[0])),
                spring: Some((spring.joint, by)),
            }
        };
        let things = problem.bench.iter().zip(&model.bench).enumerate();
        let of_bench = problem.pairs.iter().map(of_pair).chain(things.flat_map(of_lens));
        of_bench.chain(problem.springs.iter().map(of_spring)).collect()
    }

    /// The same of some of the parameters (ascending), the values `back` of all given back to what is left.
    pub(crate) fn chosen(&self, kept: &[usize], back: &[f64]) -> Bond {
        let given_back = self.columns.iter().map(|(at, by)| by * back[*at]).sum::<f64>();
        let own = |(at, by): &(usize, f64)| Some((kept.binary_search(at).ok()?, *by));
        let columns = self.columns.iter().filter_map(own).collect();
        Bond { columns, left: self.left + given_back, spring: self.spring }
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
