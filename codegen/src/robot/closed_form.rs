//! Which closed form the inverse kinematics of an arm has, read off its table.
//!
//! Only what is exactly zero counts: an axis that misses another by a micrometre does not meet it. Such an arm has the closed
//! form of the [nearest](super::nearest) table, and steps behind it.

use super::frames::Refused;
use super::model::{Angle, Convention, Motion, Robot, Value};

/// The closed form of six revolute joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClosedForm {
    /// Whether it is that of the arm read from tip to base.
    pub reversed: bool,
    /// What of its geometry it is made of.
    pub family: Family,
}

/// What makes a closed form, in the order from base to tip, or from tip to base.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Axes 4, 5, 6 meet in a point, and of the first three two are special.
    SphericalWrist(Position),
    /// Axes 2, 3, 4 are parallel, and 5 meets 6.
    ThreeParallel,
}

/// What the first three axes of an arm with a spherical wrist are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Position {
    /// 2 and 3 are parallel.
    SecondParallelThird,
    /// 1 and 2 are parallel.
    FirstParallelSecond,
    /// 1 and 2 meet.
    FirstMeetsSecond,
    /// 2 and 3 meet.
    SecondMeetsThird,
}

impl ClosedForm {
    /// What makes it, in words.
    pub fn sentence(self) -> String {
        let axes = |numbers: &[usize]| {
            let each = numbers.iter().map(|k| if self.reversed { 7 - k } else { *k });
            let mut each: Vec<usize> = each.collect();
            each.sort_unstable();
            each.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
        };
        match self.family {
            Family::ThreeParallel => {
                format!("axes {} are parallel, {} meet", axes(&[2, 3, 4]), axes(&[5, 6]))
            }
            Family::SphericalWrist(position) => {
                let (pair, how) = match position {
                    Position::SecondParallelThird => ([2, 3], "are parallel"),
                    Position::FirstParallelSecond => ([1, 2], "are parallel"),
                    Position::FirstMeetsSecond => ([1, 2], "meet"),
                    Position::SecondMeetsThird => ([2, 3], "meet"),
                };
                format!("axes {} meet in a point, {} {how}", axes(&[4, 5, 6]), axes(&pair))
            }
        }
    }
}

/// The fixed transform from one joint axis to the next, and how far along the first the next one's normal stands.
struct Between<'r> {
    a: &'r Value,
    alpha: &'r Angle,
}

impl Between<'_> {
    fn parallel(&self) -> bool {
        matches!(self.alpha, Angle::Pi(turn) if *turn.denom() == 1) || self.alpha.is_zero()
    }

    fn meets(&self) -> bool {
        self.a.is_zero() && !self.parallel()
    }
}

impl Robot {
    /// The closed form of its table's inverse kinematics.
    ///
    /// # Errors
    /// [`Refused`] where it has none that is known: what stands in the way.
    pub fn closed_form(&self) -> Result<ClosedForm, Refused> {
        const FAMILIES: &str = "a closed form is known of six revolute joints, of which the last three axes meet in a \
                                point and 1 and 2, or 2 and 3, are parallel or meet; or of which 2, 3, 4 are parallel \
                                and 5 meets 6; or the same from tip to base";
        let no = |what: String| {
            let message = format!("no closed form of the inverse kinematics: {what}");
            Refused { message, help: FAMILIES.to_owned() }
        };
        if self.dof() != 6 {
            return Err(no(format!("the arm has {} joints", self.dof())));
        }
        for joint in &self.joints {
            if joint.motion == Motion::Prismatic {
                return Err(no(format!("joint `{}` is prismatic", joint.name)));
            }
            if !joint.beta.is_zero() {
                return Err(no(format!("the row of `{}` has a beta", joint.name)));
            }
        }
        let rows = &self.joints[self.first_link()..][..5];
        let mut links: Vec<Between> =
            rows.iter().map(|row| Between { a: &row.a, alpha: &row.alpha }).collect();
        let mut offsets: Vec<&Value> = self.joints.iter().map(|joint| &joint.d).collect();
        let forwards = family(&links, &offsets);
        links.reverse();
        offsets.reverse();
        match (forwards, family(&links, &offsets)) {
            (Ok(family), _) => Ok(ClosedForm { reversed: false, family }),
            (_, Ok(family)) => Ok(ClosedForm { reversed: true, family }),
            (Err(what), _) => Err(no(what.to_owned())),
        }
    }

    /// The row, from 0, that holds the link from axis 1 to axis 2.
    pub(super) fn first_link(&self) -> usize {
        match self.convention {
            Convention::Standard => 0,
            Convention::Modified => 1,
        }
    }
}

fn family(links: &[Between], offsets: &[&Value]) -> Result<Family, &'static str> {
    let [first, second, third, fourth, fifth] = links else { return Err("it has not six joints") };
    let wrist = fourth.meets() && fifth.meets() && offsets[4].is_zero();
    if second.parallel() && third.parallel() && fifth.meets() {
        return match first.parallel()
            || fourth.parallel()
            || second.a.is_zero()
            || third.a.is_zero()
        {
            true => Err("of axes 1 to 5 more than 2, 3, 4 are parallel, or two of those are one"),
            false => Ok(Family::ThreeParallel),
        };
    }
    if !wrist {
        return Err(
            "axes 4, 5, 6 do not meet in a point, nor are 2, 3, 4 parallel with 5 meeting 6",
        );
    }
    if third.a.is_zero() && (offsets[3].is_zero() || third.parallel()) {
        return Err("the point where axes 4, 5, 6 meet is on axis 3");
    }
    if first.parallel() && second.parallel() {
        return Err("axes 1, 2, 3 are parallel, and the wrist's point cannot leave a plane");
    }
    if [first, second].iter().any(|link| link.parallel() && link.a.is_zero()) {
        return Err("two of the first three axes are one");
    }
    if first.meets() && second.meets() && offsets[1].is_zero() {
        return Err("axes 1, 2, 3 meet in a point, from which the wrist's keeps its distance");
    }
    let position = match (first, second) {
        (_, second) if second.parallel() => Position::SecondParallelThird,
        (first, _) if first.parallel() => Position::FirstParallelSecond,
        (first, _) if first.meets() => Position::FirstMeetsSecond,
        (_, second) if second.meets() => Position::SecondMeetsThird,
        _ => return Err("of axes 1, 2, 3 none is parallel to the next or meets it"),
    };
    Ok(Family::SphericalWrist(position))
}
