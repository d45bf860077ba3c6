//! What is put into a moving arm.
//!
//! ```text
//! place = "joint" i | "joints" i ("+" | "-") j | "link" i | "the tool in run" k | "every joint"
//!       | "the base" | "the interface"
//! value = number [ SI unit ]
//! ```
//!
//! The rest is [`notation`](crate::notation).

use core::fmt;

use stiffarm_kernels::generic::Arm;

use super::laws::{LAWS, Law};
use crate::effects::Spot;
use crate::io::{did_you_mean, nearest};
use crate::notation::{self, Size, TruthError};

/// One effect at one spot, with its numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionTruth {
    /// What reality does.
    pub law: &'static Law,
    /// Where.
    pub spot: Spot,
    /// One for each of its numbers, SI.
    pub values: Vec<f64>,
}

impl fmt::Display for MotionTruth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let numbers = self.law.numbers.iter().zip(&self.values);
        let named = numbers.map(|((name, _), value)| (*name, *value));
        notation::write(f, (self.law.name, &self.spot), named)
    }
}

impl MotionTruth {
    /// Reads a truth about this arm, which is moved in so many runs.
    ///
    /// # Errors
    /// [`TruthError`]: an unknown effect, a spot where it cannot act, an unknown number, or a value
    /// that is none.
    pub fn parse(text: &str, arm: &Arm, runs: usize) -> Result<MotionTruth, TruthError> {
        read(text, arm, runs).map_err(TruthError::of(text))
    }

    /// Reads an effect at a place of this arm, without a size.
    ///
    /// # Errors
    /// As [`MotionTruth::parse`].
    pub fn place(text: &str, arm: &Arm, runs: usize) -> Result<(&'static Law, Spot), TruthError> {
        acting(text, arm, runs).map_err(TruthError::of(text))
    }

    /// The value of a number; 0 if it has none of that name.
    pub fn value(&self, name: &str) -> f64 {
        let numbers = self.law.numbers.iter().zip(&self.values);
        numbers.filter(|((n, _), _)| *n == name).map(|(_, value)| *value).sum()
    }
}

fn read(text: &str, arm: &Arm, runs: usize) -> Result<MotionTruth, String> {
    let (head, size) = notation::split(text)?;
    let (law, spot) = acting(head, arm, runs)?;
    let mut values = vec![0.0; law.numbers.len()];
    match size {
        Size::Missing => {
            let (named, name) = (names(law), law.name);
            let numbers = format!("`{name}@{spot}:NAME=VALUE,…`");
            return Err(format!("found no `=`, expected a size for {named}: {numbers}"));
        }
        Size::First(text) => {
            let first = law.numbers.iter().position(|(name, _)| !law.is_form(name)).unwrap_or(0);
            values[first] = number(law, first, text)?;
        }
        Size::Named(list) => {
            for (name, text) in &list {
                let k = law.numbers.iter().position(|(n, _)| n == name).ok_or_else(|| {
                    let near = did_you_mean(nearest(name, law.numbers.iter().map(|(n, _)| *n)));
                    format!("found the number `{name}`, expected {}{near}", names(law))
                })?;
                values[k] = number(law, k, text)?;
            }
        }
    }
    whole(law, spot, values)
}

fn acting(text: &str, arm: &Arm, runs: usize) -> Result<(&'static Law, Spot), String> {
    let (name, spot) = text.split_once('@').map_or((text, None), |(n, spot)| (n, Some(spot)));
    let law = Law::named(name.trim()).ok_or_else(|| {
        let near = did_you_mean(nearest(name.trim(), LAWS.iter().map(|law| law.name)));
        let known: Vec<&str> = LAWS.iter().map(|law| law.name).collect();
        format!("found no such effect of motion, expected one of {}{near}", known.join(", "))
    })?;
    Ok((law, spot_of(law, spot, &law.spots(arm, runs))?))
}

fn names(law: &Law) -> String {
    let each: Vec<String> = law.numbers.iter().map(|(n, unit)| format!("{n} ({unit})")).collect();
    each.join(", ")
}

