//! Products of columns summed over rows: all that least squares needs of the data.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::screen::Columns;

/// Products of one set of rows: `z` are the model's parameters, `x` the candidates' numbers, `r`
/// what is left of the gap.
#[derive(Clone, Debug)]
pub struct Products {
    /// k×k.
    pub zz: DMatrix<f64>,
    /// k.
    pub zr: DVector<f64>,
    /// The squares of what is left.
    pub rr: f64,
    /// k × all numbers of all candidates.
    pub zx: DMatrix<f64>,
    /// All numbers of all candidates.
    pub xr: DVector<f64>,
    /// p×p of each candidate with itself.
    pub xx: Arc<Vec<DMatrix<f64>>>,
}

/// Which of the gathered columns are the model's, and what is given back of those that are not.
pub struct Choice {
    /// Columns of `z` that stay.
    pub kept: Vec<usize>,
    /// Columns of `z` whose effect is taken out of the model: what is left grows by theirs.
    pub back: Vec<usize>,
    /// Their values.
    pub values: DVector<f64>,
    /// Candidates that stay, from the first.
    pub candidates: usize,
    /// Their numbers.
    pub numbers: usize,
}

impl Choice {
    /// The first parameters and candidates, as they are.
    pub fn first(parameters: usize, candidates: &[impl Columns]) -> Self {
        Choice {
            kept: (0..parameters).collect(),
            back: Vec::new(),
            values: DVector::zeros(0),
            candidates: candidates.len(),
            numbers: candidates.iter().map(Columns::columns).sum(),
        }
    }
}

impl Products {
    /// Of no rows: `k` parameters, candidates with so many numbers each.
    pub fn zeros(k: usize, sizes: &[usize]) -> Self {
        let all = sizes.iter().sum();
        Self {
            zz: DMatrix::zeros(k, k),
            zr: DVector::zeros(k),
            rr: 0.0,
            zx: DMatrix::zeros(k, all),
            xr: DVector::zeros(all),
            xx: Arc::new(sizes.iter().map(|p| DMatrix::zeros(*p, *p)).collect()),
        }
    }

    /// Those of further rows.
    pub fn add(&mut self, other: &Products) {
        self.add_scaled(other, 1.0);
    }

    /// Holds the candidates' numbers: the products of a measurement of each as 0.
    pub fn hold(&mut self, candidates: &[impl Columns]) {
        for (own, candidate) in Arc::make_mut(&mut self.xx).iter_mut().zip(candidates) {
            let squares = candidate.usual().held.iter().map(|held| held * held);
            // What is added once, whatever the numbers, is held to nothing.
            let all = squares.chain(candidate.is_linearized().then_some(0.0));
            own.set_diagonal(&DVector::from_iterator(candidate.columns(), all));
        }
    }

    /// Adds the products of rows that weigh `weight`.
    pub fn add_scaled(&mut self, other: &Products, weight: f64) {
        let plus = |mine: &mut [f64], theirs: &[f64]| {
            mine.iter_mut().zip(theirs).for_each(|(m, t)| *m += t * weight);
        };
        plus(self.zz.as_mut_slice(), other.zz.as_slice());
        plus(self.zr.as_mut_slice(), other.zr.as_slice());
        self.rr += other.rr * weight;
        plus(self.zx.as_mut_slice(), other.zx.as_slice());
        plus(self.xr.as_mut_slice(), other.xr.as_slice());
        for (mine, theirs) in Arc::make_mut(&mut self.xx).iter_mut().zip(other.xx.iter()) {
            plus(mine.as_mut_slice(), theirs.as_slice());
        }
    }

    /// The same of the model's columns alone, what these do with such values given back to what is left.
    pub fn given_back(&self, values: &DVector<f64>) -> Self {
        let model = &self.zz * values;
        Self {
            rr: self.rr + values.dot(&model) + 2.0 * values.dot(&self.zr),
            zr: &self.zr + model,
            zz: self.zz.clone(),
            ..Self::zeros(0, &[])
        }
    }

