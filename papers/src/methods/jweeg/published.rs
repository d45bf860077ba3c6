//! The published differences of Jweeg & Al-Khafaji.

use super::growth::{TwoLink, largest};

/// The published largest difference in p_x, m.
const P_X: f64 = 6.3e-8;

/// The largest difference in p_y, m, under the weight at the tip of two equal links that makes the
/// largest in p_x the published one. The links' length does not matter.
pub fn p_y() -> Result<Vec<f64>, String> {
    let two = TwoLink { a1: 0.4, a2: 0.4 };
    // It grows with the square of the weight.
    let unit = 1e-3;
    let [p_x, _] = largest(two, unit, 0.0);
    let [_, p_y] = largest(two, unit * (P_X / p_x.size).sqrt(), 0.0);
    Ok(vec![p_y.size])
}
