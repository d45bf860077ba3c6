//! The ledger: a line for every equation and every table cell.

mod builtin;
mod cells;
mod json;
mod judge;
mod labels;
mod mathml;
mod page;
mod render;
mod witness;

pub use builtin::built_in;
pub use cells::Methods;
pub use judge::truth;

use crate::verdict::{Entry, Kind, Verdict};
use cells::cells;
use judge::equations;

use crate::exact::print::short;
use crate::file::Paper;

/// Judges every equation and every table cell of a paper.
pub fn judge(paper: &Paper, methods: Methods<'_>) -> Vec<Entry> {
    let mut entries = equations(paper);
    entries.extend(cells(paper, methods));
    entries
}

/// The findings about a set of papers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ledger {
    /// One entry per equation and cell, in the order of the papers.
    pub entries: Vec<Entry>,
    /// Titles of the papers by their short names.
    pub titles: Vec<(String, String)>,
}

impl Ledger {
    /// The ledger of some papers; several files may belong to one paper.
    pub fn of(papers: &[Paper]) -> Self {
        Self::with(papers, &|_| None)
    }

    /// The same, with methods for the cells that no formula gives.
    pub fn with(papers: &[Paper], methods: Methods<'_>) -> Self {
        let mut joined: Vec<Paper> = Vec::new();
        for paper in papers {
            match joined.iter_mut().find(|known| known.id == paper.id) {
                Some(known) => known.join(paper.clone()),
                None => joined.push(paper.clone()),
            }
        }
        Ledger {
            entries: joined.iter().flat_map(|paper| judge(paper, methods)).collect(),
            titles: joined.into_iter().map(|paper| (paper.id, paper.title)).collect(),
        }
    }

    /// The entries of one paper.
    pub fn paper<'l>(&'l self, id: &'l str) -> impl Iterator<Item = &'l Entry> {
        self.entries.iter().filter(move |e| e.paper == id)
    }

    /// How often each verdict was given to a kind of entry of a paper, in the order of
    /// [`Verdict::EACH`], the ones that occur.
    pub fn counts(&self, id: &str, kind: Kind) -> Vec<(Verdict, usize)> {
        let count = |verdict: Verdict| {
            self.paper(id).filter(|e| e.kind == kind && e.verdict == verdict).count()
        };
        let all = Verdict::EACH.into_iter().map(|(verdict, _)| (verdict, count(verdict)));
        all.filter(|(_, n)| *n > 0).collect()
    }

    /// The counts of a paper in words: `32 agree, …`.
    pub fn summary(&self, id: &str) -> String {
        let mut parts = Vec::new();
        for (kind, noun) in [(Kind::Equation, "equations"), (Kind::Cell, "table cells")] {
            let counts = self.counts(id, kind);
            let total: usize = counts.iter().map(|(_, n)| n).sum();
            if total > 0 {
                let each: Vec<String> =
                    counts.iter().map(|(v, n)| format!("{n} {}", v.words())).collect();
                parts.push(format!("{total} {noun}: {}", each.join(", ")));
            }
        }
        parts.join("; ")
    }
}

/// The witness in words.
fn witness_line(entry: &Entry) -> Option<String> {
    let w = entry.witness.as_ref()?;
    let angles: Vec<String> =
        w.angles.iter().map(|(name, degrees)| format!("{name} = {}°", short(*degrees))).collect();
    let symbols: Vec<String> =
        w.symbols.iter().map(|(name, value)| format!("{name} = {}", short(*value))).collect();
    let place: Vec<String> = angles.into_iter().chain(symbols).collect();
    let values = format!("printed {}, derived {}", short(w.printed), short(w.derived));
    Some(if place.is_empty() { values } else { format!("at {}: {values}", place.join(", ")) })
}
