//! Times of day as seconds.

/// Seconds of a day or, behind a date, since 1970: `10:03:05.2`, `2026-11-24T10:03:05Z`, `24.11.2026 10:03`.
/// A date with its month in front is none: nobody knows which number that is.
pub(super) fn seconds(text: &str) -> Option<f64> {
    let text = text.strip_suffix('Z').unwrap_or(text);
    let (date, clock) = match text.split_once([' ', 'T']) {
        Some((date, clock)) => (Some(date), clock.trim()),
        None => (None, text),
    };
    let below = |text: &str, most: f64| {
        text.replace(',', ".").parse().ok().filter(|part: &f64| (0.0..most).contains(part))
    };
    let parts: Vec<&str> = clock.split(':').collect();
    let (hours, minutes, seconds) = match parts[..] {
        [hours, minutes] => (hours, minutes, "0"),
        [hours, minutes, seconds] => (hours, minutes, seconds),
        _ => return None,
    };
    let of_day =
        3600.0 * below(hours, 24.0)? + 60.0 * below(minutes, 60.0)? + below(seconds, 61.0)?;
    Some(86_400.0 * date.map_or(Some(0.0), days)? + of_day)
}

/// Days since 1970 (Hinnant, *chrono-compatible low-level date algorithms*).
fn days(date: &str) -> Option<f64> {
    let parts: Vec<i64> =
        date.split(['-', '/', '.']).map(str::parse).collect::<Result<_, _>>().ok()?;
    let [year, month, day] = match parts[..] {
        [year, month, day] if year > 31 => [year, month, day],
        [day, month, year] if date.contains('.') && year > 31 => [year, month, day],
        _ => return None,
    };
    if !(1..=12).contains(&month) || !(1..=31).contains(&day) || year > 9999 {
        return None;
    }
    // Years begin in March, so that a leap day ends them.
    let year = year - i64::from(month < 3);
    let day_of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    let days = 365 * year + year / 4 - year / 100 + year / 400 + day_of_year - 719_468;
    Some(days as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clocks_are_seconds() {
        assert_eq!(seconds("10:03:05.25"), Some(36_185.25));
        assert_eq!(seconds("0:01"), Some(60.0));
        assert_eq!(seconds("1970-01-01T00:00:00Z"), Some(0.0));
        // A billion seconds of Unix, and the leap day of a century.
        assert_eq!(seconds("2001-09-09 01:46:40"), Some(1e9));
        assert_eq!(seconds("09.09.2001 01:46:40"), Some(1e9));
        let day = |text: &str| seconds(&format!("{text} 00:00")).map(|s| s / 86_400.0);
        assert_eq!(day("2000/03/01").unwrap() - day("2000/02/28").unwrap(), 2.0);
        for none in
            ["", "10", "1.5", "24:00", "10:61", "a:b", "09/09/2001 01:46", "2001-13-01 0:00"]
        {
            assert_eq!(seconds(none), None, "{none}");
        }
    }
}
