//! The header row: what each column is, and whether the columns together make a measurement.

use std::collections::HashMap;

use super::Kind;
use super::mistake::{Column, Fault, Mistakes};
use super::role::{FROM_NAMES, Family, Layout, POSE_NAMES, Role, SIGMA_PREFIX, nearest_name};
use super::table::Record;
use super::unit::{Unit, nearest_unit};

/// One column of the file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Head {
    pub(crate) column: Column,
    /// The header without its unit.
    pub(crate) name: String,
    /// The text in the brackets.
    pub(crate) unit_text: Option<String>,
    /// `None` if the name is itself a mistake.
    pub(crate) role: Option<Role>,
    /// The unit of its numbers, if they have one.
    pub(crate) unit: Option<Unit>,
}

/// Reads the header row. What is wrong with it goes to `mistakes`.
pub(crate) fn read(record: &Record, layout: &Layout, mistakes: &mut Mistakes) -> Vec<Head> {
    let mut heads: Vec<Head> = Vec::with_capacity(record.cells.len());
    let mut numbers: HashMap<String, usize> = HashMap::with_capacity(record.cells.len());
    for (index, text) in record.cells.iter().enumerate() {
        let column = Column { number: index + 1, header: text.to_owned() };
        let mut wrong = |fault| mistakes.add(record.line, Some(column.clone()), fault);
        let (name, unit_text) = match split(text) {
            Ok(parts) => parts,
            Err(fault) => {
                wrong(fault);
                (String::new(), None)
            }
        };
        let mut role = None;
        let mut unit = None;
        if !name.is_empty() {
            let first = *numbers.entry(name.clone()).or_insert(index + 1);
            if first <= index {
                wrong(Fault::Repeated { name: name.clone(), first });
            } else {
                match Role::of(&name, layout) {
                    Ok(known) => role = Some(known),
                    Err(fault) => wrong(fault),
                }
            }
        }
        if let Some(known) = role {
            match unit_of(known, &name, unit_text.as_deref(), layout) {
                Ok(of) => unit = of,
                Err(fault) => wrong(fault),
            }
        }
        heads.push(Head { column, name, unit_text, role, unit });
    }
    heads
}

/// `name[unit]` into its parts.
fn split(text: &str) -> Result<(String, Option<String>), Fault> {
    let brackets = || Fault::Brackets { found: text.to_owned() };
    let (name, unit) = match text.split_once('[') {
        None if text.contains(']') => return Err(brackets()),
        None => (text, None),
        Some((name, rest)) => {
            let unit = rest.strip_suffix(']').ok_or_else(brackets)?.trim();
            if unit.is_empty() || unit.contains(['[', ']']) {
                return Err(brackets());
            }
            (name.trim(), Some(unit.to_owned()))
        }
    };
    if name.is_empty() {
        return Err(if unit.is_some() { brackets() } else { Fault::NoName });
    }
    Ok((name.to_owned(), unit))
}

fn unit_of(
    role: Role,
    name: &str,
    found: Option<&str>,
    layout: &Layout,
) -> Result<Option<Unit>, Fault> {
    let Some(expected) = role.dimension(layout) else {
        return match found {
            Some(found) if role != Role::Extra => {
                Err(Fault::UnitOnPlain { name: name.to_owned(), found: found.to_owned() })
            }
            _ => Ok(None),
        };
    };
    let Some(found) = found else { return Ok(Some(expected.si())) };
    match Unit::named(found) {
        Some(unit) if unit.dimension == expected => Ok(Some(unit)),
        Some(unit) => {
            Err(Fault::WrongUnit { found: found.to_owned(), is: unit.dimension, expected })
        }
        None => {
            let suggestion = nearest_unit(found)
                .filter(|s| Unit::named(s).is_some_and(|u| u.dimension == expected));
            Err(Fault::UnknownUnit { found: found.to_owned(), expected, suggestion })
        }
    }
}

