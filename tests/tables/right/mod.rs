//! Tables as they may be written, and where they may stand.

mod forms;
mod places;
mod urdf;
