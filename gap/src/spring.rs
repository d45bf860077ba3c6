//! A joint's spring, seen at rest and in motion.
//!
//! What a campaign shows as `joint_compliance`, a log of commands shows as `servo_droop` and a log of the
//! motors' torques as `joint_elasticity`. Each tells it with an interval. Where one spring may be both, it
//! is the mean of the two by the inverse squares of their intervals, which is known better than
//! either; where no one spring is, both are told.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, Normal};

use crate::report::Word;

/// What one kind of data tells of a joint's spring.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spring {
    /// The joint, from 0.
    #[serde(skip)]
    pub joint: usize,
    /// The whole compliance, rad/(N·m) or m/N.
    pub value: f64,
    /// 95 % of it.
    pub ci95: [f64; 2],
    /// Whether it is among the findings; else it is told beside them.
    pub found: bool,
}

/// A spring that both kinds of data were asked for, and one of them found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Joined {
    /// The joint, as places are named.
    pub place: String,
    /// `rad/(N·m)` or `m/N`.
    pub unit: Word,
    /// What the campaign tells.
    pub at_rest: Spring,
    /// What the log tells.
    pub in_motion: Spring,
    /// The one spring that both tell; `None` where they differ by more than their intervals.
    pub together: Option<Spring>,
}

impl Spring {
    /// With so much on either side.
    pub fn new(joint: usize, value: f64, half_width: f64, found: bool) -> Spring {
        Spring { joint, value, ci95: [value - half_width, value + half_width], found }
    }

    /// Half the width of its interval.
    pub fn half_width(&self) -> f64 {
        0.5 * (self.ci95[1] - self.ci95[0])
    }

    /// Standard deviation of the value, by an interval as of a normal number.
    pub(crate) fn deviation(&self) -> f64 {
        self.half_width() / Normal::standard().inverse_cdf(0.975)
    }

    /// The one spring that both are; `None` where the interval of their difference is without zero.
    pub fn and(&self, other: &Spring) -> Option<Spring> {
        let (mine, theirs) = (self.half_width(), other.half_width());
        if (self.value - other.value).abs() > mine.hypot(theirs) {
            return None;
        }
        let weight = theirs * theirs / (mine * mine + theirs * theirs);
        let value = weight * self.value + (1.0 - weight) * other.value;
        let half_width = mine * theirs / mine.hypot(theirs);
        Some(Spring::new(self.joint, value, half_width, self.found || other.found))
    }
}

impl Joined {
    /// The springs of joints of which both tell something and one has found something; `slides` says
    /// which joints are prismatic.
    pub fn all(
        at_rest: &[Spring],
        in_motion: &[Spring],
        slides: impl Fn(usize) -> bool,
    ) -> Vec<Joined> {
        let both = |at_rest: &Spring| {
            let in_motion = in_motion.iter().find(|s| s.joint == at_rest.joint)?;
            (at_rest.found || in_motion.found).then(|| Joined {
                place: format!("joint {}", at_rest.joint + 1),
                unit: if slides(at_rest.joint) { "m/N" } else { "rad/(N·m)" }.into(),
                at_rest: *at_rest,
                in_motion: *in_motion,
                together: at_rest.and(in_motion),
            })
        };
        at_rest.iter().filter_map(both).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_spring_is_known_better_than_either() {
        let [a, b] = [Spring::new(1, 4.0, 0.6, true), Spring::new(1, 4.8, 0.8, false)];
        let both = a.and(&b).unwrap();
        // Weights 1/0.36 and 1/0.64; the half width of both is 1/√(1/0.36 + 1/0.64).
        assert!((both.value - (4.0 * 0.64 + 4.8 * 0.36)).abs() < 1e-15);
        assert!((both.half_width() - 0.48).abs() < 1e-15);
        assert_eq!(b.and(&a).unwrap().value, both.value);
        let c = Spring::new(1, 5.01, 0.8, true);
        assert_eq!(a.and(&c), None);
    }

    #[test]
    fn joints_are_joined_where_one_has_found_something() {
        let at_rest = [Spring::new(0, 1.0, 0.1, false), Spring::new(1, 2.0, 0.1, true)];
        let in_motion = [0, 1, 2].map(|joint| Spring::new(joint, 2.0, 0.2, joint == 2));
        let joined = Joined::all(&at_rest, &in_motion, |joint| joint == 1);
        let [one] = &joined[..] else { panic!("{joined:?}") };
        assert_eq!((one.place.as_str(), &*one.unit), ("joint 2", "m/N"));
        assert!(one.together.is_some());
    }
}
