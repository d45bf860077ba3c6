//! The search for the smallest change.

use std::collections::BTreeSet;

use rustc_hash::FxHashMap;

use super::brackets::{brackets, moved_brackets};
use super::core::{Core, Pair};
use super::edit::{Edit, Slip, apply};
use super::slips::{Inventory, slips};
use crate::exact::arithmetic::Arithmetic;
use crate::exact::field::{Modular, minus};
use crate::exact::reader::Reader;
use crate::exact::truth::Form;
use crate::latex::lexer::{Lexeme, Token};
use crate::latex::name::Name;

/// What is to be mended, and into what.
pub struct Search<'a> {
    /// As printed.
    pub tokens: &'a [Token],
    /// Names that may have been confused.
    pub inventory: &'a Inventory,
    /// How tokens are read.
    pub read: &'a Reader<'a>,
    /// What the formula should be.
    pub truth: Form<'a>,
}

/// More slips than this are not combined.
const MOST: usize = 4000;
/// Ways to mend a formula that are looked at exactly.
const TRIED: usize = 40;
/// Formulas of at most this many tokens have all pairs of slips tried.
const SHORT: usize = 14;

/// Changes that mend the formula, as few as are found; `confirm` decides exactly.
pub fn mend(search: &Search<'_>, confirm: impl Fn(&[Token]) -> bool) -> Option<Vec<Edit>> {
    let eye = Eye::new(search)?;
    let inventory = wanted_names(search);
    let single = slips(search.tokens, search.read.notation, search.inventory, &inventory);
    let bracket = brackets(search.tokens);
    let accept = |edits: &[&Edit]| {
        let tokens = apply(search.tokens, edits);
        eye.agrees(&tokens) && confirm(&tokens)
    };
    let owned = |edits: &[&Edit]| Some(edits.iter().map(|e| (*e).clone()).collect());
    let moved = moved_brackets(search.tokens);
    if let Some(edit) = single.iter().chain(&bracket).chain(&moved).find(|e| accept(&[e])) {
        return owned(&[edit]);
    }
    if let Some(found) = same_term(&single, &accept) {
        return owned(&found);
    }
    if let Some(found) = eye.combine(&[], &single, 2, &accept) {
        return owned(&found);
    }
    // On top of a bracket, what is likely.
    let likely = |e: &&Edit| !matches!(e.slip, Slip::Missing | Slip::Extra | Slip::Power);
    let likely: Vec<Edit> = single.iter().filter(likely).cloned().collect();
    for count in [1, 2] {
        for base in &bracket {
            if let Some(found) = eye.combine(&[base], &likely, count, &accept) {
                return owned(&found);
            }
        }
    }
    if search.tokens.len() <= SHORT
        && let Some(found) = every_pair(single.iter().chain(&bracket), &accept)
    {
        return owned(&found);
    }
    let mut more = single.clone();
    more.extend(compounds(&single));
    for (count, slips) in [(2, &more), (3, &single)] {
        if let Some(found) = eye.combine(&[], slips, count, &accept) {
            return owned(&found);
        }
    }
    None
}

/// The names of the formula and of what it should be.
fn wanted_names(search: &Search<'_>) -> Inventory {
    let mut names = Inventory::default();
    names.add(search.tokens);
    let (mut angles, mut symbols) = (BTreeSet::new(), BTreeSet::new());
    search.truth.names(&mut angles, &mut symbols);
    for token in search.inventory.tokens() {
        let Lexeme::Name(name) = &token.is else { continue };
        if angles.contains(&name.key) || symbols.contains(&name.key) {
            names.add(std::slice::from_ref(token));
        }
    }
    for name in symbols.iter().filter(|name| name.chars().count() == 1) {
        let is = Lexeme::Name(Name::new(name.clone(), None, name).into());
        names.add(&[Token { is, text: name.clone(), at: 0..0 }]);
    }
    names
}

/// Each sign with each name of the term that it begins.
fn terms(single: &[Edit]) -> impl Iterator<Item = [&Edit; 2]> {
    let place = |e: &Edit| e.parts[0].0.start;
    let signs = single.iter().filter(|e| e.slip == Slip::Sign);
    signs.flat_map(move |sign| {
        let names = single.iter().filter(|e| matches!(e.slip, Slip::Function | Slip::Index));
        let near = move |e: &&Edit| (place(sign) + 1..place(sign) + 5).contains(&place(e));
        names.filter(near).map(move |name| [sign, name])
    })
}

/// A sign together with a name of its term, as one change.
fn compounds(single: &[Edit]) -> Vec<Edit> {
    let both = |[sign, name]: [&Edit; 2]| {
        let mut both = sign.clone();
        both.parts.extend(name.parts.iter().cloned());
        both.what = format!("{}, {}: {}", sign.what, name.slip.name(), name.what);
        both
    };
    terms(single).map(both).collect()
}

