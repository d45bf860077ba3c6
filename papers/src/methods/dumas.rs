//! Numbers in the running text of Dumas et al.

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;
use stiffarm_study::dexterity::{
    Influence, Plane, Search, characteristic_length as length, influence as index,
};

/// The wrench of Fig. 4 (section 3.1), base axes, N and N·m.
pub const WRENCH: Vector6<f64> = Vector6::new(0.0, 0.0, -2000.0, 200.0, 200.0, 0.0);

/// The maps of Figs. 3 and 4: θ2 and θ3 over their limits, every 2°, θ1 = 0 and the wrist at 45°
/// (section 3.1).
///
/// # Errors
/// Those of [`Plane::over_limits`].
pub fn plane(arm: &Arm) -> Result<Plane, String> {
    let posture = [0.0, 0.0, 0.0, 45.0, 45.0, 45.0].map(f64::to_radians);
    let plane = Plane::over_limits(arm, &posture, [1, 2], 2f64.to_radians());
    plane.map_err(|error| error.to_string())
}

/// L, m (section 2.2).
pub(super) fn characteristic_length() -> Result<Vec<f64>, String> {
    let found = length(&super::arm("kuka_kr240")?, Search::default());
    Ok(vec![found.map_err(|error| error.to_string())?.length])
}

/// The largest ν_p, and the largest ν_r in degrees, of Fig. 4.
pub(super) fn influence() -> Result<Vec<f64>, String> {
    let arm = super::arm("kuka_kr240")?;
    let plane = plane(&arm)?;
    let largest = |part: fn(&Influence) -> f64| {
        let map = plane.map(|q| index(&arm, q, &WRENCH).map(|found| part(&found)));
        let peak = map.map_err(|error| error.to_string())?.max().ok_or("an empty map")?;
        Ok::<f64, String>(peak.value)
    };
    Ok(vec![largest(|found| found.nu_p)?, largest(|found| found.nu_r)?.to_degrees()])
}
