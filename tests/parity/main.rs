//! Generated = textbook = finite difference = dual number.
//!
//! The kernels are compared with `kernels::generic`, which shares no code with the generator, on the
//! arms of `stiffarm-robots`, on tables written for this test, and (through the graph's
//! own evaluation) on random tables. The dual numbers are num-dual's. Lanes and batches of poses are
//! compared with one pose at a time, bit for bit.

mod batch;
mod boundary;
mod by_joints;
#[macro_use]
mod compare;
mod corrected;
mod dual;
mod fixtures;
mod found;
mod known;
mod lanes;
mod logged;
mod payload;
mod places;
mod random;
mod special;
mod stability;
mod symbolic;
mod tables;
