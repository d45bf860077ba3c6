//! The instrument's length scale is off: a laser's wavelength in air that is warmer than it believes.

use nalgebra::{Matrix6xX, Point3, Vector6};
use stiffarm_kernels::generic::Arm;

use crate::effects::{About, Effect, Parameter, Place, Quantity, Scene, Spot, Told};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment};

/// The instrument reads `1 + scale` metres for one.
#[derive(Clone, Copy, Debug)]
pub struct InstrumentScale;

impl Effect for InstrumentScale {
    fn identifier(&self) -> &'static str {
        "instrument_scale"
    }

    fn about(&self) -> About {
        About {
            reality: "The instrument's length scale is off: a laser's wavelength in air that is \
                      warmer than it believes.",
            signature: "Positions are scaled about the instrument's origin.",
            confused_with: "All lengths of the arm being off by one factor, as `thermal_growth` \
                            makes them.",
            separated_by: "A length standard in the field of view.",
        }
    }

    fn places(&self, _: &Arm) -> Vec<Place> {
        vec![Place::Instrument]
    }

    fn parameters(&self, _: &Arm, _: Spot) -> Vec<Parameter> {
        vec![Parameter::free("scale", Quantity::Ratio).usually(1e-3)]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, _: Spot, v: &[f64]) {
        actual.metre *= 1.0 + v[0];
    }

    fn block(&self, scene: &Scene<'_>, _: Spot) -> Matrix6xX<f64> {
        let seen = (scene.base * Point3::from(scene.point)).coords;
        let p = scene.base.rotation.inverse() * seen;
        Matrix6xX::from_columns(&[Vector6::new(p.x, p.y, p.z, 0.0, 0.0, 0.0)])
    }

    fn idle(&self) -> &'static str {
        "no position is measured"
    }

    fn is_geometry(&self) -> bool {
        true
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let compared = told.by_sign("short", "long");
        format!("the instrument reads {} too {compared}", told.size())
    }
}
