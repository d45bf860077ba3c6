//! Effects by their names.

use stiffarm_gap::effects::Effect;

use crate::terminal::failure::Failure;

/// A name that differs by as many letters may be meant.
const ALIKE: usize = 3;

/// The effects of these names among those that are `known`; an error begins with `option`.
///
/// # Errors
/// [`Failure`]: a name that none has, and which it may be.
pub fn effects(
    known: &[&'static dyn Effect],
    names: &[String],
    option: &str,
) -> Result<Vec<&'static dyn Effect>, Failure> {
    let each = names.iter().map(|name| {
        let found = known.iter().copied().find(|effect| effect.identifier() == name.trim());
        found.ok_or_else(|| {
            let known: Vec<&str> = known.iter().map(|effect| effect.identifier()).collect();
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
