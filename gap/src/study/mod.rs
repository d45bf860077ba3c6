//! Studies before anything is measured: what an experiment can find, and which experiment finds most.

pub mod withhold;
