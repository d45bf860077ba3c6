//! Two points whose distance is known: sockets of one printed plate.

use nalgebra::Vector3;

/// Two points of the bench and how far they are apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// Their names.
    pub points: [String; 2],
    /// m.
    pub distance: f64,
    /// Its standard deviation, m, above 0.
    pub sigma: f64,
}

impl Pair {
    /// Measured minus fitted of the distance, over its standard deviation, and the derivative of the fitted
    /// by the first place; by the second it is the opposite.
    pub fn weighed(&self, places: [Vector3<f64>; 2]) -> (f64, Vector3<f64>) {
        let line = places[0] - places[1];
        let along = line.try_normalize(0.0).unwrap_or_default();
        ((self.distance - line.norm()) / self.sigma, along / self.sigma)
    }
}
