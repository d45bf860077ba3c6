//! Printed equations against derived ones.
//!
//! # From the file to the verdict
//!
//! 1. [`mod@file`]: a data file gives each equation of a paper as it is printed, in LaTeX, and what it
//!    is an equation of: an output of the generator, a formula, a relation between matrices.
//! 2. [`latex`]: the equation is cut at its equals signs and into the cells of its matrices
//!    ([`latex::formula`]), each cell becomes tokens in the paper's notation ([`latex::lexer`]) and
//!    a tree ([`latex::parser`]).
//! 3. [`exact`]: what it should be is derived in the generator's graph ([`exact::derived`]), and what is
//!    printed is read into it ([`exact::forms`]). Both are evaluated at random points modulo a prime,
//!    where nothing is rounded ([`exact::field`]): three points decide ([`exact::reader`]). A formula with
//!    roots is evaluated in doubles.
//! 4. [`matrix`]: a relation between matrices is evaluated at random postures, loads and parameters.
//! 5. [`mend`]: where the two differ, the smallest change of what is printed that makes it true.
//! 6. [`ledger`]: the finding becomes a [`Verdict`] with its correction, its change and a joint
//!    vector at which the two differ ([`verdict`]); so does each cell of a printed table. The ledger
//!    is written as text, Markdown, JSON or a page.
//!
//! A number that no formula gives is computed by [`methods`], which hold what the ledger needs and no
//! more. The papers' whole methods are reproductions under `tests`.
//!
//! # Ours, and libraries
//!
//! The graph is the generator's. A formula is multiplied out where a correction is printed, and nowhere
//! else ([`exact::polynomial`]). The readers of LaTeX are ours: which letters make a name is known only
//! once a paper's notation is read, a mistake points at its character, and mending works on tokens as
//! they are printed. JSON, the page, MathML, matrices and rational numbers are those of libraries.
#![forbid(unsafe_code)]

pub mod exact;
pub mod file;
pub mod latex;
pub mod ledger;
pub mod matrix;
pub mod mend;
pub mod methods;
pub mod verdict;

pub use file::{Paper, read};
pub use ledger::{Ledger, built_in};
pub use methods::column;
pub use verdict::{Entry, Kind, Verdict, Witness};
