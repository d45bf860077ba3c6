//! The name that may have been meant.

/// The candidate most like `found`: equal but for case, or within one edit (two if it is long).
pub fn nearest<'a>(found: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let long = found.chars().count();
    let reach = if long >= 6 { 2 } else { 1 };
    candidates
        .into_iter()
        // An edit changes a length by one at most: nothing is compared in vain with a name of megabytes.
        .filter(|c| c.chars().count().abs_diff(long) <= reach)
        .filter_map(|c| {
            let distance = if c.eq_ignore_ascii_case(found) {
                0
            } else {
                strsim::damerau_levenshtein(found, c)
            };
            // Two short names that share no letter are no misspelling of each other.
            let related = distance == 0 || distance < long.max(c.len());
            (distance <= reach && related).then_some((distance, c))
        })
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, c)| c)
}

/// The question at the end of a message; empty where nothing is near.
pub fn did_you_mean(near: Option<&str>) -> String {
    near.map_or_else(String::new, |n| format!("; did you mean `{n}`?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suggests_only_near_names() {
        let of = |found| nearest(found, ["m", "mm", "deg", "rad", "degC"]);
        assert_eq!((of("Deg"), of("degs")), (Some("deg"), Some("deg")));
        assert_eq!((of("furlong"), of("x")), (None, None));
        assert_eq!(did_you_mean(of("Rad")), "; did you mean `rad`?");
    }
}
