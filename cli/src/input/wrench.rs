//! Loads on the command line.

use nalgebra::Vector6;
use stiffarm_gap::measurement::Dimension;

use super::quantity;
use crate::terminal::failure::Failure;

/// `fx,fy,fz,mx,my,mz`: base axes, at the tool origin; N and N·m, or with a unit.
pub fn wrench(option: &str, text: &str) -> Result<Vector6<f64>, Failure> {
    let kinds = [[Dimension::Force; 3], [Dimension::Moment; 3]].concat();
    let whose = "a wrench is three forces and three moments: fx,fy,fz,mx,my,mz";
    Ok(Vector6::from_vec(quantity::list(option, text, &kinds, whose)?))
}
