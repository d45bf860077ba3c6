//! Batches: one output at many poses, several poses in each kernel call.
//!
//! Numbers of many poses lie in one slice, [pose after pose](Layout::Poses) or
//! [quantity after quantity](Layout::Quantities). Poses go through the kernel in [`Number::Lanes`]; the
//! last set is filled up with its last pose. A lane rounds as the scalar kernel does, so the results are
//! those of [`Kernels::evaluate`], bit for bit (with the feature `libm`, to 3e-16 in sines and cosines,
//! which lanes take from the crate's own polynomial).
//!
//! ```text
//! batch::evaluate(&ur10::Robot, Output::Jacobian, Layout::Poses, &q, Wrenches::One(&w), &mut out)?;
//! ```

mod batched;
mod columns;
mod group;
mod number;
#[cfg(feature = "rayon")]
mod parallel;

use alloc::vec::Vec;
use core::fmt;

pub use crate::inverse::at_once::{inverse_kinematics, set_points};
pub use batched::Batched;
pub use columns::evaluate_columns;
pub use number::Number;
#[cfg(feature = "rayon")]
pub use parallel::evaluate_parallel;

use self::group::{Group, Unstable};
use crate::{Kernels, Output};

/// How the numbers of many poses lie in a slice; the same for joint values, wrenches and results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// An array of structures: all numbers of the first pose, then all of the second.
    Poses,
    /// A structure of arrays: the first number of all poses, then the second of all.
    Quantities,
}

/// The wrenches on the tool (N, N·m; base axes, at the tool origin).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wrenches<'a, T> {
    /// The same at every pose.
    One(&'a [T; 6]),
    /// Six numbers for each pose, in the batch's layout.
    Each(&'a [T]),
}

/// Why a batch is not what was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A slice is not of the length that the number of poses asks for; nothing was written.
    Length {
        /// Which one: `q`, `wrench` or `out`.
        slice: &'static str,
        /// Its length.
        found: usize,
        /// The length that it should have; of `q` the number of which it should be a multiple.
        expected: usize,
    },
    /// At some poses the arm is not stable under its load. Their results were left as they were; all
    /// others are written.
    Unstable {
        /// The first such pose.
        first: usize,
        /// How many there are.
        count: usize,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Length { slice: "q", found, expected } => {
                write!(f, "q holds {found} numbers, which is no multiple of a pose's {expected}")
            }
            Error::Length { slice, found, expected } => {
                write!(f, "{slice} holds {found} numbers where {expected} are needed")
            }
            Error::Unstable { first, count } => write!(
                f,
                "the arm is not stable under its load at {count} of the poses, the first being \
                 number {first} (from 0)"
            ),
        }
    }
}

impl core::error::Error for Error {}

/// Writes `output` at every pose of `q` into `out`, both in `layout`. Of a pose there are the joint values
/// (rad, m), and behind them what more [the output takes of the joints](Output::state); each result is
/// column after column, as [`Kernels::evaluate`] writes it.
///
/// # Errors
/// [`Error::Length`] where the slices do not fit each other, [`Error::Unstable`] where a deflection has
/// no stable equilibrium at some pose.
pub fn evaluate<T, R>(
    robot: &R,
    output: Output,
    layout: Layout,
    q: &[T],
    wrenches: Wrenches<'_, T>,
    out: &mut [T],
) -> Result<(), Error>
where
    T: Number,
    R: Kernels<T> + Kernels<T::Lanes> + ?Sized,
{
    let size = Size::of::<T, R>(robot, output, q, wrenches, out)?;
    let mut group = Group::new(robot, output, size);
    let unstable = match layout {
        Layout::Poses => poses(&mut group, size, q, wrenches, out),
        Layout::Quantities => {
            // Without a pose there is no row to cut.
            let length = size.poses.max(1);
            let q: Vec<&[T]> = q.chunks(length).collect();
            let mut out: Vec<&mut [T]> = out.chunks_mut(length).collect();
            let wrenches = match wrenches {
                Wrenches::One(wrench) => Rows::One(wrench),
                Wrenches::Each(each) => Rows::Each(each.chunks(length).collect()),
            };
            quantities(&mut group, size.poses, &q, &wrenches, &mut out)
        }
    };
    unstable.into_result()
}