/// To which kind of columns that belongs which is measured.
pub(crate) fn family(kind: Kind) -> Family {
    match kind {
        Kind::Pose { .. } | Kind::Coordinates { .. } => Family::Pose,
        Kind::Displacement { .. } => Family::Displacement,
        Kind::Distance => Family::Distance,
    }
}

/// Which components are measured and which are simulated by the user. What is missing or does not
/// fit goes to `mistakes`; `None` if nothing is measured.
pub(crate) fn kind(
    heads: &[Head],
    line: u64,
    layout: &Layout,
    mistakes: &mut Mistakes,
) -> Option<(Kind, [bool; 6])> {
    missing_joints(heads, line, layout, mistakes);
    let find = |role| heads.iter().find(|h| h.role == Some(role));
    let measured = |family| (0..6).map(move |k| find(Role::Measured(family, k)));
    let first = |family| measured(family).flatten().min_by_key(|h| h.column.number);
    let mut wrong = |head: &Head, fault| mistakes.add(line, Some(head.column.clone()), fault);
    let mut of_each = Family::ALL.into_iter().filter_map(|f| first(f).map(|head| (f, head)));
    let Some((family, of_it)) = of_each.next() else {
        mistakes.add(line, None, Fault::NothingMeasured);
        return None;
    };
    if let Some((other, head)) = of_each.next() {
        let fault = Fault::TwoKinds {
            found: of_it.name.clone(),
            is: family.words(),
            other: head.name.clone(),
            other_is: other.words(),
        };
        wrong(head, fault);
        return None;
    }
    let has: Vec<_> = measured(family).collect();
    let components: [bool; 6] = core::array::from_fn(|k| has[k].is_some());
    let kind = match family {
        Family::Displacement => Kind::Displacement { components },
        Family::Distance => Kind::Distance,
        Family::Pose if components[3..] == [false; 3] && components[..3] != [true; 3] => {
            let [x, y, z, ..] = components;
            Kind::Coordinates { components: [x, y, z] }
        }
        Family::Pose => {
            let missing = absent(&has[..3], &POSE_NAMES);
            if !missing.is_empty() {
                wrong(of_it, Fault::PositionIncomplete { found: of_it.name.clone(), missing });
            }
            if let Some((head, missing)) = partial(&has[3..], &POSE_NAMES[3..]) {
                wrong(head, incomplete(head, missing, "rx, ry, rz"));
            }
            Kind::Pose { orientation: components[3..] == [true; 3] }
        }
    };
    let others = Family::ALL.into_iter().filter(|other| *other != family);
    for (other, k) in others.flat_map(|other| (0..6).map(move |k| (other, k))) {
        if let Some(head) = find(Role::Sim(other, k)) {
            let expected = of_it.name.clone();
            let fault = Fault::SimOfOtherKind {
                found: head.name.clone(),
                is: other.words(),
                measures: family.words(),
                expected: format!("sim_{expected}"),
            };
            wrong(head, fault);
        }
    }
    let sim: Vec<_> = (0..6).map(|k| find(Role::Sim(family, k))).collect();
    if let (Kind::Pose { .. }, Some((head, missing))) =
        (&kind, partial(&sim[3..], &POSE_NAMES[3..]))
    {
        wrong(head, incomplete(head, format!("sim_{missing}"), "sim_rx, sim_ry, sim_rz"));
    }
    let at: Vec<_> = (0..3).map(|k| find(Role::FromAt(k))).collect();
    let from = at.iter().flatten().copied().chain(find(Role::From)).next();
    if let Some(head) = from.filter(|_| family != Family::Distance) {
        wrong(head, Fault::FromWithout { found: head.name.clone() });
    }
    if let Some((head, missing)) = partial(&at, &FROM_NAMES) {
        wrong(head, Fault::FromIncomplete { found: head.name.clone(), missing });
    }
    if let (Some(named), Some(head)) = (find(Role::From), at.iter().flatten().next()) {
        wrong(named, Fault::FromTwice { found: head.name.clone() });
    }
    let mut given = [false; 6];
    for (flag, head) in given.iter_mut().zip(sim) {
        *flag = head.is_some();
    }
    if let Some((head, missing)) = sigma(heads, family, kind) {
        let found = head.name.clone();
        mistakes.add(line, Some(head.column.clone()), Fault::SigmaIncomplete { found, missing });
    }
    Some((kind, given))
}

