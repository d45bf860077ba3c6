//! Effects by their names.

use crate::terminal::failure::Failure;

/// A name that differs by as many letters may be meant.
const ALIKE: usize = 3;

/// What has these names among what is `known` by its name; an error begins with `option`.
///
/// # Errors
/// [`Failure`]: a name that none has, and which it may be.
pub fn effects<T: Clone>(
    known: &[(&'static str, T)],
    names: &[String],
    option: &str,
) -> Result<Vec<T>, Failure> {
    let each = names.iter().map(|name| {
        let found = known.iter().find(|(known, _)| *known == name.trim());
        found.map(|(_, found)| found.clone()).ok_or_else(|| {
            let known: Vec<&str> = known.iter().map(|(known, _)| *known).collect();
            let apart = |k: &&str| strsim::damerau_levenshtein(k, name);
            let near = known.iter().copied().min_by_key(apart).filter(|k| apart(k) <= ALIKE);
            let meant = near.map_or_else(String::new, |k| format!("; did you mean `{k}`?"));
            Failure::with_help(
                format!("{option}found the unknown effect `{name}`{meant}"),
                format!("expected some of {}", known.join(", ")),
            )
        })
    });
    each.collect()
}
