//! Bicchi & Melchiorri, "Quasi-static compensation of force errors for flexible manipulators": the
//! two planar arms of section 5, against the printed numbers, against an independent exact rod and
//! against the simulation.

mod arms;
mod compensation;
mod recursion;
mod rod;
