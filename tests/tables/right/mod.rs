//! Tables as they may be written, and where they may stand.

mod corrected;
mod forms;
mod places;
mod urdf;
