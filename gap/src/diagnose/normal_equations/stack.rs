//! The columns of some rows, one kind of component, and the sums of their products.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector, Matrix6xX, Vector6};

use super::layout::{Borne, Layout, pairs};
use crate::infer::Products;

/// One row: the changes of the reading by all carriers, by the model's
/// parameters, and by candidates with columns of their own; and all motions.
pub(crate) struct Seen {
    pub(crate) twists: Matrix6xX<f64>,
    pub(crate) motions: Vec<f64>,
    pub(crate) gap: Vector6<f64>,
}

impl Seen {
    /// Multiplies each component.
    pub(crate) fn weigh(&mut self, by: &Vector6<f64>) {
        self.twists.column_iter_mut().for_each(|mut column| column.component_mul_assign(by));
        self.gap.component_mul_assign(by);
    }
}

/// The rows of the first measured component, those of the second, and so on: what is multiplied row
/// by row then lies side by side.
pub(crate) struct Stack<'m> {
    rows: usize,
    z: DMatrix<f64>,
    /// Columns of candidates' own.
    x: DMatrix<f64>,
    r: DVector<f64>,
    carriers: DMatrix<f64>,
    /// Rows × motions.
    motions: &'m DMatrix<f64>,
    /// Rows × products of the motions of each candidate with each other.
    squares: &'m DMatrix<f64>,
}

impl<'m> Stack<'m> {
    pub(crate) fn new(
        layout: &Layout,
        k: usize,
        rows: &[Seen],
        kind: &[usize],
        motions: &'m DMatrix<f64>,
        squares: &'m DMatrix<f64>,
    ) -> Self {
        let columns = |from: usize, count: usize| {
            let mut picked = DMatrix::zeros(kind.len() * rows.len(), count);
            for (column, mut into) in picked.column_iter_mut().enumerate() {
                let each = kind.iter().flat_map(|at| rows.iter().map(move |row| (*at, row)));
                for (into, (at, row)) in into.iter_mut().zip(each) {
                    *into = row.twists[(at, from + column)];
                }
            }
            picked
        };
        let gaps = kind.iter().flat_map(|at| rows.iter().map(|row| row.gap[*at]));
        Self {
            rows: rows.len(),
            carriers: columns(0, layout.carriers),
            z: columns(layout.carriers, k),
            x: columns(layout.carriers + k, layout.owned),
            r: DVector::from_iterator(kind.len() * rows.len(), gaps),
            motions,
            squares,
        }
    }

    fn carrier(&self, column: usize) -> &[f64] {
        let length = self.carriers.nrows();
        &self.carriers.as_slice()[column * length..(column + 1) * length]
    }

    /// Row by row the products of two columns, added to `sums`.
    fn add_dots(&self, a: &[f64], b: &[f64], sums: &mut [f64]) {
        for (a, b) in a.chunks_exact(self.rows).zip(b.chunks_exact(self.rows)) {
            for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
                *sum += a * b;
            }
        }
    }
}

/// Sums of products, candidates that share a carrier beside each other.
pub(crate) struct Sum {
    products: Products,
    /// Of the model's columns with candidates' own, and of these with what is left.
    zx: DMatrix<f64>,
    xr: DVector<f64>,
    /// Of each carrier's column: the same of all its motions.
    moved: Vec<(DMatrix<f64>, DVector<f64>)>,
    /// Of each carrier: products of its columns × those of its candidates' motions.
    squared: Vec<DMatrix<f64>>,
}

impl Sum {
    pub(crate) fn zeros(k: usize, layout: &Layout) -> Self {
        let columns = layout.borne.iter().flat_map(|b| b.columns.clone().map(|_| b.motions.len()));
        Self {
            products: Products::zeros(k, &layout.sizes),
            zx: DMatrix::zeros(k, layout.owned),
            xr: DVector::zeros(layout.owned),
            moved: columns.map(|m| (DMatrix::zeros(k, m), DVector::zeros(m))).collect(),
            squared: (layout.borne.iter())
                .map(|b| DMatrix::zeros(b.squares.len(), b.columns.len().pow(2)))
                .collect(),
        }
    }

