//! The expression graph: a hash-consed arena of exact expressions, and the passes over it.
//!
//! Every pass is one file: [`fold`](self) on construction, derivative, evaluation, operation count.
//! Nothing is expanded or simplified afterwards: what is shared is shared because the same
//! expression was written twice, and a structural zero is the handle [`Expr::ZERO`].
#![forbid(unsafe_code)]

mod count;
mod derivative;
mod evaluate;
mod fold;
mod graph;
mod solve;
mod trig;
mod vector;

pub use count::OpCount;
pub use evaluate::from;
pub use graph::{Expr, Graph, Node, Symbol};
pub use trig::Turn;
pub use vector::{Twist, Vec3, negate3, parallel3};