/// A sign and a name of its term: the two multiply, so that their effects do not add.
fn same_term<'e>(single: &'e [Edit], accept: &dyn Fn(&[&Edit]) -> bool) -> Option<Vec<&'e Edit>> {
    terms(single).find(|both| accept(both)).map(Vec::from)
}

/// The first two that are accepted together.
pub fn every_pair<'e>(
    slips: impl Iterator<Item = &'e Edit>,
    accept: &dyn Fn(&[&Edit]) -> bool,
) -> Option<Vec<&'e Edit>> {
    let all: Vec<&Edit> = slips.collect();
    let pairs = all.iter().enumerate().flat_map(|(i, a)| all[i + 1..].iter().map(|b| [*a, *b]));
    let mut apart = pairs.filter(|[a, b]| !a.clashes(b));
    apart.find(|pair| accept(pair)).map(Vec::from)
}

/// Tokens between the first and the last of some edits.
fn spread(edits: &[&Edit]) -> usize {
    let places = || edits.iter().flat_map(|e| &e.parts).map(|(at, _)| at.start);
    places().max().unwrap_or(0) - places().min().unwrap_or(0)
}

/// Looks at formulas at two points.
struct Eye<'a> {
    search: &'a Search<'a>,
    points: [Modular; 2],
    truth: Pair,
}

impl<'a> Eye<'a> {
    fn new(search: &'a Search<'a>) -> Option<Self> {
        let mut points = Vec::new();
        let mut truth = Vec::new();
        for point in (1..40).filter_map(|seed| search.read.point(seed)) {
            if let Ok(value) = search.truth.value(&point) {
                points.push(point);
                truth.push(value);
            }
            if points.len() == 2 {
                break;
            }
        }
        let points: [Modular; 2] = points.try_into().ok()?;
        let truth: Pair = truth.try_into().ok()?;
        Some(Eye { search, points, truth })
    }

    fn agrees(&self, tokens: &[Token]) -> bool {
        let Some(tree) = self.search.read.tree(tokens) else { return false };
        (0..2).all(|k| self.points[k].tree(&tree) == Ok(self.truth[k]))
    }

    /// Up to `count` slips in different terms, on top of `base`; of several ways the one in which
    /// they stand nearest to each other.
    fn combine<'e>(
        &self,
        base: &[&'e Edit],
        slips: &'e [Edit],
        count: usize,
        accept: &dyn Fn(&[&Edit]) -> bool,
    ) -> Option<Vec<&'e Edit>> {
        let printed = apply(self.search.tokens, base);
        let start = Core::of(&self.search.read.tree(&printed)?, &self.points)?;
        let wanted = start.wanted(self.truth, &self.points)?;
        let mut changes: Vec<(Pair, &Edit)> = Vec::new();
        for edit in slips.iter().take(MOST).filter(|e| !base.iter().any(|b| b.clashes(e))) {
            let mut edits = base.to_vec();
            edits.push(edit);
            let tree = self.search.read.tree(&apply(self.search.tokens, &edits));
            let Some(core) = tree.and_then(|t| Core::of(&t, &self.points)) else { continue };
            if core.rest == start.rest && core.root == start.root && core.value != start.value {
                changes.push((difference(core.value, start.value), edit));
            }
        }
        let table: FxHashMap<Pair, &Edit> =
            changes.iter().rev().map(|(change, edit)| (*change, *edit)).collect();
        let mut found: Vec<Vec<&Edit>> = Vec::new();
        for goal in wanted {
            let gap = difference(goal, start.value);
            found.extend(table.get(&gap).map(|edit| vec![*edit]));
            for (i, (change, edit)) in changes.iter().enumerate().filter(|_| count > 1) {
                let gap = difference(gap, *change);
                let others: &[(Pair, &Edit)] = if count > 2 { &changes[i + 1..] } else { &[] };
                let thirds = others.iter().map(|(c, e)| (difference(gap, *c), Some(*e)));
                for (gap, second) in std::iter::once((gap, None)).chain(thirds) {
                    if let Some(last) = table.get(&gap) {
                        let mut edits = vec![*edit];
                        edits.extend(second);
                        edits.push(last);
                        found.push(edits);
                    }
                }
            }
        }
        found.retain(|edits| {
            let clash = |a: usize| edits[a + 1..].iter().any(|b| edits[a].clashes(b));
            !(0..edits.len()).any(clash)
        });
        found.sort_by_key(|edits| (edits.len(), spread(edits)));
        found.into_iter().take(TRIED).find_map(|edits| {
            let all: Vec<&Edit> = base.iter().copied().chain(edits).collect();
            accept(&all).then_some(all)
        })
    }
}

fn difference(a: Pair, b: Pair) -> Pair {
    [minus(a[0], b[0]), minus(a[1], b[1])]
}

#[cfg(test)]
mod tests;
