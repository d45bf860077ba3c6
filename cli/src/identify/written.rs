//! The robot file with what was identified.

use stiffarm_codegen::number::Number;
use stiffarm_codegen::robot::Value;
use stiffarm_gap::identify::measured::{Answer, Unknown};

use crate::input::source::Source;

/// The robot's file anew: stiffnesses of the joints that were found, moduli of the beams; of what
/// was held, or came out without being positive, as before.
pub fn robot(source: &Source, answer: &Answer, data: &str) -> String {
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
            Unknown::Base(_) => {
                remarks.push(format!("{unknown}: found, but a robot file has no foundation."));
            }
        }
    }
    let plain = |remark: &String| {
        let line: String = remark.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        format!("# {line}\n")
    };
    let head: String = remarks.iter().map(plain).collect();
    format!("{head}\n{}", robot.to_toml())
}

/// With six significant digits: no measurement has more.
fn six(x: f64) -> Value {
    Value::Number(Number::from_decimal(&format!("{x:.5e}")).unwrap_or(Number::rounded(x)))
}
