//! Lin et al. 1991, eqs. 18-21; one stiffness for both bending planes. The link is a beam from the
//! previous frame's origin to its own.

use crate::effects::prelude::*;

/// `1/EI` and `1/GJ` of a beam along the link, added to what the model has.
#[derive(Clone, Copy, Debug)]
pub struct LinkCompliance;

/// What a beam along `chord` gives at its end under a load there, per unit of 1/EI and of 1/GJ, in
/// the axes of the chord.
fn gives(chord: &Vector3<f64>, load: &Vector6<f64>) -> [Vector6<f64>; 2] {
    let length = chord.norm();
    if length == 0.0 {
        return [Vector6::zeros(); 2];
    }
    let along = chord / length;
    let across = |v: Vector3<f64>| v - along * along.dot(&v);
    let force: Vector3<f64> = load.fixed_rows::<3>(0).into_owned();
    let moment: Vector3<f64> = load.fixed_rows::<3>(3).into_owned();
    let half = length * length / 2.0;
    let shift = across(force) * (length.powi(3) / 3.0) + moment.cross(&along) * half;
    let slope = along.cross(&force) * half + across(moment) * length;
    let twist = along * (along.dot(&moment) * length);
    [
        Vector6::new(shift.x, shift.y, shift.z, slope.x, slope.y, slope.z),
        Vector6::new(0.0, 0.0, 0.0, twist.x, twist.y, twist.z),
    ]
}

const AT_REST: &Facts = &Facts {
    identifier: "link_compliance",
    reality: "The link bends and twists under load.",
    signature: "A turn and a shift at the link's end, in the proportions of a cantilever's.",
    confused_with: "`joint_compliance` of the joints at its ends.",
    separated_by: "Loads with and without a lever beyond the link: a force at its end bends and \
        shifts it in another proportion than a moment there.",
    formula: "a cantilever: f L³/3EI, f L²/2EI, m L/EI; twist m L/GJ",
    idle: "no load of this data reaches the link",
    group: Some(Group::Elastic),
    ..Facts::NONE
};

impl Law for LinkCompliance {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for LinkCompliance {
    fn places(&self, arm: &Arm) -> Vec<Place> {
        let bends = |i: &usize| {
            let joint = &arm.joints[i - 1];
            joint.a != 0.0 || joint.d != 0.0 || joint.motion == Motion::Prismatic
        };
        (1..=arm.dof()).filter(bends).map(Place::Link).collect()
    }

    fn parameters(&self, arm: &Arm, spot: Spot) -> Vec<Parameter> {
        let beam = arm.joints[spot.row()].beam.as_ref();
        let of = |stiffness: Option<f64>| 0.0 - stiffness.map_or(0.0, |s| 1.0 / s);
        let bending = of(beam.map(|b| b.youngs_modulus * b.iy.max(b.iz)));
        let torsion = of(beam.map(|b| b.shear_modulus * b.j));
        vec![
            Parameter::at_least("bending", Quantity::Flexibility, bending),
            Parameter::at_least("torsion", Quantity::Flexibility, torsion),
        ]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        let (before, behind) = actual.row(spot.row());
        let (chord, bending, torsion) = (chord(&(before * behind)), v[0], v[1]);
        let law = move |load: &Vector6<f64>| {
            let [bends, twists] = gives(&chord, load);
            bends * bending + twists * torsion
        };
        actual.laws.push((Site::Link(spot.row()), Box::new(law)));
    }

    fn block(&self, scene: &Scene<'_>, spot: Spot) -> Matrix6xX<f64> {
        let site = Site::Link(spot.row());
        let (before, behind) = scene.actual.row(spot.row());
        scene.carried(site, &gives(&chord(&(before * behind)), scene.state.load(site)))
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("{} bends and twists {} than modelled", told.place, told.by_sign("less", "more"))
    }
}
