//! Logs of plants that are written down in closed form, and what is said of them.

#[cfg(any(feature = "mcap", feature = "parquet"))]
mod formats;
mod instrument;
mod links;
mod mistaken;
mod own;
mod plant;
mod planted;
mod position;
mod rest;
mod shrink;
mod torque;
mod written;
