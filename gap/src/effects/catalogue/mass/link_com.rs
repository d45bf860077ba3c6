use crate::effects::prelude::*;

/// Displacement of the link's centre of mass, in its frame.
#[derive(Clone, Copy, Debug)]
pub struct LinkCom;

const AXES: [&str; 3] = ["x", "y", "z"];

const AT_REST: &Facts = &Facts {
    identifier: "link_com",
    reality: "A link's centre of mass is not where the robot file says: a motor, a cable package, \
        a guess.",
    signature: "The joints before the link sag by a part of a sine of the link's angle to \
        gravity, whatever the load.",
    confused_with: "The weight of the link, which moves the tool alike if the centre is off along \
        its own lever; zeros and periodic errors of order 1 of the joints before it.",
    separated_by: "Poses in which the link turns all the way about its joint; springs that are \
        known from loads.",
    formula: "c → c + (x, y, z)",
    parameters: &[
        Parameter::free("x", Quantity::Length).usually(0.1),
        Parameter::free("y", Quantity::Length).usually(0.1),
        Parameter::free("z", Quantity::Length).usually(0.1),
    ],
    idle: "nothing in the model is compliant under the weight of the link",
    ..Facts::NONE
};

impl Law for LinkCom {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for LinkCom {
    /// Links that have a mass.
    fn places(&self, arm: &Arm) -> Vec<Place> {
        let has_mass = |place: &Place| arm.joints[place.row()].mass != 0.0;
        At::Links.places(arm).into_iter().filter(has_mass).collect()
    }

    fn acts_at(&self) -> &'static str {
        "links whose `mass` is in the robot file"
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        actual.arm.to_mut().joints[spot.row()].com += Vector3::new(v[0], v[1], v[2]);
    }

    fn block(&self, scene: &Scene<'_>, spot: Spot) -> Matrix6xX<f64> {
        let site = Site::Link(spot.row());
        let (arm, frame) = (&scene.actual.arm, scene.state.frame(site));
        let joint = &arm.joints[spot.row()];
        let point = frame * Point3::from(joint.com);
        let column = |k: usize| {
            let moment = (frame.rotation * Vector3::ith(k, 1.0)).cross(&(arm.gravity * joint.mass));
            let load = (&Vector3::zeros(), &moment, &point.coords);
            scene.state.yielding(scene.actual, load, site)
        };
        Matrix6xX::from_columns(&[column(0), column(1), column(2)])
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let beside = (told.write)("m", 1e-3, told.norm(&AXES));
        format!("the centre of mass of {} is {beside} off", told.place)
    }

    /// A few centimetres.
    fn draw(&self, from: &mut Draw<'_>) -> Vec<(String, f64)> {
        let parameters = self.parameters(from.arm, Spot::at(from.place));
        from.sizes(&parameters, 0.01)
    }
}
