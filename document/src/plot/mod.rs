//! What plots share: scales, ticks, lines of equal value, colours that can be told apart by the colour-blind and in grey.
//! Nothing here knows of robots.

mod colour;
mod isoline;
mod scale;

pub use colour::viridis;
pub use isoline::isolines;
pub use scale::{Scale, angle_ticks, number, ticks};
