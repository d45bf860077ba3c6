//! Drawn effects, scaled to the noise.

use stiffarm_kernels::generic::Arm;

use crate::plant::Truth;

/// The truth with a size so many times as large; `None` beyond what an arm can have.
pub fn resized(truth: &Truth, arm: &Arm, factor: f64) -> Option<Truth> {
    let mut resized = truth.clone();
    for (name, value) in &mut resized.values {
        // What is searched for has no size.
        if let (Some(_), parameter) = truth.effect.number(arm, truth.place, name)? {
            *value *= factor;
            if value.abs() > parameter.quantity.largest() {
                return None;
            }
        }
    }
    Some(resized)
}
