//! The rows of the inline table.

use proc_macro2::TokenTree;

use super::super::dimension::Dimension;
use super::super::draft::{Cell, DraftDrive, DraftJoint};
use super::super::lexeme::Lexeme;
use super::super::model::{Angle, Motion, Value};
use super::super::problem::{Place, Problem, Report};
use super::super::suggest::advice;
use super::cells::{
    self, Raw, Variable, angle, angle_of, inertia, limits, value, value_of, values, variable,
};
use super::spot::{Spot, is_sign, is_word, words};
use super::{beam, header, rows};

/// The columns that a table may have.
pub(super) const COLUMNS: [&str; 17] = [
    "joint",
    "theta",
    "d",
    "a",
    "alpha",
    "beta",
    "stiffness",
    "mass",
    "com",
    "inertia",
    "gear",
    "rotor_inertia",
    "coulomb",
    "viscous",
    "limits",
    "beam",
    "source",
];
const HEADER_HELP: &str = "for example `joint | theta | d | a | alpha | stiffness`";

/// Reads the table; `at` is the place to blame if there is none.
pub(super) fn read(
    tokens: &[TokenTree],
    at: Spot,
    report: &mut Report<Spot>,
) -> Vec<DraftJoint<Spot>> {
    if tokens.is_empty() {
        report.error(Problem::new(at, "the table is missing").help(HEADER_HELP));
        return Vec::new();
    }
    if is_sign(&tokens[0], '|') {
        let problem = Problem::new(Spot::new(tokens[0].span()), "`|` stands between two cells");
        report.error(problem.help("begin each line with its first cell, and end it with its last"));
        return Vec::new();
    }
    let mut rows = rows::split(tokens).into_iter();
    let columns = Columns::read(&rows.next().unwrap_or_default(), at, report);
    let rows: Vec<_> = rows.collect();
    if rows.is_empty() {
        let problem = Problem::new(columns.at, "a robot has at least one joint");
        report.error(problem.help("write one row per joint under the header, base to tip"));
    }
    rows.iter().filter_map(|row| columns.row(row, report)).collect()
}

/// The header.
struct Columns {
    /// The columns in order; `None` for one whose name has been reported.
    names: Vec<Option<&'static str>>,
    at: Spot,
    /// Whether it is known in which columns `q` can stand.
    has_variable: bool,
}

impl Columns {
    fn read(header: &[TokenTree], at: Spot, report: &mut Report<Spot>) -> Self {
        let at = Spot::of(header, at);
        let mut names: Vec<Option<&'static str>> = Vec::new();
        let mut sound = true;
        for (i, cell) in cells::split(header, '|', at).iter().enumerate() {
            let name = report.keep(column(cell, i, &names));
            sound &= name.is_some();
            names.push(name);
        }
        let has = |name| names.contains(&Some(name));
        let has_variable = has("theta") || has("d");
        if sound && !has_variable {
            let message = "neither a column `theta` nor `d`: the joint variable `q` stands in one";
            report.error(Problem::new(at, message).help(HEADER_HELP));
        }
        Columns { names, at, has_variable: sound && has_variable }
    }

    fn row(&self, tokens: &[TokenTree], report: &mut Report<Spot>) -> Option<DraftJoint<Spot>> {
        let cells = cells::split(tokens, '|', self.at);
        let at = Spot::of(tokens, self.at);
        if !self.counts(&cells, at, report) {
            return None;
        }
        let row = Row { columns: &self.names, cells: &cells, at };
        Some(row.joint(self.has_variable, report))
    }

    /// Whether a row has as many cells as the header.
    fn counts(&self, cells: &[Raw], at: Spot, report: &mut Report<Spot>) -> bool {
        let (found, expected) = (cells.len(), self.names.len());
        if found == expected {
            return true;
        }
        let label = cells.iter().take(1).flat_map(|c| &c.tokens).map(ToString::to_string);
        let label = label.collect::<Vec<_>>().join(" ");
        let message =
            format!("row `{label}` has {found} cells where the header has {expected} columns");
        let problem = match cells.get(expected) {
            Some(extra) => Problem::new(extra.at.to(&at), message),
            None => {
                let missing: Option<Vec<&str>> = self.names[found..].iter().copied().collect();
                let help = missing.map(|names| format!("no cell for {}: ", names.join(", ")));
                let help = help.unwrap_or_default() + "write `-` for none";
                Problem::new(at, message).help(help)
            }
        };
        report.error(problem);
        false
    }
}

/// The name of a column.
fn column(
    cell: &Raw,
    index: usize,
    before: &[Option<&'static str>],
) -> Result<&'static str, Problem<Spot>> {
    let [TokenTree::Ident(word)] = cell.tokens.as_slice() else {
        let problem = Problem::new(cell.at, "the name of one column is expected here");
        return Err(problem.help(format!("known here: {}", COLUMNS.join(", "))));
    };
    let word = word.to_string();
    let Some(name) = COLUMNS.into_iter().find(|known| *known == word) else {
        let problem = Problem::new(cell.at, format!("unknown column `{word}`"));
        return Err(problem.help(advice(&word, &COLUMNS)));
    };
    if before.contains(&Some(name)) {
        return Err(Problem::new(cell.at, format!("a second column `{name}`")));
    }
    if index == 0 && name != "joint" {
        return Err(Problem::new(cell.at, "the first column is `joint`").help(HEADER_HELP));
    }
    Ok(name)
}

/// One row that has a cell for every column.
struct Row<'a> {
    columns: &'a [Option<&'static str>],
    cells: &'a [Raw],
    at: Spot,
}

