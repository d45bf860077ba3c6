//! How far the gap really shrinks at poses that the diagnosis has never met.

use nalgebra::Vector6;

use super::bench::difference;
use super::exact;
use crate::diagnose::Diagnosis;
use crate::effects::Catalogue;
use crate::measurement::Measurements;
use crate::plant::Truth;
use crate::whole::Whole;

/// What the arm with a diagnosis' findings is predicted to read in each row of a design; `None`
/// where the findings do not say. Only position and orientation as a file has them.
pub type Predict<'a> = dyn Fn(&Diagnosis, &Measurements) -> Option<Vec<Vector6<f64>>> + Sync + 'a;

/// The prediction of a plant that has the findings, with the values that were found: what they mean
/// by the definition of the effects, whatever the diagnosis itself makes of them.
pub fn with_findings<'a>(
    whole: impl Into<Whole<'a>>,
    catalogue: &'a Catalogue,
) -> impl Fn(&Diagnosis, &Measurements) -> Option<Vec<Vector6<f64>>> + Sync + 'a {
    let whole = whole.into();
    move |found, design| {
        let truths: Option<Vec<Truth>> = found
            .findings
            .iter()
            .map(|finding| {
                let effect = catalogue.named(&finding.effect)?;
                let place = finding.place.parse().ok()?;
                let values = finding.parameters.iter().filter(|p| p.value != 0.0);
                let values = values.map(|p| (p.name.to_string(), p.value)).collect();
                Some(Truth { effect, place, values })
            })
            .collect();
        let exact = exact(whole, &truths?, None, design).ok()?;
        Some(exact.rows.into_iter().map(|row| row.measured).collect())
    }
}

/// Sums of squares over rows, measured less nominal and measured less predicted: in position, or in
/// rotation where no position is measured.
pub(super) fn squares(
    measured: &Measurements,
    nominal: &Measurements,
    predicted: &[Vector6<f64>],
) -> [f64; 2] {
    let components = measured.kind.components();
    let range = if components[..3].contains(&true) { 0..3 } else { 3..6 };
    let square = |row: &Vector6<f64>, expected: &Vector6<f64>| -> f64 {
        let off = difference(row, expected, components);
        range.clone().filter(|k| components[*k]).map(|k| off[k] * off[k]).sum()
    };
    let rows = || measured.rows.iter().map(|row| &row.measured);
    let before = rows().zip(&nominal.rows).map(|(row, n)| square(row, &n.measured)).sum();
    let after = rows().zip(predicted).map(|(row, p)| square(row, p)).sum();
    [before, after]
}