    /// Squares that such values of the model's columns leave.
    pub fn left(&self, values: &DVector<f64>) -> f64 {
        self.rr + values.dot(&(&self.zz * values)) - 2.0 * values.dot(&self.zr)
    }

    /// In other coordinates of the model, `z t`.
    pub(crate) fn turn(&mut self, t: &DMatrix<f64>) {
        let back = t.transpose();
        self.zz = &back * &self.zz * t;
        self.zr = &back * &self.zr;
        self.zx = &back * &self.zx;
    }

    /// The products of fewer columns. What is given back is far from the remainder's own direction:
    /// all terms of the sums are of one sign or small, so that nothing cancels that does not cancel
    /// when the rows themselves are added up.
    pub fn chosen(&self, choice: &Choice) -> Self {
        let Choice { kept, back, values, candidates, numbers } = choice;
        let zx = self.zx.columns(0, *numbers);
        let mut chosen = Self {
            zz: self.zz.select_rows(kept).select_columns(kept),
            zr: self.zr.select_rows(kept),
            rr: self.rr,
            zx: zx.select_rows(kept),
            xr: self.xr.rows(0, *numbers).into_owned(),
            xx: match *candidates == self.xx.len() {
                true => Arc::clone(&self.xx),
                false => Arc::new(self.xx[..*candidates].to_vec()),
            },
        };
        if !back.is_empty() {
            let columns = self.zz.select_columns(back);
            chosen.zr += columns.select_rows(kept) * values;
            let own = columns.select_rows(back) * values;
            chosen.rr += 2.0 * values.dot(&self.zr.select_rows(back)) + values.dot(&own);
            chosen.xr += zx.select_rows(back).tr_mul(values);
        }
        chosen
    }
}

/// Where each of parts so large begins.
pub fn starts(sizes: &[usize]) -> Vec<usize> {
    let begins = sizes.iter().scan(0, |next, size| {
        let here = *next;
        *next += size;
        Some(here)
    });
    begins.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(z: &DMatrix<f64>, x: &DMatrix<f64>, r: &DVector<f64>) -> Products {
        Products {
            zz: z.tr_mul(z),
            zr: z.tr_mul(r),
            rr: r.norm_squared(),
            zx: z.tr_mul(x),
            xr: x.tr_mul(r),
            xx: Arc::new(x.column_iter().map(|c| c.tr_mul(&c).resize(1, 1, 0.0)).collect()),
        }
    }

    #[test]
    fn chosen_products_are_those_of_the_chosen_columns() {
        let any = |k: usize| (1.7 * k as f64).sin();
        let z = DMatrix::from_fn(20, 4, |r, c| any(r * 5 + c));
        let x = DMatrix::from_fn(20, 3, |r, c| any(r * 7 + 11 * c + 3));
        let r = DVector::from_fn(20, |r, _| any(13 * r + 1));
        let values = DVector::from_vec(vec![0.3, -2.0]);
        let choice = Choice {
            kept: vec![0, 3],
            back: vec![1, 2],
            values: values.clone(),
            candidates: 2,
            numbers: 2,
        };
        let chosen = of(&z, &x, &r).chosen(&choice);
        let given_back = &r + z.columns(1, 2) * values;
        let mut direct = of(&z.select_columns(&[0, 3]), &x.columns(0, 2).into_owned(), &given_back);
        let t = DMatrix::from_fn(2, 2, |r, c| any(r + 3 * c));
        let mut turned = chosen.clone();
        for _ in 0..2 {
            let close = |a: &[f64], b: &[f64]| {
                assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12), "{a:?} {b:?}");
                assert_eq!(a.len(), b.len());
            };
            close(turned.zz.as_slice(), direct.zz.as_slice());
            close(turned.zr.as_slice(), direct.zr.as_slice());
            close(turned.zx.as_slice(), direct.zx.as_slice());
            close(turned.xr.as_slice(), direct.xr.as_slice());
            close(&[turned.rr, turned.xx[1][0]], &[direct.rr, direct.xx[1][0]]);
            turned.turn(&t);
            direct =
                of(&(z.select_columns(&[0, 3]) * &t), &x.columns(0, 2).into_owned(), &given_back);
        }
    }
}
