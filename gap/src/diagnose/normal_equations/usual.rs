//! What is usual of what gives: nobody knows a compliance of arms of any size, but everybody how far arms
//! give.

use std::borrow::Cow;

use super::candidate::Candidate;
use crate::diagnose::data::Problem;
use crate::diagnose::fit::Model;
use crate::diagnose::options::DiagnoseError;
use crate::infer::limits::SOME_ROWS;
use crate::parallel;
use crate::simulate::Sim;

/// An arm's tool hardly moves by more than this part of its reach because something gives (by so many
/// radians, where no position is measured).
const PART: f64 = 5e-3;

/// Takes as usual of every number that has no size of its own what moves the reading so far,
/// root mean square over the rows.
pub(crate) fn scale_elastic(
    candidates: &mut [Candidate],
    problem: &Problem<'_>,
    model: &Model,
) -> Result<(), DiagnoseError> {
    let is_open =
        |candidate: &Candidate| candidate.effect().is_some() && candidate.usual.held.contains(&0.0);
    let predicted = model.predict(problem, None)?;
    // A load that is mistyped says nothing of how far arms give.
    let kept: Vec<usize> = (0..problem.data.rows.len()).filter(|row| problem.fits[*row]).collect();
    let rows = kept.iter().step_by(kept.len().div_ceil(SOME_ROWS).max(1));
    let rows: Vec<(usize, Cow<'_, Sim>)> = rows
        .map(|row| Ok((*row, model.state(problem, &predicted, *row)?)))
        .collect::<Result<_, _>>()?;
    let (first, most) = match problem.measures_position() {
        true => (0, PART * problem.reach),
        false => (3, PART),
    };
    parallel::change(candidates, &|candidate| {
        if !is_open(candidate) {
            return;
        }
        let mut squares = vec![0.0; candidate.size];
        for (row, sim) in &rows {
            let block = model.change(problem, sim, *row, |s| candidate.block(s));
            for (sum, column) in squares.iter_mut().zip(block.column_iter()) {
                let moved = column.component_mul(&problem.mask);
                *sum += moved.fixed_rows::<3>(first).norm_squared();
            }
        }
        for (k, squares) in squares.into_iter().enumerate() {
            let moved = (squares / rows.len() as f64).sqrt();
            if candidate.usual.held[k] == 0.0 && moved > 0.0 {
                candidate.set_usual(k, most / moved);
            }
        }
    });
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::Options;
    use crate::effects::{CATALOGUE, Place};
    use crate::fixture::springy;
    use crate::infer::constants::LOOSE;
    use crate::measurement::Measurements;
    use crate::noisy::data;
    use stiffarm_kernels::generic::Arm;

    /// A softer joint under the same loads: what is usual moves the tool as far as it should.
    #[test]
    fn what_is_usual_moves_the_tool_by_its_part_of_the_reach() {
        let (arm, data) = (springy(), data(30, [0.0; 3], 0.0, 7));
        let problem = problem_of(&arm, &data);
        let model = Model::nominal(&problem);
        let mut candidates = Candidate::all(&problem, &CATALOGUE);
        scale_elastic(&mut candidates, &problem, &model).unwrap();
        let own = candidates.iter().find(|c| {
            let effect = c.effect().map(|(effect, spot)| (effect.identifier(), spot.place));
            effect == Some(("joint_compliance", Place::Joint(2)))
        });
        let usual = 1.0 / (LOOSE * own.unwrap().usual.held[0]);
        let mut softer = arm.clone();
        // A hundredth of it, where the arm gives in proportion.
        softer.joints[1].compliance += usual / 100.0;
        let soft = problem_of(&softer, &data);
        let gaps = Model::nominal(&soft).predict(&soft, None).unwrap().gaps;
        let before = model.predict(&problem, None).unwrap().gaps;
        let moved =
            gaps.iter().zip(&before).map(|(a, b)| (a - b).fixed_rows::<3>(0).norm_squared());
        let rms = (moved.sum::<f64>() / gaps.len() as f64).sqrt();
        assert!(
            (100.0 * rms / (PART * problem.reach) - 1.0).abs() < 0.05,
            "{rms} {}",
            problem.reach
        );
    }

    fn problem_of<'a>(arm: &'a Arm, data: &'a Measurements) -> Problem<'a> {
        Problem::new(arm, data, &Options::default()).unwrap()
    }
}