/// A column of a standard deviation, and those that are missing beside it.
fn sigma(heads: &[Head], family: Family, kind: Kind) -> Option<(&Head, String)> {
    let measured = kind.components();
    let find = |role| heads.iter().find(|h| h.role == Some(role));
    let own = |k| find(Role::Sigma(Some((family, k))));
    let of = |k: usize| own(k).or_else(|| find(Role::Sigma(None)).filter(|_| k < 3));
    let names = |missing: Vec<usize>| {
        let each = missing.iter().map(|k| format!("{SIGMA_PREFIX}{}", family.names()[*k]));
        each.collect::<Vec<_>>().join(", ")
    };
    let other =
        heads.iter().find(|h| matches!(h.role, Some(Role::Sigma(Some((f, _)))) if f != family));
    if let Some(other) = other {
        return Some((other, names((0..6).filter(|&k| measured[k]).collect())));
    }
    [0..3, 3..6].into_iter().find_map(|range| {
        let (has, lacks): (Vec<usize>, Vec<usize>) =
            range.filter(|&k| measured[k]).partition(|&k| of(k).is_some());
        let first = has.first().and_then(|k| of(*k))?;
        (!lacks.is_empty()).then(|| (first, names(lacks)))
    })
}

fn missing_joints(heads: &[Head], line: u64, layout: &Layout, mistakes: &mut Mistakes) {
    let needed = if layout.readings { layout.motions.len() } else { 0 };
    let is_missing = |joint: &usize| !heads.iter().any(|h| h.role == Some(Role::Reading(*joint)));
    let missing: Vec<usize> = (0..needed).filter(is_missing).collect();
    if missing.is_empty() {
        return;
    }
    let extra = heads.iter().filter(|h| h.role == Some(Role::Extra));
    let near: Vec<_> = extra.filter_map(|h| Some((nearest_name(&h.name, layout)?, h))).collect();
    for joint in missing {
        let missing = format!("q{}", joint + 1);
        let meant = near.iter().find(|(near, _)| *near == missing);
        let suggestion = meant.map(|(_, head)| head.name.clone());
        mistakes.add(line, None, Fault::MissingJoint { missing, suggestion });
    }
}

fn absent(has: &[Option<&Head>], names: &[&'static str]) -> String {
    let lacking = names.iter().zip(has).filter(|(_, h)| h.is_none());
    lacking.map(|(name, _)| *name).collect::<Vec<_>>().join(", ")
}

/// Some of them but not all: the first present, and the names of the absent.
fn partial<'a>(has: &[Option<&'a Head>], names: &[&'static str]) -> Option<(&'a Head, String)> {
    let missing = absent(has, names);
    let head = has.iter().copied().flatten().next()?;
    (!missing.is_empty()).then_some((head, missing))
}

fn incomplete(head: &Head, missing: String, all: &'static str) -> Fault {
    Fault::OrientationIncomplete { found: head.name.clone(), missing, all }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splits_names_and_units() {
        let parts = |t| split(t).map(|(n, u)| (n, u.unwrap_or_default()));
        assert_eq!(parts("q1[deg]"), Ok(("q1".to_owned(), "deg".to_owned())));
        assert_eq!(parts("q1 [ deg ]"), Ok(("q1".to_owned(), "deg".to_owned())));
        assert_eq!(parts("pose"), Ok(("pose".to_owned(), String::new())));
        assert_eq!(parts(""), Err(Fault::NoName));
        for bad in ["q1[", "q1]", "q1[]", "[deg]", "q1[deg]x", "q1[[deg]]", "q1[a][b]"] {
            assert_eq!(parts(bad), Err(Fault::Brackets { found: bad.to_owned() }), "{bad}");
        }
    }
}
