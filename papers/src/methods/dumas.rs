//! Numbers in the running text of Dumas et al.

use nalgebra::Vector6;
use stiffarm_study::dexterity::{
    Plane, Search, characteristic_length as length, influence as index,
};

/// L, m (section 2.2).
pub fn characteristic_length() -> Result<Vec<f64>, String> {
    let found = length(&super::arm("kuka_kr240")?, Search::default());
    Ok(vec![found.map_err(|error| error.to_string())?.length])
}

/// The largest ν_p, and the largest ν_r in degrees, of Fig. 4: θ2 and θ3 over their limits, the
/// wrist at 45°, under the wrench of section 3.1.
pub fn influence() -> Result<Vec<f64>, String> {
    let arm = super::arm("kuka_kr240")?;
    let posture = [0.0, 0.0, 0.0, 45.0, 45.0, 45.0].map(f64::to_radians);
    let wrench = Vector6::new(0.0, 0.0, -2000.0, 200.0, 200.0, 0.0);
    let plane = Plane::over_limits(&arm, &posture, [1, 2], 2f64.to_radians());
    let plane = plane.map_err(|error| error.to_string())?;
    let largest = |part: fn(&stiffarm_study::dexterity::Influence) -> f64| {
        let map = plane.map(|q| index(&arm, q, &wrench).map(|found| part(&found)));
        let peak = map.map_err(|error| error.to_string())?.max().ok_or("an empty map")?;
        Ok::<f64, String>(peak.value)
    };
    Ok(vec![largest(|found| found.nu_p)?, largest(|found| found.nu_r)?.to_degrees()])
}
