//! The functions on the engine, in this process and on a cluster, against the kernels and the command line.

mod campaigns;
mod cluster;
mod diagnoses;
mod failures;
mod functions;
mod grids;
mod pages;
mod pooling;
mod stores;
