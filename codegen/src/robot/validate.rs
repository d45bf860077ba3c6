//! The one validator: both readers hand it a draft, and it makes the [`Robot`].

use super::beyond::Beyond;
use super::draft::{Cell, Draft, DraftBeam, DraftFrame, DraftJoint, DraftPayload, INERTIA, Vector};
use super::inertia;
use super::model::{
    Angle, Beam, Convention, Drive, Frame, Joint, Marker, Motion, Payload, Robot, Section, Value,
};
use super::problem::{Place, Problem, Report};
use super::{frames, names};
use crate::number::Number;

/// More joints than any arm has; a bound on the work that a file can ask for.
const MOST_JOINTS: usize = 64;

/// Standard gravity, downwards, m/s².
fn standard_gravity() -> [Value; 3] {
    [Value::ZERO, Value::ZERO, Value::Number(Number::ratio(-980_665, 100_000))]
}

/// Checks a draft and makes the robot of it. What could not be read has a neutral value in the
/// robot: it is only to be used if the report has no errors. That there is a joint at all is for
/// the readers to say, who know why none was read.
pub(crate) fn validate<L: Place>(draft: &Draft<L>, report: &mut Report<L>) -> Robot {
    if let Some(joint) = draft.joints.get(MOST_JOINTS) {
        let message = format!("joint {} of at most {MOST_JOINTS}", MOST_JOINTS + 1);
        report.error(Problem::new(joint.at.clone(), message));
    }
    names::check(draft, report);
    let joints: Vec<Joint> =
        draft.joints.iter().enumerate().map(|(i, row)| joint(i, row, report)).collect();
    let mut robot = Robot {
        name: content(&draft.name).unwrap_or_default(),
        convention: content(&draft.convention).unwrap_or(Convention::Standard),
        gravity: draft.gravity.as_ref().map_or_else(standard_gravity, vector),
        torque_side: content(&draft.torque_side),
        frames: draft.frames.iter().filter_map(|f| frames::named(f, &joints, report)).collect(),
        joints,
        base: frame(&draft.base),
        tool: frame(&draft.tool),
        markers: draft
            .markers
            .iter()
            .map(|m| Marker {
                name: m.name.value.clone().unwrap_or_default(),
                translation: m.translation.as_ref().map(vector),
            })
            .collect(),
        effects: draft.effects.clone(),
        beyond: Beyond::default(),
        payloads: draft.payloads.iter().map(|p| payload(p, report)).collect(),
        outputs: Vec::new(),
        at: Vec::new(),
    };
    frames::ask(&mut robot, &draft.outputs, report);
    carry(&mut robot, draft.carries.as_ref(), report);
    robot
}

/// Hangs a payload on the tool; what is wrong with the payload itself has been reported.
pub(crate) fn carry<L: Place>(
    robot: &mut Robot,
    name: Option<&Cell<String, L>>,
    report: &mut Report<L>,
) {
    let Some(Cell { value: Some(name), at }) = name.filter(|_| report.errors.is_empty()) else {
        return;
    };
    if let Err(no) = robot.carry(name) {
        report.error(Problem::new(at.clone(), no.message).help(no.help));
    }
}

pub(crate) fn frame<L>(frame: &DraftFrame<L>) -> Frame {
    let none = Frame::default();
    Frame {
        translation: frame.translation.as_ref().map_or(none.translation, vector),
        rotation: frame.rotation.as_ref().map_or(none.rotation, |angles| {
            angles.each_ref().map(|c| c.value.clone().unwrap_or(Angle::ZERO))
        }),
    }
}

fn payload<L: Place>(payload: &DraftPayload<L>, report: &mut Report<L>) -> Payload {
    not_below_zero("the mass", &payload.mass, report);
    possible(payload.inertia.as_ref(), "the tool's", report);
    Payload {
        name: payload.name.value.clone().unwrap_or_default(),
        mass: payload.mass.value.clone().unwrap_or(Value::ZERO),
        com: payload.com.as_ref().map_or([Value::ZERO; 3], vector),
        inertia: payload.inertia.as_ref().map(|(_, entries)| tensor(entries)),
    }
}

