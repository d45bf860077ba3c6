//! Batches on all cores.

use alloc::vec::Vec;

use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};
use rayon::slice::{ParallelSlice, ParallelSliceMut};

use super::{Error, Group, Layout, Number, Rows, Size, Unstable, Wrenches, poses, quantities};
use crate::{Kernels, Output};

/// Poses that one task works through: some tens of microseconds.
const RUN: usize = 1024;

/// [`evaluate`](super::evaluate) on all cores, in rayon's current pool; the same results. What one core works through
/// in one task stays on the caller's.
///
/// # Errors
/// As [`evaluate`](super::evaluate).
pub fn evaluate_parallel<T, R>(
    robot: &R,
    output: Output,
    layout: Layout,
    q: &[T],
    wrenches: Wrenches<'_, T>,
    out: &mut [T],
) -> Result<(), Error>
where
    T: Number,
    R: Kernels<T> + Kernels<T::Lanes> + Sync + ?Sized,
{
    let size = Size::of::<T, R>(robot, output, q, wrenches, out)?;
    if size.poses <= RUN {
        return super::evaluate(robot, output, layout, q, wrenches, out);
    }
    let runs = match layout {
        Layout::Poses => by_pose(robot, output, size, q, wrenches, out),
        Layout::Quantities => by_quantity(robot, output, size, q, wrenches, out),
    };
    let mut unstable = Unstable::default();
    for (k, run) in runs.into_iter().enumerate() {
        unstable.join(k * RUN, run);
    }
    unstable.into_result()
}

fn by_pose<T, R>(
    robot: &R,
    output: Output,
    size: Size,
    q: &[T],
    wrenches: Wrenches<'_, T>,
    out: &mut [T],
) -> Vec<Unstable>
where
    T: Number,
    R: Kernels<T> + Kernels<T::Lanes> + Sync + ?Sized,
{
    // rayon refuses chunks of nothing.
    let out = out.par_chunks_mut((RUN * size.entries).max(1));
    let runs = q.par_chunks((RUN * size.state).max(1)).zip(out).enumerate();
    let run = |(k, (q, out)): (usize, (&[T], &mut [T]))| {
        let poses_here = q.len() / size.state;
        let wrenches = match wrenches {
            Wrenches::One(wrench) => Wrenches::One(wrench),
            Wrenches::Each(each) => Wrenches::Each(&each[6 * RUN * k..][..6 * poses_here]),
        };
        let size = Size { poses: poses_here, ..size };
        poses(&mut Group::new(robot, output, size), size, q, wrenches, out)
    };
    runs.map(run).collect()
}

fn by_quantity<T, R>(
    robot: &R,
    output: Output,
    size: Size,
    q: &[T],
    wrenches: Wrenches<'_, T>,
    out: &mut [T],
) -> Vec<Unstable>
where
    T: Number,
    R: Kernels<T> + Kernels<T::Lanes> + Sync + ?Sized,
{
    let length = size.poses.max(1);
    let mut runs: Vec<Vec<&mut [T]>> = Vec::new();
    runs.resize_with(size.poses.div_ceil(RUN), Vec::new);
    for row in out.chunks_mut(length) {
        runs.iter_mut().zip(row.chunks_mut(RUN)).for_each(|(run, part)| run.push(part));
    }
    let cut = |rows: &'_ [T], k: usize| -> Vec<core::ops::Range<usize>> {
        let starts = (0..rows.len() / length).map(|row| row * length);
        starts.map(|at| at + k * RUN..at + length.min((k + 1) * RUN)).collect()
    };
    let run = |(k, mut out): (usize, Vec<&mut [T]>)| {
        let joints: Vec<&[T]> = cut(q, k).into_iter().map(|range| &q[range]).collect();
        let wrenches = match wrenches {
            Wrenches::One(wrench) => Rows::One(wrench),
            Wrenches::Each(each) => {
                Rows::Each(cut(each, k).into_iter().map(|range| &each[range]).collect())
            }
        };
        let here = joints.first().map_or(0, |row| row.len());
        quantities(&mut Group::new(robot, output, size), here, &joints, &wrenches, &mut out)
    };
    runs.into_par_iter().enumerate().map(run).collect()
}
