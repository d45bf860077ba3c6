//! Letters, Greek letters and names of more than one letter.

/// Length of the spelling of `name` (which has no spaces) at the start of `text`, spaces ignored.
pub(super) fn matched(text: &str, name: &str) -> Option<usize> {
    let mut wanted = name.chars().peekable();
    let mut length = 0;
    for c in text.chars() {
        let Some(next) = wanted.peek() else { break };
        if c == *next {
            wanted.next();
        } else if !c.is_whitespace() || length == 0 {
            return None;
        }
        length += c.len_utf8();
    }
    let complete = wanted.next().is_none();
    // `\delta` must not be found at the start of `\deltas`.
    let command = name.rfind('\\').is_some_and(|i| name[i + 1..].chars().all(char::is_alphabetic));
    let runs_on = command && text[length..].starts_with(|c: char| c.is_ascii_alphabetic());
    (complete && !runs_on).then_some(length)
}

/// Greek letters that papers use as symbols.
const GREEK: &str = "alpha beta gamma delta epsilon varepsilon zeta eta theta iota kappa lambda \
                     mu nu xi pi rho sigma tau upsilon phi varphi chi psi omega Delta Theta \
                     Lambda Gamma Omega";

/// Length of the single letter or Greek letter at the start.
pub(super) fn letter(text: &str) -> Option<usize> {
    let first = text.chars().next()?;
    if first.is_alphabetic() {
        return Some(first.len_utf8());
    }
    let command: String =
        text.strip_prefix('\\')?.chars().take_while(char::is_ascii_alphabetic).collect();
    GREEK.split(' ').any(|letter| letter == command).then_some(1 + command.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_end_where_they_end() {
        assert_eq!(matched("\\delta x_1", "\\deltax"), Some(8));
        assert_eq!(matched("RL_4", "RL"), Some(2));
        assert_eq!(matched("\\deltas", "\\delta"), None);
        assert_eq!(matched("R", "RL"), None);
        assert_eq!(letter("\\theta_1"), Some(6));
        assert_eq!(letter("\\thetas"), None);
        assert_eq!(letter("é"), Some(2));
        assert_eq!(letter("1"), None);
    }
}
