//! A table as its program wrote it: its header, whatever separates its cells, and its rows one by one.

use std::borrow::Cow;

use super::clock::Clock;
use super::file::Text;
use super::join::Join;
use super::{Map, names};
use crate::io::cell::{Decimals, is_none};
use crate::io::table::{Record, Separator, commented};
use crate::io::{Column, Convention, Fault, Mistake, Mistakes, ReadError, Unit};

/// A table whose header was found and whose cells were looked at; its rows are read again one by one.
#[derive(Clone)]
pub(super) struct Table<'t> {
    pub file: &'t str,
    text: &'t Text<'t>,
    separator: Separator,
    decimals: Decimals,
    /// How a comment says that orientations are written.
    pub orientation: Option<Convention>,
    /// Another table, whose columns stand behind these.
    join: Option<Join<'t>>,
    /// The line of the names, and the last one that is no row: theirs or that of the units.
    pub line: u64,
    above: u64,
    pub names: Vec<String>,
    /// From a row of units; empty where there is none.
    pub units: Vec<String>,
    /// What was seen in each column.
    pub seen: Vec<Seen>,
    pub said: Vec<String>,
}

/// What the cells of a column hold.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    /// The largest number.
    pub most: f64,
    /// The smallest number; infinity without any.
    pub least: f64,
    pub has_numbers: bool,
    pub has_words: bool,
}

impl Default for Seen {
    fn default() -> Seen {
        Seen { most: 0.0, least: f64::INFINITY, has_numbers: false, has_words: false }
    }
}

/// Rows above which a header is looked for.
const MOST_ABOVE: u64 = 1000;

impl<'t> Table<'t> {
    /// Finds the header, and looks at all cells.
    ///
    /// # Errors
    /// [`ReadError`]: no header; rows that are not as long as it; a quotation mark that is not closed.
    pub(super) fn of(
        file: &'t str,
        text: &'t Text<'t>,
        map: &Map,
        mut said: Vec<String>,
    ) -> Result<Table<'t>, ReadError> {
        let table = Table::headed(file, text, map);
        let mut table = table.map_err(|mistake| mistake.of(file))?;
        let (mut seen, mut mistakes) =
            (vec![Seen::default(); table.names.len()], Mistakes::default());
        let mut comma = false;
        let wide = table.names.iter().rposition(|name| !name.is_empty()).map_or(0, |last| last + 1);
        let looked = table.each(|row| {
            let surplus = row.cells.get(table.names.len()..).unwrap_or_default();
            if row.cells.len() < wide || surplus.iter().any(|cell| !cell.is_empty()) {
                mistakes.add(Fault::ragged(row.cells.len(), table.names.len()).at(row.line, None));
            }
            for (seen, cell) in seen.iter_mut().zip(row.cells).filter(|(_, c)| !is_none(c)) {
                let number = table.decimals.found(cell);
                comma |= number.is_some() && cell.contains(',');
                seen.has_numbers |= number.is_some();
                seen.has_words |= number.is_none();
                seen.most = seen.most.max(number.unwrap_or(0.0).abs());
                seen.least = number.map_or(seen.least, |number| seen.least.min(number));
            }
        });
        let empty = looked.map_err(|mistake| mistakes.add(mistake)).unwrap_or(0);
        mistakes.check(file)?;
        table.seen = seen;
        table.decimals.comma = map.decimal.map_or(comma, |decimal| decimal == ',');
        let words = table.separator.words();
        said.extend(table.decimals.comma.then(|| "a comma begins the decimals".to_owned()));
        said.extend((words != "commas").then(|| format!("cells are separated by {words}")));
        said.append(&mut table.said);
        said.extend((empty > 0).then(|| format!("{empty} empty rows are left out")));
        Ok(Table { said, ..table })
    }

    /// The header, where the map says, else the last row of words above the first row of numbers.
    fn headed(file: &'t str, text: &'t Text<'t>, map: &Map) -> Result<Table<'t>, Mistake> {
        let mut records = text.records(None)?;
        let separator = records.separator();
        let decimals = Decimals::of(separator, map);
        let mut rows: Vec<Owned> = Vec::new();
        let (mut is_body, mut given) = (false, None);
        let most = map.header.unwrap_or(MOST_ABOVE);
        while let Some(record) = records.read()?
            && !is_body
            && (rows.len() as u64) <= most
        {
            let row = Owned::of(record)?;
            is_body = match map.header {
                Some(_) => given.is_some(),
                None => row.is_of_numbers(decimals),
            };
            if map.header == Some(row.line) && !row.is_blank() {
                given = Some(rows.len());
            }
            rows.push(row);
        }
        let found = || {
            let body = is_body.then(|| rows.len() - 1)?;
            let last = |is: &dyn Fn(&Owned) -> bool| (0..body).rev().find(|k| is(&rows[*k]));
            last(&|row| row.words() >= 2 && !row.are_units()).or_else(|| last(&|r| r.words() >= 2))
        };
        let at = match map.header {
            Some(line) => given.ok_or_else(|| Map::no_header(line)),
            None => found().ok_or_else(|| {
                let help = "give its line in the map, `header = 3`";
                Mistake::from(Fault::new("no header", "a row of names above rows of numbers", help))
            }),
        }?;
        let names = match at.checked_sub(1) {
            Some(above) => grouped(&rows[at].cells, &rows[above]),
            None => rows[at].cells.clone(),
        };
        let above = rows[..at].iter().filter(|row| !row.is_blank());
        // A row of groups that some names need is no title.
        let is_title = |row: &&Owned| names == rows[at].cells || row.line != rows[at - 1].line;
        let title = above.into_iter().find(is_title).map(|title| {
            let (line, title) = (rows[at].line, title.cells.join(" "));
            format!("what stands above line {line} is left out: `{}` …", title.trim())
        });
        let units = rows.get(at + 1).filter(|row| row.are_units());
        let mut orientation = None;
        for (line, name) in commented(&records.above, "orientation") {
            orientation = Some(Convention::named(name).map_err(|fault| fault.at(line, None))?);
        }
        Ok(Table {
            file,
            text,
            separator,
            decimals,
            orientation,
            join: None,
            line: rows[at].line,
            above: units.unwrap_or(&rows[at]).line,
            units: units.map_or_else(Vec::new, |row| row.cells.clone()),
            names,
            seen: Vec::new(),
            said: title.into_iter().collect(),
        })
    }

    /// With the columns of another table behind its own, and what was done in sentences.
    pub(super) fn joined(self, join: Join<'t>, said: Vec<String>) -> Table<'t> {
        let (mut names, mut seen, mut units) = (self.names, self.seen, self.units);
        units.resize(names.len(), String::new());
        let Join { columns, .. } = &join;
        for column in columns {
            names.push(column.name.clone());
            units.push(column.unit.clone());
            seen.push(column.seen);
        }
        let said = [self.said, said].concat();
        Table { names, seen, units, said, join: Some(join), ..self }
    }

    /// Goes through the rows below the header that hold anything, and counts the others.
    pub(super) fn each(&self, mut take: impl FnMut(&Row<'_>)) -> Result<usize, Mistake> {
        let mut records = self.text.records(Some(self.separator))?;
        let (mut rows, mut empty) = (0, 0);
        while let Some(record) = records.read()? {
            if record.line <= self.above {
                continue;
            }
            let (line, mut cells) = (record.line, record.texts()?);
            if cells.iter().all(|cell| cell.is_empty()) {
                empty += 1;
                continue;
            }
            let Some(join) = &self.join else {
                take(&Row { line, cells: &cells });
                continue;
            };
            let met = join.meets(self, rows, &Row { line, cells: &cells })?;
            rows += 1;
            let Some(beside) = met.map(|met| join.cells(&met)) else { continue };
            cells.resize(self.names.len() - beside.len(), "");
            cells.extend(beside.iter().map(AsRef::<str>::as_ref));
            take(&Row { line, cells: &cells });
        }
        Ok(empty)
    }

    /// A cell as it stands, its decimals behind a point if it is a number.
    pub(super) fn text<'c>(&self, row: &Row<'c>, column: usize) -> Cow<'c, str> {
        self.decimals_of(column).plain(row.cells.get(column).copied().unwrap_or_default())
    }

    /// What begins the decimals of a column. A table that was joined has points.
    fn decimals_of(&self, column: usize) -> Decimals {
        let own = self.names.len() - self.join.as_ref().map_or(0, |join| join.columns.len());
        if column < own { self.decimals } else { Decimals::default() }
    }

    /// A column as messages name it.
    pub(super) fn column(&self, index: usize) -> Column {
        Column { number: index + 1, header: self.names[index].clone() }
    }

    /// The number of a cell; `None` of one that says that it holds none.
    ///
    /// # Errors
    /// What is no number, or may be two: `1.100` where a comma begins the decimals.
    pub(super) fn number(&self, row: &Row<'_>, column: usize) -> Result<Option<f64>, Mistake> {
        let number =
            self.decimals_of(column).number(row.cells.get(column).copied().unwrap_or_default());
        number.map_err(|fault| fault.at(row.line, Some(self.column(column))))
    }
}

