//! Dumas, Caro, Cherif, Garnier & Furet, "Joint stiffness identification of industrial serial
//! robots", Robotica 2011, on the KUKA KR 240-2 of the robot file: the numbers of sections 2 to 5
//! that follow from what is printed, each by a second path; where the paper leaves the set-up open,
//! the order of magnitude on an assumed one.

mod design;
mod dexterity;
mod identify;
mod links;
mod method;
mod robot;
mod study;
mod zones;
