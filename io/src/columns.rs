//! Which column of a file is which of ours: what a map says, else what the header's name means.

use std::collections::{HashMap, HashSet};

use super::map::{Map, Theirs};
use super::mistake::{Column, Fault, Mistakes};
use super::nearest::{did_you_mean, nearest};

/// `name[unit]` into its parts.
pub fn split(header: &str) -> (&str, Option<&str>) {
    let parts = header.strip_suffix(']').and_then(|text| text.rsplit_once('['));
    match parts {
        Some((name, unit)) if !unit.trim().is_empty() => (name.trim(), Some(unit.trim())),
        _ => (header, None),
    }
}

/// A column that is one of ours: our name of it, the same for all that mean the same, and what the map says of it.
pub type Found = (String, Theirs);

/// The header of a table, and what its names may mean.
pub struct Header<'h> {
    /// Its line; `None` of a file without lines.
    pub line: Option<u64>,
    /// As the file has them.
    pub names: &'h [String],
    /// A name of theirs without its unit.
    pub bare: &'h dyn Fn(&str) -> &str,
    /// What is said of the columns.
    pub map: &'h Map,
    /// What a name of ours in a map stands for: the same name for all that mean the same.
    pub known: &'h dyn Fn(&str) -> Option<String>,
    /// All names of ours, for a message.
    pub ours: &'h str,
}

