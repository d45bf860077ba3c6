//! What this data could show: the candidates, and the places at which an effect would leave no
//! trace.

use nalgebra::Matrix6xX;

use super::fit::Candidate;
use super::problem::Problem;
use super::report::CannotSee;
use crate::effects::{Effect, Place};

/// A place seen less than this is not tried.
///
/// `visible` of an effect at a place is the root mean square over rows of what one unit of it does
/// to the measured quantities (m; rotations counted at the arm's reach, and parameters of other
/// units scaled by powers of it), relative to the place of the same effect at which that is
/// largest.
const LEAST_VISIBLE: f64 = 1e-3;

struct Look {
    place: Place,
    /// Of the measured components.
    measured: f64,
    /// Of all six.
    all: f64,
}

/// The places of each effect that this data can show, and those that it cannot.
pub(crate) fn candidates(
    problem: &Problem<'_>,
    effects: &[&'static dyn Effect],
) -> (Vec<Candidate>, Vec<CannotSee>) {
    let (mut seen, mut unseen) = (Vec::new(), Vec::new());
    for &effect in effects {
        let looks: Vec<Look> = effect
            .places(problem.arm)
            .into_iter()
            .map(|place| {
                let scales: Vec<f64> = effect
                    .parameters(problem.arm, place, problem.reach)
                    .iter()
                    .map(|p| p.scale)
                    .collect();
                let size = |blocks: &[Matrix6xX<f64>]| size(blocks, &scales, problem.reach);
                Look {
                    place,
                    measured: size(&problem.nominal(effect, place).blocks),
                    all: size(&problem.unmasked(effect, place)),
                }
            })
            .collect();
        let largest = |of: fn(&Look) -> f64| looks.iter().map(of).fold(0.0, f64::max);
        let (most_measured, most) = (largest(|l| l.measured), largest(|l| l.all));
        for Look { place, measured, all } in looks {
            let visible = if most_measured > 0.0 { measured / most_measured } else { 0.0 };
            if visible >= LEAST_VISIBLE {
                seen.push(Candidate {
                    effect,
                    place,
                    parameters: effect.parameters(problem.arm, place, problem.reach),
                    nominal: problem.nominal(effect, place),
                });
                continue;
            }
            let idle = all <= LEAST_VISIBLE * most;
            unseen.push(CannotSee {
                effect: effect.identifier(),
                place: place.to_string(),
                visible,
                because: if idle { effect.idle() } else { "it hardly moves what was measured" },
            });
        }
    }
    (seen, unseen)
}

/// Root mean square over rows.
fn size(blocks: &[Matrix6xX<f64>], scales: &[f64], reach: f64) -> f64 {
    let mut sum = 0.0;
    for block in blocks {
        for (column, scale) in block.column_iter().zip(scales) {
            for (k, entry) in column.iter().enumerate() {
                let lever = if k < 3 { 1.0 } else { reach };
                sum += (entry * scale * lever).powi(2);
            }
        }
    }
    (sum / blocks.len().max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::CATALOGUE;
    use crate::fixture::{rigid, row, table};
    use crate::measurement::Kind;
    use nalgebra::Vector6;

    /// Places that a displacement under `w`, measured in `components`, cannot show, and why.
    fn unseen(w: [f64; 6], components: [bool; 6]) -> Vec<(String, &'static str)> {
        let rows = vec![row(&[0.0, 0.4, -0.7], Vector6::from(w))];
        let data = table(rows, Kind::Displacement { components });
        let arm = rigid();
        let problem = Problem::new(&arm, &data).unwrap();
        let (seen, unseen) = candidates(&problem, &CATALOGUE);
        assert_eq!(seen.len() + unseen.len(), 3);
        assert!(unseen.iter().all(|u| u.visible < LEAST_VISIBLE));
        unseen.into_iter().map(|u| (u.place, u.because)).collect()
    }

    #[test]
    fn a_load_in_the_plane_does_not_reach_the_turntable() {
        let down = [0.0, 0.0, -500.0, 0.0, 0.0, 0.0];
        let idle = "no load of this data reaches the joint";
        assert_eq!(unseen(down, [true; 6]), [("joint 1".to_owned(), idle)]);
        let none = unseen([0.0; 6], [true; 6]);
        assert_eq!(none.len(), 3);
        assert!(none.iter().all(|(_, because)| *because == idle));
    }

    #[test]
    fn what_is_not_measured_is_not_seen() {
        let aside = [0.0, -500.0, -500.0, 0.0, 0.0, 0.0];
        let only_z = [false, false, true, false, false, false];
        let hardly = "it hardly moves what was measured";
        assert_eq!(unseen(aside, only_z), [("joint 1".to_owned(), hardly)]);
    }
}
