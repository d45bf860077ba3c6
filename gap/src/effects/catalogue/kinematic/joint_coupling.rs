//! Each other joint is a form of its own.

use crate::effects::prelude::*;

/// Motion of this joint per motion of another.
#[derive(Clone, Copy, Debug)]
pub struct JointCoupling;

const AT_REST: &Facts = &Facts {
    identifier: "joint_coupling",
    reality: "Another joint's motion turns this one: wrists whose gears run through one another.",
    signature: "A joint is off in proportion to the reading of another.",
    confused_with: "`joint_ratio` where two joints move together; `transmission_error` of the \
        other joint where axes are parallel.",
    separated_by: "The two joints moved independently.",
    formula: "qᵢ → qᵢ + ratio · qⱼ",
    moves: Moves::Joint,
    idle: "the other joint stands at zero throughout",
    ..Facts::NONE
};

impl Law for JointCoupling {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for JointCoupling {
    fn turns_with(&self, joint: usize, of: usize) -> Option<Spot> {
        (joint != of).then(|| Spot { form: of, ..Spot::of_joint(joint) })
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        if arm.dof() < 2 { Vec::new() } else { At::Joints.places(arm) }
    }

    fn forms_are(&self) -> Forms {
        Forms::Joints
    }

    fn named_forms(&self, arm: &Arm, place: Place) -> Vec<usize> {
        (0..arm.dof()).filter(|other| *other != place.row()).collect()
    }

    fn parameters(&self, arm: &Arm, spot: Spot) -> Vec<Parameter> {
        let (this, other) = (arm.joints[spot.row()].motion, arm.joints[spot.form].motion);
        let quantity = match (this, other) {
            (Motion::Revolute, Motion::Prismatic) => Quantity::AnglePerLength,
            (Motion::Prismatic, Motion::Revolute) => Quantity::LengthPerAngle,
            _ => Quantity::Ratio,
        };
        let name = format!("joint {}", spot.form + 1);
        vec![Parameter::free("ratio", quantity).usually(0.01).named(name)]
    }

    fn moves_by(&self, row: &Row, _: &Moment, spot: Spot, each: &mut dyn FnMut(f64)) {
        each(row.q[spot.form]);
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let other = told.numbers.first().map_or("another joint", |p| &p.name);
        format!("{} turns with {other}, by {}", told.place, told.sized(told.first()))
    }

    fn shown_in<'a>(&self, unit: &'a str) -> &'a str {
        if unit == "1" { "rad/rad" } else { unit }
    }

    /// A tenth of what other ratios are.
    fn draw(&self, from: &mut Draw<'_>) -> Vec<(String, f64)> {
        let all = <dyn AtRest>::numbers(self, from.arm, from.place);
        let one = from.below(all.len());
        let Some(parameter) = all.get(one) else { return Vec::new() };
        vec![(parameter.name.to_string(), 1e-3 * from.sign())]
    }
}

/// A motor whose angle is the sum (or the difference) of two joints' values: its inertia, viscous and
/// Coulomb friction act on both, beside what is each joint's own (Stäubli's wrist: Gautier, Janot &
/// Vandanjon 2013, eq. 39).
#[derive(Clone, Copy, Debug)]
pub struct MotorCoupling;

const TORQUE: &Facts = &Facts {
    identifier: "joint_coupling",
    reality: "One motor turns with two joints, as in wrists whose drives run through each other.",
    signature: "A joint's torque goes with the speed and the acceleration of another.",
    confused_with: "The two joints' own friction and rotors.",
    separated_by: "Motion of one of the two joints alone.",
    formula: "τ → τ + inertia · q̈ⱼ + viscous · q̇ⱼ + coulomb · sign(q̇ᵢ ± q̇ⱼ)",
    parameters: &[
        Parameter::free("inertia", Quantity::In("kg·m²")),
        Parameter::free("viscous", Quantity::In("N·m·s/rad")),
        Parameter::free("coulomb", Quantity::Moment),
    ],
    at: At::Pairs,
    ..Facts::TORQUE
};

impl Law for MotorCoupling {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for MotorCoupling {
    /// Gears and bearings of each joint that the other's motor does not turn.
    fn along(&self) -> &'static [&'static str] {
        &["coulomb_friction", "viscous_friction"]
    }

    /// What the motor feels of its own joint stands in that joint's numbers; here is what it feels of
    /// the other one. Its sign is one for both.
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let (Place::Pair(.., sum), Some([a, b])) = (spot.place, spot.pair()) else {
            return Vec::new();
        };
        let sum = f64::from(sum);
        let (qd, qdd) = (&scene.signals.qd, &scene.signals.qdd);
        let crossed = |of: &[Vec<f64>]| {
            let parts = [(a, b), (b, a)].map(|(on, from)| scene.column(on, |k| sum * of[from][k]));
            Column { parts: parts.into_iter().flat_map(|column| column.parts).collect() }
        };
        let between: Vec<f64> = qd[a].iter().zip(&qd[b]).map(|(a, b)| a + sum * b).collect();
        let way = |k: usize| scene.signals.sign(&between, k);
        let mut brake = scene.column(a, way);
        brake.parts.extend(scene.column(b, |k| sum * way(k)).parts);
        vec![crossed(qdd), crossed(qd), brake]
    }
}
