//! What the readers of all files share.
//!
//! 1. [`source`](bytes): the bytes of a file, and its text.
//! 2. `table`: text into records, each with its line; what separates their cells.
//! 3. `cell`: what is a number, with a point or a comma before its decimals.
//! 4. `columns`: which column is which, by the [map](Map) that a user gives and by its name; in which
//!    [unit](Unit).
//! 5. [`Convention`]: how an orientation is written.
//! 6. [`Columns`]: a table as text.
//! 7. [`Mistake`]: what is wrong, where it stands, and how to mend it.

pub mod cell;
pub mod columns;
mod convention;
pub mod encoding;
pub mod map;
mod mistake;
mod nearest;
mod source;
pub mod table;
mod unit;
mod write;

pub use convention::{Convention, Euler};
pub use map::{Cell, Map};
pub use mistake::{Column, Fault, MOST_MISTAKES, Mistake, ReadError};
pub use nearest::{did_you_mean, listed, nearest};
pub use source::{MOST_BYTES, bytes};
pub use unit::{Dimension, INCH, POUND, Unit, plain, quantity};
pub use write::{Columns, digits, number, quoted, shown};

pub use mistake::Mistakes;
pub use source::from_toml;
