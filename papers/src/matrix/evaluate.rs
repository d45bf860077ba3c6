//! The value of a formula of matrices at a point.

use std::collections::HashMap;

use super::dense::{Dense, inverse, is_scalar, plus, scalar};
use super::dense::{blocks, times as multiply};
use super::tree::{Name, Tree, count};

/// Step of the derivatives by joints, rad: the formula of fourth order errs by 1e-13, and rounding
/// by as much.
const STEP: f64 = 1e-3;

/// Values of symbols at a posture.
pub trait Symbols {
    /// The value of a symbol by its key; `None` if it has none.
    ///
    /// # Errors
    /// Why it has none here.
    fn value(&self, key: &str, q: &[f64]) -> Result<Option<Dense>, String>;
}

/// Where a formula is evaluated.
#[derive(Clone)]
pub struct Point<'s> {
    /// The symbols' values.
    pub symbols: &'s dyn Symbols,
    /// The posture.
    pub q: Vec<f64>,
    /// Indices that count.
    pub counted: HashMap<String, i64>,
    /// Symbols that stand for formulas.
    pub formulas: HashMap<String, Tree>,
}

/// A matrix, or one for each joint.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A matrix.
    One(Dense),
    /// The derivatives by each joint in turn.
    Stack(Vec<Dense>),
}

type Found<T> = Result<T, String>;

