//! Logs of plants that are written down in closed form, and what is said of them.

mod evidence;
mod plant;
mod position;
mod torque;