fn tensor<L>(entries: &[Cell<Value, L>; 6]) -> [Value; 6] {
    entries.each_ref().map(|c| c.value.clone().unwrap_or(Value::ZERO))
}

/// Refuses moments of inertia that no body has, where all are numbers.
fn possible<L: Place>(
    inertia: Option<&(L, [Cell<Value, L>; 6])>,
    axes: &str,
    report: &mut Report<L>,
) {
    let Some((at, entries)) = inertia else { return };
    let entries = entries.each_ref().map(|entry| entry.value.as_ref()?.number());
    if let [Some(a), Some(b), Some(c), Some(d), Some(e), Some(f)] = entries {
        let message = inertia::unphysical([a, b, c, d, e, f].map(Number::to_f64));
        let help = format!("`inertia` is {INERTIA} about the centre of mass, in {axes} axes");
        report.errors.extend(message.map(|m| Problem::new(at.clone(), m).help(help)));
    }
}

fn content<T: Clone, L>(cell: &Option<Cell<T, L>>) -> Option<T> {
    cell.as_ref()?.value.clone()
}

fn value<L>(cell: &Option<Cell<Value, L>>) -> Value {
    content(cell).unwrap_or(Value::ZERO)
}

fn vector<L>(cells: &Vector<Value, L>) -> [Value; 3] {
    cells.each_ref().map(|c| c.value.clone().unwrap_or(Value::ZERO))
}

fn joint<L: Place>(index: usize, row: &DraftJoint<L>, report: &mut Report<L>) -> Joint {
    if let Some(cell) = &row.stiffness {
        above_zero("the stiffness", cell, "leave it out for a rigid joint", report);
    }
    if let Some(cell) = &row.mass {
        not_below_zero("the mass", cell, report);
    }
    if let (Some((at, com)), None) = (&row.com, &row.mass)
        && com.iter().all(|entry| entry.value.is_some())
    {
        let problem = Problem::new(at.clone(), "a centre of mass without a mass");
        report.error(problem.help("give the link's `mass` too, or leave `com` out"));
    }
    if let Some((at, inertia)) = &row.inertia {
        let entries = inertia.each_ref().map(|entry| entry.value.as_ref());
        if row.mass.is_none() && entries.iter().all(Option::is_some) {
            let problem = Problem::new(at.clone(), "moments of inertia without a mass");
            report.error(problem.help("give the link's `mass` too, or leave `inertia` out"));
        }
    }
    possible(row.inertia.as_ref(), "the row's", report);
    let drive = &row.drive;
    if let Some(cell) = &drive.gear {
        above_zero("the gear", cell, "leave it out for a motor at the joint", report);
    }
    let frictions = [
        ("the rotor's inertia", &drive.rotor_inertia),
        ("the dry friction", &drive.coulomb),
        ("the viscous friction", &drive.viscous),
    ];
    for (what, cell) in frictions {
        cell.iter().for_each(|cell| not_below_zero(what, cell, report));
    }
    if let Some(Cell { value: Some([lo, hi]), at }) = &row.limits
        && lo >= hi
    {
        let message = format!("the lower limit {lo:?} is not below the upper limit {hi:?}");
        report.error(Problem::new(at.clone(), message));
    }
    Joint {
        name: content(&row.name).unwrap_or_else(|| format!("joint {}", index + 1)),
        motion: row.motion.value.unwrap_or(Motion::Revolute),
        theta: content(&row.theta).unwrap_or(Angle::ZERO),
        d: value(&row.d),
        a: value(&row.a),
        alpha: content(&row.alpha).unwrap_or(Angle::ZERO),
        beta: content(&row.beta).unwrap_or(Angle::ZERO),
        stiffness: content(&row.stiffness),
        mass: content(&row.mass),
        com: row.com.as_ref().map_or([Value::ZERO; 3], |(_, com)| vector(com)),
        inertia: row.inertia.as_ref().map(|(_, entries)| tensor(entries)),
        drive: Drive {
            gear: content(&drive.gear),
            rotor_inertia: content(&drive.rotor_inertia),
            coulomb: content(&drive.coulomb),
            viscous: content(&drive.viscous),
        },
        limits: content(&row.limits),
        source: content(&row.source),
        beam: row.beam.as_ref().map(|b| beam(row, b, report)),
    }
}

