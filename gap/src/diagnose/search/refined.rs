//! A candidate as a part of the model, a jump at the best of all moments near its own.

use super::forward::{Explained, Search};
use crate::diagnose::fit::Fitted;
use crate::diagnose::normal_equations::{Candidate, Kept, Screen};
use crate::effects::{Forms, Spot};
use crate::infer::{Ranked, Score};

/// Moments of a jump that are tried at once; of more, an even choice, and then those about the best.
const MOST_NEAR: usize = 256;

impl Search<'_, '_> {
    /// The candidate as a part of the model; a jump at the best of all rows near its own.
    pub(crate) fn refined(
        &self,
        now: &Explained,
        without: &[usize],
        one: &Ranked,
        screen: &Screen<'_>,
    ) -> Option<Fitted> {
        let candidate = &screen.candidates[one.candidate];
        let (effect, spot) = candidate.effect()?;
        let fitted = |spot: Spot, score: &Score| {
            candidate.fitted(spot, score.values.iter().copied().collect())
        };
        if !matches!(effect.forms_are(), Forms::Searched { .. }) {
            return fitted(spot, &one.score);
        }
        let forms = effect.forms(self.problem.arm, spot.place, self.problem.data);
        let at = forms.iter().position(|f| *f == spot.form).unwrap_or(0);
        let from = at.checked_sub(1).map_or(1, |k| forms[k] + 1);
        // Beyond the last as far as to the one before it.
        let to = forms.get(at + 1).copied().unwrap_or(2 * spot.form + 1 - from);
        let (mut from, mut to) = (from, to);
        loop {
            let every = (to - from).div_ceil(MOST_NEAR).max(1);
            let near: Vec<Candidate> = (from..to)
                .step_by(every)
                .map(|form| Candidate::of(self.problem, effect, Spot { form, ..spot }, forms.len()))
                .collect();
            let kept = Kept { without, whole: true, ..Kept::default() };
            let finer = self.screen_of(now, &self.gather(now, &[], &near), kept, &near);
            let scores = (0..near.len()).map(|c| (c, finer.score(c)));
            let best = scores.max_by(|a, b| a.1.drop.total_cmp(&b.1.drop));
            let (at, score) =
                best.and_then(|(c, score)| near[c].effect().map(|(_, at)| (at, score)))?;
            if every == 1 {
                return fitted(at, &score);
            }
            (from, to) = (from.max(at.form.saturating_sub(every - 1)), to.min(at.form + every));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::{Options, diagnose};
    use crate::fixture::{rigid, row, springy, table};
    use crate::measurement::{Kind, Row};
    use crate::simulate::simulate;
    use nalgebra::Vector6;
    use stiffarm_plant::design::{Design, Shape};
    use stiffarm_plant::{Noise, Plant, Truth};

    #[test]
    fn a_jump_among_very_many_rows_is_placed_at_its_row() {
        let (arm, after) = (rigid(), 1234);
        let kind = Kind::Pose { orientation: false };
        // More rows between two of the moments that are tried at first than are tried at once.
        let rows = (0..24 * MOST_NEAR).map(|k| {
            let at = k as f64;
            let q = [(0.7 * at).sin(), (1.3 * at).cos(), (2.1 * at).sin()];
            let mut row = Row { group: k, ..row(&q, Vector6::zeros()) };
            let read = simulate(&arm, &row, kind).unwrap().reading().vector();
            let jump = if k < after { 0.0 } else { 3e-4 };
            let noise = Vector6::from_fn(|c, _| 1e-5 * (91.7 * at + 7.0 * c as f64).sin());
            row.measured =
                (read + noise).component_mul(&Vector6::new(1.0, 1.0, 1.0, 0.0, 0.0, 0.0));
            row.measured.y += jump;
            row
        });
        let data = table(rows.collect(), kind);
        let options = Options { effects: Some(vec!["slip".to_owned()]), ..Options::default() };
        let found = diagnose(&arm, &data, &options).unwrap().findings;
        assert_eq!((&*found[0].effect, found[0].place.as_str()), ("slip", "base"));
        assert_eq!(found[0].parameters[0].value, after as f64);
    }

    /// Found by another program's arm: numbers between those that are tried at first.
    #[test]
    fn numbers_in_which_nothing_is_linear_are_found() {
        let mut arm = springy();
        arm.joints[2].drive.gear = 101.0;
        let design = Design {
            shape: Shape::Force,
            poses: 60,
            repeats: 1,
            payload: 15.0,
            kind: Kind::Pose { orientation: true },
            seed: 3,
        };
        let noise = Noise { position: 2e-5, rotation: 4e-5 };
        let cases = [
            ("motor_error@joint 3:order=202.37,cos=0.2 mrad,sin=-0.3 mrad", 202.37, 0.02),
            ("soft_zone@joint 2:threshold=40,compliance=1e-5", 40.0, 1.0),
        ];
        for (text, number, within) in cases {
            let truth = Truth::parse(text, &arm).unwrap();
            let plant = Plant::new(&arm, std::slice::from_ref(&truth)).unwrap();
            let data = plant.measure(&design.rows(&arm), noise, 5).unwrap();
            let options = Options {
                noise_position: Some(noise.position),
                noise_rotation: Some(noise.rotation),
                ..Options::default()
            };
            let found = diagnose(&arm, &data, &options).unwrap().findings;
            let [finding] = &found[..] else { panic!("{text}: {found:?}") };
            let (effect, place) = (truth.effect.identifier(), truth.place.to_string());
            assert_eq!((&*finding.effect, &finding.place), (effect, &place));
            let first = &finding.parameters[0];
            assert!((first.value - number).abs() < within, "{text}: {first:?}");
            assert!((first.ci95[0]..=first.ci95[1]).contains(&number), "{text}: {first:?}");
            for parameter in &finding.parameters[1..] {
                let [low, high] = parameter.ci95;
                assert!((low..=high).contains(&truth.value(&parameter.name)), "{parameter:?}");
            }
        }
    }
}
