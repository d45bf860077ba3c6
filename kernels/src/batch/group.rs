//! One set of lanes through a kernel.

use alloc::vec;
use alloc::vec::Vec;

use super::{Error, Number, Size};
use crate::{Kernels, Output, Scalar};

/// A kernel with room for what goes in and comes out.
pub(super) struct Group<'r, T: Number, R: ?Sized> {
    robot: &'r R,
    output: Output,
    q: Vec<T::Lanes>,
    wrench: [T::Lanes; 6],
    out: Vec<T::Lanes>,
}

/// Poses at which there is no stable equilibrium.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Unstable {
    first: usize,
    count: usize,
}

impl Unstable {
    /// Adds those of a run that begins at pose `start`.
    pub fn join(&mut self, start: usize, run: Unstable) {
        if run.count > 0 {
            let first = start + run.first;
            self.first = if self.count == 0 { first } else { self.first.min(first) };
            self.count += run.count;
        }
    }

    pub fn into_result(self) -> Result<(), Error> {
        match self {
            Unstable { count: 0, .. } => Ok(()),
            Unstable { first, count } => Err(Error::Unstable { first, count }),
        }
    }
}

impl<'r, T, R> Group<'r, T, R>
where
    T: Number,
    R: Kernels<T> + Kernels<T::Lanes> + ?Sized,
{
    pub fn new(robot: &'r R, output: Output, size: Size) -> Self {
        let zero = T::Lanes::lit(0.0);
        let (q, out) = (vec![zero; size.state], vec![zero; size.entries]);
        Group { robot, output, q, wrench: [zero; 6], out }
    }

    /// States of `count` poses; lanes beyond them repeat the last.
    #[inline(always)]
    pub fn read_joints(&mut self, count: usize, read: impl Fn(usize, usize) -> T) {
        for (joint, lanes) in self.q.iter_mut().enumerate() {
            *lanes = packed(count, |lane| read(joint, lane));
        }
    }

    /// Wrenches of `count` poses; lanes beyond them repeat the last.
    #[inline(always)]
    pub fn read_wrench(&mut self, count: usize, read: impl Fn(usize, usize) -> T) {
        for (k, lanes) in self.wrench.iter_mut().enumerate() {
            *lanes = packed(count, |lane| read(k, lane));
        }
    }

    /// Evaluates what was read: the entries in lanes, or `None` where some lane has no stable
    /// equilibrium and each is to be tried [by itself](Group::one_by_one).
    #[inline(always)]
    pub fn evaluate(&mut self) -> Option<&[T::Lanes]> {
        let done = self.robot.evaluate(self.output, &self.q, &self.wrench, &mut self.out);
        done.is_ok().then_some(&self.out)
    }

    /// Each of the first `count` lanes by itself; entry, lane and value go to `write`.
    #[cold]
    pub fn one_by_one(&self, count: usize, mut write: impl FnMut(usize, usize, T)) -> Unstable {
        let mut unstable = Unstable::default();
        let zero = T::lit(0.0);
        let mut out = vec![zero; self.out.len()];
        for lane in 0..count {
            let q: Vec<T> = self.q.iter().map(|lanes| one::<T>(*lanes, lane)).collect();
            let wrench = self.wrench.map(|lanes| one::<T>(lanes, lane));
            match self.robot.evaluate(self.output, &q, &wrench, &mut out) {
                Ok(()) => out.iter().enumerate().for_each(|(entry, x)| write(entry, lane, *x)),
                Err(_) => unstable.join(lane, Unstable { first: 0, count: 1 }),
            }
        }
        unstable
    }
}

#[inline(always)]
fn packed<T: Number>(count: usize, read: impl Fn(usize) -> T) -> T::Lanes {
    if count == T::WIDTH { T::pack(read) } else { T::pack(|lane| read(lane.min(count - 1))) }
}

/// One of the lanes.
pub(super) fn one<T: Number>(lanes: T::Lanes, wanted: usize) -> T {
    let mut found = T::lit(0.0);
    T::unpack(lanes, |(lane, x)| {
        if lane == wanted {
            found = x;
        }
    });
    found
}
