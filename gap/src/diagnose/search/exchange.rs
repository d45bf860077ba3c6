//! A campaign as [`Observations`]: what may stand in place of what was found.

use nalgebra::{DMatrix, DVector};

use super::forward::{Explained, Search};
use crate::diagnose::fit::{Fitted, Model, normal_equations, prior_penalty, squares};
use crate::diagnose::normal_equations::{Candidate, Kept, Screen};
use crate::diagnose::options::DiagnoseError;
use crate::infer::{Observations, Ranked, Scale, Terms, Weighed};

impl Observations for Search<'_, '_> {
    type Fit = Explained;
    type Candidate = Candidate;
    type Error = DiagnoseError;

    fn stopped(&self) -> bool {
        self.problem.stop.is_asked()
    }

    fn beside(&self, now: &Explained, without: &[usize]) -> Screen<'_> {
        self.screen(now, Kept { without, whole: true, ..Kept::default() })
    }

    fn scale(&self, now: &Explained) -> Scale {
        let numbers = self.problem.numbers() + self.problem.springs.len();
        Scale { known: now.noise.is_known(), numbers, independent: 1.0 }
    }

    fn left_by(&self, now: &Explained, by: &Explained) -> f64 {
        squares(self.problem, &now.fit.predicted.gaps, &by.weights)
            + prior_penalty(self.problem, &now.fit.model)
    }

    fn normal(&self, now: &Explained) -> DMatrix<f64> {
        let Some(gathered) = now.gathered.get() else {
            return normal_equations(self.problem, &now.fit, &now.weights).0;
        };
        let mut normal = gathered.total.zz.clone();
        let mut right = DVector::zeros(normal.nrows());
        now.fit.model.hold(self.problem, &mut normal, &mut right);
        normal
    }

    fn terms<'f>(&'f self, now: &'f Explained) -> Terms<'f> {
        let weighed = |found: &'f Fitted| Weighed {
            values: &found.values,
            usual: &found.usual,
            is_tolerated: found.effect.is_tolerated(),
            is_proportional: true,
            margin: found.margin,
        };
        Terms {
            nuisances: Model::nuisances(self.problem),
            along: Model::along(self.problem),
            each: now.fit.model.found.iter().map(weighed).collect(),
        }
    }

    fn replacing<'n>(
        &'n self,
        now: &'n Explained,
        without: &'n [usize],
    ) -> Box<dyn Fn(&Ranked) -> bool + 'n> {
        let found = &now.fit.model.found;
        // One effect is no other than itself, but one order of a periodic error is not another; of two
        // that one might do for, it may be one of them.
        let is_it = |candidate: &Candidate| {
            let one = candidate.effect();
            let found = &found[without[0]];
            without.len() == 1
                && one.is_some_and(|(effect, spot)| {
                    let same = !candidate.forms_are_orders() || spot.form == found.spot.form;
                    effect == found.effect && spot.place == found.spot.place && same
                })
        };
        let resolved = self.resolved();
        Box::new(move |one| {
            let candidate = &self.candidates[one.candidate];
            let others = found.iter().enumerate().filter(|(k, _)| !without.contains(k));
            !is_it(candidate) && candidate.is_apart(&resolved, others.map(|(_, f)| f))
        })
    }

    fn is_pair(&self, now: &Explained, pair: [usize; 2]) -> bool {
        let found = &now.fit.model.found;
        pair.iter().all(|k| !found[*k].effect.forms_are().is_fine(found[*k].spot.form))
    }

    fn replaced(
        &self,
        now: &Explained,
        without: &[usize],
        by: Option<(&Ranked, &Screen<'_>)>,
        below: f64,
    ) -> Result<Option<Explained>, DiagnoseError> {
        let refined = by.and_then(|(one, screen)| self.refined(now, without, one, screen));
        let added = refined.into_iter().collect();
        let Some(fit) = self.with(now, without, added, below)? else { return Ok(None) };
        if let Some((one, _)) = by
            && self.lingers(now, &fit, one)?
        {
            return Ok(None);
        }
        self.converged(fit, now.weights).map(Some)
    }

    fn note_margin(&self, now: &mut Explained, term: usize, margin: f64) {
        now.fit.model.found[term].margin = margin;
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector6;

    use super::*;
    use crate::diagnose::Options;
    use crate::diagnose::data::{Folds, Problem};
    use crate::diagnose::fit::Model;
    use crate::diagnose::normal_equations::{Candidate, scale_elastic};
    use crate::effects::{CATALOGUE, Place, Spot};
    use crate::fixture::{rigid, row, table};
    use crate::infer::pruned;
    use crate::measurement::{Kind, Row};
    use crate::noisy::normal;
    use crate::rng::{Rng, Stream};
    use crate::simulate::simulate;

    /// All loads are a tenth larger than the file says. Of an arm that gives at two joints a compliance
    /// more at each does nearly the same: no one of the two is superfluous, and none can be exchanged
    /// alone.
    #[test]
    fn two_findings_that_one_explains_are_exchanged_for_it() {
        let mut arm = rigid();
        (arm.joints[0].compliance, arm.joints[1].compliance) = (2e-5, 3e-5);
        arm.joints.iter_mut().for_each(|joint| joint.mass = 0.0);
        let mut rng = Rng::new(8, Stream::Signs);
        let kind = Kind::Pose { orientation: true };
        let rows = (0..40).map(|group| {
            let mut any = |scale: f64| scale * normal(&mut rng);
            let q = [any(1.0), any(0.7), any(0.7)];
            let wrench = Vector6::from_fn(|k, _| any(if k < 3 { 60.0 } else { 5.0 }));
            let real = simulate(&arm, &row(&q, wrench * 1.1), kind).unwrap().reading().vector();
            let measured = real.map(|x| x + any(1e-6));
            Row { group, measured, ..row(&q, wrench) }
        });
        let data = table(rows.collect(), kind);
        let options = Options::default();
        let problem = Problem::new(&arm, &data, &options).unwrap();
        let folds = Folds::deal(&data, &options).unwrap();
        let mut candidates = Candidate::all(&problem, &CATALOGUE);
        scale_elastic(&mut candidates, &problem, &Model::nominal(&problem)).unwrap();
        let search = Search {
            problem: &problem,
            folds: &folds,
            candidates: &candidates,
            options: &options,
            progress: &|_| {},
        };
        let mut model = Model::nominal(&problem);
        for number in [1, 2] {
            let spot = Spot { place: Place::Joint(number), form: 0 };
            let own = candidates.iter().find(|c| {
                c.effect().is_some_and(|(e, s)| e.identifier() == "joint_compliance" && s == spot)
            });
            model.found.extend(own.unwrap().fitted(spot, vec![1e-6]));
        }
        let names = |now: &Explained| {
            let each = now.fit.model.found.iter().map(|f| f.effect.identifier());
            each.collect::<Vec<_>>()
        };
        let begun = search.begin(model).unwrap();
        let alone = pruned(&search, begun.clone(), false).unwrap();
        assert_eq!(names(&alone), ["joint_compliance"; 2]);
        assert_eq!(names(&pruned(&search, begun, true).unwrap()), ["wrench_scale"]);
    }
}
