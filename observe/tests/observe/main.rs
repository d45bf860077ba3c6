//! What others write, read as a user's file is: measurements, other programs' tables, logs.

mod log;
mod measurement;
mod readings;
