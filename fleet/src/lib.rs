//! stiffarm on Apache DataFusion and Ballista: the kernels as functions of columns, the diagnosis of a campaign as
//! an aggregate of its rows, in one process or on a cluster.
//!
//! [`session`] makes a session that knows them; [`cluster`] starts a cluster's parts; [`output`] writes results.

pub mod aggregates;
pub mod answer;
pub mod arm;
pub mod arms;
pub mod cells;
pub mod cluster;
pub mod codec;
pub mod csv;
pub mod files;
pub mod functions;
pub mod grid;
pub mod once;
pub mod output;
pub mod question;
pub mod report;
pub mod rows;
pub mod sentence;
pub mod session;
pub mod stores;
