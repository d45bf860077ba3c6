//! What a kernel may cost.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use crate::Failure;
use crate::figures::Figure;

/// What one kernel may cost at most.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(deny_unknown_fields)]
pub struct Budget {
    /// Instructions of a call.
    pub instructions: u32,
    /// Bytes of stack.
    pub stack: u32,
    /// Bytes of flash, with everything that is called.
    pub flash: u32,
    /// Conditional branches.
    #[serde(default)]
    pub branches: u32,
}

/// Budgets by board and kernel.
pub type Budgets = BTreeMap<String, BTreeMap<String, Budget>>;

/// Reads `budgets.toml`.
pub fn read(path: &Path) -> Result<Budgets, Failure> {
    let place = |e: String| format!("{}: {e}", path.display());
    let text = std::fs::read_to_string(path).map_err(|e| place(e.to_string()))?;
    toml::from_str(&text).map_err(|e| place(e.to_string()))
}

/// Every figure that is above its budget, that has none, and every budget without a figure.
pub fn exceeded(
    board: &str,
    figures: &[Figure],
    budgets: &BTreeMap<String, Budget>,
) -> Vec<String> {
    let mut faults = Vec::new();
    for figure in figures {
        let name = &figure.name;
        let Some(budget) = budgets.get(name) else {
            faults.push(format!("{board}: {name} has no budget"));
            continue;
        };
        let pairs = [
            ("instructions", figure.most, budget.instructions),
            ("bytes of stack", figure.stack, budget.stack),
            ("bytes of flash", figure.flash, budget.flash),
            ("branches", figure.branches, budget.branches),
        ];
        for (what, found, most) in pairs {
            if found > most {
                faults.push(format!("{board}: {name} takes {found} {what}, at most {most} may be"));
            }
        }
    }
    let unknown = budgets.keys().filter(|name| figures.iter().all(|f| &f.name != *name));
    faults.extend(unknown.map(|name| format!("{board}: a budget for {name}, which is no kernel")));
    faults
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(name: &str, most: u32) -> Figure {
        Figure { name: name.to_owned(), fewest: most, most, stack: 8, flash: 16, branches: 0 }
    }

    #[test]
    fn one_instruction_above_is_found() {
        let budget = Budget { instructions: 10, stack: 8, flash: 16, branches: 0 };
        let budgets = BTreeMap::from([("a".to_owned(), budget)]);
        assert_eq!(exceeded("m", &[figure("a", 10)], &budgets), [""; 0]);
        let over = exceeded("m", &[figure("a", 11)], &budgets);
        assert_eq!(over, ["m: a takes 11 instructions, at most 10 may be"]);
        let faults = exceeded("m", &[figure("b", 1)], &budgets);
        assert_eq!(faults, ["m: b has no budget", "m: a budget for a, which is no kernel"]);
    }
}
