//! What the rows and the columns of an output are, and with that how many.

/// What the rows or the columns of an output stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Side {
    /// A single column: the output is a vector.
    One,
    /// The three axes of the base.
    Axes,
    /// A frame: its axes x, y, z, its origin.
    Frame,
    /// Frames 1 to n, each as [`Side::Frame`].
    Frames,
    /// A twist: translation x, y, z, rotation x, y, z.
    Twist,
    /// A wrench: force x, y, z, moment x, y, z.
    Wrench,
    /// The joints, base to tip.
    Joints,
    /// For each joint by which is differentiated, all joints.
    JointsByJoints,
    /// For each joint by which is differentiated, a wrench.
    WrenchByJoints,
    /// The entries of the table: theta, d, a, alpha of each row, then the tool's translation and its
    /// rotation vector.
    Entries,
}

impl Side {
    /// How many there are for an arm of `n` joints.
    pub const fn count(self, n: usize) -> usize {
        match self {
            Side::One => 1,
            Side::Axes => 3,
            Side::Frame => 4,
            Side::Frames => 4 * n,
            Side::Twist | Side::Wrench => 6,
            Side::Joints => n,
            Side::JointsByJoints => n * n,
            Side::WrenchByJoints => 6 * n,
            Side::Entries => 4 * n + 6,
        }
    }

    /// What each matrix of a stack has as columns; of a single one these.
    pub const fn each(self) -> Side {
        match self {
            Side::JointsByJoints => Side::Joints,
            Side::WrenchByJoints => Side::Wrench,
            side => side,
        }
    }

    /// What it stands for, in the words of the field; a part for each unit that differs.
    pub const fn parts(self) -> &'static [&'static str] {
        match self {
            Side::One => &["value"],
            Side::Axes => &["x, y, z"],
            Side::Frame => &["axes x, y, z and origin"],
            Side::Frames => &["axes x, y, z and origin of each frame"],
            Side::Twist => &["translation", "rotation"],
            Side::Wrench => &["force", "moment"],
            Side::Joints => &["joints"],
            Side::JointsByJoints => &["joints, for each joint differentiated by"],
            Side::WrenchByJoints => &["force, moment, for each joint differentiated by"],
            Side::Entries => {
                &["theta, d, a, alpha of each row, the tool's translation, its rotation vector"]
            }
        }
    }
}

/// How the numbers of an output are arranged; each is column-major in a slice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Form {
    /// A [`Pose`](crate::Pose).
    Pose,
    /// A pose for each joint.
    Poses,
    /// An array.
    Vector,
    /// Columns of rows: `[column][row]`.
    Matrix,
    /// A matrix for each joint: `[joint][column][row]`.
    Stack,
}
