//! "Did you mean …?"

/// The known word that an unknown one was probably meant to be: the same letters in another case
/// first, else the one fewest edits away, if that is few for a word of this length.
pub fn closest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = word.chars().count();
    let allowed = (length / 3).max(1).min(length.saturating_sub(1));
    known
        .into_iter()
        .map(|candidate| {
            let edits = if candidate.eq_ignore_ascii_case(word) {
                0
            } else {
                strsim::damerau_levenshtein(word, candidate)
            };
            (edits, candidate)
        })
        .filter(|(edits, _)| *edits <= allowed)
        .min_by_key(|(edits, _)| *edits)
        .map(|(_, candidate)| candidate)
}

/// The advice for an unknown word: the closest known one, else all of them.
pub(crate) fn advice(word: &str, known: &[&str]) -> String {
    match closest(word, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("known here: {}", known.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEYS: [&str; 4] = ["theta", "alpha", "stiffness", "d"];

    #[test]
    fn near_words_are_found() {
        assert_eq!(closest("alhpa", KEYS), Some("alpha"));
        assert_eq!(closest("Alpha", KEYS), Some("alpha"));
        assert_eq!(closest("stifness", KEYS), Some("stiffness"));
        assert_eq!(closest("D", KEYS), Some("d"));
    }

    #[test]
    fn far_words_are_not() {
        assert_eq!(closest("x", KEYS), None);
        assert_eq!(closest("colour", KEYS), None);
        assert_eq!(closest("", KEYS), None);
        assert_eq!(advice("colour", &KEYS), "known here: theta, alpha, stiffness, d");
        assert_eq!(advice("thta", &KEYS), "did you mean `theta`?");
    }
}
