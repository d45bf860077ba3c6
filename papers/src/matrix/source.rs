//! What the symbols of a relation stand for: derived quantities of a robot, and random matrices of
//! the shapes that the data file gives.

use std::collections::HashMap;

use super::dense::{self, Dense};
use super::evaluate::Symbols;
use super::transform::transform;
use crate::exact::derived::{Path, Setting, Shared};
use crate::exact::field::Modular;
use crate::latex::formula::Piece;
use crate::latex::lexer::{Lexeme, Token};
use crate::latex::notation::Notation;
use crate::latex::parser::parse;
use crate::latex::tree::Tree;
use stiffarm_codegen::derive::{Output, derive_in};
use stiffarm_codegen::robot::{Robot, Value};

/// Postures of relations without a robot.
const JOINTS: usize = 3;

/// What a symbol stands for: its value at a point by its key and the posture.
type Source = Box<dyn Fn(&At<'_>, &str, &[f64]) -> Result<Dense, String>>;

/// The token of a text that is a single symbol of matrices.
pub fn single(latex: &str) -> Option<Token> {
    let mut tokens = crate::latex::lexer::lex(latex, &Notation::MATRICES).ok()?;
    let token = tokens.pop().filter(|token| matches!(token.is, Lexeme::Name(_)))?;
    tokens.is_empty().then_some(token)
}

/// Its key; of a family `K_#`, one for each value of its index.
fn key(token: &Token) -> String {
    match &token.is {
        Lexeme::Name(name) => name.counted(&HashMap::new()),
        _ => token.text.clone(),
    }
}

/// The symbols of one relation.
pub struct Sources {
    known: HashMap<String, Source>,
    robot: Option<Robot>,
    /// Indices that count.
    pub counted: HashMap<String, i64>,
    /// Symbols that stand for formulas of others.
    pub formulas: HashMap<String, Tree>,
    /// How the symbols are printed, by which a misprint may have been meant.
    pub printed: Vec<Token>,
    given: HashMap<String, f64>,
}

/// The symbols at one point: all random numbers follow from its number.
#[derive(Clone, Copy)]
pub struct At<'s>(pub &'s Sources, pub u64);

impl Sources {
    /// Reads what each symbol stands for. `given` are values of the data file.
    ///
    /// # Errors
    /// What is no source, and why.
    pub fn read(
        symbols: &[(String, Piece)],
        setting: &Setting,
        shared: Shared<'_>,
        given: &HashMap<String, f64>,
    ) -> Result<Self, String> {
        let robot = setting.robot.as_ref().and_then(|name| shared.robots.get(name)).cloned();
        let mut out = Sources {
            known: HashMap::new(),
            robot,
            counted: HashMap::new(),
            formulas: HashMap::new(),
            printed: Vec::new(),
            given: given.clone(),
        };
        for (symbol, Piece { text, .. }) in symbols {
            let token = single(symbol).ok_or_else(|| format!("`{symbol}` is no symbol"))?;
            let key = key(&token);
            if let Some(number) = text.strip_prefix("index ") {
                let number = number.parse().map_err(|_| format!("`{text}` is no index"))?;
                out.counted.insert(key, number);
                continue;
            }
            if let Some(formula) = text.strip_prefix('=') {
                let formula = parse(formula, &Notation::MATRICES).map_err(|m| m.message)?;
                out.formulas.insert(key, formula);
            } else {
                let source = out.source(text.trim(), setting, shared.notation)?;
                out.known.insert(key, source);
            }
            out.printed.push(token);
        }
        Ok(out)
    }

    fn source(&self, text: &str, setting: &Setting, notation: &Notation) -> Result<Source, String> {
        let words: Vec<&str> = text.split_whitespace().collect();
        let size = |text: &str| text.parse::<usize>().ok().filter(|n| (1..=50).contains(n));
        let shape = |text: &str| match text.split_once('x') {
            Some((rows, columns)) => Some((size(rows)?, size(columns)?)),
            None => Some((size(text)?, 1)),
        };
        let unknown = || {
            format!(
                "`{text}` is no source: a shape such as `random 3x6`, `random 6x6 of q`, \
                 `symmetric 6`, `diagonal 6`, `identity 3`, `ones 6`, `index 2`, \
                 `pseudo-inverse of M`, `stiffness`, `wrench`, `rotation`, `position`, `lever`, \
                 `transport`, `transport of Rz(q) Tx(a)`, a formula behind `=`, or an output of \
                 the robot"
            )
        };
        let shape = |text: &str| shape(text).ok_or_else(unknown);
        let size = |text: &str| size(text).ok_or_else(unknown);
        let constant = |matrix: Dense| -> Source { Box::new(move |_, _, _| Ok(matrix.clone())) };
        Ok(match words.as_slice() {
            ["random", text] => {
                let (rows, columns) = shape(text)?;
                Box::new(move |at, key, _| {
                    Ok(Dense::from_fn(rows, columns, |r, c| at.random(key, r * columns + c)))
                })
            }
            ["random", text, "of", "q"] => {
                let (rows, columns) = shape(text)?;
                Box::new(move |at, key, q| {
                    let entry = |r, c| at.moving(key, r * columns + c, q);
                    Ok(Dense::from_fn(rows, columns, entry))
                })
            }
            ["symmetric", n] => {
                let n = size(n)?;
                Box::new(move |at, key, _| {
                    let of = |r: usize, c: usize| at.random(key, r.min(c) * n + r.max(c));
                    Ok(Dense::from_fn(n, n, of) + Dense::identity(n, n) * n as f64)
                })
            }
            ["diagonal", n] => {
                let n = size(n)?;
                Box::new(move |at, key, _| Ok(diagonal(n, |k| 1.5 + at.random(key, k))))
            }
            ["identity", n] => constant(Dense::identity(size(n)?, size(n)?)),
            ["ones", n] => constant(Dense::from_element(size(n)?, 1, 1.0)),
            ["pseudo-inverse", "of", other] => {
                let other = key(&single(other).ok_or_else(unknown)?);
                Box::new(move |at, _, q| {
                    let matrix = at.value(&other, q)?;
                    let matrix = matrix.ok_or_else(|| format!("`{other}` is unknown"))?;
                    dense::pseudo_inverse(&matrix).ok_or_else(|| "no pseudo-inverse".into())
                })
            }
            ["stiffness"] => Box::new(|at, _, _| at.stiffness()),
            ["wrench"] => Box::new(|at, _, _| Ok(Dense::from_column_slice(6, 1, &at.wrench()))),
            [part @ ("rotation" | "position" | "lever" | "transport")] => {
                constant(transform(part, &setting.product, notation, &setting.defined)?)
            }
            ["transport", "of", elements @ ..] => {
                let elements: Vec<String> = elements.iter().map(|e| (*e).to_owned()).collect();
                constant(transform("transport", &elements, notation, &setting.defined)?)
            }
            [path] => self.output(path).ok_or_else(unknown)?,
            _ => return Err(unknown()),
        })
    }