/// A row of cells, and its line in the file (of a sheet, its row), from 1.
pub(super) struct Row<'c> {
    pub line: u64,
    pub cells: &'c [&'c str],
}

/// A row that is held.
struct Owned {
    line: u64,
    cells: Vec<String>,
}

impl Owned {
    fn of(record: &Record) -> Result<Owned, Mistake> {
        let cells = record.texts()?.into_iter().map(str::to_owned).collect();
        Ok(Owned { line: record.line, cells })
    }

    fn is_blank(&self) -> bool {
        self.words() == 0
    }

    /// Cells that hold anything.
    fn words(&self) -> usize {
        self.cells.iter().filter(|cell| !cell.is_empty()).count()
    }

    fn is_of_numbers(&self, decimals: Decimals) -> bool {
        let is = |cell: &&String| decimals.found(cell).is_some() || Clock::of(cell).is_some();
        let numbers = self.cells.iter().filter(is).count();
        numbers >= 2 && 2 * numbers >= self.words()
    }

    /// Whether at least half of the cells that say anything name units, and none is a number.
    fn are_units(&self) -> bool {
        let units = self.cells.iter().filter(|c| Unit::spelled(c).is_some()).count();
        let is_number = |cell: &String| cell.parse::<f64>().is_ok();
        units > 0 && 2 * units >= self.words() && !self.cells.iter().any(is_number)
    }
}

/// The names of columns below a row of groups: with their group's where they stand more than once, or mean
/// nothing without it.
fn grouped(cells: &[String], above: &Owned) -> Vec<String> {
    if above.words() < 2 {
        return cells.to_vec();
    }
    let means = |name: &str| names::meaning(names::split(name).0).is_some();
    let mut group = "";
    let each = cells.iter().enumerate().map(|(k, name)| {
        group = above.cells.get(k).map(String::as_str).filter(|g| !g.is_empty()).unwrap_or(group);
        let joined = format!("{group} {name}").trim().to_owned();
        let is_twice = || cells.iter().filter(|other| *other == name).count() > 1;
        let needs = name.is_empty() || is_twice() || !means(name) && means(&joined);
        if needs && !group.is_empty() { joined } else { name.clone() }
    });
    each.collect()
}
