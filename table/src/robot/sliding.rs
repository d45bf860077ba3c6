//! What three joints of which some are prismatic are, where they place a point by equations of one unknown each.

use super::families::{Chain, is_half_turns};
use super::model::{Angle, Motion};

/// Three joints of which some are prismatic: R turns, P slides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sliding {
    /// PPP.
    All,
    /// RPP.
    BehindTurn,
    /// PPR.
    BeforeTurn,
    /// PRP, of which the first slides along axis 2.
    AroundAlong,
    /// PRP, of which the last slides along axis 2.
    AroundAcross,
    /// RRP, of which axes 1 and 2 meet.
    LastMeets,
    /// RRP, of which axes 1 and 2 are parallel, and 3 is not across them.
    LastParallel,
    /// RPR along parallel axes.
    BetweenAlong,
    /// RPR, of which the second slides across axis 1.
    BetweenAcross,
    /// PRR along axis 2, which is parallel to 3.
    FirstAlong,
    /// PRR across axis 2, which is not parallel to 3.
    FirstAcross,
}

impl Sliding {
    /// In words, behind the axes' numbers.
    pub(super) fn words(self) -> &'static str {
        match self {
            Sliding::All => "are prismatic",
            Sliding::BehindTurn => "turn, slide and slide",
            Sliding::BeforeTurn => "slide, slide and turn",
            Sliding::AroundAlong => "slide, turn about the same direction and slide",
            Sliding::AroundAcross => "slide, turn, and slide along the axis of the turn",
            Sliding::LastMeets => "turn about axes that meet, and slide",
            Sliding::LastParallel => "turn about parallel axes, and slide",
            Sliding::BetweenAlong => "turn, slide and turn about parallel axes",
            Sliding::BetweenAcross => "turn, slide across that axis, and turn",
            Sliding::FirstAlong => "slide, and turn about parallel axes in that direction",
            Sliding::FirstAcross => "slide across axis 2, and turn",
        }
    }

    /// Whether two shoulders, and two elbows, reach a point.
    pub(super) fn bits(self) -> (bool, bool) {
        match self {
            Sliding::All => (false, false),
            Sliding::BehindTurn | Sliding::AroundAcross => (true, false),
            Sliding::BeforeTurn
            | Sliding::AroundAlong
            | Sliding::LastParallel
            | Sliding::BetweenAlong
            | Sliding::FirstAlong => (false, true),
            Sliding::LastMeets | Sliding::BetweenAcross | Sliding::FirstAcross => (true, true),
        }
    }
}

/// What the first three joints of a chain are.
pub(super) fn of(chain: &Chain) -> Result<Sliding, &'static str> {
    use Motion::{Prismatic as P, Revolute as R};
    const PLANE: &str = "the first three joints do not move the wrist's point in all directions";
    const OBLIQUE: &str =
        "of the first three joints, some of which are prismatic, no equation has one unknown";
    let motion = [0, 1, 2].map(|k| chain.joints[k].motion);
    let (first, second) = (chain.parallel(1), chain.parallel(2));
    let [first_right, second_right] = [0, 1].map(|k| is_right(chain.alpha[k]));
    let between = &chain.joints[1].theta;
    let on_third = chain.point_on_third();
    // The point behind joint 3 is on axis 2 where this link is none.
    let on_second = on_third && chain.a[1].is_zero();
    let either = |is: bool, kind: Sliding, why: &'static str| if is { Ok(kind) } else { Err(why) };
    match motion {
        [P, P, P] => either(!(first || second || is_half_turns(between)), Sliding::All, PLANE),
        [R, P, P] => {
            either(!(second || first_right && is_right(between)), Sliding::BehindTurn, PLANE)
        }
        [P, P, R] => {
            let none = first || on_third || second_right && is_right(between);
            either(!none, Sliding::BeforeTurn, PLANE)
        }
        [P, R, P] => match (first, second) {
            (true, true) => Err(PLANE),
            (true, false) => Ok(Sliding::AroundAlong),
            (false, true) => either(!on_second, Sliding::AroundAcross, PLANE),
            (false, false) => Err(OBLIQUE),
        },
        [R, R, P] => match (first, chain.a[0].is_zero()) {
            (true, true) => Err("axes 1 and 2 are one"),
            (true, false) if second_right || second && on_second => Err(PLANE),
            (true, false) => Ok(Sliding::LastParallel),
            (false, true) => either(!(second && on_second), Sliding::LastMeets, PLANE),
            (false, false) => Err(OBLIQUE),
        },
        [R, P, R] => match (first, second) {
            _ if on_third => Err(PLANE),
            (true, true) => either(
                !(chain.a[0].is_zero() && chain.a[1].is_zero()),
                Sliding::BetweenAlong,
                PLANE,
            ),
            _ if first_right => {
                let none = second_right && is_half_turns(between);
                either(!none, Sliding::BetweenAcross, PLANE)
            }
            _ => Err(OBLIQUE),
        },
        [P, R, R] => match (first, second) {
            _ if on_third => Err(PLANE),
            (true, true) => {
                either(!chain.a[1].is_zero(), Sliding::FirstAlong, "axes 2 and 3 are one")
            }
            (_, false) if first_right => Ok(Sliding::FirstAcross),
            (_, true) if first_right => Err(PLANE),
            _ => Err(OBLIQUE),
        },
        [R, R, R] => Err(OBLIQUE),
    }
}

/// Whether an angle is exactly a right one.
fn is_right(angle: &Angle) -> bool {
    matches!(angle, Angle::Pi(turn) if *turn.denom() == 2)
}
