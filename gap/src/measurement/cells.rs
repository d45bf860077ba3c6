//! The rows below the header: cells into numbers in SI.

use csv::StringRecord;

use super::Row;
use super::header::Head;
use super::mistake::{Fault, Mistake};
use super::payload::Payloads;
use super::role::{Family, Layout, Role};
use super::table::Record;
use super::unit::{Unit, nearest};

/// A number as the cell has it, before its unit; `expected` is what the message asks for.
pub(crate) fn number(cell: &str, expected: &str) -> Result<f64, Fault> {
    let (found, expected) = (cell.to_owned(), expected.to_owned());
    if cell.is_empty() {
        return Err(Fault::EmptyCell { expected });
    }
    match cell.parse::<f64>() {
        Ok(value) if value.is_nan() => Err(Fault::Nan { found, expected }),
        Ok(value) if value.is_infinite() && cell.contains(['n', 'N']) => {
            Err(Fault::Infinity { found, expected })
        }
        Ok(value) if value.is_infinite() => Err(Fault::TooLarge { found, expected }),
        Ok(value) => Ok(value),
        Err(_) if cell.replacen(',', ".", 1).parse::<f64>().is_ok() => {
            Err(Fault::DecimalComma { found })
        }
        Err(_) => Err(Fault::NotANumber { found, expected }),
    }
}

fn quantity(cell: &str, unit: Option<Unit>) -> Result<f64, Fault> {
    let expected =
        unit.map_or_else(|| "a number".to_owned(), |u| format!("{} in {}", u.dimension, u.name));
    let value = number(cell, &expected)?;
    let si = unit.map_or(value, |u| u.to_si(value));
    let found = cell.to_owned();
    if si.is_finite() { Ok(si) } else { Err(Fault::TooLarge { found, expected }) }
}

/// Reads one row, or its mistakes. Its `group` is filled in later. Of a row that is planned what is
/// measured may be empty.
pub(crate) fn row(
    record: &Record,
    heads: &[Head],
    layout: &Layout,
    planned: bool,
) -> Result<Row, Vec<Mistake>> {
    let (line, cells) = (record.line, &record.cells);
    let whole = |fault| Err(vec![Mistake { line, column: None, fault }]);
    if cells.len() != heads.len() {
        return whole(Fault::Ragged { found: cells.len(), expected: heads.len() });
    }
    if cells.iter().all(str::is_empty) {
        return whole(Fault::EmptyRow);
    }
    let mut row = Row::new(line, vec![0.0; layout.motions.len()]);
    let mut mistakes = Vec::new();
    let open = |head: &Head, cell: &str| {
        planned && cell.is_empty() && matches!(head.role, Some(Role::Measured(..) | Role::Sim(..)))
    };
    for (head, cell) in heads.iter().zip(cells).filter(|(head, cell)| !open(head, cell)) {
        if let Err(fault) = fill(&mut row, head, cell, layout) {
            mistakes.push(Mistake { line, column: Some(head.column.clone()), fault });
        }
    }
    if !mistakes.is_empty() {
        return Err(mistakes);
    }
    // Where it hangs takes the readings, which may stand behind it.
    layout.payloads.iter().for_each(|payloads| payloads.hang(&mut row));
    Ok(row)
}

