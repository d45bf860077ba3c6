//! The robot file with what was identified.

use stiffarm_codegen::number::Number;
use stiffarm_codegen::robot::{Robot, Value};
use stiffarm_gap::effects::{BaseCompliance, Known, Place, RobotFile, Spot};
use stiffarm_gap::identify::measured::{Answer, Parameter, Unknown};

use crate::diagnose::commented;
use crate::input::source::Source;
use crate::terminal::failure::Failure;

/// The robot's file anew: stiffnesses of the joints that were found, moduli of the beams, what the
/// foundation gives as an `[[effect]]`; of what was held, or came out without being positive, as before.
pub fn robot(source: &Source, answer: &Answer, data: &str) -> Result<String, Failure> {
    let mut robot = source.robot.clone();
    let mut remarks = vec![format!("Identified by stiffarm from {data}; of {}.", source.given)];
    for parameter in &answer.parameters {
        let unknown = parameter.unknown;
        if !parameter.usable() {
            if !matches!(unknown, Unknown::Base(_)) {
                remarks.push(format!("{unknown}: not identified, as it was."));
            }
            continue;
        }
        match unknown {
            Unknown::Joint(j) => {
                let joint = &mut robot.joints[j - 1];
                joint.stiffness = Some(six(1.0 / parameter.value));
                let bound =
                    |c: f64| if c > 0.0 { format!("{:.3e}", 1.0 / c) } else { "rigid".to_owned() };
                if let Some([low, high]) = parameter.interval() {
                    remarks.push(format!(
                        "{unknown}: 95 % from {} to {}.",
                        bound(high),
                        bound(low)
                    ));
                }
            }
            Unknown::Link(row) => {
                if let Some(beam) = &mut robot.joints[row - 1].beam {
                    for modulus in [&mut beam.youngs_modulus, &mut beam.shear_modulus] {
                        if let Some(number) = modulus.number() {
                            *modulus = six(number.to_f64() / parameter.value);
                        }
                    }
                    let times = parameter.value;
                    remarks.push(format!("{unknown}: {times:.4} times as flexible as before."));
                }
            }
            Unknown::Base(_) => remarks.push(of_the_base(parameter)),
        }
    }
    let robot = on_its_foundation(robot, source, answer)?;
    Ok(commented(remarks, &robot))
}

/// Where the file has it.
fn of_the_base(parameter: &Parameter) -> String {
    let (unknown, value) = (parameter.unknown, parameter.value);
    match unknown {
        Unknown::Base(0..3) => format!(
            "{unknown}: {value:.3e} m/N; `give` is the mean of all directions that were found."
        ),
        Unknown::Base(3 | 4) => format!("{unknown}: {value:.3e} rad/(N*m), among the effects."),
        _ => {
            format!("{unknown}: {value:.3e} rad/(N*m); no entry has it: joint 1's spring turns so.")
        }
    }
}

/// With what the foundation gives. One number stands for shifts in all directions: their mean, each by how
/// well it is known.
fn on_its_foundation(robot: Robot, source: &Source, answer: &Answer) -> Result<Robot, Failure> {
    let found = |k: usize| {
        let mut all = answer.parameters.iter().filter(|p| p.usable());
        all.find(|p| p.unknown == Unknown::Base(k))
    };
    let weight = |p: &Parameter| p.interval().map_or(0.0, |[low, high]| (high - low).powi(-2));
    let shifts: Vec<[f64; 2]> = (0..3).filter_map(found).map(|p| [weight(p), p.value]).collect();
    let all: f64 = shifts.iter().map(|[weight, _]| weight).sum();
    let give: f64 = shifts.iter().map(|[weight, value]| weight / all * value).sum();
    let [x, y] = [3, 4].map(|k| found(k).map_or(0.0, |p| p.value));
    if [x, y, give] == [0.0; 3] {
        return Ok(robot);
    }
    let foundation = Known {
        effect: &BaseCompliance,
        spot: Spot { place: Place::Base, form: 0 },
        values: vec![x, y, give],
        session: None,
        at: Default::default(),
    };
    let (arm, mut known) = (source.arm()?, source.known.clone());
    let mut file = RobotFile::new(&robot, &arm);
    file.put(&foundation, &mut known);
    let mut robot = file.finish(&known);
    robot.effects.extend(source.in_motion_alone());
    Ok(robot)
}

/// With six significant digits: no measurement has more.
fn six(x: f64) -> Value {
    Value::Number(Number::from_decimal(&format!("{x:.5e}")).unwrap_or(Number::rounded(x)))
}
