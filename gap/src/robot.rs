//! From the robot file's model to the arm that is simulated, and to what the reader must know.

use core::f64::consts::PI;

use nalgebra::{Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Beam, Drive, Joint};
use stiffarm_table::robot::{self, Angle, Frame, Robot, Value};

use crate::measurement::{Body, Layout, Marker, Payloads};

/// A robot whose parameters are not all known cannot be simulated.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RobotError {
    /// Entries that are still symbols.
    #[error("{robot}: found {}, expected numbers: give each a value", listing(symbols))]
    Symbolic {
        /// The robot's name.
        robot: String,
        /// Where each symbol stands and its name, in the order of the table.
        symbols: Vec<(String, String)>,
    },
    /// A stiffness of zero or below, or one whose compliance is not finite.
    #[error("{robot}: {joint}: found stiffness {stiffness}, expected a positive number")]
    Stiffness {
        /// The robot's name.
        robot: String,
        /// The row's label.
        joint: String,
        /// As the model has it.
        stiffness: String,
    },
}

fn listing(symbols: &[(String, String)]) -> String {
    let each: Vec<_> = symbols.iter().map(|(at, name)| format!("`{name}` ({at})")).collect();
    each.join(", ")
}

/// Reads values and notes the symbols among them; a symbol reads as 0.
#[derive(Default)]
struct Reader {
    symbols: Vec<(String, String)>,
}

impl Reader {
    fn value(&mut self, at: impl Fn() -> String, value: &Value) -> f64 {
        match value {
            Value::Number(n) => n.to_f64(),
            Value::Symbol(name) => self.symbol(at(), name),
        }
    }

    fn angle(&mut self, at: impl Fn() -> String, angle: &Angle) -> f64 {
        match angle {
            Angle::Symbol(name) => self.symbol(at(), name),
            known => known.radians().unwrap_or(0.0),
        }
    }

    fn optional(&mut self, at: impl Fn() -> String, value: Option<&Value>) -> f64 {
        value.map_or(0.0, |v| self.value(at, v))
    }

    fn vector(&mut self, at: &str, values: &[Value; 3]) -> Vector3<f64> {
        Vector3::from_fn(|k, _| self.value(|| at.to_owned(), &values[k]))
    }

    /// A transform, and its rotation vector.
    fn frame(&mut self, at: &'static str, frame: &Frame) -> (Isometry3<f64>, Vector3<f64>) {
        let translation = self.vector(&format!("{at} translation"), &frame.translation);
        let turn = |k| self.angle(|| format!("{at} rotation"), &frame.rotation[k]);
        let rotation = Vector3::from(std::array::from_fn(turn));
        let turned = UnitQuaternion::from_scaled_axis(rotation);
        (Isometry3::from_parts(Translation3::from(translation), turned), rotation)
    }

    fn symbol(&mut self, at: String, name: &str) -> f64 {
        self.symbols.push((at, name.to_owned()));
        0.0
    }
}

/// The arm of a robot file, in SI.
///
/// # Errors
/// [`RobotError::Symbolic`] names every entry that is still a symbol, [`RobotError::Stiffness`] a
/// stiffness that is not positive.
pub fn arm(robot: &Robot) -> Result<Arm, RobotError> {
    let mut read = Reader::default();
    let joints = robot.joints.iter().map(|j| joint(&mut read, j)).collect();
    let [base, (tool, rotation)] =
        [("base", &robot.base), ("tool", &robot.tool)].map(|(at, f)| read.frame(at, f));
    let gravity = read.vector("gravity", &robot.gravity);
    refuse_symbols(robot, read)?;
    let arm = Arm {
        name: robot.name.clone(),
        convention: robot.convention,
        joints,
        base: base.0,
        tool,
        tool_rotation_vector: rotation,
        gravity,
    };
    let wrong = arm.joints.iter().position(|j| !(j.compliance.is_finite() && j.compliance >= 0.0));
    match wrong.map(|j| &robot.joints[j]) {
        None => Ok(arm),
        Some(joint) => Err(RobotError::Stiffness {
            robot: robot.name.clone(),
            joint: joint.name.clone(),
            stiffness: joint.stiffness.as_ref().map_or_else(String::new, text),
        }),
    }
}

