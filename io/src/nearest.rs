//! Names in messages: the one that may have been meant, and lists of them.

/// Fewer letters are a part of too many names.
const PART: usize = 4;

/// The candidate most like `found`, whatever the case: within one edit (two if it is long), or the only one of which
/// it is a part.
pub fn nearest<'a>(found: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let (found, long) = (found.to_lowercase(), found.chars().count());
    let reach = if long >= 6 { 2 } else { 1 };
    let (mut near, mut holding) = (None, Vec::new());
    for candidate in candidates {
        // An edit changes a length by one at most: nothing is compared in vain with a name of megabytes.
        if candidate.chars().count().abs_diff(long) <= reach {
            let distance = strsim::damerau_levenshtein(&found, &candidate.to_lowercase());
            // Two short names that share no letter are no misspelling of each other.
            let related = distance <= reach && distance < long.max(candidate.len());
            if related && near.is_none_or(|(least, _)| distance < least) {
                near = Some((distance, candidate));
            }
        }
        if long >= PART && candidate.to_lowercase().contains(&found) {
            holding.push(candidate);
        }
    }
    let only = if let [only] = holding[..] { Some(only) } else { None };
    near.map(|(_, candidate)| candidate).or(only)
}

/// The question at the end of a message; empty where nothing is near.
pub fn did_you_mean(near: Option<&str>) -> String {
    near.map_or_else(String::new, |n| format!("; did you mean `{n}`?"))
}

/// The first entries of a list, and how many more there are.
pub fn listed(entries: &[impl ToString], most: usize) -> String {
    let shown = entries.iter().take(most).map(ToString::to_string).collect::<Vec<_>>().join(", ");
    match entries.len().checked_sub(most) {
        None | Some(0) => shown,
        Some(rest) => format!("{shown} and {rest} more"),
    }
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
        let of = |found| nearest(found, ["ur5", "ur10", "kuka_kr240", "lin_elbow", "lin_planar"]);
        assert_eq!((of("KR240"), of("UR10e")), (Some("kuka_kr240"), Some("ur10")));
        assert_eq!((of("lin_"), of("elbow")), (None, Some("lin_elbow")));
    }
}