impl Header<'_> {
    /// One of them for a message.
    pub fn column(&self, index: usize) -> Column {
        Column { number: index + 1, header: self.names[index].clone() }
    }

    /// Of each column what it is among ours, by the map or as `meaning` has it. What the map gives to a
    /// column is not what another one means.
    pub fn assign(
        &self,
        meaning: &dyn Fn(usize) -> Option<String>,
        mistakes: &mut Mistakes,
    ) -> Vec<Option<Found>> {
        let mut assigned: Vec<Option<Found>> = vec![None; self.names.len()];
        let mut given: HashSet<String> = HashSet::new();
        for (ours, theirs) in &self.map.columns {
            match self.said(ours, theirs, &assigned) {
                Ok((ours, index)) => {
                    given.insert(ours.clone());
                    assigned[index] = Some((ours, theirs.clone()));
                }
                Err(fault) => mistakes.add(fault.within(self.line, None)),
            }
        }
        for name in &self.map.ignore {
            let found = self.find(name, "one that is not kept").and_then(|index| {
                let Some((ours, _)) = &assigned[index] else { return Ok(()) };
                let found = format!("the column `{name}` to be ignored and as {ours}");
                Err(Fault::new(format!("{found} in {}", self.map.file), "one of them", ""))
            });
            mistakes.extend(found.err().map(|fault| fault.within(self.line, None)));
        }
        let open = assigned.iter_mut().enumerate().filter(|(_, slot)| slot.is_none());
        for (index, slot) in open.filter(|(index, _)| !self.ignores(*index)) {
            let meant = meaning(index).filter(|ours| !given.contains(ours));
            *slot = meant.map(|ours| (ours, Theirs::from(self.names[index].clone())));
        }
        let mut first: HashMap<&str, usize> = HashMap::with_capacity(assigned.len());
        let found = assigned.iter().enumerate().filter_map(|(k, slot)| Some((k, slot.as_ref()?)));
        for (index, (ours, _)) in found {
            let before = *first.entry(ours).or_insert(index);
            if before < index {
                let (number, one) = (before + 1, &self.names[before]);
                let same = (self.bare)(one) == (self.bare)(&self.names[index]);
                let also = if same { String::new() } else { format!(", as `{one}`") };
                let fault = Fault::new(
                    format!("`{ours}` again"),
                    "it once",
                    format!(
                        "`{ours}` stands in column {number} already{also}: remove or rename one of \
                         the two"
                    ),
                );
                mistakes.add(fault.within(self.line, Some(self.column(index))));
            }
        }
        assigned
    }

    /// The name of ours in an entry of the map, and the column that it speaks of.
    fn said(
        &self,
        ours: &str,
        theirs: &Theirs,
        assigned: &[Option<Found>],
    ) -> Result<(String, usize), Fault> {
        let map = &self.map.file;
        let Some(known) = (self.known)(ours) else {
            let found = format!("`{ours}` among the columns of {map}");
            return Err(Fault::new(found, format!("a name of ours: {}", self.ours), ""));
        };
        let index = self.find(&theirs.column, &format!("the one that is {ours}"))?;
        match &assigned[index] {
            Some((before, _)) => {
                let found =
                    format!("the column `{}` as both {before} and {ours} in {map}", theirs.column);
                Err(Fault::new(found, "it to be one of them", ""))
            }
            None => Ok((known, index)),
        }
    }

    /// The column that the map calls so, with or without its unit.
    fn find(&self, theirs: &str, which: &str) -> Result<usize, Fault> {
        let whole = self.names.iter().position(|name| name == theirs);
        let bare = || self.names.iter().position(|name| (self.bare)(name) == theirs);
        whole.or_else(bare).ok_or_else(|| {
            let near = nearest(theirs, self.names.iter().map(String::as_str));
            let found = format!("no column `{theirs}`{}", did_you_mean(near));
            Fault::new(found, format!("{which} by {}", self.map.file), "")
        })
    }

    /// Whether the map says that a column is not kept.
    pub fn ignores(&self, index: usize) -> bool {
        let name = &self.names[index];
        self.map.ignore.iter().any(|ignored| ignored == name || ignored == (self.bare)(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assigned(map: &str, names: &[&str]) -> Result<Vec<Option<String>>, String> {
        let map = Map::read("m.toml", map).map_err(|error| error.to_string())?;
        let names: Vec<String> = names.iter().map(|&name| name.to_owned()).collect();
        let known = |name: &str| ["q1", "q2", "x"].contains(&name).then(|| name.to_owned());
        let header = Header {
            line: Some(3),
            names: &names,
            bare: &|name| split(name).0,
            map: &map,
            known: &known,
            ours: "q1, q2, x",
        };
        let mut mistakes = Mistakes::default();
        let meaning = |k: usize| known(split(&names[k]).0);
        let found = header.assign(&meaning, &mut mistakes);
        mistakes.check("f").map_err(|error| error.to_string())?;
        Ok(found.into_iter().map(|slot| slot.map(|(ours, _)| ours)).collect())
    }

    #[test]
    fn headers_are_split() {
        assert_eq!(split("tau1[N*m]"), ("tau1", Some("N*m")));
        assert_eq!(split("q1 [ deg ]"), ("q1", Some("deg")));
        assert_eq!(split("position[0]"), ("position", Some("0")));
        assert_eq!((split("run"), split("q[]")), (("run", None), ("q[]", None)));
    }

    #[test]
    fn a_map_comes_first_and_mistakes_are_told() {
        let some = |names: &[&str]| -> Vec<Option<String>> {
            names.iter().map(|n| (!n.is_empty()).then(|| (*n).to_owned())).collect()
        };
        let map = "[columns]\nq1 = \"A\"\n";
        assert_eq!(assigned(map, &["A[deg]", "q1", "q2", "n"]), Ok(some(&["q1", "", "q2", ""])));
        assert_eq!(assigned("ignore = [\"q2\"]\n", &["q1", "q2[deg]"]), Ok(some(&["q1", ""])));
        for (map, names, told) in [
            (
                "",
                &["q1", "q1[deg]"][..],
                "line 3, column 2 `q1[deg]`: found `q1` again, expected it once",
            ),
            (map, &["q2"], "f: line 3: found no column `A`, expected the one that is q1 by m.toml"),
            ("[columns]\nx = \"Q2\"\n", &["q2"], "found no column `Q2`; did you mean `q2`?"),
            (
                "[columns]\nv = \"q2\"\n",
                &["q2"],
                "found `v` among the columns of m.toml, expected a name of",
            ),
            (
                "[columns]\nq1 = \"A\"\nx = \"A[mm]\"\n",
                &["A[mm]"],
                "found the column `A[mm]` as both q1 and x in m.toml, expected it to be one of them",
            ),
            ("[columns]\nspeed\n", &[], "m.toml: line 2: found no map: "),
            (
                "ignore = [\"Q2\"]\n",
                &["q2"],
                "found no column `Q2`; did you mean `q2`?, expected one",
            ),
            (
                "ignore = [\"A\"]\n[columns]\nq1 = \"A\"\n",
                &["A"],
                "found the column `A` to be ignored and as q1 in m.toml, expected one of them",
            ),
        ] {
            let error = assigned(map, names).unwrap_err();
            assert!(error.contains(told), "{error}");
        }
    }
}