impl Point<'_> {
    /// The value of a formula that is one matrix.
    ///
    /// # Errors
    /// A symbol without a value, shapes that do not fit, a singular matrix.
    pub fn matrix(&self, tree: &Tree) -> Found<Dense> {
        match self.value(tree)? {
            Value::One(matrix) => Ok(matrix),
            // The columns that the derivatives of a vector by the joints are.
            Value::Stack(each) => {
                let shape = each.first().map_or((0, 0), Dense::shape);
                if shape.1 != 1 {
                    return Err(
                        "a derivative by all joints stands without what it multiplies".into()
                    );
                }
                Ok(Dense::from_fn(shape.0, each.len(), |r, c| each[c][(r, 0)]))
            }
        }
    }

    fn scalar(&self, tree: &Tree) -> Found<f64> {
        let matrix = self.matrix(tree)?;
        is_scalar(&matrix).then(|| matrix[(0, 0)]).ok_or_else(|| {
            format!("`{}` is {}×{}, not a number", tree.latex(), matrix.nrows(), matrix.ncols())
        })
    }

    fn value(&self, tree: &Tree) -> Found<Value> {
        let one = |matrix| Ok(Value::One(matrix));
        match tree {
            Tree::Number(text) => {
                one(scalar(text.parse().map_err(|_| format!("`{text}` is no number"))?))
            }
            Tree::Name(name) => one(self.name(name)?),
            Tree::Sum(terms) => self.sum(terms),
            Tree::Product(factors) => {
                let mut product = self.value(&factors[0])?;
                for factor in &factors[1..] {
                    product = times(product, self.value(factor)?)
                        .ok_or_else(|| format!("the shapes in `{}` do not fit", tree.latex()))?;
                }
                Ok(product)
            }
            Tree::Quotient(a, b) => {
                let (a, b) = (self.matrix(a)?, self.scalar(b)?);
                if b == 0.0 { Err("a division by zero".into()) } else { one(a * (1.0 / b)) }
            }
            Tree::Transpose(a) => match self.value(a)? {
                Value::One(matrix) => one(matrix.transpose()),
                Value::Stack(each) => Ok(Value::Stack(each.iter().map(Dense::transpose).collect())),
            },
            Tree::Inverse(a) => {
                let singular = || format!("`{}` has no inverse", a.latex());
                one(inverse(&self.matrix(a)?).ok_or_else(singular)?)
            }
            Tree::Derivative(body, by) => self.derivative(body, by),
            Tree::Sqrt(a) => one(scalar(self.scalar(a)?.sqrt())),
            Tree::Trace(a) => {
                let matrix = self.matrix(a)?;
                if !matrix.is_square() {
                    return Err("a trace of no square matrix".into());
                }
                one(scalar(matrix.trace()))
            }
            Tree::Norm(a) => one(scalar(self.matrix(a)?.norm())),
            Tree::Blocks(rows) => one(self.blocks(rows)?),
            Tree::Over { index, from, to, body } => {
                let bound = |text: &str| {
                    count(text, &self.counted).ok_or_else(|| format!("`{text}` does not count"))
                };
                let mut product = scalar(1.0);
                for k in bound(from)?..=bound(to)? {
                    let mut inside = self.clone();
                    inside.counted.insert(index.clone(), k);
                    let factor = inside.matrix(body)?;
                    product =
                        multiply(&product, &factor).ok_or("the factors' shapes do not fit")?;
                }
                one(product)
            }
        }
    }

    fn name(&self, name: &Name) -> Found<Dense> {
        let key = name.key(&self.counted);
        if let Some(value) = self.symbols.value(&key, &self.q)? {
            return Ok(value);
        }
        match self.formulas.get(&key) {
            Some(formula) => self.matrix(formula),
            None => Err(format!("`{}` has no value", name.latex().trim())),
        }
    }

    fn sum(&self, terms: &[(bool, Tree)]) -> Found<Value> {
        let mut total: Option<Dense> = None;
        for (negative, term) in terms {
            let (value, sign) = (self.matrix(term)?, if *negative { -1.0 } else { 1.0 });
            total = Some(match total {
                None => value * sign,
                Some(sum) => plus(&sum, &value, sign).ok_or_else(|| {
                    format!(
                        "{}×{} and {}×{} are added",
                        sum.nrows(),
                        sum.ncols(),
                        value.nrows(),
                        value.ncols()
                    )
                })?,
            });
        }
        total.map(Value::One).ok_or_else(|| "an empty sum".into())
    }

    /// By one joint, or by all where no index or one that does not count names it.
    fn derivative(&self, body: &Tree, by: &Name) -> Found<Value> {
        if !["theta", "q"].contains(&by.base.as_str()) {
            return Err(format!("`{}` is no joint", by.latex().trim()));
        }
        let joint = by.indices.first().and_then(|index| count(index, &self.counted));
        let slope = |joint: usize| -> Found<Dense> {
            let at = |steps: f64| {
                let mut moved = self.clone();
                moved.q[joint] += steps * STEP;
                moved.matrix(body)
            };
            let near = plus(&at(1.0)?, &at(-1.0)?, -1.0).ok_or("shapes that change")?;
            let far = plus(&at(2.0)?, &at(-2.0)?, -1.0).ok_or("shapes that change")?;
            let sum = plus(&(near * 8.0), &far, -1.0).ok_or("shapes that change")?;
            Ok(sum * (1.0 / (12.0 * STEP)))
        };
        match joint {
            Some(joint) => {
                let joint = usize::try_from(joint - 1).ok().filter(|k| *k < self.q.len());
                slope(joint.ok_or("there is no such joint")?).map(Value::One)
            }
            None => (0..self.q.len()).map(slope).collect::<Found<_>>().map(Value::Stack),
        }
    }

    /// Blocks; a number among matrices is that multiple of the identity, or zeros.
    fn blocks(&self, rows: &[Vec<Tree>]) -> Found<Dense> {
        let values: Vec<Vec<Dense>> = rows
            .iter()
            .map(|row| row.iter().map(|cell| self.matrix(cell)).collect())
            .collect::<Found<_>>()?;
        let columns = values.first().map_or(0, Vec::len);
        if values.iter().any(|row| row.len() != columns) {
            return Err("rows of different lengths".into());
        }
        let height = |r: usize| values[r].iter().map(|b| b.nrows()).max().unwrap_or(1);
        let width = |c: usize| values.iter().map(|row| row[c].ncols()).max().unwrap_or(1);
        let block = |r: usize, c: usize| {
            let (shape, value) = ((height(r), width(c)), &values[r][c]);
            if !is_scalar(value) || shape == (1, 1) {
                return Some(value.clone());
            }
            let number = value[(0, 0)];
            let fits = number == 0.0 || shape.0 == shape.1;
            let diagonal = |i: usize, j: usize| if i == j { number } else { 0.0 };
            fits.then(|| Dense::from_fn(shape.0, shape.1, diagonal))
        };
        let whole: Option<Vec<Vec<Dense>>> =
            (0..values.len()).map(|r| (0..columns).map(|c| block(r, c)).collect()).collect();
        whole.and_then(|rows| blocks(&rows)).ok_or_else(|| "the blocks do not fit".into())
    }
}

