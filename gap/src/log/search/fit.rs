//! A model of a log, fitted: what the rigid links ask, and effects at their places.

use nalgebra::DMatrix;

use super::blocks::{Blocks, correlation_time};
use super::sums::{Rows, Solver, Stack, sum};
use crate::log::effects::{LogEffect, Spot};
use crate::log::scene::{Column, Loads, Scene};

/// Rounds of linearising again; each makes the error of the values about its square.
const ROUNDS: usize = 8;

/// Values that change by less than this part are found.
const STILL: f64 = 1e-6;

/// An effect at a place, with its values.
#[derive(Clone)]
pub struct Term {
    /// The effect.
    pub effect: &'static dyn LogEffect,
    /// Where.
    pub spot: Spot,
    /// Its numbers, SI.
    pub values: Vec<f64>,
}

/// What is to be explained, and by what in any case.
pub struct Problem<'a> {
    /// The log.
    pub scene: Scene<'a>,
    /// The gap, of each joint.
    pub target: Vec<Vec<f64>>,
    /// Which rows count.
    pub counts: Vec<Vec<bool>>,
    /// Columns that are always fitted, and are no finding: the rigid links.
    pub base: Vec<Column>,
}

/// A term where it has its values. What is sought is how much is to be added to `from`.
pub struct Linear {
    /// Per unit of each number.
    pub columns: Vec<Column>,
    /// What the term does where it is, taken from the left side.
    pub done: Column,
    /// Its values there; zero of a term that is in proportion to them.
    pub from: Vec<f64>,
}

impl Term {
    /// Its columns at its values.
    pub fn linear(&self, scene: &Scene<'_>) -> Linear {
        let columns = self.effect.columns(scene, self.spot, &self.values);
        match self.effect.value(scene, self.spot, &self.values) {
            Some(mut done) => {
                let rows = done.parts.iter_mut().flat_map(|(_, rows)| rows);
                rows.for_each(|x| *x = -*x);
                Linear { columns, done, from: self.values.clone() }
            }
            None => Linear {
                columns,
                done: Column::default(),
                from: vec![0.0; self.effect.numbers().len()],
            },
        }
    }
}

/// A fit.
#[derive(Clone)]
pub struct Fitted {
    /// With their values.
    pub terms: Vec<Term>,
    /// The base's columns, then the terms' in their order.
    pub columns: Vec<Column>,
    /// What they are fitted to.
    pub left: Column,
    /// Values of all columns.
    pub values: Vec<f64>,
    /// What is left, of each joint.
    pub residual: Vec<Vec<f64>>,
}

impl Fitted {
    /// What it asks of the drives; the base's columns are the first so many.
    pub fn loads(&self, base: usize) -> Loads {
        let part = |count: usize| {
            let mut part: Vec<Vec<f64>> =
                self.residual.iter().map(|r| vec![0.0; r.len()]).collect();
            for (column, value) in self.columns.iter().zip(&self.values).take(count) {
                for (joint, rows) in &column.parts {
                    part[*joint].iter_mut().zip(rows).for_each(|(x, c)| *x += value * c);
                }
            }
            part
        };
        Loads { rigid: part(base), whole: part(self.columns.len()) }
    }
}

impl Problem<'_> {
    /// Fits the base and these terms by least squares, each joint's rows told in its size; `loads` are
    /// those of the model before.
    pub fn fit(&self, terms: &[Term], sizes: &[f64], loads: &Loads) -> Fitted {
        let scene = Scene { loads, ..self.scene };
        let mut terms = terms.to_vec();
        let rows = Rows { counts: self.counts.clone(), sizes: sizes.to_vec() };
        let whole = Blocks::whole(self.scene.signals.rows());
        for round in 1.. {
            let linear: Vec<Linear> = terms.iter().map(|t| t.linear(&scene)).collect();
            let bends = linear.iter().any(|l| !l.done.parts.is_empty());
            let left = self.left(&linear);
            let from: Vec<f64> = linear.iter().flat_map(|l| l.from.clone()).collect();
            let own = linear.into_iter().flat_map(|l| l.columns);
            let columns: Vec<Column> = self.base.iter().cloned().chain(own).collect();
            let all: Vec<&Column> = columns.iter().chain([&left]).collect();
            let stack = Stack::of(&all, &rows);
            let products = sum(stack.products(&stack, &whole).iter());
            let products = products.unwrap_or_else(|| DMatrix::zeros(all.len(), all.len()));
            let values = minimum(&products);
            let found = values[self.base.len()..].iter().zip(&from).map(|(by, from)| from + by);
            let own = terms.iter_mut().flat_map(|term| &mut term.values);
            let mut moved = 0.0_f64;
            for (value, found) in own.zip(found) {
                moved = moved.max((found - *value).abs() / (1e-9 + found.abs()));
                *value = found;
            }
            if !bends || moved < STILL || round == ROUNDS {
                let residual = residual(&columns, &left, &values);
                return Fitted { terms, columns, left, values, residual };
            }
        }
        unreachable!("the rounds are counted")
    }

    /// The target less what terms do where they are.
    fn left(&self, linear: &[Linear]) -> Column {
        let mut target = self.target.clone();
        for (joint, rows) in linear.iter().flat_map(|l| &l.done.parts) {
            target[*joint].iter_mut().zip(rows).for_each(|(x, done)| *x += done);
        }
        Column { parts: target.into_iter().enumerate().collect() }
    }

    /// Root mean square of each joint's rows that count.
    pub fn sizes(&self, rows: &[Vec<f64>]) -> Vec<f64> {
        let size = |(rows, counts): (&Vec<f64>, &Vec<bool>)| {
            let used = rows.iter().zip(counts).filter(|(_, c)| **c).map(|(x, _)| x * x);
            let (sum, count) = used.fold((0.0, 0.0), |(sum, n), x| (sum + x, n + 1.0));
            // A joint without rows has no size: it is told in one.
            if sum > 0.0 { f64::sqrt(sum / count) } else { 1.0 }
        };
        rows.iter().zip(&self.counts).map(size).collect()
    }

    /// The correlation time of each joint's rows, s.
    pub fn correlation(&self, rows: &[Vec<f64>]) -> Vec<f64> {
        let signals = self.scene.signals;
        let pairs = rows.iter().zip(&self.counts);
        pairs.map(|(rows, counts)| correlation_time(rows, counts, signals)).collect()
    }
}

/// The values of least squares, of products whose last column is the left side's.
pub fn minimum(products: &DMatrix<f64>) -> Vec<f64> {
    let n = products.nrows() - 1;
    let matrix = products.view((0, 0), (n, n)).into_owned();
    let right = products.view((0, n), (n, 1)).into_owned();
    Solver::of(&matrix).solve(&right).column(0).iter().copied().collect()
}

/// What columns leave of the left side.
pub fn residual(columns: &[Column], left: &Column, values: &[f64]) -> Vec<Vec<f64>> {
    let mut residual: Vec<Vec<f64>> = left.parts.iter().map(|(_, rows)| rows.clone()).collect();
    for (column, value) in columns.iter().zip(values) {
        for (joint, rows) in &column.parts {
            residual[*joint].iter_mut().zip(rows).for_each(|(x, c)| *x -= value * c);
        }
    }
    residual
}
