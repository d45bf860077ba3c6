//! The smallest change of a printed relation that makes it hold.

use super::tree::{Name, Tree};

/// A changed relation, and what was changed.
pub type Edit = (Tree, String);

/// Every formula that one slip away from `tree` may have been meant; `known` are symbols.
pub fn edits(tree: &Tree, known: &[Name]) -> Vec<Edit> {
    let mut out = inner_edits(tree, known);
    if !matches!(tree, Tree::Product(_)) {
        let factors = known.iter().filter(|name| !is_family(name)).map(|n| Tree::Name(n.clone()));
        for factor in factors {
            for pair in [[tree.clone(), factor.clone()], [factor, tree.clone()]] {
                let changed = Tree::Product(pair.to_vec());
                let what = format!("`{}` → `{}`", tree.latex().trim(), changed.latex().trim());
                out.push((changed, what));
            }
        }
    }
    out
}

/// Whether a symbol stands for one matrix for each index.
fn is_family(name: &Name) -> bool {
    name.indices.iter().any(|index| index == "#")
}

fn inner_edits(tree: &Tree, known: &[Name]) -> Vec<Edit> {
    let mut out = own(tree, known);
    let mut into = |child: &Tree, rebuild: &dyn Fn(Tree) -> Tree| {
        out.extend(
            inner_edits(child, known).into_iter().map(|(child, what)| (rebuild(child), what)),
        );
    };
    match tree {
        Tree::Number(_) | Tree::Name(_) => {}
        Tree::Sum(terms) => {
            for (k, (_, term)) in terms.iter().enumerate() {
                into(term, &|child| {
                    let mut terms = terms.clone();
                    terms[k].1 = child;
                    Tree::Sum(terms)
                });
            }
        }
        Tree::Product(factors) => {
            for (k, factor) in factors.iter().enumerate() {
                into(factor, &|child| {
                    let mut factors = factors.clone();
                    factors[k] = child;
                    Tree::Product(factors)
                });
            }
        }
        Tree::Quotient(a, b) => {
            into(a, &|child| Tree::Quotient(Box::new(child), b.clone()));
            into(b, &|child| Tree::Quotient(a.clone(), Box::new(child)));
        }
        Tree::Transpose(a) => into(a, &|child| Tree::Transpose(Box::new(child))),
        Tree::Inverse(a) => into(a, &|child| Tree::Inverse(Box::new(child))),
        Tree::Derivative(a, by) => {
            into(a, &|child| Tree::Derivative(Box::new(child), by.clone()));
        }
        Tree::Sqrt(a) => into(a, &|child| Tree::Sqrt(Box::new(child))),
        Tree::Trace(a) => into(a, &|child| Tree::Trace(Box::new(child))),
        Tree::Norm(a) => into(a, &|child| Tree::Norm(Box::new(child))),
        Tree::Blocks(rows) => {
            for (r, row) in rows.iter().enumerate() {
                for (c, cell) in row.iter().enumerate() {
                    into(cell, &|child| {
                        let mut rows = rows.clone();
                        rows[r][c] = child;
                        Tree::Blocks(rows)
                    });
                }
            }
        }
        Tree::Over { index, from, to, body } => {
            into(body, &|child| Tree::Over {
                index: index.clone(),
                from: from.clone(),
                to: to.clone(),
                body: Box::new(child),
            });
        }
    }
    out
}

/// Changes of a node itself.
fn own(tree: &Tree, known: &[Name]) -> Vec<Edit> {
    let mut out: Vec<Edit> = Vec::new();
    let mut to = |changed: Tree| {
        let what = format!("`{}` → `{}`", tree.latex().trim(), changed.latex().trim());
        out.push((changed, what));
    };
    match tree {
        Tree::Name(name) => {
            let others = known
                .iter()
                .filter(|other| other.base != name.base || other.indices != name.indices);
            others
                .filter(|other| !is_family(other))
                .for_each(|other| to(Tree::Name(other.clone())));
            for changed in counted_otherwise(name) {
                to(Tree::Name(changed));
            }
            to(Tree::Transpose(Box::new(tree.clone())));
            to(Tree::Inverse(Box::new(tree.clone())));
        }
        Tree::Sum(terms) => {
            for k in 0..terms.len() {
                let mut changed = terms.clone();
                changed[k].0 ^= true;
                to(Tree::Sum(changed));
            }
            // `a + b c` for `(a + b) c`: the bracket was closed too late.
            if let Some((last, Tree::Product(factors))) = terms.last() {
                let mut inner = terms[..terms.len() - 1].to_vec();
                inner.push((*last, factors[0].clone()));
                let mut product = vec![Tree::Sum(inner)];
                product.extend_from_slice(&factors[1..]);
                to(Tree::Product(product));
            }
        }
        Tree::Product(factors) => {
            for k in 1..factors.len() {
                let mut changed = factors.clone();
                changed.swap(k - 1, k);
                to(Tree::Product(changed));
            }
            for k in (0..=factors.len()).rev() {
                for name in known.iter().filter(|name| !is_family(name)) {
                    let mut changed = factors.clone();
                    changed.insert(k, Tree::Name(name.clone()));
                    to(Tree::Product(changed));
                }
            }
        }
        Tree::Transpose(inner) | Tree::Inverse(inner) => to(inner.as_ref().clone()),
        Tree::Over { index, from, to: last, body } => {
            for letter in LETTERS.into_iter().filter(|letter| letter != index) {
                to(Tree::Over {
                    index: letter.into(),
                    from: from.clone(),
                    to: last.clone(),
                    body: body.clone(),
                });
            }
        }
        _ => {}
    }
    out
}

/// Letters that papers count by.
const LETTERS: [&str; 3] = ["i", "j", "k"];

/// The same symbol under another index.
fn counted_otherwise(name: &Name) -> Vec<Name> {
    let mut out = Vec::new();
    for (k, index) in name.indices.iter().enumerate() {
        let letter = LETTERS.into_iter().find(|letter| {
            index == letter
                || index.starts_with(&format!("{letter}+"))
                || index.starts_with(&format!("{letter}-"))
        });
        let Some(letter) = letter else { continue };
        for other in LETTERS.into_iter().filter(|other| *other != letter) {
            let mut changed = name.clone();
            changed.indices[k] = index.replacen(letter, other, 1);
            out.push(changed);
        }
    }
    out
}
