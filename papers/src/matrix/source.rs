//! What the symbols of a relation stand for: derived quantities of a robot, and random matrices of
//! the shapes that the data file gives.

use std::collections::HashMap;

use super::dense::{self, Dense};
use super::evaluate::Symbols;
use super::transform::transform;
use crate::exact::derived::{Path, Setting};
use crate::latex::lexer::{Lexeme, Token};
use crate::latex::notation::Notation;
use crate::latex::parser::parse;
use crate::latex::tree::Tree;
use stiffarm_codegen::derive::{Output, Program, derive_in};
use stiffarm_codegen::robot::{Robot, Value};

/// Postures of relations without a robot.
const JOINTS: usize = 3;

/// What a symbol stands for.
enum Source {
    /// Random, with a shape; the second flag makes it depend on the posture.
    Random {
        shape: (usize, usize),
        moves: bool,
    },
    /// Random and symmetric positive.
    Symmetric(usize),
    /// Random on the diagonal.
    Diagonal(usize),
    Identity(usize),
    /// A column of ones.
    Ones(usize),
    /// An output of the robot, whole or an entry of it.
    Output {
        program: Box<Program>,
        shape: (usize, usize),
        entry: Option<(usize, usize)>,
    },
    /// The joints' stiffnesses on a diagonal.
    Stiffness,
    /// The wrench.
    Wrench,
    /// A part of the equation's product of transforms.
    Constant(Dense),
    /// The pseudo-inverse of another symbol.
    PseudoInverse(String),
}

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
        symbols: &[(String, String)],
        setting: &Setting,
        given: &HashMap<String, f64>,
    ) -> Result<Self, String> {
        let robot = setting.robot.as_ref().and_then(|name| setting.robots.get(name)).cloned();
        let mut out = Sources {
            known: HashMap::new(),
            robot,
            counted: HashMap::new(),
            formulas: HashMap::new(),
            printed: Vec::new(),
            given: given.clone(),
        };
        for (symbol, text) in symbols {
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
                let source = out.source(text.trim(), setting)?;
                out.known.insert(key, source);
            }
            out.printed.push(token);
        }
        Ok(out)
    }

    fn source(&self, text: &str, setting: &Setting) -> Result<Source, String> {
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
        let found = match words.as_slice() {
            ["random", size] => shape(size).map(|shape| Source::Random { shape, moves: false }),
            ["random", size, "of", "q"] => {
                shape(size).map(|shape| Source::Random { shape, moves: true })
            }
            ["symmetric", n] => size(n).map(Source::Symmetric),
            ["diagonal", n] => size(n).map(Source::Diagonal),
            ["identity", n] => size(n).map(Source::Identity),
            ["ones", n] => size(n).map(Source::Ones),
            ["pseudo-inverse", "of", other] => {
                Some(Source::PseudoInverse(key(&single(other).ok_or_else(unknown)?)))
            }
            ["stiffness"] => Some(Source::Stiffness),
            ["wrench"] => Some(Source::Wrench),
            [part @ ("rotation" | "position" | "lever" | "transport")] => {
                Some(Source::Constant(transform(part, &setting.product, setting)?))
            }
            ["transport", "of", elements @ ..] => {
                let elements: Vec<String> = elements.iter().map(|e| (*e).to_owned()).collect();
                Some(Source::Constant(transform("transport", &elements, setting)?))
            }
            [path] => return self.output(path).ok_or_else(unknown),
            _ => None,
        };
        found.ok_or_else(unknown)
    }

    /// `jacobian`, `pose[1][4]`.
    fn output(&self, path: &str) -> Option<Source> {
        let robot = self.robot.as_ref()?;
        let path = Path::read(path).ok()?;
        let output = Output::EACH.into_iter().find(|output| output.name() == path.name)?;
        let shape = output.shape(robot.dof());
        let entry = path.entry(shape).ok()?;
        Some(Source::Output { program: Box::new(derive_in(robot, &[output], 0)), shape, entry })
    }
}

