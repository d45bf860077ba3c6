//! What the corrections of an identification do, joint by joint.

use std::collections::HashMap;

use nalgebra::Vector6;
use stiffarm_gap::Measurements;
use stiffarm_gap::effects::{Curve, Over};
use stiffarm_gap::identify::measured::{Answer, Parameter, Unknown};

use super::experiment::{Experiment, Share};
use super::shape::{Shaped, lever, torque};

/// The joints (from 0) whose springs were found, with what that adds to the file's compliance.
pub fn corrected(answer: &Answer) -> impl Iterator<Item = (&Parameter, usize, f64)> + '_ {
    answer.parameters.iter().filter(|p| p.usable()).filter_map(|p| match p.unknown {
        Unknown::Joint(joint) => Some((p, joint - 1, p.value - p.file)),
        Unknown::Link(_) | Unknown::Base(_) => None,
    })
}

/// A correction as a function of the joint's torque.
pub fn curve((_, joint, change): (&Parameter, usize, f64)) -> Shaped<'static> {
    let value = Box::new(move |torque| change * torque);
    Shaped {
        title: format!("compliance at joint {}", joint + 1),
        joint,
        curve: Curve { over: Over::Torque, proportional: true, value },
    }
}

/// What each joint's correction alone moves, as a part of the gap's mean square.
pub fn shares(experiment: &Experiment<'_>, answer: &Answer) -> Vec<Share> {
    let first = if experiment.has_positions() { 0 } else { 3 };
    let squares = |moves: &[Vector6<f64>]| -> f64 {
        moves.iter().map(|m| m.fixed_rows::<3>(first).norm_squared()).sum()
    };
    let whole = squares(experiment.gaps[0]);
    let share = |(parameter, joint, change): (&Parameter, usize, f64)| {
        let rows = &experiment.data.rows;
        let move_of = |row| {
            let torque = torque(experiment, row, joint).unwrap_or(0.0);
            lever(experiment, row, joint) * (torque * change)
        };
        let mut moves: Vec<Vector6<f64>> = rows.iter().map(move_of).collect();
        if !experiment.data.kind.is_difference() {
            subtract_means(&mut moves, experiment.data);
        }
        let part = if whole > 0.0 { squares(&moves) / whole } else { 0.0 };
        Share { place: parameter.unknown.to_string(), share: Some(part), found: parameter.differs }
    };
    let mut shares: Vec<Share> = corrected(answer).map(share).collect();
    shares.sort_by(|a, b| b.share.unwrap_or(0.0).total_cmp(&a.share.unwrap_or(0.0)));
    shares
}

/// Of poses only the differences between the loads of each, and of each marker in it, count.
fn subtract_means(moves: &mut [Vector6<f64>], data: &Measurements) {
    let key = |k: usize| (data.rows[k].group, data.rows[k].marker.clone());
    let mut sums: HashMap<_, (f64, Vector6<f64>)> = HashMap::new();
    for (k, moved) in moves.iter().enumerate() {
        let sum = sums.entry(key(k)).or_default();
        sum.0 += 1.0;
        sum.1 += moved;
    }
    for (k, moved) in moves.iter_mut().enumerate() {
        if let Some((count, sum)) = sums.get(&key(k)) {
            *moved -= sum / *count;
        }
    }
}
