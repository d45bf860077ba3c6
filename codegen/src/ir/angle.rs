//! Angles whose sines and cosines enter a function: what they are sums of, and what they are called.

use super::constants::parameter;
use super::term::{Name, Term};
use crate::derive::COMPONENTS;
use crate::expr::{Expr, Graph, Symbol};

/// An angle whose sine and cosine are inputs.
#[derive(Clone, Debug)]
pub(crate) struct Angle {
    /// The sum of joint angles (and offsets) itself.
    pub sum: Term,
    /// What stands behind `s` and `c` in the names: `23` for θ2 + θ3.
    pub suffix: String,
    pub sine: bool,
    pub cosine: bool,
}

impl Angle {
    /// The names of sine and cosine, of those that are needed.
    pub fn names(&self) -> [Option<Name>; 2] {
        [(self.sine, 's'), (self.cosine, 'c')]
            .map(|(needed, letter)| needed.then(|| format!("{letter}{}", self.suffix).into()))
    }

    /// The names of those that are needed.
    pub fn needed(&self) -> impl Iterator<Item = Name> {
        self.names().into_iter().flatten()
    }
}

/// What stands behind `s` and `c`: the joints and displacements of the sum, or its parameters.
pub(super) fn name(g: &Graph, sum: Expr) -> String {
    let mut name = suffix(&joints_of(g, sum));
    name.push_str(&displaced(g, sum, name.is_empty()));
    if name.is_empty() { parameters_of(g, sum).join("_") } else { name }
}

/// The outermost joint of the sum.
pub(super) fn last_joint(g: &Graph, sum: Expr) -> Option<usize> {
    joints_of(g, sum).iter().map(|(joint, _)| *joint).max()
}

/// The joints in a sum of angles, each with whether it is subtracted.
fn joints_of(g: &Graph, sum: Expr) -> Vec<(usize, bool)> {
    let joint = |e: Expr| match g.symbol_at(e.node())? {
        Symbol::Joint(joint) => Some((*joint, e.is_negative())),
        _ => None,
    };
    g.terms(sum).into_iter().filter_map(joint).collect()
}

/// The parameters in an angle without joints.
fn parameters_of(g: &Graph, sum: Expr) -> Vec<String> {
    g.terms(sum).into_iter().filter_map(|e| parameter(g, e.node()).map(str::to_owned)).collect()
}

/// What displacements add to an angle's name: `d1` behind joints for dφ1, alone `phi1`.
fn displaced(g: &Graph, sum: Expr, alone: bool) -> String {
    let mut places = Vec::new();
    for e in g.terms(sum) {
        if let Some(Symbol::Displacement { place, component }) = g.symbol_at(e.node()) {
            places.push((*place, COMPONENTS[*component].trim_start_matches('d')));
        }
    }
    let each = places.iter().map(|(place, letter)| match alone {
        true => format!("{letter}{place}"),
        false => format!("d{place}"),
    });
    each.collect()
}

/// `23` for θ2 + θ3, `2m3` for θ2 − θ3, `9_10` where a joint's number has two digits.
fn suffix(joints: &[(usize, bool)]) -> String {
    let long = joints.iter().any(|(joint, _)| *joint >= 9) && joints.len() > 1;
    let mut out = String::new();
    for (at, (joint, negative)) in joints.iter().enumerate() {
        match (negative, at) {
            (true, _) => out.push('m'),
            (false, at) if long && at > 0 => out.push('_'),
            _ => {}
        }
        out.push_str(&(joint + 1).to_string());
    }
    out
}
