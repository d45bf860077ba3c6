use super::{JointOffset, LinkGeometry};
use crate::effects::prelude::*;

/// All offsets and rows of the table at once.
#[derive(Clone, Copy, Debug)]
pub struct Geometry;

/// The offsets, then the rows.
fn parts(arm: &Arm) -> impl Iterator<Item = (&'static dyn AtRest, Spot)> {
    let at = |place| Spot { place, form: 0 };
    let offsets =
        At::Joints.places(arm).into_iter().map(move |p| (&JointOffset as &dyn AtRest, at(p)));
    offsets.chain(
        At::Links.places(arm).into_iter().map(move |p| (&LinkGeometry as &dyn AtRest, at(p))),
    )
}

const AT_REST: &Facts = &Facts {
    identifier: "geometry",
    reality: "Every zero, length and twist of the table is a little off: what ordinary \
        calibration takes up.",
    signature: "The same at every load, moment and direction, and small everywhere: each number \
        within what makers tolerate.",
    confused_with: "A single number that is off by far more, which is `joint_offset` or \
        `link_geometry`.",
    separated_by: "Poses that use the whole range of every joint. Where the data see only a sum, \
        of the `d` of parallel axes or of a zero and a frame, its parts share it.",
    formula: "all of `joint_offset` and `link_geometry`",
    at: At::Arm,
    idle: "no length, twist or zero moves what was measured",
    is_geometry: true,
    ..Facts::NONE
};

impl Law for Geometry {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for Geometry {
    /// Those of every offset and of every row, `d of link 3`.
    fn parameters(&self, arm: &Arm, _: Spot) -> Vec<Parameter> {
        let each = parts(arm).flat_map(|(effect, spot)| {
            let named = move |p: Parameter| {
                let name = format!("{} of {}", p.name, spot.place);
                Parameter { usual: f64::INFINITY, ..p.named(name) }
            };
            effect.parameters(arm, spot).into_iter().map(named)
        });
        each.collect()
    }

    fn alter(&self, actual: &mut Actual<'_>, row: &Row, when: &Moment, _: Spot, v: &[f64]) {
        let nominal = actual.nominal;
        let mut rest = v;
        for (effect, spot) in parts(nominal) {
            let (own, others) = rest.split_at(effect.parameters(nominal, spot).len());
            effect.alter(actual, row, when, spot, own);
            rest = others;
        }
    }

    fn block(&self, scene: &Scene<'_>, _: Spot) -> Matrix6xX<f64> {
        let blocks = parts(scene.nominal).map(|(effect, spot)| effect.block(scene, spot));
        let columns: Vec<Vector6<f64>> =
            blocks.flat_map(|b| b.column_iter().map(Into::into).collect::<Vec<_>>()).collect();
        Matrix6xX::from_columns(&columns)
    }

    fn is_tolerated(&self) -> bool {
        true
    }

    fn excluded(&self, data: &Measurements) -> Option<&'static str> {
        let is_difference = data.kind.is_difference();
        is_difference.then_some(
            "lengths and angles cancel in the difference of two measurements of one pose",
        )
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let most = |unit: &'static str| {
            let sizes = told.numbers.iter().filter(|p| p.unit == unit).map(|p| p.value.abs());
            let most = sizes.fold(0.0, f64::max);
            (most > 0.0).then(|| (told.write)(unit, most, most))
        };
        let most: Vec<String> = ["m", "rad"].into_iter().filter_map(most).collect();
        format!("the table's lengths, twists and zeros are off by up to {}", most.join(" and "))
    }

    fn write(&self, file: &mut RobotFile<'_>, _: Spot, v: &[f64]) -> Option<String> {
        let mut changed = file.clone();
        let mut rest = v;
        for (effect, spot) in parts(file.arm()) {
            let (own, others) = rest.split_at(effect.parameters(file.arm(), spot).len());
            effect.write(&mut changed, spot, own)?;
            rest = others;
        }
        *file = changed;
        Some("the rows of the table".to_owned())
    }
}
