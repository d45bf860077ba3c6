//! Plots as self-contained SVG: scales, ticks, axes, bands of colour, lines, points. What is
//! plotted is numbers with labels; nothing here knows of robots.
//!
//! A [`Figure`] has two axes and layers on them. It follows the reader's light or dark theme, its
//! colours can be told apart by the colour-blind and in grey, and it has a title and a description
//! for those who do not see it.

mod colour;
mod figure;
mod isoline;
mod layer;
mod scale;
mod svg;

pub use figure::{Axis, Figure};
pub use isoline::isolines;
pub use layer::{Bands, Layer, Line, Point};
pub use scale::{number, ticks};
