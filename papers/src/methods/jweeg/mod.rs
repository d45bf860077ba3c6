//! How far the approximate kinematics of Jweeg & Al-Khafaji is from the exact one: the difference in
//! closed form and its largest values ([`growth`]), the published ones, and a picture ([`figure`]).

pub mod figure;
pub mod growth;
pub(super) mod published;
mod small;
