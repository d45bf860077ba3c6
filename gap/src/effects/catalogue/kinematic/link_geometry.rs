//! Between parallel axes `beta` takes the place of `d` (Hayati & Mirmirani 1985): it tilts what is
//! parallel out of its plane, which the row's own numbers cannot say, and a shift along them is the
//! next row's.

use crate::effects::prelude::*;

/// Lengths and twists of one row, added to the table's.
#[derive(Clone, Copy, Debug)]
pub struct LinkGeometry;

/// Consecutive axes whose twist has a smaller sine are parallel or nearly: a shift along the one is
/// a hundred times better known as the other's.
const PARALLEL: f64 = 1e-2;

/// What a table may be off by without surprise, m and rad.
const USUAL: f64 = 3e-3;

/// Whether a row stands between two axes of the arm that are parallel or nearly.
fn is_parallel(arm: &Arm, row: usize) -> bool {
    let between = match arm.convention {
        Convention::Standard => row + 1 < arm.dof(),
        Convention::Modified => row > 0,
    };
    between && arm.joints[row].alpha.sin().abs() < PARALLEL
}

/// The entries of a row that are told: `d` (`theta` of a prismatic joint), `a`, `alpha`; between
/// parallel axes `beta`, which takes the place of `d`.
fn entries(arm: &Arm, row: usize) -> &'static [&'static str] {
    match (arm.joints[row].motion, is_parallel(arm, row)) {
        (Motion::Revolute, false) => &["d", "a", "alpha"],
        (Motion::Revolute, true) => &["a", "alpha", "beta"],
        (Motion::Prismatic, false) => &["theta", "a", "alpha"],
        (Motion::Prismatic, true) => &["theta", "a", "alpha", "beta"],
    }
}

const AT_REST: &Facts = &Facts {
    identifier: "link_geometry",
    reality: "The DH lengths or twist of the row are off.",
    signature: "The same at every load, moment and direction.",
    confused_with: "Its neighbours along common normals and parallel axes, `base_frame` (row 1) \
        and `tool_frame` (the last row): only sums of such numbers are seen.",
    separated_by: "Poses that turn the joints on both sides of the row through their ranges.",
    formula: "d → d + Δd, a → a + Δa, α → α + Δα; β between parallel axes",
    at: At::Links,
    idle: "the row does not move what was measured",
    group: Some(Group::Constant),
    is_geometry: true,
    ..Facts::NONE
};

impl Law for LinkGeometry {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for LinkGeometry {
    fn parameters(&self, arm: &Arm, spot: Spot) -> Vec<Parameter> {
        let each = entries(arm, spot.row()).iter().map(|entry| {
            let is_length = matches!(*entry, "d" | "a");
            let quantity = if is_length { Quantity::Length } else { Quantity::Angle };
            Parameter::free(entry, quantity).usually(USUAL)
        });
        each.collect()
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        let entries = entries(&actual.arm, spot.row());
        let joint = &mut actual.arm.to_mut().joints[spot.row()];
        for (entry, value) in entries.iter().zip(v) {
            *match *entry {
                "theta" => &mut joint.theta,
                "d" => &mut joint.d,
                "a" => &mut joint.a,
                "alpha" => &mut joint.alpha,
                _ => &mut joint.beta,
            } += value;
        }
    }

    fn block(&self, scene: &Scene<'_>, spot: Spot) -> Matrix6xX<f64> {
        let arm = &scene.actual.arm;
        let joint = &arm.joints[spot.row()];
        let (axis, link) = (Site::Joint(spot.row()), Site::Link(spot.row()));
        let carried = |site, (v, w): (Vector3<f64>, Vector3<f64>)| {
            scene.state.carry(site, &Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z))
        };
        let slide = |along: Vector3<f64>| (along, Vector3::zeros());
        // About an axis of what stands `at` before the site, a turn is a shift there too.
        let turn = |about: Vector3<f64>, at: Vector3<f64>| (-about.cross(&at), about);
        let tilt = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -joint.beta);
        let along = tilt * Vector3::x();
        let (site, length, at) = match arm.convention {
            Convention::Standard => (link, along, Vector3::zeros()),
            Convention::Modified => (axis, Vector3::x(), -joint.a * Vector3::x()),
        };
        let each = entries(scene.nominal, spot.row()).iter().map(|entry| match *entry {
            "theta" => carried(axis, turn(Vector3::z(), Vector3::zeros())),
            "d" => carried(axis, slide(Vector3::z())),
            "a" => carried(site, slide(length)),
            "alpha" => carried(site, turn(along, at)),
            _ => carried(site, turn(Vector3::y(), at)),
        });
        Matrix6xX::from_columns(&each.collect::<Vec<_>>())
    }

    /// Lengths and angles that are told from zero; all of them if none is.
    fn sentence(&self, told: &Told<'_>) -> String {
        let is_told = |ci: [f64; 2]| ci[0] > 0.0 || ci[1] < 0.0;
        let any = told.numbers.iter().any(|p| is_told(p.ci95));
        let shown = told.numbers.iter().filter(|p| !any || is_told(p.ci95));
        let size = |value: f64, unit: &str| (told.write)(unit, value.abs(), value);
        let each = shown.map(|p| format!("{} in {}", size(p.value, &p.unit), p.name));
        let each = each.collect::<Vec<_>>().join(", ");
        format!("the table's row of {} is off by {each}", told.place)
    }
}