impl At<'_> {
    /// Its posture.
    pub fn posture(&self) -> Vec<f64> {
        let joints = self.0.robot.as_ref().map_or(JOINTS, Robot::dof);
        (0..joints).map(|k| 1.3 * self.random("q", k)).collect()
    }

    /// A number from −1 to 1 that follows from the point, a name and a count (FNV-1a, then a mixing
    /// step of SplitMix64).
    fn random(&self, name: &str, k: usize) -> f64 {
        let bytes = name.bytes().chain(k.to_le_bytes()).chain(self.1.to_le_bytes());
        let mut hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
        });
        hash = (hash ^ (hash >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        hash = (hash ^ (hash >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        2.0 * ((hash ^ (hash >> 31)) >> 11) as f64 / (1u64 << 53) as f64 - 1.0
    }

    /// A value above zero.
    fn positive(&self, name: &str) -> f64 {
        self.0.given.get(name).copied().unwrap_or_else(|| 1.5 + 0.9 * self.random(name, 0))
    }

    fn of_source(&self, key: &str, source: &Source, q: &[f64]) -> Result<Dense, String> {
        let square = |n: usize, of: &dyn Fn(usize, usize) -> f64| Dense::from_fn(n, n, of);
        let unit = |r: usize, c: usize| f64::from(u8::from(r == c));
        Ok(match source {
            Source::Random { shape: (rows, columns), moves } => {
                // A member of a family moves with its own joint.
                let own = key.split(['_', ',']).find_map(|index| index.parse::<usize>().ok());
                let q = match own {
                    Some(own) => q.get(own.wrapping_sub(1)).map_or(&q[..0], core::slice::from_ref),
                    None => q,
                };
                let moved = |k: usize| match moves {
                    true => {
                        q.iter().map(|q| (q * (1.0 + 0.5 * self.random(key, k + 997))).sin()).sum()
                    }
                    false => 0.0,
                };
                Dense::from_fn(*rows, *columns, |r, c| {
                    let k = r * columns + c;
                    self.random(key, k) + moved(k)
                })
            }
            Source::Symmetric(n) => square(*n, &|r, c| {
                self.random(key, r.min(c) * n + r.max(c)) + *n as f64 * unit(r, c)
            }),
            Source::Diagonal(n) => square(*n, &|r, c| (1.5 + self.random(key, r)) * unit(r, c)),
            Source::Identity(n) => Dense::identity(*n, *n),
            Source::Ones(n) => Dense::from_fn(*n, 1, |_, _| 1.0),
            Source::Output { program, shape: (rows, columns), entry } => {
                let parameter = |name: &str| self.positive(name);
                let found = program
                    .evaluate(q, &self.wrench(), parameter)
                    .map_err(|error| error.to_string())?;
                let whole = Dense::from_fn(*rows, *columns, |r, c| found[0][c * rows + r]);
                entry.map_or(whole.clone(), |(r, c)| dense::scalar(whole[(r, c)]))
            }
            Source::Stiffness => {
                let joints = self.0.robot.as_ref().map_or(&[][..], |robot| &robot.joints);
                let each: Vec<f64> = joints
                    .iter()
                    .map(|joint| match &joint.stiffness {
                        Some(Value::Number(k)) => Ok(k.to_f64()),
                        Some(Value::Symbol(name)) => Ok(self.positive(name)),
                        None => Err(format!("{} has no stiffness", joint.name)),
                    })
                    .collect::<Result<_, _>>()?;
                square(each.len(), &|r, c| each[r] * unit(r, c))
            }
            Source::Wrench => Dense::from_fn(6, 1, |r, _| self.wrench()[r]),
            Source::Constant(matrix) => matrix.clone(),
            Source::PseudoInverse(other) => {
                let matrix =
                    self.value(other, q)?.ok_or_else(|| format!("`{other}` is unknown"))?;
                dense::pseudo_inverse(&matrix).ok_or("no pseudo-inverse")?
            }
        })
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
        source.map(|source| self.of_source(key, source, q)).transpose()
    }
}
