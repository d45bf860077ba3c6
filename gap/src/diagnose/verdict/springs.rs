//! The springs of the joints: what the rows tell of each, found or not, and everything else beside those
//! that a log tells too.

use crate::diagnose::data::Problem;
use crate::diagnose::fit::{Fitted, Model};
use crate::diagnose::normal_equations::Candidate;
use crate::diagnose::options::DiagnoseError;
use crate::diagnose::search::{Explained, Search};
use crate::effects::{JOINT_SPRING, Place, Spot};
use crate::spring::{Joined, Spring};

impl Search<'_, '_> {
    /// Of each joint, as the rows alone have it: its spring among what was found, or what it would be beside that.
    pub(crate) fn springs(&self, now: &Explained) -> Result<Vec<Spring>, DiagnoseError> {
        let arm = self.problem.arm;
        let problem = Problem { springs: Vec::new(), ..self.problem.clone() };
        let alone = Search { problem: &problem, ..*self };
        let now = &alone.begin(now.fit.model.clone())?;
        let mut springs = Vec::new();
        for joint in 0..arm.dof() {
            let found = now.fit.model.found.iter().any(|f| f.is_spring_of(joint));
            let with = match found {
                true => now.clone(),
                false => alone.begin(self.with_spring(now.fit.model.clone(), joint, 0.0))?,
            };
            let model = &with.fit.model;
            let Some(at) = model.found.iter().position(|f| f.is_spring_of(joint)) else { continue };
            let before = model.found[..at].iter().map(|f| f.values.len()).sum::<usize>();
            let certainty = alone.certainty(&with);
            let half = certainty.half[Model::nuisances(self.problem) + before];
            // What the rows do not decide has no interval.
            if half > 0.0 {
                let whole = arm.joints[joint].compliance + model.found[at].values[0];
                springs.push(Spring::new(joint, whole, half, found));
            }
        }
        Ok(springs)
    }

    /// The same with the springs that a log has found: what the rows do not confirm goes again.
    pub(crate) fn with_springs_of_log(&self, begun: Explained) -> Result<Explained, DiagnoseError> {
        let mut model = begun.fit.model.clone();
        for spring in self.problem.springs.iter().filter(|spring| spring.found) {
            let own = self.problem.arm.joints[spring.joint].compliance;
            model = self.with_spring(model, spring.joint, spring.value.max(0.0) - own);
        }
        if model.found.len() == begun.fit.model.found.len() { Ok(begun) } else { self.begin(model) }
    }

    /// The model with a joint's spring in it, as much beyond the robot file's.
    fn with_spring(&self, mut model: Model, joint: usize, more: f64) -> Model {
        let spot = Spot::at(Place::Joint(joint + 1));
        let candidate = Candidate::of(self.problem, JOINT_SPRING, spot, 1);
        model.found.extend(candidate.fitted(spot, vec![more]));
        model
    }

    /// The fit of everything else where these springs are as both kinds of data have them.
    pub(crate) fn beside_springs(
        &self,
        now: &Explained,
        springs: &[Joined],
    ) -> Result<Explained, DiagnoseError> {
        let known: Vec<Spring> = springs.iter().filter_map(|joined| joined.together).collect();
        let is_known = |f: &Fitted| known.iter().any(|s| f.is_spring_of(s.joint));
        let mut model = now.fit.model.clone();
        for spring in &known {
            if !model.found.iter().any(|f| f.is_spring_of(spring.joint)) {
                model = self.with_spring(model, spring.joint, 0.0);
            }
        }
        let order = model.found.clone();
        model.found.retain(|f| !is_known(f));
        for spring in &known {
            model.arm.joints[spring.joint].compliance = spring.value;
        }
        let mut fitted = self.begin(model)?;
        // What was fixed stands among the findings again, in its place.
        let model = &mut fitted.fit.model;
        let mut free = std::mem::take(&mut model.found).into_iter();
        for mut one in order {
            match known.iter().find(|s| one.is_spring_of(s.joint)) {
                Some(spring) => {
                    let nominal = self.problem.arm.joints[spring.joint].compliance;
                    model.arm.joints[spring.joint].compliance = nominal;
                    one.values = vec![spring.value - nominal];
                    model.found.push(one);
                }
                None => model.found.extend(free.next()),
            }
        }
        Ok(fitted)
    }
}
