//! Poses that lie in columns, as tables hold them: a slice for each joint, wherever it is.

use super::group::Group;
use super::{Error, Number, Size, Unstable, each};
use crate::{Input, Kernels, Output};

/// Writes `output` at every pose into `out`, pose after pose. `q` has a column for each of
/// [`Output::state`]'s numbers, `wrench` the six of the load on the tool (N, N·m; base axes, at the tool
/// origin); an output that takes no wrench may be given none.
///
/// # Errors
/// [`Error::Length`] where the columns do not fit each other, [`Error::Unstable`] where a deflection has
/// no stable equilibrium at some pose.
pub fn evaluate_columns<T, R>(
    robot: &R,
    output: Output,
    q: &[&[T]],
    wrench: &[&[T]],
    out: &mut [T],
) -> Result<(), Error>
where
    T: Number,
    R: Kernels<T> + Kernels<T::Lanes> + ?Sized,
{
    let dof = <R as Kernels<T>>::dof(robot);
    let (state, (rows, columns)) = (output.state(dof), output.shape(dof));
    let (poses, entries) = (q.first().map_or(0, |column| column.len()), rows * columns);
    let loads = if wrench.is_empty() && !output.takes(Input::Wrench) { 0 } else { 6 };
    let fit = |columns: &[&[T]], count| {
        columns.len() == count && columns.iter().all(|column| column.len() == poses)
    };
    let numbers = |columns: &[&[T]]| columns.iter().map(|column| column.len()).sum();
    let wrong = |slice, found, expected| Err(Error::Length { slice, found, expected });
    if !fit(q, state) {
        return wrong("q", numbers(q), state);
    }
    if !fit(wrench, loads) {
        return wrong("wrench", numbers(wrench), loads * poses);
    }
    if out.len() != entries * poses {
        return wrong("out", out.len(), entries * poses);
    }
    let size = Size { poses, state, entries };
    let mut group = Group::new(robot, output, size);
    let mut unstable = Unstable::default();
    for first in (0..poses).step_by(T::WIDTH) {
        let count = T::WIDTH.min(poses - first);
        group.read_joints(count, |joint, lane| q[joint][first + lane]);
        if loads > 0 {
            group.read_wrench(count, |k, lane| wrench[k][first + lane]);
        }
        let out = &mut out[first * entries..(first + count) * entries];
        let write = |entry, lane, x| out[lane * entries + entry] = x;
        match group.evaluate() {
            Some(lanes) if count == T::WIDTH => T::store_by_lane(lanes, out),
            Some(lanes) => each(lanes, count, write),
            None => unstable.join(first, group.one_by_one(count, write)),
        }
    }
    unstable.into_result()
}
