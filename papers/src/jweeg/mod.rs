//! Flexible kinematics of Jweeg & Al-Khafaji 2012: the displacements as roll, pitch and yaw
//! and their chain ([`rpy`]), the two-link arm ([`two_link`]), how the difference of the exact and the published
//! kinematics grows ([`growth`], as a picture [`figure`]), and the measured deflections ([`gauge`]).

pub mod figure;
pub mod gauge;
pub mod growth;
pub mod rpy;
mod small;
pub mod two_link;
