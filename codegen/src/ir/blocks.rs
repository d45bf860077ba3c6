//! A body cut into blocks of bounded length, with the names that cross their borders.

use core::ops::Range;
use std::collections::{HashMap, HashSet};

use super::statement::{Statement, read};
use super::term::Name;

/// A run of statements with the names that cross its borders.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Block {
    /// Its statements, as a range of the body.
    pub steps: Range<usize>,
    /// Named before the block and used in it.
    pub live_in: Vec<Name>,
    /// Named in the block and used after it.
    pub live_out: Vec<Name>,
}

/// Number of names.
pub(crate) fn lets(body: &[Statement]) -> usize {
    body.iter().filter(|step| matches!(step, Statement::Let(..))).count()
}

/// Cuts a body into blocks of at most `limit` names, and always before and after a linear system.
pub(crate) fn blocks(body: &[Statement], limit: usize) -> Vec<Range<usize>> {
    let mut cuts = vec![0];
    let mut lets = 0;
    for (at, step) in body.iter().enumerate() {
        match step {
            Statement::Solve(_) => {
                cuts.extend([at, at + 1]);
                lets = 0;
            }
            Statement::Let(..) if lets == limit => {
                cuts.push(at);
                lets = 1;
            }
            Statement::Let(..) => lets += 1,
            Statement::SinCos(_) | Statement::Store { .. } => {}
        }
    }
    cuts.push(body.len());
    cuts.dedup();
    cuts.windows(2).filter(|w| w[0] < w[1]).map(|w| w[0]..w[1]).collect()
}

/// Ranges of a body with the names that cross their borders.
pub(crate) fn lively(
    body: &[Statement],
    ranges: impl IntoIterator<Item = Range<usize>>,
) -> Vec<Block> {
    let defined: Vec<(usize, Name)> = body
        .iter()
        .enumerate()
        .flat_map(|(at, step)| step.defines().into_iter().map(move |name| (at, name)))
        .collect();
    let mut last: HashMap<&str, usize> = HashMap::new();
    for (at, step) in body.iter().enumerate() {
        last.extend(read([step]).into_iter().map(|name| (name, at)));
    }
    let block = |steps: Range<usize>| {
        let inside: HashSet<&str> = read(&body[steps.clone()]);
        let named = |is: &dyn Fn(usize, &str) -> bool| {
            let each = defined.iter().filter(|(at, name)| is(*at, name));
            each.map(|(_, name)| name.clone()).collect()
        };
        Block {
            live_in: named(&|at, name| at < steps.start && inside.contains(name)),
            live_out: named(&|at, name| {
                steps.contains(&at) && last.get(name).is_some_and(|last| *last >= steps.end)
            }),
            steps,
        }
    };
    ranges.into_iter().map(block).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{Solve, Term};

    fn product(a: &str, b: &str) -> Term {
        Term::Product(Box::new([Term::local(a), Term::local(b)]))
    }

    #[test]
    fn operands_come_before_uses_and_blocks_are_bounded() {
        let step = |k: usize| {
            let before = if k == 0 { "x".to_owned() } else { format!("t{}", k - 1) };
            Statement::Let(format!("t{k}").into(), product(&before, "x"))
        };
        let body: Vec<Statement> = (0..1000).map(step).collect();
        let blocks = lively(&body, blocks(&body, 256));
        assert_eq!(blocks.len(), lets(&body).div_ceil(256));
        for pair in blocks.windows(2) {
            assert_eq!(pair[0].steps.end, pair[1].steps.start);
            assert_eq!(pair[0].live_out, pair[1].live_in, "a chain keeps one value alive");
            assert_eq!(pair[0].live_out.len(), 1);
        }
    }

    #[test]
    fn unknowns_of_a_solve_live_across_blocks() {
        let solve = Solve {
            matrix: vec![Term::local("square")],
            right: vec![Term::local("square")],
            unknowns: vec![Some("u".into())],
            leading: 1,
            margin: None,
            of_motion: false,
        };
        let body = [
            Statement::Let("square".into(), product("x", "x")),
            Statement::Solve(solve),
            Statement::Store { block: 0, entry: 0, value: product("square", "u") },
        ];
        let blocks = lively(&body, blocks(&body, 256));
        let names = |names: &[Name]| names.iter().map(|name| name.to_string()).collect::<Vec<_>>();
        assert_eq!(blocks.len(), 3);
        assert_eq!(names(&blocks[1].live_out), ["u"]);
        assert_eq!(names(&blocks[2].live_in), ["square", "u"]);
    }
}
