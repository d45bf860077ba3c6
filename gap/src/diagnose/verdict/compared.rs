//! Other models: columns of the file that predict what is measured.

use nalgebra::Vector6;

use super::bootstrap::{excludes_zero, mean_interval};
use crate::diagnose::options::DiagnoseError;
use crate::diagnose::report;
use crate::gap::{rms, row_gap};
use crate::measurement::{Dimension, ExtraColumn, Measurements, Unit};
use crate::simulate::Reading;

/// A rival's gap.
#[derive(Debug)]
pub(crate) struct Rival {
    name: String,
    /// Which of the six it predicts and the file measures: translations, or rotations if no
    /// translation.
    compared: Vec<usize>,
    /// Measured minus predicted, one per row.
    gaps: Vec<Vector6<f64>>,
}

impl Rival {
    /// Finds the columns `name_…` that predict what is measured.
    pub(crate) fn read(data: &Measurements, name: &str) -> Result<Rival, DiagnoseError> {
        let names = data.kind.names();
        let measured = data.kind.components();
        let mut predictions = vec![Vector6::zeros(); data.rows.len()];
        let mut given = [false; 6];
        for k in (0..6).filter(|&k| measured[k]) {
            let header = format!("{name}_{}", names[k]);
            let Some(column) = data.extra.iter().find(|e| e.name == header) else { continue };
            for (prediction, value) in predictions.iter_mut().zip(column_si(data, column, k)?) {
                prediction[k] = value;
            }
            given[k] = true;
        }
        let kind = |range: core::ops::Range<usize>| range.filter(|&k| given[k]).collect();
        let translations: Vec<usize> = kind(0..3);
        let rotations: Vec<usize> = kind(3..6);
        // Some of three rotations cannot be compared as a rotation.
        let whole = measured[3..] != [true; 3] || rotations.len() == 3;
        let compared = match (translations.is_empty(), rotations.is_empty() || !whole) {
            (false, _) => translations,
            (true, false) => rotations,
            (true, true) => return Err(missing(data, name)),
        };
        let gaps = data.rows.iter().zip(&predictions);
        let gaps = gaps.map(|(row, p)| row_gap(data, row, &Reading::from_vector(p))).collect();
        Ok(Rival { name: name.to_owned(), compared, gaps })
    }

    /// Against our held-out gaps, pose by pose, of the rows that fit.
    pub(crate) fn compare(
        &self,
        data: &Measurements,
        fits: &[bool],
        ours: &[Vector6<f64>],
        seed: u64,
    ) -> report::Rival {
        let size =
            |gap: &Vector6<f64>| self.compared.iter().map(|&k| gap[k] * gap[k]).sum::<f64>().sqrt();
        let sizes = |gaps: &[Vector6<f64>]| -> Vec<f64> {
            gaps.iter().zip(fits).filter(|(_, fits)| **fits).map(|(gap, _)| size(gap)).collect()
        };
        let (theirs, ours) = (sizes(&self.gaps), sizes(ours));
        let mut differences = vec![0.0; data.poses];
        let mut rows = vec![0.0; data.poses];
        let fitting = data.rows.iter().zip(fits).filter(|(_, fits)| **fits).map(|(row, _)| row);
        for ((row, theirs), ours) in fitting.zip(&theirs).zip(&ours) {
            differences[row.group] += theirs * theirs - ours * ours;
            rows[row.group] += 1.0;
        }
        let ci95 = mean_interval(&differences, &rows, seed);
        report::Rival {
            name: self.name.clone(),
            rms: rms(&theirs),
            held_out_rms: rms(&ours),
            mean_square_gain: differences.iter().sum::<f64>() / ours.len() as f64,
            ci95,
            significant: excludes_zero(ci95),
        }
    }
}

fn column_si(
    data: &Measurements,
    column: &ExtraColumn,
    component: usize,
) -> Result<Vec<f64>, DiagnoseError> {
    let dimension = if component < 3 { Dimension::Length } else { Dimension::Angle };
    let (number, header) = (column.column.number, column.column.header.clone());
    let unit = match &column.unit {
        None => dimension.si(),
        Some(found) => match Unit::named(found).filter(|u| u.dimension == dimension) {
            Some(unit) => unit,
            None => {
                return Err(DiagnoseError::RivalUnit {
                    file: data.file.clone(),
                    number,
                    header,
                    found: found.clone(),
                    expected: dimension.units(),
                });
            }
        },
    };
    let wrong = |line: u64, found: String| DiagnoseError::RivalCell {
        file: data.file.clone(),
        line,
        number,
        header: header.clone(),
        found,
    };
    let values = column.values.as_ref().map_err(|(line, found)| wrong(*line, found.clone()))?;
    let each = values.iter().zip(&data.rows).map(|(value, row)| {
        let si = Some(unit.to_si(*value)).filter(|si| si.abs() < 1e100);
        si.ok_or_else(|| wrong(row.line, format!("{value:e}")))
    });
    each.collect()
}

fn missing(data: &Measurements, rival: &str) -> DiagnoseError {
    let names = data.kind.names();
    let measured = data.kind.components();
    let expected = (0..6).filter(|&k| measured[k]).map(|k| format!("`{rival}_{}`", names[k]));
    let mut known: Vec<String> = Vec::new();
    for column in &data.extra {
        let Some((prefix, component)) = column.name.rsplit_once('_') else { continue };
        let prefix = format!("`{prefix}`");
        if names.contains(&component) && !known.contains(&prefix) {
            known.push(prefix);
        }
    }
    DiagnoseError::NoRival {
        file: data.file.clone(),
        rival: rival.to_owned(),
        expected: expected.collect::<Vec<_>>().join(" or "),
        known: known.join(", "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::layout;

    fn data(text: &str) -> Measurements {
        Measurements::from_bytes("run.csv", text.as_bytes(), &layout(1)).unwrap()
    }

    #[test]
    fn a_rival_is_compared_in_si_on_what_it_predicts() {
        let data = data("q1,dx[mm],dy[mm],alt_dy[um]\n0.1,5,2,1000\n0.2,5,4,5000\n");
        let rival = Rival::read(&data, "alt").unwrap();
        let ours = vec![Vector6::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0); 2];
        let report = rival.compare(&data, &[true; 2], &ours, 0);
        assert!((report.rms - 1e-3).abs() < 1e-15);
        assert_eq!(report.held_out_rms, 0.0);
        assert!((report.mean_square_gain - 1e-6).abs() < 1e-15);
        assert!(report.significant);
    }

    #[test]
    fn mistakes_of_a_rival_are_named() {
        let error = |text: &str| Rival::read(&data(text), "alt").unwrap_err().to_string();
        let none = error("q1,dy,ycd_dy,speed\n0.1,2,1,1\n");
        assert_eq!(
            none,
            "run.csv: found no column that predicts what is measured for the rival `alt`, expected \
             `alt_dy`; the file has predictions of `ycd`"
        );
        let cell = error("q1,dy,alt_dy\n0.1,2,1\n0.1,2,?\n");
        assert!(cell.starts_with("run.csv: line 3, column 3 `alt_dy`: found `?`"), "{cell}");
        assert!(error("q1,dy,alt_dy\n0.1,2,nan\n").contains("found `nan`"));
        let unit = error("q1,dy,alt_dy[deg]\n0.1,2,1\n");
        assert!(unit.contains("found the unit `deg`, expected one of m, mm, um, in"), "{unit}");
    }
}
