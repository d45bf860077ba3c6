use crate::effects::prelude::*;

/// Turn of gravity about the base's x and y.
///
/// A force of the rows that points down as the robot file's gravity does is a weight and turns along;
/// its centre of mass is as high as the tool origin. Any other was measured by a load cell, whose axes
/// are the arm's.
#[derive(Clone, Copy, Debug)]
pub struct GravityTilt;

/// A force that is off gravity by a larger sine is no weight: a load column has six digits.
const DOWN: f64 = 1e-5;

/// Where a load hangs from, seen from the tool origin and as high, m; `None` if it is no weight.
fn hangs_at(wrench: &Vector6<f64>, gravity: &Vector3<f64>) -> Option<Vector3<f64>> {
    let force = translation(wrench);
    let along = force.dot(gravity);
    let is_weight = along > 0.0 && force.cross(gravity).norm() <= DOWN * along;
    is_weight.then(|| force.cross(&rotation(wrench)) / force.norm_squared())
}

const AT_REST: &Facts = &Facts {
    identifier: "gravity_tilt",
    reality: "The base is not level: gravity does not point where the robot file says.",
    signature: "All weights pull a little to one side of the base: joint 1 turns where the file \
        expects no torque about it, the others by a little more or less.",
    confused_with: "A frame of the base and zeros of the joints, as far as the sag hardly \
        changes; compliance of joint 1, which works on the same torque.",
    separated_by: "Heavy and light loads at poses all around the base; a spirit level.",
    formula: "g → Rot(x, y, 0) g",
    parameters: &[
        Parameter::free("x", Quantity::Angle).usually(0.01),
        Parameter::free("y", Quantity::Angle).usually(0.01),
    ],
    idle: "nothing in the model is compliant under the weight of links and loads",
    ..Facts::NONE
};

impl Law for GravityTilt {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for GravityTilt {
    fn tilts_gravity(&self) -> bool {
        true
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        if arm.gravity == Vector3::zeros() { Vec::new() } else { vec![Place::Base] }
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, _: Spot, v: &[f64]) {
        let turn = Rotation3::new(Vector3::new(v[0], v[1], 0.0));
        let gravity = actual.arm.gravity;
        if let Some(lever) = hangs_at(&actual.wrench, &gravity) {
            let force = translation(&actual.wrench);
            let change = turn * force - force;
            let moment = lever.cross(&change);
            actual.wrench +=
                Vector6::new(change.x, change.y, change.z, moment.x, moment.y, moment.z);
        }
        actual.arm.to_mut().gravity = turn * gravity;
    }

    fn block(&self, scene: &Scene<'_>, _: Spot) -> Matrix6xX<f64> {
        let (actual, state) = (scene.actual, scene.state);
        let gravity = actual.arm.gravity;
        let lever = hangs_at(&actual.wrench, &gravity);
        let point = (state.tool * Point3::from(actual.load_point)).coords;
        let column = |axis: Vector3<f64>| {
            let twist = state.weighed(actual, &axis.cross(&gravity));
            let Some(lever) = lever else { return twist };
            let change = axis.cross(&scene.force());
            let load = (&change, &lever.cross(&change), &point);
            twist + state.yielding(actual, load, Site::Tool)
        };
        Matrix6xX::from_columns(&[column(Vector3::x()), column(Vector3::y())])
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("the base is {} off level", told.sized(told.norm(&["x", "y"])))
    }

    /// A few milliradians: what feet that nobody levelled leave.
    fn draw(&self, from: &mut Draw<'_>) -> Vec<(String, f64)> {
        let parameters = self.parameters(from.arm, Spot::at(from.place));
        from.sizes(&parameters, 0.1)
    }
}

/// The base is turned about its own axes by small angles, and with it the weights of the robot file.
#[derive(Clone, Copy, Debug)]
pub struct GravityDirection;

const TORQUE: &Facts = &Facts {
    identifier: "gravity_direction",
    law_of: "gravity_tilt",
    reality: "The base does not stand as the robot file has it: gravity pulls another way.",
    signature: "Moments of weights about axes that ought to be upright.",
    confused_with: "Moments of links, exactly so about axes that stay level.",
    separated_by: "Turning the base; large turns of joint 1.",
    formula: "g → Rot(rx, ry, rz)ᵀ g",
    parameters: &[
        Parameter::free("rx", Quantity::Angle),
        Parameter::free("ry", Quantity::Angle),
        Parameter::free("rz", Quantity::Angle),
    ],
    at: At::Base,
    ..Facts::TORQUE
};

impl Law for GravityDirection {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for GravityDirection {
    fn columns(&self, scene: &LogScene<'_>, _: Spot, _: &[f64]) -> Vec<Column> {
        // The drives hold what the weights pull.
        let held = |pulls: &Vec<f64>| pulls.iter().map(|x| -x).collect();
        let column = |turned: &Vec<Vec<f64>>| Column {
            parts: turned.iter().map(held).enumerate().collect(),
        };
        scene.weights()[1..].iter().map(column).collect()
    }

    fn excluded(&self, scene: &LogScene<'_>) -> Option<String> {
        weightless(scene)
    }
}
