//! A finding, as its effect puts it into words.

use crate::report::Parameter as ParameterReport;

/// What no instrument reads of a frame, m and rad.
const LEAST: f64 = 1e-9;

/// What was found, for a sentence.
#[derive(Clone, Copy)]
pub struct Told<'a> {
    /// Where.
    pub place: &'a str,
    /// Its numbers; of several forms those of all.
    pub numbers: &'a [ParameterReport],
    /// Writes a value with its unit: the SI unit, the largest value that is to be shown in the same
    /// unit, the value.
    pub write: &'a dyn Fn(&str, f64, f64) -> String,
}

impl<'a> Told<'a> {
    /// In plain SI, three digits.
    pub fn plain(place: &'a str, numbers: &'a [ParameterReport]) -> Self {
        let write: &dyn Fn(&str, f64, f64) -> String = &|unit, _, value| match unit {
            "1" => format!("{value:.2e}"),
            "rows" => value.to_string(),
            _ => format!("{value:.2e} {unit}"),
        };
        Told { place, numbers, write }
    }

    /// The first number; 0 without one.
    pub fn first(&self) -> f64 {
        self.numbers.first().map_or(0.0, |p| p.value)
    }

    /// A number by its name; 0 if there is none.
    pub fn value(&self, name: &str) -> f64 {
        self.numbers.iter().find(|p| p.name == name).map_or(0.0, |p| p.value)
    }

    /// A number by its name, in its own unit; nothing if there is none.
    pub fn named(&self, name: &str) -> String {
        let number = self.numbers.iter().find(|p| p.name == name);
        number.map_or_else(String::new, |p| (self.write)(&p.unit, p.value.abs(), p.value))
    }

    /// A value in the unit of the first number.
    pub fn sized(&self, value: f64) -> String {
        let unit = self.numbers.first().map_or("", |p| &*p.unit);
        (self.write)(unit, value.abs(), value)
    }

    /// The first number without its sign.
    pub fn size(&self) -> String {
        self.sized(self.first().abs())
    }

    /// `if_negative` or `else_`, by the sign of the first number.
    pub fn by_sign(&self, if_negative: &'static str, else_: &'static str) -> &'static str {
        if self.first() < 0.0 { if_negative } else { else_ }
    }

    /// Length of the vector of some numbers.
    pub fn norm(&self, names: &[&str]) -> f64 {
        names.iter().map(|name| self.value(name).powi(2)).sum::<f64>().sqrt()
    }

    /// How far a frame is moved and turned, each as far as it is more than rounding.
    pub fn moved(&self) -> String {
        let parts = [("m", ["x", "y", "z"]), ("rad", ["rx", "ry", "rz"])].map(|(unit, names)| {
            let size = self.norm(&names);
            (size, (self.write)(unit, size, size))
        });
        let least = if parts.iter().any(|(size, _)| *size > LEAST) { LEAST } else { 0.0 };
        let there = parts.into_iter().filter(|(size, _)| *size > least);
        there.map(|(_, text)| text).collect::<Vec<_>>().join(" and ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_found_by_name() {
        let number = |name: &str, value| ParameterReport {
            name: name.to_owned().into(),
            value,
            unit: "m".into(),
            ci95: [value; 2],
            by_command: None,
        };
        let numbers = [number("x", -3e-3), number("y", 4e-3)];
        let told = Told::plain("base", &numbers);
        assert_eq!((told.first(), told.value("y"), told.value("z")), (-3e-3, 4e-3, 0.0));
        assert_eq!((told.norm(&["x", "y"]), told.by_sign("less", "more")), (5e-3, "less"));
        assert_eq!((told.moved(), told.size()), ("5.00e-3 m".to_owned(), "3.00e-3 m".to_owned()));
    }
}
