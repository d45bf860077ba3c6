//! The rows below the header: cells into numbers in SI.

use super::header::Head;
use super::payload::Payloads;
use super::role::{Family, Layout, Role};
use super::told::Told;
use super::{Kind, Row};
use crate::io::cell::{empty, number, too_large};
use crate::io::{Convention, Fault, Mistake, Unit, did_you_mean, nearest};

const READ: Role = Role::Measured(Family::Distance, 0);

fn quantity(cell: &str, unit: Option<Unit>) -> Result<f64, Fault> {
    let expected =
        || unit.map_or_else(|| "a number".to_owned(), |u| format!("{} in {}", u.dimension, u.name));
    let value = number(cell, expected)?;
    let si = unit.map_or(value, |u| u.to_si(value));
    if si.is_finite() { Ok(si) } else { Err(too_large(cell, &expected())) }
}

/// Reads one row, or its mistakes. Its `group` is filled in later. Of a row that is planned what is
/// measured may be empty.
pub(crate) fn row(
    line: u64,
    cells: &[&str],
    heads: &[Head],
    layout: &Layout,
    (planned, orientation, kind): (bool, Convention, Option<Kind>),
) -> Result<Row, Vec<Mistake>> {
    let whole = |fault: Fault| Err(vec![fault.at(line, None)]);
    if cells.len() != heads.len() {
        return whole(Fault::ragged(cells.len(), heads.len()));
    }
    if cells.iter().all(|cell| cell.is_empty()) {
        return whole(Fault::hole("an empty row of commas", "a measurement", "remove the row"));
    }
    let mut row = Row::new(line, vec![0.0; layout.motions.len()]);
    let (mut told, mut mistakes) = (Told::default(), Vec::new());
    // Of a bench each row has cells of its own kind.
    let mixed = matches!(kind, Some(Kind::Bench { .. }));
    let open = |head: &Head, cell: &str| {
        let Some(role) = head.role.filter(|_| cell.is_empty()) else { return false };
        let is_measured = matches!(
            role,
            Role::Measured(..) | Role::Sim(..) | Role::Along | Role::Tilt(_) | Role::Pixel(_)
        );
        let is_other = Told::takes(role)
            || matches!(role, Role::Sigma(None) | Role::Camera | Role::Board | Role::Marker);
        planned && is_measured || mixed && is_other
    };
    for (head, cell) in heads.iter().zip(cells).filter(|(head, cell)| !open(head, cell)) {
        if let Err(fault) = fill(&mut row, &mut told, head, cell, layout) {
            mistakes.push(fault.at(line, Some(head.column.clone())));
        }
    }
    let distance = heads.iter().zip(cells).find(|(head, _)| head.role == Some(READ));
    if let (Some(_), Some((head, cell))) = (told.negative(), distance) {
        let fault = Fault::new(*cell, "a distance", "it is not below zero");
        mistakes.push(fault.at(line, Some(head.column.clone())));
    } else if let Err(fault) = told.into_row(kind, planned, &mut row) {
        mistakes.push(fault.at(line, None));
    }
    if !mistakes.is_empty() {
        return Err(mistakes);
    }
    if orientation != Convention::RotationVector {
        let simulated = row.sim.as_deref_mut();
        for six in [&mut row.measured].into_iter().chain(simulated) {
            let turns = orientation.ordered([six[3], six[4], six[5]]);
            // Three turns are always a rotation.
            let vector = orientation.rotation(&turns).unwrap_or_default();
            six.fixed_rows_mut::<3>(3).copy_from(&vector);
        }
    }
    // Where it hangs takes the readings, which may stand behind it.
    layout.payloads.iter().for_each(|payloads| payloads.hang(&mut row));
    Ok(row)
}

