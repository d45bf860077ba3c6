//! What is usual of an effect's numbers, by those who know the arm: a value that is beyond it pays for
//! that, and one that the data hardly decide stays near it.

use stiffarm_kernels::generic::Arm;

use super::options::DiagnoseError;
use crate::effects::{Catalogue, Effect, Parameter};

/// What is usual of a number of an effect at every place.
#[derive(Clone, Debug, PartialEq)]
pub struct Prior {
    effect: &'static dyn Effect,
    /// Its key; `None` is all of them.
    number: Option<String>,
    /// Of either sign, SI.
    size: f64,
}

impl Prior {
    /// Reads `effect=SIZE` or `effect:number=SIZE`, the size with its unit: `joint_compliance=2e-6
    /// rad/Nm`.
    ///
    /// # Errors
    /// [`DiagnoseError::Prior`]: what was found, and what was expected.
    pub fn parse(text: &str, arm: &Arm, catalogue: &Catalogue) -> Result<Self, DiagnoseError> {
        let wrong = |expected: String| DiagnoseError::Prior { found: text.to_owned(), expected };
        let parts = text.split_once('=').ok_or_else(|| {
            wrong("`effect=SIZE` or `effect:number=SIZE`, as joint_compliance=2e-6".to_owned())
        })?;
        let (name, size) = (parts.0.trim(), parts.1.trim());
        let (name, number) = name.split_once(':').map_or((name, None), |(n, k)| (n, Some(k)));
        let effect = catalogue.named(name).filter(|e| !e.is_tolerated()).ok_or_else(|| {
            let all = catalogue.iter().filter(|e| !e.is_tolerated()).map(|e| e.identifier());
            wrong(format!("one of the effects {}", all.collect::<Vec<_>>().join(", ")))
        })?;
        let place = effect
            .places(arm)
            .into_iter()
            .next()
            .ok_or_else(|| wrong("an effect that this arm can have".to_owned()))?;
        let own = effect.form_number().map(|form| form.key);
        let mut all = effect.numbers(arm, place);
        all.retain(|p| own != Some(p.key));
        let keys = || all.iter().map(|p| format!("`{}`", p.key)).collect::<Vec<_>>().join(", ");
        let meant = |p: &&Parameter| number.is_none_or(|number| p.key == number);
        let first = all.iter().find(meant).ok_or_else(|| wrong(format!("one of {}", keys())))?;
        if all.iter().filter(meant).any(|p| p.quantity != first.quantity) {
            return Err(wrong(format!("a size for one of its numbers, {}", keys())));
        }
        let size = first.quantity.read(size).filter(|size| *size > 0.0);
        let size = size.ok_or_else(|| {
            wrong(format!("a size above 0, alone or in {}", first.quantity.units()))
        })?;
        Ok(Self { effect, number: number.map(str::to_owned), size })
    }

    /// What is usual of a number: by the last of some priors that is about it, or the effect's own.
    pub(crate) fn usual(priors: &[Prior], effect: &dyn Effect, parameter: &Parameter) -> f64 {
        let is_about = |prior: &&Prior| {
            prior.effect == effect && prior.number.as_ref().is_none_or(|n| n == parameter.key)
        };
        priors.iter().rev().find(is_about).map_or(parameter.usual, |prior| prior.size)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{BaseFrame, Place, Spot};
    use crate::fixture::springy;

    #[test]
    fn priors_are_read_with_their_units() {
        let catalogue = Catalogue::default();
        let read = |text: &str| Prior::parse(text, &springy(), &catalogue);
        let priors = [
            read("joint_compliance = 2 urad/Nm").unwrap(),
            read("base_frame:rx=3 mrad").unwrap(),
            read("joint_compliance=4e-6").unwrap(),
        ];
        let spot = |place| Spot { place, form: 0 };
        let joint = catalogue.named("joint_compliance").unwrap();
        let compliance = &joint.parameters(&springy(), spot(Place::Joint(2)))[0];
        assert_eq!(Prior::usual(&priors, joint, compliance), 4e-6);
        let frame = BaseFrame.parameters(&springy(), spot(Place::Base));
        assert_eq!(Prior::usual(&priors, &BaseFrame, &frame[3]), 3.0 * 1e-3);
        assert_eq!(Prior::usual(&priors, &BaseFrame, &frame[4]), frame[4].usual);
        let wrong = [
            ("joint_compliance", "`effect=SIZE`"),
            ("joint_complience=1", "one of the effects"),
            ("geometry=1mm", "one of the effects"),
            ("joint_compliance:give=1", "one of `compliance`"),
            ("base_frame=1", "a size for one of its numbers"),
            ("joint_compliance=2 mm", "a size above 0, alone or in"),
            ("joint_compliance=-1", "a size above 0"),
        ];
        for (text, expected) in wrong {
            let error = read(text).unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
        }
    }
}