/// Columns as a matrix; `None` if they are no columns.
fn side_by_side(each: &[Dense]) -> Option<Dense> {
    let (rows, columns) = each.first()?.shape();
    (columns == 1).then(|| Dense::from_fn(rows, each.len(), |r, c| each[c][(r, 0)]))
}

/// A product; derivatives by all joints times a vector are the columns of a matrix.
fn times(a: Value, b: Value) -> Option<Value> {
    match (a, b) {
        (Value::One(a), Value::One(b)) => multiply(&a, &b).map(Value::One),
        (Value::Stack(each), Value::One(b)) => {
            // The derivatives of a vector are the columns of a matrix.
            if let Some(matrix) = side_by_side(&each) {
                return multiply(&matrix, &b).map(Value::One);
            }
            let products: Vec<Dense> =
                each.iter().map(|a| multiply(a, &b)).collect::<Option<_>>()?;
            Some(side_by_side(&products).map_or(Value::Stack(products), Value::One))
        }
        (Value::One(a), Value::Stack(each)) => {
            each.iter().map(|b| multiply(&a, b)).collect::<Option<_>>().map(Value::Stack)
        }
        (Value::Stack(_), Value::Stack(_)) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::parse::sides;
    use super::*;

    /// A(q) = [[q1², q1 q2], [sin q1, 3]], v = (2, −1), n = 3.
    struct Sample;

    impl Symbols for Sample {
        fn value(&self, key: &str, q: &[f64]) -> Result<Option<Dense>, String> {
            let [x, y] = [q[0], q[1]];
            let a = [[x * x, x * y], [x.sin(), 3.0]];
            Ok(match key {
                "A" => Some(Dense::from_fn(2, 2, |r, c| a[r][c])),
                "v" => Some(Dense::from_fn(2, 1, |r, _| 2.0 - 3.0 * r as f64)),
                "B_1" | "B_2" => Some(scalar(if key == "B_1" { 5.0 } else { 7.0 })),
                _ => None,
            })
        }
    }

    fn of(latex: &str) -> Result<Dense, String> {
        let point = Point {
            symbols: &Sample,
            q: vec![0.3, 0.8],
            counted: HashMap::from([("n".into(), 2)]),
            formulas: HashMap::new(),
        };
        point.matrix(&sides(latex).unwrap()[0])
    }

    #[test]
    fn derivatives_by_joints_are_columns() {
        let d = of("\\frac{\\partial A}{\\partial \\theta} v").unwrap();
        let expected = [[2.0 * 2.0 * 0.3 - 0.8, -0.3], [2.0 * 0.3f64.cos(), 0.0]];
        for (r, row) in expected.iter().enumerate() {
            for (c, want) in row.iter().enumerate() {
                assert!((d[(r, c)] - want).abs() < 1e-11, "{d:?}");
            }
        }
        let one = of("\\frac{\\partial A}{\\partial q_2} v").unwrap();
        assert!((one[(0, 0)] - d[(0, 1)]).abs() < 1e-12);
        let gradient = of("\\frac{\\partial (A v)}{\\partial q}").unwrap();
        assert!((gradient - &d).amax() < 1e-11);
    }

    #[test]
    fn products_over_an_index_and_blocks() {
        assert_eq!(of("\\prod_{j=1}^{n} B_j").unwrap()[(0, 0)], 35.0);
        assert_eq!(of("\\prod_{j=1}^{n-1} B_{j+1}").unwrap()[(0, 0)], 7.0);
        let blocks = of("\\begin{bmatrix} A & 0 \\\\ v^T & 1 \\end{bmatrix}").unwrap();
        assert_eq!((blocks.shape(), blocks[(0, 2)], blocks[(2, 2)]), ((3, 3), 0.0, 1.0));
    }

    #[test]
    fn what_does_not_fit_is_said() {
        assert_eq!(of("A + v").unwrap_err(), "2×2 and 2×1 are added");
        assert_eq!(of("v A").unwrap_err(), "the shapes in `v A` do not fit");
        assert_eq!(of("(v v^T)^{-1}").unwrap_err(), "`v v^T` has no inverse");
        assert_eq!(of("C_{j,x}").unwrap_err(), "`C_{j,x}` has no value");
    }
}