fn fill(
    row: &mut Row,
    told: &mut Told,
    head: &Head,
    cell: &str,
    layout: &Layout,
) -> Result<(), Fault> {
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
            match layout.markers.iter().find(|m| m.name == found) {
                Some(marker) => row.offset = marker.translation,
                // Which board's it is, and where, is known when the row is.
                None if layout.bench.has_corner(&found) => {}
                None => return Err(unknown("marker", &found, &names, "name one of them")),
            }
            row.marker = Some(found);
        }
        Some(Role::Session) => row.session = Some(name(cell, "the name of a session")?),
        Some(Role::Payload) => {
            let found = name(cell, "the name of a payload, or `none`")?;
            row.payload = Some(Box::new(Payloads::named(layout.payloads.as_ref(), &found)?));
        }
        Some(Role::From) => told.from = Some(name(cell, "the name of a point")?),
        Some(Role::FromAt(k)) => told.from_at[k] = Some(value()?),
        Some(Role::Measured(Family::Distance, _)) => told.distance = Some(value()?),
        Some(Role::BoardPose(k)) => row.measured[k] = value()?,
        Some(Role::BoardTurn(k)) => told.turn[k] = Some(value()?),
        Some(Role::Camera) => told.camera = Some(name(cell, "the name of a camera")?),
        Some(Role::Board) => told.board = Some(name(cell, "the name of a board")?),
        Some(Role::Point) => told.point = Some(name(cell, "the name of a point")?),
        Some(Role::Plane) => told.plane = Some(name(cell, "the name of a plane")?),
        Some(Role::Along) => told.along = Some(value()?),
        Some(Role::Zero) => told.zero = Some(name(cell, "the name of a zero")?),
        Some(Role::Tilt(k)) => told.tilt[k] = Some(value()?),
        Some(Role::Pixel(k)) => told.pixel[k] = Some(value()?),
        Some(Role::Normal(k)) => told.normal[k] = Some(value()?),
        Some(Role::Measured(_, k)) => row.measured[k] = value()?,
        Some(Role::Sigma(of)) => {
            let sd = value().and_then(|sd| match sd > 0.0 {
                true => Ok(sd),
                false => Err(Fault::new(
                    format!("`{cell}`"),
                    "a number above 0",
                    "the instrument's standard deviation of the reading",
                )),
            })?;
            told.sigma_is =
                head.unit.filter(|_| head.unit_text.is_some()).map(|unit| unit.dimension);
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

/// A name that the robot file's tables of this kind do not have; `names` are those that they have.
pub(crate) fn unknown(table: &str, found: &str, names: &[&str], help: &str) -> Fault {
    let listed: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    let known = match listed.is_empty() {
        true => format!("no [[{table}]]"),
        false => listed.join(", "),
    };
    let near = did_you_mean(nearest(found, names.iter().copied()));
    let found = format!("the unknown {table} `{found}`, the robot file has {known}{near}");
    Fault::new(found, "", format!("{help} or add it to the robot file"))
}

fn direction(cell: &str) -> Result<i8, Fault> {
    let expected = "-1, 0 or 1";
    match number(cell, || expected.to_owned())? {
        -1.0 => Ok(-1),
        0.0 => Ok(0),
        1.0 => Ok(1),
        _ => {
            let help = "the direction from which the joint came to rest";
            Err(Fault::new(format!("`{cell}`"), expected, help))
        }
    }
}

fn name(cell: &str, expected: &str) -> Result<String, Fault> {
    if cell.is_empty() { Err(empty(expected)) } else { Ok(cell.to_owned()) }
}

/// The first cell of a row that can be no header: every cell is empty or a number, one at least a
/// number.
pub(crate) fn only_numbers(cells: &[&str]) -> Option<String> {
    let numeric = |c: &str| c.parse::<f64>().is_ok();
    let all = cells.iter().all(|c| c.is_empty() || numeric(c));
    cells.iter().find(|c| numeric(c)).filter(|_| all).map(|c| (*c).to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_can_make_a_number_too_large() {
        let kilo = Unit::named("kN");
        assert_eq!(quantity("1e307", kilo), Err(too_large("1e307", "a force in kN")));
        assert_eq!(quantity("2", kilo), Ok(2000.0));
    }

    #[test]
    fn directions_are_signs() {
        for (cell, sign) in [("-1", -1), ("0", 0), ("+1", 1), ("1.0", 1)] {
            assert_eq!(direction(cell), Ok(sign));
        }
        assert_eq!(direction("2").unwrap_err().found, "`2`");
    }
}