    pub(crate) fn add(&mut self, layout: &Layout, stack: &Stack<'_>) {
        let across = stack.z.transpose();
        let p = &mut self.products;
        p.zz.gemm(1.0, &across, &stack.z, 1.0);
        p.zr.gemv(1.0, &across, &stack.r, 1.0);
        p.rr += stack.r.norm_squared();
        self.zx.gemm(1.0, &across, &stack.x, 1.0);
        self.xr.gemv_tr(1.0, &stack.x, &stack.r, 1.0);
        let xx = Arc::make_mut(&mut p.xx);
        for (candidate, columns) in &layout.own {
            let own = stack.x.columns_range(columns.clone());
            xx[*candidate].gemm_tr(1.0, &own, &own, 1.0);
        }
        for borne in &layout.borne {
            for column in borne.columns.clone() {
                self.add_moved(borne, stack, &across, column);
            }
            self.add_squares(borne, stack);
        }
    }

    /// A candidate's number is a carrier's column times its motion, row by row: the column's
    /// products are taken once, for all the motions.
    fn add_moved(
        &mut self,
        borne: &Borne,
        stack: &Stack<'_>,
        across: &DMatrix<f64>,
        column: usize,
    ) {
        let (k, carrier) = (across.nrows(), stack.carrier(column));
        let mut with_z = DMatrix::zeros(stack.rows, k);
        let columns = stack.z.as_slice().chunks_exact(carrier.len());
        for (z, sums) in columns.zip(with_z.as_mut_slice().chunks_exact_mut(stack.rows)) {
            stack.add_dots(carrier, z, sums);
        }
        let mut with_r = DVector::zeros(stack.rows);
        stack.add_dots(carrier, stack.r.as_slice(), with_r.as_mut_slice());
        let motions = stack.motions.columns_range(borne.motions.clone());
        let (zx, xr) = &mut self.moved[column];
        zx.gemm(1.0, &with_z.transpose(), &motions, 1.0);
        xr.gemv_tr(1.0, &motions, &with_r, 1.0);
    }

    /// The products of each candidate's numbers with each other: of the carrier's columns with each
    /// other, row by row, times the motions'.
    fn add_squares(&mut self, borne: &Borne, stack: &Stack<'_>) {
        let squares = stack.squares.columns_range(borne.squares.clone());
        let first = borne.columns.start;
        for (at, (i, j)) in square(borne.columns.len()).enumerate() {
            let mut dots = DVector::zeros(stack.rows);
            let (a, b) = (stack.carrier(first + i), stack.carrier(first + j));
            stack.add_dots(a, b, dots.as_mut_slice());
            self.squared[borne.index].column_mut(at).gemv_tr(1.0, &squares, &dots, 1.0);
        }
    }

    /// With every candidate's numbers where they belong.
    pub(crate) fn into_products(self, layout: &Layout) -> Products {
        let Sum { mut products, zx, xr, moved, squared } = self;
        for (candidate, columns) in &layout.own {
            let (from, count) = (layout.at[*candidate], columns.len());
            let mine = zx.columns_range(columns.clone());
            products.zx.columns_mut(from, count).copy_from(&mine);
            products.xr.rows_mut(from, count).copy_from(&xr.rows_range(columns.clone()));
        }
        let xx = Arc::make_mut(&mut products.xx);
        for (borne, squared) in layout.borne.iter().zip(&squared) {
            let size = borne.columns.len();
            let mut own = squared.row_iter();
            for moving in &borne.candidates {
                for (m, n) in pairs(moving.motions.len()) {
                    let Some(own) = own.next() else { continue };
                    for (at, (i, j)) in square(size).enumerate() {
                        xx[moving.candidate][(m * size + i, n * size + j)] = own[at];
                        xx[moving.candidate][(n * size + j, m * size + i)] = own[at];
                    }
                }
            }
        }
        for borne in &layout.borne {
            for (index, column) in borne.columns.clone().enumerate() {
                let (zx, xr) = &moved[column];
                for moving in &borne.candidates {
                    for (m, motion) in moving.motions.clone().enumerate() {
                        let number = layout.number(borne, moving, m, index);
                        let mine = motion - borne.motions.start;
                        products.zx.set_column(number, &zx.column(mine));
                        products.xr[number] = xr[mine];
                    }
                }
            }
        }
        products
    }
}

/// Every one of so many with every one.
fn square(count: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..count).flat_map(move |i| (0..count).map(move |j| (i, j)))
}
