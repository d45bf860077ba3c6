//! Times of day as seconds.

/// A time as a text tells it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Clock {
    /// Since 1970, or of a day.
    pub seconds: f64,
    /// Whether it has a date.
    pub dated: bool,
}

/// Seconds of a day.
pub(super) const DAY: f64 = 86_400.0;

impl Clock {
    /// Of `10:03:05.2`, `10:03:05:200`, `9:03 PM`, `2026-11-24T10:03:05Z`, `24.11.2026 10:03`. A date with its
    /// month in front is none: nobody knows which number that is.
    pub(super) fn of(text: &str) -> Option<Clock> {
        let (date, clock) = match text.split_once([' ', 'T']) {
            Some((date, clock)) if !date.contains(':') => (Some(date), clock.trim()),
            _ => (None, text),
        };
        let (clock, half) = halves(clock);
        let (clock, east) = zone(clock.strip_suffix('Z').unwrap_or(clock))?;
        let below = |text: &str, most: f64| {
            text.replace(',', ".").parse().ok().filter(|part: &f64| (0.0..most).contains(part))
        };
        let parts: Vec<&str> = clock.split(':').collect();
        let (hours, minutes, seconds) = match parts[..] {
            [hours, minutes] => (hours, minutes, below("0", 1.0)),
            [hours, minutes, seconds] => (hours, minutes, below(seconds, 61.0)),
            // Controllers put milliseconds behind a colon.
            [hours, minutes, seconds, thousandths] if thousandths.len() == 3 => {
                let rest = below(thousandths, 1000.0)?;
                (hours, minutes, below(seconds, 61.0).map(|whole| whole + 1e-3 * rest))
            }
            _ => return None,
        };
        let hours = match half {
            None => below(hours, 24.0)?,
            Some(half) => below(hours, 13.0)?.rem_euclid(12.0) + half,
        };
        let of_day = 3600.0 * hours + 60.0 * below(minutes, 60.0)? + seconds?;
        let days = date.map_or(Some(0.0), days)?;
        Some(Clock { seconds: DAY * days + of_day - east, dated: date.is_some() })
    }
}

/// Without `AM` or `PM`, and from which hour on these count.
fn halves(clock: &str) -> (&str, Option<f64>) {
    let behind = |half: &str| {
        let at = clock.len().checked_sub(half.len())?;
        let is = clock.get(at..)?.eq_ignore_ascii_case(half);
        is.then(|| clock[..at].trim_end())
    };
    match (behind("am"), behind("pm")) {
        (Some(clock), _) => (clock, Some(0.0)),
        (None, Some(clock)) => (clock, Some(12.0)),
        (None, None) => (clock, None),
    }
}

/// Without `+01:00`, and how many seconds east of Greenwich that is.
fn zone(clock: &str) -> Option<(&str, f64)> {
    let Some(at) = clock.rfind(['+', '-']) else { return Some((clock, 0.0)) };
    let (hours, minutes) = clock[at + 1..].split_once(':').unwrap_or((&clock[at + 1..], "0"));
    let part = |text: &str| text.parse().ok().filter(|part: &u8| *part < 60).map(f64::from);
    let east = 3600.0 * part(hours)? + 60.0 * part(minutes)?;
    Some((&clock[..at], if clock[at..].starts_with('-') { -east } else { east }))
}

/// Days since 1970 (Hinnant, *chrono-compatible low-level date algorithms*).
pub(super) fn days(date: &str) -> Option<f64> {
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
        let seconds = |text: &str| Clock::of(text).map(|clock| clock.seconds);
        for (text, expected) in [
            ("10:03:05.25", 36_185.25),
            ("10:03:05:250", 36_185.25),
            ("0:01", 60.0),
            ("12:01 AM", 60.0),
            ("12:01:30 pm", 43_290.0),
            ("9:03PM", 75_780.0),
            ("1970-01-01T00:00:00Z", 0.0),
            ("1970-01-01T03:00:00+01:30", 5400.0),
            ("1970-01-01 03:00:00-0:30", 12_600.0),
            // A billion seconds of Unix.
            ("2001-09-09 01:46:40", 1e9),
            ("09.09.2001 01:46:40", 1e9),
            ("9.9.2001 1:46:40 am", 1e9),
        ] {
            assert_eq!(seconds(text), Some(expected), "{text}");
        }
        assert!(
            Clock::of("2001-09-09 01:46").unwrap().dated && !Clock::of("1:46 AM").unwrap().dated
        );
        // The leap day of a century.
        let day = |text: &str| seconds(&format!("{text} 00:00")).map(|s| s / DAY);
        assert_eq!(day("2000/03/01").unwrap() - day("2000/02/28").unwrap(), 2.0);
        for none in [
            "",
            "10",
            "1.5",
            "24:00",
            "10:61",
            "a:b",
            "09/09/2001 01:46",
            "2001-13-01 0:00",
            "13:00 PM",
            "1:2:3:4",
            "10:03+",
            "PM",
        ] {
            assert_eq!(seconds(none), None, "{none}");
        }
    }
}
