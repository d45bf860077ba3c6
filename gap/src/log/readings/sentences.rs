//! What is said of a mistake of the readings: what is wrong, what is done, and how to mend it.

use stiffarm_kernels::generic::{Arm, Drive};

use super::Misread;
use crate::constants::FEWEST_OF_A_KIND;
use crate::log::{Log, Signal, TorqueSide};

impl Misread {
    /// What is wrong, what is done, and how to mend it.
    pub(super) fn sentence(&self, log: &Log) -> String {
        let file = log.files.join(", ");
        let named = |signal: &Signal, joint: usize| format!("{}{}", signal.name(), joint + 1);
        let what = match self {
            Misread::Time { factor } if *factor < 1.0 => format!(
                "t steps by {} s: it is read as milliseconds; write t[ms]",
                shown(log.period())
            ),
            Misread::Time { .. } => format!(
                "t steps by {} s: it is read as a thousand times that; write its unit as t[s] or t[ms]",
                shown(log.period())
            ),
            Misread::Wrapped { signal, joint, jumps } => format!(
                "{} jumps by whole turns {jumps} times: it is read without the jumps",
                named(signal, *joint)
            ),
            Misread::Rates { factor } if *factor < 0.0 => {
                "qd1 … have the sign against which q1 … change: they are read \
                 with the other"
                    .to_owned()
            }
            Misread::Rates { factor } => {
                let (is, says) = if *factor < 1.0 { ("deg", "rad") } else { ("rad", "deg") };
                format!(
                    "qd1 … are {} times the rates of q1 …: they are read as {is}/s, not {says}/s; write \
                     qd1[{is}/s]",
                    shown(1.0 / factor)
                )
            }
            Misread::NoRate { joint, ratio: Some(ratio) } => format!(
                "qd{n} is {} times the rate of q{n}: no column of rates is used; is its unit right?",
                shown(*ratio),
                n = joint + 1
            ),
            Misread::NoRate { joint, ratio: None } => format!(
                "qd{n} does not go with the rate of q{n}: no column of rates is used; is it another joint's?",
                n = joint + 1
            ),
            Misread::Silent { signal, joint, at } => format!(
                "{} is {} throughout: joint {} is left out; is the channel connected?",
                named(signal, *joint),
                shown(*at),
                joint + 1
            ),
            Misread::Parked { joint } => {
                format!("joint {} does not move: it is left out", joint + 1)
            }
            Misread::Clipped { signal, joint, samples, limits } => {
                let limits = limits.iter().filter(|limit| limit.is_finite());
                let limits: Vec<String> = limits.map(|limit| shown(*limit)).collect();
                let limits = limits.join(" and ");
                format!(
                    "{} stands at its limit of {limits} in {samples} samples: there rows of joint {} are left out",
                    named(signal, *joint),
                    joint + 1
                )
            }
            Misread::Sign { signal, joint, or: Some(other) } => format!(
                "{name} has the wrong sign for joint {n}, or {} has the wrong sign for joint {n}: this log does not \
                 distinguish them; {name} is read as −{name}; give the wrong one factor = -1 in a map",
                named(other, *joint),
                n = joint + 1,
                name = named(signal, *joint),
            ),
            Misread::Sign { signal, joint, or: None } => format!(
                "{name} has the wrong sign for joint {}: it is read as −{name}; give it factor = -1 in a map",
                joint + 1,
                name = named(signal, *joint),
            ),
            Misread::Zero { joint, by } => format!(
                "q{n} is off by {by:.1}° from the zero of the robot file: it is read as q{n} {sign} {size:.1}°; give it that offset, or \
                 add it to theta of joint {n} in the robot file",
                n = joint + 1,
                by = by.to_degrees(),
                sign = if *by < 0.0 { '−' } else { '+' },
                size = by.to_degrees().abs()
            ),
            Misread::Against { joint } => format!(
                "q{n} moves against q_cmd{n}: one of them has the wrong sign; q_cmd{n} is read as −q_cmd{n}; if q{n} is the \
                 wrong one, give it factor = -1 in a map",
                n = joint + 1
            ),
            Misread::Swapped { signal, joints: [a, b] } => format!(
                "{} and {} stand in each other's columns: they are read as swapped; write their names the other way",
                named(signal, *a),
                named(signal, *b)
            ),
            Misread::Held { runs, mass } => {
                let names: Vec<String> = runs.iter().map(|run| (run + 1).to_string()).collect();
                let (which, verb) = match names.as_slice() {
                    [one] => (format!("run {one}"), "carries"),
                    [before @ .., last] => {
                        (format!("runs {} and {last}", before.join(", ")), "carry")
                    }
                    [] => (String::new(), ""),
                };
                format!(
                    "{which} {verb} about {} kg more than the others, and no column says so: it is taken for one \
                     body; write its name in a column `payload`",
                    shown(*mass)
                )
            }
        };
        format!("{file}: {what}")
    }
}

/// What a robot file's friction looks like that nobody has measured: one number at every joint.
pub fn placeholder(arm: &Arm, side: Option<TorqueSide>) -> Option<String> {
    if arm.dof() < FEWEST_OF_A_KIND || !side.is_some_and(TorqueSide::is_driven) {
        return None;
    }
    let drives = || arm.joints.iter().map(|joint| &joint.drive);
    let all = |of: &dyn Fn(&Drive) -> f64| {
        let first = drives().map(of).next().unwrap_or(0.0);
        (first > 0.0 && drives().all(|drive| of(drive) == first)).then_some(first)
    };
    let coulomb = all(&|drive| drive.coulomb).map(|x| format!("coulomb = {}", shown(x)));
    let viscous = all(&|drive| drive.viscous).map(|x| format!("viscous = {}", shown(x)));
    let named: Vec<String> = coulomb.into_iter().chain(viscous).collect();
    (!named.is_empty()).then(|| {
        format!(
            "the robot file has {} at every joint: is it a placeholder of a simulator's file? What is found is beyond it, \
             and takes it back where it is too much",
            named.join(" and ")
        )
    })
}

/// Three significant digits.
fn shown(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return x.to_string();
    }
    let digits = (2.0 - x.abs().log10().floor()).clamp(0.0, 12.0);
    let text = format!("{x:.*}", digits as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}
