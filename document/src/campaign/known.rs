//! Whether the residuals are noise, and how well the parameters are told from each other.

use stiffarm_gap::diagnose::{Correlation, Observability};

use super::Campaign;
use crate::text::{counted, fixed};
use crate::words::{percent, words};
use crate::{Block, Cell, Table};

impl Campaign<'_> {
    /// How the residuals are distributed and correlated, a sentence each.
    pub(super) fn normality(&self) -> Vec<String> {
        let Some(residual) = &self.found.residual else { return Vec::new() };
        let shape = residual.normality.as_ref().map(|shape| {
            format!(
                "Normal residuals depart as far from the line in {} of campaigns (Anderson-Darling test). The \
                 excess kurtosis is {}; it is 0 of normal residuals and positive of heavy tails.",
                chance(shape.p_value),
                fixed(shape.excess_kurtosis, 2),
            )
        });
        let order = residual.autocorrelation.as_ref().map(|order| {
            format!(
                "The residuals of successive visits have a correlation of {}; white noise has one as large in {} of \
                 campaigns.",
                fixed(order.lag_1, 2),
                chance(order.p_value),
            )
        });
        shape.into_iter().chain(order).collect()
    }
}

/// How well the parameters are determined; `None` where none was fitted.
pub fn known(campaign: &Campaign<'_>) -> Option<Block> {
    let Observability { parameters, decided, condition, correlations, matrix, .. } =
        campaign.found.observability.as_ref()?;
    let all = if decided == parameters { "all of them".to_owned() } else { decided.to_string() };
    let said = format!(
        "Frames and effects have {}, which are fitted together; the data determine {all}. The condition number is \
         {condition:.0}.",
        counted(*parameters, "parameter"),
    );
    let several = matrix.of.len() > 1;
    let mut blocks = vec![Block::Paragraph(said)];
    if several {
        let numbers = (1..=matrix.of.len()).map(|k| k.to_string());
        let heads = std::iter::once("correlations".to_owned()).chain(numbers).collect();
        let row = |(k, (name, row)): (usize, (&String, &Vec<f64>))| {
            let name = Cell::Text(format!("{} {}", k + 1, words(name)));
            std::iter::once(name).chain(row.iter().map(|x| Cell::Shade(*x, fixed(*x, 2)))).collect()
        };
        let rows = matrix.of.iter().zip(&matrix.rows).enumerate().map(row).collect();
        blocks.push(Block::Table(Table { heads, rows, caption: String::new() }));
    }
    let within = |name: &String| several && matrix.of.contains(name);
    let pair = |pair: &Correlation| {
        format!("{} with {}: {}", words(&pair.of), words(&pair.with), fixed(pair.correlation, 2))
    };
    let beyond = correlations.iter().filter(|p| !(within(&p.of) && within(&p.with)));
    let pairs: Vec<String> = beyond.map(pair).collect();
    if !pairs.is_empty() {
        blocks.push(Block::section(
            "Strongest correlations with nuisance parameters",
            vec![Block::List(pairs)],
        ));
    }
    Some(Block::section("How well the parameters are determined", blocks))
}

fn chance(p: f64) -> String {
    if p < 5e-3 { "less than 1 %".to_owned() } else { percent(p) }
}
