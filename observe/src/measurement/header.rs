//! The header row: what each column is.

use super::role::{Layout, Role};
use crate::io::columns::{Header, split};
use crate::io::{Column, Dimension, Fault, Map, Mistakes, Unit};

/// One column of the file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Head {
    pub column: Column,
    /// The header without its unit.
    pub name: String,
    /// The text in the brackets.
    pub(crate) unit_text: Option<String>,
    /// `None` if the name is itself a mistake.
    pub(crate) role: Option<Role>,
    /// The unit of its numbers, if they have one.
    pub unit: Option<Unit>,
}

/// Reads the header row. What is wrong with it goes to `mistakes`.
pub fn read(line: u64, names: &[String], layout: &Layout, mistakes: &mut Mistakes) -> Vec<Head> {
    let header = Header {
        line: Some(line),
        names,
        bare: &|name| split(name).0,
        map: &Map::default(),
        known: &|_| None,
        ours: "",
    };
    let wrong = |fault: Fault, k: usize| fault.at(line, Some(header.column(k)));
    let parts: Vec<Result<(&str, Option<&str>), Fault>> = names.iter().map(|n| parts(n)).collect();
    let named = |k: usize| parts[k].as_ref().ok().map(|(name, _)| (*name).to_owned());
    header.assign(&named, mistakes);
    let mut heads: Vec<Head> = Vec::with_capacity(names.len());
    for (k, parts) in parts.into_iter().enumerate() {
        let mut head = Head {
            column: header.column(k),
            name: String::new(),
            unit_text: None,
            role: None,
            unit: None,
        };
        let read = parts.and_then(|(name, unit)| {
            head.name = name.to_owned();
            head.unit_text = unit.map(str::to_owned);
            let role = Role::of(name, layout)?;
            head.role = Some(role);
            unit_of(role, name, unit, layout)
        });
        match read {
            Ok(unit) => head.unit = unit,
            Err(fault) => mistakes.add(wrong(fault, k)),
        }
        heads.push(head);
    }
    heads
}

/// `name[unit]` into its parts.
fn parts(text: &str) -> Result<(&str, Option<&str>), Fault> {
    let (name, unit) = split(text);
    let expected = "`name` or `name[unit]`";
    if text.is_empty() {
        let help = "name the column or remove it (a trailing comma makes one)";
        return Err(Fault::new("no name", expected, help));
    }
    if name.is_empty() || [name, unit.unwrap_or_default()].concat().contains(['[', ']']) {
        return Err(Fault::new(format!("`{text}`"), expected, "mend the brackets"));
    }
    Ok((name, unit))
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
                let (found, help) = (format!("the unit `{found}`"), format!("write `{name}`"));
                Err(Fault::new(found, "none", help))
            }
            _ => Ok(None),
        };
    };
    // Of a bench the standard deviation has the unit of the row's reading.
    let of_reading = |found: &&str| {
        let unit = Unit::named(found).filter(|_| role == Role::Sigma(None))?;
        matches!(unit.dimension, Dimension::Angle | Dimension::Pixels).then_some(unit)
    };
    if let Some(unit) = found.as_ref().and_then(of_reading) {
        return Ok(Some(unit));
    }
    found.map_or_else(|| Ok(expected.si()), |found| expected.unit(found, Unit::named)).map(Some)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splits_names_and_units() {
        assert_eq!(parts("q1 [ deg ]"), Ok(("q1", Some("deg"))));
        assert_eq!(parts("pose"), Ok(("pose", None)));
        assert_eq!(parts("").unwrap_err().found, "no name");
        for bad in ["q1[", "q1]", "q1[]", "[deg]", "q1[deg]x", "q1[[deg]]", "q1[a][b]"] {
            assert_eq!(&*parts(bad).unwrap_err().help, "mend the brackets", "{bad}");
        }
    }
}
