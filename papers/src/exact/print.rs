//! A formula written in a paper's notation.

use std::collections::HashMap;

use num_rational::Ratio;
use num_traits::{One, Signed};

use super::polynomial::{Expanded, Polynomial, Variable};
use super::truth::Form;
use crate::latex::lexer::Lexeme;
use crate::latex::name::key;
use crate::latex::notation::Notation;
use crate::latex::tree::Function;
use crate::mend::Inventory;

/// The formula multiplied out, sines and cosines of single angles, in the paper's letters where it
/// has them.
///
/// # Errors
/// It is too long, or has a root.
pub fn expanded(
    formula: Form<'_>,
    notation: &Notation,
    inventory: &Inventory,
) -> Result<String, &'static str> {
    let value = formula.value(&Expanded)?;
    let mut names: HashMap<String, String> = HashMap::new();
    for token in inventory.tokens() {
        if let Lexeme::Name(name) = &token.is {
            names.entry(name.key.clone()).or_insert_with(|| token.text.clone());
        }
    }
    let printer = Printer { notation, names };
    let above = printer.sum(&value.above);
    if value.below == Polynomial::one() {
        return Ok(above);
    }
    Ok(format!("\\frac{{{above}}}{{{}}}", printer.sum(&value.below)))
}

struct Printer<'a> {
    notation: &'a Notation,
    names: HashMap<String, String>,
}

impl Printer<'_> {
    fn sum(&self, p: &Polynomial) -> String {
        if *p == Polynomial::default() {
            return "0".into();
        }
        let mut text = String::new();
        for (monomial, c) in p.terms() {
            let sign = match (c.is_negative(), text.is_empty()) {
                (true, true) => "-",
                (true, false) => " - ",
                (false, true) => "",
                (false, false) => " + ",
            };
            text.push_str(sign);
            let factors = |positive: bool| {
                let chosen = monomial.iter().filter(move |(_, p)| (**p > 0) == positive);
                chosen.map(|(v, p)| self.factor(v, p.unsigned_abs())).collect::<Vec<_>>().join(" ")
            };
            let (above, below) = (factors(true), factors(false));
            let n = c.abs();
            let above = number(*n.numer(), &above);
            match number(*n.denom(), &below).as_str() {
                "1" => text.push_str(&above),
                below => text.push_str(&format!("\\frac{{{above}}}{{{below}}}")),
            }
        }
        text
    }

    fn factor(&self, variable: &Variable, power: u32) -> String {
        let base = match variable {
            Variable::Symbol(name) => self.name(name),
            Variable::Sin(name) => self.trig(Function::Sin, name),
            Variable::Cos(name) => self.trig(Function::Cos, name),
        };
        match power {
            1 => base,
            p if base.starts_with('\\') && base.contains(' ') => format!("({base})^{p}"),
            p => format!("{base}^{p}"),
        }
    }

    fn name(&self, name: &str) -> String {
        self.names.get(name).cloned().unwrap_or_else(|| name.to_owned())
    }

    fn trig(&self, function: Function, name: &str) -> String {
        for (letter, f, angle) in &self.notation.functions {
            let index = name.strip_prefix(key(angle, None).as_str());
            if let Some(index) = index.filter(|i| *f == function && !i.is_empty()) {
                return format!("{letter}_{index}");
            }
        }
        let f = if function == Function::Sin { "\\sin" } else { "\\cos" };
        format!("{f} {}", self.name(name))
    }
}

fn number(n: i128, rest: &str) -> String {
    match (n, rest) {
        (n, "") => n.to_string(),
        (n, rest) if n.is_one() => rest.to_owned(),
        (n, rest) => format!("{n} {rest}"),
    }
}

/// A double as a reader wants it: six digits.
pub fn short(x: f64) -> String {
    let text = format!("{x:.6}");
    let text =
        if x != 0.0 && (x.abs() < 1e-3 || x.abs() >= 1e6) { format!("{x:.5e}") } else { text };
    match text.contains('e') {
        true => text,
        false => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
    }
}

/// A printed decimal: its value and the unit of its last digit.
pub fn decimal(text: &str) -> Option<(f64, f64)> {
    let clean = text.trim().trim_end_matches('%').replace('−', "-");
    let value: f64 = clean.parse().ok()?;
    let (mantissa, exponent) = clean.split_once(['e', 'E']).unwrap_or((&clean, "0"));
    let places = mantissa.split_once('.').map_or(0, |(_, f)| f.len());
    let unit = Ratio::<i32>::from(exponent.parse::<i32>().ok()?) - i32::try_from(places).ok()?;
    Some((value, 10f64.powi(unit.to_integer())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::truth::Truth;
    use crate::latex::lexer::lex;

    #[test]
    fn what_is_multiplied_out_is_written_in_the_papers_letters() {
        let functions = vec![("s".to_owned(), Function::Sin, "\\theta".to_owned())];
        let notation = Notation { functions, ..Notation::default() };
        let text = "\\lambda_6 s_1/2 - \\cos\\theta_2 a^2";
        let mut inventory = Inventory::default();
        inventory.add(&lex(text, &notation).unwrap());
        let truth = Truth::written(text, &notation);
        assert_eq!(
            expanded(truth.form(truth.entries[0]), &notation, &inventory).unwrap(),
            "-a^2 \\cos \\theta_2 + \\frac{\\lambda_6 s_1}{2}"
        );
    }

    #[test]
    fn printed_decimals_have_a_last_digit() {
        assert_eq!(decimal("0.00122").map(|d| d.1), Some(1e-5));
        assert_eq!(decimal("32").map(|d| d.1), Some(1.0));
        assert_eq!(decimal("x"), None);
        assert_eq!(
            (short(0.25), short(1234.5), short(1.0e-7)),
            ("0.25".into(), "1234.5".into(), "1.00000e-7".into())
        );
    }
}
