//! What is told beside a diagnosis: another file, an earlier diagnosis, a tolerance, a log of the same arm, and of what
//! it was made.

mod accepted;
mod check;
mod compared;
mod logged;
mod provenance;
mod said;

pub use accepted::Accepted;
pub use check::Check;
pub use compared::{Compared, Last, Number, Reached};
pub use logged::Check as LogCheck;
pub use provenance::{Hashes, Provenance};
pub use said::Said;