fn beam<L: Place>(row: &DraftJoint<L>, beam: &DraftBeam<L>, report: &mut Report<L>) -> Beam {
    let [area, iy, iz, j] = &beam.section;
    let constants = [
        ("youngs_modulus", &beam.youngs_modulus),
        ("shear_modulus", &beam.shear_modulus),
        ("the section's area", area),
        ("the section's iy", iy),
        ("the section's iz", iz),
        ("the section's j", j),
    ];
    for (what, cell) in constants {
        above_zero(what, cell, "", report);
    }
    if let Some(cell) = &beam.shear_coefficient {
        above_zero("shear_coefficient", cell, "leave it out to neglect shear", report);
    }
    if let Some(cell) = &beam.density {
        not_below_zero("the density", cell, report);
        if row.motion.value == Some(Motion::Prismatic) {
            let message = "a density on a prismatic joint's beam: its length changes";
            let problem = Problem::new(cell.at.clone(), message);
            report.error(problem.help("give the link's `mass` and `com` instead"));
        }
    }
    chord(row, beam, report);
    let content = |cell: &Cell<Value, L>| cell.value.clone().unwrap_or(Value::ZERO);
    Beam {
        youngs_modulus: content(&beam.youngs_modulus),
        shear_modulus: content(&beam.shear_modulus),
        section: Section { area: content(area), iy: content(iy), iz: content(iz), j: content(j) },
        density: beam.density.as_ref().map(content),
        shear_coefficient: beam.shear_coefficient.as_ref().map(content),
    }
}

/// A beam needs a chord from frame origin to frame origin: its length is √(a² + d²) in both
/// conventions.
fn chord<L: Place>(row: &DraftJoint<L>, beam: &DraftBeam<L>, report: &mut Report<L>) {
    // A broken cell has been reported; whatever it was meant to be is not known to be zero.
    let zero = |cell: &Option<Cell<Value, L>>| {
        cell.as_ref().is_none_or(|c| c.value.as_ref().is_some_and(Value::is_zero))
    };
    if row.motion.value == Some(Motion::Revolute) && zero(&row.a) && zero(&row.d) {
        let message = "a beam of no length: `a` and `d` of this joint are both zero";
        let problem = Problem::new(beam.at.clone(), message);
        report.error(problem.help("put the beam on the joint whose row has the link's length"));
    }
}

fn known<L>(cell: &Cell<Value, L>) -> Option<Number> {
    cell.value.as_ref()?.number()
}

fn above_zero<L: Place>(what: &str, cell: &Cell<Value, L>, help: &str, report: &mut Report<L>) {
    if let Some(n) = known(cell).filter(|n| n.is_negative() || n.is_zero()) {
        let message = format!("{what} is {n}: it must be above zero");
        let problem = Problem::new(cell.at.clone(), message);
        report.error(if help.is_empty() { problem } else { problem.help(help) });
    }
}

fn not_below_zero<L: Place>(what: &str, cell: &Cell<Value, L>, report: &mut Report<L>) {
    if let Some(n) = known(cell).filter(|n| n.is_negative()) {
        let message = format!("{what} is {n}: it must not be below zero");
        report.error(Problem::new(cell.at.clone(), message));
    }
}

#[cfg(test)]
mod tests {
    use super::super::Robot;

    fn messages(joint: &str) -> Vec<String> {
        let text = format!("name = \"x\"\nconvention = \"modified\"\n[[joint]]\n{joint}");
        match Robot::from_toml(&text, "x.toml") {
            Ok(_) => Vec::new(),
            Err(error) => error.errors.into_iter().map(|e| e.message).collect(),
        }
    }

    fn revolute(lines: &str) -> Vec<String> {
        messages(&format!("type = \"revolute\"\n{lines}\n"))
    }

    const BEAM: &str = "[joint.beam]\nyoungs_modulus = 1\nshear_modulus = 1\n\
                        section = { area = 1, iy = 1, iz = 1, j = 1 }\n";

