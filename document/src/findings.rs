//! Findings as they are reported: those that matter in full, the others together.

use stiffarm_gap::report::{Alternative, Finding as Found, MATTERS};

use super::figure::Step;
use super::words::{joined, named, p_value};
use super::{Block, Finding};
use crate::text::counted;

/// Findings in order, with their numbers.
pub type Numbered<'a> = Vec<(usize, &'a Found)>;

/// The findings that matter, and the others; where none does, all are shown as if they did.
pub fn weighed(findings: &[Found]) -> [Numbered<'_>; 2] {
    let numbered = findings.iter().enumerate().map(|(k, finding)| (k + 1, finding));
    let (large, small): (Vec<_>, Vec<_>) = numbered.partition(|(_, f)| f.share >= MATTERS);
    if large.is_empty() { [small, large] } else { [large, small] }
}

/// `11 small effects, 4 µm together`, with `size` as what they remove is written; empty of none.
pub fn summary(small: &Numbered<'_>, size: impl Fn(f64) -> String) -> String {
    let removed = |(_, f): &(usize, &Found)| f.held_out.before() - f.held_out.after();
    match small.len() {
        0 => String::new(),
        1 => format!("1 small effect, {}", size(removed(&small[0]))),
        n => format!("{n} small effects, {} together", size(small.iter().map(removed).sum())),
    }
}

/// What the findings remove, a step each as `one` draws it; small ones that follow one another are one step, which
/// leaves what `size` writes.
pub fn steps(
    findings: &[Found],
    one: impl Fn(&Found) -> Step,
    size: impl Fn(f64) -> String,
) -> Vec<Step> {
    let [_, small] = weighed(findings);
    let is_small = |f: &Found| small.iter().any(|(_, other)| std::ptr::eq(*other, f));
    let step = |run: &[Found]| match run {
        [first, .., last] => {
            let (before, after) = (first.held_out.before(), last.held_out.after());
            Step {
                label: counted(run.len(), "small effect"),
                from: after.min(before),
                to: after.max(before),
                text: format!("→ {}", size(after)),
                ..one(last)
            }
        }
        _ => one(&run[0]),
    };
    findings.chunk_by(|a, b| is_small(a) && is_small(b)).map(step).collect()
}

/// The findings as `one` reports each.
pub fn block(
    findings: &[Found],
    one: impl Fn(usize, &Found) -> Finding,
    size: impl Fn(f64) -> String,
) -> Block {
    let [large, small] = weighed(findings);
    let each = |of: &Numbered<'_>| of.iter().map(|(number, f)| one(*number, f)).collect();
    Block::Findings { large: each(&large), summary: summary(&small, size), small: each(&small) }
}

/// What the first findings do, as `said` says it, and how many more there are.
pub fn told(findings: &[Found], most: usize, and: &str, said: impl Fn(&Found) -> String) -> String {
    let [large, small] = weighed(findings);
    let first = if large.len() > most { most - 1 } else { large.len() };
    let mut told: Vec<String> = large.iter().take(first).map(|(_, f)| said(f)).collect();
    told.extend(unnamed(large.len() - first, small.len()));
    joined(&told, and)
}

/// `2 more effects`, `3 small effects`: what a sentence counts and does not name.
pub fn unnamed(more: usize, small: usize) -> impl Iterator<Item = String> {
    let each = [(more, "more effect"), (small, "small effect")].into_iter();
    each.filter(|(count, _)| *count > 0).map(|(count, what)| counted(count, what))
}

impl Finding {
    /// Its parameters, at most so many before the rest is counted.
    pub fn numbers(&self, most: usize) -> String {
        let mut parameters: Vec<String> = self.parameters.iter().take(most).cloned().collect();
        let rest = self.parameters.len() - parameters.len();
        parameters.extend((rest > 0).then(|| format!("and {rest} more")));
        parameters.join("; ")
    }

    /// What findings of every kind of data have, with `rival` as what an alternative leaves is written
    /// and `whole` the error before any finding.
    pub fn of(
        number: usize,
        f: &Found,
        whole: f64,
        rival: impl Fn(&Alternative) -> String,
    ) -> Finding {
        let part = |x: f64| if whole > 0.0 { x / whole } else { 0.0 };
        let other = |a: &Alternative| format!("{} ({})", named(&a.effect, &a.place), rival(a));
        Finding {
            number,
            name: named(&f.effect, &f.place),
            said: String::new(),
            error: String::new(),
            parts: [part(f.held_out.before()), part(f.held_out.after())],
            less: String::new(),
            parameters: Vec::new(),
            evidence: p_value(f.p_value),
            same: f.indistinguishable().map(&other).collect(),
            next: f.alternatives.iter().find(|a| a.separable()).map(&other),
            advice: f.advice().map(str::to_owned),
        }
    }
}
