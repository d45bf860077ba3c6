//! What the inverse solution finds, and why it finds nothing.

/// One of the two values of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// The positive root.
    Plus,
    /// The negative root.
    Minus,
}

impl Sign {
    pub(super) const BOTH: [Self; 2] = [Self::Plus, Self::Minus];

    pub(super) fn of(self, magnitude: f64) -> f64 {
        match self {
            Self::Plus => magnitude,
            Self::Minus => -magnitude,
        }
    }
}

/// Which of the eight solutions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Branch {
    /// Of the root in θ1: the side of axis 1 on which p5 lies as link 1 sees it (x1 positive or
    /// negative).
    pub shoulder: Sign,
    /// Of sin θ5, with the table's offset.
    pub wrist: Sign,
    /// Of sin θ3, with the table's offset.
    pub elbow: Sign,
}

/// One inverse solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// Joint values, rad, each above −π and at most π.
    pub q: [f64; 6],
    /// Which one it is.
    pub branch: Branch,
    /// How far forward kinematics misses the target: the larger of the distance over the arm's
    /// size (the sum of its lengths) and the angle in rad.
    pub residual: f64,
}

/// Why a branch has no solution.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Missing {
    /// p5 is nearer to axis 1 than the offset of the arm's plane.
    #[error(
        "the wrist must stand {distance:e} from axis 1, nearer than the offset {offset:e} of the \
         arm's plane"
    )]
    Offset {
        /// Of p5 from axis 1.
        distance: f64,
        /// |d2 + d3 + d4|.
        offset: f64,
    },
    /// The triangle of links 2 and 3 does not close.
    #[error(
        "axis 4 must stand {distance:e} from axis 2, and links 2 and 3 reach from {nearest:e} to \
         {farthest:e}"
    )]
    Reach {
        /// Wanted.
        distance: f64,
        /// | |a2| − |a3| |.
        nearest: f64,
        /// |a2| + |a3|.
        farthest: f64,
    },
    /// p5 on axis 1.
    #[error("the wrist stands on axis 1: joint 1 may have any value, give it one")]
    Shoulder,
    /// Axis 6 along the parallel axes.
    #[error("axis 6 is parallel to axes 2 to 4: joint 6 may have any value, give it one")]
    Wrist,
    /// Axis 4 on axis 2.
    #[error("axis 4 coincides with axis 2: joint 2 may have any value, give it one")]
    Elbow,
}

/// Why there are no inverse solutions at all.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InverseError {
    /// Not the kind of arm that this solves.
    #[error("this is not an elbow manipulator: {what}")]
    Family {
        /// What is otherwise.
        what: String,
    },
    /// The target is not a number.
    #[error("the target pose is not finite")]
    NotFinite,
    /// Every branch is missing.
    #[error("the target has no inverse solution: {}", listing(.missing))]
    Unreachable {
        /// Each group of branches and why.
        missing: Vec<Missing>,
    },
}

fn listing(missing: &[Missing]) -> String {
    let mut each: Vec<String> = missing.iter().map(ToString::to_string).collect();
    each.dedup();
    each.join("; ")
}

/// The inverse solutions of one target.
#[derive(Clone, Debug, PartialEq)]
pub struct Inverses {
    /// Up to eight, at least one. Where two branches meet (a stretched elbow, a wrist at the least
    /// distance from axis 1) both are listed.
    pub solutions: Vec<Solution>,
    /// Why the others are missing; one entry for each group of branches that ends there.
    pub missing: Vec<Missing>,
}