impl Row<'_> {
    /// The cell of a column, unless it is absent.
    fn get(&self, column: &str) -> Option<&Raw> {
        let index = self.columns.iter().position(|name| *name == Some(column))?;
        let rigid = |cell: &Raw| match cell.tokens.as_slice() {
            // What the generated documentation writes for a joint without a spring.
            [word] => column == "stiffness" && is_word(word, "rigid"),
            _ => false,
        };
        let none = |cell: &Raw| cell.is_absent() || cell.tokens.is_empty() || rigid(cell);
        self.cells.get(index).filter(|cell| !none(cell))
    }

    fn joint(&self, has_variable: bool, report: &mut Report<Spot>) -> DraftJoint<Spot> {
        for empty in self.cells.iter().skip(1).filter(|cell| cell.tokens.is_empty()) {
            let problem = Problem::new(empty.at, "an empty cell");
            report.error(problem.help("write `0`, or `-` for what is absent"));
        }
        let theta = self.variable("theta", report);
        let d = self.variable("d", report);
        let motion = match has_variable {
            true => self.motion(&theta, &d, report),
            false => Cell::broken(self.at),
        };
        // What these measure depends on a motion that may not be known: they are then left unread.
        let by_motion = |column, dimension: fn(Motion) -> Dimension, report: &mut Report<Spot>| {
            self.get(column).map(|cell| match motion.value {
                Some(motion) => value(cell, dimension(motion), report),
                None => Cell::broken(cell.at),
            })
        };
        let stiffness = by_motion("stiffness", Dimension::stiffness, report);
        let limits = self.get("limits").map(|cell| match motion.value {
            Some(motion) => limits(cell, motion, report),
            None => Cell::broken(cell.at),
        });
        DraftJoint {
            at: self.at,
            name: self.cells.first().map(|cell| name(cell, self.at, report)),
            theta: theta.map(|(v, at)| offset(v, at, report, Angle::ZERO, angle_of)),
            d: d.map(|(v, at)| {
                offset(v, at, report, Value::ZERO, |words, at, report| {
                    value_of(words, at, Dimension::Length, report)
                })
            }),
            a: self.get("a").map(|cell| value(cell, Dimension::Length, report)),
            alpha: self.get("alpha").map(|cell| angle(cell, report)),
            beta: self.get("beta").map(|cell| angle(cell, report)),
            stiffness,
            mass: self.get("mass").map(|cell| value(cell, Dimension::Mass, report)),
            com: self.get("com").map(|c| (c.at, values(c, Dimension::Length, report))),
            inertia: self.get("inertia").map(|c| (c.at, inertia(c, report))),
            drive: DraftDrive {
                gear: by_motion("gear", Dimension::gear, report),
                rotor_inertia: self
                    .get("rotor_inertia")
                    .map(|cell| value(cell, Dimension::Inertia, report)),
                coulomb: by_motion("coulomb", Dimension::load, report),
                viscous: by_motion("viscous", Dimension::damping, report),
            },
            limits,
            source: self.get("source").map(|cell| header::string(cell, report)),
            beam: self.get("beam").and_then(|cell| beam::read(cell, report)),
            motion,
        }
    }

    /// The cell of a column in which `q` can stand. A broken one has no content.
    fn variable(
        &self,
        column: &str,
        report: &mut Report<Spot>,
    ) -> Option<(Option<Variable>, Spot)> {
        let cell = self.get(column)?;
        Some((report.keep(variable(words(&cell.tokens))), cell.at))
    }

    /// Revolute or prismatic: `q` stands in exactly one of the two cells.
    fn motion(
        &self,
        theta: &Option<(Option<Variable>, Spot)>,
        d: &Option<(Option<Variable>, Spot)>,
        report: &mut Report<Spot>,
    ) -> Cell<Motion, Spot> {
        // A cell breaks only over its `q`: there is one.
        let place = |cell: &Option<(Option<Variable>, Spot)>| match cell {
            Some((Some(variable), _)) => variable.q,
            Some((None, at)) => Some(*at),
            None => None,
        };
        match (place(theta), place(d)) {
            (Some(q), None) => return Cell::new(Motion::Revolute, q),
            (None, Some(q)) => return Cell::new(Motion::Prismatic, q),
            (Some(_), Some(q)) => {
                let message = "`q` stands in theta and in d of this row: a joint has one variable";
                report.error(Problem::new(q, message));
            }
            (None, None) => {
                let at = theta.as_ref().or(d.as_ref()).map_or(self.at, |(_, at)| *at);
                let problem = Problem::new(at, "no `q` in theta or d of this row");
                let help = "write `q` in theta for a revolute joint, in d for a prismatic one";
                report.error(problem.help(help));
            }
        }
        Cell::broken(self.at)
    }
}

fn offset<T>(
    variable: Option<Variable>,
    at: Spot,
    report: &mut Report<Spot>,
    zero: T,
    read: impl FnOnce(&[Lexeme<Spot>], Spot, &mut Report<Spot>) -> Cell<T, Spot>,
) -> Cell<T, Spot> {
    match variable {
        None => Cell::broken(at),
        Some(Variable { q: Some(_), offset }) if offset.is_empty() => Cell::new(zero, at),
        Some(Variable { offset, .. }) => read(&offset, at, report),
    }
}

/// The joint's name: one word, or a number.
fn name(cell: &Raw, row: Spot, report: &mut Report<Spot>) -> Cell<String, Spot> {
    match cell.tokens.as_slice() {
        [TokenTree::Ident(word)] => Cell::new(word.to_string(), cell.at),
        [TokenTree::Literal(number)] if number.to_string().bytes().all(|b| b.is_ascii_digit()) => {
            Cell::new(number.to_string(), cell.at)
        }
        tokens => {
            let at = if tokens.is_empty() { row } else { cell.at };
            report.error(Problem::new(at, "the joint's name, one word, is expected here"));
            Cell::broken(at)
        }
    }
}
