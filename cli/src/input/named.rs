//! Effects by their names.

use stiffarm_gap::io::{did_you_mean, nearest};

use crate::terminal::failure::Failure;

/// What has these names among what is `known` by its name; an error begins with `option`.
pub fn effects<T: Clone>(
    known: &[(&'static str, T)],
    names: &[String],
    option: &str,
) -> Result<Vec<T>, Failure> {
    let each = names.iter().map(|name| {
        let found = known.iter().find(|(known, _)| *known == name.trim());
        found.map(|(_, found)| found.clone()).ok_or_else(|| {
            let mut known: Vec<&str> = known.iter().map(|(known, _)| *known).collect();
            // At rest and in motion an effect has one name.
            known.dedup();
            let meant = did_you_mean(nearest(name, known.iter().copied()));
            Failure::with_help(
                format!("{option}found the unknown effect `{name}`{meant}"),
                format!("expected some of {}", known.join(", ")),
            )
        })
    });
    each.collect()
}
