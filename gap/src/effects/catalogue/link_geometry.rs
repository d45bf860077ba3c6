//! The DH lengths or twist of the row are off.
//!
//! Beside the row's own numbers, `beta` tilts what is parallel out of its plane (Hayati: between parallel
//! axes `a` and `alpha` alone cannot say so).

use nalgebra::{Matrix6xX, Vector6};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention};

use crate::effects::robot_file::{shift, turn};
use crate::effects::{
    About, Effect, Fate, Group, Parameter, ParameterReport, Place, Quantity, RobotFile, Scene,
    Spot, Told, links,
};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment, Site};

/// Lengths and twists of one row, added to the table's.
#[derive(Clone, Copy, Debug)]
pub struct LinkGeometry;

/// Axes whose twist has a smaller sine are parallel.
const PARALLEL: f64 = 1e-9;

/// What a table may be off by without surprise, m and rad.
const USUAL: f64 = 3e-3;

/// Whether a row stands between two parallel axes of the arm.
fn is_parallel(arm: &Arm, row: usize) -> bool {
    let between = match arm.convention {
        Convention::Standard => row + 1 < arm.dof(),
        Convention::Modified => row > 0,
    };
    between && arm.joints[row].alpha.sin().abs() < PARALLEL
}

impl Effect for LinkGeometry {
    fn identifier(&self) -> &'static str {
        "link_geometry"
    }

    fn about(&self) -> About {
        About {
            reality: "The DH lengths or twist of the row are off.",
            signature: "The same at every load, moment and direction.",
            confused_with: "Its neighbours along common normals and parallel axes, `base_frame` \
                            (row 1) and `tool_frame` (the last row): only sums of such numbers are \
                            seen.",
            separated_by: "Poses that turn the joints on both sides of the row through their \
                           ranges.",
        }
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        links(arm)
    }

    /// `d` (`theta` of a prismatic joint), `a`, `alpha`, and `beta` between parallel axes.
    fn parameters(&self, arm: &Arm, spot: Spot) -> Vec<Parameter> {
        let first = match arm.joints[spot.row()].motion {
            Motion::Revolute => Parameter::free("d", Quantity::Length),
            Motion::Prismatic => Parameter::free("theta", Quantity::Angle),
        };
        let mut all = vec![
            first,
            Parameter::free("a", Quantity::Length),
            Parameter::free("alpha", Quantity::Angle),
        ];
        if is_parallel(arm, spot.row()) {
            all.push(Parameter::free("beta", Quantity::Angle));
        }
        all.into_iter().map(|p| p.usually(USUAL)).collect()
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        let convention = actual.arm.convention;
        let joint = &mut actual.arm.to_mut().joints[spot.row()];
        match joint.motion {
            Motion::Revolute => joint.d += v[0],
            Motion::Prismatic => joint.theta += v[0],
        }
        joint.a += v[1];
        joint.alpha += v[2];
        let Some(&beta) = v.get(3) else { return };
        match convention {
            Convention::Standard => actual.fixed_at(Site::Link(spot.row()))[4] += beta,
            // About the origin before the row's `a`, seen from behind it.
            Convention::Modified => {
                let (sine, cosine) = beta.sin_cos();
                let a = actual.arm.joints[spot.row()].a;
                let shift = Vector6::new(a * (cosine - 1.0), 0.0, -a * sine, 0.0, beta, 0.0);
                *actual.fixed_at(Site::Joint(spot.row())) += shift;
            }
        }
    }

    fn block(&self, scene: &Scene<'_>, spot: Spot) -> Matrix6xX<f64> {
        let arm = &scene.actual.arm;
        let joint = &arm.joints[spot.row()];
        let (axis, link) = (Site::Joint(spot.row()), Site::Link(spot.row()));
        let first = match joint.motion {
            Motion::Revolute => Vector6::ith(2, 1.0),
            Motion::Prismatic => Vector6::ith(5, 1.0),
        };
        let unit = |k: usize| Vector6::ith(k, 1.0);
        let (site, tilt) = match arm.convention {
            Convention::Standard => (link, unit(4)),
            Convention::Modified => (axis, Vector6::new(0.0, 0.0, -joint.a, 0.0, 1.0, 0.0)),
        };
        let mut columns = vec![scene.state.carry(axis, &first)];
        columns.extend([unit(0), unit(3)].map(|d| scene.state.carry(site, &d)));
        if is_parallel(scene.nominal, spot.row()) {
            columns.push(scene.state.carry(site, &tilt));
        }
        Matrix6xX::from_columns(&columns)
    }

    fn idle(&self) -> &'static str {
        "the row does not move what was measured"
    }

    fn is_geometry(&self) -> bool {
        true
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Constant)
    }

    /// Lengths and angles that are told from zero; all of them if none is.
    fn sentence(&self, told: &Told<'_>) -> String {
        let is_told = |ci: [f64; 2]| ci[0] > 0.0 || ci[1] < 0.0;
        let any = told.numbers.iter().any(|p| is_told(p.ci95));
        let shown = told.numbers.iter().filter(|p| !any || is_told(p.ci95));
        let size = |value: f64, unit| (told.write)(unit, value.abs(), value);
        let each = shown.map(|p| format!("{} in {}", size(p.value, p.unit), p.name));
        let each = each.collect::<Vec<_>>().join(", ");
        format!("the table's row of {} is off by {each}", told.place)
    }

    fn write(
        &self,
        file: &mut RobotFile<'_>,
        place: Place,
        numbers: &[ParameterReport],
    ) -> Vec<Fate> {
        file.at_row(place, numbers, |row, number| {
            let joint = &mut *row.joint;
            match number.name.as_str() {
                "theta" => turn(&mut joint.theta, number.value),
                "d" => shift(&mut joint.d, number.value),
                "a" => shift(&mut joint.a, number.value),
                "alpha" => turn(&mut joint.alpha, number.value),
                _ => return Err("a row of the table has no such angle"),
            }
            let entries = ["theta", "d", "a", "alpha"];
            Ok(entries.into_iter().find(|entry| number.name == *entry).unwrap_or_default())
        })
    }
}
