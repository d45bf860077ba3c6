//! How well what was fitted is known at other rows, as it is saved: what a diagnosis that was written, and is
//! read again, has to know beside its robot.

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::explanation::Explanation;
use super::spread::Spread;
use crate::diagnose::data::Problem;
use crate::diagnose::fit::Model;
use crate::diagnose::normal_equations::Candidate;
use crate::diagnose::options::{DiagnoseError, Nuisance, Options};
use crate::effects::{Catalogue, Depends, Spot, file_name};
use crate::measurement::Measurements;
use crate::whole::Whole;

/// What was fitted, and how it scatters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trust {
    /// The file that was diagnosed.
    file: String,
    /// Identifiers of the frames that were fitted along.
    frames: Vec<String>,
    /// The effects.
    effects: Vec<Fitted>,
    /// Row by row a matrix whose product with its transpose is the covariance of the frames' numbers and
    /// the effects', in their order.
    root: Vec<Vec<f64>>,
    /// Variance that is left of each measured number, m² and rad².
    left: [f64; 6],
    /// The largest leverage of a row that was fitted.
    leverage: f64,
}

/// An effect of which numbers were fitted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Fitted {
    effect: String,
    place: String,
    form: usize,
}

impl Explanation {
    /// What of it is saved beside the robot.
    pub fn trust(&self) -> Trust {
        let effect = |found: &crate::diagnose::fit::Fitted| Fitted {
            effect: found.effect.identifier().to_owned(),
            place: found.spot.place.to_string(),
            form: found.spot.form,
        };
        let rows = self.spread.root.row_iter();
        Trust {
            file: file_name(&self.file).to_owned(),
            frames: self.nuisances.iter().map(|frame| frame.identifier().to_owned()).collect(),
            effects: self.after.found.iter().map(effect).collect(),
            root: rows.map(|row| row.iter().copied().collect()).collect(),
            left: self.spread.left.into(),
            leverage: self.spread.leverage,
        }
    }
}

impl Trust {
    /// Whether each row's leverage is no larger than that of a row that was fitted; `whole` is the arm with
    /// what was found. What was saved of another catalogue holds nowhere.
    ///
    /// # Errors
    /// [`DiagnoseError`] of the data.
    pub fn holds(
        &self,
        whole: Whole<'_>,
        catalogue: &Catalogue,
        data: &Measurements,
    ) -> Result<Vec<bool>, DiagnoseError> {
        let nuisances = self.frames.iter().map(|frame| Nuisance::parse(frame));
        let nuisances = nuisances.collect::<Result<_, _>>()?;
        let options = Options { nuisances, known: whole.known.to_vec(), ..Options::default() };
        let problem = Problem::new(whole.arm, data, &options)?;
        let mut model = Model::nominal(&problem);
        let mut numbers: Vec<usize> = (0..6 * problem.nuisances.len()).collect();
        let mut next = numbers.len();
        for fitted in &self.effects {
            let named = catalogue.named(&fitted.effect).zip(fitted.place.parse().ok());
            let Some((effect, place)) = named else { return Ok(vec![false; data.rows.len()]) };
            let spot = Spot { place, form: fitted.form };
            let candidate = Candidate::of(&problem, effect, spot, 1);
            let own = next..next + candidate.size;
            next = own.end;
            // What happened at a time is carried to no other file.
            if effect.depends() != Depends::Session || file_name(&data.file) == self.file {
                numbers.extend(own);
                model.found.extend(candidate.fitted(spot, vec![0.0; candidate.size]));
            }
        }
        let Some(spread) = self.spread(next) else { return Ok(vec![false; data.rows.len()]) };
        let predicted = model.predict(&problem, None)?;
        let holds = |row| spread.covers(&problem, &model, &predicted, row, &numbers);
        Ok((0..data.rows.len()).map(holds).collect())
    }

    /// Of so many numbers; `None` if others were saved.
    fn spread(&self, numbers: usize) -> Option<Spread> {
        let rank = self.root.first().map_or(0, Vec::len);
        let is_whole = self.root.len() == numbers && self.root.iter().all(|row| row.len() == rank);
        is_whole.then(|| Spread {
            root: DMatrix::from_fn(numbers, rank, |r, c| self.root[r][c]),
            left: self.left.into(),
            leverage: self.leverage,
        })
    }
}
