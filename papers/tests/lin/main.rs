//! Lin, Chiang & Cui, *An improved method for on-line calculation and compensation of the static
//! deflection at a robot end-effector*, J. Robotic Systems 8(2), 1991: equations and tables, in the
//! paper's inches and pounds.

mod arms;
mod compensation;
mod equations;
mod inverse;
mod method;
#[path = "../support/printed.rs"]
mod printed;
mod table_5;
mod tables;