    #[test]
    fn signs_of_numbers() {
        assert_eq!(revolute("stiffness = 0"), ["the stiffness is 0.0: it must be above zero"]);
        assert_eq!(revolute("stiffness = -2"), ["the stiffness is -2.0: it must be above zero"]);
        assert_eq!(revolute("mass = -1"), ["the mass is -1.0: it must not be below zero"]);
        assert!(revolute("mass = 0\ncom = [1, 0, 0]").is_empty());
        assert_eq!(
            revolute(
                "a = 1\n[joint.beam]\nyoungs_modulus = 0\nshear_modulus = -1\ndensity = -1\n\
                 shear_coefficient = 0\nsection = { area = 0, iy = 0, iz = 0, j = -1 }"
            ),
            [
                "youngs_modulus is 0.0: it must be above zero",
                "shear_modulus is -1.0: it must be above zero",
                "the density is -1.0: it must not be below zero",
                "shear_coefficient is 0.0: it must be above zero",
                "the section's area is 0.0: it must be above zero",
                "the section's iy is 0.0: it must be above zero",
                "the section's iz is 0.0: it must be above zero",
                "the section's j is -1.0: it must be above zero",
            ]
        );
    }

    #[test]
    fn a_tensor_of_inertia_is_that_of_some_body() {
        let with = |inertia: &str| revolute(&format!("mass = 1\ninertia = {inertia}"));
        assert!(with("[0.3, 0.01, 0, 0.4, 0, 0.2]").is_empty());
        // A disc, whose third moment is the sum of the others, and a rod.
        assert!(with("[0.1, 0, 0, 0.2, 0, 0.3]").is_empty());
        assert!(with("[0.2, 0, 0, 0.2, 0, 0]").is_empty());
        assert_eq!(
            with("[0.1, 0, 0, 0.2, 0, 0.4]"),
            [
                "the principal moments of inertia are 0.1, 0.2 and 0.4: no body has one that is larger than \
              the sum of the others"
            ]
        );
        assert_eq!(
            with("[0.1, 0.2, 0, 0.1, 0, 0.1]"),
            ["the principal moments of inertia are -0.1, 0.1 and 0.3: none can be below zero"]
        );
        let weightless = "moments of inertia without a mass";
        assert_eq!(revolute("inertia = [1, 0, 0, 1, 0, 1]"), [weightless]);
        assert_eq!(revolute("mass = 1\ninertia = [1, 0, 0]").len(), 1);
    }

    #[test]
    fn friction_and_gears_have_signs() {
        assert_eq!(
            revolute("gear = 0\nrotor_inertia = -1\ncoulomb = -2\nviscous = -3"),
            [
                "the gear is 0.0: it must be above zero",
                "the rotor's inertia is -1.0: it must not be below zero",
                "the dry friction is -2.0: it must not be below zero",
                "the viscous friction is -3.0: it must not be below zero",
            ]
        );
    }

    #[test]
    fn limits_are_in_order() {
        assert_eq!(
            revolute("limits = [1, 1]"),
            ["the lower limit 1.0 is not below the upper limit 1.0"]
        );
    }

    #[test]
    fn a_centre_of_mass_needs_a_mass() {
        assert_eq!(revolute("com = [1, 0, 0]"), ["a centre of mass without a mass"]);
        assert_eq!(
            revolute("com = [1, 0, 0]\nmass = \"x kg\""),
            ["`x kg` is an expression: a cell holds one number or one parameter"]
        );
    }

    #[test]
    fn a_beam_needs_a_length_that_stays() {
        let none = "a beam of no length: `a` and `d` of this joint are both zero";
        assert_eq!(revolute(BEAM), [none]);
        assert!(revolute(&format!("d = \"d1\"\n{BEAM}")).is_empty());
        assert_eq!(
            messages(&format!("type = \"prismatic\"\n{BEAM}density = 1\n")),
            ["a density on a prismatic joint's beam: its length changes"]
        );
    }

    #[test]
    fn the_number_of_joints_is_bounded() {
        let joints = "type = \"revolute\"\n[[joint]]\n".repeat(64) + "type = \"revolute\"\n";
        assert_eq!(messages(&joints), ["joint 65 of at most 64"]);
    }
}
