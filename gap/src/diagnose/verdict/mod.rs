//! What is said of what was found.
//!
//! **In:** the fit with all its effects.
//! **Out:** `judged`: the findings, in the order in which they shrink the held-out gap
//! (`outcome`), each with its values and intervals and the shrink with its own (`summary`,
//! `searched`, `bootstrap`, `refitted`), the explanations that could stand in its place (`rivals`), the chance of noise and
//! how often half of the poses find it again (`stability`), and the measurement that would separate
//! it (`separate`); and what is left (`remainder`). What is not significant beside all the
//! others is taken out again. `nested` runs the search itself again without each fold, `springs` asks for those of the joints that a log tells too. [`Rival`] is another model, which the file's columns predict with.

mod bench;
mod bootstrap;
mod certainty;
mod compared;
mod judged;
mod nested;
mod observed;
mod outcome;
mod refitted;
mod remainder;
mod residual;
mod rivals;
mod searched;
mod separate;
mod springs;
mod stability;
mod summary;

pub(crate) use compared::Rival;
pub(crate) use outcome::Held;
pub(crate) use summary::{cover, nuisances};
