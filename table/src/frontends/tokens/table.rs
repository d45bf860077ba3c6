//! The rows of the inline table.

use proc_macro2::TokenTree;

use super::cells::{self, Raw, Variable, variable};
use super::spot::{Spot, is_sign, words};
use super::{beam, rows};
use crate::robot::problem::{Place, Problem, Report};
use crate::robot::suggest::advice;
use crate::schema::{Content, JOINT, Node, Table, keys};

/// The columns that a table may have: a joint's fields, behind its label.
pub(super) fn columns() -> Vec<&'static str> {
    let fields = keys(JOINT).into_iter().filter(|key| !["type", "name"].contains(key));
    [LABEL].into_iter().chain(fields).collect()
}

/// The column of the joints' labels.
const LABEL: &str = "joint";
const HEADER_HELP: &str = "for example `joint | theta | d | a | alpha | stiffness`";

/// Reads the table; `at` is the place to blame if there is none.
pub(super) fn read(tokens: &[TokenTree], at: Spot, report: &mut Report<Spot>) -> Vec<Node<Spot>> {
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

    fn row(&self, tokens: &[TokenTree], report: &mut Report<Spot>) -> Option<Node<Spot>> {
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
        return Err(problem.help(format!("known here: {}", columns().join(", "))));
    };
    let word = word.to_string();
    let Some(name) = columns().into_iter().find(|known| *known == word) else {
        let problem = Problem::new(cell.at, format!("unknown column `{word}`"));
        return Err(problem.help(advice(&word, &columns())));
    };
    if before.contains(&Some(name)) {
        return Err(Problem::new(cell.at, format!("a second column `{name}`")));
    }
    if index == 0 && name != LABEL {
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
        self.cells.get(index).filter(|cell| !cell.is_absent() && !cell.tokens.is_empty())
    }

    /// The row as the `[[joint]]` table of a robot file.
    fn joint(&self, has_variable: bool, report: &mut Report<Spot>) -> Node<Spot> {
        for empty in self.cells.iter().skip(1).filter(|cell| cell.tokens.is_empty()) {
            let problem = Problem::new(empty.at, "an empty cell");
            report.error(problem.help("write `0`, or `-` for what is absent"));
        }
        let offsets = ["theta", "d"].map(|column| self.variable(column, report));
        let mut table = Table::new();
        let motion = match has_variable {
            true => self.motion(&offsets, report),
            false => Node::broken(&self.at),
        };
        table.put("type", &self.at, motion);
        if let Some(cell) = self.cells.first() {
            table.put("name", &self.at, name(cell, self.at, report));
        }
        for (column, cell) in ["theta", "d"].into_iter().zip(offsets) {
            if let Some((variable, at)) = cell {
                let value = offset(variable, at);
                value.into_iter().for_each(|value| table.put(column, &at, value));
            }
        }
        let others = self.columns.iter().flatten().filter(|c| !["joint", "theta", "d"].contains(c));
        for (column, cell) in others.filter_map(|column| Some((column, self.get(column)?))) {
            let value = match *column {
                "beam" => beam::read(cell, report),
                _ => cells::node(cell),
            };
            table.put(column, &cell.at, value);
        }
        Node::made(&self.at, Content::Table(table))
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
        [theta, d]: &[Option<(Option<Variable>, Spot)>; 2],
        report: &mut Report<Spot>,
    ) -> Node<Spot> {
        // A cell breaks only over its `q`: there is one.
        let place = |cell: &Option<(Option<Variable>, Spot)>| match cell {
            Some((Some(variable), _)) => variable.q,
            Some((None, at)) => Some(*at),
            None => None,
        };
        match (place(theta), place(d)) {
            (Some(q), None) => return Node::text(&q, "revolute"),
            (None, Some(q)) => return Node::text(&q, "prismatic"),
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
        Node::broken(&self.at)
    }
}

/// What is added to `q`, or the whole cell where it does not stand; `None` if that is nothing.
fn offset(variable: Option<Variable>, at: Spot) -> Option<Node<Spot>> {
    let Some(Variable { q, offset }) = variable else { return Some(Node::broken(&at)) };
    let words = Some(offset).filter(|offset| q.is_none() || !offset.is_empty())?;
    Some(Node { at, kind: None, words: Some(words), content: Content::Cell })
}

/// The joint's name: one word, or a number.
fn name(cell: &Raw, row: Spot, report: &mut Report<Spot>) -> Node<Spot> {
    match cell.tokens.as_slice() {
        [TokenTree::Ident(word)] => Node::text(&cell.at, word.to_string()),
        [TokenTree::Literal(number)] if number.to_string().bytes().all(|b| b.is_ascii_digit()) => {
            Node::text(&cell.at, number.to_string())
        }
        tokens => {
            let at = if tokens.is_empty() { row } else { cell.at };
            report.error(Problem::new(at, "the joint's name, one word, is expected here"));
            Node::broken(&at)
        }
    }
}
