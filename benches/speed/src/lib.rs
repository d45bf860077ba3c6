//! What the benches time: generated kernels, a hand-unrolled ideal, the textbook, and the draws that go
//! into them.

pub mod arms;
pub mod ideal;
pub mod timing;
