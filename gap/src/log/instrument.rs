//! The commanded motion as an instrument.
//!
//! The noise of what is differentiated stands in the columns, and, through the controller, in what they are to
//! explain: least squares are drawn off by it. A command knows nothing of that noise. The normal equations
//! `Zᵀ (y − W x) = 0` with columns `Z` of the commanded motion in place of the measured one have a solution that
//! it does not draw (of robots, with a motion that is simulated: Janot, Vandanjon & Gautier 2014).

use core::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::model::Acting;
use super::scene::{Column, Domain};
use super::search::case::{Case, Simple, Wanted};
use super::search::fit::{Links, weights};
use crate::infer::Basis;
use crate::parallel;
use crate::signal::{Signals, Span};

/// Rows that are gone through at once.
const ROWS: usize = 4096;

/// A model whose numbers are asked of the commands.
pub struct Asked<'a> {
    /// What is explained.
    pub case: &'a Case<'a>,
    /// How the drives are loaded.
    pub simple: &'a Simple,
    /// What was found.
    pub terms: &'a [Acting],
    /// What is known of the rigid links.
    pub links: &'a Links,
    /// In which each joint's rows are told.
    pub sizes: &'a [f64],
}

/// `Zᵀ W`, `Zᵀ y` and `Wᵀ W`.
struct Equations {
    crossed: DMatrix<f64>,
    right: DVector<f64>,
    own: DMatrix<f64>,
}

impl Equations {
    fn plus(self, other: Equations) -> Equations {
        Equations {
            crossed: self.crossed + other.crossed,
            right: self.right + other.right,
            own: self.own + other.own,
        }
    }

    /// What is not seen beside what stands before it stays zero, as in the fit.
    fn solved(&self) -> Option<DVector<f64>> {
        let (basis, count) = (Basis::ordered(&self.own), self.own.nrows());
        let told: Vec<usize> = (0..count).filter(|k| basis.decides(*k)).collect();
        // Columns of one size: newton-metres per radian and second are of many.
        let scale = |k: usize| 1.0 / self.own[(told[k], told[k])].sqrt();
        let at = |row: usize, column: usize| {
            self.crossed[(told[row], told[column])] * scale(row) * scale(column)
        };
        let crossed = DMatrix::from_fn(told.len(), told.len(), at);
        let right = DVector::from_fn(told.len(), |k, _| self.right[told[k]] * scale(k));
        let found = crossed.lu().solve(&right)?;
        let mut all = DVector::zeros(count);
        told.iter().enumerate().for_each(|(k, to)| all[*to] = found[k] * scale(k));
        all.iter().all(|x| x.is_finite()).then_some(all)
    }
}

impl Asked<'_> {
    /// The terms' numbers by the commands, all behind one another; `None` where there are none, where no commands
    /// are logged or the rows hold them, or where they do not tell what the motion tells.
    pub fn numbers(&self) -> Option<Vec<f64>> {
        if self.terms.is_empty() || self.case.kind.0 != Domain::Torque {
            return None;
        }
        let measured = self.case.signals;
        let mut commanded = measured.commanded()?;
        commanded.mark_ways(self.case.still);
        let chunks = measured.spans.iter().flat_map(|span| {
            let end = span.kept.end;
            span.kept.clone().step_by(ROWS).map(move |from| (span, from..(from + ROWS).min(end)))
        });
        let chunks: Vec<(&Span, Range<usize>)> = chunks.collect();
        let counts = self.case.counts();
        let of_rows =
            |(span, rows): &(&Span, Range<usize>)| self.equations(&commanded, span, rows, &counts);
        let sums = parallel::each(&chunks, &of_rows).into_iter().reduce(Equations::plus)?;
        let own: usize = self.terms.iter().map(|term| term.values.len()).sum();
        sums.solved().map(|all| all.iter().copied().skip(all.len() - own).collect())
    }

    /// Of some rows of a span.
    fn equations(
        &self,
        commanded: &Signals,
        span: &Span,
        rows: &Range<usize>,
        counts: &[Vec<bool>],
    ) -> Equations {
        let (part, before) = self.case.signals.stretch(span, rows, self.case.late);
        let (mut columns, left) = self.columns(&part, span.run);
        let (instruments, _) =
            self.columns(&commanded.stretch(span, rows, self.case.late).0, span.run);
        let count = columns.len();
        columns.push(left);
        let mut sum = Equations {
            crossed: DMatrix::zeros(count, count),
            right: DVector::zeros(count),
            own: DMatrix::zeros(count, count),
        };
        for ((joint, counts), weight) in counts.iter().enumerate().zip(weights(self.sizes)) {
            let used: Vec<usize> = rows.clone().filter(|row| counts[*row]).collect();
            let matrix = |of: &[Column]| {
                let mut matrix = DMatrix::zeros(used.len(), of.len());
                for (c, column) in of.iter().enumerate() {
                    for (_, x) in column.parts.iter().filter(|(on, _)| *on == joint) {
                        let at = |row: &usize| x[row - rows.start + before];
                        matrix.column_mut(c).iter_mut().zip(&used).for_each(|(to, k)| *to += at(k));
                    }
                }
                matrix
            };
            let (told, instruments) = (matrix(&columns), matrix(&instruments));
            let crossed = weight * instruments.tr_mul(&told);
            sum.crossed += crossed.columns(0, count);
            sum.right += crossed.column(count);
            sum.own += weight * told.columns(0, count).tr_mul(&told.columns(0, count));
        }
        sum
    }

    /// Columns of all that is sought, the rigid links' first where these are free; and what they are to explain.
    fn columns(&self, signals: &Signals, run: usize) -> (Vec<Column>, Column) {
        let wanted: Vec<Wanted> =
            self.terms.iter().map(|t| (t.effect, t.spot, vec![t.values.clone()])).collect();
        let mut all = self.case.columns(self.simple, &wanted, signals, run);
        let mut left = all.pop().unwrap_or_default();
        let own = all.split_off(self.case.base.map_or(0, |base| base.columns.len()));
        let rigid = all;
        let (mut own, mut sought) = (own.into_iter(), Vec::new());
        for term in self.terms {
            if let Some(mixed) = self.case.carried(term.effect, term.spot) {
                let here = mixed.iter().map(|mixed| {
                    let is_here = mixed.run.is_none_or(|of| of == self.case.held_as(run));
                    let parts = mixed.of.iter().filter(|_| is_here);
                    parts.fold(Column::default(), |sum, (k, x)| sum.plus(*x, &rigid[*k]))
                });
                sought.extend(here);
                continue;
            }
            let columns: Vec<Column> = own.by_ref().take(term.values.len()).collect();
            if let Some(does) = term.effect.bends().then(|| own.next()).flatten() {
                // What is linearised is sought whole: y − f(at) + Σ column · at.
                left = left.plus(-1.0, &does);
                left =
                    columns.iter().zip(&term.values).fold(left, |left, (c, at)| left.plus(*at, c));
            }
            sought.extend(columns);
        }
        match self.links {
            Links::Free => (rigid.into_iter().chain(sought).collect(), left),
            Links::Known(values) => {
                let left = rigid.iter().zip(values).fold(left, |left, (c, x)| left.plus(-x, c));
                (sought, left)
            }
        }
    }
}
