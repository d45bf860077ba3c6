//! The plant against means that it does not use: the textbook, closed forms, arms whose file has
//! what a truth would add.

mod arms;
mod bench;
mod camera;
mod closed_forms;
mod distances;
mod kinematic;
mod nominal;
mod same_as_file;
mod session;
mod sessions;
