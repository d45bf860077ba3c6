//! Bicchi & Melchiorri, "Quasi-static compensation of force errors for flexible manipulators": the
//! two planar arms of section 5, against the printed numbers and against an independent exact rod.

mod arms;
mod compensation;
mod dead;
mod reach;
mod recursion;
mod rod;
mod small;