/// How much of everything there is.
#[derive(Clone, Copy, Debug)]
struct Size {
    poses: usize,
    /// Numbers of the joints at one pose.
    state: usize,
    entries: usize,
}

impl Size {
    fn of<T: Number, R: Kernels<T> + ?Sized>(
        robot: &R,
        output: Output,
        q: &[T],
        wrenches: Wrenches<'_, T>,
        out: &[T],
    ) -> Result<Size, Error> {
        let state = output.state(robot.dof());
        let (rows, columns) = output.shape(robot.dof());
        if !q.len().is_multiple_of(state) {
            return Err(Error::Length { slice: "q", found: q.len(), expected: state });
        }
        let poses = q.len().checked_div(state).unwrap_or(0);
        let size = Size { poses, state, entries: rows * columns };
        let check = |slice, found, expected| {
            if found == expected { Ok(()) } else { Err(Error::Length { slice, found, expected }) }
        };
        if let Wrenches::Each(each) = wrenches {
            check("wrench", each.len(), 6 * size.poses)?;
        }
        check("out", out.len(), size.entries * size.poses)?;
        Ok(size)
    }
}

/// Wrenches cut into their six components.
enum Rows<'a, T> {
    One(&'a [T; 6]),
    Each(Vec<&'a [T]>),
}

/// A run of poses, one after the other.
fn poses<T, R>(
    group: &mut Group<'_, T, R>,
    size: Size,
    q: &[T],
    wrenches: Wrenches<'_, T>,
    out: &mut [T],
) -> Unstable
where
    T: Number,
    R: Kernels<T> + Kernels<T::Lanes> + ?Sized,
{
    let Size { poses, state, entries } = size;
    let mut unstable = Unstable::default();
    for first in (0..poses).step_by(T::WIDTH) {
        let count = T::WIDTH.min(poses - first);
        let whole = count == T::WIDTH;
        let here = &q[first * state..(first + count) * state];
        group.read_joints(count, |joint, lane| here[lane * state + joint]);
        match wrenches {
            Wrenches::One(wrench) => group.read_wrench(1, |k, _| wrench[k]),
            Wrenches::Each(each) => {
                let here = &each[first * 6..(first + count) * 6];
                group.read_wrench(count, |k, lane| here[lane * 6 + k]);
            }
        }
        let out = &mut out[first * entries..(first + count) * entries];
        let write = |entry, lane, x| out[lane * entries + entry] = x;
        match group.evaluate() {
            Some(lanes) if whole => T::store_by_lane(lanes, out),
            Some(lanes) => each(lanes, count, write),
            None => unstable.join(first, group.one_by_one(count, write)),
        }
    }
    unstable
}

/// A run of poses, given by quantity.
fn quantities<T, R>(
    group: &mut Group<'_, T, R>,
    poses: usize,
    q: &[&[T]],
    wrenches: &Rows<'_, T>,
    out: &mut [&mut [T]],
) -> Unstable
where
    T: Number,
    R: Kernels<T> + Kernels<T::Lanes> + ?Sized,
{
    let mut unstable = Unstable::default();
    for first in (0..poses).step_by(T::WIDTH) {
        let count = T::WIDTH.min(poses - first);
        group.read_joints(count, |joint, lane| q[joint][first + lane]);
        match wrenches {
            Rows::One(wrench) => group.read_wrench(1, |k, _| wrench[k]),
            Rows::Each(each) => group.read_wrench(count, |k, lane| each[k][first + lane]),
        }
        let write = |entry: usize, lane: usize, x| out[entry][first + lane] = x;
        match group.evaluate() {
            Some(lanes) if count == T::WIDTH => {
                for (lanes, row) in lanes.iter().zip(&mut *out) {
                    T::store(*lanes, &mut row[first..first + count]);
                }
            }
            Some(lanes) => each(lanes, count, write),
            None => unstable.join(first, group.one_by_one(count, write)),
        }
    }
    unstable
}

/// Entry, lane and value of the first `count` lanes, one by one.
fn each<T: Number>(entries: &[T::Lanes], count: usize, mut write: impl FnMut(usize, usize, T)) {
    for (entry, lanes) in entries.iter().enumerate() {
        for lane in 0..count {
            write(entry, lane, group::one::<T>(*lanes, lane));
        }
    }
}