    /// An output of the robot, whole or an entry of it: `jacobian`, `pose[1][4]`.
    fn output(&self, path: &str) -> Option<Source> {
        let robot = self.robot.as_ref()?;
        let path = Path::read(path).ok()?;
        let output = Output::EACH.into_iter().find(|output| output.name() == path.name)?;
        let (rows, columns) = output.shape(robot.dof());
        let entry = path.entry((rows, columns)).ok()?;
        let program = derive_in(robot, &[output], 0);
        Some(Box::new(move |at, _, q| {
            let found = program.evaluate(q, &at.wrench(), |name: &str| at.positive(name));
            let found = found.map_err(|error| error.to_string())?;
            let whole = Dense::from_column_slice(rows, columns, &found[0][..rows * columns]);
            Ok(entry.map_or(whole.clone(), |place| dense::scalar(whole[place])))
        }))
    }
}

fn diagonal(n: usize, of: impl Fn(usize) -> f64) -> Dense {
    Dense::from_fn(n, n, |r, c| if r == c { of(r) } else { 0.0 })
}

impl At<'_> {
    /// Its posture.
    pub fn posture(&self) -> Vec<f64> {
        let joints = self.0.robot.as_ref().map_or(JOINTS, Robot::dof);
        (0..joints).map(|k| 1.3 * self.random("q", k)).collect()
    }

    /// A number from −1 to 1 that follows from the point, a name and a count.
    fn random(&self, name: &str, k: usize) -> f64 {
        2.0 * Modular::point(self.1).part(&format!("{name} {k}")) - 1.0
    }

    /// A value above zero.
    fn positive(&self, name: &str) -> f64 {
        self.0.given.get(name).copied().unwrap_or_else(|| 1.5 + 0.9 * self.random(name, 0))
    }

    /// A random number that moves with the posture; a member of a family moves with its own joint.
    fn moving(&self, key: &str, k: usize, q: &[f64]) -> f64 {
        let own = key.split(['_', ',']).find_map(|index| index.parse::<usize>().ok());
        let q = match own {
            Some(own) => q.get(own.wrapping_sub(1)).map_or(&q[..0], core::slice::from_ref),
            None => q,
        };
        let rate = 1.0 + 0.5 * self.random(key, k + 997);
        self.random(key, k) + q.iter().map(|q| (q * rate).sin()).sum::<f64>()
    }

    /// The joints' stiffnesses on a diagonal.
    fn stiffness(&self) -> Result<Dense, String> {
        let joints = self.0.robot.as_ref().map_or(&[][..], |robot| &robot.joints);
        let each: Vec<f64> = joints
            .iter()
            .map(|joint| match &joint.stiffness {
                Some(Value::Number(k)) => Ok(k.to_f64()),
                Some(Value::Symbol(name)) => Ok(self.positive(name)),
                None => Err(format!("{} has no stiffness", joint.name)),
            })
            .collect::<Result<_, _>>()?;
        Ok(diagonal(each.len(), |k| each[k]))
    }

    fn wrench(&self) -> [f64; 6] {
        core::array::from_fn(|k| self.random("wrench", k))
    }
}

impl Symbols for At<'_> {
    fn value(&self, key: &str, q: &[f64]) -> Result<Option<Dense>, String> {
        if let Some(n) = self.0.counted.get(key) {
            return Ok(Some(dense::scalar(*n as f64)));
        }
        // `K_2,kin` is of the family `K_#,kin`.
        let family: String = match key.split_once('_') {
            Some((base, indices)) => {
                let each = indices.split(',').map(|index| match index.parse::<i64>() {
                    Ok(_) => "#",
                    Err(_) => index,
                });
                format!("{base}_{}", each.collect::<Vec<_>>().join(","))
            }
            None => key.to_owned(),
        };
        let source = self.0.known.get(key).or_else(|| self.0.known.get(&family));
        source.map(|source| source(self, key, q)).transpose()
    }
}
