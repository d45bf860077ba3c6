//! What every generated robot module offers, whatever its table.

use core::fmt;

use crate::{Output, Scalar, Unstable};

/// A pose: the axes of a frame as columns, and its origin, m; both in base axes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose<S> {
    /// `rotation[0]` is the frame's x axis, `[1]` its y, `[2]` its z.
    pub rotation: [[S; 3]; 3],
    /// The frame's origin.
    pub position: [S; 3],
}

impl<S: Copy> Pose<S> {
    /// The pose as the first three rows of its homogeneous matrix: columns x, y, z, origin.
    pub fn columns(self) -> [[S; 3]; 4] {
        let [x, y, z] = self.rotation;
        [x, y, z, self.position]
    }
}

impl<S: Scalar> Pose<S> {
    /// The pose displaced by a small translation, m, and a rotation vector, rad, base axes, as a deflection tells them. Of a
    /// turn of 0.1 rad the series is off by 3e-14.
    pub fn displaced(self, by: &[S; 6]) -> Self {
        let [dx, dy, dz, u, v, w] = *by;
        let t = u * u + v * v + w * w;
        let series = |terms: [f64; 4]| {
            let [last, rest @ ..] = terms;
            rest.into_iter().fold(S::lit(last), |sum, term| S::lit(term) - t * sum)
        };
        // sin φ / φ and (1 − cos φ) / φ².
        let first = series([1.0 / 5040.0, 1.0 / 120.0, 1.0 / 6.0, 1.0]);
        let second = series([1.0 / 40320.0, 1.0 / 720.0, 1.0 / 24.0, 0.5]);
        let cross = |[x, y, z]: [S; 3]| [v * z - w * y, w * x - u * z, u * y - v * x];
        let turned = |axis: [S; 3]| {
            let once = cross(axis);
            let twice = cross(once);
            core::array::from_fn(|k| axis[k] + first * once[k] + second * twice[k])
        };
        let [x, y, z] = self.position;
        Pose { rotation: self.rotation.map(turned), position: [x + dx, y + dy, z + dz] }
    }
}

/// Copies `values` into `out`.
///
/// # Errors
/// [`Error::Length`] if the two differ in length.
pub fn fill<S: Copy>(out: &mut [S], values: &[S]) -> Result<(), Error> {
    if out.len() != values.len() {
        return Err(Error::Length);
    }
    out.copy_from_slice(values);
    Ok(())
}

/// Operations of a kernel beyond its sines and cosines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ops {
    /// Additions and subtractions.
    pub add: u32,
    /// Multiplications.
    pub mul: u32,
    /// Sign changes that no other operation absorbs.
    pub neg: u32,
    /// Reciprocals and square roots (the solve of the deflection not counted).
    pub div: u32,
    /// Sine-cosine pairs.
    pub sin_cos: u32,
}

impl Ops {
    /// Additions and multiplications together; those of sines, cosines and of a linear solve are not counted.
    pub const fn flops(self) -> u32 {
        self.add + self.mul
    }
}

/// The kind of a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Motion {
    /// `q` adds to theta.
    #[default]
    Revolute,
    /// `q` adds to d.
    Prismatic,
}

/// How one row of the table becomes a transform.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Convention {
    /// `Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta)`: Denavit and Hartenberg as in Paul and in Lin et al.
    #[default]
    Standard,
    /// `Rx(alpha) Ry(beta) Tx(a) Rz(theta) Tz(d)`: Khalil and Craig, as in Dumas et al.
    Modified,
}

/// One row of the Denavit-Hartenberg table as it was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DhRow {
    /// The row's label.
    pub joint: &'static str,
    /// Revolute or prismatic.
    pub motion: Motion,
    /// Offset of theta, as text (`pi/2`).
    pub theta: &'static str,
    /// d (or its offset), m, as text.
    pub d: &'static str,
    /// a, m, as text.
    pub a: &'static str,
    /// alpha, as text.
    pub alpha: &'static str,
    /// beta, as text; `0` in a table of Denavit and Hartenberg's.
    pub beta: &'static str,
    /// Joint stiffness, as text; `rigid` where there is none.
    pub stiffness: &'static str,
}

/// Why an evaluation by slices did not take place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Error {
    /// The state or `out` is not of the robot's and output's length.
    Length,
    /// The arm is not stable under the load.
    Unstable,
    /// The arm's module was generated without this output.
    Absent,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Length => {
                f.write_str("a slice is not of the length that the robot's output has")
            }
            Error::Unstable => Unstable.fmt(f),
            Error::Absent => f.write_str("the robot's module was generated without this output"),
        }
    }
}

impl core::error::Error for Error {}

impl From<Unstable> for Error {
    fn from(_: Unstable) -> Self {
        Error::Unstable
    }
}

/// A generated robot behind a pointer: what the command line, checks and benches go through. Code
/// that knows its robot calls the module's functions instead.
pub trait Kernels<S: Scalar> {
    /// The arm's name.
    fn name(&self) -> &'static str;

    /// Number of joints.
    fn dof(&self) -> usize;

    /// The outputs that it was generated with.
    fn outputs(&self) -> &'static [Output];

    /// Writes `output` at `state` under `wrench` (N, N·m; base axes, at the tool origin) into `out`, column
    /// by column. The state is the joint values (rad, m), and behind them what more of the joints the
    /// output takes, as [`Output::state`] says. Outputs that take no wrench ignore it.
    ///
    /// # Errors
    /// [`Error::Length`] where a slice has the wrong length, [`Error::Unstable`] where the deflection
    /// has no stable equilibrium, [`Error::Absent`] where the module does not have the output; `out` is
    /// then as it was.
    fn evaluate(
        &self,
        output: Output,
        state: &[S],
        wrench: &[S; 6],
        out: &mut [S],
    ) -> Result<(), Error>;
}
