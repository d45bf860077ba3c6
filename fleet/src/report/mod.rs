//! `stiffarm-fleet report`: what a fleet knows that an arm does not, on one page.

mod campaigns;
mod facts;
mod numbers;
mod page;
mod pooled;
mod time;

pub use campaigns::{Campaign, Columns, campaigns};
pub use facts::Fleet;
pub use page::html;
pub use time::{Change, Kind};
