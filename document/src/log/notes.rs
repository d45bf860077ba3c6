//! What was co-estimated, what remains and depends on what, what this log cannot show.

use stiffarm_gap::report::log::Dependence;

use super::Log;
use crate::Block;
use crate::text::{counted, listed, short};
use crate::words::{gathered, share, words};

/// Entries of a list before the rest is counted.
const MOST: usize = 4;

impl Log<'_> {
    /// The remarks below the findings.
    pub(super) fn notes(&self) -> Vec<Block> {
        let found = self.found;
        let rigid = match found.rigid_parameters {
            0 => String::new(),
            n => format!("the rigid links, {}", counted(n, "base parameter")),
        };
        let longest = found.evidence.correlation_time.iter().copied().fold(0.0, f64::max);
        let short = match found.evidence.long_enough {
            true => String::new(),
            false => format!(
                "there are too few blocks of five correlation times ({} s each); shorter blocks are used, so that \
                 p values and intervals are too small",
                short(longest)
            ),
        };
        let hidden = self.hidden();
        let most = hidden.len();
        let remarks =
            Block::notes("Rows", found.remarks.clone(), 0).map(|note| Block::Page(vec![note]));
        let notes = [
            Block::note("Co-estimated", rigid),
            Block::note("Too short", short),
            Block::note("Commands", self.by_command().unwrap_or_default()),
            Block::notes("Unexplained", self.unexplained(), MOST),
            Block::notes("Unobservable", hidden, most),
            remarks,
        ];
        notes.into_iter().flatten().collect()
    }

    /// What the commanded motion as instrument changes; `None` where none is logged.
    fn by_command(&self) -> Option<String> {
        let all =
            || self.found.findings.iter().flat_map(|f| f.parameters.iter().map(move |p| (f, p)));
        let told: Vec<_> = all().filter_map(|(f, p)| Some((f, p, p.by_command?))).collect();
        let off = told.iter().filter(|(_, p, other)| *other < p.ci95[0] || *other > p.ci95[1]);
        let off: Vec<String> = off
            .map(|(f, p, other)| {
                let (value, other) = (short(p.value), short(*other));
                let effect = words(&f.effect);
                format!("{} of {effect} at {}, {other} for {value} {}", p.name, f.place, p.unit)
            })
            .collect();
        let instrument = "with the commanded motion as instrumental variable, which is free of measurement noise,";
        match (told.is_empty(), off.is_empty()) {
            (true, _) => None,
            (_, true) => Some(format!("{instrument} every parameter stays within its interval")),
            _ => Some(format!("{instrument} parameters change: {}", listed(&off, MOST))),
        }
    }

    /// On what the residuals depend, joint by joint; the largest share first.
    fn unexplained(&self) -> Vec<String> {
        let part = |rest: &Dependence| format!("{} depends on its {}", share(rest.share), rest.of);
        let all = self.found.unexplained.depends_on.iter();
        let told = gathered(all.map(|rest| (rest.place.as_str(), part(rest))));
        let line = |(place, parts): (&str, Vec<String>)| {
            format!("of the residuals of {place} {}", listed(&parts, MOST))
        };
        told.into_iter().map(line).collect()
    }

    /// What the log cannot show and why, places of the same kind in one line.
    fn hidden(&self) -> Vec<String> {
        let all = self.found.cannot_see.iter();
        let told = gathered(all.map(|one| ((&*one.effect, one.because()), &*one.place)));
        let line = |((effect, because), places): ((&str, &str), Vec<&str>)| {
            format!("{} at {}: {because}", words(effect), places.join(", "))
        };
        told.into_iter().map(line).collect()
    }
}
