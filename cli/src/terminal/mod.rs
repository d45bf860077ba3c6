//! What is said and written: JSON, errors with their place, remarks, progress, files.

pub mod failure;
pub mod interrupt;
pub mod json;
pub mod output;
pub mod progress;
pub mod snippet;
pub mod whole;
