//! Whether what is left is noise, and how well the numbers are told from each other.

use stiffarm_gap::diagnose::Observability;

use super::Report;
use super::page::percent;

/// The numbers that were fitted.
pub struct Known {
    /// How many there are and how well the data decide them.
    pub said: String,
    /// The matrix: what each row is, and its cells; none of one number alone.
    pub rows: Vec<(String, Vec<Cell>)>,
    /// Pairs with what was fitted along among them, the most correlated first.
    pub pairs: Vec<String>,
}

/// A correlation.
pub struct Cell {
    /// With its sign.
    pub text: String,
    /// Its size in percent: how dark it is.
    pub size: String,
}

/// What is said of the shape and the order of what is left.
pub fn left(report: &Report<'_>) -> Vec<String> {
    let Some(residual) = &report.found.residual else { return Vec::new() };
    let shape = residual.normality.as_ref().map(|shape| {
        format!(
            "Normal numbers are as far from the line in {} of campaigns (Anderson and Darling’s \
             test); the excess kurtosis is {}, 0 of normal numbers and positive of heavy tails.",
            chance(shape.p_value),
            signed(shape.excess_kurtosis),
        )
    });
    let order = residual.autocorrelation.as_ref().map(|order| {
        format!(
            "What is left at one visit correlates with what is left at the next by {}; by chance as \
             much is there in {} of campaigns.",
            signed(order.lag_1),
            chance(order.p_value),
        )
    });
    shape.into_iter().chain(order).collect()
}

/// How well the numbers are known; `None` where none was fitted.
pub fn known(report: &Report<'_>) -> Option<Known> {
    let Observability { parameters, decided, condition, correlations, matrix, .. } =
        report.found.observability.as_ref()?;
    let all = if decided == parameters { "all of them".to_owned() } else { decided.to_string() };
    let numbers = if *parameters == 1 { "number was" } else { "numbers were" };
    let said = format!(
        "{parameters} {numbers} fitted, frames and effects together; the data decide {all}, with a \
         condition of {condition:.0}."
    );
    let several = matrix.of.len() > 1;
    let rows = matrix.of.iter().zip(&matrix.rows).filter(|_| several);
    let cell = |value: &f64| {
        // No darker than what is written upon it can be read.
        Cell { text: signed(*value), size: format!("{:.0}%", 60.0 * value.abs()) }
    };
    let pair = |pair: &stiffarm_gap::diagnose::Correlation| {
        format!("{} with {}: {}", plain(&pair.of), plain(&pair.with), signed(pair.correlation))
    };
    let within = |name: &String| several && matrix.of.contains(name);
    let beyond = correlations.iter().filter(|p| !(within(&p.of) && within(&p.with)));
    Some(Known {
        said,
        rows: rows.map(|(name, row)| (plain(name), row.iter().map(cell).collect())).collect(),
        pairs: beyond.map(pair).collect(),
    })
}

/// `compliance of joint compliance at joint 2`.
fn plain(name: &str) -> String {
    name.replace('_', " ")
}

fn signed(x: f64) -> String {
    format!("{x:.2}").replacen('-', "−", 1)
}

fn chance(p: f64) -> String {
    if p < 5e-3 { "less than 1 %".to_owned() } else { percent(p) }
}