fn text(value: &Value) -> String {
    value.number().map_or_else(String::new, |n| n.to_string())
}

/// What the reader of measurement files must know of the robot.
///
/// # Errors
/// [`RobotError::Symbolic`] names every number of a marker or payload that is still a symbol;
/// [`RobotError`] of the arm where there are payloads.
pub fn layout(robot: &Robot) -> Result<Layout, RobotError> {
    let mut read = Reader::default();
    let markers: Vec<Marker> = robot
        .markers
        .iter()
        .map(|m| Marker {
            name: m.name.clone(),
            translation: m.translation.as_ref().map(|t| {
                let at = format!("marker {}", m.name);
                read.vector(&at, t).into()
            }),
        })
        .collect();
    let body = |p: &robot::Payload| {
        let at = || format!("payload {}", p.name);
        Body {
            name: p.name.clone(),
            mass: read.value(at, &p.mass),
            com: read.vector(&at(), &p.com),
        }
    };
    let bodies: Vec<Body> = robot.payloads.iter().map(body).collect();
    refuse_symbols(robot, read)?;
    let carried = (!bodies.is_empty()).then(|| Ok(Payloads { bodies, arm: arm(robot)? }));
    Ok(Layout {
        markers,
        payloads: carried.transpose()?,
        ..Layout::new(robot.joints.iter().map(|j| j.motion))
    })
}

fn refuse_symbols(robot: &Robot, read: Reader) -> Result<(), RobotError> {
    if read.symbols.is_empty() {
        return Ok(());
    }
    Err(RobotError::Symbolic { robot: robot.name.clone(), symbols: read.symbols })
}

/// Limits of each joint; a revolute one without any turns once around.
///
/// # Errors
/// The first prismatic joint without limits, from 1: it cannot be searched.
pub fn ranges(arm: &Arm) -> Result<Vec<[f64; 2]>, usize> {
    let each = arm.joints.iter().enumerate().map(|(k, joint)| match (joint.limits, joint.motion) {
        (Some(limits), _) => Ok(limits),
        (None, Motion::Revolute) => Ok([-PI, PI]),
        (None, Motion::Prismatic) => Err(k + 1),
    });
    each.collect()
}

fn joint(read: &mut Reader, joint: &robot::Joint) -> Joint {
    let at = |what: &'static str| move || format!("{what} of {}", joint.name);
    Joint {
        motion: joint.motion,
        theta: read.angle(at("theta"), &joint.theta),
        d: read.value(at("d"), &joint.d),
        a: read.value(at("a"), &joint.a),
        alpha: read.angle(at("alpha"), &joint.alpha),
        beta: read.angle(at("beta"), &joint.beta),
        compliance: match &joint.stiffness {
            Some(Value::Symbol(name)) => read.symbol(at("stiffness")(), name),
            Some(Value::Number(k)) => 1.0 / k.to_f64(),
            None => 0.0,
        },
        mass: read.optional(at("mass"), joint.mass.as_ref()),
        com: read.vector(&at("com")(), &joint.com),
        inertia: inertia(read, joint),
        drive: drive(read, joint),
        limits: joint.limits,
        beam: joint.beam.as_ref().map(|b| beam(read, b, &joint.name)),
    }
}

