//! Judges the cells of printed tables.

use std::collections::HashMap;

use super::evaluate::{Arithmetic, Real};
use super::file::{Column, Paper, Table};
use super::judge::truth;
use super::print::{decimal, short};
use super::rational::Rational;
use super::verdict::{Entry, Kind, Verdict};

/// Every cell of every table of a paper.
pub(super) fn cells(paper: &Paper) -> Vec<Entry> {
    paper.tables.iter().flat_map(|table| cells_of(paper, table)).collect()
}

/// What the names of a column's formula are given by other equations.
type Given = Result<HashMap<String, Rational>, String>;

fn cells_of(paper: &Paper, table: &Table) -> Vec<Entry> {
    let given: Vec<Given> = table.columns.iter().map(|column| lookup(paper, column)).collect();
    let mut out = Vec::new();
    for row in &table.rows {
        let mut values = paper.values.clone();
        values.extend(table.values.iter().map(|(name, value)| (name.clone(), *value)));
        let mut label = Vec::new();
        for (column, cell) in table.columns.iter().zip(row) {
            let Some((value, _)) = decimal(&cell.text) else { continue };
            let value = if column.degrees { value.to_radians() } else { value };
            if let Some(symbol) = &column.rounded {
                values.insert(symbol.clone(), value);
            }
            if let Some(symbol) = &column.symbol {
                // Columns that are worked out replace this by their own value below.
                values.insert(symbol.clone(), value);
                if column.formula.is_none() && column.why.is_none() {
                    label.push(cell.text.clone());
                }
            }
        }
        let label = match (label.is_empty(), row.first()) {
            (true, Some(first)) => first.text.clone(),
            _ => label.join(", "),
        };
        for ((column, cell), given) in table.columns.iter().zip(row).zip(&given) {
            let number = format!("{} ({label}) {}", table.number, column.name);
            let mut entry = Entry::new(&paper.id, &number, Kind::Cell, &cell.text);
            entry.note = column.note.clone().or_else(|| table.note.clone());
            judge(&mut entry, column, &cell.text, given, &mut values);
            out.push(entry);
        }
    }
    out
}

fn lookup(paper: &Paper, column: &Column) -> Given {
    let mut out = HashMap::new();
    for (name, number) in &column.equations {
        let equation =
            paper.equations.iter().chain(&paper.quantities).find(|e| e.number == *number);
        let equation = equation.ok_or_else(|| format!("there is no equation {number}"))?;
        let value = truth(paper, equation)?;
        let single = value.get(0, 0).cloned().ok_or("an empty equation")?;
        out.insert(name.clone(), single);
    }
    Ok(out)
}

fn judge(
    entry: &mut Entry,
    column: &Column,
    printed: &str,
    given: &Given,
    values: &mut HashMap<String, f64>,
) {
    if let Some(why) = &column.why {
        entry.verdict = Verdict::NotReproduced;
        entry.note = Some(why.clone());
        return;
    }
    let Some(formula) = &column.formula else {
        entry.verdict = Verdict::Given;
        return;
    };
    let given = match given {
        Ok(given) => given,
        Err(why) => {
            entry.verdict = Verdict::NotJudged;
            entry.note = Some(why.clone());
            return;
        }
    };
    let plain = Real(|name: &str| values.get(name).copied());
    let resolved = Real(|name: &str| match given.get(name) {
        Some(exact) => plain.rational(exact),
        None => values.get(name).copied(),
    });
    let (Some(computed), Some((value, unit))) = (resolved.tree(formula), decimal(printed)) else {
        entry.verdict = Verdict::NotJudged;
        entry.note = Some("a symbol of the formula has no value".into());
        return;
    };
    let computed = if column.degrees { computed.to_degrees() } else { computed };
    let off = (computed - value).abs() / unit;
    // Half a unit is rounding; a hair more is the rounding of this comparison.
    entry.verdict = match off {
        off if off <= 0.5 + 1e-6 => Verdict::Reproduced,
        off if off <= 1.0 => Verdict::Close,
        _ => Verdict::NotReproduced,
    };
    entry.correction = Some(short(computed));
    if entry.verdict != Verdict::Reproduced {
        entry.change = Some(format!("off by {} units of the last digit", short(off)));
    }
    if let Some(symbol) = &column.symbol {
        values.insert(symbol.clone(), computed);
    }
}

#[cfg(test)]
mod tests {
    use super::super::file::read;
    use super::*;

    #[test]
    fn cells_are_compared_in_units_of_their_last_digit() {
        let text = "paper = 'x'\n[[equation]]\nnumber = '(1)'\nlatex = 'y = a'\ntruth = '2a'\n\
            [[table]]\nnumber = 'I'\nrows = [['1', '3', '2', 'm'], ['2', '4.0', '9', 'n']]\n\
            [[table.column]]\nname = 'a'\nsymbol = 'a'\n\
            [[table.column]]\nname = 'y'\nformula = 'y'\nequations = { y = '(1)' }\n\
            [[table.column]]\nname = 'z'\nformula = '2a'\n\
            [[table.column]]\nname = 'm'\nwhy = 'measured'\n";
        let paper = read(text, "x").unwrap();
        let found: Vec<_> = cells(&paper).into_iter().map(|e| e.verdict).collect();
        use Verdict::{Close, Given, NotReproduced, Reproduced};
        assert_eq!(
            found,
            [
                Given,
                Close,
                Reproduced,
                NotReproduced,
                Given,
                Reproduced,
                NotReproduced,
                NotReproduced
            ]
        );
    }
}