fn fill(row: &mut Row, head: &Head, cell: &str, layout: &Layout) -> Result<(), Fault> {
    let value = || quantity(cell, head.unit);
    match head.role {
        None | Some(Role::Extra) => {}
        Some(Role::Reading(joint)) => row.q[joint] = value()?,
        Some(Role::Wrench(k)) => row.wrench[k] = value()?,
        Some(Role::Temperature) => row.temperature = Some(value()?),
        Some(Role::Time) => row.time = Some(value()?),
        Some(Role::Direction(joint)) => {
            let joints = row.q.len();
            row.direction.get_or_insert_with(|| vec![0; joints])[joint] = direction(cell)?;
        }
        Some(Role::Pose) => row.pose = Some(name(cell, "the id of a pose")?),
        Some(Role::Marker) => {
            let found = name(cell, "the name of a marker")?;
            let names: Vec<&str> = layout.markers.iter().map(|m| m.name.as_str()).collect();
            let Some(marker) = layout.markers.iter().find(|m| m.name == found) else {
                let (known, suggestion) = known(&found, &names);
                return Err(Fault::UnknownMarker { found, known, suggestion });
            };
            row.offset = marker.translation;
            row.marker = Some(found);
        }
        Some(Role::Session) => row.session = Some(name(cell, "the name of a session")?),
        Some(Role::Payload) => {
            let found = name(cell, "the name of a payload, or `none`")?;
            row.payload = Some(Box::new(Payloads::named(layout.payloads.as_ref(), &found)?));
        }
        Some(Role::From) => row.from_point = Some(name(cell, "the name of a point")?),
        Some(Role::FromAt(k)) => row.from.get_or_insert([0.0; 3])[k] = value()?,
        Some(Role::Measured(Family::Distance, _)) => {
            row.measured[0] = value()?;
            if row.measured[0] < 0.0 {
                return Err(Fault::Negative { found: cell.to_owned() });
            }
        }
        Some(Role::Measured(_, k)) => row.measured[k] = value()?,
        Some(Role::Sigma(of)) => {
            let sd = value().and_then(|sd| match sd > 0.0 {
                true => Ok(sd),
                false => Err(Fault::Sigma { found: cell.to_owned() }),
            })?;
            let all = row.sigma.get_or_insert_default();
            match of {
                Some((_, k)) => all[k] = sd,
                // A component's own column says more, whichever comes first.
                None => all.fixed_rows_mut::<3>(0).iter_mut().for_each(|s| {
                    if *s == 0.0 {
                        *s = sd;
                    }
                }),
            }
        }
        Some(Role::Sim(_, k)) => row.sim.get_or_insert_default()[k] = value()?,
    }
    Ok(())
}

/// The names that there are, as a message lists them, and the one that may have been meant.
pub(crate) fn known(found: &str, names: &[&str]) -> (Vec<String>, Option<String>) {
    let suggestion = nearest(found, names.iter().copied()).map(str::to_owned);
    (names.iter().map(|n| format!("`{n}`")).collect(), suggestion)
}

fn direction(cell: &str) -> Result<i8, Fault> {
    match number(cell, "-1, 0 or 1")? {
        -1.0 => Ok(-1),
        0.0 => Ok(0),
        1.0 => Ok(1),
        _ => Err(Fault::Direction { found: cell.to_owned() }),
    }
}

fn name(cell: &str, expected: &str) -> Result<String, Fault> {
    if cell.is_empty() {
        return Err(Fault::EmptyCell { expected: expected.to_owned() });
    }
    Ok(cell.to_owned())
}

/// The first cell of a row that can be no header: every cell is empty or a number, one at least a
/// number.
pub(crate) fn only_numbers(cells: &StringRecord) -> Option<String> {
    let numeric = |c: &str| c.parse::<f64>().is_ok();
    let all = cells.iter().all(|c| c.is_empty() || numeric(c));
    cells.iter().find(|c| numeric(c)).filter(|_| all).map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_plain_and_finite() {
        for (cell, value) in [("1.5", 1.5), ("-2e-3", -2e-3), ("+7", 7.0), (".5", 0.5)] {
            assert_eq!(number(cell, "a"), Ok(value));
        }
        let fault = |cell| number(cell, "a").unwrap_err();
        assert!(matches!(fault(""), Fault::EmptyCell { .. }));
        for nan in ["NaN", "nan", "-NAN"] {
            assert!(matches!(fault(nan), Fault::Nan { .. }), "{nan}");
        }
        for infinity in ["inf", "-Infinity", "INF"] {
            assert!(matches!(fault(infinity), Fault::Infinity { .. }), "{infinity}");
        }
        assert!(matches!(fault("1e999"), Fault::TooLarge { .. }));
        assert!(matches!(fault("1,5"), Fault::DecimalComma { .. }));
        for text in ["abc", "1.5mm", "0x10", "1 2", "1,2,3", "--1", "e"] {
            assert!(matches!(fault(text), Fault::NotANumber { .. }), "{text}");
        }
    }

    #[test]
    fn a_unit_can_make_a_number_too_large() {
        let kilo = Unit::named("kN");
        assert!(matches!(quantity("1e307", kilo), Err(Fault::TooLarge { .. })));
        assert_eq!(quantity("2", kilo), Ok(2000.0));
    }

    #[test]
    fn directions_are_signs() {
        for (cell, sign) in [("-1", -1), ("0", 0), ("+1", 1), ("1.0", 1)] {
            assert_eq!(direction(cell), Ok(sign));
        }
        assert_eq!(direction("2"), Err(Fault::Direction { found: "2".to_owned() }));
    }
}
