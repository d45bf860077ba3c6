//! Numbers on the command line: SI, or with a unit right behind them (`30deg`, `3e-05m`).

use stiffarm_document::text::counted;
use stiffarm_gap::io::plain;
pub use stiffarm_gap::io::quantity as read;
use stiffarm_gap::measurement::Dimension;

use crate::terminal::failure::Failure;

/// A number that has its unit: for options that are never in SI by default.
pub fn with_unit(option: &str, text: &str, dimension: Dimension) -> Result<f64, Failure> {
    match read(text, Some(dimension)).filter(|_| plain(text.trim()).is_none()) {
        Some(value) if value > 0.0 => Ok(value),
        _ => {
            let units = dimension.units();
            let message = format!(
                "{option}: found `{text}`, expected a positive number and its unit, one of {units}"
            );
            Err(Failure::new(message))
        }
    }
}

/// Numbers separated by commas, as many as `kinds`; `whose` says of what, in the message.
pub fn list(
    option: &str,
    text: &str,
    kinds: &[Dimension],
    whose: &str,
) -> Result<Vec<f64>, Failure> {
    let found: Vec<&str> = text.split(',').map(str::trim).collect();
    if found.len() != kinds.len() {
        let message = format!(
            "{option}: found {}, expected {}",
            counted(found.len(), "value"),
            counted(kinds.len(), "value")
        );
        return Err(Failure::with_help(message, whose));
    }
    let numbers = found.iter().zip(kinds).enumerate().map(|(k, (text, kind))| {
        read(text, Some(*kind)).ok_or_else(|| {
            let (si, units) = (kind.si().name, kind.units());
            Failure::new(format!(
                "{option}: value {}: found `{text}`, expected {kind}: a number in {si}, or with a \
                 unit behind it, one of {units}",
                k + 1
            ))
        })
    });
    numbers.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_stand_behind_numbers() {
        let length = |text| read(text, Some(Dimension::Length));
        assert_eq!(length("30um"), Some(30.0 * 1e-6));
        assert_eq!(length("3e-05m"), Some(3e-5));
        assert_eq!(length("-12 in"), Some(-12.0 * 0.0254));
        assert_eq!(length("0.5"), Some(0.5));
        for wrong in ["", "m", "30deg", "30 furlong", "inf", "nan", "1e999", "1e308km", "infm"] {
            assert_eq!(length(wrong), None, "{wrong}");
        }
        assert_eq!(read("180deg", Some(Dimension::Angle)), Some(core::f64::consts::PI));
        assert_eq!(read("180deg", None), None);
    }

    #[test]
    fn lists_are_counted() {
        let kinds = [Dimension::Angle, Dimension::Length];
        assert_eq!(list("--q", "0.1, -50mm", &kinds, "").unwrap(), [0.1, -0.05]);
        assert!(list("--q", "0.1", &kinds, "").is_err());
        assert!(list("--q", "0.1,", &kinds, "").is_err());
        assert!(with_unit("--n", "30", Dimension::Length).is_err());
        assert_eq!(with_unit("--n", "2mm", Dimension::Length).unwrap(), 2e-3);
    }
}
