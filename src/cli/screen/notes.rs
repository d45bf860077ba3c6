//! What a diagnosis leaves open: what is not explained, what could not be seen, what was not read.

use super::{MOST, Screen, words};
use crate::cli::text::bold;

impl Screen<'_> {
    /// What is left, what could not be seen, what was not read.
    pub(super) fn rest(&self) -> String {
        let mut lines: Vec<String> = Vec::new();
        let left = &self.found.unexplained;
        if left.present {
            let size =
                self.length(left.position_rms, left.position_rms).with_unit(left.position_rms);
            lines.push(format!("{}  {size} beyond the noise", bold("Unexplained")));
        } else if self.found.gap.noise.from != "residual" {
            lines.push(format!("{}  nothing beyond the noise", bold("Unexplained")));
        }
        let mut hidden: Vec<(&str, &str, Vec<&str>)> = Vec::new();
        for c in &self.found.cannot_see {
            match hidden.iter_mut().find(|(e, b, _)| (*e, *b) == (c.effect, c.because)) {
                Some((_, _, places)) => places.push(&c.place),
                None => hidden.push((c.effect, c.because, vec![&c.place])),
            }
        }
        for (effect, because, places) in hidden.iter().take(MOST) {
            let (effect, places) = (words(effect), places.join(", "));
            lines.push(format!("{}  {effect} at {places}: {because}", bold("Cannot see")));
        }
        let rival = |name: &str| {
            self.rivals
                .iter()
                .any(|r| name.strip_prefix(r.as_str()).is_some_and(|n| n.starts_with('_')))
        };
        let unknown: Vec<String> = self
            .data
            .extra
            .iter()
            .filter(|column| !rival(&column.name))
            .map(|column| match &column.suggestion {
                Some(meant) => format!("{} (did you mean {meant}?)", column.column.header),
                None => column.column.header.clone(),
            })
            .chain(self.data.unused.iter().map(|c| format!("{} (not measured)", c.header)))
            .collect();
        if !unknown.is_empty() {
            lines.push(format!("{}  columns {}", bold("Not used"), unknown.join(", ")));
        }
        if lines.is_empty() { String::new() } else { format!("\n{}\n", lines.join("\n")) }
    }
}
