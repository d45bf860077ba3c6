//! The value of a formula of matrices at a point.

use std::collections::HashMap;

use num_rational::Ratio;

use super::dense::{Dense, blocks, inverse, is_scalar, product, scalar, shape, sum};
use crate::exact::arithmetic::{Arithmetic, Real};
use crate::latex::name::{Name, count};
use crate::latex::tree::{Angle, Function, Tree};

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

impl Value {
    /// As one matrix; the derivatives of a vector by the joints are its columns.
    fn matrix(self) -> Found<Dense> {
        match self {
            Value::One(matrix) => Ok(matrix),
            Value::Stack(each) => side_by_side(&each).ok_or_else(|| {
                "a derivative by all joints stands without what it multiplies".into()
            }),
        }
    }

    fn number(self) -> Found<f64> {
        let matrix = self.matrix()?;
        let wrong = || format!("{} stands where a number is expected", shape(&matrix));
        is_scalar(&matrix).then(|| matrix[(0, 0)]).ok_or_else(wrong)
    }
}

/// Columns as a matrix; `None` if they are no columns.
fn side_by_side(each: &[Dense]) -> Option<Dense> {
    let (rows, columns) = each.first()?.shape();
    (columns == 1).then(|| Dense::from_fn(rows, each.len(), |r, c| each[c][(r, 0)]))
}

impl Arithmetic for Point<'_> {
    type Value = Value;
    type Error = String;

    fn number(&self, n: Ratio<i128>) -> Found<Value> {
        let number = Real(|_: &str| None).number(n);
        Ok(Value::One(scalar(number?)))
    }

    fn named(&self, key: &str) -> Found<Value> {
        self.value(key)?.ok_or_else(|| format!("`{key}` has no value"))
    }

    fn symbol(&self, name: &Name) -> Found<Value> {
        let value = self.value(&name.counted(&self.counted))?;
        value.ok_or_else(|| format!("`{}` has no value", name.latex().trim()))
    }

    fn trig(&self, _: Function, angle: &Angle) -> Found<Value> {
        Err(format!("the sine or cosine of {angle} stands among matrices"))
    }

    fn add(&self, a: Value, b: Value) -> Found<Value> {
        sum(&a.matrix()?, &b.matrix()?, 1.0).map(Value::One)
    }

    fn sub(&self, a: Value, b: Value) -> Found<Value> {
        sum(&a.matrix()?, &b.matrix()?, -1.0).map(Value::One)
    }

    /// Derivatives by all joints times a vector are the columns of a matrix.
    fn mul(&self, a: Value, b: Value) -> Found<Value> {
        match (a, b) {
            (Value::One(a), Value::One(b)) => product(&a, &b).map(Value::One),
            (Value::Stack(each), Value::One(b)) => {
                if let Some(matrix) = side_by_side(&each) {
                    return product(&matrix, &b).map(Value::One);
                }
                let products: Vec<Dense> =
                    each.iter().map(|a| product(a, &b)).collect::<Found<_>>()?;
                Ok(side_by_side(&products).map_or(Value::Stack(products), Value::One))
            }
            (Value::One(a), Value::Stack(each)) => {
                each.iter().map(|b| product(&a, b)).collect::<Found<_>>().map(Value::Stack)
            }
            (Value::Stack(_), Value::Stack(_)) => {
                Err("two derivatives by all joints are multiplied".into())
            }
        }
    }

    fn div(&self, a: Value, b: Value) -> Found<Value> {
        match b.number()? {
            0.0 => Err("a division by zero".into()),
            b => Ok(Value::One(a.matrix()? * (1.0 / b))),
        }
    }

    fn sqrt(&self, a: Value) -> Found<Value> {
        Ok(Value::One(scalar(a.number()?.sqrt())))
    }

    fn power(&self, base: Value, n: i32) -> Found<Value> {
        let mut base = base.matrix()?;
        if n < 0 {
            base = inverse(&base).ok_or("a matrix that has no inverse is inverted")?;
        }
        let power = (0..n.unsigned_abs()).try_fold(scalar(1.0), |p, _| product(&p, &base))?;
        Ok(Value::One(power))
    }

    fn other(&self, tree: &Tree) -> Found<Value> {
        Ok(Value::One(match tree {
            Tree::Transpose(a) => match self.tree(a)? {
                Value::One(matrix) => matrix.transpose(),
                Value::Stack(each) => {
                    return Ok(Value::Stack(each.iter().map(Dense::transpose).collect()));
                }
            },
            Tree::Derivative(body, by) => return self.derivative(body, by),
            Tree::Trace(a) => {
                let matrix = self.matrix(a)?;
                if !matrix.is_square() {
                    return Err("a trace of no square matrix".into());
                }
                scalar(matrix.trace())
            }
            Tree::Norm(a) => scalar(self.matrix(a)?.norm()),
            Tree::Blocks(rows) => {
                let row = |row: &Vec<Tree>| row.iter().map(|cell| self.matrix(cell)).collect();
                blocks(&rows.iter().map(row).collect::<Found<Vec<_>>>()?)?
            }
            Tree::Over(over, body) => {
                let bound = |text: &str| {
                    count(text, &self.counted).ok_or_else(|| format!("`{text}` does not count"))
                };
                let mut inside = self.clone();
                let mut whole = scalar(1.0);
                for k in bound(&over.from)?..=bound(&over.to)? {
                    inside.counted.insert(over.index.clone(), k);
                    whole = product(&whole, &inside.matrix(body)?)?;
                }
                whole
            }
            _ => return Err(format!("`{}` stands among matrices", tree.latex())),
        }))
    }
}

impl Point<'_> {
    /// The value of a formula that is one matrix.
    ///
    /// # Errors
    /// A symbol without a value, shapes that do not fit, a singular matrix.
    pub fn matrix(&self, tree: &Tree) -> Found<Dense> {
        self.tree(tree)?.matrix()
    }

    fn value(&self, key: &str) -> Found<Option<Value>> {
        let value = match self.symbols.value(key, &self.q)? {
            None => self.formulas.get(key).map(|formula| self.matrix(formula)).transpose()?,
            found => found,
        };
        Ok(value.map(Value::One))
    }

    /// By one joint, or by all where no index or one that does not count names it.
    fn derivative(&self, body: &Tree, by: &Name) -> Found<Value> {
        if !["theta", "q"].contains(&by.base.trim_start_matches('\\')) {
            return Err(format!("`{}` is no joint", by.latex().trim()));
        }
        let joint = by.indices().next().and_then(|index| count(index, &self.counted));
        let slope = |joint: usize| -> Found<Dense> {
            let at = |steps: f64| {
                let mut moved = self.clone();
                moved.q[joint] += steps * STEP;
                moved.matrix(body)
            };
            let near = sum(&at(1.0)?, &at(-1.0)?, -1.0)?;
            let far = sum(&at(2.0)?, &at(-2.0)?, -1.0)?;
            Ok(sum(&(near * 8.0), &far, -1.0)? * (1.0 / (12.0 * STEP)))
        };
        match joint {
            Some(joint) => {
                let joint = usize::try_from(joint - 1).ok().filter(|k| *k < self.q.len());
                slope(joint.ok_or("there is no such joint")?).map(Value::One)
            }
            None => (0..self.q.len()).map(slope).collect::<Found<_>>().map(Value::Stack),
        }
    }
}

#[cfg(test)]
mod tests;
