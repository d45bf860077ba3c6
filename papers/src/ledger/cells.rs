//! Judges the cells of printed tables.

use std::collections::HashMap;

use super::judge::truth;
use crate::exact::arithmetic::{Arithmetic, Real};
use crate::exact::print::{decimal, short};
use crate::exact::truth::Truth;
use crate::file::{Column, Paper, Table};
use crate::verdict::{Entry, Kind, Verdict};

/// Methods that work out a column of cells, by their names: one value for each row, `None` for a
/// cell that the method has nothing to say of. An unknown name has no column.
pub type Methods<'m> = &'m dyn Fn(&str) -> Option<Result<Vec<Option<f64>>, String>>;

/// Every cell of every table of a paper.
pub(super) fn cells(paper: &Paper, methods: Methods<'_>) -> Vec<Entry> {
    paper.tables.iter().flat_map(|table| cells_of(paper, table, methods)).collect()
}

/// What the names of a column's formula are given by other equations.
type Given = Result<HashMap<String, Truth>, String>;

fn cells_of(paper: &Paper, table: &Table, methods: Methods<'_>) -> Vec<Entry> {
    let given: Vec<Given> = table.columns.iter().map(|column| lookup(paper, column)).collect();
    let computed: Vec<Option<Result<Vec<Option<f64>>, String>>> = table
        .columns
        .iter()
        .map(|column| {
            let name = column.computed.as_ref()?;
            let unknown = || Err(format!("no method is named `{name}`"));
            Some(methods(name).unwrap_or_else(unknown))
        })
        .collect();
    let mut out = Vec::new();
    for (at, row) in table.rows.iter().enumerate() {
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
                if column.is_given() {
                    label.push(cell.text.clone());
                }
            }
        }
        let label = match (label.is_empty(), row.first()) {
            (true, Some(first)) => first.text.clone(),
            _ => label.join(", "),
        };
        let columns = table.columns.iter().zip(row).zip(&given).zip(&computed);
        for (((column, cell), given), computed) in columns {
            let number = format!("{} ({label}) {}", table.number, column.name);
            let mut entry = Entry::new(&paper.id, &number, Kind::Cell, &cell.text);
            entry.note = column.note.clone().or_else(|| table.note.clone());
            let value = match computed {
                Some(Ok(values)) => Ok(values.get(at).copied().flatten()),
                Some(Err(why)) => Err(why.clone()),
                None => by_formula(column, given, &values),
            };
            if let (Some(symbol), Ok(Some(value))) = (&column.symbol, &value) {
                values.insert(symbol.clone(), *value);
            }
            judge(&mut entry, column, &cell.text, value);
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
        out.insert(name.clone(), truth(paper, equation)?);
    }
    Ok(out)
}

/// What a column's formula comes to in one row; nothing for a column without one.
fn by_formula(
    column: &Column,
    given: &Given,
    values: &HashMap<String, f64>,
) -> Result<Option<f64>, String> {
    let Some(formula) = &column.formula else { return Ok(None) };
    let given = given.as_ref().map_err(Clone::clone)?;
    let resolved = Real(|name: &str| match given.get(name) {
        Some(truth) => {
            truth.form(*truth.entries.first()?).real(|name| values.get(name).copied()).ok()
        }
        None => values.get(name).copied(),
    });
    Ok(Some(resolved.tree(formula)?))
}

fn judge(entry: &mut Entry, column: &Column, printed: &str, value: Result<Option<f64>, String>) {
    let computed = match value {
        Ok(Some(value)) if column.degrees => value.to_degrees(),
        Ok(Some(value)) => value,
        Ok(None) if column.is_given() => return entry.verdict = Verdict::Given,
        Ok(None) => {
            let why = column.why.clone();
            entry.verdict = if why.is_some() { Verdict::NotReproduced } else { Verdict::NotJudged };
            entry.note = why.or_else(|| Some("the method gives no value for this cell".into()));
            return;
        }
        Err(why) => return entry.not_judged(why),
    };
    let bound = printed.trim().strip_prefix('≤');
    let Some((value, unit)) = decimal(bound.unwrap_or(printed)) else {
        return entry.not_judged(format!("`{printed}` is no number"));
    };
    let off = (computed - value).abs() / unit;
    // Half a unit is rounding; a hair more is the rounding of this comparison.
    entry.verdict = match off {
        _ if bound.is_some() && computed <= value => Verdict::Reproduced,
        off if off <= 0.5 + 1e-6 => Verdict::Reproduced,
        off if off <= 1.0 => Verdict::Close,
        _ => Verdict::NotReproduced,
    };
    entry.correction = Some(short(computed));
    if entry.verdict != Verdict::Reproduced {
        entry.change = Some(match off {
            off if off < 1000.0 => format!("off by {off:.1} units of the last digit"),
            _ => format!("{:.3} times the printed value", computed / value),
        });
        if column.why.is_some() {
            entry.note.clone_from(&column.why);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::read;

    #[test]
    fn cells_are_compared_in_units_of_their_last_digit() {
        let text = "paper = 'x'\n[[equation]]\nnumber = '(1)'\nlatex = 'y = a'\ntruth = '2a'\n\
            [[table]]\nnumber = 'I'\nrows = [['1', '3', '2', 'm'], ['2', '4.0', '9', 'n']]\n\
            [[table.column]]\nname = 'a'\nsymbol = 'a'\n\
            [[table.column]]\nname = 'y'\nformula = 'y'\nequations = { y = '(1)' }\n\
            [[table.column]]\nname = 'z'\nformula = '2a'\n\
            [[table.column]]\nname = 'm'\nwhy = 'measured'\n";
        let paper = read(text, "x").unwrap();
        let found: Vec<_> = cells(&paper, &|_| None).into_iter().map(|e| e.verdict).collect();
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
    #[test]
    fn methods_give_what_no_formula_does() {
        let text = "paper = 'x'\n[[table]]\nnumber = 'I'\n\
            rows = [['1.0', '≤ 0.5'], ['2.0', '≤ 0.5'], ['3.0', '-'], ['4', '1']]\n\
            [[table.column]]\nname = 'a'\ncomputed = 'a'\nwhy = 'never printed'\n\
            [[table.column]]\nname = 'b'\ncomputed = 'b'\n";
        let paper = read(text, "x").unwrap();
        let methods = |name: &str| match name {
            "a" => Some(Ok(vec![Some(1.04), Some(2.2), None])),
            "b" => Some(Ok(vec![Some(0.1), Some(0.7)])),
            _ => None,
        };
        let found = cells(&paper, &methods);
        let verdicts: Vec<_> = found.iter().map(|e| e.verdict).collect();
        use Verdict::{NotJudged, NotReproduced, Reproduced};
        assert_eq!(
            verdicts,
            [
                Reproduced,
                Reproduced,
                NotReproduced,
                NotReproduced,
                NotReproduced,
                NotJudged,
                NotReproduced,
                NotJudged
            ]
        );
        assert_eq!(found[2].note.as_deref(), Some("never printed"));
        assert_eq!(found[2].correction.as_deref(), Some("2.2"));
        let unknown = &cells(&paper, &|_| None)[0];
        assert_eq!(unknown.note.as_deref(), Some("no method is named `a`"));
    }
}
