use crate::effects::prelude::*;

/// The instrument reads `1 + scale` metres for one.
#[derive(Clone, Copy, Debug)]
pub struct InstrumentScale;

const AT_REST: &Facts = &Facts {
    identifier: "instrument_scale",
    reality: "The instrument's length scale is off: a laser's wavelength in air that is warmer \
        than it believes.",
    signature: "Positions are scaled about the instrument's origin.",
    confused_with: "All lengths of the arm being off by one factor, as `thermal_growth` makes \
        them.",
    separated_by: "A length standard in the field of view.",
    formula: "p → (1 + scale) p",
    parameters: &[Parameter::free("scale", Quantity::Ratio).usually(1e-3)],
    at: At::Instrument,
    idle: "no position is measured",
    is_geometry: true,
    ..Facts::NONE
};

impl Law for InstrumentScale {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for InstrumentScale {
    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, _: Spot, v: &[f64]) {
        actual.metre *= 1.0 + v[0];
    }

    fn block(&self, scene: &Scene<'_>, _: Spot) -> Matrix6xX<f64> {
        let seen = (scene.base * Point3::from(scene.point)).coords;
        let p = scene.base.rotation.inverse() * seen;
        Matrix6xX::from_columns(&[Vector6::new(p.x, p.y, p.z, 0.0, 0.0, 0.0)])
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let compared = told.by_sign("short", "long");
        format!("the instrument reads {} too {compared}", told.size())
    }
}