fn inertia(read: &mut Reader, joint: &robot::Joint) -> Matrix3<f64> {
    let entry = |value| read.value(|| format!("inertia of {}", joint.name), value);
    let Some([xx, xy, xz, yy, yz, zz]) = joint.inertia.as_ref().map(|i| i.each_ref().map(entry))
    else {
        return Matrix3::zeros();
    };
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

fn drive(read: &mut Reader, joint: &robot::Joint) -> Drive {
    let mut number = |what: &str, value: &Option<Value>| {
        read.optional(|| format!("{what} of {}", joint.name), value.as_ref())
    };
    let drive = &joint.drive;
    Drive {
        gear: drive.gear.as_ref().map_or(1.0, |_| number("gear", &drive.gear)),
        rotor_inertia: number("rotor_inertia", &drive.rotor_inertia),
        coulomb: number("coulomb", &drive.coulomb),
        viscous: number("viscous", &drive.viscous),
    }
}

fn beam(read: &mut Reader, beam: &robot::Beam, joint: &str) -> Beam {
    let at = |what: &'static str| move || format!("{what} of the beam of {joint}");
    Beam {
        youngs_modulus: read.value(at("youngs_modulus"), &beam.youngs_modulus),
        shear_modulus: read.value(at("shear_modulus"), &beam.shear_modulus),
        area: read.value(at("area"), &beam.section.area),
        iy: read.value(at("iy"), &beam.section.iy),
        iz: read.value(at("iz"), &beam.section.iz),
        j: read.value(at("j"), &beam.section.j),
        density: read.optional(at("density"), beam.density.as_ref()),
        shear_coefficient: beam
            .shear_coefficient
            .as_ref()
            .map(|kappa| read.value(at("shear_coefficient"), kappa)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stiffarm_table::number::Number;

    fn number(text: &str) -> Value {
        Value::Number(Number::from_decimal(text).unwrap())
    }

    fn robot() -> Robot {
        let joint = robot::Joint {
            name: "a1".to_owned(),
            motion: Motion::Revolute,
            theta: Angle::ZERO,
            d: Value::ZERO,
            a: number("0.5"),
            alpha: Angle::ZERO,
            beta: Angle::ZERO,
            stiffness: Some(number("2e5")),
            mass: None,
            com: [const { Value::ZERO }; 3],
            inertia: None,
            drive: Default::default(),
            limits: None,
            source: None,
            beam: None,
        };
        Robot {
            name: "one link".to_owned(),
            convention: robot::Convention::Standard,
            gravity: [Value::ZERO, Value::ZERO, number("-9.80665")],
            torque_side: None,
            joints: vec![joint],
            base: Frame::default(),
            tool: Frame::default(),
            effects: Vec::new(),
            beyond: Default::default(),
            payloads: Vec::new(),
            frames: Vec::new(),
            markers: vec![robot::Marker {
                name: "smr".to_owned(),
                translation: Some([Value::ZERO, number("0.1"), Value::ZERO]),
            }],
            outputs: Vec::new(),
            at: Vec::new(),
            inverse_kinematics: None,
            redundancy: None,
        }
    }

    #[test]
    fn numbers_come_through() {
        let arm = arm(&robot()).unwrap();
        assert_eq!(arm.joints[0].compliance, 5e-6);
        assert_eq!(arm.pose(&[0.0]).translation.vector, Vector3::new(0.5, 0.0, 0.0));
        assert_eq!(arm.gravity.z, -9.80665);
        let layout = layout(&robot()).unwrap();
        assert_eq!(layout.motions, [Motion::Revolute]);
        assert_eq!(layout.markers[0].translation, Some([0.0, 0.1, 0.0]));
    }

    #[test]
    fn symbols_are_named_all_at_once() {
        let mut robot = robot();
        robot.joints[0].a = Value::Symbol("a1".to_owned());
        robot.joints[0].stiffness = Some(Value::Symbol("k1".to_owned()));
        let text = arm(&robot).unwrap_err().to_string();
        assert_eq!(
            text,
            "one link: found `a1` (a of a1), `k1` (stiffness of a1), expected numbers: \
             give each a value"
        );
    }

    #[test]
    fn a_stiffness_is_positive() {
        let mut robot = robot();
        for wrong in ["0", "-3"] {
            robot.joints[0].stiffness = Some(number(wrong));
            assert!(matches!(arm(&robot), Err(RobotError::Stiffness { .. })), "{wrong}");
        }
    }
}