/// What an effect cannot do without beside its size.
fn whole(law: &'static Law, spot: Spot, values: Vec<f64>) -> Result<MotionTruth, String> {
    let numbers = || law.numbers.iter().zip(&values);
    let lacks = numbers().find(|((name, _), value)| law.is_form(name) && **value <= 0.0);
    if let Some(((name, unit), _)) = lacks {
        return Err(format!("found no `{name}`, expected a positive one ({unit}) beside the size"));
    }
    if numbers().all(|((name, _), value)| law.is_form(name) || *value == 0.0) {
        return Err(format!("found nothing but zeros, expected a size for {}", names(law)));
    }
    Ok(MotionTruth { law, spot, values })
}

fn number(law: &Law, k: usize, text: &str) -> Result<f64, String> {
    let (name, unit) = law.numbers[k];
    let text = text.trim();
    // N*m as N·m, and what stands behind a number may be left out.
    let plain = |text: &str| text.replace('*', "·").replace(' ', "");
    let text_alone = plain(text);
    // Of a pure number no unit stands behind it.
    let bare = if unit == "1" {
        &text_alone
    } else {
        text_alone.strip_suffix(unit).unwrap_or(&text_alone)
    };
    bare.parse()
        .ok()
        .filter(|x: &f64| x.is_finite())
        .ok_or_else(|| format!("`{name}`: found `{text}`, expected a number in SI ({unit})"))
}

fn spot_of(law: &Law, text: Option<&str>, spots: &[Spot]) -> Result<Spot, String> {
    let plain = |text: &str| text.replace('−', "-").replace(' ', "").replace("the", "");
    match text {
        Some(text) => spots.iter().find(|s| plain(&s.to_string()) == plain(text)).copied(),
        None => spots.first().filter(|_| spots.len() == 1).copied(),
    }
    .ok_or_else(|| {
        let known: Vec<String> = spots.iter().map(Spot::to_string).collect();
        let found = text.map_or_else(|| "no place".to_owned(), |t| format!("`{}`", t.trim()));
        format!(
            "found {found}, expected one of {}: `{}@{}=…`",
            known.join(", "),
            law.name,
            known[0]
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Place;
    use crate::fixture::rigid;

    fn parsed(text: &str) -> Result<MotionTruth, String> {
        MotionTruth::parse(text, &rigid(), 2).map_err(|error| error.to_string())
    }

    #[test]
    fn truths_are_read_as_they_are_written() {
        for text in [
            "coulomb_friction@joint 2:coulomb=4e0",
            "stribeck@joint 1:torque=2e0,speed=5e-2",
            "joint_coupling@joints 2 − 3:inertia=1e-2,viscous=5e-1,coulomb=1e0",
            "latency@the interface:delay=1e-1",
            "torque_scale@every joint:scale=1e-1",
        ] {
            assert_eq!(parsed(text).unwrap().to_string(), text);
        }
        let short = parsed("viscous_friction@joint 3 = 2.5 N*m*s/rad").unwrap();
        assert_eq!((short.spot, short.values), (Spot::of_joint(2), vec![2.5]));
        let payload = parsed("payload@tool in run 2:m=2,mz=0.2").unwrap();
        assert_eq!((payload.spot.place, payload.value("mz")), (Place::Held(2), 0.2));
        assert_eq!(parsed("latency=0.1 s").unwrap().spot.place, Place::Interface);
        assert_eq!(parsed("joint_coupling@joints 1+2=1").unwrap().spot.place, Place::Pair(1, 2, 1));
    }

    #[test]
    fn mistakes_are_told() {
        for (text, part) in [
            ("coulomb_frictoin@joint 2=4", "did you mean `coulomb_friction`?"),
            ("coulomb_friction@joint 7=4", "found `joint 7`, expected one of joint 1, joint 2"),
            ("coulomb_friction=4", "found no place"),
            ("coulomb_friction@joint 2", "found no `=`"),
            ("coulomb_friction@joint 2=much", "found `much`, expected a number in SI (N·m)"),
            ("coulomb_friction@joint 2=0", "nothing but zeros"),
            ("stribeck@joint 1=2", "found no `speed`"),
            ("stribeck@joint 1:torque=2,torque=3", "twice"),
            ("stribeck@joint 1:torqe=2", "did you mean `torque`?"),
        ] {
            let told = parsed(text).unwrap_err();
            assert!(told.contains(part), "{text}: {told}");
        }
    }
}
