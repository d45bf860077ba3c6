//! A joint vector at which two formulas differ.

use std::collections::{BTreeSet, HashMap};

use crate::exact::arithmetic::{Arithmetic, Real};
use crate::exact::truth::{Form, Truth};
use crate::latex::tree::Tree;
use crate::verdict::Witness;

/// Degrees for angles, in the order of their names.
const DEGREES: [f64; 9] = [20.0, 35.0, -50.0, 65.0, 40.0, -25.0, 15.0, 70.0, -10.0];

/// Values for all names in printed and derived, and what both come to there. `given` are values of
/// the data file; angles in radians.
pub fn witness(
    printed: &Tree,
    derived: Form<'_>,
    truth: &Truth,
    given: &HashMap<String, f64>,
) -> Option<Witness> {
    let (mut angles, mut symbols) = (BTreeSet::new(), BTreeSet::new());
    printed.each_name(&mut |name, angle| {
        if angle { &mut angles } else { &mut symbols }.insert(name.to_owned());
    });
    derived.names(&mut angles, &mut symbols);
    let used: Vec<String> = symbols.iter().cloned().collect();
    for name in used {
        if let Some(value) = truth.names.get(&name) {
            symbols.remove(&name);
            truth.form(*value).names(&mut angles, &mut symbols);
        }
    }
    for shift in 0..DEGREES.len() {
        let degrees = |k: usize| DEGREES[(k + shift) % DEGREES.len()];
        let mut values: HashMap<String, f64> = HashMap::new();
        for (k, name) in angles.iter().enumerate() {
            values
                .insert(name.clone(), given.get(name).copied().unwrap_or(degrees(k).to_radians()));
        }
        for (k, name) in symbols.iter().filter(|s| !angles.contains(*s)).enumerate() {
            let value = 1.0 + 0.25 * (k + shift) as f64;
            values.insert(name.clone(), given.get(name).copied().unwrap_or(value));
        }
        let value = |name: &str| values.get(name).copied();
        let resolved = Real(|name: &str| match truth.names.get(name) {
            Some(form) if value(name).is_none() => truth.form(*form).real(value).ok(),
            _ => value(name),
        });
        let (Ok(p), Ok(d)) = (resolved.tree(printed), derived.real(value)) else {
            continue;
        };
        if (p - d).abs() > 1e-6 * p.abs().max(d.abs()) {
            let plain: Vec<_> = symbols.iter().filter(|s| !angles.contains(*s)).collect();
            return Some(Witness {
                angles: angles.iter().map(|n| (n.clone(), values[n].to_degrees())).collect(),
                symbols: plain.into_iter().map(|n| (n.clone(), values[n])).collect(),
                printed: p,
                derived: d,
            });
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latex::notation::Notation;
    use crate::latex::parser::parse;

    #[test]
    fn a_witness_tells_two_formulas_apart() {
        let read = |text: &str| parse(text, &Notation::default()).unwrap();
        let truth = &Truth::written("a \\cos\\theta_1", &Notation::default());
        let derived = truth.form(truth.entries[0]);
        let given = HashMap::from([("a".to_owned(), 2.0)]);
        let found = witness(&read("a \\sin\\theta_1"), derived, truth, &given).unwrap();
        assert_eq!(found.angles.len(), 1);
        assert_eq!(found.symbols, [("a".to_owned(), 2.0)]);
        assert!((found.derived - 2.0 * 20f64.to_radians().cos()).abs() < 1e-12);
        let same = witness(&read("a \\cos\\theta_1"), derived, truth, &given);
        assert_eq!(same, None);
    }
}
